"""Rank statistics, resampling, collapse of curves, yield: what studies near jamming and of shear need beyond scipy."""
from __future__ import annotations

from typing import Any, Callable, Iterable, NamedTuple, Sequence

import numpy as np

from ._api.arrays import Array
from ._api.shown import only

__all__ = [
    "Estimate", "YieldPoint", "bootstrap", "collapse", "collapse_estimate", "deciles", "roc_area", "spearman",
    "spearman_components", "velocity_spectrum", "yield_point",
]
__dir__ = only(__all__)


class Estimate(NamedTuple):
    """A value and its standard error."""

    value: float
    error: float


def spearman(x: Any, y: Any) -> float:
    """Spearman's rank coefficient K[x, y]; ties get average ranks. NaN when one of them is constant."""
    from scipy.stats import rankdata

    x, y = np.ravel(x), np.ravel(y)
    if x.shape != y.shape:
        raise ValueError(f"x has {x.size} values, y has {y.size}")
    if x.size < 3:
        raise ValueError(f"a rank coefficient needs at least 3 values, not {x.size}")
    a, b = rankdata(x) - 0.5 * (x.size + 1), rankdata(y) - 0.5 * (y.size + 1)
    norm = np.sqrt((a @ a) * (b @ b))
    return float(a @ b / norm) if norm > 0 else float("nan")


def spearman_components(x: Any, y: Any) -> tuple[float, float]:
    """K of two vector fields (n, d): mean over the d components, and all n d values pooled."""
    x, y = np.asarray(x), np.asarray(y)
    return float(np.mean([spearman(x[:, c], y[:, c]) for c in range(x.shape[1])])), spearman(x, y)


def roc_area(score: Any, positive: Any) -> float:
    """Area under the ROC curve: how often a positive case has the higher score than a negative one; ties count half."""
    from scipy.stats import rankdata

    score, positive = np.ravel(score), np.ravel(positive).astype(bool)
    count, others = int(positive.sum()), int((~positive).sum())
    if count == 0 or others == 0:
        return float("nan")
    ranks = rankdata(score)
    return float((ranks[positive].sum() - 0.5 * count * (count + 1)) / (count * others))


def deciles(predictor: Any, observed: Any, share: float = 0.1) -> tuple[float, float]:
    """Mean of `observed` over the spheres with the largest and with the smallest `share` of the predictor."""
    predictor, observed = np.ravel(predictor), np.ravel(observed)
    if not 0.0 < share <= 0.5:
        raise ValueError(f"share is {share}, it must be in (0, 0.5]")
    order, count = np.argsort(predictor, kind="stable"), max(1, int(round(share * predictor.size)))
    return float(observed[order[-count:]].mean()), float(observed[order[:count]].mean())


def bootstrap(f: Callable[[Array], Any], blocks: int, times: int = 200, seed: int = 1) -> Array:
    """f(weights) for `times` resamples of `blocks` blocks with replacement; weights (blocks,) count how often each is drawn."""
    if blocks < 2:
        raise ValueError(f"{blocks} blocks of runs cannot be resampled: make more runs, or give a smaller block= to isoconf()")
    draw = np.random.default_rng(seed)
    return np.array([f(np.bincount(draw.integers(0, blocks, blocks), minlength=blocks)) for _ in range(times)])


def collapse(
    x: Sequence[Any], y: Sequence[Any], control: Any, levels: int = 40, between: tuple[float, float] | None = None
) -> float:
    """Exponent nu for which the falling curves y_k against x_k / control_k^nu lie closest together.

    At each of `levels` values of y, log x is read off every curve that reaches it; nu is the slope of least squares of log x
    against log control, one for all levels. So curves that do not overlap cannot look collapsed. x: positive, ascending.
    between: the lowest and the highest value of y to use; where curves do not collapse, nu depends on it.
    NaN when no two curves share a value of y.
    """
    logs = np.log(np.asarray(control, float))
    if len(x) < 2 or len(x) != len(y) or len(x) != logs.size:
        raise ValueError(f"{len(x)} and {len(y)} curves and {logs.size} values of the control")
    falling = [np.minimum.accumulate(np.asarray(k, float)) for k in y]
    lowest, highest = between or (min(k[-1] for k in falling), max(k[0] for k in falling))
    grid = np.linspace(lowest, highest, levels + 2)[1:-1]
    read = np.array(
        [np.interp(-grid, -k, np.log(np.asarray(a, float)), left=np.nan, right=np.nan) for a, k in zip(x, falling)]
    )
    there = np.isfinite(read)
    shared = there.sum(0) >= 2
    if not shared.any():
        return float("nan")
    read, there = read[:, shared], there[:, shared]
    control_logs = np.where(there, logs[:, None], np.nan)
    from_mean = control_logs - np.nanmean(control_logs, axis=0)
    return float(np.nansum(from_mean * (read - np.nanmean(read, axis=0))) / np.nansum(from_mean**2))


