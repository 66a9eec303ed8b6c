"""Pictures with matplotlib. Every function takes `ax` (None makes a figure), returns the axes and keeps no state.

    jam.plot.packing(system).figure.savefig("packing.png", dpi=150)

Where pyplot is already imported (a notebook, an interactive session) new figures are pyplot's, so that they show;
otherwise they are free figures that need no display.
"""
from __future__ import annotations

from typing import Any

from ..errors import StateError
from ..system import System
from .curves import cdf, convergence, density_of_states, trace
from .motions import displacements, mode
from .packings import COLOURS, VIEW, network, packing

__all__ = [
    "COLOURS",
    "VIEW",
    "cdf",
    "convergence",
    "density_of_states",
    "displacements",
    "mode",
    "network",
    "packing",
    "summary",
    "trace",
]


def summary(system: System) -> Any:
    """One figure of a crunched packing: spheres, network, forces, and how it was reached. Returns the Figure."""
    from matplotlib.figure import Figure

    pairs = system.contacts.pairs  # without them, a StateError before anything is drawn
    figure = Figure(figsize=(11, 8.2), layout="constrained")
    axes = figure.subplots(2, 2)
    packing(system, axes[0, 0])
    network(system, axes[0, 1])
    try:
        crossing = (system.bucklers[pairs] & (pairs >= 0)).any(1)
        for chosen, label, slope, colour in (
            (~crossing, "extended forces", 1.42311, "#4c78a8"),
            (crossing, "forces at bucklers", 1.17462, "#f2a541"),
        ):
            if chosen.sum() > 10:
                cdf(system.forces[chosen], axes[1, 0], slopes=[slope], label=label, color=colour)
        axes[1, 0].set(xlabel="force / mean force")
    except StateError:
        axes[1, 0].set_axis_off()
    (trace if any(p.phase == 2 for p in system.trace) else convergence)(system, axes[1, 1])
    return figure
