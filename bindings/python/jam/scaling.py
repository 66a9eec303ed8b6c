"""Finite-size scaling of tails: exponents of p(x) ~ x^a for x -> 0 from many packings of several sizes, with errors.

Data flow: one array a packing -> a cumulative distribution or a likelihood -> exponents, errors by resampling packings.

Contacts of one packing depend on each other, packings do not: every error here resamples packings, never contacts.
Theory (R. Diaz Hernandez Rojas, PhD thesis, Sapienza 2021, chapter 4): with p(x) ~ x^a in packings of N spheres the
cumulative distribution is c(x) = (1/N) C(x N^(1/(1+a))), C(s) ~ s below 1 and s^(1+a) above: a power law on the left that
ends in a plateau of p, which N sets. Forces have a = theta, gaps a = -gamma.
"""
from __future__ import annotations

from typing import Any, Callable, NamedTuple, Sequence

import numpy as np

from ._api.arrays import Array
from ._api.shown import only
from ._tails import TailExponent, not_positive, tail_exponent, taken

__all__ = [
    "Cdf", "Collapse", "Estimate", "Exponent", "TailExponent", "bootstrap", "cdf_grid", "cdf_pooled", "cdf_ranked", "collapse",
    "crossover", "draw_left_power", "fit_crossover", "fit_power", "local_exponent", "quality", "tail_exponent",
    "tail_scaling",
]
__dir__ = only(__all__)

RESAMPLES = 200  # of a bootstrap: its error is then good to 5 %


class Cdf(NamedTuple):
    """A cumulative distribution: c at x, with the standard errors of either (nan: not given by this estimator)."""

    x: Array
    c: Array
    x_error: Array
    c_error: Array


class Estimate(NamedTuple):
    """A number or an array with its standard error, and the values that the resamples gave."""

    value: Any
    error: Any
    resampled: Array


class Exponent(NamedTuple):
    """Exponent of a density x^a, its standard error over packings, how many values it comes from, and how many values were
    `omitted` because they are 0 or less."""

    value: float
    error: float
    count: int  # type: ignore[assignment]  # hides tuple.count, which numbers do not need
    omitted: int


class Collapse(NamedTuple):
    """Best parameters of a collapse, their errors over packings, and the quality S (about 1 when good)."""

    value: Array
    error: Array
    quality: float


# ---- three estimators of the cumulative distribution
def cdf_pooled(samples: Sequence[Array]) -> Cdf:
    """Pools the values of all packings and ranks them.

    Parameters
    ----------
    samples : sequence of arrays
        The values of each packing.
    """
    x = np.sort(np.concatenate(taken(samples)))
    none = np.full(len(x), np.nan)
    return Cdf(x, np.arange(1, len(x) + 1) / len(x), none, none)


def cdf_ranked(samples: Sequence[Array]) -> Cdf:
    """Ranks the values in each packing and averages the k-th over packings: the error is one of x.

    Packings with fewer values than others end the average early; c of the k-th is k over the mean number.
    """
    ordered = [np.sort(s) for s in taken(samples)]
    least, mean = min(map(len, ordered)), np.mean([len(s) for s in ordered])
    rows = np.array([s[:least] for s in ordered])
    error = rows.std(axis=0, ddof=1) / np.sqrt(len(rows)) if len(rows) > 1 else np.full(least, np.nan)
    return Cdf(rows.mean(axis=0), np.arange(1, least + 1) / mean, error, np.full(least, np.nan))


def _steps(samples: Sequence[Array], grid: Array, least: int) -> Array:
    """The step function of each packing on one grid, (packings, grid)."""
    samples = taken(samples, least)
    for k, sample in enumerate(samples):
        if len(sample) == 0:
            raise ValueError(f"packing {k} has no values, and no distribution of them: leave it out")
    return np.array([np.searchsorted(np.sort(s), grid, side="right") / len(s) for s in samples])


def cdf_grid(samples: Sequence[Array], grid: Array) -> Cdf:
    """Evaluates the step function of each packing, which needs values, on one grid: the error is one of c."""
    rows = _steps(samples, grid, 1)
    error = rows.std(axis=0, ddof=1) / np.sqrt(len(rows)) if len(rows) > 1 else np.full(len(grid), np.nan)
    return Cdf(np.asarray(grid, float), rows.mean(axis=0), np.full(len(grid), np.nan), error)


def local_exponent(x: Array, c: Array, width: float = 0.5) -> Array:
    """Slope of ln c against ln x by least squares in a window of `width` decades around each x; nan with under 3 points."""
    use = (np.asarray(c) > 0) & (np.asarray(x) > 0)
    lx, lc = np.log(np.where(use, x, 1.0)), np.log(np.where(use, c, 1.0))
    made = np.full(len(lx), np.nan)
    for k in np.flatnonzero(use):
        near = use & (abs(lx - lx[k]) <= 0.5 * width * np.log(10.0))
        if near.sum() >= 3:
            made[k] = np.polyfit(lx[near] - lx[k], lc[near], 1)[0]
    return made


