#!/usr/bin/env python3
"""Slow growth through packing fraction 0.5 to 0.6 crystallises equal spheres in d = 3. The two-stage protocol does not.

usage: crystallisation.py PICTURE.png [N [SEEDS]]       N spheres (500), packings a rate (4)
Needs the Python package `jam`, numpy, matplotlib. Prints a table.

One rate from packing fraction 0.2 to 0.6, then 1e-2 to p = 1e4, where g(r) and the crystal score are taken: an FCC crystal has a
peak at sqrt 2 diameters, a glass has none there but a split one at sqrt 3 and 2. Freezing 0.494, melting 0.545.
"""
import sys
import time

import matplotlib.pyplot as plt
import numpy as np

import jam


def grown(n, seed, rate):
    """(score, packing fraction, r, g(r), seconds) of a packing at p = 1e4."""
    begin = time.process_time()
    with jam.System.random(n, seed=seed) as packing:
        packing.compress([dict(growth_rate=rate, packing_fraction=0.6, pressure=1e12), (1e-2, 500.0), (3e-3, 1e4)])
        packing.observe(r_bins=150, r_max=2.5, sample_every=20)
        packing.run(200)
        g = packing.observed_correlation()
        return packing.crystal_score(), packing.packing_fraction, g.r, g.g, time.process_time() - begin


def main(picture, n=500, seeds=4):
    figure, axes = plt.subplots(figsize=(6.4, 4.4))
    print("| G up to 0.6 | crystal score | packing fraction at p = 1e4 | seconds |")
    print("|---|---|---|---|")
    for k, rate in enumerate((1e-2, 1e-3, 3e-4, 1e-4)):
        runs = [grown(n, seed, rate) for seed in range(1, seeds + 1)]
        print(
            f"| {rate:g} | {', '.join(f'{r[0]:.2f}' for r in runs)} | {', '.join(f'{r[1]:.4f}' for r in runs)} | {np.mean([r[4] for r in runs]):.1f} |",
            flush=True,
        )
        axes.plot(runs[0][2], np.mean([r[3] for r in runs], axis=0) + 2 * k, lw=1, label=f"G = {rate:g}")
    for x, name in ((2**0.5, "$\\sqrt{2}$"), (3**0.5, "$\\sqrt{3}$"), (2.0, "2")):
        axes.axvline(x, color="k", ls=":", lw=0.8)
        axes.text(x, 12.2, name, ha="center")
    axes.set_xlim(0.95, 2.5)
    axes.set_ylim(0, 12)
    axes.set_xlabel("distance r / diameter")
    axes.set_ylabel("g(r), shifted by 2 for each rate")
    axes.legend(fontsize=8, loc="upper right")
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1], *map(int, sys.argv[2:4]))
