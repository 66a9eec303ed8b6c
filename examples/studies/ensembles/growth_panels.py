#!/usr/bin/env python3
"""Rates and sizes on the path to jamming: figures 2.8 to 2.10, 2.13, 2.15 and 2.16 of the thesis.

usage: growth_panels.py [--large | --slow] [--seeds K] [--folder DIR] [--only-read] [--out DIR]

Runs are those of path_to_jamming.py for several (N, kappa), and small systems grown slowly from 0.2, which order in part.
Small: (256, 1e-3), and N = 256, 512, 1024 at 3e-4, 3 seeds. Slow: also N = 1024, 2048 and 4096 at 1e-4, half an hour. Large: N = 1024 at four rates, N = 2048 and 4096 at 1e-4, 10 seeds.
"""
import time

import matplotlib.pyplot as plt
import numpy as np
from common import G_OF_KAPPA, Results, arguments, mean_error, seeded
from path_to_jamming import MAX_ORDER, STEP_BINS, numbers, one, overlap

import jam

SMALL = ((256, 1e-3), (256, 3e-4), (512, 3e-4), (1024, 3e-4))
LARGE = ((1024, 3e-4), (1024, 1e-4), (1024, 3e-5), (1024, 1e-5), (2048, 1e-4), (4096, 1e-4))
SLOW = (*SMALL, (1024, 1e-4), (2048, 1e-4), (4096, 1e-4))
R_MAX, BINS = 4.0, 402  # no edge of a bin at contact


def runs(o, n, kappa, seeds, pressures):
    study = f"growth_panels_n{n}"
    there = seeded(o, study, f"kappa{kappa:g}_", seeds, lambda s: one(n, s, kappa, pressures))
    return [m for m in there if m["score"] < MAX_ORDER and numbers([m], "jammed", pressures).all()], len(there)


def against_pressure(r, every, pressures):
    """2.8, 2.9, 2.15, 2.16: phi_J, its difference, shared contacts, LPs and seconds for each (N, kappa)."""
    figure, axes = plt.subplots(2, 3, figsize=(15, 8.5))
    texts = ("phi_J", "mean |phi_J - phi_J(largest p)|", "contacts of the reference", "LPs", "s of growth and LPs", "s of LPs")
    for (n, kappa), made in every.items():
        phi, lps = numbers(made, "phi", pressures), numbers(made, "lps", pressures)
        off = np.abs(phi - phi[-1]).mean(axis=1)
        shared = np.array([[overlap(m, t, pressures[-1]) for m in made] for t in pressures])
        crunch, growth = numbers(made, "seconds", pressures), numbers(made, "md_seconds", pressures)
        label = f"N = {n}, kappa = {kappa:g}"
        style = dict(marker="o" if n == min(k[0] for k in every) else "s", ms=4, lw=1, capsize=2, label=label)
        error = lambda x: x.std(axis=1, ddof=1) / x.shape[1] ** 0.5  # noqa: E731
        for axis, y, e in zip(
            axes.flat,
            (phi.mean(axis=1), np.maximum(off, 1e-17), shared.mean(axis=1), lps.mean(axis=1), (crunch + growth).mean(axis=1), crunch.mean(axis=1)),
            (error(phi), None, error(shared), error(lps), error(crunch + growth), error(crunch)),
        ):  # fmt: skip
            axis.errorbar(pressures, y, e, **style)
        where = f"N = {n}, kappa = {kappa:g}"
        low, high = pressures[0], pressures[-1]
        r.add("2.8", f"|phi_J - reference|, p_target = {low:.0e}, {where}", "falls with p", off[0])
        r.add("2.9", f"contacts of the reference, p_target = {low:.0e}, {where}", "rises to 1", *mean_error(shared[0]))
        r.add("2.15", f"seconds of growth to p_target = {high:.0e}, {where}", "grow with 1/kappa and N", *mean_error(growth[-1]))
        r.add("2.15", f"seconds of the LPs from p_target = {low:.0e}, {where}", "fall with p", *mean_error(crunch[0]))
        r.add("2.15", f"seconds of the LPs from p_target = {high:.0e}, {where}", "fall with p", *mean_error(crunch[-1]))
        r.add("2.16", f"LPs from p_target = {high:.0e}, {where}", "about 3 to 10, least 3", *mean_error(lps[-1]))
    for axis, text in zip(axes.flat, texts):
        axis.set(xscale="log", xlabel="p where growth stops", ylabel=text)
    axes[0, 1].set(yscale="log"), axes[1, 1].set(yscale="log"), axes[1, 2].set(yscale="log")
    axes[0, 0].legend(fontsize=7)
    r.picture(figure, "growth_panels_pressure")


