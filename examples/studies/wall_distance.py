#!/usr/bin/env python3
"""Jamming density against the distance of two walls: phi_J(H) = phi_bulk - C / H, as the layers at the walls fill space less well.

usage: wall_distance.py PICTURE.png [--large] [--seeds K] [--result FILE.json#NAME]
       wall_distance.py --disks N [--seeds K] [--result FILE.json#NAME]     how well N disks follow the law: (phi of periodic packings - phi) H
Small: 10 packings per point, 300 disks or 400 spheres. Large: 40, of 1200 and 1600.
Needs the Python package `jam`, numpy, matplotlib. Prints a table.

Half of the spheres are 1.4 times as wide, as in K. W. Desmond and E. R. Weeks, Phys. Rev. E 80, 051305 (2009), who found the law
and phi_bulk = 0.842 (d = 2) and 0.646 (d = 3); law and densities are not checked against the paper. H is in mean diameters. The fit
has H >= 4; the periodic packings are no part of it.
"""
import argparse
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import jam

sys.path.append(str(Path(__file__).resolve().parents[2] / "bindings/docs"))
import figures  # noqa: E402

DISTANCES, LEAST, PUBLISHED = (2.5, 3, 4, 5, 7, 10, 14), 4.0, {2: 0.842, 3: 0.646}
LOSSES = ["H", "phi_J", "(periodic - phi_J) H", "phi_bulk of a fit from this H", "chi^2 a degree of freedom"]
COLUMNS = ["d", "N", "packings per point", "phi_bulk of the fit", "periodic packings", "published", "C", "chi^2 a degree of freedom"]


def jammed(d, n, seed, height):
    """H in mean diameters and phi_J, of a jammed packing; without height periodic."""
    sizes = np.where(np.arange(n) % 2, 1.4, 1.0) / 1.2
    volume = {2: np.pi / 4, 3: np.pi / 6}[d] * (sizes**d).sum() / (PUBLISHED[d] - 0.3 / (height or np.inf))
    edge = (volume / height) ** (1 / (d - 1)) if height else volume ** (1 / d)
    cell, axis = [edge] * (d - 1) + [height or edge], "xyz"[d - 1]
    with jam.System.random(n, d, seed, diameters=sizes, cell=cell, walls=axis if height else "", packing_fraction=0.2) as packing:
        packing.compress([(1e-2, 1e4)])
        report = packing.crunch()
        return (packing.cell[-1, -1] / packing.diameters.mean(), packing.packing_fraction) if report.jammed else None


def point(d, n, seeds, height):
    """H, phi_J and its error over packings, and how many of them are jammed."""
    found = [f for seed in range(1, seeds + 1) if (f := jammed(d, n, seed, height))]
    return [np.mean([f[0] for f in found]), *mean_error([f[1] for f in found])], len(found)


def mean_error(values):
    return np.mean(values), np.std(values, ddof=1) / len(values) ** 0.5


def fit(x, y, error):
    """phi_bulk, C, their errors, chi^2 a degree of freedom of y = phi_bulk - C x."""
    a = np.stack([np.ones_like(x), -x], axis=1) / error[:, None]
    covariance = np.linalg.inv(a.T @ a)
    value = covariance @ a.T @ (y / error)
    chi2 = ((y - value[0] + value[1] * x) ** 2 / error**2).sum() / (len(x) - 2)
    return value, np.sqrt(np.diag(covariance) * max(1.0, chi2)), chi2


def disks(n, seeds, result):
    periodic = point(2, n, 2 * seeds, None)[0][1:]
    print(f"periodic: {periodic[0]:.5f} +- {periodic[1]:.5f}")
    points = []
    for height in (4, 7, 10, 14):
        points.append(point(2, n, seeds, height)[0])
        h, phi, error = points[-1]
        print(f"H = {h:.2f}: phi = {phi:.5f} +- {error:.5f}, (phi_periodic - phi) H = {(periodic[0] - phi) * h:.4f}", flush=True)
    rows = [[float(h), {"value": float(phi), "error": float(e)}, float((periodic[0] - phi) * h), None, None] for h, phi, e in points]
    for first in (0, 1):
        x, y, error = np.array(points[first:]).T
        value, errors, chi2 = fit(1 / x, y, error)
        print(f"fit from H = {x[0]:.2f}: phi_bulk = {value[0]:.5f} +- {errors[0]:.5f}, chi^2 a degree of freedom {chi2:.1f}")
        rows[first][3:] = [{"value": float(value[0]), "error": float(errors[0])}, float(chi2)]
    rows.append(["periodic", {"value": float(periodic[0]), "error": float(periodic[1])}, None, None, None])
    if result:
        figures.save(result, f"wall_distance.py --disks {n}" + (f" --seeds {seeds}" if seeds != 10 else ""), LOSSES, rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("picture", nargs="?")
    parser.add_argument("--disks", type=int)
    parser.add_argument("--large", action="store_true")
    parser.add_argument("--seeds", type=int)
    parser.add_argument("--result", help="rows of the table, as JSON")
    o = parser.parse_args()
    if o.disks:
        return disks(o.disks, o.seeds or 10, o.result)
    if not o.picture:
        parser.error("give the name of the picture")
    seeds, rows = o.seeds or (40 if o.large else 10), []
    figure, grid = plt.subplots(1, 2, figsize=(9.6, 3.8), constrained_layout=True)
    for axes, (d, n) in zip(grid, ((2, 300), (3, 400))):
        n *= 4 if o.large else 1
        points, fewest = [], seeds
        for height in (None, *DISTANCES):
            found, there = point(d, n, seeds, height)
            points.append(found)
            fewest = min(fewest, there)
            print(f"d = {d}, H = {height or 'periodic'}: phi_J {found[1]:.5f} +- {found[2]:.5f}, {there} of {seeds} packings jammed", flush=True)
        bulk, walled = points[0], np.array(points[1:])
        x, y, error = 1 / walled[:, 0], walled[:, 1], walled[:, 2]
        used = walled[:, 0] >= LEAST * 0.97
        value, of, chi2 = fit(x[used], y[used], error[used])
        axes.errorbar(x, y, error, fmt="o", color="#2b6cb0", ms=4, label="between walls")
        axes.errorbar([0], bulk[1], bulk[2], fmt="s", color="#c05621", ms=5, label="periodic")
        axes.plot([0, 1 / LEAST], value[0] - value[1] * np.array([0, 1 / LEAST]), color="0.3", lw=1)
        axes.plot([1 / LEAST, x.max()], value[0] - value[1] * np.array([1 / LEAST, x.max()]), ":", color="0.3", lw=1)
        axes.set(xlabel="mean diameter / distance of the walls", ylabel="jamming density", title=f"d = {d}")
        axes.legend(frameon=False)
        cells = [{"value": float(v), "error": float(e)} for v, e in ((value[0], of[0]), (bulk[1], bulk[2]), (value[1], of[1]))]
        rows.append([d, n, fewest, cells[0], cells[1], PUBLISHED[d], cells[2], float(chi2)])
        print(dict(zip(COLUMNS, rows[-1])), flush=True)
    figure.savefig(o.picture, dpi=100)
    if o.result:
        command = "wall_distance.py PICTURE.png" + (" --large" if o.large else "") + (f" --seeds {o.seeds}" if o.seeds else "")
        figures.save(o.result, command, COLUMNS, rows)


if __name__ == "__main__":
    main()
