#!/usr/bin/env python3
"""Jammed states around one glass: which one a crunch finds, and how far it lies. Section 7 of the studies, its open questions.

usage: landscape.py [--large] [--folder DIR] [--only-read]

1. Growth (G = 1.732e-2 to p = 500, 1e-3 beyond) stops at p_target; molecular dynamics goes on without growth. Each snapshot is
   crunched: distance of its jammed state from the first one, beside the mean-square displacement between the snapshots.
2. Cage: the mean-square displacement from its middle against p. Marginal glasses have p^-1.4157, normal ones p^-1. These runs
   are too short for slow modes: see cage_size.py.
3. Clones: one configuration, other velocities, crunched after a long time: are three distances those of an ultrametric tree?
4. Memory: diameters of a jammed packing shrink to phi = (1 - x) phi_J, dynamics, crunch: which contacts come back?

Distances are mean squares over spheres that are stable in both packings, the mean displacement taken out, in unit of the mean
diameter squared. Small: N = 128, two packings. Large: N = 1024, ten. Each run is kept when done.
"""
from itertools import combinations

import matplotlib.pyplot as plt
import numpy as np
from common import Results, mean_error, options, seeded

import jam

KAPPA_MF = 1.4157
INSTANTS = 12  # snapshots of part 1
CLONES = 8
SAME = 1e-12  # distance of two clones in one jammed state, diameters squared


def grown(n, seed, pressure):
    packing = jam.System.random(n, seed=seed)
    packing.compress([(1.732e-2, 500.0), (1e-3, pressure)] if pressure > 500 else [(1.732e-2, pressure)])
    return packing


def jammed(packing):
    """A crunched copy, or None when it is not jammed."""
    copy = packing.copy()
    report = copy.crunch()
    return copy if report.jammed else None


def between(a, b):
    """(distance, contacts of a that are in b) of two jammed packings."""
    found = a.compare(b).comparison
    return found.displacement_rms**2, found.overlap_a


def walk(n, seed, pressure, longest):
    """Part 1 and 2: snapshots in time, what their crunches find, and the cage."""
    with grown(n, seed, pressure) as packing:
        first = jammed(packing)
        begin, unit = packing.positions.copy(), packing.diameters.mean()
        use = ~first.rattlers
        state, cage = [], []
        for step in np.diff(np.geomspace(0.5, longest, INSTANTS), prepend=0.0):
            packing.run(step)
            moved = packing.positions - begin
            moved = (moved - np.round(moved))[use]
            moved = moved - moved.mean(axis=0)
            there = jammed(packing)
            msd = np.mean(np.sum(moved**2, axis=1)) / unit**2
            state.append((msd, between(first, there)[0] if there else np.nan))
            cage.append(moved)
        late = np.array(cage[-4:])  # mean square around the mean of late instants, and its bias taken out
        size = np.mean(np.sum((late - late.mean(axis=0)) ** 2, axis=2)) / unit**2 * 4 / 3
        lp = begin - first.positions
        lp = (lp - np.round(lp))[use]
        lp = lp - lp.mean(axis=0)
        return {
            "walk": state,
            "cage": size,
            "pressure": packing.run(20).pressure,
            "lp": np.mean(np.sum(lp**2, axis=1)) / unit**2,
        }


def clones(n, seed, pressure, longest):
    """Part 3: distances of jammed states of clones."""
    rng = np.random.default_rng(seed)
    with grown(n, seed, pressure) as packing:
        ends = []
        for _ in range(CLONES):
            copy = packing.copy()
            velocities = rng.normal(size=(n, 3))
            copy.velocities = velocities - velocities.mean(axis=0)
            copy.run(longest)
            ends.append(jammed(copy))
        ends = [e for e in ends if e]
        return {"d": np.array([[between(a, b)[0] for b in ends] for a in ends])}


def memory(n, seed, shrinks, collisions):
    """Part 4: (distance, contacts found again, change of phi_J) after decompression and dynamics."""
    with grown(n, seed, 1e6) as packing:
        first = jammed(packing)
        found = []
        for x in shrinks:
            copy = first.copy()
            copy.scale_diameters((1 - x) ** (1 / 3))
            copy.run(collisions)
            end = jammed(copy)
            if end is None:
                found.append((np.nan,) * 3)
                continue
            found.append((*between(first, end), end.report.packing_fraction - first.report.packing_fraction))
        return {"memory": found}


def ultrametric(d, same):
    """Over triples of three states: (largest - middle) / (largest - smallest), 0 for an ultrametric tree. same: pairs in one
    state; with two equal states a triple is ultrametric whatever the third one is."""
    values = []
    for k in combinations(range(len(d)), 3):
        pairs = [(k[0], k[1]), (k[0], k[2]), (k[1], k[2])]
        small, middle, large = sorted(d[p] for p in pairs)
        if not any(same[p] for p in pairs) and large > small * (1 + 1e-6):
            values.append((large - middle) / (large - small))
    return np.mean(values) if values else np.nan


