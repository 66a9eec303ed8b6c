#!/usr/bin/env python3
"""Do other packings give the same decorrelation? K against the MSD at one density, for grown and for quenched packings.

usage: near_jamming_packings.py FOLDER PICTURE.png [--large] [--runs RUNS]
Packings: seeds 1 and 2 by growth; seed 1 by sequential linear programs from random spheres, as published. 0.99, 0.995, 0.999.
Runs are saved in FOLDER. Needs jam, numpy, scipy, matplotlib. Prints a table.

A packing is a sample of spheres: its error of K comes from resampling spheres, that of the runs from resampling runs.
Expected: the same curves within these errors. Source: R. Diaz Hernandez Rojas, PhD thesis (Sapienza 2021), chapter 3.
"""
import near_jamming_common as common
import numpy as np
from near_jamming_common import INSTANTS, NAMES, plt

import jam
from jam import near_jamming as nj

PACKINGS = {"seed 1": (1, False), "seed 2": (2, False), "seed 1, quenched": (1, True)}
RATIOS = (0.99, 0.995, 0.999)
SHOWN = (2, 10, 20, 100)


def sphere_errors(runs, structure, times=50):
    """Standard errors (m,) of K[C, <dr>], K[S, <|dr|^2>] and K[|C|, Var], over resampled spheres."""
    draw, n = np.random.default_rng(1), len(structure.s)
    first, square, spread = runs.mean("displacement"), runs.mean("distance2"), runs.variance()
    made = {"c": [], "s": [], "variance": []}
    for _ in range(times):
        i = draw.integers(0, n, n)
        c = structure.c[i]
        made["c"].append([jam.statistics.spearman_components(c, dr[i])[0] for dr in first])
        made["s"].append([jam.statistics.spearman(structure.s[i], r2[i]) for r2 in square])
        made["variance"].append([jam.statistics.spearman_components(np.abs(c), v[i])[0] for v in spread])
    return {name: np.std(values, axis=0, ddof=1) for name, values in made.items()}


def main():
    args = common.arguments(__doc__, runs=100)
    figure, axes = plt.subplots(1, 3, figsize=(14, 4.4))
    print(
        "| packing | phi/phi_J | tau | MSD / sigma^2 | K[C, <dr>] | K[S, <|dr|^2>] | K[|C|, Var] | without rattlers |"
    )
    print("|---" * 8 + "|")
    for color, (label, (seed, quenched)) in zip(("C0", "C1", "C2"), PACKINGS.items()):
        packing = common.make_packing(seed, quenched=quenched)
        structure = nj.predictors(packing)
        for ratio, style in zip(RATIOS, (":", "-", "--")):
            runs = common.md_runs(packing, args.folder, f"{seed}{'q' * quenched}", ratio, args.runs)
            k, e = nj.correlations(runs, structure), sphere_errors(runs, structure)
            bare = nj.correlations(runs, structure, rattlers=False)["variance"]
            msd = runs.msd / packing.diameters.mean() ** 2
            for axis, name in zip(axes, ("c", "s", "variance")):
                some = slice(None, None, 3)
                axis.plot(msd, k[name], style, color=color, label=f"{label}, {ratio}")
                axis.errorbar(msd[some], k[name][some], e[name][some], fmt=".", color=color)
            for tau in SHOWN:
                m = INSTANTS.index(tau)
                cells = " | ".join(f"{k[name][m]:.3f}({e[name][m]:.3f})" for name in ("c", "s", "variance"))
                print(f"| {label} | {ratio} | {tau} | {msd[m]:.3g} | {cells} | {bare[m]:.3f} |")
    for axis, name in zip(axes, ("c", "s", "variance")):
        axis.set(xscale="log", xlabel="MSD / sigma^2", ylabel=NAMES[name])
    axes[2].axhspan(-0.06, 0.06, color="0.9")
    axes[0].legend(fontsize=6)
    common.save(figure, args.picture)


if __name__ == "__main__":
    main()
