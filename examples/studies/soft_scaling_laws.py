#!/usr/bin/env python3
"""Critical laws of soft spheres above jamming, for three exponents of the energy.

usage: soft_scaling_laws.py PICTURE.png [N] [PACKINGS] [SMALLEST DISTANCE] [ROWS.json]
Each packing comes from random points at phi = 0.72 and is decompressed in steps to distances ln(R / R_J). The distance
is 3 ln(R / R_J) = dphi / phi to first order, so every packing is measured from its own phi_J. At each step: energy a
sphere e, pressure P, contacts z above isostatic, and the moduli B and G with pre-stress. O'Hern et al., Phys. Rev. E 68,
011306 (2003): e ~ x^alpha, P ~ x^(alpha - 1), G ~ x^(alpha - 3/2), B ~ x^(alpha - 2), z - z_c ~ x^(1/2).
An exponent is the a of A x^a exp(b sqrt(x)), fitted to the rows of all packings by least squares of relative errors. The last
factor is the leading correction: contacts that close change each quantity in proportion to their number, which grows as sqrt(x).
G and z - z_c are taken where (z - z_c) N / 2 is at least 16 contacts: below, small systems have other laws (Goodrich, Liu and
Nagel, Phys. Rev. Lett. 109, 095704 (2012)). Errors: jackknife over packings. Beside it stands a plain power law below 2e-3.
With ROWS.json, ladders are kept there one by one and a run that was stopped goes on.
Needs the Python package `jam`, numpy, scipy, matplotlib.
"""
import json
import os
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from scipy.optimize import least_squares

import jam

ALPHAS = (2.0, 2.5, 1.5)
LAWS = {  # quantity: exponent less alpha, or the exponent where it does not depend on alpha
    "e": (0.0, True),
    "P": (-1.0, True),
    "G": (-1.5, True),
    "B": (-2.0, True),
    "z - z_c": (0.5, False),
}
LEAST_EXCESS = 16  # contacts above isostatic, for G and z - z_c
NEAR = 2e-3  # distance below which a plain power law is fitted


def ladder(n, seed, alpha, smallest):
    """Rows of a packing on its way down: distance, e, P, G, B, z - z_c."""
    packing = jam.System.random(n=n, seed=seed, packing_fraction=0.72, overlap="allow")
    rows = []
    # Below alpha = 2 contacts stiffen as they open: Newton's method cannot follow those that flicker.
    minimiser = "newton" if alpha >= 2.0 else "lbfgs"
    for target in 10.0 ** np.arange(-2.0, np.log10(smallest) - 1e-9, -0.25):
        down = packing.decompress(
            alpha=alpha, distance=target, energy_factor=0.1, isostatic=0, crunch=0, minimiser=minimiser
        )
        if down.status != 0:
            break
        if rows and down.steps == 0:
            continue  # a step goes down by a factor and may pass several targets
        m = packing.moduli(stiffness="soft", prestress=1.0)
        stable = packing.n - down.rattlers
        rows.append(
            (down.distance, down.energy / n, down.pressure, m.shear, m.bulk, 2.0 * down.excess_contacts / stable)
        )
    return np.array(rows)


def power(x, y, correction):
    """a of A x^a, times exp(b sqrt(x)) where correction is set: least squares of relative errors, which take negative y too."""
    terms = np.transpose([np.ones(len(x)), np.log(x)] + ([np.sqrt(x)] if correction else []))
    first = np.linalg.lstsq(terms[y > 0], np.log(y[y > 0]), rcond=None)[0]
    return least_squares(lambda q: y / np.exp(terms @ q) - 1.0, first).x[1]


def exponent(runs, n, name, correction):
    """Exponent of one quantity over all packings, and its jackknife error."""
    column = 1 + list(LAWS).index(name)

    def of(rows):
        r = np.concatenate(rows)
        if not correction:
            r = r[r[:, 0] < NEAR]
        if name in ("G", "z - z_c"):
            r = r[r[:, 5] * n / 2 >= LEAST_EXCESS]
        return power(r[:, 0], r[:, column], correction) if np.sum(r[:, column] > 0) > 8 else np.nan

    left_out = [of(runs[:k] + runs[k + 1 :]) for k in range(len(runs))] if len(runs) > 1 else [np.nan]
    return of(runs), np.std(left_out) * np.sqrt(len(runs) - 1.0)


def ladders(n, packings, alpha, smallest, kept, file):
    """One array of rows a packing; what is in `kept` is taken from there, and what is made is added to the file."""
    for seed in range(1, packings + 1):
        key = f"{n} {seed} {alpha:g} {smallest:g}"
        if key not in kept:
            kept[key] = ladder(n, seed, alpha, smallest).tolist()
            if file:
                part = file.with_name(file.name + ".part")
                part.write_text(json.dumps(kept))
                os.replace(part, file)
        yield np.array(kept[key])


def main():
    picture = sys.argv[1]
    n, packings = int(sys.argv[2]) if len(sys.argv) > 2 else 256, int(sys.argv[3]) if len(sys.argv) > 3 else 4
    smallest = float(sys.argv[4]) if len(sys.argv) > 4 else 1e-6
    file = Path(sys.argv[5]) if len(sys.argv) > 5 else None
    kept = json.loads(file.read_text()) if file and file.exists() else {}
    figure, axes = plt.subplots(1, len(LAWS), figsize=(3.4 * len(LAWS), 3.6))
    print(f"N = {n}, {packings} packings, distances 1e-2 to {smallest:g}")
    print("alpha  quantity  exponent  error   law    plain    error")
    for alpha, colour in zip(ALPHAS, ("C0", "C1", "C2")):
        runs = [r for r in ladders(n, packings, alpha, smallest, kept, file) if len(r) > 4]
        if not runs:
            print(f"{alpha:5.2f}  no ladder with five rungs")
            continue
        for column, ((name, (power, with_alpha)), axis) in enumerate(zip(LAWS.items(), axes), 1):
            law = power + alpha if with_alpha else power
            found, plain = exponent(runs, n, name, True), exponent(runs, n, name, False)
            print(
                f"{alpha:5.2f}  {name:8s}  {found[0]:8.4f}  {found[1]:6.4f}  {law:5.2f}  {plain[0]:8.4f}  {plain[1]:6.4f}"
            )
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
