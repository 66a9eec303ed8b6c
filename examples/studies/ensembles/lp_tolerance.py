#!/usr/bin/env python3
"""Does the tolerance of the LPs explain the published pressures of final contacts, numbers of LPs and displacements (2.9, 2.14, 2.16)?

usage: lp_tolerance.py [--large] [--n N] [--seeds K] [--folder DIR] [--only-read] [--out DIR]

Growth at kappa = 5e-3 to p = 500, then at kappa = 3e-5. At each p_target a copy is crunched by this library and by LPs of HiGHS
(scipy) as the thesis writes them, whose feasibility and optimality tolerances are TOLERANCES in a box where sigma^2 = 0.0112, that of the
thesis at N = 1024. LPs stop when max |s_i| < 1e-9, or when the tolerance keeps it from falling further; contacts have forces above 1e-10.
The reference of each method is its packing from the last pressure. Contact k opens by sigma / (p f_k) and the next one forms at s_plus:
contacts should be final above p = max 1 / (f_k s_plus_k). Packings with order or several states of self-stress are left out. Small:
N = 100, 4 seeds. Large: N = 256, 20.
"""
import matplotlib.pyplot as plt
import numpy as np
from common import G_OF_KAPPA, Results, mean_error, options, seeded
from scipy.optimize import linprog
from scipy.sparse import coo_matrix

import jam

KAPPA, SQUARE = 3e-5, 0.0112
PRESSURES = 10.0 ** np.arange(4, 12)
TOLERANCES = (1e-9, 1e-7)
MAX_ORDER = 1.5  # crystal score
REACH, MOST_LPS, LEAST_FORCE, STALLED = 1.5, 30, 1e-10, 1e-8  # pairs to this many diameters are constraints


def one_lp(x, edge, square, tolerance):
    """Displacements, Gamma and the pairs with forces: maximise Gamma, 2 r.(s_i - s_j) - Gamma sigma^2 >= -r^2, |s| bounded."""
    i, j = np.triu_indices(len(x), 1)
    r = x[i] - x[j]
    r -= edge * np.round(r / edge)
    near = np.sum(r**2, axis=1) < REACH**2 * square
    i, j, r = i[near], j[near], r[near]
    rows, m = np.repeat(np.arange(len(i)), 3), len(i)
    column = lambda k: (3 * k[:, None] + np.arange(3)).ravel()  # noqa: E731
    last = np.full(m, 3 * len(x))
    values = np.concatenate([-2 * r.ravel(), 2 * r.ravel(), np.full(m, square)])
    where = (np.concatenate([rows, rows, np.arange(m)]), np.concatenate([column(i), column(j), last]))
    matrix = coo_matrix((values, where), shape=(m, 3 * len(x) + 1)).tocsr()
    bound = (REACH - 1) * square**0.5 / (2 * 3**0.5)
    found = linprog(
        np.r_[np.zeros(3 * len(x)), -1.0], A_ub=matrix, b_ub=np.sum(r**2, axis=1),
        bounds=[(-bound, bound)] * (3 * len(x)) + [(0.5, 2.0)], method="highs-ds",
        options={"primal_feasibility_tolerance": tolerance, "dual_feasibility_tolerance": tolerance, "presolve": False},
    )  # fmt: skip
    if found.status != 0:
        raise RuntimeError(found.message)
    force = -found.ineqlin.marginals * np.sqrt(np.sum(r**2, axis=1))
    kept_pairs = force > LEAST_FORCE
    return found.x[:-1].reshape(-1, 3), found.x[-1], np.stack([i, j], axis=1)[kept_pairs]


def by_lps(packing, tolerance):
    """Contacts, number of LPs, phi, MSD over the stable spheres in diameters squared."""
    edge = SQUARE**0.5 / packing.diameters.mean()
    x, square, moved, step = packing.positions * edge, SQUARE, 0.0, np.inf
    for count in range(1, MOST_LPS + 1):
        s, growth, pairs = one_lp(x, edge, square, tolerance)
        x, square, moved = x + s, square * growth, moved + s
        stable = np.unique(pairs)
        before, step = step, np.abs(s[stable]).max()
        if step < 1e-9 or (growth**0.5 - 1 < STALLED and step > 0.5 * before):
            break
    shift = moved[stable] - moved[stable].mean(axis=0)
    phi = len(x) * np.pi / 6 * square**1.5 / edge**3
    return pairs, count, phi, np.mean(np.sum(shift**2, axis=1)) / square