def collapse_estimate(
    curves: Callable[[Array], tuple[Any, ...]], blocks: int, control: Any, times: int = 40, **options: Any
) -> Estimate:
    """collapse() of curves(weights) -> (x, y), with the standard error from resampled blocks of runs."""

    def fit(weights: Array) -> float:
        x, y = curves(weights)
        return collapse(x, y, control, **options)

    value = fit(np.ones(blocks))
    return Estimate(value, float(np.std(bootstrap(fit, blocks, times), ddof=1)))


def velocity_spectrum(time: Any, correlation: Any, omega: Iterable[float]) -> Array:
    """Density of states from a velocity autocorrelation on a uniform grid of times: (2/pi) int C(t) cos(omega t) dt.

    A Hann window falls to zero at the last time; features narrower than about pi / time[-1] are smoothed.
    """
    t, c = np.asarray(time, float), np.asarray(correlation, float)
    if t.ndim != 1 or t.shape != c.shape or t.size < 4:
        raise ValueError("time and correlation must have the same length, at least 4")
    step = np.diff(t)
    if np.ptp(step) > 1e-6 * step.mean():
        raise ValueError("times must be equally spaced")
    weighted = c * 0.5 * (1.0 + np.cos(np.pi * t / t[-1]))
    products = (weighted * np.cos(w * t) for w in omega)
    return np.array([(step * (y[1:] + y[:-1])).sum() / np.pi for y in products])


class YieldPoint(NamedTuple):
    """Stress of the flow, and the strain where the stress first reaches it."""

    stress: Estimate
    strain: Estimate


def yield_point(rows: Any, beyond: float) -> YieldPoint:
    """Where a packing yields, from the rows of a shear in one direction, by this rule.

    The yield stress is the mean of the stress over the strains beyond `beyond`, from where on the packing flows. Stresses there
    are correlated: its error is the largest of those from 8, 16, 32 and 64 blocks of equal strain, and holds where an eighth of
    these strains is longer than the correlation. The yield strain is the first one where the stress reaches the yield
    stress. Its error is half the way between those where it reaches that stress minus and plus its error, at least a step.

    Parameters
    ----------
    rows : System.shear_rows
        Or anything whose fields strain and stress are arrays.
    """
    strain, stress = np.asarray(rows["strain"], float), np.asarray(rows["stress"], float)
    if not strain.size:
        raise ValueError("there are no rows: call shear first")
    way = 1.0 if strain[-1] >= strain[0] else -1.0
    x, y = way * strain, way * stress
    if (np.diff(x) < 0.0).any():
        raise ValueError("the strain turns: give the rows of one direction")
    if not np.isfinite(y).all():
        raise ValueError("some stresses are not finite, as those of a minimum without contacts")
    begin, end = way * beyond, x[-1]
    if not x[0] <= begin < end:
        raise ValueError(f"beyond is {beyond}: the strain goes from {strain[0]:g} to {strain[-1]:g}")
    if (x >= begin).sum() < 64:
        raise ValueError(f"beyond is {beyond}: {int((x >= begin).sum())} rows lie beyond it, and at least 64 must")
    integral = np.concatenate([[0.0], np.cumsum(np.diff(x) * (y[1:] + y[:-1]) / 2)])
    error = 0.0
    for blocks in (8, 16, 32, 64):
        edges = np.linspace(begin, end, blocks + 1)
        means = np.diff(np.interp(edges, x, integral)) / np.diff(edges)
        error = max(error, float(means.std(ddof=1)) / blocks**0.5)
    mean = float(means.mean())

    def first(level: float) -> float:
        k = int(np.argmax(y >= min(level, y.max())))
        part = (min(level, y.max()) - y[k - 1]) / (y[k] - y[k - 1]) if k > 0 else 0.0
        return float(x[k] - (1.0 - part) * (x[k] - x[k - 1])) if k > 0 else float(x[0])

    uncertain = max((first(mean + error) - first(mean - error)) / 2, float(np.diff(x).max()))
    return YieldPoint(Estimate(way * mean, error), Estimate(way * first(mean), uncertain))
