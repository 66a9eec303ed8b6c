"""What a file of packings holds, as arrays and attributes by name, and the errors of files that are not what jam wrote."""
from __future__ import annotations

import contextlib
from typing import Any, Iterator, NamedTuple

import numpy as np

from .._api.arrays import Array
from .._api.results import Contacts
from ..errors import StoreError

SCHEMA = 1
CONTACTS = ("pairs", "vectors", "gaps", "forces")


def damaged(path: Any, what: str) -> StoreError:
    """The error for a file that is not what jam wrote."""
    return StoreError(
        5,
        f"{path} is damaged, or was changed by another program: {what}. Use another copy or make it again; "
        "h5py reads its arrays, and System.from_arrays takes positions, diameters and cell vectors",
    )


@contextlib.contextmanager
def refusing(path: Any) -> Iterator[None]:
    """Whatever the content of a file leads to inside is one StoreError."""
    try:
        yield
    except StoreError:
        raise
    except (KeyError, ValueError, TypeError, IndexError, AttributeError, RecursionError, OverflowError) as error:
        raise damaged(path, f"{type(error).__name__}: {error}") from error
    except OSError as error:
        raise StoreError(error.errno or 5, f"{path} cannot be read: {error.strerror or error}") from error


def plain_value(value: Any) -> Any:
    """Attributes as JSON holds them."""
    value = value.tolist() if hasattr(value, "tolist") else value
    if isinstance(value, dict):
        return {key: plain_value(v) for key, v in value.items()}
    if isinstance(value, list):
        return [plain_value(v) for v in value]
    return value.decode() if isinstance(value, bytes) else value


class Packing(NamedTuple):
    """One packing: its arrays, the attributes of its groups, and texts beside the arrays, by their path in the file."""

    arrays: dict[str, Array]
    attributes: dict[str, dict[str, Any]]
    texts: dict[str, dict[str, str]] = {}

    @property
    def jam(self) -> dict[str, Any]:
        """Attributes of the packing as a whole."""
        return self.attributes["jam"]

    def get(self, path: str) -> Any:
        """A number, an array or text; of a group a dict of them. None where there is none."""
        if path in self.arrays:
            value: Any = self.arrays[path][()]
            return value.decode() if isinstance(value, bytes) else value
        names = dict.fromkeys(name[len(path) + 1 :].partition("/")[0] for name in self.arrays if name.startswith(path + "/"))
        return {name: self.get(f"{path}/{name}") for name in names} or None

    def array(self, path: str, kind: str, *shape: int) -> Array:
        """An array, checked for a type and a shape, -1 for any length."""
        value = self.arrays[path]
        fits = value.ndim == len(shape) and all(a in (-1, b) for a, b in zip(shape, value.shape))
        if not fits or (kind and not np.can_cast(value.dtype, kind, "safe")):
            raise ValueError(f"{path} is {value.dtype} of shape {value.shape}, not {kind} of {shape}")
        return value

    def check_record(self, path: str, *shape: int) -> None:
        """A record of numbers, or a row of them, where there is one."""
        if path in self.arrays:
            kind = self.array(path, "", *shape).dtype
            if not kind.names or any(kind[k].kind not in "iufb" for k in kind.names):
                raise ValueError(f"{path} is {kind}, not a record of numbers")

    def contacts(self, n: int, dim: int) -> Contacts | None:
        """The contacts, whose shapes and indices fit n spheres, or None."""
        if not any(name.startswith("jam/contacts/") for name in self.arrays):
            return None
        pairs = self.array("jam/contacts/pairs", "i4", -1, 2)
        count, spheres = len(pairs), pairs.copy()
        if "container" in self.jam:  # partners below 0 are walls, two a flat axis and a round one
            wall = (pairs[:, 1] < 0) & (pairs[:, 1] >= -1 - 2 * dim)
            spheres[wall, 1] = spheres[wall, 0]
        if count and not (0 <= spheres.min() and spheres.max() < n):
            raise ValueError(f"contacts/pairs name spheres {pairs.min()} to {pairs.max()} of {n}")
        vectors = self.array("jam/contacts/vectors", "f8", count, dim)
        return Contacts(pairs, vectors, *(self.array("jam/contacts/" + k, "f8", count) for k in ("gaps", "forces")))
