"""The packings of an ensemble: rows of the table, which say what each is and how its crunch ended; entries, which read more;
and what there is in numbers, with the warning of what cannot be read.

index.bin has the rows, to save time. It may be anybody's: it is a sealed file as those of packings, and a row counts only for a
file with the place, size and time of change that its key names. Some are compared with their files (folder.py).
"""
from __future__ import annotations

import contextlib
import os
import re
import warnings
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, Iterable, Mapping

import numpy as np

from .. import store
from .._api.arrays import Array
from .._api.generated import CrunchReport
from .._api.given import enclosure_of
from .._api.results import Contacts
from .._api.size_laws import size_report, volume_of
from .._formats.records import enum_of, fill, of_report
from .._formats.replacing import replacing
from .._formats.seal import SCHEMA, Packing, read_packing, refusing, seal
from ..errors import StoreError
from ..system import System
from .protocol import packing_name

_REPORT = of_report(CrunchReport)[0]
#: What distinguishes packings, the report of the crunch, and the crystal score (nan: not asked for).
ROW = np.dtype(
    [
        *[("seed", "i8"), ("name", "S32"), ("protocol", "S12"), ("version", "S24")],
        *[("commit", "S12"), ("library", "S16"), ("algorithm", "S12"), ("n", "i4"), ("dim", "i4")],
        *[(k, _REPORT[k].str) for k in _REPORT.names or ()],
        *[("crystal_score", "f8"), ("seconds_made", "f8"), ("written", "f8")],
    ]
)
FIELDS: tuple[str, ...] = ROW.names or ()


def row_of(packing: Packing) -> Array:
    """The row of a packing. Its name follows from protocol, seed and algorithm, not from the file's."""
    # 1.0.0 wrote no algorithm, and was the first; older files have no builds
    jam: dict[str, Any] = {"algorithm": "1.0.0", "commit": "", "library": "", "seconds_made": np.nan, **packing.attributes["jam"]}
    made, arrays = np.zeros((), ROW), packing.arrays
    fill(made, arrays.get("jam/report"))
    for key in ("seed", "protocol", "version", "written", "algorithm", "commit", "library", "seconds_made"):
        made[key] = jam[key]
    made["name"] = packing_name(jam["protocol"], jam["seed"], str(jam["algorithm"]))
    sigma, cell = arrays["jam/diameters"], arrays["particles/spheres/box/edges/value"][0]
    made["n"], made["dim"], dim = len(sigma), len(cell), len(cell)
    if "jam/report" not in arrays:
        container, _ = enclosure_of(jam.get("container"), None, dim)
        made["packing_fraction"] = size_report(sigma, dim).volume / volume_of(container, cell)
        made["diameter_mean"] = sigma.mean()
    score = arrays.get("jam/analysis/crystal_score")
    made["crystal_score"] = np.nan if score is None or score.dtype.kind != "f" else score[()]
    return made


def build_of(row: Any) -> str:
    """The build of libjam that made a packing: version, commit, digest of the library."""
    parts = {"": row["version"], "commit ": row["commit"], "library ": row["library"]}
    return " ".join(word + part.decode() for word, part in parts.items() if part)


def as_table(entries: Iterable[Any], pandas: bool) -> Any:
    """The rows of entries, or a DataFrame of them: text as str, enums as words, None for a number that has none."""
    rows = np.array([e.row for e in entries], ROW)
    if not pandas:
        return rows
    import pandas as pd

    columns: dict[str, Any] = {name: rows[name].astype(str) if rows.dtype[name].kind == "S" else rows[name] for name in FIELDS}
    for f in fields(CrunchReport):
        if enum := enum_of(str(f.type)):
            words = {int(value): value.name.lower() for value in enum}
            columns[f.name] = [words.get(int(number)) for number in rows[f.name]]
    return pd.DataFrame(columns)


def name_at(path: Path, inner: str | None) -> str:
    """The packing that a file is named after, as Folder.place() does; none of one in a shard, and of any other name."""
    found = re.fullmatch("([0-9a-f]{32})(-.*)?", path.stem)
    return found[1] if found and inner is None and path.parent.name == found[1][:2] else ""


