"""Exponent of a density p(x) ~ x^a for x -> 0 whose error contains the choice of range and of corrections to the law.

Data flow: one array a packing -> counts in bins -> fits of all ranges and models -> their weighted average.
The values of all packings are counted in bins, six a decade, from x_low to 1 or to the largest value. Below x_low, where N c(x) = floor, the finite
size of N spheres rules (c: the cumulative distribution). The models p = A x^a and p = A x^a exp(b x^q), q one of `powers`,
are fitted by maximum likelihood of Poisson counts from x_low to each possible upper end, and averaged with the weights
exp(-AIC / 2), AIC = deviance + 2 parameters + 2 bins left out (W. I. Jay and E. T. Neil, Phys. Rev. D 103, 114502 (2021)).
Coverage on known laws: examples/studies/tail_exponents.py.
"""
from __future__ import annotations

from typing import Any, NamedTuple, Sequence

import numpy as np

from ._api.arrays import Array

FORCES = ((0.5, 1.0, 2.0), 3.0)  # powers of corrections, floor
# A constant background beside h^-0.41 is a correction h^0.41, below the reach of 1/2. Gaps feel the finite size more.
GAPS = ((0.25, 0.5, 1.0, 2.0), 10.0)
KINDS = {"forces": FORCES, "gaps": GAPS}
PER_DECADE, LEAST_BINS = 6, 9
STEPS, SMALL = 12, 1e-9  # of reweighted least squares; a diagonal that keeps normal equations regular


class TailExponent(NamedTuple):
    """Exponent a with its standard error, the two parts of which are `statistic` (packings) and `spread` (ranges and models);
    the lower end of the fits, the weighted mean of their upper ends, how many values lie between, and how many values were
    `omitted` because they are 0 or less."""

    value: float
    error: float
    statistic: float
    spread: float
    low: float
    high: float
    count: int  # type: ignore[assignment]  # hides tuple.count
    omitted: int


def taken(samples: Sequence[Any], least: int = 1) -> list[Array]:
    """The values of each packing as one array; refuses too few packings, one number a packing, and values that are not finite."""
    samples = list(samples)
    if len(samples) < least:
        raise ValueError(f"errors over packings need at least {least} of them")
    if any(np.ndim(sample) == 0 for sample in samples):
        raise ValueError("samples has one number for a packing: give an array for each packing, as [a.forces, b.forces]")
    samples = [np.asarray(sample, float).reshape(-1) for sample in samples]
    if not all(np.isfinite(sample).all() for sample in samples):
        raise ValueError("samples has values that are not finite")
    return samples


def not_positive(samples: Sequence[Array]) -> int:
    """How many values a tail x^a, x > 0, cannot have."""
    return int(sum(np.count_nonzero(sample <= 0) for sample in samples))


def tail_exponent(samples: Sequence[Any], n: int, kind: str = "forces", powers: Sequence[float] | None = None) -> TailExponent:
    """Exponent of p(x) ~ x^a for x -> 0, averaged over fit ranges and corrections to the law.

    Parameters
    ----------
    samples : sequence of arrays
        The values of each packing: forces over their mean, or gaps; at least 2 packings. Values of 0 and less,
        of rattlers and of contacts that rounding closed, have no tail and are left out: `omitted` of the result is their number.
    n : int
        Spheres of a packing: below N c(x) = 3 (forces) or 10 (gaps) values are those of a finite system and left out.
    kind : str
        "forces" or "gaps": which corrections are tried, and how far the finite size reaches.
    powers : sequence of float, optional
        Powers q of the corrections exp(b x^q), instead of those of `kind`.

    Raises
    ------
    ValueError
        Fewer than 2 packings, or no range is left between the finite size and x = 1.
    """
    if kind not in KINDS:
        raise ValueError(f"kind is {kind!r}: 'forces' or 'gaps'")
    samples = taken(samples, 2)
    if not 1 <= n < np.inf:
        raise ValueError(f"n is {n}: the number of spheres of a packing")
    if powers is not None and not all(0 < q < np.inf for q in powers):
        raise ValueError(f"powers is {tuple(powers)}: each must be above 0")
    corrections, floor = KINDS[kind]
    edges, counts = bins(samples, n, floor)
    total = counts.sum(axis=0)
    weight, a, variance, last = average(total, edges, corrections if powers is None else powers)
    mean = weight @ a
    # Packings are independent, values of one packing need not be: variance of counts between packings over that of Poisson.
    excess = np.mean(counts.var(axis=0, ddof=1) / np.maximum(counts.mean(axis=0), 1.0 / len(samples)))
    statistic, spread = np.sqrt(max(1.0, excess) * (weight @ variance)), np.sqrt(weight @ (a - mean) ** 2)
    high = np.exp(weight @ np.log(edges[last]))
    count = int(total[edges[1:] <= high * (1 + 1e-6)].sum())
    error = float(np.hypot(statistic, spread))
    return TailExponent(
        float(mean), error, float(statistic), float(spread), float(edges[0]), float(high), count, not_positive(samples)
    )


