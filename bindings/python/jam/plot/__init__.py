"""Pictures with matplotlib. Every function takes `ax` (None makes a figure), returns the axes and keeps no state.

    jam.plot.packing(system).figure.savefig("packing.png", dpi=150)

Where pyplot is already imported (a notebook, an interactive session) new figures are pyplot's, so that they show;
otherwise they are free figures that need no display.
"""
from __future__ import annotations

from math import isnan
from typing import Any

import numpy as np

from .._api.shown import only
from ..errors import StateError
from ..system import System
from .curves import cdf, convergence, density_of_states, minima, stress_strain, trace
from .motions import displacements, mode
from .packings import COLOURS, VIEW, network, packing

__all__ = [
    "COLOURS",
    "VIEW",
    "cdf",
    "convergence",
    "density_of_states",
    "displacements",
    "minima",
    "mode",
    "network",
    "packing",
    "stress_strain",
    "summary",
    "trace",
]
__dir__ = only(__all__)


def summary(system: System) -> Any:
    """One figure of a packing with contacts: spheres, network, forces, and how it was reached. Returns the Figure.

    Of soft spheres with overlaps: forces without the slopes of jamming, and minima() or, without a decompression, overlaps.
    Of contacts by distance, which have no forces: gaps and coordination.
    """
    from matplotlib.figure import Figure

    gaps = system.contacts.gaps  # without them, a StateError before anything is drawn
    figure = Figure(figsize=(11, 8.2), layout="constrained")
    axes = figure.subplots(2, 2)
    packing(system, axes[0, 0])
    network(system, axes[0, 1])
    if not isnan(system.info.contact_gap):
        axes[1, 0].hist(gaps, bins=40, color=COLOURS["force"])
        axes[1, 0].set(xlabel="gap / contact distance", ylabel="contacts")
        numbers = np.bincount(system.coordination)
        axes[1, 1].bar(range(len(numbers)), numbers, color=COLOURS["force"])
        axes[1, 1].set(xlabel="contacts of a sphere", ylabel="spheres")
        return figure
    if (gaps < -1e-7).any():  # overlaps of a hard packing are rounding
        cdf(system.forces, axes[1, 0], label="forces")
        try:
            minima(system, axes[1, 1])
        except StateError:  # relaxed, without a decompression
            cdf(-gaps, axes[1, 1], label="overlap / contact distance")
    else:
        _forces_of_jamming(system, axes[1, 0])
        (trace if any(p.phase == 2 for p in system.trace) else convergence)(system, axes[1, 1])
    axes[1, 0].set(xlabel="force / mean force")
    return figure


def _forces_of_jamming(system: System, ax: Any) -> None:
    """Forces at bucklers and the others, with the slopes that theory gives isostatic packings."""
    pairs = system.contacts.pairs
    try:
        crossing = (system.bucklers[pairs] & (pairs >= 0)).any(1)
    except StateError:
        ax.set_axis_off()
        return
    isostatic = system.report.excess_contacts == 0
    for chosen, label, slope, colour in (
        (~crossing, "extended forces", 1.42311, "#4c78a8"),
        (crossing, "forces at bucklers", 1.17462, "#f2a541"),
    ):
        if chosen.sum() > 10:
            cdf(system.forces[chosen], ax, slopes=[slope] if isostatic else (), label=label, color=colour)
