#!/usr/bin/env python3
"""Exponents by several estimators against N: figures 4.11, 4.12, 4.14, 4.16, 4.18 and 4.19 of the thesis.

usage: estimators.py [--large] [--sizes N ...] [--particles K ...] [--folder DIR] [--only-read] [--out DIR]

Packings are those of both_sides.py from below, and Mari-Kurchan packings planted at 2.5. The cumulative distribution by three
estimators: values pooled, ranked in each packing, evaluated at fixed points. Small: N = 128 and 256, 3000 particles each.
"""
import matplotlib.pyplot as plt
import numpy as np
from both_sides import SIDES, U, samples
from common import GAMMA, Results, arguments, mean_error
from finite_size import CROSSOVER

from jam import scaling

WIDEST = 0.01  # gaps to here are compared with the crossover: beyond, pairs are those of a liquid
SPANS = {"extended": (3e-3, 3), "localised": (1e-3, 3), "gaps": (1e-5, 1)}


def bucklers(r, found, sizes):
    """4.11: S of bucklers, both models laid over each other."""
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.4))
    bins = np.arange(-2.0, -0.49, 0.05)
    for (side, n), s in found.items():
        values = [m["S"][m["z"] == 4] for m in s.good]
        pool = np.concatenate(values)
        for axis in axes if n == max(sizes) else axes[:1]:
            axis.hist(pool, bins, density=True, histtype="step", ls="-" if side == "below" else "--",
                      color=f"C{sizes.index(n)}", label=f"{'spheres' if side == 'below' else SIDES[side]}, N = {n}")  # fmt: skip
        r.add("4.11", f"mean S of bucklers, {SIDES[side]}, N = {n}", "very similar", *mean_error([v.mean() for v in values if len(v)]))
    for axis in axes:
        axis.set(xlabel="S_i of bucklers, z = 4", ylabel="pdf")
        axis.legend(fontsize=7)
    axes[1].set(title=f"N = {max(sizes)}")
    r.picture(figure, "estimators_bucklers")


def bends(r, found):
    """4.12: power of c of extended forces where the density bends over."""
    for (side, n), s in found.items():
        few, many = (np.array([np.searchsorted(v, f) for v in s.extended], float) for f in (0.1, 0.3))
        power = np.log(many.mean() / few.mean()) / np.log(3)
        error = mean_error(many / many.mean() - few / few.mean())[1] / np.log(3)
        r.add("4.12", f"power of c of extended forces between f = 0.1 and 0.3, {SIDES[side]}, N = {n}", "below the bend: 1.42311", power, error)


def crossover(r, found, sizes):
    """4.14: gaps of Mari-Kurchan packings with the published function, which one factor brings onto N c for each packing."""
    figure, axis = plt.subplots(figsize=(6.4, 4.8))
    for n in sizes:
        if ("mk", n) not in found:
            continue
        gaps = found["mk", n].gaps
        x = np.geomspace(0.1, min(300, WIDEST * n ** U["gaps"]), 30)
        count = np.array([np.searchsorted(g, x * n ** -U["gaps"]) for g in gaps], float)
        mean, error = count.mean(axis=0), count.std(axis=0, ddof=1) / len(count) ** 0.5
        law = scaling.crossover(x, *CROSSOVER, -GAMMA)
        use = mean > 0
        weight = (mean[use] / np.maximum(error[use], 1e-3 * mean[use])) ** 2
        factor = np.exp(np.average(np.log(mean[use] / law[use]), weights=weight))
        axis.errorbar(x, mean / factor, error / factor, fmt=".", ms=4, label=f"N = {n}, factor {factor:.1f}")
        off = np.log(mean[use] / law[use] / factor) / np.maximum(error[use] / mean[use], 1e-3)
        r.add("4.14", f"gaps a packing over the published F(h N^(1/(1-gamma))), N = {n}", "one factor", factor)
        r.add("4.14", f"root mean square deviation from F in errors, from scaled h = 0.1, N = {n}", "about 1", np.sqrt(np.mean(off**2)))
    axis.loglog(x, law, "k-", lw=1, label="F, published a, b, q")
    axis.loglog(x, 0.223543 * x ** (1 - GAMMA), "k:", lw=1, label="slope 0.58731")
    axis.set(xlabel="h N^(1/(1-gamma))", ylabel="gaps of a packing below h, over a factor")
    axis.legend(fontsize=8)
    r.picture(figure, "estimators_crossover")


