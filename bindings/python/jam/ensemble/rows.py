"""Rows of an ensemble's table: what one packing is and how its crunch ended, taken from its file; as numpy, pandas and bytes. And
what there is of an ensemble in numbers, with the warning of what cannot be read.

index.bin in an ensemble's folder has the rows, each by a digest of its file's place, size and time of change. It only saves
time. It may be anybody's: it is read as bytes of fixed length behind their checksum, and a row counts only for the file that
its digest names. Some rows are compared with their files each time (folder.py).
"""
from __future__ import annotations

import contextlib
import hashlib
import math
import os
import warnings
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any, Iterable, Mapping

import numpy as np

from .._api.arrays import Array
from .._api.generated import CrunchReport
from .._formats.content import Packing
from .._formats.records import dtype_of, enum_of, unknown
from .._formats.replacing import open_regular
from .._formats.write_packing import write_file
from .protocol import packing_name

_REPORT = dtype_of(CrunchReport)
_REPORT_FIELDS: tuple[str, ...] = _REPORT.names or ()
#: What distinguishes packings, the report of the crunch, and the crystal score (nan: not asked for).
ROW = np.dtype(
    [
        *[("seed", "i8"), ("name", "S32"), ("protocol", "S12"), ("version", "S24")],
        *[("commit", "S12"), ("library", "S16"), ("algorithm", "S12"), ("n", "i4"), ("dim", "i4")],
        *[(k, _REPORT[k]) for k in _REPORT_FIELDS],
        *[("crystal_score", "f8"), ("seconds_made", "f8"), ("written", "f8")],
    ]
)
FIELDS: tuple[str, ...] = ROW.names or ()


def row_of(packing: Packing) -> Array:
    """The row of a packing. Its name follows from protocol, seed and algorithm, not from the file's."""
    made, arrays, attributes = np.zeros((), ROW), packing.arrays, packing.jam
    for key in ("seed", "protocol", "version", "written"):
        made[key] = attributes[key]
    # 1.0.0 wrote no algorithm, and was the first; older files have no builds
    for key, absent in (("algorithm", "1.0.0"), ("commit", ""), ("library", ""), ("seconds_made", np.nan)):
        made[key] = attributes.get(key, absent)
    algorithm = str(attributes.get("algorithm", "1.0.0"))
    made["name"] = packing_name(attributes["protocol"], attributes["seed"], algorithm)
    sigma, cell = arrays["jam/diameters"], arrays["particles/spheres/box/edges/value"][0]
    made["n"], made["dim"] = len(sigma), len(cell)
    for f in fields(CrunchReport):
        made[f.name] = unknown(str(f.type))
    ball = math.pi ** (len(cell) / 2) / math.gamma(len(cell) / 2 + 1) / 2 ** len(cell)
    made["packing_fraction"] = ball * (sigma ** len(cell)).sum() / abs(np.linalg.det(cell))
    made["diameter_mean"] = sigma.mean()
    if "jam/report" in arrays:
        report = arrays["jam/report"]
        for key in set(_REPORT_FIELDS) & set(report.dtype.names or ()):
            made[key] = report[key]
    score = arrays.get("jam/analysis/crystal_score")
    made["crystal_score"] = np.nan if score is None or score.dtype.kind != "f" else score[()]
    return made


def builds_of(rows: Array) -> tuple[str, ...]:
    """The builds of libjam that made the packings of a table: version, commit, digest of the library."""
    found = np.unique(rows[["version", "commit", "library"]])
    return tuple(
        " ".join(f"{word} {part.decode()}".strip() for word, part in zip(("", "commit", "library"), row) if part)
        for row in found
    )


#: Enum of each field of the table that has one.
ENUMS: dict[str, Any] = {f.name: enum for f in fields(CrunchReport) if (enum := enum_of(str(f.type)))}


def _column(rows: Array, name: str) -> Any:
    """Text as str, and enums as words: None for a number that has none."""
    column = rows[name]
    if column.dtype.kind == "S":
        return column.astype(str)
    if name in ENUMS:
        words = {int(value): value.name.lower() for value in ENUMS[name]}
        return [words.get(int(number)) for number in column]
    return column


def as_table(rows: Array, pandas: bool) -> Any:
    """The rows, or a DataFrame of them."""
    if not pandas:
        return rows
    import pandas as pd

    return pd.DataFrame({name: _column(rows, name) for name in FIELDS})


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
    builds: tuple[str, ...] = field(default=())

    @property
    def missing(self) -> int:
        """Neither made, failed nor damaged."""
        return max(0, self.asked - self.done - self.failed - len(self.damaged))

    def __str__(self) -> str:
        text = (
            f"{self.done} of {self.asked} packings are there, {self.jammed} jammed; {self.failed} failed, "
            f"{self.missing} to be made"
        )
        if self.made:
            text += f"; {self.made} made now"
        if self.damaged:
            text += f"; {len(self.damaged)} damaged and omitted: " + "; ".join(self.damaged[:3])
        if self.odd:
            text += f"; {len(self.odd)} files are odd: " + "; ".join(self.odd[:3])
        if self.remade:
            text += f"; made again: {', '.join(self.remade)}"
        if len(self.builds) > 1:
            text += f"; made by {len(self.builds)} builds: " + ", ".join(self.builds)
        return text


# ---- index.bin
_KEY = 32  # bytes of a digest
_LARGEST = 1 << 30  # bytes; 1e5 packings take 70 MB


def key_of(path: Path, inner: str | None) -> bytes:
    """What the index calls a packing, of a file as it is now."""
    stat = path.stat()
    text = f"{path.parent.name}/{path.name}:{inner or ''} {stat.st_size} {stat.st_mtime_ns}"
    return hashlib.sha256(text.encode(errors="surrogateescape")).digest()


def _checksum(rows: bytes) -> bytes:
    """Changes with the rows, with their layout, and with what stands for unknown in them."""
    absent = [unknown(str(f.type)) for f in fields(CrunchReport)]
    return hashlib.sha256(f"{ROW.descr} {absent}".encode() + rows).digest()


def read_index(path: Path) -> dict[bytes, bytes]:
    """Rows by key; none where it is not the index that was written."""
    try:
        with open_regular(path) as file:
            data = file.read() if os.fstat(file.fileno()).st_size <= _LARGEST else b""
    except OSError:
        return {}
    if data[:_KEY] != _checksum(data[_KEY:]):
        return {}
    size = _KEY + ROW.itemsize
    return {data[k : k + _KEY]: data[k + _KEY : k + size] for k in range(_KEY, len(data), size)}


def write_index(path: Path, rows: Mapping[bytes, bytes]) -> None:
    """Nothing is lost where that cannot be."""
    data = b"".join(key + row for key, row in rows.items())
    with contextlib.suppress(OSError):
        if path.is_symlink():  # somebody's: what it leads to is not replaced
            path.unlink()
        write_file(path, _checksum(data) + data)
