#!/usr/bin/env python3
"""Which soft spheres move at jamming: figures 3.11 to 3.15 and 3.17 of the thesis, Metropolis Monte Carlo.

usage: motion_mc.py [--large] [--n N] [--runs RUNS] [--folder DIR] [--out DIR]

The packing of motion_md.py, energy (2R - r)^alpha at phi_J; three temperatures for each alpha (ours: equal overlaps T^(1/alpha);
published is T = 1e-4 for alpha = 2). Small: 40 runs of 250 sweeps for each of nine pairs, two minutes. Large: 1000. Runs are kept.
"""
import sys

import matplotlib.pyplot as plt
import numpy as np
from common import HERE, Results, arguments

from jam import near_jamming as nj

sys.path.insert(0, str(HERE.parent))
import near_jamming_common as near  # noqa: E402

MIDDLE = 1  # of the three temperatures: the one that the scatter panels show


def energies(r, every):
    figure, axis = plt.subplots(figsize=(6, 4.4))
    for (alpha, t), runs in every.items():
        style = {1.5: ":", 2.0: "-", 2.5: "--"}[alpha]
        level = near.TEMPERATURES[alpha].index(t)
        e = runs.mean("energy") / t
        axis.errorbar(runs.instants, e, runs.deviation("energy") / t / runs.runs**0.5, ls=style, color=f"C{level}", lw=1)
        axis.plot([], [], style, color=f"C{level}", label=f"alpha = {alpha}, T = {t:g}")
        r.add("3.11", f"beta <E> / N at the end, alpha = {alpha}, T = {t:g}", "one small range for all nine", e[-1])
    axis.set(xscale="log", xlabel="sweeps", ylabel="beta <E> / N")
    axis.legend(fontsize=7)
    r.picture(figure, "motion_mc_energy")


def scatters(r, structure, every, radius):
    pairs = [(alpha, near.TEMPERATURES[alpha][MIDDLE]) for alpha in near.TEMPERATURES]
    columns = [(f"alpha = {alpha}, T = {t:g}", every[alpha, t], -1) for alpha, t in pairs]
    figure, k = near.vectors(structure, columns, radius)
    r.picture(figure, "motion_mc_vectors")
    for (title, _, _), value in zip(columns, k):
        r.add("3.12", f"K[C, <dr>], {title}", "grows with alpha", value)
    figure, k, _ = near.variances(structure, columns, radius)
    r.picture(figure, "motion_mc_variance")
    for (title, _, _), value in zip(columns, k):
        r.add("3.13", f"K[|C|, Var], {title}", "about 0", value)
    figure, k = near.mobility(structure, columns, radius)
    r.picture(figure, "motion_mc_mobility")
    for (title, runs, _), values in zip(columns, k):
        e = nj.correlation_errors(runs, structure, 10)
        for text, name, value in zip(("sum f", "sum f.f", "S"), near.SCALARS, values):
            r.add("3.14", f"K[{text}, <|dr|^2>], {title}", "largest |K| for S; alpha = 2", value, e[name][-1])


def factor(curve, reference, levels=20):
    """Factor on x that brings one falling curve (x, K) onto another: mean difference of ln x at equal K."""
    (x, k), (y, q) = ((a, np.minimum.accumulate(b)) for a, b in (curve, reference))
    grid = np.linspace(max(k[-1], q[-1]), min(k[0], q[0]), levels + 2)[1:-1]
    return float(np.exp(np.mean(np.interp(-grid, -q, np.log(y)) - np.interp(-grid, -k, np.log(x)))))


def decays(r, structure, every, radius):
    """3.17: K against the MSD, raw, scaled with the published exponents, and all alpha on one curve by a factor each."""
    figure, axes = plt.subplots(2, 3, figsize=(14, 8))
    for row, kind in enumerate("cs"):
        joined = {}
        for column, (alpha, temperatures) in enumerate(near.TEMPERATURES.items()):
            runs, known = [every[alpha, t] for t in temperatures], near.MC_EXPONENTS[alpha][kind]
            found = nj.collapse_exponent(runs, structure, temperatures, kind, 10)
            r.add("3.17", f"exponent for {kind.upper()}, alpha = {alpha}", known, found.value, found.error)
            curves = []
            for style, one, t in zip((":", "-", "--"), runs, temperatures):
                x, k = nj.decay_curve(one, structure, kind)
                x = x / radius**2
                axes[row, 0].loglog(x, k, style, color=f"C{column}", label=f"alpha = {alpha}, T = {t:g}")
                axes[row, 1].loglog(x / t**found.value, k, style, color=f"C{column}")
                curves.append((x / t**found.value, k, style))
            joined[alpha] = curves
        for column, (alpha, curves) in enumerate(joined.items()):
            c = factor(curves[MIDDLE][:2], joined[2.0][MIDDLE][:2])
            if alpha != 2.0:
                r.add("3.17", f"factor of alpha = {alpha} onto alpha = 2, {kind.upper()}", "not given", c)
            for x, k, style in curves:
                axes[row, 2].loglog(c * x, k, style, color=f"C{column}", label=f"alpha = {alpha}, factor {c:.2g}")
        text = "K[C, <dr>]" if kind == "c" else "K[S, <|dr|^2>]"
        for axis, x in zip(axes[row], ("MSD / R_J^2", "MSD / (R_J^2 T^nu), nu of our fit", "c_alpha MSD / (R_J^2 T^nu)")):
            axis.set(xlabel=x, ylabel=text)
        axes[row, 0].legend(fontsize=6), axes[row, 2].legend(fontsize=6)
    r.picture(figure, "motion_mc_decay")


def main():
    p = arguments(__doc__.splitlines()[0])
    p.add_argument("--n", type=int, default=1024, help="spheres (1024)")
    p.add_argument("--runs", type=int, help="runs for each pair (small 40, large 1000)")
    o = p.parse_args()
    count = o.runs or (1000 if o.large else 40)
    r = Results(o, "motion_mc")
    packing = near.kept_packing(o.folder, 1, o.n)
    structure, radius = nj.predictors(packing), 0.5 * packing.diameters.mean()
    every = {}
    for alpha, temperatures in near.TEMPERATURES.items():
        for t in temperatures:
            every[alpha, t] = near.mc_runs(packing, o.folder, "1q", alpha, t, count)
    energies(r, every)
    scatters(r, structure, every, radius)
    decays(r, structure, every, radius)
    found = nj.prediction(every[2.0, 1e-4], structure)
    r.add("3.15", "area under the ROC curve, sign of <dr_c> by C_c, alpha = 2, T = 1e-4, last sweep", "> 0.5", found.c_area[-1])
    r.write()


if __name__ == "__main__":
    main()
