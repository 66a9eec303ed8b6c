#!/usr/bin/env python3
"""Critical laws of soft spheres above jamming, for three exponents of the energy.

usage: soft_scaling_laws.py PICTURE.png [N] [PACKINGS] [SMALLEST DISTANCE]
Each packing comes from random points at phi = 0.72 and is decompressed in steps to distances ln(R / R_J). The distance
is 3 ln(R / R_J) = dphi / phi to first order, so every packing is measured from its own phi_J. At each step: energy a
sphere e, pressure P, contacts z above isostatic, and the moduli B and G with pre-stress. O'Hern et al., Phys. Rev. E 68,
011306 (2003): e ~ x^alpha, P ~ x^(alpha - 1), G ~ x^(alpha - 3/2), B ~ x^(alpha - 2), z - z_c ~ x^(1/2).
Prints each exponent with its standard error over packings. Needs the Python package `jam`, numpy, matplotlib.
"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import jam  # noqa: E402

ALPHAS = (2.0, 2.5, 1.5)
LAWS = {  # quantity: exponent less alpha, or the exponent where it does not depend on alpha
    "e": (0.0, True),
    "P": (-1.0, True),
    "G": (-1.5, True),
    "B": (-2.0, True),
    "z - z_c": (0.5, False),
}


def ladder(n, seed, alpha, smallest):
    """Rows of a packing on its way down: distance, e, P, G, B, z - z_c."""
    packing = jam.System.random(n=n, seed=seed, packing_fraction=0.72, overlap="allow")
    rows = []
    for target in 10.0 ** np.arange(-2.0, np.log10(smallest) - 1e-9, -0.25):
        down = packing.decompress(alpha=alpha, distance=target, energy_factor=0.1, isostatic=0, crunch=0)
        if down.status != 0:
            break
        m = packing.moduli(stiffness="soft", prestress=1.0)
        stable = packing.n - down.rattlers
        rows.append(
            (down.distance, down.energy / n, down.pressure, m.shear, m.bulk, 2.0 * down.excess_contacts / stable)
        )
    return np.array(rows)


def slope(x, y):
    """Exponent of y ~ x^a by least squares of logarithms, where y is positive."""
    good = y > 0
    return np.polyfit(np.log(x[good]), np.log(y[good]), 1)[0] if good.sum() > 2 else np.nan


def main():
    picture = sys.argv[1]
    n, packings = int(sys.argv[2]) if len(sys.argv) > 2 else 256, int(sys.argv[3]) if len(sys.argv) > 3 else 4
    smallest = float(sys.argv[4]) if len(sys.argv) > 4 else 1e-6
    figure, axes = plt.subplots(1, len(LAWS), figsize=(3.4 * len(LAWS), 3.6))
    print(f"N = {n}, {packings} packings, distances 1e-2 to {smallest:g}")
    print("alpha  quantity  exponent  error   law")
    for alpha, colour in zip(ALPHAS, ("C0", "C1", "C2")):
        runs = [ladder(n, seed, alpha, smallest) for seed in range(1, packings + 1)]
        for column, ((name, (power, with_alpha)), axis) in enumerate(zip(LAWS.items(), axes), 1):
            law = power + alpha if with_alpha else power
            # The largest distances are beyond the laws' range: from 1e-3 down.
            slopes = [slope(r[r[:, 0] < 2e-3, 0], r[r[:, 0] < 2e-3, column]) for r in runs if len(r) > 4]
            error = np.nanstd(slopes, ddof=1) / np.sqrt(len(slopes)) if len(slopes) > 1 else np.nan
            print(f"{alpha:5.2f}  {name:8s}  {np.nanmean(slopes):8.4f}  {error:6.4f}  {law:5.2f}")
            for r in runs:
                axis.loglog(r[:, 0], np.where(r[:, column] > 0, r[:, column], np.nan), ".", ms=3, color=colour)
            r = runs[0]
            middle = len(r) // 2
            axis.loglog(
                r[:, 0],
                r[middle, column] * (r[:, 0] / r[middle, 0]) ** law,
                lw=0.8,
                color=colour,
                label=f"alpha {alpha:g}: {law:g}",
            )
            axis.set(xlabel="ln(R / R_J)", title=name)
    for axis in axes:
        axis.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(picture, dpi=120)


if __name__ == "__main__":
    main()
