#!/usr/bin/env python3
"""What errors of linear programs do to contacts and displacements: a hypothesis for figures 2.9 and 2.14 of the thesis.

usage: lp_noise.py [--large] [--n N] [--seeds K] [--folder DIR] [--only-read] [--out DIR]

A jammed packing with one state of self-stress has as many contacts as unknowns, so a linear program (LP) whose constraints carry errors e
moves its spheres by the solution of 2 r.(s_i - s_j) - (Gamma - 1) sigma^2 = e, one equation a contact, without the three translations.
Here e is uniform in +-eps, independent for each contact, in the box of the thesis (sigma^2 = 0.0112 at N = 1024; the tolerance of its LPs
is 1e-9). The contacts change when another pair closes. Beside it: contacts opened by sigma x / (p f), x exponential, as dynamics at the
reduced pressure p leaves them. Where the two displacements are equal, a plateau of the displacement in the LPs begins.
Small: N = 256, 3 packings, 12 draws each. Large: N = 1024, 5 packings, 24 draws.
"""
import matplotlib.pyplot as plt
import numpy as np
from common import Results, options, seeded
from finite_size import protocol
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu

import jam

SQUARE = 0.0112  # sigma^2 of the thesis, box of side 1, N = 1024
ERRORS = (1e-10, 1e-9, 1e-8)
PRESSURES = 10.0 ** np.arange(5, 12)
REACH = 0.05  # gaps over the diameter up to which pairs are tested


def packed(n, seed):
    """Contacts, unit vectors, forces and near pairs of a jammed packing, lengths in diameters."""
    with jam.System.random(n=n, seed=seed) as packing:
        packing.compress([(stage["growth_rate"], stage["pressure"]) for stage in protocol("euclid", n)["stages"]])
        report = packing.crunch()
        gaps = packing.gaps(h_max=REACH, stable_only=1)
        near = np.asarray(gaps.pair)[gaps.gap > 0]
        r = packing.positions[near[:, 0]] - packing.positions[near[:, 1]]
        r = (r - np.round(r)) / packing.diameters.mean()
        contacts = packing.contacts
        return {
            "good": report.jammed and report.excess_contacts == 0,
            "pairs": contacts.pairs,
            "vectors": contacts.vectors,
            "forces": packing.forces,
            "near": near,
            "r": r,
        }


class Network:
    """The square system of one packing; unknowns: displacements but of the first sphere in units of sigma, and Gamma - 1."""

    def __init__(self, m):
        stable, pairs = np.unique(m["pairs"], return_inverse=True)
        pairs, count = pairs.reshape(-1, 2), len(m["pairs"])
        order = {s: k for k, s in enumerate(stable)}
        rows, last = np.repeat(np.arange(count), 3), np.full(count, 3 * len(stable))
        column = lambda k: (3 * pairs[:, [k]] + np.arange(3)).ravel()  # noqa: E731
        n = m["vectors"]  # from the second sphere to the first
        values = np.concatenate([2 * n.ravel(), -2 * n.ravel(), -np.ones(count)])
        where = (np.concatenate([rows, rows, np.arange(count)]), np.concatenate([column(0), column(1), last]))
        matrix = csc_matrix((values, where), shape=(count, 3 * len(stable) + 1))
        self.solver, self.spheres = splu(matrix[:, 3:].tocsc()), len(stable)
        near = np.array([[order.get(i, -1) for i in pair] for pair in m["near"]])
        use = (near >= 0).all(axis=1)
        self.near, self.r = near[use], m["r"][use]

    def answer(self, e):
        """(displacements (spheres, 3) without drift, whether another pair closes) for errors e of the constraints, unit sigma^2."""
        x = self.solver.solve(e)
        s, growth = np.concatenate([np.zeros(3), x[:-1]]).reshape(-1, 3), x[-1]
        left = np.sum(self.r**2, axis=1) - 1.0 - growth
        left += 2 * np.sum(self.r * (s[self.near[:, 0]] - s[self.near[:, 1]]), axis=1)
        return s - s.mean(axis=0), bool((left < 0).any())


def main():
    o = options(__doc__.splitlines()[0], n=(256, 1024), seeds=(3, 5))
    n, seeds, draws = o.n, o.seeds, 24 if o.large else 12
    r = Results(o, "lp_noise")
    made = [m for m in seeded(o, f"lp_noise_n{n}", "", seeds, lambda s: packed(n, s)) if m["good"]]
    networks, rng = [Network(m) for m in made], np.random.default_rng(1)
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.4))
    plateaus = []
    for eps in ERRORS:
        found = [w.answer(eps / SQUARE * rng.uniform(-1, 1, len(m["forces"]))) for w, m in zip(networks, made) for _ in range(draws)]
        msd, changed = np.mean([np.mean(np.sum(s**2, axis=1)) for s, _ in found]), np.mean([c for _, c in found])
        plateaus.append((eps, msd))
        r.add("2.9", f"share of draws whose contacts change, errors of {eps:g} in each constraint, N = {n}", "LPs to 1e-9", changed)
        r.add("2.14", f"MSD_LP / sigma^2 that errors of {eps:g} in each constraint make, N = {n}", "a plateau", msd)
        axes[1].axhline(msd, color="0.6", ls=":")
        axes[1].text(PRESSURES[0], msd, f" errors of {eps:g}", va="bottom", fontsize=8)
    for m, w in zip(made, networks):
        msd, changed = [], []
        for p_target in PRESSURES:
            opened = [rng.exponential(size=len(m["forces"])) / (p_target * m["forces"] / m["forces"].mean()) for _ in range(draws)]
            found = [w.answer(-2 * h) for h in opened]
            msd.append(np.mean([np.mean(np.sum(s**2, axis=1)) for s, _ in found])), changed.append(np.mean([c for _, c in found]))
        axes[0].semilogx(PRESSURES, changed, "o-"), axes[1].loglog(PRESSURES, msd, "o-")
        power, level = np.polyfit(np.log(PRESSURES), np.log(msd), 1)
        for eps, plateau in plateaus:
            crossing = np.exp((np.log(plateau) - level) / power)
            if m is made[0]:
                r.add("2.14", f"pressure where MSD_LP falls below that of errors of {eps:g}, first packing, N = {n}", "a plateau", crossing)
    axes[0].set(xlabel="p", ylabel="share of draws whose contacts change")
    axes[1].set(xlabel="p", ylabel="MSD_LP / sigma^2; dotted: errors of LPs alone")
    r.write(figure)


if __name__ == "__main__":
    main()
