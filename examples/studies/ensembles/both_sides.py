#!/usr/bin/env python3
"""Jamming from below and from above: figures 4.3 to 4.8 of the thesis, hard spheres beside decompressed soft ones.

usage: both_sides.py [--large] [--sizes N ...] [--particles K ...] [--folder DIR] [--only-read] [--out DIR]

Below: growth and crunch as in finite_size.py. Above: harmonic soft spheres from random points at 0.72, decompressed to one
state of self-stress, then compared with a crunch from just below contact. Forces, gaps below 1 and coordination of each packing
are kept. Small: N = 128 and 256, 3000 particles each. Large: N = 256 to 4096, 2e5.
"""
import matplotlib.pyplot as plt
import numpy as np
from common import GAMMA, THETA_E, THETA_L, Results, arguments, mean_error, seeded
from finite_size import protocol

import jam
from jam import scaling

SIDES = {"below": "from below", "above": "from above", "mk": "Mari-Kurchan"}
MAX_ORDER = 1.5
OFFSET = 0.25  # constant of c - 0.25 / N, figure 4.5
U = {"extended": 1 / (1 + THETA_E), "localised": 1 / (1 + THETA_L), "gaps": 1 / (1 - GAMMA)}


def jammed(side, n, seed):
    """Forces with their class, gaps, z, S of a packing; empty when it is not jammed with one state of self-stress."""
    more = {}
    if side == "above":
        packing = jam.System.random(n=n, seed=seed, packing_fraction=0.72, overlap="allow")
        down = packing.decompress()
        report, more = packing.report, {"same": down.same_network, "difference": down.force_difference}
    else:
        mk = side == "mk"
        packing = jam.System.random(n=n, seed=seed, **({"model": "mk", "packing_fraction": 2.5} if mk else {}))
        packing.compress([(stage["growth_rate"], stage["pressure"]) for stage in protocol(side if mk else "euclid", n)["stages"]])
        report = packing.crunch()
    with packing:
        good = report.jammed and report.excess_contacts == 0
        if not good or (side != "mk" and packing.crystal_score() > MAX_ORDER):
            return {"good": False}
        z, flags = packing.coordination, packing.contact_classes()
        return {
            "good": True,
            "forces": packing.forces,
            "local": (flags & 1) != 0,
            "gaps": packing.gaps(h_max=1.0, stable_only=1).gap,
            "z": z,
            "S": packing.sphere_structure(weighted=0).s,
            "phi": report.packing_fraction,
            **more,
        }


class Side:
    """Samples of one side and one N: one array a packing."""

    def __init__(self, o, side, n, count):
        self.all = seeded(o, f"{side}_n{n}", "", count, lambda s: jammed(side, n, s))
        self.good = [m for m in self.all if m["good"]]
        local = [m["local"].astype(bool) for m in self.good]
        self.extended = [np.sort(m["forces"][~k]) for m, k in zip(self.good, local)]
        self.localised = [np.sort(m["forces"][k]) for m, k in zip(self.good, local)]
        self.gaps = [np.sort(m["gaps"]) for m in self.good]
        self.z = [m["z"][m["z"] > 0] for m in self.good]


def samples(o, sides, sizes, particles):
    """{(side, n): Side} of those with four good packings and more."""
    found = {}
    if len(particles) not in (1, len(sizes)):
        raise SystemExit("--particles takes one number, or one for each size")
    for side in sides:
        for n, count in zip(sizes, particles * (len(sizes) if len(particles) == 1 else 1)):
            one = Side(o, side, n, max(4, round(count / n)))
            if len(one.good) >= 4:
                found[side, n] = one
    return found


STYLE = {"below": "-", "above": "--", "mk": "-."}


def curve(axis, key, colour, x, y, **more):
    use = (y > 0) & np.isfinite(y)
    axis.loglog(x[use], y[use], STYLE[key[0]], color=colour, lw=1, label=f"{SIDES[key[0]]}, N = {key[1]}", **more)


def figures(found, sizes):
    figure, axes = plt.subplots(3, 3, figsize=(15, 12.5))
    f, h = np.geomspace(1e-4, 8, 90), np.geomspace(1e-7, 1, 90)
    theta = THETA_E / (1 + THETA_E)
    for key, s in found.items():
        n, colour = key[1], f"C{sizes.index(key[1])}"
        c = scaling.cdf_grid(s.extended, f).c
        curve(axes[0, 0], key, colour, f, c)
        curve(axes[0, 1], key, colour, f * n ** U["extended"], n * c)
        curve(axes[0, 2], key, colour, f * n ** U["extended"], c / f * n**theta)
        curve(axes[1, 0], key, colour, f * n ** U["extended"], n * c - OFFSET)
        g = scaling.cdf_grid(s.gaps, h).c
        curve(axes[1, 1], key, colour, h, g)
        curve(axes[1, 2], key, colour, h * n ** U["gaps"], n * g)
        curve(axes[2, 0], key, colour, h, g / h ** (1 - GAMMA))
        curve(axes[2, 1], key, colour, h * n ** U["gaps"], g / h * n ** (-GAMMA * U["gaps"]))
        curve(axes[2, 2], key, colour, f, scaling.cdf_grid(s.localised, f).c)
    for axis, at, power, text in (
        (axes[0, 0], (1e-3, 0.3), 1 + THETA_E, "1.42311"),
        (axes[0, 1], (0.3, 30), 1 + THETA_E, "1.42311"),
        (axes[1, 1], (1e-5, 0.1), 1 - GAMMA, "0.58731"),
        (axes[1, 2], (1, 1e3), 1 - GAMMA, "0.58731"),
        (axes[2, 2], (3e-3, 0.3), 1 + THETA_L, "1.17462"),
    ):
        x = np.array(at)
        y = axis.lines[0]
        level = np.interp(np.log(x[1]), np.log(y.get_xdata()), np.log(y.get_ydata()))
        axis.loglog(x, np.exp(level) * (x / x[1]) ** power, "k:", lw=1.5, label=f"slope {text}")
    names = (
        (("f, extended", "c"), ("f N^(1/(1+theta_e))", "N c"), ("f N^(1/(1+theta_e))", "N^(theta_e/(1+theta_e)) c / f")),
        (("f N^(1/(1+theta_e))", f"N c - {OFFSET}"), ("h", "c, gaps"), ("h N^(1/(1-gamma))", "N c")),
        (("h", "c / h^(1-gamma)"), ("h N^(1/(1-gamma))", "N^(-gamma/(1-gamma)) c / h"), ("f, localised", "c")),
    )
    for axis, (x, y) in zip(axes.flat, (pair for row in names for pair in row)):
        axis.set(xlabel=x, ylabel=y)
    axes[1, 0].set(ylim=(1e-2, None))
    axes[0, 0].legend(fontsize=7), axes[2, 2].legend(fontsize=7)
    return figure


