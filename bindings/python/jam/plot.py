"""Pictures with matplotlib. Every function takes `ax` (None makes a figure), returns the axes and keeps no state.

    jam.plot.packing(system).figure.savefig("packing.png", dpi=150)

Where pyplot is already imported (a notebook, an interactive session) new figures are pyplot's, so that they show;
otherwise they are free figures that need no display.
"""
from __future__ import annotations

import math
import sys
from typing import Any, Iterable, Sequence

import numpy as np

from ._api.arrays import Array
from ._api.errors import StateError
from .files import half_bonds
from .system import Modes, System

COLOURS = {"sphere": "#4c78a8", "buckler": "#f2a541", "rattler": "#c8c8c8", "force": "#b2182b", "line": "#333333"}
VIEW = (25.0, 20.0)  # degrees: turn about the vertical axis, then tilt


def _axes(ax: Any, square: bool = False) -> Any:
    if ax is not None:
        return ax
    size = (5.6, 5.6) if square else (5.6, 4.2)
    pyplot = sys.modules.get("matplotlib.pyplot")
    if pyplot is not None:
        return pyplot.subplots(figsize=size, layout="constrained")[1]
    from matplotlib.figure import Figure

    return Figure(figsize=size, layout="constrained").subplots()


def _colours(system: System) -> Array:
    from matplotlib.colors import to_rgb

    colours = np.tile(to_rgb(COLOURS["sphere"]), (system.n, 1))
    try:
        colours[system.bucklers] = to_rgb(COLOURS["buckler"])
        colours[system.rattlers] = to_rgb(COLOURS["rattler"])
    except StateError:
        pass  # before crunch all are alike
    return colours


_IMAGES = [np.array([i, j]) for i in range(-2, 3) for j in (-1, 0, 1)]  # a_1 may lean half of a_0 either way


def _project(x: Array, edges: Array, view: tuple[float, float]) -> tuple[Array, Array]:
    """Parallel projection of (..., 3): plane coordinates and depth in -1 (far) .. 1 (near)."""
    turn, tilt = np.radians(view)
    a = np.array([[math.cos(turn), math.sin(turn), 0], [-math.sin(turn), math.cos(turn), 0], [0, 0, 1]])
    b = np.array([[1, 0, 0], [0, math.cos(tilt), -math.sin(tilt)], [0, math.sin(tilt), math.cos(tilt)]])
    y = (x - 0.5 * edges) @ (b @ a).T
    return y[..., [0, 2]], -y[..., 1] / (0.5 * float(np.linalg.norm(edges)))


def _circles(ax: Any, centres: Array, diameters: Any, colours: Any, **more: Any) -> None:
    from matplotlib.collections import EllipseCollection

    if not len(centres):
        return  # matplotlib would draw one circle of the size of the axes
    diameters = np.broadcast_to(diameters, len(centres))
    ax.add_collection(
        EllipseCollection(
            diameters,
            diameters,
            np.zeros(len(centres)),
            units="xy",
            offsets=centres,
            offset_transform=ax.transData,
            facecolors=colours,
            **more,
        )
    )


def _brick(ax: Any, edges: Array, view: tuple[float, float], front: bool) -> None:
    corners = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)], float) * edges
    flat, depth = _project(corners, edges, view)
    near = np.argmax(depth)
    for i in range(8):
        for axis in (1, 2, 4):
            j = i ^ axis
            if i < j and (near in (i, j)) == front:
                ax.plot(*flat[[i, j]].T, color=COLOURS["line"], lw=0.8, zorder=5 if front else 0)


def _frame(ax: Any, edges: Array) -> None:
    dim = len(edges)
    ax.set_aspect("equal")
    if dim == 2:
        ax.set(xlim=(0, edges[0]), ylim=(0, edges[1]))
    else:
        half = 0.82 * float(edges.max())
        ax.set(xlim=(-half, half), ylim=(-half, half))
    ax.set(xticks=[], yticks=[])
    if dim == 3:
        ax.set_axis_off()


def _drawable(system: System) -> int:
    if system.dim not in (2, 3):
        raise ValueError(f"only d = 2 and d = 3 can be drawn, this system has d = {system.dim}")
    found: int = system.dim
    return found


def _legend(ax: Any, system: System) -> None:
    from matplotlib.lines import Line2D

    try:
        report = system.report
    except StateError:
        return
    marks = [
        Line2D([], [], ls="", marker="o", ms=8, color=COLOURS[k], label=f"{n} {k}{'' if n == 1 else 's'}")
        for k, n in (
            ("sphere", report.stable - report.bucklers),
            ("buckler", report.bucklers),
            ("rattler", report.rattlers),
        )
        if n
    ]
    ax.legend(handles=marks, loc="upper center", bbox_to_anchor=(0.5, -0.01), ncols=3, frameon=False, fontsize=9)


