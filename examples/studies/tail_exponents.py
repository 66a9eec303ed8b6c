#!/usr/bin/env python3
"""Exponent of a density p(x) ~ x^a for x -> 0. The error bar includes the choice of range and the corrections to the law.

usage: tail_exponents.py [PACKINGS [REPEATS]]      validation on samples of known exponent (default 20 packings, 40 repeats)

Method, the same for every quantity, fixed on synthetic samples before any packing was looked at:
  * values of all packings in bins, six a decade, from x_low to 1; x_low is where N c(x) = floor: below, the finite size rules
    (N spheres a packing, c the cumulative distribution; R. Diaz Hernandez Rojas, PhD thesis, Sapienza 2021);
  * models p = A x^a and p = A x^a exp(b x^q), q one of `powers` (leading correction to the law), by maximum likelihood of Poisson
    counts on the bins from x_low up to each possible upper end;
  * their average with weights exp(-AIC / 2), AIC = deviance + 2 parameters + 2 bins left out (W. I. Jay and E. T. Neil,
    Phys. Rev. D 103, 114502 (2021)): no range and no model is chosen;
  * error^2 = weighted variance of a within each fit, times the variance between packings over that of Poisson counts where that is
    above 1, plus the weighted variance of a among ranges and models (as Jay and Neil).
On the laws below 78 % of the trials lie within one error and 97 % within two with 100 packings, 84 % and 99 % with 20; worst is a slow
departure from the law: 50 % and 82 %.
A power law without corrections on the range of least Kolmogorov-Smirnov distance (Clauset, Shalizi and Newman, SIAM Rev. 51, 661
(2009)) was tried on such samples first: biased by -0.04 to -0.2 on forces and by 0.02 to 0.03 on gaps that have a background.
"""
import sys

import numpy as np

POWERS = (0.5, 1.0, 2.0)
GAP_POWERS = (
    0.25,
    0.5,
    1.0,
    2.0,
)  # a constant background beside h^-0.41 is a correction h^0.41, below the reach of 1/2
FLOOR, GAP_FLOOR = 3.0, 10.0  # gaps feel the finite size far more than forces
PER_DECADE, LEAST_BINS = 6, 9


def lower_end(pool, spheres, floor):
    """x with N c(x) = floor, in a sorted pool."""
    return pool[min(len(pool) - 1, int(floor * len(pool) / spheres))]


def likelihood(counts, middle, width, used, columns):
    """Maximum likelihood of ln p = columns . beta on several sets of bins (used, a row each) at once: a, its variance, deviance."""
    x = np.stack([np.ones_like(middle), np.log(middle)] + [(middle / middle[-1]) ** q for q in columns], axis=1)
    mean = np.tile(np.maximum(counts, 0.3), (len(used), 1))
    z = np.log(mean / width)
    for _ in range(12):  # reweighted least squares
        normal = np.einsum("wb,bp,bq->wpq", used * mean, x, x) + 1e-9 * np.eye(x.shape[1])
        beta = np.linalg.solve(normal, np.einsum("wb,bp->wp", used * mean * z, x)[..., None])[..., 0]
        eta = np.clip(beta @ x.T, -60.0, 60.0)
        mean = np.clip(np.exp(eta) * width, 1e-6, 1e9)
        z = eta + (counts - mean) / mean
    logs = np.where(counts > 0, counts * np.log(np.maximum(counts, 1e-9) / mean), 0.0)
    return beta[:, 1], np.linalg.inv(normal)[:, 1, 1], 2.0 * np.sum(used * (logs - (counts - mean)), axis=1)


def average(counts, edges, powers):
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


def bins_of(samples, spheres, floor):
    """Edges from x_low to 1 and the counts of each packing."""
    low = lower_end(np.sort(np.concatenate(samples)), spheres, floor)
    edges = 10.0 ** (np.arange(-int(np.ceil(-np.log10(low) * PER_DECADE)), 1) / PER_DECADE)
    edges[0] = low
    if len(edges) < LEAST_BINS + 2:  # two upper ends to average over
        raise ValueError(
            f"finite size ends at {low:.2g} only, which leaves no range below 1: larger packings are needed"
        )
    return edges, np.array([np.histogram(s, edges)[0] for s in samples])


def fit(samples, spheres, powers=POWERS, floor=FLOOR):
    """Exponent, error and its two parts, range (upper end: weighted mean of ln) and number of values; samples: one array a packing."""
    edges, counts = bins_of(samples, spheres, floor)
    total = counts.sum(axis=0)
    weight, a, variance, last = average(total, edges, powers)
    mean = weight @ a
    # Packings are independent, forces of one packing need not be: variance of counts between packings over that of Poisson.
    excess = np.mean(counts.var(axis=0, ddof=1) / counts.mean(axis=0)) if len(samples) > 1 else 1.0
    statistic, spread = np.sqrt(max(1.0, excess) * (weight @ variance)), np.sqrt(weight @ (a - mean) ** 2)
    high = np.exp(weight @ np.log(edges[last]))
    return {
        "exponent": mean,
        "error": np.hypot(statistic, spread),
        "statistic": statistic,
        "spread": spread,
        "low": edges[0],
        "high": high,
        "excess": excess,
        "count": int(total[edges[1:] <= high * 1.000001].sum()),
    }


