#!/usr/bin/env python3
"""Which spheres move below jamming: figures 3.5 to 3.10, 3.15, 3.16, 3.21 and 3.22 of the thesis, hard spheres.

usage: motion_md.py [--large] [--n N] [--runs RUNS] [--long-runs RUNS] [--folder DIR] [--out DIR]

Packings as published: N = 1024, sequential LPs from random spheres, seeds 1 and 2. Runs from one packing with other velocities, its
diameters reduced to phi / phi_J = 0.96 to 0.999. tau is the number of collisions over N, as in the thesis. Small: 100 runs, and
5 that are 100 times as long, as published. Large: 5000 and 1000; of the second packing 500.
Runs are kept in the folder.
"""
import sys

import matplotlib.pyplot as plt
import numpy as np
from common import HERE, Results, arguments

from jam import near_jamming as nj

sys.path.insert(0, str(HERE.parent))
import near_jamming_common as near  # noqa: E402

SHOWN = (2, 10, 20, 100)  # instants of the columns
RATIO = 0.995


def at(tau):
    return near.INSTANTS.index(tau)


def displacements(r, structure, runs, radius):
    """3.6: distributions of single spheres over runs at tau = 20, mean and median; 3.7: mean against deviation."""
    kept = runs.kept[at(20)] / radius  # (runs, n, d)
    mean, median = kept.mean(axis=0), np.median(kept, axis=0)
    square = np.sum(kept**2, axis=2)
    figure, axes = plt.subplots(2, 2, figsize=(10, 8))
    z = mean[:, 2]
    order = np.argsort(np.abs(z))
    colours = plt.cm.coolwarm((structure.c[:, 2] + 2) / 4)
    chosen = np.concatenate([order[-len(z) // 10 :], order[: len(z) // 20]])
    for i in chosen[::4]:
        count, edges = np.histogram(kept[:, i, 2], np.linspace(-0.15, 0.15, 31), density=True)
        style = "k--" if structure.rattlers[i] else "-"
        axes[0, 0].plot(edges[1:] - 0.005, count, style, lw=0.5, **({} if style == "k--" else {"color": colours[i]}))
    axes[0, 0].set(xlabel="dz / R_J", ylabel="pdf of a sphere; colour: C_z from -2 (blue) to 2 (red)")
    for c, name in enumerate("xyz"):
        axes[0, 1].plot(mean[:, c], median[:, c], ".", ms=2, label=name)
    line = np.array([mean.min(), mean.max()])
    axes[0, 1].plot(line, line, "k--", lw=1)
    axes[0, 1].set(xlabel="mean of dr_c / R_J", ylabel="median", title="dashed: equal")
    axes[0, 1].legend(fontsize=8)
    order = np.argsort(square.mean(axis=0))
    for i in np.concatenate([order[-len(z) // 10 :], order[: len(z) // 20]])[::4]:
        count, edges = np.histogram(np.log10(square[:, i]), np.linspace(-6, 0, 31), density=True)
        colour = plt.cm.viridis(-structure.s[i] / 4) if not structure.rattlers[i] else "k"
        axes[1, 0].plot(edges[1:] - 0.1, count, "--" if structure.rattlers[i] else "-", lw=0.5, color=colour)
    axes[1, 0].set(xlabel="lg |dr|^2 / R_J^2", ylabel="pdf of a sphere; colour: S from 0 (dark) to -4")
    x, y = square.mean(axis=0), np.median(square, axis=0)
    axes[1, 1].loglog(x, y, ".", ms=2)
    axes[1, 1].loglog(np.sort(x), 0.75 * np.sort(x), "k:", lw=1, label="0.75 of the mean")
    axes[1, 1].set(xlabel="mean of |dr|^2 / R_J^2", ylabel="median")
    axes[1, 1].legend(fontsize=8)
    r.picture(figure, "motion_md_single")
    draws = np.random.default_rng(1).integers(len(kept), size=(20, len(kept)))
    slopes = [nj.median_over_mean(kept[d]) for d in draws]
    r.add("3.6", "median over mean of |dr|^2, tau = 20", 0.75, nj.median_over_mean(kept), np.std(slopes, ddof=1))


def spread(r, structure, runs, radius):
    figure, axes = plt.subplots(1, len(SHOWN), figsize=(15, 4))
    for axis, tau in zip(axes, SHOWN):
        mean = runs.mean("displacement")[at(tau)][:, 2] / radius
        sigma = np.sqrt(runs.variance()[at(tau)][:, 2]) / radius
        points = axis.scatter(sigma, mean, c=structure.c[:, 2], s=3, cmap="coolwarm", vmin=-2, vmax=2)
        line = np.array([0.0, sigma.max()])
        axis.plot(line, line, "k--", line, -line, "k--", lw=1)
        axis.set(xlabel="deviation of dz over runs / R_J", ylabel="<dz> / R_J", title=f"tau = {tau}; dashed: equal")
        r.add("3.7", f"largest |<dz>| over its deviation, tau = {tau}", "about 1 early", np.max(np.abs(mean) / sigma))
    figure.colorbar(points, ax=axes[-1], label="C_z")
    r.picture(figure, "motion_md_spread")


def of_second(name):
    """Ending of what a row is called."""
    return ", second packing" if name else ""


def scatters(r, name, structure, md, radius):
    runs = md[RATIO]
    columns = [(f"tau = {tau}", runs, at(tau)) for tau in SHOWN]
    figure, k = near.vectors(structure, columns, radius)
    r.picture(figure, f"motion_md_vectors{name}")
    label = "3.21" if name else "3.8"
    for tau, value in zip(SHOWN, k):
        r.add(label, f"K[C, <dr>], {RATIO}, tau = {tau}{of_second(name)}", "in the picture", value)
    rows = [(f"phi/phi_J = {q}, tau = 10", md[q], at(10)) for q in ((0.999, 0.99) if not name else (RATIO,))]
    figure, k = near.mobility(structure, rows, radius)
    r.picture(figure, f"motion_md_mobility{name}")
    for (title, _, _), values in zip(rows, k):
        for text, value in zip(("sum f", "sum f.f", "S"), values):
            r.add("3.22" if name else "3.10", f"K[{text}, <|dr|^2>], {title}{of_second(name)}", "largest |K| for S", value)
    if name:
        return
    figure, k, bare = near.variances(structure, columns, radius)
    r.picture(figure, "motion_md_variance")
    for tau, value, without in zip(SHOWN, k, bare):
        r.add("3.9", f"K[|C|, Var], {RATIO}, tau = {tau}", "about 0", value)
        r.add("3.9", f"the same without rattlers, tau = {tau}", "about 0", without)


def decays(r, structure, md, long_ones, radius):
    figure, axes = plt.subplots(2, 2, figsize=(10, 8))
    ratios = [q for q in md if q >= 0.98]
    for row, kind, known in ((0, "c", near.MD_EXPONENTS["c"]), (1, "s", near.MD_EXPONENTS["s"])):
        for ratio, runs in md.items():
            x, k = nj.decay_curve(runs, structure, kind)
            for axis, power in ((axes[row, 0], 0.0), (axes[row, 1], known)):
                axis.loglog(x / radius**2 / (1 - ratio) ** power, k, ".-", label=f"{ratio}")
        text = "K[C, <dr>]" if kind == "c" else "K[S, <|dr|^2>]"
        axes[row, 0].set(xlabel="MSD / R_J^2", ylabel=text)
        axes[row, 1].set(xlabel=f"MSD / R_J^2 / (1 - phi/phi_J)^{known:g}, published", ylabel=text)
        axes[row, 0].legend(fontsize=8)
        e = nj.collapse_exponent([md[q] for q in ratios], structure, [1 - q for q in ratios], kind, 20)
        r.add("3.16", f"exponent for {kind.upper()}, 0.98 to 0.999, all K", known, e.value, e.error)
    r.picture(figure, "motion_md_decay")
    figure, axes = plt.subplots(1, 2, figsize=(10, 4.2))
    for ratio, runs in md.items():
        shrunk = radius * ratio ** (1 / 3)  # of the spheres that move; the unit of time has kT = m = 1
        axes[0].loglog(runs.time / shrunk, runs.msd / shrunk**2, ".-", label=f"phi/phi_J = {ratio}")
        axes[1].errorbar(near.taus(runs), runs.time / shrunk, runs.deviation("time") / shrunk, label=f"{ratio}")
    for ratio in (0.99, 0.999):
        runs = md[ratio]
        share = runs.deviation("time")[at(20)] / runs.time[at(20)]
        r.add("3.4", f"deviation of t over runs, over its mean, {ratio}, tau = 20", "tiny", share)
        early = np.log(runs.msd[1] / runs.msd[0]) / np.log(runs.time[1] / runs.time[0])
        r.add("3.5", f"slope of the MSD in t, {ratio}, tau = 1 to 2", "below 2: ballistic only earlier", early)
        late = np.log(runs.msd[-1] / runs.msd[-2]) / np.log(runs.time[-1] / runs.time[-2])
        r.add("3.5", f"slope of the MSD in t, {ratio}, tau = 70 to 100", "> 0: the plateau comes later", late)
    axes[0].set(xlabel="t / (R sqrt(m / kT))", ylabel="MSD / R^2")
    for ratio, runs in long_ones.items():
        shrunk = radius * ratio ** (1 / 3)
        colour = f"C{list(md).index(ratio)}"
        axes[0].loglog(runs.time / shrunk, runs.msd / shrunk**2, "-", lw=1, color=colour, label=f"{ratio}, long")
        late = np.log(runs.msd[-1] / runs.msd[-2]) / np.log(runs.time[-1] / runs.time[-2])
        r.add("3.5", f"slope of the MSD in t, {ratio}, tau = 7000 to 10000", "to 0: plateau", late)
    t = axes[0].lines[0].get_xdata()[:3]
    axes[0].loglog(t, 0.5 * axes[0].lines[0].get_ydata()[0] * (t / t[0]) ** 2, "k--", lw=1, label="slope 2")
    axes[1].set(xscale="log", yscale="log", xlabel="tau", ylabel="t / (R sqrt(m / kT))")
    axes[0].legend(fontsize=8), axes[1].legend(fontsize=8)
    r.picture(figure, "motion_md_msd")


def main():
    p = arguments(__doc__.splitlines()[0])
    p.add_argument("--n", type=int, default=1024, help="spheres (1024)")
    p.add_argument("--runs", type=int, help="runs for each density (small 100, large 5000; 500 at most of the second packing)")
    p.add_argument("--long-runs", type=int, help="runs to tau = 1e4 (small 5, large 1000)")
    o = p.parse_args()
    count, long_count = o.runs or (5000 if o.large else 100), o.long_runs or (1000 if o.large else 5)
    r = Results(o, "motion_md")
    for seed, name, ratios in ((1, "", near.RATIOS), (2, "_second", (RATIO,))):
        packing = near.kept_packing(o.folder, seed, o.n)
        structure, radius = nj.predictors(packing), 0.5 * packing.diameters.mean()
        runs = min(count, 500) if name else count  # the second packing: 500, as published
        md = {q: near.md_runs(packing, o.folder, f"{seed}q", q, runs) for q in ratios}
        r.add("3.1", f"phi_J of seed {seed}", "0.635", packing.packing_fraction)
        scatters(r, name, structure, md, radius)
        if name:
            break
        displacements(r, structure, md[RATIO], radius)
        spread(r, structure, md[RATIO], radius)
        long_ones = {q: near.long_md_runs(packing, o.folder, f"{seed}q", q, long_count) for q in near.LONG_RATIOS}
        decays(r, structure, md, long_ones, radius)
        figure, axes = plt.subplots(1, 2, figsize=(10, 4.2))
        near.ranking(axes, structure, md[0.99], radius, "phi/phi_J = 0.99")
        found = nj.prediction(md[0.99], structure)
        for tau in (2, 100):
            r.add("3.15", f"area under the ROC curve, sign of <dr_c> by C_c, tau = {tau}", "> 0.5", found.c_area[at(tau)])
            r.add("3.15", f"the same, top tenth of <|dr|^2> by S, tau = {tau}", "> 0.5", found.s_area[at(tau)])
        r.picture(figure, "motion_md_ranking")
    r.write()


if __name__ == "__main__":
    main()
