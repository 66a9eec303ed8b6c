#!/usr/bin/env python3
"""Densest packings of few equal spheres in a free periodic cell, from random starts.

usage: small_periodic_packings.py PICTURE.png [SEEDS]     default 100 starts a number of spheres; a minute or two

Each start is a cube at low density; `crunch(strain="free")` deforms the cell and ends strictly jammed. One sphere alone
starts in a random cell, since all its starts in a cube are the same. The densest known
lattice packing fits any number of spheres in some cell, so a search that is good enough finds its density for every N.
Torquato and Jiao, Phys. Rev. E 82, 061302 (2010); lattice densities: Conway and Sloane, Sphere Packings, Lattices and Groups.
"""
import math
import sys

import matplotlib.pyplot as plt
import numpy as np

import jam

# d: (name, density) of the densest known lattice packing, numbers of spheres, packing fraction of the starts.
CASES = {
    2: ("hexagonal", math.pi / math.sqrt(12.0), range(1, 21), 0.2),
    3: ("face-centred cubic", math.pi / math.sqrt(18.0), range(1, 21), 0.1),
    4: ("D4", math.pi**2 / 16.0, range(1, 13), 0.05),
    5: ("D5", math.pi**2 / (15.0 * math.sqrt(2.0)), range(1, 9), 0.02),
}


def random_start(dim, n, phi, seed):
    if n > 1:
        return jam.System.random(n, dim, seed, packing_fraction=phi)
    rng = np.random.default_rng(seed)
    cell = np.diag(rng.uniform(0.7, 1.3, dim)) + np.tril(rng.uniform(-0.5, 0.5, (dim, dim)), -1)
    return jam.System.from_arrays(np.zeros((1, dim)), 0.3, cell=cell)


def search(dim, n, start, seeds):
    """Best density of strictly jammed ends, the share of starts that reach it, and how many ended otherwise."""
    found, others = [], 0
    for seed in range(1, seeds + 1):
        report = random_start(dim, n, start, seed).crunch(strain="free")
        if report.strictly_jammed == jam.Verdict.YES:
            found.append(report.packing_fraction)
        else:
            others += 1
    best = max(found, default=math.nan)
    return best, sum(phi > best * (1.0 - 1e-9) for phi in found) / seeds, others


def main():
    seeds = int(sys.argv[2]) if len(sys.argv) > 2 else 100
    figure, axis = plt.subplots(figsize=(7, 4))
    print(
        "| d | N | best density | less than the lattice by | share of starts | not strict |\n|---|---|---|---|---|---|"
    )
    for dim, (name, lattice, sizes, start) in CASES.items():
        ratios = []
        for n in sizes:
            best, share, others = search(dim, n, start, seeds)
            ratios.append(best / lattice)
            print(f"| {dim} | {n} | {best:.12f} | {lattice - best:.1e} | {share:.2f} | {others} |", flush=True)
        axis.plot(list(sizes), ratios, "o-", ms=4, label=f"d = {dim}, {name}")
    axis.set(
        xlabel="spheres a cell", ylabel="best density / densest known lattice", title=f"{seeds} random starts each"
    )
    axis.legend(fontsize=8)
    axis.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(sys.argv[1], dpi=100)


if __name__ == "__main__":
    main()
