#!/usr/bin/env python3
"""Forces, gaps and coordination at jamming against N, of spheres and Mari-Kurchan packings: chapter 4.

usage: finite_size.py [--model euclid|mk] [--large] [--folder DIR] [--only-read]

Small: N = 200 and 400, a minute or two. Large: N = 256 to 2048 with 5e4 particles a size and more.
Forces have mean 1 in each packing before they are separated: localised forces touch a sphere with d + 1 contacts,
extended ones do not. Packings of spheres with a crystal score of 1.5 and more are left out.
"""
import sys

import matplotlib.pyplot as plt
import numpy as np
from common import GAMMA, THETA_E, THETA_L, Results, arguments, ensemble, mean_error

from jam import scaling

GAPS_END = {"euclid": 1.0, "mk": 1e-3}  # fits look no further: beyond, Mari-Kurchan pairs are those of a liquid
CROSSOVER = (0.179008, 0.223543, -1.25569)  # published a, b, q of gaps: Mari-Kurchan packings, N = 4096
CONTENT = {"gaps": {"h_max": 1.0, "stable_only": 1}, "crystal_score": {}}
CONTENT_MK = {"gaps": {"h_max": 1.0, "stable_only": 1}}
MAX_ORDER = 1.5


def protocol(model, n, **analysis):
    """Growth ends at p = 1e5: 132 pairs of packings show the distributions of growth to 1e7, for two thirds of the time."""
    if model == "mk":
        start = dict(packing_fraction=2.5, model="mk", stages=[{"growth_rate": 5e-3, "pressure": 1e5}])
    else:
        start = dict(stages=[{"growth_rate": 1e-2, "pressure": 500.0}, {"growth_rate": 3e-3, "pressure": 1e5}])
    return dict(n=n, dim=3, **start, analysis={**CONTENT, **analysis} if model == "euclid" else CONTENT_MK)


def kept_entries(e, model):
    """Packings with a single state of self-stress and, of spheres, without order."""
    return [
        entry
        for entry in e
        if entry.row["jammed"]
        and not entry.row["excess_contacts"]
        and (model == "mk" or entry.row["crystal_score"] <= MAX_ORDER)
    ]


class Size:
    """What is looked at of all packings of one size: one array a packing."""

    def __init__(self, e, model, dim=3):
        self.extended, self.localised, self.forces, self.gaps, self.z, rows = [], [], [], [], [], []
        self.clear = []  # gaps that touch no buckler
        for entry in kept_entries(e, model):
            f, pairs, z, gaps, ends = entry.read("forces", "pairs", "coordination", "gaps", "gaps/pair")
            local = (z[pairs] == dim + 1).any(axis=1)
            clear = (gaps > 0) & (z[ends] != dim + 1).all(axis=1)
            self.extended.append(np.sort(f[~local]))
            self.localised.append(np.sort(f[local]))
            self.forces.append(np.sort(f))
            self.gaps.append(np.sort(gaps[gaps > 0]))
            self.clear.append(np.sort(gaps[clear]))
            self.z.append(z[z > 0])
            rows.append(entry.row)
        self.rows = np.array(rows)


def collapse_tail(sizes, name, exponent, low, high, points=30):
    grid = lambda n: np.geomspace(low, high, points) * n ** (-1 / (1 + exponent))  # noqa: E731
    return scaling.collapse({n: getattr(s, name) for n, s in sizes.items()}, grid, [exponent], resamples=20)


def figures(axes, sizes, model):
    for n, s in sizes.items():
        z = np.concatenate(s.z)
        axes[0, 0].plot(*np.unique(z, return_counts=True)[:1], np.unique(z, return_counts=True)[1] / len(z), "o-", ms=3)
        x = np.geomspace(1e-5, 20, 120)
        for row, name, a in ((0, "extended", THETA_E), (1, "gaps", -GAMMA)):
            x = np.geomspace(1e-5, 20, 120) if row == 0 else np.geomspace(1e-9, 1, 120)
            c = scaling.cdf_grid(getattr(s, name), x).c
            axes[row, 1].loglog(x[c > 0], c[c > 0], label=f"N = {n}")
            axes[row, 2].loglog((x * n ** (1 / (1 + a)))[c > 0], (n * c)[c > 0])
        x = np.geomspace(1e-4, 20, 100)
        c = scaling.cdf_grid(s.localised, x).c
        axes[1, 0].loglog(x[c > 0], c[c > 0])
    guide = np.geomspace(1e-2, 1e2, 2)
    axes[0, 2].loglog(guide, 6 * guide ** (1 + THETA_E), "k--", lw=1, label="slope 1.42311")
    axes[1, 2].loglog(guide, 6 * guide ** (1 - GAMMA), "k--", lw=1, label="slope 0.58731")
    slope = 1 + (THETA_L if model == "euclid" else 0.0)
    axes[1, 0].loglog([1e-3, 1e-1], [3e-4, 3e-4 * 100**slope], "k--", lw=1, label=f"slope {slope:g}")
    titles = (
        ("contacts z", "extended forces f", "f N^(1/(1+theta_e))"),
        ("localised forces f", "gaps h", "h N^(1/(1-gamma))"),
    )
    for row in (0, 1):
        for k in (0, 1, 2):
            axes[row, k].set(
                xlabel=titles[row][k], ylabel="N cdf" if k == 2 else "cdf" if (row, k) != (0, 0) else "pdf"
            )
            if axes[row, k].get_legend_handles_labels()[0]:
                axes[row, k].legend(fontsize=7)
    axes[0, 0].set_yscale("log")