def exponents(r, found, sizes):
    """4.16: gamma - gamma(N) near scaled h = 1 and 100, by least squares and by two likelihoods."""
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.4), sharey=True)
    for axis, at in zip(axes, (1.0, 100.0)):
        for side, marker in (("below", "o"), ("mk", "s")):
            there = [n for n in sizes if (side, n) in found]
            values = {text: [] for text in ("least squares", "likelihood", "truncated likelihood")}
            for n in there:
                gaps = found[side, n].gaps
                grid = at * np.geomspace(10**-0.5, 10**0.5, 15) * n ** -U["gaps"]

                def line(some):
                    return np.polyfit(np.log(grid), np.log(np.maximum(scaling.cdf_grid(some, grid).c, 1e-9)), 1)[0] - 1

                made = scaling.bootstrap(gaps, line, 40)
                values["least squares"].append((made.value, made.error))
                for text, low in (("likelihood", None), ("truncated likelihood", grid[0])):
                    try:
                        fit = scaling.fit_power(gaps, grid[-1], low)
                        values[text].append((fit.value, fit.error))
                    except ValueError:
                        values[text].append((np.nan, np.nan))
                for text in values:
                    value, error = values[text][-1]
                    known = "in the picture" if side == "mk" else "none"
                    r.add("4.16", f"gamma by {text} near scaled h = {at:g}, {SIDES[side]}, N = {n}", known, -value, error)
            for k, (text, pairs) in enumerate(values.items()):
                v, e = np.array(pairs).T
                x = np.array(there) * (1 + 0.03 * k)
                axis.errorbar(x, GAMMA + v, e, fmt=marker + ("-" if k == 0 else ":"), ms=4, color=f"C{k}", label=f"{text}, {SIDES[side]}")
        axis.axhline(0, color="0.6", lw=1)
        axis.set(xscale="log", xlabel="N", ylabel="gamma - gamma(N)", title=f"near h N^(1/(1-gamma)) = {at:g}")
        axis.set_xticks(sizes, [str(n) for n in sizes])
        axis.minorticks_off()
    axes[1].legend(fontsize=6)
    r.picture(figure, "estimators_exponents")


def equivalence(r, found, sizes):
    """4.18 (forces) and 4.19 (gaps) of hard spheres: three estimators of the distribution for all N; bars: deviation over packings."""
    there = [n for n in sizes if ("below", n) in found]
    for label, names, text in (("4.18", ("extended", "localised"), "forces"), ("4.19", ("gaps",), "gaps")):
        figure, axes = plt.subplots(len(names), len(there), figsize=(4.6 * len(there), 3.6 * len(names)), squeeze=False)
        for row, name in zip(axes, names):
            for axis, n in zip(row, there):
                compare(r, axis, label, name, n, getattr(found["below", n], name))
        axes[0, 0].legend(fontsize=7)
        r.picture(figure, f"estimators_equivalence_{text}")


def compare(r, axis, label, name, n, values):
    x = np.geomspace(*SPANS[name], 25)
    fixed, pooled, ranked = scaling.cdf_grid(values, x), scaling.cdf_pooled(values), scaling.cdf_ranked(values)
    use = fixed.c > 0
    axis.errorbar(x[use], fixed.c[use], fixed.c_error[use] * len(values) ** 0.5, fmt="o", ms=3, lw=1, label="fixed points")
    axis.plot(pooled.x, pooled.c, "-", lw=1, label="pooled")
    axis.errorbar(ranked.x[::9], ranked.c[::9], xerr=ranked.x_error[::9], fmt="s", ms=2, lw=0.7, label="ranked")
    axis.set(xscale="log", yscale="log", xlabel=("h" if name == "gaps" else f"f, {name}") + f", N = {n}", ylabel="c")
    few = np.array([np.searchsorted(v, x) for v in values]).sum(axis=0) >= 30  # enough values for an error
    few &= (x < ranked.x[-1]) & (fixed.c < 0.5)  # packings with few values end the ranked one
    off = np.max((np.abs(np.interp(x, ranked.x, ranked.c) - fixed.c) / np.maximum(fixed.c_error, 1e-12))[few])
    r.add(label, f"{name}, from below, N = {n}: ranked against fixed points, most, in errors", "agree", off)
    least = np.array([v[0] for v in values if len(v)])
    r.add(label, f"{name}, from below, N = {n}: deviation of the least value over its mean", "gaps scatter most", least.std(ddof=1) / least.mean())


def main():
    p = arguments(__doc__.splitlines()[0])
    p.add_argument("--sizes", type=int, nargs="+", help="N (small 128 256; large 256 ... 2048)")
    p.add_argument("--particles", type=float, nargs="+", help="particles of all sizes or of each (small 3e3, large 1e5)")
    o = p.parse_args()
    sizes = o.sizes or ([256, 512, 1024, 2048] if o.large else [128, 256])
    r = Results(o, "estimators")
    found = samples(o, ("below", "mk"), sizes, o.particles or [1e5 if o.large else 3e3])
    bucklers(r, found, sizes)
    bends(r, found)
    crossover(r, found, sizes)
    exponents(r, found, sizes)
    equivalence(r, found, sizes)
    r.write()


if __name__ == "__main__":
    main()
