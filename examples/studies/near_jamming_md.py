#!/usr/bin/env python3
"""How well the contact network predicts the motion of hard spheres just below jamming: isoconfigurational runs.

usage: near_jamming_md.py FOLDER PICTURE.png [--large] [--quenched] [--runs RUNS] [--long-runs RUNS] [--seed SEED]
Default: 100 runs at five densities. --large: 5000 runs at seven densities and 1000 to tau = 1e4 at four, four hours
of one core (20 long runs: 25 minutes). Long runs end beyond the cage's edge: the MSD reaches its plateau.
--quenched: the packing by sequential linear programs from random spheres, as published, not by growth.
Runs are saved in FOLDER; a study that was stopped continues. Small and large ones need folders of their own.
Needs jam, numpy, scipy, matplotlib. Prints tables.

Source: R. Diaz Hernandez Rojas, PhD thesis (Sapienza 2021), chapter 3. Expected: K falls by at most a decade while the MSD grows
by two; curves fall together against MSD / (phi_J - phi)^nu with nu = 1.80 for C and 1.65 for S; median |dr|^2 = 0.75 of its mean.
"""
import near_jamming_common as common
import numpy as np
from near_jamming_common import INSTANTS, MD_EXPONENTS, NAMES, plt

import jam
from jam import near_jamming as nj


def table(ensembles, structure, errors):
    print("| phi/phi_J | tau | time | MSD | " + " | ".join(NAMES.values()) + " |")
    print("|---" * (4 + len(NAMES)) + "|")
    for ratio, runs in ensembles.items():
        k, e = nj.correlations(runs, structure), nj.correlation_errors(runs, structure, errors)
        for m, tau in enumerate(common.taus(runs)):
            if tau in (2, 10, 20, 100, 300, 1000, 10000):
                cells = " | ".join(f"{k[name][m]:.3f}({e[name][m]:.3f})" for name in NAMES)
                print(f"| {ratio} | {tau:g} | {runs.time[m]:.3g} | {runs.msd[m]:.2e} | {cells} |")


def draw(ensembles, long_ones, structure, exponents, picture):
    figure, axes = plt.subplots(2, 3, figsize=(13, 7.6))
    for color, (ratio, runs) in zip(plt.cm.viridis(np.linspace(0, 0.9, len(ensembles))), ensembles.items()):
        k = nj.correlations(runs, structure)
        label = f"phi/phi_J = {ratio}"
        axes[0, 0].errorbar(
            common.taus(runs), runs.time / runs.time[0], runs.deviation("time") / runs.time[0], color=color, label=label
        )
        axes[0, 1].loglog(common.taus(runs), runs.msd, ".-", color=color)
        axes[0, 2].semilogx(common.taus(runs), k["variance"], ".-", color=color)
        for row, name in ((axes[1, 0], "c"), (axes[1, 1], "s")):
            row.loglog(runs.msd / (1 - ratio) ** exponents[name].value, k[name], ".-", color=color, label=label)
    for ratio, runs in long_ones.items():
        color = plt.cm.viridis(0.9 * list(ensembles).index(ratio) / (len(ensembles) - 1))
        k = nj.correlations(runs, structure)
        axes[0, 1].loglog(common.taus(runs), runs.msd, "-", color=color, lw=1)
        for row, name in ((axes[1, 0], "c"), (axes[1, 1], "s")):
            row.loglog(runs.msd / (1 - ratio) ** exponents[name].value, k[name], "-", color=color, lw=1)
    axes[0, 0].set(xscale="log", yscale="log", xlabel="tau", ylabel="time over that at tau = 1")
    axes[0, 1].set(xlabel="tau", ylabel="MSD")
    tau = np.array([1.0, 5.0])
    first = next(iter(ensembles.values()))
    axes[0, 1].loglog(tau, first.msd[0] * tau**2, "k--", lw=1, label="slope 2")
    axes[0, 2].axhspan(-0.06, 0.06, color="0.9")
    bare = nj.correlations(ensembles[0.995], structure, rattlers=False)["variance"]
    axes[0, 2].semilogx(INSTANTS, bare, "k--", lw=1, label="0.995, without rattlers")
    axes[0, 2].legend(fontsize=7)
    axes[0, 2].set(ylim=(-0.3, 0.3), xlabel="tau", ylabel="K[|C_c|, Var dr_c]")
    for axis, name in ((axes[1, 0], "c"), (axes[1, 1], "s")):
        e = exponents[name]
        axis.set(
            xlabel=f"MSD / (1 - phi/phi_J)^{e.value:.2f}",
            ylabel=NAMES[name],
            title=f"nu = {e.value:.2f} +- {e.error:.3f}, thesis {MD_EXPONENTS[name]:.2f}",
        )
    axes[0, 0].legend(fontsize=7)
    axes[0, 1].legend(fontsize=7)
    ratio = min(ensembles, key=lambda r: abs(r - 0.995))
    runs = ensembles[ratio]
    m = list(common.taus(runs)).index(10)
    c, dr = structure.c[:, 2], runs.mean("displacement")[m][:, 2]
    axes[1, 2].plot(c[~structure.rattlers], dr[~structure.rattlers], ".", ms=2)
    axes[1, 2].plot(c[structure.rattlers], dr[structure.rattlers], "r.", ms=3, label="rattlers")
    axes[1, 2].set(xlabel="C_z", ylabel="<dz>", title=f"{ratio}, tau = 10: K = {jam.statistics.spearman(c, dr):.2f}")
    axes[1, 2].legend(fontsize=7)
    common.save(figure, picture)


