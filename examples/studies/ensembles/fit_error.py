#!/usr/bin/env python3
"""phi_J by a fit of the glass branch, its error with and without the covariance, and phi_J by crunches: figures 2.11 and 2.12.

usage: fit_error.py [--large] [--n N] [--seeds K ...] [--kappas K ...] [--folder DIR] [--only-read] [--out DIR]

Growth at kappa = 5e-3 to p = 500, then at kappa (radius rate, G = 2 sqrt(3) kappa), four points a decade to p = 1e9; crunches of
copies at 1e3, 1e5 and 1e7 and of the last state give phi_J. Least squares 1/p = a - b phi from p = 1e5 on give phi_J = a/b and d = 1/a. The error of a/b without the covariance of a
and b is phi_J sqrt((da/a)^2 + (db/b)^2). Small: N = 128, kappa = 1e-3, 3 seeds. Large: N = 1024, kappa = 3e-4 and 1e-4, 20 and 10 seeds.
"""
import matplotlib.pyplot as plt
import numpy as np
from common import G_OF_KAPPA, Results, arguments, mean_error, seeded

import jam

PRESSURES = 10 ** np.arange(3, 9.01, 0.25)
EARLIER = (1e3, 1e5, 1e7)
LOWEST, MAX_ORDER = 1e5, 1.5


def growth(n, seed, kappa):
    p, phi, earlier = [], [], []
    with jam.System.random(n, seed=seed) as packing:
        packing.compress([(5e-3 * G_OF_KAPPA, 500.0)])
        for target in PRESSURES:
            md = packing.compress([(kappa * G_OF_KAPPA, float(target))])
            p.append(md.pressure), phi.append(md.packing_fraction)
            if any(abs(target / e - 1) < 1e-9 for e in EARLIER):
                with packing.copy() as copy:
                    earlier.append(copy.crunch().packing_fraction)
        report, order = packing.crunch(), packing.crystal_score()
        good = report.jammed and report.excess_contacts == 0 and order < MAX_ORDER
        return {"p": p, "phi": phi, "phi_j": report.packing_fraction, "earlier": earlier, "good": good}


def fit(phi, p):
    """(phi_J, its error, the error without the covariance, d / 3, R^2) of 1/p = a - b phi; phi from its mean on, for the rounding."""
    y, x0 = 1 / p, phi.mean()
    (slope, middle), cov = np.polyfit(phi - x0, y, 1, cov=True)
    a, b = middle - slope * x0, -slope
    phi_j = x0 + middle / b
    error = np.sqrt(cov[1, 1] + (middle / b) ** 2 * cov[0, 0] + 2 * middle / b * cov[0, 1]) / b
    var_a = cov[1, 1] + x0**2 * cov[0, 0] - 2 * x0 * cov[0, 1]
    naive = phi_j * np.sqrt(var_a / a**2 + cov[0, 0] / b**2)
    off = y - (middle + slope * (phi - x0))
    return phi_j, error, naive, 1 / a / 3, 1 - np.sum(off**2) / np.sum((y - y.mean()) ** 2)


def rows(r, axis, k, n, kappa, made):
    where = f"N = {n}, kappa = {kappa:g}"
    use = [m["p"] > 0.99 * LOWEST for m in made]
    phi_j, error, naive, d, r2 = np.array([fit(m["phi"][u], m["p"][u]) for m, u in zip(made, use)]).T
    off = phi_j - [m["phi_j"] for m in made]
    r.add("2.11", f"d of the fit over 3, {where}", "1 to 1.07", *mean_error(d))
    r.add("2.11", f"least R^2, {where}", ">= 0.999", r2.min())
    r.add("2.11", f"phi_J of the fit minus that of the crunch, {where}", "0", *mean_error(off))
    r.add("2.11", f"median of |phi_J of the fit - phi_J of the crunch|, {where}", "in the picture", np.median(np.abs(off)))
    r.add("2.11", f"error of the fit, median, {where}", "none", np.median(error))
    r.add("2.11", f"error of the fit without the covariance, median, {where}", "none", np.median(naive))
    r.add("2.11", f"median of the error without the covariance over that difference, {where}", "100 and more", np.median(naive / np.abs(off)))
    r.add("2.11", f"median of that difference over the error of the fit, {where}", "about 1 if growth ends at phi_J", np.median(np.abs(off) / error))
    first, second, third = np.array([m["earlier"] for m in made]).T
    same = 1e-12
    for value, low, high in ((first, 1e3, 1e7), (second, 1e5, 1e7)):
        less, more = np.sum(value < third - same), np.sum(value > third + same)
        r.add("2.12", f"share of packings whose phi_J from p = {low:.0e} is below that from {high:.0e}, {where}", "most", less / len(made))
        r.add("2.12", f"the same: above it, {low:.0e}, {where}", "few", more / len(made))
    x = k + 0.03 * (np.arange(len(off)) - 0.5 * len(off))
    axis.semilogy(x, np.abs(off), "o", ms=4, color=f"C{k}", label=f"difference, kappa = {kappa:g}")
    axis.plot(x, error, "_", color="k", label=None if k else "error of the fit")
    axis.plot(x, naive, "_", color="r", label=None if k else "error without the covariance")


def main():
    p = arguments(__doc__.splitlines()[0])
    p.add_argument("--n", type=int, help="spheres (small 128, large 1024)")
    p.add_argument("--seeds", type=int, nargs="+", help="packings for each kappa (small 3, large 20 10)")
    p.add_argument("--kappas", type=float, nargs="+", help="radius rates (small 1e-3, large 3e-4 1e-4)")
    o = p.parse_args()
    n, kappas = o.n or (1024 if o.large else 128), o.kappas or ([3e-4, 1e-4] if o.large else [1e-3])
    seeds = o.seeds or ([20, 10] if o.large else [3] * len(kappas))
    r, (figure, axis) = Results(o, "fit_error"), plt.subplots(figsize=(7, 4.6))
    for k, (kappa, count) in enumerate(zip(kappas, seeds)):
        good = [m for m in seeded(o, f"fit_error_n{n}", f"kappa{kappa:g}_", count, lambda s: growth(n, s, kappa)) if m["good"]]
        if len(good) > 1:
            rows(r, axis, k, n, kappa, good)
    axis.set(xticks=range(len(kappas)), xticklabels=[f"{kappa:g}" for kappa in kappas], xlabel="kappa; one point a packing", ylabel="|phi_J of the fit - phi_J of the crunch|")
    axis.legend(fontsize=8)
    r.write(figure)


if __name__ == "__main__":
    main()
