"""One packing of an ensemble."""
from __future__ import annotations

from typing import Any

from .. import store
from .._api.results import Contacts
from .._formats.content import Packing
from .._formats.sealed import read_packing
from ..system import System
from .folder import Place
from .rows import FIELDS


class Entry:
    """One packing of an ensemble. It has the attributes and analyses of its System: entry.forces, entry.modes(5), ...

    What the file stores is read from it on first use: positions, diameters, contacts, forces, coordination, rattlers,
    bucklers, history. All else is asked of a System that is made from the file for this one question, so the packing of
    an entry never changes. To ask much, or to move spheres, take system().

    Of the ensemble are `gaps` and `gap_pairs`, those of the protocol's analysis (any others: system().gaps(...));
    `analysis(name)`, any other result; and the numbers of the report, by their names or as row["rattlers"].
    """

    __slots__ = ("row", "path", "_inner")

    _PLACES = {
        "pairs": "contacts/pairs",
        "vectors": "contacts/vectors",
        "contact_gaps": "contacts/gaps",
        "forces": "contacts/forces",
        "gaps": "analysis/gaps/gap",
        "gap_pairs": "analysis/gaps/pair",
        "diameters": "diameters",
        "coordination": "coordination",
        "history": "history",
    }
    _MADE = ("positions", "contacts", "rattlers", "bucklers")  # from several places, or with another layout

    def __init__(self, row: Any, place: Place) -> None:
        #: The row of the table
        self.row = row
        #: The file, which may be a shard
        self.path, self._inner = place

    seed = property(lambda self: int(self.row["seed"]))

    def read(self, *names: str) -> tuple[Any, ...]:
        """Several of the stored attributes with one opening of the file."""
        packing = read_packing(self.path, self._inner)
        return tuple(self._get(packing, name) for name in names)

    def _get(self, packing: Packing, name: str) -> Any:
        if name == "rattlers":
            return self._get(packing, "coordination") == 0
        if name == "bucklers":
            return self._get(packing, "coordination") == int(self.row["dim"]) + 1
        if name == "contacts":
            return Contacts(*(self._get(packing, part) for part in ("pairs", "vectors", "contact_gaps", "forces")))
        if name == "positions":
            return packing.arrays["particles/spheres/position/value"][0]
        if name in FIELDS and name not in self._PLACES:
            return self.row[name]
        found = packing.get("jam/" + self._PLACES.get(name, "analysis/" + name))
        if found is None:
            there = [*self._PLACES, *self._MADE, *(packing.get("jam/analysis") or ())]
            raise KeyError(f"{self.path} contains no {name!r}; there may be {', '.join(there)}")
        return found

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        if name in self._PLACES or name in self._MADE:
            try:
                return self.read(name)[0]
            except KeyError:
                if name.startswith("gap") or not hasattr(System, name):
                    raise
                return getattr(self.system(), name)  # which says what is missing
        if name in FIELDS:
            return self.row[name]
        if hasattr(System, name):
            return getattr(self.system(), name)
        raise AttributeError(f"neither System nor the table of an ensemble has {name!r}")

    def __dir__(self) -> list[str]:
        of_system = [name for name in dir(System) if not name.startswith("_")]
        return sorted({*object.__dir__(self), *self._PLACES, *self._MADE, *FIELDS, *of_system})

    def analysis(self, name: str) -> Any:
        """A result of the protocol's analysis: a number, an array, text, or a dict of them."""
        return self.read(name)[0]

    def system(self) -> System:
        """The packing itself."""
        return store.load(self.path, self._inner)

    def __repr__(self) -> str:
        return f"Entry(seed={self.seed}, n={self.row['n']}, jammed={self.row['jammed']}, {self.path.name})"
