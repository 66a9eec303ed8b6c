#!/usr/bin/env python3
"""Distributions of forces, gaps, frequencies and contact vectors over jammed packings, with fits and a picture.

usage: network_distributions.py PICTURE.png PACKING...      packings at their jamming point, as jam-pack writes them
Make them with: for s in $(seq 20); do jam-pack --seed $s --output p$s.dat; done
Needs the Python package `jam`, numpy, matplotlib.

Cumulative distributions c(x) ~ x^(1+a): a is the exponent of the density, fitted by maximum likelihood with no bins, errors by
bootstrap over packings. No range is chosen by eye; two rules, the same for all four quantities, are both reported:
  decade  the laws hold for x -> 0: the lowest decade above the finite size, which rules where less than one observation a packing
          lies (N c(x) departs from x^(1+a) at about 1);
  widest  from the same lower end to the upper end, among 40 ranks up to half of all values, where the distance of Kolmogorov and
          Smirnov to the fitted law is least (Clauset, Shalizi and Newman, SIAM Rev. 51, 661 (2009)); chosen again in each bootstrap.
The widest range was the rule written down first; it has ten times the values and feels the corrections to the law, so its exponents
are sharper and biased, and the decade was added for that. Gaps feel the finite size most: their lowest decade is still depleted.
Values to compare with: theta_e = 0.42311 (extended forces), theta_l = 0.17462 (localised), gamma = 0.41269 (gaps): Charbonneau et
al., Nat. Commun. 5, 3725 (2014); Lerner, During and Wyart, Soft Matter 9, 8252 (2013).
"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import jam  # noqa: E402

LOCALISED = 1  # flag JAM_CONTACT_LOCALISED
EXPECTED = {"extended forces": 0.42311, "localised forces": 0.17462, "gaps": -0.41269, "frequencies": 0.0}


def measure(path):
    """Everything the study needs from one packing."""
    with jam.System.read(path) as packing:
        found = packing.contacts_from_geometry()
        if found.excess_contacts != 0 or packing.status != 0:
            print(f"{path}: {found.excess_contacts} excess contacts, status {packing.status}: left out", file=sys.stderr)
            return None
        force, flags = packing.forces, packing.contact_classes()
        local = (flags & LOCALISED) != 0
        modes = packing.modes(which="all")
        dots, z = packing.contact_dots(weighted=0), packing.coordination
        return {
            "extended forces": force[~local] / force[~local].mean(),
            "localised forces": force[local] / force[local].mean(),
            "gaps": packing.gaps(h_max=1.0, stable_only=1).gap,
            "frequencies": np.sqrt(np.maximum(modes.values[packing.dim:], 0.0)),
            "dots": dots.dot,
            "buckler dots": dots.dot[z[dots.sphere] == packing.dim + 1],
            "S": packing.sphere_structure(weighted=0).s[z > 0],
            "z": z[z > 0],
            "phi": packing.packing_fraction,
        }


def exponent(mean, low, high):
    """Maximum likelihood of a in the density ~ x^a on [low, high], where mean is that of ln(x / high)."""
    ratio = low / high
    left, right = -0.99, 3.0
    for _ in range(50):  # bisection on the score: mean of ln x minus its expectation under the truncated law
        middle = 0.5 * (left + right)
        b = middle + 1.0
        score = mean - (-np.log(ratio) * ratio**b / (1.0 - ratio**b) - 1.0 / b)
        left, right = (middle, right) if score > 0.0 else (left, middle)
    return 0.5 * (left + right)


class Pool:
    """Values of several packings in one sorted list, from the rank where finite size ends."""

    def __init__(self, values):
        self.x = np.sort(np.concatenate(values))
        self.first = len(values) - 1
        self.total = np.concatenate([[0.0], np.cumsum(np.log(self.x))])
        self.ranks = np.unique(np.geomspace(10 * len(values), len(self.x) // 2, 40).astype(int))

    def fit(self, last):
        """Exponent, low, high, number of values from the first rank to `last`."""
        low, high, count = self.x[self.first], self.x[last], last - self.first + 1
        mean = (self.total[last + 1] - self.total[self.first]) / count - np.log(high)
        return exponent(mean, low, high), low, high, count

    def distance(self, last):
        a, low, high, count = self.fit(last)
        law = ((self.x[self.first : last + 1] / low) ** (a + 1.0) - 1.0) / ((high / low) ** (a + 1.0) - 1.0)
        return np.abs(law - np.arange(count) / (count - 1.0)).max()


RULES = {"decade": lambda pool: pool.fit(np.searchsorted(pool.x, 10.0 * pool.x[pool.first]) - 1),
         "widest": lambda pool: pool.fit(min(pool.ranks, key=pool.distance))}


def fit(values, rule, repeats=200):
    """Exponent, its error, and the range chosen."""
    a, low, high, count = RULES[rule](Pool(values))
    rng, n = np.random.default_rng(1), len(values)
    again = [RULES[rule](Pool([values[k] for k in rng.integers(n, size=n)]))[0] for _ in range(repeats)] if n > 1 else [np.nan]
    return {"exponent": a, "error": np.std(again), "low": low, "high": high, "count": count}


def draw_cdf(axis, samples, name, result):
    pooled = np.sort(np.concatenate([s[name] for s in samples]))
    cdf = np.arange(1, len(pooled) + 1) / len(pooled)
    axis.loglog(pooled, cdf, ".", markersize=2, label=name)
    low, high = result["low"], result["high"]
    x = np.geomspace(low, high, 50)
    at = np.searchsorted(pooled, high)
    for a, style, text in ((result["exponent"], "-", f"fit: 1 + a = {1 + result['exponent']:.3f} ± {result['error']:.3f}"),
                           (EXPECTED[name], "--", f"expected {1 + EXPECTED[name]:.3f}")):
        axis.plot(x, cdf[at] * (x / pooled[at]) ** (1 + a), style, linewidth=1.5, label=text)
    axis.axvspan(low, high, color="0.92", zorder=0)
    axis.set(xlabel={"gaps": "h", "frequencies": "omega"}.get(name, "f"), ylabel="cumulative distribution")
    axis.legend(fontsize=8)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    samples = [m for m in map(measure, sys.argv[2:]) if m]
    if not samples:
        sys.exit("no packing with one state of self-stress")
    phi = np.array([s["phi"] for s in samples])
    print(f"{len(samples)} packings, phi_J = {phi.mean():.5f} +- {phi.std() / np.sqrt(max(1, len(phi) - 1)):.5f}")
    print(f"{'':18} {'rule':>7} {'range':>20} {'values':>7} {'exponent':>9} {'error':>7} {'expected':>9} {'sigmas':>7}")
    results = {name: {rule: fit([s[name] for s in samples], rule) for rule in RULES} for name in EXPECTED}
    for name, rules in results.items():
        for rule, r in rules.items():
            print(f"{name:18} {rule:>7} {r['low']:9.2e} .. {r['high']:7.3g} {r['count']:7d} {r['exponent']:9.4f} {r['error']:7.4f} {EXPECTED[name]:9.4f}"
                  f" {abs(r['exponent'] - EXPECTED[name]) / r['error']:7.1f}")
    figure, axes = plt.subplots(2, 3, figsize=(14, 8))
    for axis, name in zip(axes.flat, EXPECTED):
        draw_cdf(axis, samples, name, results[name]["decade"])
    bins = np.linspace(-1, 1, 121)
    for name in ("dots", "buckler dots"):
        values = np.concatenate([s[name] for s in samples])
        height, _ = np.histogram(values, bins, density=True)
        axes[1, 1].step(bins[:-1], height, where="post", label={"dots": "all stable spheres", "buckler dots": "bucklers"}[name])
        top = np.argmax(height)
        print(f"{name}: the histogram peaks at {0.5 * (bins[top] + bins[top + 1]):.3f}")
    axes[1, 1].axvline(0.5, color="gray", linestyle=":")
    axes[1, 1].set(xlabel="n_ij . n_ik", ylabel="density")
    axes[1, 1].legend(fontsize=8)
    s, z = np.concatenate([m["S"] for m in samples]), np.concatenate([m["z"] for m in samples])
    for k in range(4, 10):
        values = s[z == k]
        if len(values) > 20:
            axes[1, 2].hist(values, bins=60, density=True, histtype="step", label=f"z = {k}")
            axes[1, 2].axvline(-0.5 * k, color="gray", linestyle=":", linewidth=0.8)
            print(f"z = {k}: {len(values)} spheres, smallest S = {values.min():.4f}, edge at {-0.5 * k}")
    axes[1, 2].set(xlabel="S_i (dotted: -z/2)", ylabel="density")
    axes[1, 2].legend(fontsize=8)
    figure.suptitle(f"{len(samples)} packings; grey: the range of each fit, the lowest decade above the finite size")
    figure.tight_layout()
    figure.savefig(sys.argv[1], dpi=100)


if __name__ == "__main__":
    main()