def bins(samples: Sequence[Any], n: int, floor: float) -> tuple[Array, Array]:
    """Edges from x_low to 1, or to the last edge below the largest value where that is smaller, and the counts of each packing."""
    pool = np.sort(np.concatenate([s[s > 0] for s in samples]))
    if len(pool) < 2:
        raise ValueError(f"{len(pool)} positive values, {not_positive(samples)} of 0 and less")
    low = pool[min(len(pool) - 1, int(floor * len(pool) / n))]
    top = min(0, int(np.floor(np.log10(pool[-1]) * PER_DECADE)))  # gaps are often kept up to a largest one
    edges = 10.0 ** (np.arange(-int(np.ceil(-np.log10(low) * PER_DECADE)), top + 1) / PER_DECADE)
    if len(edges) < LEAST_BINS + 2:  # two upper ends to average over
        end = 10.0 ** (top / PER_DECADE)
        have, need = max(0.0, np.log10(end / low)), (LEAST_BINS + 1) / PER_DECADE
        raise ValueError(
            f"from the end of finite size, {low:.2g}, to {end:.2g} are {have:.1f} decades, and {need:.1f} are needed: larger "
            "packings reach smaller values"
        )
    edges[0] = low
    return edges, np.array([np.histogram(s, edges)[0] for s in samples])


def average(counts: Array, edges: Array, powers: Sequence[float]) -> tuple[Array, Array, Array, Array]:
    """Weights, exponents, their variances and upper bins of all ranges and models."""
    middle, width = np.sqrt(edges[:-1] * edges[1:]), np.diff(edges)
    rows = []
    for columns in ((),) + tuple((q,) for q in powers):
        parameters = 2 + len(columns)
        ends = np.arange(max(LEAST_BINS, parameters + 3), len(counts) + 1)
        used = (np.arange(len(counts)) < ends[:, None]).astype(float)
        a, variance, deviance = likelihood(counts.astype(float), middle, width, used, columns)
        rows.append(np.stack([deviance + 2.0 * parameters + 2.0 * (len(counts) - ends), a, variance, ends]))
    aic, a, variance, last = np.concatenate(rows, axis=1)
    weight = np.exp(-0.5 * (aic - aic.min()))
    return weight / weight.sum(), a, variance, last.astype(int)


def likelihood(
    counts: Array, middle: Array, width: Array, used: Array, columns: Sequence[float]
) -> tuple[Array, Array, Array]:
    """Maximum likelihood of ln p = columns . beta on several sets of bins (used, a row each) at once: a, its variance, deviance."""
    x = np.stack([np.ones_like(middle), np.log(middle)] + [(middle / middle[-1]) ** q for q in columns], axis=1)
    mean = np.tile(np.maximum(counts, 0.3), (len(used), 1))
    z = np.log(mean / width)
    for _ in range(STEPS):  # reweighted least squares
        normal = np.einsum("wb,bp,bq->wpq", used * mean, x, x) + SMALL * np.eye(x.shape[1])
        beta = np.linalg.solve(normal, np.einsum("wb,bp->wp", used * mean * z, x)[..., None])[..., 0]
        eta = np.clip(beta @ x.T, -60.0, 60.0)
        mean = np.clip(np.exp(eta) * width, 1e-6, 1e9)
        z = eta + (counts - mean) / mean
    logs = np.where(counts > 0, counts * np.log(np.maximum(counts, 1e-9) / mean), 0.0)
    return beta[:, 1], np.linalg.inv(normal)[:, 1, 1], 2.0 * np.sum(used * (logs - (counts - mean)), axis=1)
