#!/usr/bin/env python3
"""Size of cages against pressure, by the length of the run: is it p^-1.4157?

usage: cage_size.py [--large] [--n N] [--seeds K] [--folder DIR] [--only-read]

Growth (G = 1.732e-2 to p = 500, 1e-3 beyond) stops at p. Molecular dynamics goes on without growth for windows of 300, 3000, ...
collisions a sphere, one after the other. The size of cages in a window is the mean-square displacement from the mean of 40
instants, over spheres that are no rattlers, in unit of the mean diameter squared. Marginal glasses have p^-1.4157. A short window
misses the slow modes, whose period in collisions grows with p: it gives a steeper law.
Small: N = 256, two packings, windows to 3000. Large: N = 1024, six packings, windows to 1e5. Each run is kept when done.
"""
import numpy as np
from common import Results, mean_error, options, seeded
from landscape import grown

INSTANTS, KAPPA_MF = 40, 1.4157


def windows(n, seed, pressure, lengths):
    """Size of cages in windows of these lengths, and the reduced pressure."""
    with grown(n, seed, pressure) as packing:
        jammed = packing.copy()
        jammed.crunch()
        stable = ~jammed.rattlers
        sizes = []
        for length in lengths:
            begin, moved = packing.positions.copy(), []
            for _ in range(INSTANTS):
                packing.run(length / INSTANTS)
                step = packing.positions - begin
                step = (step - np.round(step))[stable]
                moved.append(step - step.mean(axis=0))
            around = np.sum(np.var(moved, axis=0, ddof=1), axis=1)
            sizes.append(np.mean(around) / packing.diameters.mean() ** 2)
        return {"size": sizes, "pressure": packing.run(20).pressure}


def main():
    o = options(__doc__.splitlines()[0], n=(256, 1024), seeds=(2, 6))
    n, seeds = o.n, o.seeds
    lengths = 10.0 ** np.arange(0, 2.6 if o.large else 1.1, 1.0) * 300
    lengths = np.append(lengths, 1e5) if o.large else lengths
    pressures = (1e3, 1e4, 1e5, 1e6)
    r = Results(o, "cage_size")
    made = []
    for pressure in pressures:
        runs = seeded(o, f"cage_size_n{n}_to{lengths[-1]:.0e}", f"{pressure:.0e}_", seeds, lambda s: windows(n, s, pressure, lengths))
        if len(runs) < seeds:
            return
        made.append(runs)
    x = np.log([[run["pressure"] for run in runs] for runs in made])
    y = np.log([[run["size"] for run in runs] for runs in made])
    for k, length in enumerate(lengths):
        powers = [np.polyfit(x[:, s], y[:, s, k], 1)[0] for s in range(seeds)]
        text = f"power of p in the size of cages, N = {n}, p = 1e3 to 1e6, windows of {length:g} collisions"
        r.add("7", text, -KAPPA_MF, *mean_error(powers))
    r.write()


if __name__ == "__main__":
    main()
