"""Displacements of the spheres as arrows over the packing: modes, flexes, floppy modes, steps."""
from __future__ import annotations

from typing import Any

import numpy as np

from .._api.arrays import as_array
from .._api.results import Modes
from ..system import System
from .axes import axes_of
from .packings import COLOURS, VIEW, _drawable, _project, packing


def displacements(
    system: System,
    vectors: Any,
    ax: Any = None,
    *,
    spheres: Any = None,
    longest: float = 0.8,
    view: tuple[float, float] = VIEW,
    **style: Any,
) -> Any:
    """The packing, pale, with an arrow at each sphere that moves.

    Parameters
    ----------
    system : System
        In d = 2 or 3.
    vectors : array_like, shape (m, d)
        Displacements; only their ratios show.
    spheres : array_like, shape (m,), optional
        Which spheres they belong to; default: all.
    longest : float
        Length of the longest arrow in mean diameters.
    **style
        For matplotlib's quiver.

    Examples
    --------
    >>> import jam
    >>> loose = jam.System.random(n=20, dim=2, seed=1)
    >>> ax = jam.plot.displacements(loose, loose.flex("collective").out)
    """
    dim, ax, x = _drawable(system), axes_of(ax, True), system.positions
    u = as_array(vectors, name="vectors")
    index = np.arange(system.n) if spheres is None else np.asarray(spheres)
    if u.shape != (len(index), dim):
        raise ValueError(f"vectors must have shape ({len(index)}, {dim}), not {u.shape}")
    u = np.where(np.isfinite(u), u, 0.0)
    length = float(np.linalg.norm(u, axis=1).max(initial=0.0))
    if length > 0:
        u = u * (longest * float(system.diameters.mean()) / length)
    packing(system, ax, view=view, legend=False)
    for circles in ax.collections:  # pale, so that arrows stand out
        circles.set_alpha(0.35)
    tails, heads = x[index], x[index] + u
    if dim == 3:
        edges = np.diag(system.cell)
        tails, heads = _project(tails, edges, view)[0], _project(heads, edges, view)[0]
    arrow = heads - tails
    settings = {"color": COLOURS["force"], "width": 0.004, "zorder": 6, **style}
    ax.quiver(tails[:, 0], tails[:, 1], arrow[:, 0], arrow[:, 1], angles="xy", scale_units="xy", scale=1.0, **settings)
    return ax


def mode(system: System, modes: Modes, k: int = 0, ax: Any = None, **style: Any) -> Any:
    """Mode k of system.modes(): an arrow for each stable sphere, with frequency and inverse participation ratio as title.

    Examples
    --------
    >>> import jam
    >>> disks = jam.System.random(n=64, dim=2, seed=1, diameters=[1.0] * 32 + [1.4] * 32)
    >>> report = disks.crunch()
    >>> ax = jam.plot.mode(disks, disks.modes(4), 0)
    """
    ax = displacements(system, modes.vectors[k], ax, spheres=modes.spheres, **style)
    title = f"mode {k}: omega {modes.frequencies[k]:.4g}, inverse participation ratio {modes.participation[k]:.3g}"
    ax.set_title(title, fontsize=10)
    return ax
