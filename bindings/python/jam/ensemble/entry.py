"""One packing of an ensemble."""
from __future__ import annotations

from pathlib import Path
from typing import Any

from .. import store
from .._formats.read_packing import jam_of, plain
from .._formats.sealed import open_file
from ..system import System
from .folder import FIELDS


class Entry:
    """One packing of an ensemble, read from its file on first use.

    Attributes are what System calls them: positions, diameters, pairs, vectors, contact_gaps, forces, coordination,
    rattlers (which spheres are), history; `gaps` are those of the protocol's analysis; `analysis(name)` reads any other
    result. Numbers of the report go by their names, the number of rattlers by row["rattlers"].
    """

    _PLACES = {
        "pairs": "contacts/pairs",
        "vectors": "contacts/vectors",
        "contact_gaps": "contacts/gaps",
        "forces": "contacts/forces",
        "gaps": "analysis/gaps/gap",
        "diameters": "diameters",
        "coordination": "coordination",
        "history": "history",
    }

    def __init__(self, row: Any, path: Path, unverified: bool = False) -> None:
        #: The row of the table
        self.row = row
        #: The file
        self.path = path
        self._unverified = unverified

    seed = property(lambda self: int(self.row["seed"]))

    def read(self, *names: str) -> tuple[Any, ...]:
        """Several of the attributes with one opening of the file."""
        with open_file(self.path, self._unverified) as file:
            jam_of(file, self.path)
            return tuple(self._get(file, name) for name in names)

    def _get(self, file: Any, name: str) -> Any:
        if name == "rattlers":
            return self._get(file, "coordination") == 0
        if name == "positions":
            return file["particles/spheres/position/value"][0]
        if name in FIELDS and name not in self._PLACES:
            return self.row[name]
        place = self._PLACES.get(name, "analysis/" + name)
        if place not in file["jam"]:
            there = list(self._PLACES) + ["positions"] + list(file["jam/analysis"])
            raise KeyError(f"{self.path} contains no {name!r}; there may be {', '.join(there)}")
        return plain(file["jam/" + place])

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name not in (*self._PLACES, "positions", *FIELDS):
            raise AttributeError(name)
        return self.read(name)[0]

    def analysis(self, name: str) -> Any:
        """A result of the protocol's analysis: a number, an array, text, or a dict of them."""
        return self.read(name)[0]

    def system(self) -> System:
        """The packing itself."""
        return store.load(self.path, unverified=self._unverified)

    def __repr__(self) -> str:
        return f"Entry(seed={self.seed}, n={self.row['n']}, jammed={self.row['jammed']}, {self.path.name})"
