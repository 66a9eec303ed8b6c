#!/usr/bin/env python3
"""Do curves of decorrelation collapse with one exponent? The exponent of neighbouring densities or temperatures against K.

usage: near_jamming_exponents.py FOLDER PICTURE.png [--large] [--runs RUNS] [--mc-runs RUNS]
Uses the runs in FOLDER and makes those that are missing. Needs jam, numpy, scipy, matplotlib. Prints tables.

At a value of K, two curves of K against the MSD lie at two MSDs. Their ratio is the ratio of the controls (phi_J - phi or T)
to the power nu. One exponent for all K and all pairs is what a collapse asks for. Source: R. Diaz Hernandez Rojas, PhD thesis
(Sapienza 2021), chapter 3, where exponents were chosen by eye: 1.80 and 1.65; 0.84, 0.64, 0.51 and 0.45, 0.40, 0.35.
"""
import near_jamming_common as common
import numpy as np
from near_jamming_common import MC_EXPONENTS, MD_EXPONENTS, NAMES, plt

import jam
from jam import near_jamming as nj

BANDS = [(low, low + 0.1) for low in np.round(np.arange(0.2, 0.75, 0.05), 2)]
RESAMPLES = 20


def exponents(runs, control, structure, kind):
    """nu and its error over blocks of runs, (pairs of neighbours, bands of K)."""
    blocks = min(r.blocks for r in runs)

    def values(weights):
        curves = []
        for r in runs:
            padded = np.concatenate([weights, np.full(r.blocks - blocks, float((weights == 1).all()))])
            curves.append(nj.decay_curve(r, structure, kind, padded))
        made = np.full((len(runs) - 1, len(BANDS)), np.nan)
        for p in range(len(runs) - 1):
            (x, k), (y, q) = curves[p], curves[p + 1]
            for b, (low, high) in enumerate(BANDS):
                if max(k[-1], q[-1]) <= 0.5 * (low + high) <= min(k[0], q[0]):
                    made[p, b] = jam.statistics.collapse([x, y], [k, q], control[p : p + 2], 10, (low, high))
        return made

    resampled = jam.statistics.bootstrap(values, blocks, RESAMPLES)
    return values(np.ones(blocks)), np.ma.masked_invalid(resampled).std(0, ddof=1).filled(np.nan)


def show(axis, title, labels, runs, control, structure, kind, thesis):
    nu, error = exponents(runs, control, structure, kind)
    for p in range(len(runs) - 1):
        pair = f"{labels[p]}, {labels[p + 1]}"
        axis.errorbar([sum(b) / 2 for b in BANDS], nu[p], error[p], fmt=".-", label=pair)
        cells = " | ".join("" if np.isnan(v) else f"{v:.2f}({e:.2f})" for v, e in zip(nu[p][::2], error[p][::2]))
        print(f"| {title} | {pair} | {cells} | {thesis:.2f} |")
    axis.axhline(thesis, color="k", ls="--", lw=1)
    axis.set(title=title, xlabel="K", xlim=(0.2, 0.85))
    axis.legend(fontsize=6)


def main():
    args = common.arguments(__doc__, runs=100, mc_runs=40)
    packing = common.make_packing(1)
    structure, ratios = nj.predictors(packing), common.RATIOS
    near = [common.md_runs(packing, args.folder, 1, q, args.runs) for q in ratios]
    print("| densities | K | nu for C | nu for S |\n|---|---|---|---|")
    for least, between in ((0.96, None), (0.98, (0.6, 0.8)), (0.99, (0.6, 0.8))):
        some = [k for k, q in enumerate(ratios) if q >= least]
        control = [1 - ratios[k] for k in some]
        found = [nj.collapse_exponent([near[k] for k in some], structure, control, kind, 10, between) for kind in "cs"]
        print(f"| {least} to 0.999 | {between or 'all'} | " + " | ".join(f"{e.value:.3f}({e.error:.3f})" for e in found) + " |")
    figure, axes = plt.subplots(2, 4, figsize=(15, 7))
    print("| | pair | " + " | ".join(f"K {low:.1f} .. {high:.1f}" for low, high in BANDS[::2]) + " | thesis |")
    print("|---" * (3 + len(BANDS[::2])) + "|")
    for row, kind in enumerate("cs"):
        name = "C" if kind == "c" else "S"
        show(axes[row, 0], f"MD, {name}", ratios, near, [1 - q for q in ratios], structure, kind, MD_EXPONENTS[kind])
        for column, (alpha, temperatures) in enumerate(common.TEMPERATURES.items(), 1):
            hot = [common.mc_runs(packing, args.folder, 1, alpha, t, args.mc_runs) for t in temperatures]
            labels = [f"{t:.3g}" for t in temperatures]
            thesis = MC_EXPONENTS[alpha][kind]
            show(axes[row, column], f"MC, alpha {alpha}, {name}", labels, hot, temperatures, structure, kind, thesis)
        axes[row, 0].set_ylabel(f"nu of {NAMES[kind]}")
    common.save(figure, args.picture)


if __name__ == "__main__":
    main()
