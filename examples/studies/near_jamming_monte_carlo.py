#!/usr/bin/env python3
"""How well the contact network predicts the motion of soft spheres at phi_J: Metropolis runs at nine pairs (alpha, T).

usage: near_jamming_monte_carlo.py FOLDER PICTURE.png [--large] [--runs RUNS] [--seed SEED]
Default: 40 runs of 120 sweeps for each pair. --large: 1000 runs of 250 sweeps, a quarter of an hour of one core.
Runs are saved in FOLDER; a study that was stopped goes on. Needs jam, numpy, scipy, matplotlib. Prints a table.

Source: R. Diaz Hernandez Rojas, PhD thesis (Sapienza 2021), chapter 3: U = |2R - r|^alpha. Temperatures are ours but for
T = 1e-4 at alpha = 2: the three of each alpha give the same typical overlaps T^(1/alpha). Expected: curves of K against
MSD / T^nu fall together; nu = 0.84, 0.64, 0.51 for C and 0.45, 0.40, 0.35 for S at alpha = 3/2, 2, 5/2.
"""
import argparse
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from near_jamming_md import make_packing  # noqa: E402

from jam import near_jamming as nj  # noqa: E402

TEMPERATURES = {1.5: (1e-4, 3.16e-4, 1e-3), 2.0: (4.64e-6, 2.15e-5, 1e-4), 2.5: (2.15e-7, 1.47e-6, 1e-5)}
THESIS = {1.5: (0.84, 0.45), 2.0: (0.64, 0.40), 2.5: (0.51, 0.35)}


def instants_of(last):
    return np.unique(np.round(np.geomspace(2, last, 12)))


def ensemble(packing, folder, name, alpha, temperature, instants, count):
    """Runs at one energy and temperature, from the file of an earlier call where it holds them."""
    return nj.campaign(
        packing,
        os.path.join(folder, f"mc_{name}_{alpha}_{temperature}.npz"),
        instants,
        count,
        monte_carlo=dict(alpha=alpha, temperature=temperature),
        block=20 if count >= 200 else 2,
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("picture")
    parser.add_argument("--large", action="store_true")
    parser.add_argument("--runs", type=int)
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    count, last = args.runs or (1000 if args.large else 40), 250 if args.large else 120
    instants = instants_of(last)
    os.makedirs(args.folder, exist_ok=True)
    packing = make_packing(args.seed)
    structure = nj.predictors(packing)
    figure, axes = plt.subplots(2, 3, figsize=(13, 7.6))
    print(
        "| alpha | T | step | acceptance | beta <E>/N at the end | MSD | K[C, <dr>] | K[S, <|dr|^2>] | K[|C|, Var] | caged |"
    )
    print("|---" * 10 + "|")
    for column, (alpha, temperatures) in enumerate(TEMPERATURES.items()):
        ensembles = []
        for temperature in temperatures:
            runs = ensemble(packing, args.folder, f"{args.seed}", alpha, temperature, instants, count)
            k = nj.correlations(runs, structure)
            print(
                f"| {alpha} | {temperature:g} | {runs.step:.3g} | {runs.acceptance:.2f} "
                f"| {runs.mean('energy')[-1] / temperature:.3f} | {runs.msd[-1]:.2e} | {k['c'][-1]:.2f} | {k['s'][-1]:.2f} "
                f"| {k['variance'][-1]:.2f} | {nj.is_caged(runs, packing)[-1]} |"
            )
            ensembles.append(runs)
        for row, kind in enumerate("cs"):
            e = nj.collapse_exponent(ensembles, structure, temperatures, kind, 10)
            print(f"alpha = {alpha}, {kind.upper()}: nu = {e.value:.3f} +- {e.error:.3f}, thesis {THESIS[alpha][row]}")
            for runs, temperature in zip(ensembles, temperatures):
                k = nj.correlations(runs, structure)[kind]
                axes[row, column].loglog(runs.msd / temperature**e.value, k, ".-", label=f"T = {temperature:g}")
            axes[row, column].set(
                xlabel=f"MSD / T^{e.value:.2f}",
                ylabel="K[C, <dr>]" if kind == "c" else "K[S, <|dr|^2>]",
                title=f"alpha = {alpha}: nu = {e.value:.2f}({e.error:.2f}), thesis {THESIS[alpha][row]}",
            )
            axes[row, column].legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(args.picture, dpi=75)


if __name__ == "__main__":
    main()