class Entry:
    """One packing of an ensemble. It has the attributes and analyses of its System: entry.forces, entry.modes(5), ...

    What the file stores is read from it on first use: positions, diameters, contacts, forces, coordination, rattlers,
    bucklers, history. All else is asked of a System that is made from the file for this one question, so the packing of
    an entry never changes. To ask much, or to move spheres, take system().

    Of the ensemble are `gaps` and `gap_pairs`, those of the protocol's analysis (any others: system().gaps(...));
    `analysis(name)`, any other result; and the numbers of the report, by their names or as row["rattlers"].
    """

    __slots__ = ("row", "path", "_place")

    _PLACES = {
        "positions": "particles/spheres/position/value",
        "contacts": "jam/contacts",
        "pairs": "jam/contacts/pairs",
        "vectors": "jam/contacts/vectors",
        "contact_gaps": "jam/contacts/gaps",
        "forces": "jam/contacts/forces",
        "gaps": "jam/analysis/gaps/gap",
        "gap_pairs": "jam/analysis/gaps/pair",
        "diameters": "jam/diameters",
        "history": "jam/history",
        "coordination": "jam/coordination",
        "rattlers": "jam/coordination",
        "bucklers": "jam/coordination",
    }

    def __init__(self, row: Any, place: tuple[Path, str | None]) -> None:
        #: The row of the table
        self.row = row
        #: The file, which may be a shard
        self.path, self._place = place[0], place

    seed = property(lambda self: int(self.row["seed"]))

    def read(self, *names: str) -> tuple[Any, ...]:
        """Several of the stored attributes with one opening of the file."""
        packing = read_packing(*self._place)
        return tuple(self._get(packing, name) for name in names)

    def _get(self, packing: Packing, name: str) -> Any:
        if name in FIELDS and name not in self._PLACES:
            return self.row[name]
        found = packing.get(self._PLACES.get(name, "jam/analysis/" + name))
        if found is None:
            there = [*self._PLACES, *(packing.get("jam/analysis") or ())]
            raise KeyError(f"{self.path} contains no {name!r}; there may be {', '.join(there)}")
        if name in ("rattlers", "bucklers"):
            return found == (0 if name == "rattlers" else int(self.row["dim"]) + 1)
        return Contacts(**found) if name == "contacts" else found[0] if name == "positions" else found

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        if name in self._PLACES:
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
        return sorted({*object.__dir__(self), *self._PLACES, *FIELDS, *of_system})

    def analysis(self, name: str) -> Any:
        """A result of the protocol's analysis: a number, an array, text, or a dict of them."""
        return self.read(name)[0]

    def system(self) -> System:
        """The packing itself."""
        return store.load(*self._place)

    def __repr__(self) -> str:
        return f"Entry(seed={self.seed}, n={self.row['n']}, jammed={self.row['jammed']}, {self.path.name})"


class DamagedWarning(UserWarning):
    """Files of an ensemble that cannot be read are left out; the text names them."""


def warn(left_out: Iterable[str]) -> None:
    """Names the first files that are left out."""
    texts = list(left_out)
    if texts:
        more = f"; and {len(texts) - 5} more" if len(texts) > 5 else ""
        warnings.warn(f"{len(texts)} files are omitted: " + "; ".join(texts[:5]) + more, DamagedWarning, stacklevel=3)


@dataclass(frozen=True)
class Status:
    """What is there of the seeds asked for."""

    asked: int
    done: int
    jammed: int
    failed: int
    #: What is wrong with each file that cannot be read; a text names its file. Without seeds: of any protocol.
    damaged: tuple[str, ...] = ()
    #: Files that hold the packing of a seed that another file holds too, or that have the name of another packing.
    odd: tuple[str, ...] = ()
    #: Files that could not be read, whose packings run() has made again.
    remade: tuple[str, ...] = ()
    #: Packings that run() has made.
    made: int = 0
    #: Builds of libjam that made the packings: more than one may differ in the last bits. The table has columns of it.
    builds: tuple[str, ...] = ()

    @property
    def missing(self) -> int:
        """Neither made, failed nor damaged."""
        return max(0, self.asked - self.done - self.failed - len(self.damaged))

    def __str__(self) -> str:
        there = f"{self.done} of {self.asked} packings are there, {self.jammed} jammed"
        text = f"{there}; {self.failed} failed, {self.missing} to be made"
        for count, said in (
            (self.made, f"{self.made} made now"),
            (len(self.damaged), f"{len(self.damaged)} damaged and omitted: " + "; ".join(self.damaged[:3])),
            (len(self.odd), f"{len(self.odd)} files are odd: " + "; ".join(self.odd[:3])),
            (len(self.remade), f"made again: {', '.join(self.remade)}"),
            (len(self.builds) > 1, f"made by {len(self.builds)} builds: " + ", ".join(self.builds)),
        ):
            text += f"; {said}" if count else ""
        return text


# ---- index.bin
def key_of(path: Path, inner: str | None) -> bytes:
    """What the index calls a packing, of a file as it is now."""
    stat = path.stat()
    return os.fsencode(f"{path.parent.name}/{path.name}:{inner or ''} {stat.st_size} {stat.st_mtime_ns}")


def read_index(path: Path) -> dict[bytes, bytes]:
    """Rows by key; none where it is not the index that was written, or has rows of another kind."""
    with contextlib.suppress(StoreError), refusing(path):
        found = read_packing(path).arrays
        if found["rows"].dtype == ROW:
            return dict(zip(found["keys"].tolist(), (row.tobytes() for row in found["rows"].reshape(-1))))
    return {}


def write_index(path: Path, rows: Mapping[bytes, bytes]) -> None:
    """Nothing is lost where that cannot be."""
    arrays = {"keys": np.array([*rows], "S"), "rows": np.frombuffer(b"".join(rows.values()), ROW)}
    with contextlib.suppress(OSError):
        if path.is_symlink():  # somebody's: what it leads to is not replaced
            path.unlink()
        with replacing(path) as file:
            seal(file, Packing(arrays, {"jam": {"schema": SCHEMA}}))