# ---- resampling
def bootstrap(
    samples: Sequence[Any], statistic: Callable[[list[Any]], Any], resamples: int = RESAMPLES, seed: int = 0
) -> Estimate:
    """Standard error of a statistic by drawing packings with replacement.

    Parameters
    ----------
    samples : sequence
        One entry a packing, of any kind.
    statistic : callable
        Takes a list of entries; gives a number or an array.
    """
    rng, m = np.random.default_rng(seed), len(samples)
    if m < 2:
        raise ValueError("a bootstrap over packings needs at least 2 of them")
    drawn = np.array([statistic([samples[k] for k in rng.integers(m, size=m)]) for _ in range(resamples)])
    return Estimate(statistic(list(samples)), drawn.std(axis=0, ddof=1) * np.sqrt(m / (m - 1)), drawn)


# ---- likelihood
def _solve(mean: Array, span: float) -> Array:
    """b with <ln(x / low)> = mean for the density b x^(b-1) on [low, high], span = ln(high / low); by bisection."""
    low, high = np.full(np.shape(mean), -200.0 / span), np.full(np.shape(mean), 200.0 / span)
    for _ in range(60):
        b = 0.5 * (low + high)
        t = np.where(abs(b * span) < 1e-6, 1e-6, b * span)
        expected = span * (-1.0 / np.expm1(-t) - 1.0 / t)
        high = np.where(expected > mean, b, high)
        low = np.where(expected > mean, low, b)
    return 0.5 * (low + high)


def fit_power(
    samples: Sequence[Array], high: float, low: float | None = None, resamples: int = RESAMPLES, seed: int = 0
) -> Exponent:
    """Maximum likelihood of p(x) ~ x^a on one range, without corrections to the law.

    The error is that between packings alone, by bootstrap. It does not contain that another range, or a correction, gives
    another exponent, which is often ten times as much: `tail_exponent` averages over both.

    Parameters
    ----------
    high : float
        Values above are omitted: there the law ends.
    low : float, optional
        Values below are omitted too, and the density is normalised on [low, high]. Without it the law is taken to go
        down to 0 (the left-hand form of M. E. J. Newman, Contemp. Phys. 46, 323 (2005)): biased where a plateau sets in.

    Raises
    ------
    ValueError
        Fewer than 2 packings, no values in the range, or low <= 0.
    """
    samples = taken(samples, 2)
    if low is not None and not low > 0.0:
        raise ValueError(f"low is {low}, it must be above 0; without it the law goes down to 0")
    counts, sums = np.empty(len(samples)), np.empty(len(samples))
    for k, sample in enumerate(samples):
        inside = sample[(sample <= high) & (sample >= (low or 0.0)) & (sample > 0.0)]
        counts[k], sums[k] = len(inside), np.log(inside / (low or high)).sum()
    if counts.sum() < 2:
        raise ValueError(f"{int(counts.sum())} values in the range from {low or 0.0:g} to {high:g}")
    m = len(samples)
    weight = np.random.default_rng(seed).multinomial(m, np.full(m, 1.0 / m), size=resamples)
    n = np.concatenate([[counts.sum()], weight @ counts])
    mean = np.concatenate([[sums.sum()], weight @ sums]) / np.maximum(n, 1.0)
    b = -1.0 / mean if low is None else _solve(mean, np.log(high / low))
    b = b[np.isfinite(b)]
    return Exponent(float(b[0] - 1.0), float(b[1:].std(ddof=1) * np.sqrt(m / (m - 1))), int(n[0]), not_positive(samples))


# ---- collapse of several sizes
def quality(curves: Sequence[tuple[float, Cdf]], u: float, v: float) -> float:
    """Quality S of the collapse of c N^v against x N^u (J. Houdayer and A. K. Hartmann, Phys. Rev. B 70, 014418 (2004)).

    Each point is compared with the weighted straight line through those points of the other sizes that bracket it; S is
    the mean square of the difference over its variance: about 1 when good. Logarithms of x and c are used.

    Parameters
    ----------
    curves : sequence of (N, Cdf)
        With c_error, on any grids. Points without c > 0 and an error > 0 are omitted.
    """
    scaled = []
    for n, curve in curves:
        use = (curve.c > 0) & (curve.c_error > 0)
        x, y = np.log(curve.x[use]) + u * np.log(n), np.log(curve.c[use]) + v * np.log(n)
        scaled.append((x, y, curve.c_error[use] / curve.c[use]))
    total, points = 0.0, 0
    for k, (x, y, e) in enumerate(scaled):
        sums = np.zeros((5, len(x)))
        for other, (xo, yo, eo) in enumerate(scaled):
            if other == k or len(xo) < 2:
                continue
            j = np.searchsorted(xo, x)
            inside = (j > 0) & (j < len(xo))
            for at in (np.clip(j - 1, 0, len(xo) - 1), np.clip(j, 0, len(xo) - 1)):
                w, d = inside / eo[at] ** 2, xo[at] - x  # abscissae from the point itself: its value is the intercept
                sums += w * np.array([np.ones_like(d), d, d * d, yo[at], d * yo[at]])
        s, sx, sxx, sy, sxy = sums
        determinant = s * sxx - sx * sx
        use = determinant > 1e-12 * np.maximum(s * sxx, 1e-300)
        value = (sxx[use] * sy[use] - sx[use] * sxy[use]) / determinant[use]
        variance = sxx[use] / determinant[use]
        total += np.sum((y[use] - value) ** 2 / (e[use] ** 2 + variance))
        points += int(use.sum())
    return total / points if points else np.inf


