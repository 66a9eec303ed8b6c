#!/usr/bin/env python3
"""Do packings from LPs alone stay in their jammed state? Figure 3.5: the mean squared displacement of long runs has no plateau.

usage: quench_stability.py [--large] [--n N] [--seeds K] [--folder DIR] [--only-read] [--out DIR]

Packings by sequential LPs from random spheres, and grown ones (G = 1e-2 to p = 500, 3e-3 to 1e5, crunch), have their diameters
reduced to a share of phi_J. Dynamics runs to LONGEST collisions of a sphere; at some times a copy is crunched: does it find the
contacts and the density of the start? The MSD is that of spheres that are stable at the start. Small: N = 256, 6 packings of each
kind. Large: N = 1024, 20.
"""
import matplotlib.pyplot as plt
import numpy as np
from common import Results, mean_error, options, seeded

import jam

RATIOS = (0.99, 0.999)
INSTANTS = np.array([1, 3, 10, 30, 100, 300, 700, 1000.0])  # collisions of a sphere
CRUNCHED = (100.0, 1000.0)
KINDS = {"quenched": "by LPs alone", "grown": "grown"}


def jammed(kind, n, seed):
    packing = jam.System.random(n, seed=seed, **({"packing_fraction": 0.2} if kind == "quenched" else {}))
    if kind == "grown":
        packing.compress([(1e-2, 500.0), (3e-3, 1e5)])
    report = packing.crunch(**({"method": "sequential_lp"} if kind == "quenched" else {}))
    return packing, report.jammed and report.excess_contacts == 0


def motion(kind, n, seed):
    """MSD of stable spheres over R^2 at INSTANTS and, at CRUNCHED, shared contacts and change of phi_J; for each ratio."""
    packing, good = jammed(kind, n, seed)
    if not good:
        return {"msd": np.zeros(0)}
    stable, phi, radius = ~packing.rattlers, packing.packing_fraction, packing.diameters.mean() / 2
    msd, found = [], []
    for ratio in RATIOS:
        with packing.copy() as moving:
            moving.scale_diameters(ratio ** (1 / 3))
            start, total = moving.positions.copy(), 0.0
            last = start.copy()
            for span, instant in zip(np.diff(INSTANTS, prepend=0.0), INSTANTS):
                moving.run(float(span))
                step = moving.positions - last
                total, last = total + step - np.round(step), moving.positions.copy()
                shift = total[stable] - total[stable].mean(axis=0)
                msd.append(np.mean(np.sum(shift**2, axis=1)) / radius**2)
                if instant in CRUNCHED:
                    end = moving.copy()
                    report = end.crunch()
                    same = packing.compare(end).comparison.overlap_a if report.jammed else np.nan
                    found.append((same, report.packing_fraction - phi))
    shape = (len(RATIOS), -1)
    return {"msd": np.reshape(msd, shape), "found": np.reshape(found, (*shape, 2)), "phi": phi}


def main():
    o = options(__doc__.splitlines()[0], n=(256, 1024), seeds=(6, 20))
    n, seeds = o.n, o.seeds
    r = Results(o, "quench_stability")
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.6))
    for kind, style in zip(KINDS, ("o-", "s--")):
        made = [m for m in seeded(o, f"quench_stability_n{n}", f"{kind}_", seeds, lambda s: motion(kind, n, s)) if m["msd"].size]
        if len(made) < 2:
            continue
        msd, found = np.array([m["msd"] for m in made]), np.array([m["found"] for m in made])
        for k, ratio in enumerate(RATIOS):
            slope = np.log(msd[:, k, -1] / msd[:, k, -2]) / np.log(INSTANTS[-1] / INSTANTS[-2])
            text = f"phi/phi_J = {ratio}, {KINDS[kind]}"
            r.add("3.5", f"slope of the MSD, tau = {INSTANTS[-2]:g} to {INSTANTS[-1]:g}, {text}", "0: plateau", *mean_error(slope))
            for c, instant in enumerate(CRUNCHED):
                same, rise = found[:, k, c].T
                use = np.isfinite(same)
                r.add("3.5", f"share of contacts found again after tau = {instant:g}, {text}", "none", *mean_error(same[use]))
                r.add("3.5", f"change of phi_J after tau = {instant:g}, {text}", "none", *mean_error(rise[use]))
            axes[0].loglog(INSTANTS, np.exp(np.log(msd[:, k]).mean(axis=0)), style, ms=4, color=f"C{k}", label=text)
            axes[1].plot(found[:, k, -1, 1], found[:, k, -1, 0], style[0], ms=4, mfc="none", color=f"C{k}", label=text)
    axes[0].set(xlabel="tau", ylabel="MSD / R^2, mean of its logarithm")
    axes[1].set(xlabel=f"change of phi_J after tau = {CRUNCHED[-1]:g}", ylabel="share of contacts found again")
    for axis in axes:
        axis.legend(fontsize=7)
    r.write(figure)


if __name__ == "__main__":
    main()
