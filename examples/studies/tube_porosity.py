#!/usr/bin/env python3
"""Porosity of jammed spheres in a tube against the distance from its wall, beside two correlations for packed beds.

usage: tube_porosity.py PICTURE.png [--large] [--seeds K] [--result FILE.json#NAME]
Small: 6 packings for each of the ratios 5 and 9 of tube and sphere. Large: 30.
Needs the Python package `jam`, numpy, scipy, matplotlib. Prints a table.

The solid fraction is exact (System.solid_profile). z is the distance from the wall in sphere diameters, D the ratio:
    A. de Klerk, AIChE J. 49, 2022 (2003): 2.14 z^2 - 2.53 z + 1 up to z = 0.637, then
        e_b + 0.29 exp(-0.6 z) cos(2.3 pi (z - 0.16)) + 0.15 exp(-0.9 z), with e_b of the packing
    G. E. Mueller, Powder Technol. 72, 269 (1992): e_b + (1 - e_b) J0(a z) exp(-b z), with a = 7.45 - 3.15 / D,
        b = 0.315 - 0.725 / D, e_b = 0.365 + 0.22 / D
The coefficients are not checked against the papers. Both are fits to packed beds, with a porosity of 0.36 to 0.40 far from the wall.
Jammed packings are denser.
"""
import argparse
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from scipy.signal import argrelextrema
from scipy.special import j0

import jam

sys.path.append(str(Path(__file__).resolve().parents[2] / "bindings/docs"))
import figures  # noqa: E402

RATIOS = (5.0, 9.0)
COLUMNS = ["curve", "D / d", "first minimum at z", "porosity there", "first maximum at z", "porosity there ", "second minimum at z"]


def de_klerk(z, bulk):
    far = bulk + 0.29 * np.exp(-0.6 * z) * np.cos(2.3 * np.pi * (z - 0.16)) + 0.15 * np.exp(-0.9 * z)
    return np.where(z <= 0.637, 2.14 * z**2 - 2.53 * z + 1, far)


def mueller(z, ratio):
    bulk = 0.365 + 0.22 / ratio
    return bulk + (1 - bulk) * j0((7.45 - 3.15 / ratio) * z) * np.exp(-(0.315 - 0.725 / ratio) * z)


def packed(ratio, seed):
    """D / d at jamming, and (z, porosity) in shells of 0.05 d; None where the packing is not jammed."""
    length = max(6.0, 40.0 / ratio)
    n = round(0.6 * 1.5 * ratio**2 * length)
    with jam.System.random(n, seed=seed, packing_fraction=0.2, cell=[ratio, ratio, length], container="cylinder") as packing:
        packing.compress([(1e-2, 1e4)])
        if not packing.crunch().jammed:
            return None
        d = packing.diameters[0]
        shells = packing.solid_profile(3, round(10 * ratio))
        return ratio / d, (ratio / 2 - (shells.low + shells.high) / 2) / d, 1 - shells.solid


def extrema(z, porosity):
    """The first minimum, maximum and second minimum, each by a parabola through three points."""
    order = np.argsort(z)
    z, porosity, found = z[order], porosity[order], []
    for kind in (np.less, np.greater, np.less):
        at = [k for k in argrelextrema(porosity, kind, order=3)[0] if not found or z[k] > found[-1][0] + 0.2]
        if not at:
            return None
        a, b, c = np.polyfit(z[at[0] - 1 : at[0] + 2], porosity[at[0] - 1 : at[0] + 2], 2)
        found.append((-b / (2 * a), c - b * b / (4 * a)))
    return [found[0][0], found[0][1], found[1][0], found[1][1], found[2][0]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("picture")
    parser.add_argument("--large", action="store_true")
    parser.add_argument("--seeds", type=int)
    parser.add_argument("--result", help="rows of the table, as JSON")
    o = parser.parse_args()
    seeds, rows = o.seeds or (30 if o.large else 6), []
    figure, grid = plt.subplots(1, len(RATIOS), figsize=(10, 3.8), constrained_layout=True, sharey=True)
    for axes, ratio in zip(grid, RATIOS):
        made = [m for seed in range(1, seeds + 1) if (m := packed(ratio, seed))]
        if len(made) < seeds:
            print(f"D = {ratio} d: {seeds - len(made)} of {seeds} packings are not jammed and left out", flush=True)
        wide, z = np.mean([m[0] for m in made]), np.mean([m[1] for m in made], axis=0)
        all_of = np.array([m[2] for m in made])
        mean, error = all_of.mean(0), all_of.std(0, ddof=1) / len(made) ** 0.5
        bulk = mean[(z > 1.5)].mean()
        fine = np.linspace(0.02, z.max(), 2000)
        curves = ((f"{len(made)} packings", z, mean), ("de Klerk", fine, de_klerk(fine, bulk)), ("Mueller", fine, mueller(fine, wide)))
        axes.errorbar(z, mean, error, fmt="o", ms=3, color="#2b6cb0", label=f"{len(made)} jammed packings", zorder=3)
        axes.plot(fine, curves[1][2], color="#c05621", lw=1, label="de Klerk 2003")
        axes.plot(fine, curves[2][2], "--", color="0.4", lw=1, label="Mueller 1992")
        axes.set(xlabel="distance from the wall / d", title=f"D = {wide:.2f} d", ylim=(0, 1), xlim=(0, None))
        for name, *curve in curves:
            at = extrema(*curve)
            rows.append([name, float(wide), *(float(x) for x in at)] if at else [name, float(wide), *[None] * 5])
            print(dict(zip(COLUMNS, rows[-1])), flush=True)
    grid[0].set_ylabel("porosity")
    grid[0].legend(frameon=False)
    figure.savefig(o.picture, dpi=100)
    if o.result:
        command = "tube_porosity.py PICTURE.png" + (" --large" if o.large else "") + (f" --seeds {o.seeds}" if o.seeds else "")
        figures.save(o.result, command, COLUMNS, rows)


if __name__ == "__main__":
    main()
