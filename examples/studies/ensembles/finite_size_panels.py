#!/usr/bin/env python3
"""Panels that test the scaling with N, and shapes of contacts: chapter 4.

usage: finite_size_panels.py [--model euclid|mk] [--large] [--folder DIR] [--only-read]

Packings are those of finite_size.py with the same options. c is the cumulative distribution.
"""
import matplotlib.pyplot as plt
import numpy as np
from common import GAMMA, THETA_E, THETA_L, Results, arguments, ensemble, mean_error
from finite_size import Size, kept_entries, protocol

from jam import scaling

OFFSET = 0.25  # constant of c - 0.25 / N


def shapes(entry):
    """n.n of pairs of contacts of a sphere, whether that sphere is a buckler, and S of each stable sphere with its z."""
    pairs, vectors, z = entry.read("pairs", "vectors", "coordination")
    ends = np.concatenate([pairs[:, 0], pairs[:, 1]])
    order = np.argsort(ends, kind="stable")
    n = np.concatenate([vectors, -vectors])[order]
    first = np.concatenate([[0], np.cumsum(z)])
    dots, bucklers, s = [], [], []
    for k in np.flatnonzero(z):
        own = n[first[k] : first[k] + z[k]]
        d = (own @ own.T)[np.triu_indices(z[k], 1)]
        dots.append(d), bucklers.append(np.full(len(d), z[k] == 4)), s.append((d.sum(), z[k]))
    return np.concatenate(dots), np.concatenate(bucklers), np.array(s)


def contact_shapes(r, figure, axes, entries, n, model):
    every = [shapes(e) for e in entries[:40]]
    dots, bucklers, s = (np.concatenate(x) for x in zip(*every))
    share = lambda use: mean_error([np.mean(use(d, b)) for d, b, _ in every])  # noqa: E731
    at_half, below = share(lambda d, b: (d > 0.45) & (d < 0.505)), share(lambda d, b: (d > 0.35) & (d < 0.45))
    ratio = at_half[0] / 0.055 / (below[0] / 0.1)
    error = ratio * np.hypot(at_half[1] / at_half[0], below[1] / below[0])
    r.add(
        figure,
        f"density of n.n at 1/2 over that below, N = {n}",
        "1: no peak" if model == "mk" else "> 1: peak",
        ratio,
        error,
    )
    above = share(lambda d, b: d > 0.505)
    r.add(figure, f"share of n.n above 1/2, N = {n}", "> 0" if model == "mk" else "0", *above)
    least = mean_error([np.mean(x[x[:, 1] == 4, 0]) for _, _, x in every])
    r.add(figure, f"mean S of bucklers, N = {n}", "like the other model", *least)
    for use, text in ((slice(None), "all"), (bucklers, "bucklers"), (~bucklers, "others")):
        axes[0].hist(dots[use], np.linspace(-1, 1, 81), density=True, histtype="step", label=text)
    axes[0].set(xlabel="n.n of two contacts", ylabel="pdf", title=f"N = {n}")
    for z in (4, 5, 6, 7, 8):
        axes[1].hist(s[s[:, 1] == z, 0], np.arange(-6, 0.01, 0.05), histtype="step", label=f"z = {z}")
    axes[1].set(xlabel="S", ylabel="spheres", yscale="log")


def ratios(r, figure, axes, sizes):
    """c / f^b for four b. Spheres: c - 0.25 / N (4.5). Mari-Kurchan packings: N^(theta/(1+theta)) c / f (4.13)."""
    x = np.geomspace(1e-4, 3, 60)
    largest = max(sizes)
    for k, (n, s) in enumerate(sizes.items()):
        c = scaling.cdf_grid(s.extended, x).c
        for b, style in ((1 + THETA_E, "-"), (1.0, ":"), (1 + THETA_L, "--"), (1.25, "-.")):
            use = c > 0
            axes[0].loglog(
                x[use], c[use] / x[use] ** b, style, color=f"C{k}", lw=1, label=f"b = {b:.3f}" if n == largest else None
            )
        lower = n ** (THETA_E / (1 + THETA_E)) * c / x if figure == "6.6" else np.maximum(n * c - OFFSET, 1e-3)
        axes[1].loglog(x * n ** (1 / (1 + THETA_E)), lower, lw=1, label=f"N = {n}")
    axes[0].set(xlabel="f, extended", ylabel="c / f^b", ylim=(1e-2, 1e2))
    axes[1].set(xlabel="f N^(1/(1+theta_e))", ylabel="N^(theta/(1+theta)) c / f" if figure == "6.6" else "N c - 0.25", ylim=(1e-2, None))
    if len(sizes) > 1:
        u, v = scaling.tail_scaling([THETA_E])
        for scaled in (False, True):
            grid = lambda n: np.geomspace(0.3, 10, 25) * n**-u  # noqa: E731
            curves = []
            for n, s in sizes.items():
                c = scaling.cdf_grid(s.extended, grid(n) if scaled else np.geomspace(3e-3, 0.1, 25))
                curves.append((n, c._replace(c=c.c - OFFSET / n)))
            quality = scaling.quality(curves, *((u, v) if scaled else (0.0, 0.0)))
            text = f"S of c - {OFFSET:g} / N of extended forces, {'scaled' if scaled else 'not scaled'}"
            r.add(figure + ".4", text, "about 1" if scaled else "> 1", quality)


