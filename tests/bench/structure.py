#!/usr/bin/env python3
"""Error against time of g(r), Voronoi cells and pore sizes, beside an arithmetic of scipy.

usage: structure.py OUT.json PICTURE.png      PYTHONPATH: the built module
Fluids of equal spheres at packing fraction 0.45. g(r): the pairs within two diameters, by the sum over bins against the count of a
k-d tree. Voronoi: local packing fractions against the cells that Qhull gives of the packing with copies around it. Pores: the mean radius at
random points against that at 40000; `distance` against the k-d tree. Processor time, one thread.
"""
import itertools
import json
import sys
import time

import jam
import matplotlib
import numpy as np
from scipy.spatial import ConvexHull, Voronoi, cKDTree

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

SIZES = (256, 1024, 4096, 16384)
BINS = (10, 40, 160, 640)
POINTS = (50, 200, 800, 3200)


def timed(call):
    begin = time.process_time()
    answer = call()
    return answer, time.process_time() - begin


def fluid(n):
    s = jam.System.random(n, 3, seed=1, packing_fraction=0.25)
    s.compress(growth_rate=0.1, pressure=1e12, packing_fraction=0.45)
    return s


def with_copies(s, margin):
    """The centres, and their copies within the margin of the cube, which come later."""
    x, edge = s.positions, s.info.box
    copies = [x + edge * np.array(shift) for shift in itertools.product((-1, 0, 1), repeat=3) if any(shift)]
    outer = np.concatenate(copies)
    return np.concatenate([x, outer[((outer > -margin) & (outer < edge + margin)).all(axis=1)]])


def pair_correlation(s):
    sigma, n = s.diameters.mean(), s.n
    tree = cKDTree(s.positions, boxsize=s.info.box)
    counted = (tree.count_neighbors(tree, 2.0 * sigma) - n) / 2
    for bins in BINS:
        g, seconds = timed(lambda bins=bins: s.pair_correlation(2.0, bins))
        edges = np.linspace(0.0, 2.0 * sigma, bins + 1)
        shells = 4.0 / 3.0 * np.pi * np.diff(edges**3)
        pairs = (g * shells).sum() * n**2 / (2.0 * s.info.box**3)
        yield {"task": "g(r)", "n": n, "at": f"{bins} bins", "seconds": seconds, "error": abs(pairs / counted - 1.0)}


def voronoi(s):
    local, seconds = timed(s.local_fraction)
    cells = Voronoi(with_copies(s, 4.0 * s.diameters.mean()))
    volume = [ConvexHull(cells.vertices[cells.regions[cells.point_region[i]]]).volume for i in range(min(s.n, 300))]
    expected = np.pi / 6.0 * s.diameters[: len(volume)] ** 3 / volume
    error = np.abs(local[: len(volume)] / expected - 1.0).max()
    yield {"task": "Voronoi cells", "n": s.n, "at": "", "seconds": seconds, "error": error}


def pores(s):
    tree, sigma = cKDTree(s.positions, boxsize=s.info.box), s.diameters.mean()
    best = s.pore_sizes(40000, 99).radius.mean()
    for points in POINTS:
        found, seconds = timed(lambda points=points: s.pore_sizes(points, 7))
        x = np.stack([found.x, found.y, found.z], axis=1)
        near = np.abs(found.distance - (tree.query(x)[0] - 0.5 * sigma)).max() / sigma
        yield {"task": "distance at points", "n": s.n, "at": f"{points} points", "seconds": seconds, "error": near}
        mean = abs(found.radius.mean() / best - 1.0)
        yield {"task": "mean pore radius", "n": s.n, "at": f"{points} points", "seconds": seconds, "error": mean}


def draw(rows, picture):
    figure, axis = plt.subplots(figsize=(6, 4.2), constrained_layout=True)
    for task, marker in zip(dict.fromkeys(r["task"] for r in rows), "os^D"):
        run = [r for r in rows if r["task"] == task]
        axis.loglog([r["seconds"] for r in run], [max(r["error"], 1e-17) for r in run], marker, label=task)
    axis.set(xlabel="processor time (s)", ylabel="relative error (1e-17: none)")
    axis.legend()
    figure.savefig(picture, dpi=150)


def main():
    rows = []
    for n in SIZES:
        s = fluid(n)
        rows += [*pair_correlation(s), *voronoi(s)]
        if n == 1024:
            rows += pores(s)
    with open(sys.argv[1], "w", encoding="ascii") as file:
        json.dump(rows, file, indent=1)
    draw(rows, sys.argv[2])


if __name__ == "__main__":
    main()
