#!/usr/bin/env python3
"""Mari-Kurchan liquid and glass, planted or not, with a fit of the glass branch whose d is free: figure 2.6 of the thesis.

usage: mk_glass.py [--large] [--folder DIR] [--only-read] [--out DIR]

Spheres grow from 0.3 and from the planted liquid at 2.5 to p = 1e6. Small: N = 200, 3 of each. Large: N = 1024, 5.
"""
import matplotlib.pyplot as plt
import numpy as np
from common import Results, arguments, mean_error, seeded

import jam


def mari_kurchan(n, seed, phi):
    """(p, phi) on the way to p = 1e6, and phi_J of the crunch."""
    p, density = [], []
    with jam.System.random(n, seed=seed, model="mk", packing_fraction=phi) as packing:
        for target in 10.0 ** np.arange(0.8, 6.01, 0.2):
            if target > 1.2 * (1 + 4 * phi):
                md = packing.compress([(3e-3, float(target))])
                p.append(md.pressure), density.append(md.packing_fraction)
        report = packing.crunch()
        return {"p": p, "phi": density, "phi_j": report.packing_fraction, "jammed": report.jammed}


def glasses(o, r, n, seeds):
    """One set of curves for each start, with the fits; returns the picture."""
    figure, axis = plt.subplots(figsize=(7, 4.8))
    line = np.linspace(0.3, 3.2, 100)
    axis.semilogy(line, 1 / (1 + 4 * line), "k--", lw=1, label="1 + 4 phi")
    for k, (start, text) in enumerate(((0.3, "not planted, from 0.3"), (2.5, "planted at 2.5"))):
        make = seeded(o, f"mk_glass_n{n}", f"from{start:g}_", seeds, lambda s: mari_kurchan(n, s, start))
        made = [m for m in make if m["jammed"]]
        if len(made) < 2:
            continue
        fits = [jam.glass_fit(m["phi"][m["p"] > 1e3], m["p"][m["p"] > 1e3]) for m in made]
        for m, fit in zip(made, fits):
            first = m is made[0]
            axis.semilogy(m["phi"], 1 / m["p"], ".-", ms=3, lw=0.7, color=f"C{k}", label=text if first else None)
            x = np.linspace(0.75 * fit.jammed_fraction, fit.jammed_fraction * (1 - 1e-5), 60)
            axis.semilogy(x, (1 - x / fit.jammed_fraction) / fit.dimension, ":", color=f"C{k}", label="fit, d free" if first else None)
        r.add("2.6", f"d of the fit of the glass branch, {text}", "free", *mean_error([f.dimension for f in fits]))
        r.add("2.6", f"phi_J of the fit minus that of the crunch, {text}", "0", *mean_error([f.jammed_fraction - m["phi_j"] for f, m in zip(fits, made)]))
        r.add("2.6", f"phi_J, {text}", ">= 3.1 planted", *mean_error([m["phi_j"] for m in made]))
    axis.axvline(1.776, color="0.7", lw=1)
    axis.set(xlabel="phi; vertical line: phi_d = 1.776", ylabel="1 / p", ylim=(1e-5, 1))
    axis.legend(fontsize=7)
    return figure


def main():
    o = arguments(__doc__.splitlines()[0]).parse_args()
    r = Results(o, "mk_glass")
    r.write(glasses(o, r, 1024 if o.large else 200, 5 if o.large else 3))


if __name__ == "__main__":
    main()