def gaps(r, figure, axes, sizes):
    """c / h^(1-gamma), and the plateau of c N^(-gamma/(1-gamma)) / h; exponents near two scaled gaps."""
    u = 1 / (1 - GAMMA)
    for n, s in sizes.items():
        x = np.geomspace(1e-3, 1e3, 60) * n**-u
        c, normal = scaling.cdf_grid(s.gaps, x).c, np.mean([len(g) for g in s.gaps]) / n
        axes[0].loglog(x[c > 0], c[c > 0] / x[c > 0] ** (1 - GAMMA), lw=1, label=f"N = {n}")
        axes[1].loglog((x * n**u)[c > 0], (c / x)[c > 0] * n ** (-GAMMA * u), lw=1, label=f"N = {n}")
        few = (
            np.array([np.sum(g < 0.3 * n**-u) for g in s.gaps])
            * normal
            / 0.3
            / np.array([len(g) for g in s.gaps])
            * n
        )
        r.add(
            figure + ".6",
            f"plateau of c N^(-gamma/(1-gamma)) / h, scaled h < 0.3, N = {n}",
            "order 1",
            *mean_error(few / normal),
        )
    axes[0].set(xlabel="h", ylabel="c / h^(1-gamma)")
    axes[1].set(xlabel="h N^(1/(1-gamma))", ylabel="c N^(-gamma/(1-gamma)) / h")
    n = max(sizes)
    for at in (1.0, 100.0):
        grid = at * np.geomspace(10**-0.5, 10**0.5, 15) * n**-u

        def slope(some):
            c = scaling.cdf_grid(some, grid).c
            return np.polyfit(np.log(grid), np.log(np.maximum(c, 1e-9)), 1)[0] - 1

        found = scaling.bootstrap(sizes[n].gaps, slope, 60)
        r.add(
            figure + ".5",
            f"exponent of gaps near scaled h = {at:g}, least squares, N = {n}",
            "none",
            found.value,
            found.error,
        )


def main():
    p = arguments(__doc__.splitlines()[0])
    p.add_argument("--model", choices=["euclid", "mk"], default="euclid")
    p.add_argument("--sizes", type=int, nargs="+", help="N (small: 200 400; large: 256 512 1024 2048)")
    p.add_argument("--particles", type=float, default=5e4, help="with --large: particles a size (5e4)")
    o = p.parse_args()
    r = Results(o, "finite_size_panels_" + o.model)
    sizes, entries = {}, []
    for n in o.sizes or ((256, 512, 1024, 2048) if o.large else (200, 400)):
        e = ensemble(o, protocol(o.model, n), round(o.particles / n) if o.large else 3200 // n)
        size = Size(e, o.model)
        if len(size.rows) >= 4:
            sizes[n], entries = size, kept_entries(e, o.model)
    figure, axes = plt.subplots(2, 3, figsize=(14, 8))
    name = "6.6" if o.model == "mk" else "6.5"
    ratios(r, name, axes[0], sizes)
    gaps(r, name, axes[1], sizes)
    contact_shapes(r, "6.6.2" if o.model == "mk" else "4.1", (axes[0, 2], axes[1, 2]), entries, max(sizes), o.model)
    for axis in axes.flat:
        axis.legend(fontsize=7)
    r.write(figure)


if __name__ == "__main__":
    main()