def tail_scaling(parameters: Array) -> tuple[float, float]:
    """Powers (u, v) of N for a tail x^a: x N^(1/(1+a)), N c. One parameter: a."""
    return 1.0 / (1.0 + float(parameters[0])), 1.0


def collapse(
    samples: dict[int, Sequence[Array]],
    grid: Array | Callable[[int], Array],
    start: Sequence[float],
    scaling: Callable[[Array], tuple[float, float]] = tail_scaling,
    resamples: int = 40,
    seed: int = 0,
) -> Collapse:
    """Finds the exponents that collapse the cumulative distributions of several sizes best, with errors over packings.

    Parameters
    ----------
    samples : dict
        N -> one array a packing.
    grid : array, or callable of N
        Where the distributions are evaluated.
    start : sequence of float
        First guess of the parameters.
    scaling : callable
        Parameters -> powers (u, v) of N that x and c are multiplied by; default tail_scaling.
    resamples : int
        Packings of each size are drawn again so often.
    """
    from scipy.optimize import minimize

    grids = {n: np.asarray(grid(n) if callable(grid) else grid, float) for n in samples}
    rows = {n: _steps(samples[n], grids[n], 2) for n in samples}
    errors = {n: r.std(axis=0, ddof=1) / np.sqrt(len(r)) for n, r in rows.items()}

    def best(picked: dict[int, Array], first: Sequence[float] | Array) -> tuple[Array, float]:
        nan = {n: np.full(len(g), np.nan) for n, g in grids.items()}
        curves = [(n, Cdf(grids[n], picked[n].mean(axis=0), nan[n], errors[n])) for n in picked]
        found = minimize(lambda p: quality(curves, *scaling(p)), first, method="Nelder-Mead", options={"xatol": 1e-4})
        return found.x, float(found.fun)

    value, s = best(rows, start)
    rng = np.random.default_rng(seed)
    drawn = []
    for _ in range(resamples):
        picked = {n: r[rng.integers(len(r), size=len(r))] for n, r in rows.items()}
        drawn.append(best(picked, value)[0])
    least = min(map(len, rows.values()))
    error = (
        np.std(drawn, axis=0, ddof=1) * np.sqrt(least / (least - 1)) if resamples > 1 else np.full(len(value), np.nan)
    )
    return Collapse(value, error, s)


# ---- the form between plateau and power law
def crossover(x: Array, a: float, b: float, q: float, exponent: float) -> Array:
    """F(x) = [(a x)^q + (b x^(1+exponent))^q]^(1/q): linear for small x, a power law for large (thesis, section 4.4)."""
    x = np.asarray(x, float)
    return np.exp(np.logaddexp(q * np.log(a * x), q * (np.log(b) + (1.0 + exponent) * np.log(x))) / q)


def fit_crossover(
    x: Array, c: Array, error: Array, exponent: float, start: Sequence[float] = (0.2, 0.2, -1.2)
) -> tuple[Array, float]:
    """Least squares of ln c = ln F: (a, b, q), and the mean square residual in units of the errors.

    ln a and ln b are kept within 8 of 0, q in -10 ... -0.1: data without a bend do not determine them. Points without c > 0
    and an error > 0, where no packing or every packing has a value, have no logarithm or weight and are omitted.
    """
    from scipy.optimize import least_squares

    use = (c > 0) & (error > 0)
    if use.sum() < 3:
        raise ValueError(f"{int(use.sum())} points with c > 0 and an error > 0: three parameters need as many")
    lc, weight = np.log(c[use]), c[use] / error[use]

    def residual(p: Array) -> Array:
        return weight * (np.log(crossover(x[use], np.exp(p[0]), np.exp(p[1]), p[2], exponent)) - lc)

    found = least_squares(
        residual, [np.log(start[0]), np.log(start[1]), start[2]], bounds=([-8, -8, -10], [8, 8, -0.1])
    )
    return np.array([np.exp(found.x[0]), np.exp(found.x[1]), found.x[2]]), float(np.mean(found.fun**2))


def draw_left_power(rng: np.random.Generator, count: int, exponent: float, plateau: float) -> Array:
    """Synthetic values in (0, 1): density x^exponent, constant below `plateau`; for tests of the methods above."""
    b = 1.0 + exponent
    below = plateau**b  # mass below the plateau's end, then of the power law, both over the same constant
    u = rng.random(count) * (below + (1.0 - plateau**b) / b)
    return np.where(u < below, u / plateau**exponent, np.maximum(plateau**b + b * (u - below), 0.0) ** (1.0 / b))