def apparent(samples, spheres, floor=FLOOR):
    """Upper ends and exponents of the law without corrections between x_low and each of them: how it drifts."""
    edges, counts = bins_of(samples, spheres, floor)
    ends = np.arange(4, counts.shape[1] + 1)
    used = (np.arange(counts.shape[1]) < ends[:, None]).astype(float)
    return (
        edges[ends],
        likelihood(counts.sum(axis=0).astype(float), np.sqrt(edges[:-1] * edges[1:]), np.diff(edges), used, ())[0],
    )


class Synthetic:
    """A density x^a upper(x) that finite size bends below x0, where N c(x0) = nc: `flat` below it, or `slow`, as published for gaps of
    Mari-Kurchan packings: c = x^(1+a) (1 + (x/x0)^(-a q))^(1/q), |q| = 1.26."""

    def __init__(self, a, values, upper, bend="none", nc=1.0, spheres=1024, x_max=20.0):
        self.a, self.values, x0 = a, values, 1e-6
        q = 1.26 if a > 0.0 else -1.26
        self.x = np.geomspace(1e-9, x_max, 40001)
        for _ in range(60):
            if bend == "flat":
                low = (x0**2 + self.x**2) ** (0.5 * a)
            elif bend == "slow":
                r = (self.x / x0) ** (-a * q)
                low = self.x**a * (1.0 + r) ** (1.0 / q - 1.0) * ((1.0 + a) * (1.0 + r) - a * r)
            else:
                low = self.x**a
            p = low * upper(self.x)
            self.cdf = np.concatenate([[0.0], np.cumsum(0.5 * (p[1:] + p[:-1]) * np.diff(self.x))]) + self.x[0] * p[0]
            self.cdf /= self.cdf[-1]
            x0 *= (nc / (np.interp(x0, self.x, self.cdf) * spheres)) ** (1.0 / (1.0 + a))

    def draw(self, rng):
        return np.interp(rng.random(self.values), self.cdf, self.x)


def families():
    """Synthetic laws that deviate at x of order 1, fast and slowly, with as many values as a packing of 1024 spheres."""
    extended, localised, gap = 0.42311, 0.17462, -0.41269
    for a, n in ((extended, 2500), (localised, 500)):
        kind = "extended" if a == extended else "localised"
        yield f"{kind} gamma", Synthetic(a, n, lambda x, a=a: np.exp(-(1 + a) * x), "flat")
        yield f"{kind} gamma, slow bend at 0.1", Synthetic(a, n, lambda x, a=a: np.exp(-(1 + a) * x), "slow", 0.1)
        yield f"{kind} weibull", Synthetic(a, n, lambda x, a=a: np.exp(-((0.92 * x) ** (1 + a))), "flat")
        yield f"{kind} gauss", Synthetic(a, n, lambda x: np.exp(-((0.75 * x) ** 2)), "flat")
        yield f"{kind} slow departure", Synthetic(a, n, lambda x: np.exp(-0.7 * x) / (1 + x / 0.4), "flat")
    uppers = {
        "law alone": lambda x: 1.0 + 0.0 * x,
        "exponential": lambda x: np.exp(-3.3 * x),
        "rising": lambda x: 1 + 0.6 * x**0.71,
        "constant background": lambda x: 1 + 0.5 * x**0.41,
    }
    for name, upper in uppers.items():
        for bend in ("flat", "slow"):
            yield f"gaps {name}, {bend}", Synthetic(gap, 12000, upper, bend, x_max=1.0)
    yield "frequencies falling", Synthetic(0.0, 3000, lambda x: 1 / (1 + (x / 0.6) ** 2), x_max=2.0)
    yield "frequencies rising", Synthetic(0.0, 3000, lambda x: (1 + 0.3 * x) / (1 + (x / 0.8) ** 4), x_max=2.0)


def main():
    packings, repeats = [int(v) for v in sys.argv[1:3]] + [20, 40][len(sys.argv[1:3]) :]
    print(f"{'known law':42} {'bias':>8} {'scatter':>8} {'error':>8} {'in 1s':>6} {'in 2s':>6} {'range':>18}")
    for name, law in families():
        gap = name.startswith("gaps")
        found = []
        for k in range(repeats):
            rng = np.random.default_rng(1000 + k)
            found.append(
                fit(
                    [law.draw(rng) for _ in range(packings)],
                    1024,
                    GAP_POWERS if gap else POWERS,
                    GAP_FLOOR if gap else FLOOR,
                )
            )
        off, error = np.array([f["exponent"] - law.a for f in found]), np.array([f["error"] for f in found])
        high = np.exp(np.mean([np.log(f["high"]) for f in found]))
        print(
            f"{name:42} {off.mean():8.4f} {off.std():8.4f} {error.mean():8.4f} {np.mean(abs(off) < error):6.2f}"
            f" {np.mean(abs(off) < 2 * error):6.2f} {found[0]['low']:8.1e} .. {high:5.2g}",
            flush=True,
        )


if __name__ == "__main__":
    main()
