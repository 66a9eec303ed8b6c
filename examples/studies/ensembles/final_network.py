#!/usr/bin/env python3
"""The pressure above which a jammed network is final, p_th, against N: spheres and Mari-Kurchan packings.

usage: final_network.py [--large] [--sizes N ...] [--seeds K ...] [--folder DIR] [--only-read] [--out DIR]

Below jamming contact k is open by sigma / (p f_k), forces with mean 1, and at an opening s_plus_k the next contact forms. No contact is
exchanged above p_th = max 1 / (f_k s_plus_k), s_plus in diameters. If the least force goes as N^(-1/(1+theta_e)), s_plus as
N^(-1/(1-gamma)), and the two are independent, p_th ~ N^(1/(1+theta_e) + 1/(1-gamma)) = N^2.405. Growth as in finite_size.py, to p = 1e5. Packings with order or more than one state of
self-stress are left out; each network of spheres is proved. Small: N = 64, 128. Large: to 1024.
"""
import matplotlib.pyplot as plt
import numpy as np
from common import GAMMA, THETA_E, Results, arguments, mean_error, seeded
from finite_size import MAX_ORDER, protocol

import jam

MODELS = {"euclid": "spheres", "mk": "Mari-Kurchan"}
SIZES, SEEDS = [64, 128, 256, 512, 1024], [200, 150, 100, 50, 20]
LAW = round(1 / (1 + THETA_E) + 1 / (1 - GAMMA), 4)


def network(packing, model):
    """Forces with mean 1, floppy modes and classes of a jammed packing; {"good": False} if it does not count."""
    report = packing.crunch()
    order = 0.0 if model == "mk" else packing.crystal_score()
    if not report.jammed or report.excess_contacts or (model == "euclid" and order > MAX_ORDER):
        return {"good": False}
    modes, sigma = packing.floppy_modes(), packing.diameters.mean()
    proved = model != "mk" and packing.prove().theorem != jam.Theorem.NONE
    found = {"b": modes.median, "w": modes.weight, "s_plus": modes.s_plus / sigma, "sigma": modes.s_return / modes.s_plus}
    return {"good": True, "f": packing.forces / packing.forces.mean(), "flags": packing.contact_classes(), "proved": proved, **found}


def grown(model, n, seed):
    start = dict(model="mk", packing_fraction=2.5) if model == "mk" else {}
    with jam.System.random(n=n, seed=seed, **start) as packing:
        packing.compress([(stage["growth_rate"], stage["pressure"]) for stage in protocol(model, n)["stages"]])
        return network(packing, model)


def networks(o, model, n, count):
    """Good networks of seeds 1 to count, and how many were made."""
    there = seeded(o, "final_network", f"{model}_n{n}_", count, lambda s: grown(model, n, s))
    return [m for m in there if m["good"]], len(there)


def threshold(m):
    use = (m["s_plus"] > 0) & np.isfinite(m["s_plus"])
    return np.log10(np.max(1 / (m["f"] * m["s_plus"])[use]))


def power(sizes, values):
    """Slope of the means of values (one array for each N) against lg N, by weighted least squares."""
    x, (y, e) = np.log10(sizes), np.array([mean_error(v) for v in values]).T
    x0 = np.average(x, weights=1 / e**2)
    spread = np.sum(((x - x0) / e) ** 2)
    return np.sum((x - x0) * y / e**2) / spread, spread**-0.5


def rows(r, text, sizes, made):
    """p_th of each N, its power of N with statistics, range and estimator apart, and the two parts of the law."""
    lg = [np.array([threshold(m) for m in found]) for found in made]
    for n, v in zip(sizes, lg):
        r.add("p_th", f"lg p_th, {text}, N = {n}", "none", *mean_error(v))
    if len(sizes) < 2:
        return lg
    r.add("p_th", f"power of N of p_th, {text}, N = {sizes[0]} to {sizes[-1]}", LAW, *power(sizes, lg))
    if len(sizes) > 2:
        r.add("p_th", f"the same without the smallest N, {text}", LAW, *power(sizes[1:], lg[1:]))
        r.add("p_th", f"the same without the largest N, {text}", LAW, *power(sizes[:-1], lg[:-1]))
    rng = np.random.default_rng(1)
    medians = [[np.median(rng.choice(v, len(v))) for v in lg] for _ in range(200)]
    slopes = [np.polyfit(np.log10(sizes), m, 1)[0] for m in medians]
    middle = np.polyfit(np.log10(sizes), [np.median(v) for v in lg], 1)[0]
    r.add("p_th", f"the same by medians, {text}", LAW, middle, np.std(slopes, ddof=1))
    low = lambda m, key: np.log10(np.min(m[key][m["s_plus"] > 0]))  # noqa: E731
    for key, name, law in (("f", "least force", round(-1 / (1 + THETA_E), 4)), ("s_plus", "least s_plus", round(-1 / (1 - GAMMA), 4))):
        r.add("p_th", f"power of N of the {name}, {text}", law, *power(sizes, [[low(m, key) for m in found] for found in made]))
    independent = [[np.log10(np.max(1 / (m["f"] * rng.permutation(m["s_plus"]))[m["s_plus"] > 0])) for m in found] for found in made]
    r.add("p_th", f"power of N of p_th if s_plus is shuffled among the contacts, {text}", LAW, *power(sizes, independent))
    return lg


def main():
    p = arguments(__doc__.splitlines()[0])
    p.add_argument("--sizes", type=int, nargs="+", help="N (small 64 128; large to 1024)")
    p.add_argument("--seeds", type=int, nargs="+", help="packings of each N (small 8; large 200 to 20)")
    o = p.parse_args()
    sizes = o.sizes or (SIZES if o.large else SIZES[:2])
    seeds = o.seeds or (SEEDS if o.large else [8] * len(sizes))
    r, (figure, axes) = Results(o, "final_network"), plt.subplots(1, 2, figsize=(11, 4.4))
    for k, (model, text) in enumerate(MODELS.items()):
        found = {n: networks(o, model, n, count) for n, count in zip(sizes, seeds)}
        found = {n: (good, there) for n, (good, there) in found.items() if len(good) > 3}
        for n, (good, there) in found.items():
            if model == "euclid":
                r.add("p_th", f"share of networks proved, {text}, N = {n}", "all", np.mean([bool(m["proved"]) for m in good]))
        there = list(found)
        lg = rows(r, text, there, [good for good, _ in found.values()])
        axes[0].errorbar(there, [np.mean(v) for v in lg], [mean_error(v)[1] for v in lg], fmt="os"[k], color=f"C{k}", label=text)
        axes[0].plot(there, np.mean(lg[0]) + LAW * np.log10(np.array(there) / there[0]), ":", color=f"C{k}")
        for n, v in zip(there, lg):
            axes[1].step(np.sort(v - v.mean()), np.arange(1, len(v) + 1) / len(v), lw=1, color=f"C{k}", alpha=0.3 + 0.7 * n / there[-1])
    axes[0].set(xscale="log", xlabel="N", ylabel=f"mean lg p_th; dotted: N^{LAW:.3f}")
    axes[1].set(xlabel="lg p_th less its mean at each N; darker: larger N", ylabel="share of packings below")
    axes[0].legend()
    r.write(figure)


if __name__ == "__main__":
    main()
