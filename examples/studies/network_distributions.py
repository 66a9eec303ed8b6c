#!/usr/bin/env python3
"""Distributions of forces, gaps, frequencies and contact vectors over jammed packings, with fits and a picture.

usage: network_distributions.py PICTURE.png PACKING...      packings at their jamming point, as jam-pack writes them
Make them with: for s in $(seq 20); do jam-pack --seed $s --output p$s.dat; done
Needs the Python package `jam`, numpy, matplotlib.

Cumulative distributions c(x) ~ x^(1+a): a is the exponent of the density. It is fitted by maximum likelihood on the stated
range, with no bins (Clauset, Shalizi and Newman, SIAM Rev. 51, 661 (2009)); errors are jackknife over packings. Values to
compare with: theta_e = 0.42311 (extended forces), theta_l = 0.17462 (localised), gamma = 0.41269 (gaps): Charbonneau et al.,
Nat. Commun. 5, 3725 (2014); Lerner, During and Wyart, Soft Matter 9, 8252 (2013).
"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import jam  # noqa: E402

LOCALISED = 1  # flag JAM_CONTACT_LOCALISED
# Power laws hold for small values only: the fitted exponents still drift with the upper ends below (extended forces, N = 1024,
# 20 packings: 0.31, 0.38, 0.42 for 0.4, 0.2, 0.1). Gaps below 1e-4 are depleted by the finite size.
RANGES = {"extended forces": (1e-4, 0.1), "localised forces": (1e-4, 0.05), "gaps": (1e-4, 1e-2), "frequencies": (1e-3, 0.05)}
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
        modes = packing.modes(400)
        dots, z = packing.contact_dots(weighted=0), packing.coordination
        return {
            "extended forces": force[~local] / force[~local].mean(),
            "localised forces": force[local] / force[local].mean(),
            "gaps": packing.gaps(h_max=1.0, stable_only=1).gap,
            "frequencies": np.sqrt(modes.values),
            "all modes": packing.dim * (len(modes.spheres) - 1),
            "dots": dots.dot,
            "buckler dots": dots.dot[z[dots.sphere] == packing.dim + 1],
            "S": packing.sphere_structure(weighted=0).s[z > 0],
            "z": z[z > 0],
            "phi": packing.packing_fraction,
        }


def exponent(x, low, high):
    """Maximum likelihood of a in the density ~ x^a on [low, high], by Newton's bisection on the score."""
    x = x[(x >= low) & (x <= high)] / high
    ratio, mean = low / high, np.log(x).mean()

    def score(a):  # mean of ln x minus its expectation under the truncated power law
        b = a + 1.0
        if abs(b) < 1e-9:
            return mean - 0.5 * np.log(ratio)
        return mean - (-np.log(ratio) * ratio**b / (1.0 - ratio**b) - 1.0 / b)

    left, right = -0.99, 3.0
    for _ in range(60):
        middle = 0.5 * (left + right)
        left, right = (middle, right) if score(middle) > 0.0 else (left, middle)
    return 0.5 * (left + right)


def fit(samples, name):
    """Exponent over all samples, its jackknife error and the number of values in the range."""
    low, high = RANGES[name]
    values = [s[name] for s in samples]
    pooled = np.concatenate(values)
    count = int(((pooled >= low) & (pooled <= high)).sum())
    leave = [exponent(np.concatenate(values[:k] + values[k + 1 :]), low, high) for k in range(len(values))] if len(values) > 1 else []
    error = np.sqrt((len(leave) - 1) * np.var(leave)) if leave else np.nan
    return exponent(pooled, low, high), error, count


def draw_cdf(axis, samples, name, result):
    pooled = np.sort(np.concatenate([s[name] for s in samples]))
    total = sum(s["all modes"] for s in samples) if name == "frequencies" else len(pooled)
    cdf = np.arange(1, len(pooled) + 1) / total
    axis.loglog(pooled, cdf, ".", markersize=2, label=name)
    low, high = RANGES[name]
    x = np.geomspace(low, high, 50)
    at = np.searchsorted(pooled, high) - 1
    for a, style, text in ((result[0], "-", f"fit: 1 + a = {1 + result[0]:.3f} ± {result[1]:.3f}"),
                           (EXPECTED[name], "--", f"expected {1 + EXPECTED[name]:.3f}")):
        axis.plot(x, cdf[at] * (x / pooled[at]) ** (1 + a), style, linewidth=1.5, label=text)
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
    print(f"{'':18} {'range':>16} {'values':>7} {'exponent':>9} {'error':>7} {'expected':>9} {'sigmas':>7}")
    results = {name: fit(samples, name) for name in RANGES}
    for name, (a, error, count) in results.items():
        low, high = RANGES[name]
        print(f"{name:18} {low:7.0e} .. {high:5.2g} {count:7d} {a:9.4f} {error:7.4f} {EXPECTED[name]:9.4f} {abs(a - EXPECTED[name]) / error:7.1f}")
    figure, axes = plt.subplots(2, 3, figsize=(14, 8))
    for axis, name in zip(axes.flat, RANGES):
        draw_cdf(axis, samples, name, results[name])
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
    figure.suptitle(f"{len(samples)} packings")
    figure.tight_layout()
    figure.savefig(sys.argv[1], dpi=100)


if __name__ == "__main__":
    main()
