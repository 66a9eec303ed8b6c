"""The content of an open file as groups and arrays by name, and the errors of files that are not what jam wrote."""
from __future__ import annotations

import contextlib
from typing import Any, Callable, Iterator, Mapping, Sequence

from .._api.arrays import Array
from ..errors import StoreError


def damaged(path: Any, what: str) -> StoreError:
    """The error for a file that is not what jam wrote."""
    return StoreError(
        5,
        f"{path} is damaged, or was changed by another program: {what}. Use another copy or make it again. "
        "unverified=True reads a file of your own without this check",
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
    """An attribute as JSON holds it."""
    value = value.tolist() if hasattr(value, "tolist") else value
    if isinstance(value, list):
        return [plain_value(v) for v in value]
    return value.decode() if isinstance(value, bytes) else value


class Group(Mapping[str, Any]):
    """Datasets and groups by name, as of h5py: arrays are read, and checked, when asked for."""

    def __init__(self, names: Sequence[str], fetch: Callable[[str], Array], attributes: Mapping[str, Any], at: str = ""):
        self.all, self._fetch, self._attributes, self._at = names, fetch, attributes, at
        inside = [name[len(at) :] for name in names if name.startswith(at)]
        self._datasets, self._inside = set(inside), list(dict.fromkeys(name.partition("/")[0] for name in inside))

    @property
    def attrs(self) -> dict[str, Any]:
        """Attributes of this group."""
        return dict(self._attributes.get(self._at.rstrip("/"), {}))

    def __getitem__(self, name: str) -> Any:
        if name in self._datasets:
            return self._fetch(self._at + name)
        if name not in self:
            raise KeyError(name)
        return Group(self.all, self._fetch, self._attributes, f"{self._at}{name}/")

    def __contains__(self, name: object) -> bool:
        return name in self._datasets or any(d.startswith(f"{name}/") for d in self._datasets)

    def __iter__(self) -> Iterator[str]:
        return iter(self._inside)

    def __len__(self) -> int:
        return len(self._inside)


class Shard(Mapping[str, Group]):
    """Packings of a shard by name."""

    def __init__(self, names: Sequence[str], fetch: Callable[[str], Group]) -> None:
        self._names, self._fetch = list(names), fetch

    def __getitem__(self, name: str) -> Group:
        if name not in self._names:
            raise KeyError(name)
        return self._fetch(name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)
