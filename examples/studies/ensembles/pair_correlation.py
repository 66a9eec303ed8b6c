#!/usr/bin/env python3
"""g(r) of jammed packings of all sizes, and on the path to jamming: figures 2.10 and 4.2.

usage: pair_correlation.py [--large] [--folder DIR] [--only-read]

Packings are those of finite_size.py and path_to_jamming.py with the same options. g peaks at sqrt 3 and 2 (two triangles, three
spheres in a row); a crystal would show at sqrt 2 and sqrt 7. The number for each: height of g there
over the mean of g 0.15 to the left and to the right.
"""
import matplotlib.pyplot as plt
import numpy as np
from common import Results, arguments, ensemble
from finite_size import MAX_ORDER, protocol
from path_to_jamming import kept_paths

BIN = 0.01  # of r, in mean diameters
WIDTH, FLANK = 0.05, 0.15  # of a window, in mean diameters, and how far those beside it lie
GROUPS = 8  # of packings, for the error
PLACES = (
    ("sqrt 2", 2**0.5, "none"),
    ("sqrt 3", 3**0.5, "peak"),
    ("2", 2.0, "peak"),
    ("sqrt 7", 7**0.5, "none"),
)


def height(r, g, at):
    """Largest smoothed g near `at` over the mean of g at either side of it; and its error over packings."""
    smooth = lambda x, c: x[:, abs(r - c) < WIDTH / 2].mean(axis=1)  # noqa: E731
    groups = [g[k::GROUPS].mean(axis=0) for k in range(min(GROUPS, len(g)))]
    some = np.array(groups)
    best = max((-0.03, 0.0, 0.03), key=lambda x: smooth(some, at + x).mean())
    ratio = smooth(some, at + best) / (0.5 * (smooth(some, at - FLANK) + smooth(some, at + FLANK)))
    return np.mean(ratio), np.std(ratio, ddof=1) / len(ratio) ** 0.5


def rows(result, figure, text, r, g):
    for name, at, published in PLACES:
        if at + FLANK + WIDTH < r[-1]:
            result.add(figure, f"g at {name} over g beside it, {text}", published, *height(r, g, at))


def main():
    p = arguments(__doc__.splitlines()[0])
    p.add_argument("--sizes", type=int, nargs="+", help="N (small: 200 400; large: 256 512 1024 2048)")
    p.add_argument("--particles", type=float, default=5e4, help="with --large: particles a size (5e4)")
    p.add_argument("--n", type=int, help="N of the path (small 256, large 1024)")
    p.add_argument("--seeds", type=int, help="seeds of the path (small 3, large 20)")
    o = p.parse_args()
    result = Results(o, "pair_correlation")
    figure, axes = plt.subplots(1, 2, figsize=(13, 5))
    for shift, n in enumerate(o.sizes or ((256, 512, 1024, 2048) if o.large else (200, 400))):
        e = ensemble(o, protocol("euclid", n), round(o.particles / n) if o.large else 3200 // n)
        found = []
        for entry in e:
            if entry.row["jammed"] and entry.row["crystal_score"] < MAX_ORDER:
                system = entry.system()
                reach = 0.499 * system.cell[0, 0] / system.diameters.mean()
                bins = int(min(reach, 4.0) / BIN)
                found.append(system.pair_correlation(bins * BIN, bins))
        if len(found) < 3:
            continue
        least = min(map(len, found))
        g = np.array([x[:least] for x in found])
        r = (np.arange(least) + 0.5) * BIN
        axes[0].plot(r, g.mean(axis=0) + shift, lw=1, label=f"N = {n}")
        rows(result, "6.5.1", f"N = {n}", r, g)
    for kappa, pressures, made in kept_paths(o):
        r = (np.arange(400) + 0.5) * BIN
        for shift, target in enumerate(pressures):
            g = np.array([m[f"g_{target:.0e}"] for m in made])
            use = slice(0, int(0.45 * 10 ** (1 / 3) * g.shape[1]))
            axes[1].plot(r[use], g.mean(axis=0)[use] + 0.7 * shift, lw=1, label=f"p = {target:.0e}")
        rows(result, "7", f"crunch from p_target = {pressures[-1]:.0e}, kappa = {kappa:g}", r, g)
        break  # one rate in the figure
    for axis, title in zip(axes, ("all sizes, shifted by 1", "crunches from each p_target, shifted by 0.7")):
        for _, at, known in PLACES + (("3", 3.0, "peak"),):
            axis.axvline(at, color="0.6", lw=0.7, ls=":" if known.startswith("none") else "-")
        axis.set(xlabel="r / sigma", ylabel="g", xlim=(0.95, 3.6), ylim=(0, 9), title=title)
        axis.legend(fontsize=7)
    result.write(figure)


if __name__ == "__main__":
    main()
