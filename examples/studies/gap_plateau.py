#!/usr/bin/env python3
"""Gaps near contact at several pressures and two growth rates: a plateau up to h ~ 1/p, whose height the pressure fixes, then a power law.

usage: gap_plateau.py PICTURE.png [--large] [--n N] [--seeds K] [--result FILE.json#NAME]
Small: 4 systems of N = 256, 300 collisions of each sphere observed. Large: 20 of N = 1024, 1000.
Needs the Python package `jam`, numpy, matplotlib. Prints a table.

For equal spheres in d = 3 p = 1 + 4 phi g(sigma), so the histogram, in units of an ideal gas, starts at (p - 1) / (4 phi). Far
beyond 1/p it falls as h^-gamma, gamma = 0.41269 (Charbonneau et al., Nat. Commun. 5, 3725 (2014)). The rate of growth, here two
that differ by ten, has no visible effect (R. Diaz Hernandez Rojas, PhD thesis, Sapienza 2021: 20 systems, several p and rates).
"""
import argparse
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import jam

sys.path.append(str(Path(__file__).resolve().parents[2] / "bindings/docs"))
import figures  # noqa: E402

TARGETS, RATES = (1e4, 1e6, 1e8), (3e-3, 3e-4)
COLUMNS = ["G", "p", "systems", "(p-1)/(4 phi)", "first bin, h < 0.05/p, over it", "exponent from h = 3000/p to 0.05"]


def observed(n, seed, rate, collisions):
    """[(p, height, lower, upper edges, density)] at each target."""
    found = []
    with jam.System.random(n, seed=seed) as packing:
        packing.compress([(1e-2, 500.0)])
        for target in TARGETS:
            packing.compress([(rate, target)])
            packing.run(0.2 * collisions)
            packing.observe(gap_bins=60, gap_min=0.05 / target, gap_max=1.0, sample_every=10)
            p = packing.run(collisions).pressure
            gaps = packing.observed_gaps()
            found.append((p, (p - 1) / (4 * packing.packing_fraction), gaps.low, gaps.high, gaps.density))
    return found


def mean_error(values):
    error = np.std(values, ddof=1) / len(values) ** 0.5 if len(values) > 1 else 0.0
    return {"value": float(np.mean(values)), "error": float(error)} if error > 0 else float(np.mean(values))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("picture")
    parser.add_argument("--large", action="store_true")
    parser.add_argument("--n", type=int)
    parser.add_argument("--seeds", type=int)
    parser.add_argument("--result", help="rows of the table, as JSON")
    o = parser.parse_args()
    n, seeds, collisions = o.n or (1024 if o.large else 256), o.seeds or (20 if o.large else 4), 1000.0 if o.large else 300.0
    figure, axes = plt.subplots(figsize=(6.8, 4.8))
    rows = []
    for rate, style in zip(RATES, ("-", "--")):
        every = [observed(n, seed, rate, collisions) for seed in range(1, seeds + 1)]
        for k, target in enumerate(TARGETS):
            p, height, low, high, _ = every[0][k]
            middle = np.sqrt(np.maximum(low, high[0] / 4) * high)
            density = np.mean([one[k][4] for one in every], axis=0)
            tail = (middle > 3e3 / target) & (middle < 0.05)  # below, pairs with small forces
            slopes = []
            for one in every:
                use = tail & (one[k][4] > 0)
                if use.sum() > 5:
                    slopes.append(np.polyfit(np.log(middle[use]), np.log(one[k][4][use]), 1)[0])
            first = [one[k][4][0] / one[k][1] for one in every]
            heights = float(np.mean([one[k][1] for one in every]))
            rows.append([rate, target, seeds, heights, mean_error(first), mean_error(slopes) if slopes else None])
            print("| " + " | ".join(figures.cell(x) for x in rows[-1]) + " |", flush=True)
            axes.loglog(middle, density, style, color=f"C{k}", lw=1, label=f"p = {target:g}, G = {rate:g}")
            axes.axhline(heights, color=f"C{k}", ls=":", lw=1)
    h = np.logspace(-7, -1.3, 20)
    axes.loglog(h, 0.42 * h**-0.41269, "k--", lw=1, label="slope -0.413")
    axes.set(xlabel="gap h", ylabel="density of pairs over that of an ideal gas", title=f"N = {n}, mean of {seeds} systems")
    axes.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(o.picture, dpi=80)
    if o.result:
        words = f"gap_plateau.py PICTURE.png{' --large' * o.large} --n {n} --seeds {seeds}"
        figures.save(o.result, words, COLUMNS, rows)


if __name__ == "__main__":
    main()