def main():
    args = common.arguments(__doc__, "quenched", runs=100, long_runs=0, seed=1)
    ratios = (0.9, 0.93) * args.large + common.RATIOS
    packing, name = common.make_packing(args.seed, quenched=args.quenched), f"{args.seed}{'q' * args.quenched}"
    structure = nj.predictors(packing)
    ensembles = {ratio: common.md_runs(packing, args.folder, name, ratio, args.runs) for ratio in ratios}
    table(ensembles, structure, 20)
    long_ones = {}
    if args.long_runs:
        for ratio in common.LONG_RATIOS:
            long_ones[ratio] = common.long_md_runs(packing, args.folder, name, ratio, args.long_runs)
        table(long_ones, structure, 20)
    print(
        f"median over mean of |dr|^2 at tau = 20, 0.995: {nj.median_over_mean(ensembles[0.995].kept[INSTANTS.index(20)]):.3f} (0.75)"
    )
    exponents = {}
    for kind in "cs":
        # Last the densities that are drawn with.
        for least in (0.98, 0.99, 0.96):
            near = {ratio: runs for ratio, runs in ensembles.items() if ratio >= least}
            for between in ((0.6, 0.8), (0.4, 0.6), None):
                e = nj.collapse_exponent(list(near.values()), structure, [1 - r for r in near], kind, 10, between)
                at = f"K in {between}" if between else "all K"
                print(
                    f"{NAMES[kind]}, ratios from {least}, {at}: nu = {e.value:.3f} +- {e.error:.3f}, thesis {MD_EXPONENTS[kind]}"
                )
        exponents[kind] = e
    without = nj.correlations(ensembles[0.995], structure, rattlers=False)
    print("0.995 without rattlers: " + ", ".join(f"{NAMES[k]} {without[k][5]:.3f}" for k in NAMES) + " at tau = 10")
    p = nj.prediction(ensembles[0.99], structure)
    print("| tau | top and bottom tenth of C: <dr_c> | of S: <|dr|^2> | ROC area of C | of S |\n|---|---|---|---|---|")
    for m, tau in enumerate(INSTANTS):
        if tau in (2, 10, 100):
            print(
                f"| {tau} | {p.c_top[m]:.2e}, {p.c_bottom[m]:.2e} | {p.s_top[m]:.2e}, {p.s_bottom[m]:.2e} "
                f"| {p.c_area[m]:.3f} | {p.s_area[m]:.3f} |"
            )
    draw(ensembles, long_ones, structure, exponents, args.picture)


if __name__ == "__main__":
    main()
