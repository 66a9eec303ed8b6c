#!/usr/bin/env python3
"""Minimisers of soft spheres in a free cell at fixed pressure: processor time against the balance of forces and stresses.

usage: soft_cell.py FILE.json [N] [SEED]   then   soft_cell.py FILE.json PICTURE.png
All strains are free. Each start is a minimum in a cube, relaxed once at another pressure: every run moves spheres and cell
and ends at its pressure. A run a tolerance. The residual is the larger of that of forces and that of stresses.
"""
import json
import sys
import time

import numpy as np

import jam

PRESSURES = (1e-1, 1e-3, 1e-5)  # times the stiffness of a contact over the diameter
TOLERANCES = 10.0 ** np.arange(-2, -14, -1.0)


def race(n, seed):
    points = []
    for pressure in PRESSURES:
        start = jam.System.random(n=n, seed=seed, packing_fraction=0.70, overlap="allow")
        bulk = pressure / start.diameters[0] ** 3
        start.relax(strain="all", pressure=1.5 * bulk, force_tolerance=1e-6)
        for minimiser in ("newton", "fire", "lbfgs"):
            for tolerance in TOLERANCES:
                packing = start.copy()
                begun = time.process_time()
                r = packing.relax(
                    strain="all", pressure=bulk, minimiser=minimiser, force_tolerance=tolerance, max_evaluations=40000
                )
                points.append(
                    {
                        "pressure": pressure,
                        "minimiser": minimiser,
                        "tolerance": tolerance,
                        "seconds": time.process_time() - begun,
                        "residual": max(r.force_residual, r.stress_residual),
                        "converged": bool(r.converged),
                        "evaluations": r.evaluations,
                        "factorisations": r.factorisations,
                        "off": abs(r.pressure / bulk - 1.0),
                    }
                )
                p = points[-1]
                print(
                    f"P {pressure:.0e} {minimiser:6s} asked {tolerance:.0e} reached {p['residual']:.1e} pressure off by "
                    f"{p['off']:.1e} {p['seconds']:.3f} s {p['evaluations']} evaluations {p['factorisations']} factor.",
                    flush=True,
                )
                if not r.converged:
                    break
    return points


def draw(data, picture):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, len(PRESSURES), figsize=(12, 4), sharey=True)
    for axis, pressure in zip(axes, PRESSURES):
        for minimiser in ("newton", "fire", "lbfgs"):
            p = [q for q in data["race"] if (q["pressure"], q["minimiser"]) == (pressure, minimiser)]
            axis.loglog([q["seconds"] for q in p], [q["residual"] for q in p], "o-", ms=3, label=minimiser)
        axis.set(xlabel="processor time (s)", title=f"N = {data['n']}, P = {pressure:g} stiffness / diameter")
        axis.grid(alpha=0.3)
    axes[0].set_ylabel("larger residual of forces and stresses")
    axes[0].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


def main():
    name = sys.argv[1]
    if len(sys.argv) > 2 and sys.argv[2].endswith(".png"):
        with open(name, encoding="ascii") as file:
            return draw(json.load(file), sys.argv[2])
    n, seed = int(sys.argv[2]) if len(sys.argv) > 2 else 512, int(sys.argv[3]) if len(sys.argv) > 3 else 1
    data = {"n": n, "race": race(n, seed)}
    with open(name, "w", encoding="ascii") as file:
        json.dump(data, file)


if __name__ == "__main__":
    main()
