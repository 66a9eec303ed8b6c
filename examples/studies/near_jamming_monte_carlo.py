#!/usr/bin/env python3
"""How well the contact network predicts the motion of soft spheres at phi_J: Metropolis runs at nine pairs (alpha, T).

usage: near_jamming_monte_carlo.py FOLDER PICTURE.png [--large] [--mc-runs RUNS] [--seed SEED]
Default: 40 runs of 250 sweeps for each pair. --large: 1000 runs, a quarter of an hour of one core.
Runs are saved in FOLDER; a study that was stopped continues. Needs jam, numpy, scipy, matplotlib. Prints a table.

Source: R. Diaz Hernandez Rojas, PhD thesis (Sapienza 2021), chapter 3: U = |2R - r|^alpha. Temperatures are ours but for
T = 1e-4 at alpha = 2: the three of each alpha give the same typical overlaps T^(1/alpha). Expected: curves of K against
MSD / T^nu fall together; nu = 0.84, 0.64, 0.51 for C and 0.45, 0.40, 0.35 for S at alpha = 3/2, 2, 5/2.
"""
import near_jamming_common as common
from near_jamming_common import MC_EXPONENTS, plt

from jam import near_jamming as nj


def main():
    args = common.arguments(__doc__, mc_runs=40, seed=1)
    packing = common.make_packing(args.seed)
    structure = nj.predictors(packing)
    figure, axes = plt.subplots(2, 3, figsize=(13, 7.6))
    print(
        "| alpha | T | step | acceptance | beta <E>/N at the end | MSD | K[C, <dr>] | K[S, <|dr|^2>] | K[|C|, Var] | caged |"
    )
    print("|---" * 10 + "|")
    for column, (alpha, temperatures) in enumerate(common.TEMPERATURES.items()):
        ensembles = []
        for temperature in temperatures:
            runs = common.mc_runs(packing, args.folder, args.seed, alpha, temperature, args.mc_runs)
            k = nj.correlations(runs, structure)
            print(
                f"| {alpha} | {temperature:g} | {runs.step:.3g} | {runs.acceptance:.2f} "
                f"| {runs.mean('energy')[-1] / temperature:.3f} | {runs.msd[-1]:.2e} | {k['c'][-1]:.2f} | {k['s'][-1]:.2f} "
                f"| {k['variance'][-1]:.2f} | {nj.is_caged(runs, packing)[-1]} |"
            )
            ensembles.append(runs)
        for row, kind in enumerate("cs"):
            e = nj.collapse_exponent(ensembles, structure, temperatures, kind, 10)
            print(
                f"alpha = {alpha}, {kind.upper()}: nu = {e.value:.3f} +- {e.error:.3f}, thesis {MC_EXPONENTS[alpha][kind]}"
            )
            for runs, temperature in zip(ensembles, temperatures):
                k = nj.correlations(runs, structure)[kind]
                axes[row, column].loglog(runs.msd / temperature**e.value, k, ".-", label=f"T = {temperature:g}")
            axes[row, column].set(
                xlabel=f"MSD / T^{e.value:.2f}",
                ylabel="K[C, <dr>]" if kind == "c" else "K[S, <|dr|^2>]",
                title=f"alpha = {alpha}: nu = {e.value:.2f}({e.error:.2f}), thesis {MC_EXPONENTS[alpha][kind]}",
            )
            axes[row, column].legend(fontsize=7)
    common.save(figure, args.picture)


if __name__ == "__main__":
    main()
