#!/usr/bin/env python3
"""Jamming density, contacts and work of the crunch against the pressure where growth stops: section 7 of the studies.

usage: path_to_jamming.py [--large] [--folder DIR] [--only-read]

Growth at kappa = 5e-3 to p = 500, then at kappa to p_target, crunch (kappa: radius rate, G = 2 sqrt(3) kappa). The packing
of the largest p_target is the reference of each seed. Small: N = 128, kappa = 3e-4 and 1e-3, 4 seeds. Large: N = 1024,
kappa = 3e-4 to 1e-5, p_target to 1e11, 20 seeds. Each (kappa, p_target) is an ensemble, so a run that was killed goes on.
"""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from common import Results, arguments, ensemble, mean_error

G_OF_KAPPA = 2 * 3**0.5


def protocol(n, kappa, pressure):
    stages = [
        {"growth_rate": 5e-3 * G_OF_KAPPA, "pressure": 500.0},
        {"growth_rate": kappa * G_OF_KAPPA, "pressure": pressure},
    ]
    return dict(n=n, dim=3, stages=stages, analysis={"crystal_score": {}})


def contacts_of(entry):
    return set(map(tuple, entry.pairs.tolist()))


def main():
    p = arguments(__doc__.splitlines()[0])
    p.add_argument("--n", type=int, help="spheres (small 128, large 1024)")
    p.add_argument("--seeds", type=int, help="packings (small 4, large 20)")
    o = p.parse_args()
    n, seeds = o.n or (1024 if o.large else 128), o.seeds or (20 if o.large else 4)
    kappas = (3e-4, 1e-4, 3e-5, 1e-5) if o.large else (1e-3, 3e-4)
    pressures = 10.0 ** np.arange(3, 12 if o.large else 11, 1 if o.large else 2)
    r = Results(o, "path_to_jamming")
    figure, axes = plt.subplots(1, 4, figsize=(16, 4))
    for kappa in kappas:
        sets = {}
        for target in pressures:
            e = ensemble(o, protocol(n, kappa, float(target)), seeds)
            sets[target] = {x.seed: x for x in e if x.row["jammed"] and x.row["crystal_score"] < 1.5}
            r.used(e, len(sets[target]))
        common = sorted(set.intersection(*(set(s) for s in sets.values())))
        if len(common) < 2:
            continue
        phi = np.array([[sets[t][s].row["packing_fraction"] for s in common] for t in pressures])
        reference = [contacts_of(sets[pressures[-1]][s]) for s in common]
        overlap = [
            np.mean([len(contacts_of(sets[t][s]) & c) / len(c) for s, c in zip(common, reference)]) for t in pressures
        ]
        solves = [np.mean([sets[t][s].row["lp_solves"] for s in common]) for t in pressures]
        work = [np.mean([sets[t][s].row["factorisations"] for s in common]) for t in pressures]
        same = [t for t, q in zip(pressures, overlap) if q == 1.0]
        mean, error = mean_error(phi[-1])
        r.add("7", f"phi_J, kappa = {kappa:g}, p_target = {pressures[-1]:.0e}", "see growth_rate_table", mean, error)
        published = {3e-4: 1e8, 1e-4: 1e10}.get(kappa, "> 1e11" if kappa < 1e-4 else "none")
        r.add("7", f"least p_target with the reference's contacts, kappa = {kappa:g}", str(published), min(same))
        label = f"kappa = {kappa:g}"
        axes[0].semilogx(pressures, phi.mean(axis=1), "o-", label=label)
        off = abs(phi - phi[-1]).mean(axis=1)[:-1]
        axes[1].loglog(pressures[:-1], np.maximum(off, 1e-17), "o-")
        axes[2].semilogx(pressures, overlap, "o-")
        axes[3].semilogx(pressures, work, "o-")
        for t, d, q, k, w in zip(pressures, abs(phi - phi[-1]).mean(axis=1), overlap, solves, work):
            r.add("7", f"|phi_J - reference|, kappa = {kappa:g}, p_target = {t:.0e}", "falls to 1e7 and beyond", d)
            r.add("7", f"contacts of the reference found, kappa = {kappa:g}, p_target = {t:.0e}", "rises to 1", q)
            r.add("7", f"LPs solved in full, kappa = {kappa:g}, p_target = {t:.0e}", "3 to 10 at high p", k)
            r.add("7", f"factorisations, kappa = {kappa:g}, p_target = {t:.0e}", "none", w)
    texts = ("phi_J", "mean |phi_J - phi_J(largest p)|", "contacts of the reference found", "factorisations")
    for axis, text in zip(axes, texts):
        axis.set(xlabel="p where growth stops", ylabel=text)
    axes[0].legend(fontsize=8)
    r.write(figure)


if __name__ == "__main__":
    main()
