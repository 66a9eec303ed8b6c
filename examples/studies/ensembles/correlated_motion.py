#!/usr/bin/env python3
"""Correlated motion of a glass: chi_4, the four-point function G_4(r), and structure averaged over a sphere's surroundings.

usage: correlated_motion.py [--large] [--folder DIR] [--only-read] [--out DIR]

Runs from one jammed packing at phi / phi_J = 0.99 with velocities of their own. w_i is 1 while sphere i moved less than 0.015
diameters, about the size of its cage; Q is the mean of w over spheres; chi_4 = N var Q over runs. G_4(r) = mean of (w_i - <w_i>)(w_j - <w_j>) over pairs at distance r
and over runs: chi_4 is its sum over all pairs. Coarse graining: S averaged over the stable spheres within R, against the mobility.
Small: N = 256, 100 runs. Large: N = 1024, 1000 runs, 5 packings.
"""
import matplotlib.pyplot as plt
import numpy as np
from common import Results, arguments, mean_error, seeded

import jam
from jam import near_jamming as nj

RATIO, NEAR, EDGES = 0.99, 0.015, np.arange(1.0, 4.01, 0.25)
INSTANTS = np.array([2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0])
RADII = np.array([0.0, 1.1, 1.5, 2.0, 2.5, 3.0])


def one(n, seed, runs):
    with jam.System.random(n, seed=seed) as packing:
        packing.compress([(1e-2, 500.0), (3e-3, 1e5)])
        packing.crunch()
        found = packing.isoconf(INSTANTS, runs=runs, density_ratio=RATIO, keep=range(len(INSTANTS)), threads=1)
        stable, sigma, structure = ~packing.rattlers, packing.diameters.mean(), nj.predictors(packing)
        apart = packing.positions[:, None] - packing.positions[None]
        apart = np.linalg.norm(apart - np.round(apart), axis=2) / sigma
    chi, g4 = [], []
    for m in range(len(INSTANTS)):
        w = (np.linalg.norm(found.kept[m], axis=2) < NEAR * sigma)[:, stable].astype(float)
        off = w - w.mean(axis=0)
        together = off.T @ off / (len(w) - 1)
        chi.append(stable.sum() * w.mean(axis=1).var(ddof=1))
        which = np.digitize(apart[np.ix_(stable, stable)], EDGES)
        g4.append([together[which == k].mean() for k in range(1, len(EDGES))] + [together.sum() / stable.sum()])
    mobility, s, ranks = nj.propensity(found)[-3], structure.s, []
    for radius in RADII:
        weights = (apart <= radius) & stable[None]
        field = (weights @ s) / np.maximum(weights.sum(axis=1), 1)
        ranks.append(jam.statistics.spearman(field[stable], mobility[stable]))
    return {"chi": chi, "g4": g4, "ranks": ranks}


def main():
    o = arguments(__doc__.splitlines()[0]).parse_args()
    n, runs, seeds = (1024, 1000, 5) if o.large else (256, 100, 2)
    made = seeded(o, f"correlated_motion_n{n}", "", seeds, lambda s: one(n, s, runs))
    r, (figure, axes) = Results(o, "correlated_motion"), plt.subplots(1, 3, figsize=(15, 4.2))
    chi, g4, ranks = (np.array([m[key] for m in made]) for key in ("chi", "g4", "ranks"))
    peak = chi.mean(axis=0).argmax()
    r.add("chi_4", f"largest chi_4, after {INSTANTS[peak]:g} collisions per sphere", "a peak", *mean_error(chi[:, peak]))
    r.add("chi_4", "sum of G_4 over all pairs over chi_4", 1, np.mean(g4[:, peak, -1] / chi[:, peak]))
    r.add("G_4", f"G_4 near contact over that beyond r = {EDGES[-2]:g} sigma", "> 1: correlated", *mean_error(g4[:, peak, 0] / np.abs(g4[:, peak, -2])))
    for k, radius in enumerate(RADII):
        r.add("coarse", f"K[S averaged within {radius:g} sigma, mobility]", "none", *mean_error(ranks[:, k]))
    axes[0].errorbar(INSTANTS, chi.mean(axis=0), chi.std(axis=0, ddof=1) / len(chi) ** 0.5, fmt="o-")
    axes[1].errorbar(0.5 * (EDGES[1:] + EDGES[:-1]), g4[:, peak, :-1].mean(axis=0), g4[:, peak, :-1].std(axis=0, ddof=1) / len(g4) ** 0.5, fmt="o-")
    axes[2].errorbar(RADII, ranks.mean(axis=0), ranks.std(axis=0, ddof=1) / len(ranks) ** 0.5, fmt="o-")
    axes[0].set(xscale="log", xlabel="collisions per sphere", ylabel="chi_4")
    axes[1].set(xlabel="r / sigma", ylabel="G_4(r) at the peak of chi_4")
    axes[2].set(xlabel="R / sigma of the average of S", ylabel="K[S averaged within R, mobility]")
    r.write(figure)


if __name__ == "__main__":
    main()
