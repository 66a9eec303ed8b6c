"""A row of an ensemble's table: what one packing is and how its crunch ended, taken from its file."""
from __future__ import annotations

import math
from dataclasses import fields

import numpy as np

from .._api.arrays import Array
from .._api.generated import CrunchReport
from .._formats.content import Packing
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
