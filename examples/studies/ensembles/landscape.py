#!/usr/bin/env python3
"""Jammed states around one glass: which one a crunch finds, and how far it lies: open questions of chapter 2.

usage: landscape.py [--large] [--folder DIR] [--only-read]

Clones: growth (G = 1.732e-2 to p = 500, 1e-3 beyond) stops at p_target; from this configuration runs with other velocities are crunched
   after a long time: are three distances those of an ultrametric tree?
Memory: diameters of a jammed packing shrink to phi = (1 - x) phi_J, dynamics, crunch: which contacts come back?

Distances are mean squares over spheres that are stable in both packings, the mean displacement taken out, in unit of the mean
diameter squared. Small: N = 128, two packings. Large: N = 1024, ten. Each run is kept when done.
"""
from itertools import combinations

import numpy as np
from common import Results, mean_error, options, seeded

import jam

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


def clones(n, seed, pressure, longest):
    """Distances of jammed states of clones."""
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
        return {"d": np.array([[a.compare(b).comparison.displacement_rms ** 2 for b in ends] for a in ends])}


def memory(n, seed, shrinks, collisions):
    """Share of the contacts that is found again after decompression and dynamics."""
    with grown(n, seed, 1e6) as packing:
        first = jammed(packing)
        found = []
        for x in shrinks:
            copy = first.copy()
            copy.scale_diameters((1 - x) ** (1 / 3))
            copy.run(collisions)
            end = jammed(copy)
            found.append(first.compare(end).comparison.overlap_a if end else np.nan)
        return {"share": found}


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


def trees(o, r, n, seeds, longest):
    for pressure in (1e2, 1e3, 1e4, 1e5):
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


def memories(o, r, n, seeds, collisions):
    shrinks = np.geomspace(1e-6, 0.3, 12)
    found = [m["share"] for m in seeded(o, f"landscape_n{n}", "found_again_", seeds, lambda s: memory(n, s, shrinks, collisions))]
    if not found:
        return
    for k in (0, 3, 6, 9, 11):
        back = np.array(found)[:, k]
        text = f"memory: contacts that come back from phi = (1 - {shrinks[k]:.0e}) phi_J"
        r.add("7", text, "none", np.nanmean(back), np.nanstd(back) / len(found) ** 0.5)


def main():
    o = options(__doc__.splitlines()[0], n=(128, 1024), seeds=(2, 10))
    n, seeds, longest = o.n, o.seeds, 3000.0 if o.large else 300.0
    r = Results(o, "landscape")
    trees(o, r, n, seeds, longest)
    memories(o, r, n, seeds, longest)
    r.write()


if __name__ == "__main__":
    main()