def table(r, sizes, model, top):
    figure = "6.6" if model == "mk" else "6.5"
    largest, s = max(sizes.items())
    rows = s.rows
    z = np.concatenate(s.z)
    ideal = np.mean(6.0 - 4.0 / rows["stable"])
    r.add(figure + ".1", f"mean z at N = {largest}: 2d + 2(1-d)/N'", ("exact", round(float(ideal), 6)), z.mean())
    values, count = np.unique(z, return_counts=True)
    r.add(figure + ".1", "most likely z", "4 or 5" if model == "mk" else 6, values[count.argmax()])
    r.add(
        figure + ".1",
        "share of z >= 12" if model == "mk" else "share of z >= 10",
        "0.01" if model == "mk" else "few",
        np.mean(z >= (12 if model == "mk" else 10)),
    )
    phi, error = mean_error(rows["packing_fraction"])
    r.add(figure + ".1", f"phi_J at N = {largest}", ">= 3.1" if model == "mk" else "0.64", phi, error)
    share, error = mean_error(rows["rattlers"] / largest)
    r.add(figure + ".1", "share of rattlers", "0.15 to 0.20" if model == "mk" else "0.015 to 0.03", share, error)
    spheres = model == "euclid"
    for name, a, label in (
        ("extended", THETA_E, ".2" if spheres else ".3"),
        ("gaps", -GAMMA, ".5" if spheres else ".4"),
        ("localised", THETA_L if spheres else 0.0, ".7" if spheres else ".6"),
        ("forces", 0.25 if spheres else 0.1, ".7" if spheres else ".6"),
    ):
        values = [v[v < GAPS_END[model]] for v in s.gaps] if name == "gaps" else getattr(s, name)
        try:
            found = scaling.tail_exponent(values, largest, "gaps" if name == "gaps" else "forces")
        except ValueError as error:
            print(f"{name}: {error}")
            continue
        text = f"exponent of {name}, N = {largest}, averaged over ranges"
        r.add(figure + label, text, a, found.value, found.error)
    for name, a, low, high, label in (("extended", THETA_E, 0.3, 10, ".2"), ("gaps", -GAMMA, 0.1, top, ".5")):
        if len(sizes) < 2:
            continue
        found = collapse_tail(sizes, name, a, low, high)
        r.add(
            figure + label,
            f"exponent of {name} by collapse (S = {found.quality:.2f})",
            a,
            found.value[0],
            found.error[0],
        )


def main():
    p = arguments(__doc__.splitlines()[0])
    p.add_argument("--model", choices=["euclid", "mk"], default="euclid")
    p.add_argument("--sizes", type=int, nargs="+", help="N (small: 200 400; large: 256 512 1024 2048)")
    p.add_argument("--particles", type=float, default=5e4, help="with --large: particles a size (5e4)")
    o = p.parse_args()
    wanted = o.sizes or ((256, 512, 1024, 2048) if o.large else (200, 400))
    r = Results(o, "finite_size_" + o.model)
    sizes = {}
    for n in wanted:
        e = ensemble(o, protocol(o.model, n), round(o.particles / n) if o.large else 3200 // n)
        size = Size(e, o.model)
        if len(size.rows) >= 4:
            sizes[n] = size
    if not sizes:
        sys.exit("fewer than 4 packings of every size")
    figure, axes = plt.subplots(2, 3, figsize=(13, 7.5))
    figures(axes, sizes, o.model)
    table(r, sizes, o.model, min(2e2, GAPS_END[o.model] * min(sizes) ** (1 / (1 - GAMMA))))
    r.write(figure)


if __name__ == "__main__":
    main()