def independent(d):
    """Distances of independent displacements of as different lengths: mean squares add up, d_ij = a_i + a_j, by least squares."""
    n, rows = len(d), d.sum(axis=1)
    a = np.maximum((rows - d.sum() / (2 * (n - 1))) / (n - 2), 0.0)
    made = a[:, None] + a[None, :]
    np.fill_diagonal(made, 0.0)
    return made


def walks(o, axes, n, seeds, pressures, longest):
    cages, lps = [], []
    for k, pressure in enumerate(pressures):
        made = seeded(o, f"landscape_n{n}", f"walk{pressure:.0e}_", seeds, lambda s: walk(n, s, pressure, longest))
        if not made:
            continue
        for m in made:
            axes[0].loglog(m["walk"][:, 0], np.maximum(m["walk"][:, 1], 1e-17), "o-", ms=3, lw=0.7, color=f"C{k}")
        axes[0].plot([], [], "o-", ms=3, color=f"C{k}", label=f"p = {pressure:.0e}")
        cages.append([np.log(m["cage"]) for m in made]), lps.append([np.log(m["lp"]) for m in made])
    axes[0].loglog([1e-12, 1e-2], [1e-12, 1e-2], "k--", lw=1, label="equal")
    axes[0].set(xlabel="MSD between snapshots", ylabel="distance of the jammed states")
    axes[0].legend(fontsize=7)
    if len(cages) < 3:
        return
    for values, text in ((np.array(cages), "cage"), (np.array(lps), "MSD_LP")):
        y = np.exp(values.mean(axis=1))
        axes[1].loglog(pressures[: len(y)], y, "o-", label=text)
    for power, style in ((-KAPPA_MF, "k--"), (-1.0, "k:"), (-2.0, "k-.")):
        p = np.array([pressures[0], pressures[-1]])
        axes[1].loglog(p, np.exp(np.mean(cages[0])) * (p / p[0]) ** power, style, lw=1, label=f"p^{power:g}")
    axes[1].set(xlabel="p", ylabel="mean squares")
    axes[1].legend(fontsize=7)


def trees(o, r, axis, n, seeds, pressures, longest):
    for pressure in pressures:
        make = seeded(o, f"landscape_n{n}", f"clones{pressure:.0e}_", 2 * seeds, lambda s: clones(n, s, pressure, longest))
        found = [m["d"] for m in make if len(m["d"]) > 3]
        if not found:
            continue
        value = [ultrametric(d, d < SAME) for d in found]
        blind = [ultrametric(independent(d), d < SAME) for d in found]
        known = [(v, w) for v, w in zip(value, blind) if np.isfinite(v) and np.isfinite(w)]  # not where few states are found
        if len(known) > 1:
            text = f"clones, p = {pressure:.0e}: (largest - middle) / (largest - smallest)"
            r.add("7", text, "0: a tree", *mean_error([v for v, _ in known]))
            text = f"the same, independent displacements of these lengths, p = {pressure:.0e}"
            r.add("7", text, "none", *mean_error([w for _, w in known]))
        upper = np.concatenate([d[np.triu_indices(len(d), 1)] for d in found])
        axis.hist(
            np.log10(np.maximum(upper, 1e-17)), np.arange(-17, 0, 0.5), histtype="step", label=f"p = {pressure:.0e}"
        )
    axis.set(xlabel="lg distance of two clones", ylabel="pairs")
    axis.legend(fontsize=7)


def memories(o, r, axes, n, seeds, collisions):
    shrinks = np.geomspace(1e-6, 0.3, 12)
    found = [m["memory"] for m in seeded(o, f"landscape_n{n}", "memory_", seeds, lambda s: memory(n, s, shrinks, collisions))]
    if not found:
        return
    mean = np.nanmean(found, axis=0)
    for k in (0, 3, 6, 9, 11):
        text = f"memory: contacts that come back from phi = (1 - {shrinks[k]:.0e}) phi_J"
        r.add("7", text, "none", mean[k, 1], np.nanstd(np.array(found)[:, k, 1]) / len(found) ** 0.5)
    axes.semilogx(shrinks, mean[:, 1], "o-", label="contacts that come back")
    axes.semilogx(shrinks, np.exp(-mean[:, 0] / 0.01), "s-", label="exp(-distance / 0.01)")
    axes.set(xlabel="1 - phi / phi_J after decompression", ylabel="mean over packings")
    axes.legend(fontsize=8)


def main():
    o = options(__doc__.splitlines()[0], n=(128, 1024), seeds=(2, 10))
    n, seeds, longest = o.n, o.seeds, 3000.0 if o.large else 300.0
    pressures = 10.0 ** np.arange(2, 9 if o.large else 7)
    r = Results(o, "landscape")
    figure, axes = plt.subplots(1, 4, figsize=(18, 4.5))
    walks(o, axes, n, seeds, pressures, longest)
    trees(o, r, axes[2], n, seeds, pressures[:4], longest)
    memories(o, r, axes[3], n, seeds, longest)
    r.write(figure)


if __name__ == "__main__":
    main()