def packing(
    system: System, ax: Any = None, *, forces: bool = False, view: tuple[float, float] = VIEW, legend: bool = True
) -> Any:
    """The spheres, bucklers (d + 1 contacts) and rattlers coloured; with forces=True (d = 2) the network over them."""
    dim, ax, cell = _drawable(system), _axes(ax, True), system.cell
    edges, box = np.diag(cell), system.box
    x, s, colours = system.positions, system.diameters, _colours(system)
    if dim == 2:
        for shift in _IMAGES:
            y = x + shift @ cell
            seen = ((y > -0.5 * s[:, None]) & (y < edges + 0.5 * s[:, None])).all(1)
            _circles(ax, y[seen], s[seen], colours[seen], edgecolors="white", linewidths=0.4)
        if forces:
            network(system, ax, legend=False, colour="black", width=0.06 * 380 * float(s.mean()) / box)
    else:
        flat, depth = _project(x, edges, view)
        order = np.argsort(depth)
        tone = 0.62 + 0.38 * (depth[order, None] + 1) / 2
        shaded = 1 - (1 - colours[order]) * tone
        _brick(ax, edges, view, False)
        for k, sphere in enumerate(order):  # far to near, each with a highlight
            _circles(
                ax,
                flat[[sphere]],
                s[sphere],
                shaded[[k]],
                edgecolors=[shaded[k] * 0.55],
                linewidths=0.35,
                zorder=2 + k * 1e-6,
            )
            _circles(
                ax,
                flat[[sphere]] + s[sphere] * np.array([-0.14, 0.16]),
                0.3 * s[sphere],
                [1 - (1 - shaded[k]) * 0.55],
                edgecolors="none",
                zorder=2 + (k + 0.5) * 1e-6,
            )
        _brick(ax, edges, view, True)
    _frame(ax, edges)
    if legend:
        _legend(ax, system)
    return ax


def network(
    system: System,
    ax: Any = None,
    *,
    view: tuple[float, float] = VIEW,
    legend: bool = True,
    width: float | None = None,
    colour: str | None = None,
) -> Any:
    """The force network: each contact a line whose width grows with its force. width: points at the mean force."""
    from matplotlib.collections import LineCollection

    dim, ax, cell = _drawable(system), _axes(ax, True), system.cell
    edges, box = np.diag(cell), system.box
    ends, index = half_bonds(system)
    force = system.forces[index]
    if dim == 2:
        width = width or 0.1 * 380 * float(system.diameters.mean()) / box
        for shift in _IMAGES:
            moved = ends + shift @ cell
            seen = ((moved > 0) & (moved < edges)).any(1).all(1)
            ax.add_collection(
                LineCollection(
                    moved[seen],
                    linewidths=width * force[seen],
                    colors=colour or COLOURS["force"],
                    capstyle="round",
                    zorder=3,
                )
            )
    else:
        from matplotlib.colors import to_rgb

        width = width or 0.07 * 240 * float(system.diameters.mean()) / box
        flat, depth = _project(ends, edges, view)
        depth = depth.mean(1)
        order = np.argsort(depth)
        tone = 0.2 + 0.8 * (depth[order, None] + 1) / 2
        _brick(ax, edges, view, False)
        ax.add_collection(
            LineCollection(
                flat[order],
                linewidths=width * force[order],
                capstyle="round",
                zorder=3,
                colors=1 - (1 - np.array(to_rgb(colour or COLOURS["force"]))) * tone,
            )
        )
        _brick(ax, edges, view, True)
    _frame(ax, edges)
    if legend:
        ax.set_title(f"{len(system.contacts)} contacts, width by force", fontsize=10)
    return ax


def _samples(system: System | Iterable[Any]) -> tuple[Any, Any]:
    if isinstance(system, System):
        try:
            series = system.observed_series()
        except StateError:
            series = None
        if series is not None and len(series.pressure):
            good = np.isfinite(series.pressure)
            return series.fraction[good], series.pressure[good]
        system = system.trace
    records = [p for p in system if not math.isnan(p.pressure) and p.collisions > 0]
    return [p.packing_fraction for p in records], [p.pressure for p in records]


