"""What a file of one packing holds, as plain data."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from .._api.arrays import Array
from .._api.generated import CrunchReport
from .._api.results import Contacts

#: What to do after an error in writing
MENDED = "Nothing that was finished is lost: correct this and run again"


@dataclass(frozen=True)
class Contents:
    """One packing: n spheres in d dimensions, None for results that it does not have."""

    state: bytes  # of a checkpoint
    calls: list[dict[str, Any]]  # that moved the spheres
    seed: int
    positions: Array  # (n, d)
    cell: Array  # (d, d), one vector a row
    diameters: Array  # (n,)
    container: str  # "brick", "cylinder", "ball"
    walls: list[bool]  # axes with flat walls
    closed: list[bool]  # axes along which nothing repeats
    report: CrunchReport | None
    contacts: Contacts | None
    history: Array | None  # steps of the crunch, one a row
    coordination: Array | None  # (n,)
