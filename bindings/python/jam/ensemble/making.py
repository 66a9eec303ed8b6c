"""Makes one packing by a complete protocol."""
from __future__ import annotations

import math
from typing import Any, Mapping

import numpy as np

from .. import errors
from .._api.arrays import Array
from .._api.generated import StatusCode
from .._api.size_laws import sizes as draw_sizes
from ..system import System

#: What a protocol may say of the cell and its walls, and what it says by default.
SCENE = {"cell": None, "walls": None, "container": "brick"}


def sizes_of_law(law: Any, n: int, dim: int, seed: int) -> Array | None:
    """Ratios of the diameters."""
    if law is None or isinstance(law, list):
        return None if law is None else np.array(law)
    if law["law"] == "bidisperse":
        if not all(isinstance(law[k], float) for k in ("ratio", "share")) or not (law["ratio"] > 0 and 0 < law["share"] < 1):
            raise ValueError("bidisperse takes a ratio > 0 and a share in (0, 1)")
        return np.where(np.arange(n) < round(law["share"] * n), 1.0, law["ratio"])
    fields: dict[str, Any] = {"draw": "random", "seed": seed, **{k: v for k, v in law.items() if k != "law"}}
    return draw_sizes(str(law["law"]), n, dim=dim, **fields)


def _fcc(n: int, box: float) -> Array:
    m = round((n / 4) ** (1 / 3))
    corners = np.stack(np.meshgrid(*[np.arange(m)] * 3, indexing="ij"), axis=-1).reshape(-1, 1, 3)
    basis = np.array([[0, 0, 0], [0, 1, 1], [1, 0, 1], [1, 1, 0]]) / 2.0
    return ((corners + basis + 0.25) * (box / m)).reshape(-1, 3)


def begin(protocol: Mapping[str, Any], seed: int) -> System:
    """The start of a complete protocol. On a lattice the diameters shrink by one factor until no pair overlaps."""
    given = dict(protocol["start"])
    lattice, law = given.pop("lattice"), given.pop("diameters")
    scene = {k: given.pop(k, None) for k in SCENE}
    sizes = sizes_of_law(law, given["n"], given["dim"], seed)
    if lattice is None:
        if scene["cell"] is not None:
            del given["box"]
        return System.random(seed=seed, diameters=sizes, **given, **scene)
    overlap = "allow" if given.pop("overlap", "refuse") == "allow" else "shrink"
    n, box, dim, phi = given.pop("n"), given.pop("box"), given.pop("dim"), given.pop("packing_fraction")
    sizes = np.ones(n) if sizes is None else sizes
    if isinstance(law, dict) and (law["law"] == "bidisperse" or law.get("draw") == "quantiles"):
        # on other sites for each seed: sizes that ascend would part small from large
        keys = draw_sizes("uniform", n, low=1.0, high=2.0, draw="random", seed=seed)
        sizes = sizes[np.argsort(keys, kind="stable")]
    unit = math.pi ** (dim / 2) / math.gamma(dim / 2 + 1) * (sizes / 2) ** dim
    sizes = sizes * (phi * box**dim / unit.sum()) ** (1 / dim)
    return System.from_arrays(_fcc(n, box), sizes, box, seed=seed, overlap=overlap, **given)


def make(protocol: Mapping[str, Any], seed: int) -> tuple[System, dict[str, Any]]:
    """Makes one packing, also when it is not jammed, as its report says; and results of the analysis by name.

    A call that this packing cannot answer, such as one that needs a jammed network, gives its error's text.
    """
    system = begin(protocol, seed)
    for stage in protocol["stages"]:
        given = dict(stage)
        report = getattr(system, given.pop("verb"))(**given)
        if getattr(report, "status", StatusCode.OK) in (StatusCode.CANCELLED, StatusCode.LIMIT):
            break  # as System.compress: a stage that stopped early ends the sequence
    if protocol["crunch"] is not None:
        system.crunch(**protocol["crunch"])
    results = {}
    for name, given in protocol["analysis"].items():
        try:
            results[name] = getattr(system, name)(**given)
        except (errors.StateError, errors.UnsupportedError) as error:
            results[name] = f"not available: {error}"
    return system, results
