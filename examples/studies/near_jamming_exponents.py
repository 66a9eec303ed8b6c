#!/usr/bin/env python3
"""Do curves of decorrelation collapse with one exponent? The exponent for ranges of densities and of K: figure 3.16 of the thesis.

usage: near_jamming_exponents.py FOLDER [--large] [--runs RUNS]
Uses the runs in FOLDER and makes those that are missing. Needs jam, numpy, scipy, matplotlib. Prints a table.

At a value of K, two curves of K against the MSD lie at two MSDs. Their ratio is the ratio of phi_J - phi to the power nu. One
exponent for all K and all densities is what a collapse asks for. Source: R. Diaz Hernandez Rojas, PhD thesis (Sapienza 2021),
chapter 3, where exponents were chosen by eye: 1.80 and 1.65.
"""
import near_jamming_common as common

from jam import near_jamming as nj

RANGES = ((0.96, None), (0.98, (0.6, 0.8)), (0.99, (0.6, 0.8)), (0.995, (0.7, 0.8)))  # least density, range of K


def main():
    args = common.arguments(__doc__, picture=False, runs=100)
    packing = common.make_packing(1)
    structure = nj.predictors(packing)
    near = {q: common.md_runs(packing, args.folder, 1, q, args.runs) for q in common.RATIOS}
    print("| densities | K | nu for C | nu for S |\n|---|---|---|---|")
    for least, between in RANGES:
        some = {q: runs for q, runs in near.items() if q >= least}
        control = [1 - q for q in some]
        found = [nj.collapse_exponent(list(some.values()), structure, control, kind, 10, between) for kind in "cs"]
        print(f"| {least} to 0.999 | {between or 'all'} | " + " | ".join(f"{e.value:.3f}({e.error:.3f})" for e in found) + " |")


if __name__ == "__main__":
    main()
