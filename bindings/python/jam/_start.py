"""The start of python3 -m jam: random, a file or a checkpoint. It gives the same bits as jam-pack."""
from __future__ import annotations

import argparse
import math
from typing import Any

import numpy as np

from ._api.arrays import Array
from .ensemble.protocol import _uniform
from .system import System




def take_diameters(text: str) -> tuple[str, Any]:
    """The value of --diameters: ('lognormal', S), ('bidisperse', R) or ('file', name)."""
    word, colon, number = text.partition(":")
    if not colon or word not in ("lognormal", "bidisperse"):
        return "file", text
    if not 0 < float(number) < math.inf:
        raise argparse.ArgumentTypeError(
            f"{text!r} must be lognormal:S or bidisperse:R with a finite number > 0, or a file"
        )
    return word, float(number)


def _read_diameters(path: str) -> Array:
    with open(path, encoding="ascii") as file:
        values = np.array([float(x) for x in file.read().split()])
    if not len(values) or not (np.isfinite(values) & (values > 0)).all():
        raise ValueError(f"{path}: diameters must be finite numbers > 0")
    return values


def _diameters(o: argparse.Namespace, n: int) -> Array | None:
    """Ratios of the diameters as --diameters asks; None when all are equal."""
    kind, value = o.diameters or ("bidisperse", o.diameters_ratio)
    if kind == "file":
        sizes = _read_diameters(value)
        if o.n is not None and len(sizes) != o.n:
            raise ValueError(f"{value} holds {len(sizes)} diameters, --n is {o.n}")
        return sizes
    if kind == "bidisperse":
        return None if value == 1 else np.where(np.arange(n) < n // 2, 1.0, value)
    width = math.sqrt(math.log1p(value * value))
    return np.array(
        [
            math.exp(
                width
                * math.sqrt(-2 * math.log(_uniform(o.seed, 2 * k)))
                * math.cos(6.283185307179586 * _uniform(o.seed, 2 * k + 1))
            )
            for k in range(n)
        ]
    )


def start(o: argparse.Namespace) -> System:
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
    sizes = _diameters(o, 1024 if o.n is None else o.n)
    n = 1024 if o.n is None and sizes is None else o.n if sizes is None else len(sizes)
    phi0 = o.plant or o.phi0 or 0.0  # 0: the library's own, by dimension
    return System.random(n, o.dim, o.seed, packing_fraction=phi0, diameters=sizes, box=o.box, **model)
