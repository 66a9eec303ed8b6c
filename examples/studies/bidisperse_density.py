#!/usr/bin/env python3
"""Jamming density of spheres of two sizes against size ratio and share of the large ones, beside published curves.

usage: bidisperse_density.py PICTURE.png [--n 500]      a minute by default

X is the share of the large spheres in the volume of all. Lines: the theory of R. S. Farr and R. D. Groot, J. Chem. Phys. 131,
244104 (2009), which they compare with simulations, as jam.size_report computes it for the same diameters. Black: the limit of
an infinite ratio (C. C. Furnas, Ind. Eng. Chem. 23, 1052 (1931)) with f = 0.6435 of equal spheres. Left of its peak the
small spheres jam around the large ones, 1 / (X + (1 - X) / f); right of it they fit into the voids of the jammed large
ones, f / X. The peak is at X = 1 / (2 - f), with the density 1 - (1 - f)^2. Growth to p = 1000 at G = 0.01, then a crunch.
"""
import argparse

import jam
import matplotlib.pyplot as plt
import numpy as np

EQUAL, RATIOS = 0.6435, (2.0, 3.0, 5.0)
SHARES = (0.0, 0.2, 0.4, 0.55, 0.65, 0.72, 0.8, 0.9, 1.0)


def furnas(x):
    with np.errstate(divide="ignore"):
        return np.minimum(1 / (x + (1 - x) / EQUAL), EQUAL / x)


def diameters(n, ratio, share):
    """n spheres of which the large ones have this share of the volume, as nearly as whole numbers allow."""
    odds = share / (ratio**3 * (1 - share)) if share < 1 else np.inf  # large ones for each small one
    large = n if share == 1 else round(n * odds / (1 + odds))
    return np.r_[np.full(large, float(ratio)), np.ones(n - large)]


def measure(n, ratio, share):
    sizes = diameters(n, ratio, share)
    volume = sizes**3
    s = jam.System.random(n, 3, 1, diameters=sizes)
    s.compress(growth_rate=0.01, pressure=1000)
    r = s.crunch()
    large = sizes > 1
    free = s.rattlers
    return {
        "n": n,
        "ratio": ratio,
        "share": float(volume[large].sum() / volume.sum()),
        "large": int(large.sum()),
        "jammed": r.jammed,
        "packing_fraction": r.packing_fraction,
        "theory": jam.size_report(sizes).jammed_fraction,
        "furnas": float(furnas(volume[large].sum() / volume.sum())),
        "small_rattlers": float(free[~large].mean()) if (~large).any() else float("nan"),
    }


def draw(rows, path):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4))
    x = np.linspace(0, 1, 201)
    left.plot(x, furnas(x), "k-", lw=1, label="infinite ratio (Furnas)")
    for colour, ratio in zip(("#2b6cb0", "#2f855a", "#c05621", "#6b46c1"), RATIOS):
        mine = sorted((r for r in rows if r["ratio"] == ratio), key=lambda r: r["share"])
        shares = [r["share"] for r in mine]
        line = [jam.size_report(diameters(20000, ratio, s)).jammed_fraction for s in x[::4]]
        left.plot(x[::4], line, "-", color=colour, lw=1)
        left.plot(shares, [r["packing_fraction"] for r in mine], "o", ms=4, color=colour, label=f"ratio {ratio:g}")
        loose = [r for r in mine if not r["jammed"]]
        left.plot([r["share"] for r in loose], [r["packing_fraction"] for r in loose], "o", ms=9, mfc="none", color="k")
        mixed = [r for r in mine if r["large"] < r["n"]]
        right.plot([r["share"] for r in mixed], [r["small_rattlers"] for r in mixed], "o-", ms=4, lw=1, color=colour)
    left.set(xlabel="share of the large spheres in the volume, X", ylabel="packing fraction", title="points: libjam (circled: not jammed); lines: Farr and Groot")
    right.set(xlabel="share of the large spheres in the volume, X", ylabel="share of small spheres that are rattlers", ylim=(0, 1.02))
    left.legend(fontsize=8)
    for axis in (left, right):
        axis.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(path, dpi=100)


def main():
    p = argparse.ArgumentParser()
    p.add_argument("picture")
    p.add_argument("--n", type=int, default=500)
    a = p.parse_args()
    rows = []
    print("| ratio | X | large of n | phi_J | Farr and Groot | Furnas | small rattlers |\n|---|---|---|---|---|---|---|")
    for ratio in RATIOS:
        for share in SHARES:
            r = measure(a.n, ratio, share)
            rows.append(r)
            print(f"| {ratio:g} | {r['share']:.3f} | {r['large']} | {r['packing_fraction']:.4f} | {r['theory']:.4f} ", end="")
            print(f"| {r['furnas']:.4f} | {r['small_rattlers']:.2f} |", flush=True)
    draw(rows, a.picture)


if __name__ == "__main__":
    main()