def powers(found, sizes):
    """4.4: c / f^b of extended forces for four powers."""
    figure, axes = plt.subplots(1, 4, figsize=(17, 4.2))
    f = np.geomspace(1e-3, 3, 70)
    for axis, (b, text) in zip(axes, ((1 + THETA_E, "1 + theta_e"), (1.0, "1"), (1 + THETA_L, "1 + theta_l"), (1.25, "1.25"))):
        for key, s in found.items():
            curve(axis, key, f"C{sizes.index(key[1])}", f, scaling.cdf_grid(s.extended, f).c / f**b)
        axis.set(xlabel="f, extended", ylabel=f"c / f^b, b = {text}", ylim=(1e-2, 3))
    axes[0].legend(fontsize=7)
    return figure


def slope(values, low, high):
    """Exponent of the density by the mean number of values below two bounds, and its error over packings."""
    few, many = (np.array([np.sum(v < b) for v in values], float) for b in (low, high))
    power = np.log(many.mean() / few.mean()) / np.log(high / low) - 1
    error = mean_error(many / many.mean() - few / few.mean())[1] / np.log(high / low)
    return power, error


RANGES = {  # pairs of bounds, and the law
    "extended": (((0.03, 0.3), (0.01, 0.1), (0.01, 0.3)), THETA_E),
    "localised": (((0.003, 0.03), (0.003, 0.1), (0.01, 0.1)), THETA_L),
    "gaps": (((1e-3, 3e-2), (1e-4, 1e-2), (1e-3, 1e-1)), -GAMMA),
}
LABEL = {"extended": "4.3", "localised": "4.8", "gaps": "4.6"}


def rows(r, found, sizes):
    for (side, n), s in found.items():
        phi = mean_error([m["phi"] for m in s.good])
        r.add("4.3", f"phi_J {SIDES[side]}, N = {n}", "none", *phi)
        if side == "above":
            same = np.mean([m["same"] == 1 for m in s.good])
            r.add("4.3", f"share whose crunch finds the same contacts, N = {n}", "> 0.95", same)
            off = np.median([m["difference"] for m in s.good if m["same"] == 1])
            r.add("4.3", f"median over packings of the largest |f_soft - f_crunch| / mean, N = {n}", "to 0", off)
    n = max(sizes)
    if not all((side, n) in found for side in ("below", "above")):
        return
    for name, (ranges, law) in RANGES.items():
        both = np.array([[slope(getattr(found[side, n], name), *span) for span in ranges] for side in ("below", "above")])
        values, errors = both[1].T
        text = f"exponent of {name}, mean of three ranges, from above, N = {n}"
        r.add(LABEL[name], text, law, values.mean(), np.hypot(errors.mean(), values.std()))
        off, error = both[1, :, 0] - both[0, :, 0], np.hypot(both[1, :, 1], both[0, :, 1])
        text = f"exponent of {name}: from above less from below, N = {n}"
        r.add(LABEL[name], text, 0.0, off.mean(), np.hypot(error.mean(), off.std()))
    theta = THETA_E / (1 + THETA_E)
    for side in ("below", "above"):
        s = found[side, n]
        top = n ** -U["extended"]
        level = np.array([np.mean(v < top) / top * n**theta for v in s.extended])
        r.add("4.4", f"N^(theta_e/(1+theta_e)) c / f at scaled f = 1, {SIDES[side]}, N = {n}", "one level", *mean_error(level))
        top = n ** -U["gaps"]
        level = np.array([np.mean(v < top) / top * n ** (-GAMMA * U["gaps"]) for v in s.gaps])
        r.add("4.7", f"N^(-gamma/(1-gamma)) c / h at scaled h = 1, {SIDES[side]}, N = {n}", "one level", *mean_error(level))


def main():
    p = arguments(__doc__.splitlines()[0])
    p.add_argument("--sizes", type=int, nargs="+", help="N (small 128 256; large 256 ... 4096)")
    p.add_argument("--particles", type=float, nargs="+", help="particles of all sizes or of each (small 3e3, large 2e5)")
    o = p.parse_args()
    sizes = o.sizes or ([256, 512, 1024, 2048, 4096] if o.large else [128, 256])
    r = Results(o, "both_sides")
    found = samples(o, ("below", "above"), sizes, o.particles or [2e5 if o.large else 3e3])
    rows(r, found, sizes)
    r.picture(powers(found, sizes), "both_sides_powers")
    r.write(figures(found, sizes))


if __name__ == "__main__":
    main()
