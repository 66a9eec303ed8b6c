"""The start of python3 -m jam: random, a file or a checkpoint. It gives the same bits as jam-pack."""
from __future__ import annotations

import argparse
import math
from typing import Any

import numpy as np

from . import errors, raw
from ._api.arrays import Array
from ._api.size_laws import sizes
from .system import System


def take_sizes(text: str) -> tuple[str, str]:
    """The value of --sizes: ('law', its text) or ('file', a name)."""
    try:
        raw.jam_parse_diameters(text, raw.jam_diameters_options(), None)
    except (errors.IoError, errors.FormatError):
        pass  # a file that the law names may be missing: that is no wrong command line
    except errors.JamError as error:
        if text and ":" not in text:
            return "file", text
        said = error if text else "it must be a law or a file of diameters"
        raise argparse.ArgumentTypeError(f"{text!r}: {said}") from None
    return "law", text


def take_cell(text: str) -> list[float]:
    """The value of --cell: d sides or d d components of vectors."""
    try:
        numbers = [float(x) for x in text.split(",")]
    except ValueError:
        numbers = []
    if not numbers or not np.isfinite(numbers).all():
        raise argparse.ArgumentTypeError(
            f"{text!r} must be d sides or d * d components of vectors, parted by commas"
        )
    return numbers


def _read_diameters(path: str) -> Array:
    with open(path, encoding="ascii") as file:
        values = np.array([float(x) for x in file.read().split()])
    if not len(values) or not (np.isfinite(values) & (values > 0)).all():
        raise ValueError(f"{path}: diameters must be finite numbers > 0")
    return values


def density(o: argparse.Namespace) -> float | None:
    """The packing fraction that the command line asks for, or None."""
    found = o.packing_fraction if o.porosity is None else 1 - o.porosity
    return None if found is None else float(found)


def _diameters(o: argparse.Namespace, n: int, named: set[str]) -> Array | None:
    """Ratios of the diameters as --sizes and --diameters-ratio ask; None when all are equal."""
    kind, value = o.sizes or ("ratio", o.diameters_ratio)
    if kind == "file":
        found = _read_diameters(value)
        if o.n is not None and len(found) != o.n:
            raise ValueError(f"{value} holds {len(found)} diameters, --n is {o.n}")
        return found
    if kind == "ratio":
        return None if value == 1 else np.where(np.arange(n) < n // 2, 1.0, value)
    follows = density(o) is not None and o.n is None and bool(named & {"cell", "box"})
    if follows:
        cell = {"box": o.box} if o.cell is None else {"cell": cell_of(o)}
        return sizes(value, dim=o.dim, seed=o.seed, packing_fraction=density(o), **cell)
    return sizes(value, n, dim=o.dim, seed=o.seed)


def cell_of(o: argparse.Namespace) -> Array | None:
    """The cell vectors of --cell, one a row."""
    if o.cell is None:
        return None
    return np.diag(o.cell) if len(o.cell) == o.dim else np.reshape(o.cell, (o.dim, o.dim))


def start(o: argparse.Namespace, named: set[str]) -> System:
    if o.resume:
        return System.from_checkpoint(o.resume)
    model = {
        "model": "mk" if o.model == "mk" or o.zeta is not None or o.plant is not None else "euclid",
        "mk_zeta": o.zeta,
        "non_additivity": o.non_additivity,
    }
    if o.input:
        return System.read(
            o.input,
            seed=o.seed,
            box=None if o.box == 1 else o.box,  # the default is no word about a file that names its own
            frame=o.frame,
            overlap="shrink" if o.shrink else "refuse",
            shrink_min=o.shrink_min,
            **model,
        )
    diameters = _diameters(o, 1024 if o.n is None else o.n, named)
    n = o.n if diameters is None else len(diameters)
    phi0 = o.plant or o.phi0 or 0.0  # 0: the library's own, by dimension
    aim = density(o)
    if not phi0 and aim is not None and aim < math.ldexp(0.2, -max(0, o.dim - 3)):
        phi0 = aim
    where = {"box": o.box} if o.cell is None else {"cell": cell_of(o)}
    return System.random(n, o.dim, o.seed, packing_fraction=phi0, diameters=diameters, **where, **model)