TOGETHER = 10  # growths that advance in one process, as published


def together(n, seed, pressure=1e7):
    """2.15, lower panels: seconds of growth of one packing alone, and of each of TOGETHER that advance by turns."""
    found = []
    for count in (1, TOGETHER):
        packings = [jam.System.random(n, seed=100 * seed + k) for k in range(count)]
        begin = time.process_time()
        for growth, target in [(5e-3 * G_OF_KAPPA, 500.0)] + [(1e-3 * G_OF_KAPPA, 10.0**k) for k in range(3, round(np.log10(pressure)) + 1)]:
            for packing in packings:
                packing.compress([(growth, float(target))])
        found.append((time.process_time() - begin) / count)
    return {"alone": found[0], "together": found[1]}


def side_by_side(o, r, sizes, seeds):
    figure, axis = plt.subplots(figsize=(5.6, 4.2))
    rows = []
    for n in sizes:
        made = seeded(o, "growth_panels_together", f"n{n}_", seeds, lambda s: together(n, s))
        if made:
            rows.append((n, np.mean([m["alone"] for m in made]), np.mean([m["together"] for m in made])))
            ratio = mean_error([m["together"] / m["alone"] for m in made])
            r.add("2.15", f"seconds of growth of each of {TOGETHER} at once over one alone, N = {n}, p = 1e7", "in the picture", *ratio)
    if rows:
        n, alone, several = np.array(rows).T
        axis.loglog(n, alone, "o-", label="one alone"), axis.loglog(n, several, "s--", label=f"each of {TOGETHER} at once")
        axis.set(xlabel="N", ylabel="processor s of growth to p = 1e7")
        axis.legend()
        r.picture(figure, "growth_panels_together")


def steps(r, every, pressures):
    """2.13: lg |s_i| of the first and the last LP by p and by kappa, and of every LP of one run; null displacements."""
    figure, axes = plt.subplots(1, 5, figsize=(22, 4.4))
    first_key = next(iter(every))
    middles = 0.5 * (STEP_BINS[1:] + STEP_BINS[:-1])
    for k, which in ((0, 0), (1, -1)):
        for t in pressures:
            counts = sum(m[f"each_{t:.0e}"][which] for m in every[first_key])
            axes[k].step(middles, counts / counts.sum() / 0.25, where="mid", lw=1, label=f"p = {t:.0e}")
        axes[k].set(title=f"{'first' if k == 0 else 'last'} LP, N = {first_key[0]}, kappa = {first_key[1]:g}")
    at = pressures[1]
    for (n, kappa), made in every.items():
        counts = sum(m[f"each_{at:.0e}"][0] for m in made)
        axes[2].step(middles, counts / counts.sum() / 0.25, where="mid", lw=1, label=f"N = {n}, kappa = {kappa:g}")
        counts = sum(m[f"each_{at:.0e}"][-1] for m in made)
        axes[4].step(middles, counts / counts.sum() / 0.25, where="mid", lw=1, label=f"N = {n}, kappa = {kappa:g}")
    axes[2].set(title=f"first LP from p = {at:.0e}")
    axes[4].set(title=f"last LP from p = {at:.0e}")
    each = max((m[f"each_{at:.0e}"] for m in every[first_key]), key=len)
    for k, counts in enumerate(each):
        axes[3].step(middles, counts / counts.sum() / 0.25, where="mid", lw=1, color=plt.cm.viridis(k / len(each)))
    axes[3].set(title=f"every LP of one run, {len(each)} of them; last: yellow")
    for axis in axes:
        axis.set(xlabel="lg |s_i|; 0 is drawn at -18", ylabel="pdf", yscale="log")
        if axis.get_legend_handles_labels()[0]:
            axis.legend(fontsize=7)
    peaks = [middles[np.argmax(sum(m[f"each_{t:.0e}"][0] for m in every[first_key]))] for t in pressures]
    power = np.polyfit(np.log10(pressures), peaks, 1)[0]
    r.add("2.13", "power of p in the most likely |s_i| of the first LP", "< 0: moves left with p", power)
    r.picture(figure, "growth_panels_steps")


