#!/usr/bin/env python3
"""Minimisers of soft spheres: processor time against the balance of forces, and the smallest overlaps that can be balanced.

usage: soft_minimise.py FILE.json [N] [SEED]   then   soft_minimise.py FILE.json PICTURE.png
A packing at each of three distances ln(R / R_J) is shaken by a third of its mean overlap and minimised again, by each
method and precision, to one tolerance after the other. The second panel: the smallest residual each precision reaches.
"""
import json
import sys
import time

import numpy as np

import jam

DISTANCES = (1e-2, 1e-4, 1e-6)
TOLERANCES = 10.0 ** np.arange(-2, -14, -1.0)


def at_distance(n, seed, distance):
    packing = jam.System.random(n=n, seed=seed, packing_fraction=0.70, overlap="allow")
    packing.decompress(distance=distance, isostatic=0, crunch=0)
    return packing


def shaken(packing, distance, seed):
    x = np.array(packing.positions)
    x += np.random.default_rng(seed).uniform(-1, 1, x.shape) * distance * packing.diameters[0] / 3
    return jam.System.from_arrays(x, packing.diameters, overlap="allow")


def measure(start, **options):
    packing = start.copy()
    begun = time.process_time()
    report = packing.relax(**options)
    return time.process_time() - begun, report


def race(n, seed):
    points = []
    for distance in DISTANCES:
        start = shaken(at_distance(n, seed, distance), distance, seed)
        for minimiser in ("newton", "fire", "lbfgs"):
            for precision in ("reference", "double"):
                for tolerance in TOLERANCES:
                    options = {"minimiser": minimiser, "precision": precision, "force_tolerance": tolerance}
                    seconds, r = measure(start, max_evaluations=40000, **options)
                    points.append(
                        dict(
                            options,
                            distance=distance,
                            seconds=seconds,
                            residual=r.force_residual,
                            converged=r.converged,
                            evaluations=r.evaluations,
                            factorisations=r.factorisations,
                        )
                    )
                    if not r.converged:
                        break
    return points


def floors(n, seed):
    points = []
    for distance in 10.0 ** np.arange(-3, -12.5, -1.0):
        packing = at_distance(n, seed, distance)
        for precision in ("reference", "double"):
            _, r = measure(packing, precision=precision, force_tolerance=1e-16, max_evaluations=3000)
            points.append({"distance": distance, "precision": precision, "residual": r.force_residual})
    return points


def draw(data, picture):
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 4, figsize=(15, 4))
    for axis, distance in zip(axes, DISTANCES):
        for colour, minimiser in zip(("C0", "C1", "C2"), ("newton", "fire", "lbfgs")):
            for line, precision in (("-", "reference"), (":", "double")):
                p = [
                    q
                    for q in data["race"]
                    if (q["distance"], q["minimiser"], q["precision"]) == (distance, minimiser, precision)
                ]
                axis.loglog(
                    [q["seconds"] for q in p],
                    [q["residual"] for q in p],
                    "o" + line,
                    ms=3,
                    color=colour,
                    label=f"{minimiser}, {precision}",
                )
        axis.set(xlabel="CPU time (s)", ylabel="max |F_i| / <f>", title=f"N = {data['n']}, ln(R/R_J) = {distance:g}")
    axes[0].legend(fontsize=7)
    for precision in ("reference", "double"):
        p = [q for q in data["floors"] if q["precision"] == precision]
        axes[3].loglog([q["distance"] for q in p], [q["residual"] for q in p], "o-", ms=3, label=precision)
    axes[3].set(xlabel="ln(R / R_J)", title="smallest residual")
    axes[3].legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    name = sys.argv[1]
    if len(sys.argv) > 2 and sys.argv[2].endswith(".png"):
        with open(name, encoding="ascii") as file:
            draw(json.load(file), sys.argv[2])
    else:
        size, number = int(sys.argv[2]) if len(sys.argv) > 2 else 512, int(sys.argv[3]) if len(sys.argv) > 3 else 1
        with open(name, "w", encoding="ascii") as file:
            json.dump({"n": size, "seed": number, "race": race(size, number), "floors": floors(size, number)}, file)
