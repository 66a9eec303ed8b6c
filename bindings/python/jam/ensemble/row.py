"""A row of an ensemble's table: what one packing is and how its crunch ended, taken from its file."""
from __future__ import annotations

import hashlib
import math
from dataclasses import fields
from typing import Any

import numpy as np

from .._api.arrays import Array
from .._api.generated import CrunchReport
from .._formats.records import dtype_of, unknown
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


def row_of(file: Any) -> Array:
    """The row of a packing from its open file. Its name follows from protocol, seed and algorithm, not from the file's."""
    made, jam = np.zeros((), ROW), file["jam"]
    attributes = jam.attrs
    for key in ("seed", "protocol", "version", "written"):
        made[key] = attributes[key]
    # 1.0.0 wrote no algorithm, and was the first; older files have no builds
    for key, absent in (("algorithm", "1.0.0"), ("commit", ""), ("library", ""), ("seconds_made", np.nan)):
        made[key] = attributes.get(key, absent)
    algorithm = str(attributes.get("algorithm", "1.0.0"))
    made["name"] = packing_name(attributes["protocol"], attributes["seed"], algorithm)
    made["n"] = len(jam["diameters"])
    made["dim"] = file["particles/spheres/position/value"].shape[2]
    for f in fields(CrunchReport):
        made[f.name] = unknown(str(f.type))
    made["packing_fraction"], made["diameter_mean"] = _of_spheres(file)
    if "report" in jam:
        report = jam["report"]
        for key in set(_REPORT_FIELDS) & set(report.dtype.names):
            made[key] = report[key]
    score = jam.get("analysis/crystal_score")
    made["crystal_score"] = np.nan if score is None or score.dtype.kind != "f" else score[()]
    return made


def _of_spheres(file: Any) -> tuple[float, float]:
    """Packing fraction and mean diameter, which need no crunch."""
    sigma, cell = file["jam/diameters"], file["particles/spheres/box/edges/value"][0]
    d = len(cell)
    ball = math.pi ** (d / 2) / math.gamma(d / 2 + 1) / 2**d
    return ball * float((sigma**d).sum()) / abs(float(np.linalg.det(cell))), float(sigma.mean())


def hash_of_row() -> int:
    """A number that changes with ROW and with what stands for unknown: an index of another layout is made again."""
    absent = [unknown(str(f.type)) for f in fields(CrunchReport)]
    return int.from_bytes(hashlib.sha256(f"{ROW.descr} {absent}".encode()).digest()[:3], "big") + 1


def builds_of(rows: Array) -> tuple[str, ...]:
    """The builds of libjam that made the packings of a table: version, commit, digest of the library."""
    found = np.unique(rows[["version", "commit", "library"]])
    return tuple(
        " ".join(f"{word} {part.decode()}".strip() for word, part in zip(("", "commit", "library"), row) if part)
        for row in found
    )