def trace(system: System | Iterable[Any], ax: Any = None, **style: Any) -> Any:
    """Reduced pressure against packing fraction, while compress or run move the spheres.

    What observing() recorded comes first: its samples stand at fixed numbers of collisions, so the same seed gives the same
    points. Without it the points are progress records, which come by the clock.
    """
    phi, pressure = _samples(system)
    ax = _axes(ax)
    ax.semilogy(
        phi,
        pressure,
        **{"marker": ".", "ms": 4, "lw": 1, **style},
    )
    ax.set(xlabel=r"packing fraction $\varphi$", ylabel=r"reduced pressure $p$")
    return ax


def convergence(system: System | Iterable[Any], ax: Any = None, **style: Any) -> Any:
    """Crunch: gain sqrt(Gamma) - 1 and largest step against factorisations; from the history of a system's last crunch, or from
    progress records (at most one every 0.05 s)."""
    at: Any
    gains: Any
    steps: Any
    if isinstance(system, System):
        try:
            h = system.history
            at, gains, steps = np.cumsum(h["factorisations"]), h["gain"], h["step_max"]
        except StateError:  # the system came with a pickle, or was not crunched
            return convergence(system.trace, ax, **style)
    else:
        records = [p for p in system if p.phase in (3, 4)]
        at, gains, steps = ([getattr(p, k) for p in records] for k in ("factorisations", "gain", "max_step"))
    ax = _axes(ax)
    for values, label in ((gains, r"gain $\sqrt{\Gamma}-1$"), (steps, r"largest step $|s_i|/\langle\sigma\rangle$")):
        pairs = [(k, v) for k, v in zip(at, values) if v > 0]
        if pairs:
            ax.semilogy(*zip(*pairs), label=label, **{"marker": ".", "ms": 5, "lw": 1, **style})
    ax.set(xlabel="factorisations")
    if ax.lines:
        ax.legend(frameon=False)
    return ax


def cdf(values: Any, ax: Any = None, *, slopes: Sequence[float] = (), label: str | None = None, **style: Any) -> Any:
    """Cumulative distribution of positive values on log axes, with reference lines of the given slopes.

    label: of the curve in the legend, and of the axis where it has none yet.

    Theory: gaps 1 - 0.41269; forces that touch a buckler 1 + 0.17462, all others 1 + 0.42311.
    """
    x = np.sort(np.asarray(values, float).reshape(-1))
    x = x[x > 0]
    if not len(x):
        raise ValueError("no positive values")
    ax = _axes(ax)
    c = np.arange(1, len(x) + 1) / len(x)
    ax.loglog(x, c, label=label, **{"lw": 1.6, **style})
    low, middle = x[0], np.exp(np.mean(np.log(x[[0, len(x) // 2]])))
    anchor = float(np.interp(middle, x, c))
    for k, slope in enumerate(slopes):
        t = np.geomspace(low, x[len(x) // 2], 2)
        ax.loglog(
            t,
            anchor * (t / middle) ** slope,
            ls=("--", ":", "-.")[k % 3],
            color="0.4",
            lw=1,
            label=f"slope {slope:.4g}",
        )
    lowest = 0.5 / len(x) if ax.get_ylabel() == "" else min(0.5 / len(x), ax.get_ylim()[0])
    ax.set(xlabel=ax.get_xlabel() or label or "value", ylabel="share of values up to it", ylim=(lowest, 1.5))
    if slopes or label:
        ax.legend(frameon=False)
    return ax


def density_of_states(modes: Modes | Any, ax: Any = None, *, bins: int | None = None, **style: Any) -> Any:
    """D(omega) as a histogram; modes: a Modes (best of which='all') or frequencies."""
    omega = modes.frequencies if isinstance(modes, Modes) else np.asarray(modes, float)
    omega = omega[np.isfinite(omega)]
    ax = _axes(ax)
    count, edges = np.histogram(omega[omega > 1e-7], bins=bins or max(10, int(2 * len(omega) ** (1 / 3))))
    ax.stairs(count / (len(omega) * np.diff(edges)), edges, **{"lw": 1.4, "fill": False, **style})
    ax.set(xlabel=r"frequency $\omega$", ylabel=r"$D(\omega)$", xlim=(0, None))
    return ax


def summary(system: System) -> Any:
    """One figure of a crunched packing: spheres, network, forces, and how it was reached. Returns the Figure."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11, 8.2), layout="constrained")
    axes = figure.subplots(2, 2)
    packing(system, axes[0, 0])
    network(system, axes[0, 1])
    try:
        crossing = system.bucklers[system.contacts.pairs].any(1)
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
