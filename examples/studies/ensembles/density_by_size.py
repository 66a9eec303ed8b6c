#!/usr/bin/env python3
"""phi_J against N at one growth rate: the trend that figure 2.8 of the thesis states.

usage: density_by_size.py [--large] [--folder DIR] [--only-read] [--out DIR]

Growth at kappa = 5e-3 to p = 500, then at kappa = 3e-4 (radius rate, G = 2 sqrt(3) kappa) to p = 1e7, crunch. Small: 40 to 10 packings of
N = 64 to 256. Large: 80 to 8 of N = 256 to 2048, five minutes.
"""
import matplotlib.pyplot as plt
import numpy as np
from common import G_OF_KAPPA, Results, arguments, mean_error, seeded

import jam

KAPPA, MAX_ORDER = 3e-4, 1.5
SMALL = {64: 40, 128: 20, 256: 10}
LARGE = {256: 80, 512: 40, 1024: 20, 2048: 8}


def jammed(n, seed):
    with jam.System.random(n, seed=seed) as packing:
        packing.compress([(5e-3 * G_OF_KAPPA, 500.0), (KAPPA * G_OF_KAPPA, 1e7)])
        report = packing.crunch()
        return {"phi_j": report.packing_fraction, "good": report.jammed and packing.crystal_score() < MAX_ORDER}


def main():
    o = arguments(__doc__.splitlines()[0]).parse_args()
    sizes, means = LARGE if o.large else SMALL, []
    r, (figure, axis) = Results(o, "density_by_size"), plt.subplots(figsize=(6, 4.2))
    for n, count in sizes.items():
        made = seeded(o, "density_by_size", f"n{n}_", count, lambda s: jammed(n, s))
        phi = [float(m["phi_j"]) for m in made if m is not None and m["good"]]
        means.append(mean_error(phi))
        r.add("2.8", f"phi_J, N = {n}, kappa = {KAPPA:g}", "rises with N", *means[-1])
    lg, (phi, error) = np.log10(list(sizes)), np.array(means).T
    (slope, _), cov = np.polyfit(lg, phi, 1, w=1 / error, cov="unscaled")
    r.add("2.8", f"rise of phi_J for each factor 10 in N, N = {min(sizes)} to {max(sizes)}", "> 0", slope, cov[0, 0] ** 0.5)
    axis.errorbar(list(sizes), phi, error, fmt="o", capsize=2)
    axis.set(xscale="log", xlabel="N", ylabel="phi_J, mean over packings")
    r.write(figure)


if __name__ == "__main__":
    main()
