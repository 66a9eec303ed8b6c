"""Curves: the way to jamming, distributions, densities of states."""
from __future__ import annotations

import math
from typing import Any, Iterable, Sequence

import numpy as np

from .._api.results import Modes
from .._api.tuples import DensityOfStatesResult
from ..errors import StateError
from ..system import System
from .axes import axes_of


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

    What observing() recorded comes first: its samples are taken at fixed numbers of collisions, so the same seed gives the same
    points. Without it the points are progress records, which come by the clock.
    """
    phi, pressure = _samples(system)
    ax = axes_of(ax)
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
    ax = axes_of(ax)
    for values, label in ((gains, r"gain $\sqrt{\Gamma}-1$"), (steps, r"largest step $|s_i|/\langle\sigma\rangle$")):
        pairs = [(k, v) for k, v in zip(at, values) if v > 0]
        if pairs:
            ax.semilogy(*zip(*pairs), label=label, **{"marker": ".", "ms": 5, "lw": 1, **style})
    ax.set(xlabel="factorisations")
    if ax.lines:
        ax.legend(frameon=False)
    return ax


def minima(system: System, ax: Any = None, **style: Any) -> Any:
    """Pressure of the minima of a decompression against their distance alpha U / sum f r from jamming (soft_history)."""
    rows = system.soft_history
    above = rows[(rows["distance"] > 0) & (rows["pressure"] > 0)]
    ax = axes_of(ax)
    ax.loglog(above["distance"], above["pressure"], **{"marker": ".", "ms": 5, "lw": 1, **style})
    ax.set(xlabel=r"distance from jamming $\alpha U/\sum f r$", ylabel="pressure")
    return ax


def stress_strain(system: System, ax: Any = None, **style: Any) -> Any:
    """Stress of a shear against strain (shear_rows); circles mark plastic events."""
    rows = system.shear_rows
    ax = axes_of(ax)
    (line,) = ax.plot(rows["strain"], rows["stress"], **{"lw": 1.2, **style})
    events = rows[rows["event"] == 1]
    ax.plot(events["strain"], events["stress"], "o", mfc="none", ms=4, color=line.get_color())
    ax.set(xlabel=r"strain $\gamma$", ylabel=r"stress $\partial U/\partial\gamma\,/\,V$")
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
    ax = axes_of(ax)
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


def density_of_states(states: Any, ax: Any = None, *, bins: int | None = None, **style: Any) -> Any:
    """D(omega): of a Modes (best of which='all') or of frequencies as a histogram, of System.density_of_states() as its curve."""
    ax = axes_of(ax)
    if isinstance(states, DensityOfStatesResult):
        ax.plot(states.omega, states.density, **{"lw": 1.4, **style})
    else:
        omega = np.asarray(states.frequencies if isinstance(states, Modes) else states, float)
        if omega.ndim != 1:
            raise ValueError(f"frequencies must be one array of numbers, not of shape {omega.shape}")
        omega = omega[np.isfinite(omega)]
        count, edges = np.histogram(omega[omega > 1e-7], bins=bins or max(10, int(2 * len(omega) ** (1 / 3))))
        ax.stairs(count / (len(omega) * np.diff(edges)), edges, **{"lw": 1.4, "fill": False, **style})
    ax.set(xlabel=r"frequency $\omega$", ylabel=r"$D(\omega)$", xlim=(0, None))
    return ax
