#!/usr/bin/env python3
"""Gardner test: distances of clones of one glass against its pressure, their variance and skewness.

usage: clone_overlaps.py [--large] [--folder DIR] [--only-read] [--out DIR]

Growth (G = 1.732e-2 to p = 500, 1e-3 beyond) stops at p. Clones start from this configuration with velocities of their own. After
some time D_AB is the mean over spheres of |r_A - r_B|^2, D that of the displacement from the start. D_AB = 2 D when clones move
apart freely. In a simple glass D_AB and D soon have the value of the cage, with a narrow Gaussian distribution. Beyond a Gardner
transition D stays below D_AB, and variance and skewness of D_AB are large (L. Berthier et al., Proc. Natl. Acad. Sci. 113, 8397
(2016)). Spheres that left their cage (|dr| > LEFT in any clone) and the mean displacement are taken out. Small: N = 256 and 512, 8
clones of 16 glasses. Large: N = 512 to 2048, 10 of 50.
"""
from itertools import combinations

import matplotlib.pyplot as plt
import numpy as np
from common import Results, arguments, mean_error, seeded

import jam

PRESSURES = (30.0, 100.0, 300.0, 1e3, 1e4, 1e5)
INSTANTS = (1.0, 3.0, 10.0, 30.0, 100.0, 300.0)  # collisions of a sphere
LEFT = 0.5  # mean diameters


def clones(n, seed, pressure, count):
    """Displacements (clone, instant, sphere, axis) in mean diameters, the mean displacement taken out."""
    with jam.System.random(n, seed=seed) as glass:
        glass.compress([(1.732e-2, 500.0), (1e-3, pressure)] if pressure > 500 else [(1.732e-2, pressure)])
        begin, unit, found = glass.positions.copy(), glass.diameters.mean(), []
        rng = np.random.default_rng(seed)
        for _ in range(count):
            copy = glass.copy()
            velocities = rng.normal(size=(n, 3))
            copy.velocities = velocities - velocities.mean(axis=0)
            path = []
            for span in np.diff(INSTANTS, prepend=0.0):
                copy.run(span)
                moved = copy.positions - begin
                moved -= np.round(moved)
                path.append((moved - moved.mean(axis=0)) / unit)
            found.append(path)
        return {"r": np.array(found, np.float32)}


def squares(r):
    """D_AB of each pair and D of each clone, at each instant, over spheres that stay in their cages."""
    caged = (np.sum(r**2, axis=3) < LEFT**2).all(axis=(0, 1))
    r = r[:, :, caged].astype(float)
    pairs = np.array([np.mean(np.sum((r[a] - r[b]) ** 2, axis=2), axis=1) for a, b in combinations(range(len(r)), 2)])
    return pairs, np.mean(np.sum(r**2, axis=3), axis=2), caged.sum()


def moments(values):
    """Relative variance and skewness of values over a row, for each row, and their errors over rows."""
    relative = values / values.mean(axis=1, keepdims=True) - 1
    variance = np.mean(relative**2, axis=1)
    pooled = relative.ravel()
    skew = np.mean(pooled**3) / np.mean(pooled**2) ** 1.5
    left_out = [np.delete(relative, k, axis=0).ravel() for k in range(len(relative))]  # jackknife over glasses
    parts = [np.mean(v**3) / np.mean(v**2) ** 1.5 for v in left_out]
    return mean_error(variance), (skew, np.std(parts) * np.sqrt(len(parts) - 1.0))


def rows(r, n, pressure, found):
    """Rows of one N and pressure; the numbers of the picture."""
    between, moved = np.array([f[0] for f in found]), np.array([f[1] for f in found])
    ratio = between.mean(axis=1) / moved.mean(axis=1)
    (variance, v_error), (skew, s_error) = moments(between[:, :, -1])
    caged, where = np.mean([f[2] for f in found]), f"N = {n}, p = {pressure:g}"
    r.add("1", f"{where}: D_AB over D after {INSTANTS[-1]:g} collisions", "simple glass: 1", *mean_error(ratio[:, -1]))
    r.add("1", f"{where}: spheres times the relative variance of D_AB", "simple glass: the same for all N", caged * variance, caged * v_error)
    r.add("1", f"{where}: skewness of D_AB", "Gaussian: 0", skew, s_error)
    return between, moved, (pressure, caged * variance, caged * v_error, skew, s_error)


def main():
    o = arguments(__doc__.splitlines()[0]).parse_args()
    sizes, glasses, count = ((512, 1024, 2048), 50, 10) if o.large else ((256, 512), 16, 8)
    r = Results(o, "clone_overlaps")
    figure, axes = plt.subplots(1, 4, figsize=(18, 4.4))
    for n in sizes:
        lines = []
        for k, pressure in enumerate(PRESSURES):
            name, last = f"clone_overlaps_n{n}", n == sizes[-1]
            made = seeded(o, name, f"p{pressure:g}_", glasses, lambda s: clones(n, s, pressure, count))
            found = [squares(m["r"]) for m in made if m is not None]
            if len(found) < 3:
                continue
            between, moved, line = rows(r, n, pressure, found)
            lines.append(line)
            if last:
                color = f"C{k}"
                axes[0].loglog(INSTANTS, between.mean(axis=(0, 1)), "o-", ms=3, color=color, label=f"D_AB, p = {pressure:g}")
                axes[0].loglog(INSTANTS, moved.mean(axis=(0, 1)), "s--", ms=3, color=color)
                pooled = (between[:, :, -1] / between[:, :, -1].mean(axis=1, keepdims=True)).ravel()
                axes[3].hist(pooled, np.linspace(0.0, 2.5, 26), histtype="step", density=True, color=color, label=f"p = {pressure:g}")
        if lines:
            p, variance, v_error, skew, s_error = np.array(lines).T
            axes[1].errorbar(p, variance, v_error, fmt="o-", capsize=3, label=f"N = {n}")
            axes[2].errorbar(p, skew, s_error, fmt="o-", capsize=3, label=f"N = {n}")
    axes[2].axhline(0.0, color="0.6", lw=1)
    axes[0].set(xlabel="collisions of a sphere", ylabel="diameters^2; dashed: D from the start", title=f"N = {sizes[-1]}")
    axes[1].set(xscale="log", ylim=(0, None), xlabel="p", ylabel="spheres times relative variance of D_AB")
    axes[2].set(xscale="log", xlabel="p", ylabel="skewness of D_AB")
    axes[3].set(xlabel="D_AB over its mean in the glass", ylabel="density", title=f"N = {sizes[-1]}")
    for axis in axes:
        axis.legend(fontsize=6)
    r.write(figure)


if __name__ == "__main__":
    main()
