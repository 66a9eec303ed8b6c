#!/usr/bin/env python3
"""LPs, factorisations and time of a crunch against N: figures 2.17 and 2.18.

usage: complexity.py [--large] [--sizes N ...] [--seeds K] [--kappa K] [--folder DIR] [--only-read]

Growth at kappa = 5e-3 to p = 500, then at kappa to p = 1e7; the same configuration is crunched by sequential LPs, each solved in
full (as published), and by the default path. Twice: kappa the same for all N, and kappa_N = kappa (N_max / N)^(1/3), the
same rate of the density. Published: Gurobi's barrier solver, 6 cores, fits from N = 1024 on. Seconds are processor time of one
thread. Small: N = 64 to 512, kappa = 1e-3, 3 seeds. Large: N = 256 to 16384, kappa = 1e-5, 100 seeds.
"""
import time

import matplotlib.pyplot as plt
import numpy as np
from common import G_OF_KAPPA, Results, arguments, seeded

import jam

PUBLISHED = {"LPs": (0.59, 0.02), "seconds": (2.75, 0.08), "seconds of one LP": (2.27, 0.07)}  # power of N at fixed kappa, error


def crunched(packing, **options):
    """LPs, factorisations, seconds, seconds of the first and the last LP, of one LP in the mean; jammed."""
    marks, now = [], time.process_time
    with packing.copy() as copy:
        begin = now()
        if options:
            marks.append(begin)
            report = copy.crunch(on_step=lambda s: marks.append(now()) if len(s.duals) else None, **options)
            each = np.diff(marks)
            lps = (len(each), each[0], each[-1], each.mean())
        else:
            report = copy.crunch()
            lps = (report.lp_solves, np.nan, np.nan, np.nan)
        return [lps[0], report.factorisations, now() - begin, *lps[1:], report.jammed]


def one(n, seed, kappa):
    with jam.System.random(n, seed=seed) as packing:
        begin = time.process_time()
        packing.compress([(5e-3 * G_OF_KAPPA, 500.0), (kappa * G_OF_KAPPA, 1e7)])
        grown = time.process_time() - begin
        return {
            "lp": crunched(packing, method="sequential_lp", full_lps=1),
            "path": crunched(packing),
            "growth": grown,
            "score": packing.crystal_score(),
        }


def power(n, values, resamples=200):
    """Power of N of the means over seeds and its error over seeds; values: one array of seeds each N."""
    rng, x = np.random.default_rng(0), np.log(n)

    def fit(rows):
        return np.polyfit(x, np.log([np.mean(v) for v in rows]), 1)[0]

    drawn = [fit([v[rng.integers(len(v), size=len(v))] for v in values]) for _ in range(resamples)]
    return fit(values), np.std(drawn, ddof=1)


def main():
    p = arguments(__doc__.splitlines()[0])
    p.add_argument("--sizes", type=int, nargs="+", help="N (small 64 ... 512, large 256 ... 16384)")
    p.add_argument("--seeds", type=int, help="packings a size (small 3, large 100)")
    p.add_argument("--kappa", type=float, help="radius rate of the largest N (small 1e-3, large 1e-5)")
    o = p.parse_args()
    sizes = o.sizes or ([2**k for k in range(8, 15)] if o.large else [64, 128, 256, 512])
    seeds, kappa = o.seeds or (100 if o.large else 3), o.kappa or (1e-5 if o.large else 1e-3)
    r = Results(o, "complexity")
    figure, axes = plt.subplots(1, 4, figsize=(17, 4.2))
    for scaled in (False, True):
        name = "kappa_N" if scaled else "kappa fixed"
        found = {}
        for n in sizes:
            rate = kappa * (max(sizes) / n) ** (1 / 3) if scaled else kappa
            make = seeded(o, "complexity", f"n{n}_kappa{rate:.3g}_", seeds, lambda s: one(n, s, rate))
            good = [m for m in make if m["lp"][-1] and m["path"][-1]]
            if len(good) >= 2:
                found[n] = good
        if len(found) < 3:
            continue
        n = np.array(sorted(found), float)
        column = lambda way, k: [np.array([m[way][k] for m in found[m_n]]) for m_n in sorted(found)]  # noqa: E731
        lps, seconds = column("lp", 0), column("lp", 2)
        if not scaled:
            for text, k in (("LPs", 0), ("factorisations", 1), ("seconds", 2), ("seconds of one LP", 5)):
                value, error = power(n, column("lp", k))
                published, of_it = PUBLISHED.get(text, ("none", 0.0))
                r.add("7", f"power of N of {text}, {name}, N = {sizes[0]} to {sizes[-1]}", published, value, np.hypot(error, of_it))
            ratio = [np.mean(a / b) for a, b in zip(column("lp", 3), column("lp", 4))]
            text = f"seconds of the first LP over the last, {name}, mean over N"
            r.add("7", text, 1.5, np.mean(ratio), np.std(ratio, ddof=1))
        style = "s--" if scaled else "o-"
        for axis, values in zip(axes, (lps, column("lp", 1), seconds, column("lp", 5))):
            axis.loglog(n, [v.mean() for v in values], style, label=f"LPs, {name}")
        for axis, k in ((axes[1], 1), (axes[2], 2)):
            axis.loglog(n, [v.mean() for v in column("path", k)], style, label=f"default, {name}")
    x = np.array([sizes[0], sizes[-1]], float)
    for axis, slope in zip(axes, (0.59, 0.59, 2.75, 2.27)):
        low = np.median([line.get_ydata()[0] for line in axis.lines]) if axis.lines else 1.0
        axis.loglog(x, low * (x / x[0]) ** slope, "k:", lw=1, label=f"N^{slope:g}, published for LPs")
    for axis, text in zip(axes, ("LPs", "factorisations", "seconds of the crunch", "seconds of one LP")):
        axis.set(xlabel="N", ylabel=text)
        axis.legend(fontsize=7)
    r.write(figure)


if __name__ == "__main__":
    main()
