#!/usr/bin/env python3
"""D(omega) of the linear contact network of each LP of a crunch, from below jamming up to it.

usage: undercompressed_spectrum.py PICTURE.png [N] [PRESSURE] [PACKINGS]
Below jamming no two spheres touch, but the pairs with a positive multiplier in an LP carry forces lambda r that balance on every
sphere: a network with a Hessian S^T S of its own, where S has a row n_ij a pair. The distance to jamming is the gain
sqrt(Gamma) - 1 of the LP. LPs of several packings are pooled by two decades of the gain; those in which a step bound holds a
sphere, and so takes part in the balance, stand apart. A few LPs are degenerate: a contact without force, one zero mode.
Prints, for each pool, the LPs, contacts above isostatic, the largest imbalance of a sphere over the mean force, and zero modes
beyond the translations. Needs the Python package `jam`, numpy, matplotlib.
"""
import sys

import matplotlib.pyplot as plt
import numpy as np

import jam


def stable_part(pairs, n, dim):
    """Rows that remain when spheres with fewer than d + 1 contacts are removed recursively."""
    keep = np.ones(len(pairs), bool)
    while True:
        z = np.bincount(pairs[keep].reshape(-1), minlength=n)
        bad = keep & ((z[pairs] < dim + 1).any(axis=1))
        if not bad.any():
            return keep, np.flatnonzero(z > 0)
        keep &= ~bad


def network(packing):
    """The linear network of the LP that has just ended, or None."""
    step = packing.crunch_step()
    pairs, r, duals = step.pair, step.vector, step.dual
    if len(pairs) == 0:
        return None
    sums = np.zeros((packing.n, packing.dim))
    np.add.at(sums, pairs[:, 0], duals[:, None] * r)
    np.subtract.at(sums, pairs[:, 1], duals[:, None] * r)
    imbalance = np.abs(sums).max() / (duals * np.sqrt((r**2).sum(axis=1))).mean()
    keep, spheres = stable_part(pairs, packing.n, packing.dim)
    if not keep.any():
        return None
    pairs, r = pairs[keep], r[keep]
    node = np.full(packing.n, -1)
    node[spheres] = np.arange(len(spheres))
    length = np.sqrt((r**2).sum(axis=1))
    rows, d = np.arange(len(pairs))[:, None], np.arange(packing.dim)
    s = np.zeros((len(pairs), packing.dim * len(spheres)))
    np.add.at(s, (rows, packing.dim * node[pairs[:, :1]] + d), r / length[:, None])
    np.subtract.at(s, (rows, packing.dim * node[pairs[:, 1:]] + d), r / length[:, None])
    values = np.linalg.eigvalsh(s.T @ s)
    zero = int((values < 1e-10 * values[-1]).sum())
    return {
        "omega": np.sqrt(np.maximum(values[packing.dim :], 0)),
        "zeros": zero - packing.dim,
        "excess": len(pairs) - packing.dim * (len(spheres) - 1) - 1,
        "imbalance": imbalance,
    }


def crunch(seed, n, pressure):
    """All linear networks of one crunch by sequential LPs, each with the gain of its LP."""
    found = []
    with jam.System.random(n=n, dim=3, seed=seed) as packing:
        packing.compress(stages=[(1e-2, pressure)])

        def look(progress):
            try:
                here = network(packing)
            except jam.errors.StateError:  # called between steps
                return False
            if here:
                found.append(here)
            return False

        packing.crunch(method="sequential_lp", steps=1, full_lps=1, progress=look)
        lps = packing.history[packing.history["phase"] == 2]
        gains, held = lps["gain"], lps["held"]
    if len(gains) != len(found):
        sys.exit(f"seed {seed}: {len(gains)} LPs in the history, {len(found)} seen")
    return [dict(item, gain=g, held=h > 0) for item, g, h in zip(found, gains, held)]


def pool(step):
    """Sort key and name of the pool an LP belongs to."""
    if step["held"]:
        return 2, "a step bound is active"
    if step["gain"] < 1e-11:
        return -99, "at jamming"
    low = int(2 * np.floor(np.log10(step["gain"]) / 2))
    return low, f"1e{low} .. 1e{low + 2}"


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    n, pressure, packings = (
        kind(sys.argv[k]) if len(sys.argv) > k else default
        for k, kind, default in ((2, int, 256), (3, float, 30.0), (4, int, 5))
    )
    steps = [step for seed in range(1, packings + 1) for step in crunch(seed, n, pressure)]
    groups = {}
    for step in steps:
        groups.setdefault(pool(step), []).append(step)
    figure, axes = plt.subplots(1, 2, figsize=(12, 4.8))
    bins = np.linspace(0, 3, 46)
    print(f"{'gain':>24} {'LPs':>4} {'excess contacts':>16} {'imbalance':>10} {'zero modes':>10}")
    for (place, name), group in sorted(groups.items(), reverse=True):
        colour = "0.6" if group[0]["held"] else "tab:red" if place == -99 else plt.cm.viridis(min(0.9, -place / 14))
        excess = [g["excess"] for g in group]
        print(
            f"{name:>24} {len(group):4d} {np.mean(excess):8.1f} +- {np.std(excess):4.1f} {max(g['imbalance'] for g in group):10.1e}"
            f" {np.mean([g['zeros'] for g in group]):10.1f}"
        )
        omega = np.sort(np.concatenate([g["omega"] for g in group]))
        height, _ = np.histogram(omega, bins, density=True)
        axes[0].step(
            bins[:-1],
            height,
            where="post",
            color=colour,
            label=f"√Γ - 1: {name}" if place < 2 and place > -99 else name,
        )
        axes[1].loglog(omega, np.arange(1, len(omega) + 1) / len(omega), color=colour)
    x = np.geomspace(1e-3, 1, 10)
    axes[1].plot(x, 0.3 * x, "k:", label="~ omega: flat D(omega)")
    axes[0].set(xlabel="omega", ylabel="D(omega)", title=f"{packings} crunches, N = {n}, from p = {pressure:g}")
    axes[1].set(xlabel="omega", ylabel="share of modes below omega", xlim=(1e-4, 5))
    for axis in axes:
        axis.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(sys.argv[1], dpi=100)


if __name__ == "__main__":
    main()
