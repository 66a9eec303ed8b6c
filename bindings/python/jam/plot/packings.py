"""Spheres and contact networks, in a parallel projection."""
from __future__ import annotations

import math
from typing import Any

import numpy as np

from .._api.arrays import Array, as_vector
from .._api.generated import Container
from .._api.given import closed_axes
from ..errors import StateError
from ..files import half_bonds
from ..system import System
from .axes import axes_of

COLOURS = {"sphere": "#4c78a8", "buckler": "#f2a541", "rattler": "#c8c8c8", "force": "#b2182b", "line": "#333333"}
VIEW = (25.0, 20.0)  # degrees: turn about the vertical axis, then tilt


def _by_value(values: Any, n: int, colour_map: str) -> tuple[Array, Any]:
    """Colours of n values, and what a colour bar shows. Values that are not finite are grey."""
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize, to_rgb

    x = as_vector(values, name="values")
    if len(x) != n:
        raise ValueError(f"values must have shape ({n},), a number for each sphere, not {np.shape(values)}")
    finite = np.isfinite(x)
    if not finite.any():
        raise ValueError("none of the values is a number")
    scale = ScalarMappable(Normalize(float(x[finite].min()), float(x[finite].max())), colormaps[colour_map])
    colours: Array = scale.to_rgba(np.where(finite, x, x[finite][0]))[:, :3]
    colours[~finite] = to_rgb(COLOURS["rattler"])
    return colours, scale


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


def _balls(ax: Any, centres: Array, diameters: Array, colours: Array) -> None:
    """Spheres from far to near, each with its highlight: one collection, which is drawn in its order."""

    def in_turn(sphere: Array, highlight: Array) -> Array:
        pairs: Array = np.stack([sphere, highlight], axis=1)
        return pairs.reshape(-1, *sphere.shape[1:])

    opaque = np.ones((len(centres), 1))
    edges = np.hstack([0.55 * colours, opaque])
    _circles(
        ax,
        in_turn(centres, centres + diameters[:, None] * np.array([-0.14, 0.16])),
        in_turn(diameters, 0.3 * diameters),
        in_turn(colours, 1 - 0.55 * (1 - colours)),
        edgecolors=in_turn(edges, 0 * edges),
        linewidths=np.tile([0.35, 0.0], len(centres)),
        zorder=2,
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


# Of a container about z the width at its end, over that at its beginning.
_TAPER = {Container.CYLINDER: 1.0, Container.CONE: 0.5}


def _round(ax: Any, edges: Array, view: tuple[float, float], kind: Container) -> None:
    """The curved wall: the silhouette of a ball, or both rings of another container and two sides."""
    line: dict[str, Any] = dict(color=COLOURS["line"], lw=0.8, zorder=5)
    t = np.linspace(0, 2 * np.pi, 361)
    ring = 0.5 * edges[0] * np.array([np.cos(t), np.sin(t), np.zeros_like(t)]).T
    if kind == Container.BALL:
        ax.plot(*ring[:, :2].T, **line)
        return
    ends = [_project(width * ring + edges * (0.5, 0.5, z), edges, view)[0] for z, width in ((0, 1.0), (1, _TAPER[kind]))]
    for end in ends:
        ax.plot(*end.T, **line)
    for side in (np.argmin, np.argmax):
        at = side(ends[0][:, 0])
        ax.plot([e[at, 0] for e in ends], [e[at, 1] for e in ends], **line)


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
    return system.dim


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
    system: System,
    ax: Any = None,
    *,
    forces: bool = False,
    values: Any = None,
    label: str | None = None,
    colour_map: str = "viridis",
    view: tuple[float, float] = VIEW,
    legend: bool = True,
) -> Any:
    """The spheres, bucklers (d + 1 contacts) and rattlers coloured; with forces=True (d = 2) the network over them.

    Parameters
    ----------
    system : System
        In d = 2 or 3.
    ax : matplotlib axes, optional
        Where to draw; default: those of a new figure.
    forces : bool
        Draw the contacts as lines, width by force (d = 2).
    values : array_like, shape (n,), optional
        Colours the spheres by a number of each instead, with a colour bar; nan is grey.
    label : str, optional
        Of the colour bar.
    colour_map : str
        Of matplotlib.
    view : (float, float)
        Degrees (d = 3): turn about the vertical axis, then tilt.
    legend : bool
        Legend or colour bar.
    """
    dim, ax, cell = _drawable(system), axes_of(ax, True), system.cell
    edges, box = np.diag(cell), system.box
    colours, scale = (_colours(system), None) if values is None else _by_value(values, system.n, colour_map)
    x, s = system.positions, system.diameters
    if dim == 2:
        closed = np.array(closed_axes(system.info))
        for shift in _IMAGES:
            if (np.asarray(shift)[closed] != 0).any():
                continue  # nothing repeats across a wall
            y = x + shift @ cell
            seen = ((y > -0.5 * s[:, None]) & (y < edges + 0.5 * s[:, None])).all(1)
            _circles(ax, y[seen], s[seen], colours[seen], edgecolors="white", linewidths=0.4)
        if system.info.container == Container.BALL:
            _circles(ax, edges[None] / 2, edges[:1], "none", edgecolors=COLOURS["line"], linewidths=0.8)
        if forces:
            network(system, ax, legend=False, colour="black", width=0.06 * 380 * float(s.mean()) / box)
    else:
        flat, depth = _project(x, edges, view)
        order = np.argsort(depth)
        tone = 0.62 + 0.38 * (depth[order, None] + 1) / 2
        shaded = 1 - (1 - colours[order]) * tone
        kind = system.info.container
        if kind == Container.BRICK:
            _brick(ax, edges, view, False)
        _balls(ax, flat[order], s[order], shaded)
        if kind == Container.BRICK:
            _brick(ax, edges, view, True)
        else:
            _round(ax, edges, view, kind)
    _frame(ax, edges)
    if legend and scale is not None:
        ax.figure.colorbar(scale, ax=ax, shrink=0.75, label=label or "")
    elif legend:
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
    """The force network: each contact a line whose width grows with its force. width: points at the mean force, and of
    each line where contacts_by_distance leaves the forces unknown.
    """
    from matplotlib.collections import LineCollection

    dim, ax, cell = _drawable(system), axes_of(ax, True), system.cell
    edges, box = np.diag(cell), system.box
    ends, index = half_bonds(system)
    known = bool(np.isnan(system.info.contact_gap))
    force = system.forces[index] if known else np.ones(len(index))
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
        told = "width by force" if known else f"gaps below {system.info.contact_gap:g}"
        ax.set_title(f"{len(system.contacts)} contacts, {told}", fontsize=10)
    return ax
