"""Parts of an open file of one packing, each checked for type and shape."""
from __future__ import annotations

from typing import Any

import numpy as np

from .._api.arrays import Array
from .._api.generated import CrunchReport
from .._api.results import Contacts
from ..errors import StoreError
from .groups import Group, Shard
from .records import unpack
from .write_packing import CONTACTS, SCHEMA


def jam_of(file: Group | Shard, path: Any) -> Group:
    """The group `jam` of a file of one packing."""
    if isinstance(file, Shard):
        raise StoreError(22, f"{path} is a shard of {len(file)} packings: name one, e.g. name={next(iter(file))!r}")
    if "jam" not in file or "schema" not in file["jam"].attrs:
        raise StoreError(22, f"{path} contains no packing of jam (no group `jam`)")
    found: Group = file["jam"]
    if int(found.attrs["schema"]) > SCHEMA:
        raise StoreError(22, f"{path}: schema {found.attrs['schema']} is newer than the schema {SCHEMA} of this jam")
    return found


def checked(name: str, value: Array, kind: str, *shape: int) -> Array:
    """An array of a type and a shape, -1 for any length."""
    fits = value.ndim == len(shape) and all(a in (-1, b) for a, b in zip(shape, value.shape))
    if not fits or not np.can_cast(value.dtype, kind, "safe"):
        raise ValueError(f"{name} is {value.dtype} of shape {value.shape}, not {kind} of {shape}")
    return value


def record(name: str, value: Array, dimensions: int) -> Array:
    """A record of numbers, or a row of them."""
    names = value.dtype.names or ()
    if value.ndim != dimensions or not names or any(value.dtype[k].kind not in "iufb" for k in names):
        raise ValueError(f"{name} is {value.dtype} of shape {value.shape}, not a record of numbers")
    return value


def contacts_of(jam: Group, n: int, dim: int) -> Contacts | None:
    """The contacts in a group `jam`, whose shapes and indices fit n spheres, or None."""
    if "contacts" not in jam:
        return None
    pairs, vectors, gaps, forces = (jam["contacts/" + k] for k in CONTACTS)
    count = len(checked("contacts/pairs", pairs, "i4", -1, 2))
    spheres = pairs.copy()
    if "container" in jam.attrs and count:  # partners below 0 are walls, two a flat axis and a round one
        wall = (pairs[:, 1] < 0) & (pairs[:, 1] >= -1 - 2 * dim)
        spheres[wall, 1] = spheres[wall, 0]
    if count and not (0 <= spheres.min() and spheres.max() < n):
        raise ValueError(f"contacts/pairs name spheres {pairs.min()} to {pairs.max()} of {n}")
    checked("contacts/vectors", vectors, "f8", count, dim)
    checked("contacts/gaps", gaps, "f8", count)
    checked("contacts/forces", forces, "f8", count)
    return Contacts(pairs, vectors, gaps, forces)


def results_of(jam: Group, n: int, dim: int) -> tuple[Any, ...] | None:
    """Report, contacts and history of a group `jam`, or None."""
    report = unpack(record("report", jam["report"], 0)[()], CrunchReport) if "report" in jam else None
    contacts = contacts_of(jam, n, dim)
    if report is None and contacts is None:
        return None
    return report, contacts, record("history", jam["history"], 1) if "history" in jam else None


def plain(node: Any) -> Any:
    if isinstance(node, Group):
        return {k: plain(v) for k, v in node.items()}
    value = node[()]
    return value.decode() if isinstance(value, bytes) else value