def ordered(n, seed):
    with jam.System.random(n, seed=seed) as packing:
        packing.compress([(1e-3, 1e4)])
        report = packing.crunch()
        return {"phi": report.packing_fraction, "score": packing.crystal_score(), "g": packing.pair_correlation(R_MAX, BINS)}


def correlations(o, r, every, pressures, count):
    """2.10: g(r) for each p_target and rate; inset: packings that ordered in part."""
    figure, axes = plt.subplots(1, 3, figsize=(16, 4.4))
    x = jam.System.distances(4.0, 400)
    key = next(iter(every))
    for k, t in enumerate(pressures):
        g = np.mean([m[f"g_{t:.0e}"] for m in every[key]], axis=0)
        axes[0].plot(x, g + 0.5 * k, lw=1, label=f"p = {t:.0e}")
    for k, ((n, kappa), made) in enumerate(every.items()):
        g = np.mean([m[f"g_{pressures[-1]:.0e}"] for m in made], axis=0)
        axes[1].plot(x, g + 0.5 * k, lw=1, label=f"N = {n}, kappa = {kappa:g}")
    found = [m for m in seeded(o, "growth_panels_ordered", "n108_", count, lambda s: ordered(108, s)) if m["score"] > MAX_ORDER]
    for m in found:
        axes[2].plot(jam.System.distances(R_MAX, BINS), m["g"], lw=0.4, color="0.6")
    if found:
        axes[2].plot(jam.System.distances(R_MAX, BINS), np.mean([m["g"] for m in found], axis=0), lw=1.5, label=f"mean of {len(found)}")
        phi = [m["phi"] for m in found]
        r.add("2.10", "least phi_J of partly ordered packings, N = 108", "0.65", min(phi))
        r.add("2.10", "largest phi_J of partly ordered packings, N = 108", "0.675", max(phi))
    for axis, title in zip(axes, (f"N = {key[0]}, kappa = {key[1]:g}", "last p", "packings that ordered in part")):
        for at, style in ((2**0.5, ":"), (3**0.5, "-"), (2, "-"), (7**0.5, ":"), (3, "-")):
            axis.axvline(at, color="0.7", ls=style, lw=0.8)
        axis.set(xlabel="r / sigma", ylabel="g(r), shifted", xlim=(0.9, 3.5), ylim=(0, 6), title=title)
        axis.legend(fontsize=7)
    r.picture(figure, "growth_panels_correlation")


def main():
    p = arguments(__doc__.splitlines()[0])
    p.add_argument("--seeds", type=int, help="packings for each (N, kappa) (small 3, large 10)")
    p.add_argument("--slow", action="store_true", help="with larger systems at kappa = 1e-4")
    o = p.parse_args()
    seeds, pressures = o.seeds or (10 if o.large else 3), 10.0 ** np.arange(3, 12, 1 if o.large else 2)
    r, every = Results(o, "growth_panels"), {}
    for n, kappa in LARGE if o.large else SLOW if o.slow else SMALL:
        good, there = runs(o, n, kappa, seeds, pressures)
        print(f"N = {n}, kappa = {kappa:g}: {len(good)} of {there} are isostatic and without order")
        if len(good) > 1:
            every[n, kappa] = good
    if every:
        against_pressure(r, every, pressures)
        steps(r, every, pressures)
        side_by_side(o, r, sorted({n for n, _ in every}), seeds)
        correlations(o, r, every, pressures, 10)
    r.write()


if __name__ == "__main__":
    main()
