#!/usr/bin/env python3
"""Gaps near contact at three pressures: a plateau up to h ~ 1/p, whose height the pressure fixes, then a power law.

usage: gap_plateau.py PICTURE.png [N [COLLISIONS]]       N spheres (1024), collisions per particle observed (1000)
Needs the Python package `jam`, numpy, matplotlib. Prints a table.

For equal spheres in d = 3 p = 1 + 4 phi g(sigma), so the histogram, in units of an ideal gas, starts at (p - 1) / (4 phi). Far
beyond 1/p it falls as h^-gamma, gamma = 0.41269 (Charbonneau et al., Nat. Commun. 5, 3725 (2014)).
"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import jam  # noqa: E402


def main(picture, n=1024, collisions=1000.0):
    figure, axes = plt.subplots(figsize=(6.4, 4.4))
    print("| p | (p-1)/(4 phi) | first bin, h < 0.05/p | ratio | exponent from h = 3000/p to 0.05 |")
    print("|---|---|---|---|---|")
    with jam.System.random(n) as packing:
        packing.compress([(1e-2, 500.0)])
        for target in (1e4, 1e6, 1e8):
            packing.compress([(1e-3, target)])
            packing.run(200)
            packing.observe(gap_bins=60, gap_min=0.05 / target, gap_max=1.0, sample_every=10)
            p = packing.run(collisions).pressure
            gaps = packing.observed_gaps()
            height = (p - 1) / (4 * packing.packing_fraction)
            middle = np.sqrt(np.maximum(gaps.low, gaps.high[0] / 4) * gaps.high)
            tail = (middle > 3e3 / target) & (middle < 0.05) & (gaps.density > 0)  # below, pairs with small forces
            slope = (
                f"{np.polyfit(np.log(middle[tail]), np.log(gaps.density[tail]), 1)[0]:.2f}" if tail.sum() > 5 else ""
            )
            print(
                f"| {p:.4g} | {height:.4g} | {gaps.density[0]:.4g}({gaps.error[0]:.1g}) | {gaps.density[0] / height:.3f} | {slope} |"
            )
            (line,) = axes.loglog(middle, gaps.density, ".-", ms=4, label=f"p = {target:g}")
            axes.axhline(height, color=line.get_color(), ls=":", lw=1)
    h = np.logspace(-7, -1.3, 20)
    axes.loglog(h, 0.42 * h**-0.41269, "k--", lw=1, label="slope -0.413")
    axes.set_xlabel("gap h")
    axes.set_ylabel("density of pairs over that of an ideal gas")
    axes.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1], *map(int, sys.argv[2:3]), *map(float, sys.argv[3:4]))