def by_library(packing):
    with packing.copy() as copy:
        steps = []
        report = copy.crunch(
            on_step=lambda s: steps.append(s.displacements.copy()) if len(s.duals) else None, method="sequential_lp", full_lps=1
        )
        stable, moved = ~copy.rattlers, np.sum(steps, axis=0)
        shift = moved[stable] - moved[stable].mean(axis=0)
        if report.excess_contacts or not report.jammed:
            return None
        f, opening = copy.forces / copy.forces.mean(), copy.floppy_modes().s_plus / copy.diameters.mean()
        settled = np.nanmax(1 / (f * opening)[opening > 0])
        msd = np.mean(np.sum(shift**2, axis=1)) / copy.diameters.mean() ** 2
        return copy.contacts.pairs, len(steps), report.packing_fraction, msd, settled


def growth(n, seed):
    made = {}
    with jam.System.random(n, seed=seed) as packing:
        packing.compress([(5e-3 * G_OF_KAPPA, 500.0)])
        for p in PRESSURES:
            packing.compress([(KAPPA * G_OF_KAPPA, float(p))])
            found = by_library(packing)
            if found is None or packing.crystal_score() > MAX_ORDER:
                return {"good": False}
            *numbers, made[f"settled_{p:.0e}"] = found
            for method, found in [("library", numbers)] + [(f"{t:g}", by_lps(packing, t)) for t in TOLERANCES]:
                for name, value in zip(("pairs", "lps", "phi", "msd"), found):
                    made[f"{name}_{method}_{p:.0e}"] = value
        return {**made, "good": True}


def shared(m, method, p):
    """Share of the contacts of the method's own reference that are there."""
    here, last = (set(map(tuple, np.sort(m[f"pairs_{method}_{q:.0e}"], axis=1).tolist())) for q in (p, PRESSURES[-1]))
    return len(here & last) / len(last)


def final(m, method):
    """Least pressure from which on all contacts of the reference are found; the last pressure where there is none below."""
    same = [shared(m, method, p) == 1.0 for p in PRESSURES]
    first = len(same)
    while first > 0 and same[first - 1]:
        first -= 1
    return PRESSURES[min(first, len(same) - 1)]


def main():
    o = options(__doc__.splitlines()[0], n=(100, 256), seeds=(4, 20))
    n, seeds = o.n, o.seeds
    r = Results(o, "lp_tolerance")
    made = [m for m in seeded(o, f"lp_tolerance_n{n}_kappa{KAPPA:g}", "", seeds, lambda s: growth(n, s)) if m["good"]]
    if not made:
        raise SystemExit(f"no packing of N = {n} has one state of self-stress and no order")
    lg = lambda values: mean_error(np.log10(values))  # noqa: E731
    figure, axes = plt.subplots(1, 3, figsize=(15, 4.4))
    r.add("2.9", "lg of max 1 / (f s_plus), predicted pressure of final contacts", "none", *lg([m[f"settled_{PRESSURES[-1]:.0e}"] for m in made]))
    for k, method in enumerate(["library"] + [f"{t:g}" for t in TOLERANCES]):
        text = "library" if method == "library" else f"LPs with tolerance {method}"
        row = f"{text}: lg of the least p_target with the contacts of its own reference"
        r.add("2.9", row, "kappa = 3e-5: > 11", *lg([final(m, method) for m in made]))
        lps = np.array([[m[f"lps_{method}_{q:.0e}"] for q in PRESSURES] for m in made], float)
        r.add("2.16", f"{text}: LPs from p_target = 1e7 and more", "about 3, never below", *mean_error(lps[:, PRESSURES >= 1e7].mean(axis=1)))
        msd = np.array([[m[f"msd_{method}_{q:.0e}"] for q in PRESSURES] for m in made])
        late = PRESSURES >= 1e5
        power = [np.polyfit(np.log(PRESSURES[late]), np.log(row[late]), 1)[0] for row in msd]
        r.add("2.14", f"{text}: power of p in MSD_LP above 1e5", "0: plateau", *mean_error(power))
        share = np.mean([[shared(m, method, q) for q in PRESSURES] for m in made], axis=0)
        for axis, y in zip(axes, (share, lps.mean(axis=0), np.exp(np.log(msd).mean(axis=0)))):
            axis.plot(PRESSURES, y, "osd^"[k], ls="-", ms=4, mfc="none", label=text)
    axes[0].set(xscale="log", xlabel="p_target", ylabel=f"contacts shared with the packing from {PRESSURES[-1]:.0e}")
    axes[1].set(xscale="log", xlabel="p_target", ylabel="LPs")
    axes[2].set(xscale="log", yscale="log", xlabel="p_target", ylabel="MSD_LP / sigma^2")
    axes[2].plot(PRESSURES, msd.mean(axis=0)[0] * (PRESSURES / PRESSURES[0]) ** -2.0, "k:", lw=1, label="slope -2")
    for axis in axes:
        axis.legend(fontsize=7)
    r.write(figure)


if __name__ == "__main__":
    main()
