#!/usr/bin/env python3
"""Jamming density, contacts, LPs and displacements against the pressure where growth stops: figures 2.8, 2.9, 2.14 and 2.16.

usage: path_to_jamming.py [--large] [--n N] [--seeds K] [--kappas K ...] [--folder DIR] [--only-read]

Growth at kappa = 5e-3 to p = 500, then at kappa; at each p_target a copy is crunched by sequential LPs, each solved in full, as
published (kappa: radius rate, G = 2 sqrt(3) kappa). The packing of the largest p_target is the reference of each seed. The
glass branch of the same growth gives phi_J by a fit of 1/p against phi. Small: N = 256, kappa = 1e-3 and 3e-4, 3 seeds.
Large: N = 1024, kappa = 3e-4 to 1e-5, p_target to 1e11, 20 seeds. Each (kappa, seed) is kept when done.
"""
import time

import matplotlib.pyplot as plt
import numpy as np
from common import G_OF_KAPPA, Results, arguments, mean_error, seeded

import jam

STEP_BINS = np.arange(-18.0, 0.01, 0.25)  # of lg |s_i|
STEPS = 4  # points of the glass branch a decade of p
MAX_ORDER = 1.5
PUBLISHED_PHI = {3e-4: 0.64223, 1e-4: 0.64255, 3e-5: 0.64291, 1e-5: 0.64301}  # fit of the glass branch, errors 2e-4
SAME = {3e-4: "1e8", 1e-4: "1e10", 3e-5: "> 1e11", 1e-5: "> 1e11"}


def log_lengths(steps):
    return np.log10(np.maximum(np.linalg.norm(steps, axis=1), 1e-18))


def crunched(packing):
    """Crunch of a copy by LPs: contacts, phi_J, and the displacements |s_i| of the first and the last LP. msd is that of the spheres
    themselves, as published."""
    steps = []
    with packing.copy() as copy:
        begin = time.process_time()
        # not every step is an LP: the polish at the end has no linear contacts
        report = copy.crunch(
            on_step=lambda s: steps.append(s.displacements.copy()) if len(s.duals) else None,
            method="sequential_lp",
            full_lps=1,
        )
        stable = ~copy.rattlers
        moved = np.cumsum(steps, axis=0)[:, stable]
        msd = np.mean(np.sum(moved**2, axis=2), axis=1)
        return {
            "phi": report.packing_fraction,
            "jammed": report.jammed and report.excess_contacts == 0,
            "lps": len(steps),
            "seconds": time.process_time() - begin,
            "contacts": copy.contacts.pairs,
            "first": np.linalg.norm(steps[0][stable], axis=1),
            "last": np.linalg.norm(steps[-1][stable], axis=1),
            "each": [np.histogram(log_lengths(s[stable]), STEP_BINS)[0] for s in steps],
            "msd": msd[[0, min(1, len(msd) - 1), -1]],
            "g": copy.pair_correlation(4.0, 400),
        }


def one(n, seed, kappa, pressures):
    made, p, phi, seconds = {}, [], [], 0.0
    with jam.System.random(n, seed=seed) as packing:
        begin = time.process_time()
        packing.compress([(5e-3 * G_OF_KAPPA, 500.0)])
        seconds += time.process_time() - begin
        for target in pressures:
            begin = time.process_time()
            for step in target * 10.0 ** (np.arange(1 - STEPS, 1) / STEPS):
                md = packing.compress([(kappa * G_OF_KAPPA, float(step))])
                p.append(md.pressure), phi.append(md.packing_fraction)
            seconds += time.process_time() - begin
            made[f"md_seconds_{target:.0e}"] = seconds
            for name, value in crunched(packing).items():
                made[f"{name}_{target:.0e}"] = value
        return {**made, "p": p, "md_phi": phi, "score": packing.crystal_score()}


def numbers(made, name, pressures):
    return np.array([[m[f"{name}_{t:.0e}"] for m in made] for t in pressures], float)


def overlap(m, target, last):
    """Contacts of the reference that are there, over all of the reference."""
    there, reference = (set(map(tuple, m[f"contacts_{t:.0e}"].tolist())) for t in (target, last))
    return len(there & reference) / len(reference)


def glass(r, kappa, made):
    """phi_J by the fit of the glass branch above p = 1e5."""
    fits = [jam.glass_fit(m["md_phi"][m["p"] > 1e5], m["p"][m["p"] > 1e5]) for m in made]
    value, error = mean_error([f.jammed_fraction for f in fits])
    both = np.hypot(error, 2e-4)  # ours and the published one
    r.add("7", f"phi_J by the glass fit, kappa = {kappa:g}", PUBLISHED_PHI.get(kappa, "none"), value, both)


def rows(r, kappa, made, pressures):
    phi, lps = numbers(made, "phi", pressures), numbers(made, "lps", pressures)
    last = pressures[-1]
    shared = np.array([[overlap(m, t, last) for m in made] for t in pressures])
    r.add("7", f"phi_J from p_target = {last:.0e}, kappa = {kappa:g}", "fit above", *mean_error(phi[-1]))
    same = [t for t, q in zip(pressures, shared.min(axis=1)) if q == 1.0]
    text = f"least p_target with the reference's contacts, kappa = {kappa:g}"
    text += f" ({last:.0e}: none below the reference)".replace("e+", "e") if min(same) == last else ""
    r.add("7", text, SAME.get(kappa, "none"), min(same))
    off = abs(phi - phi[-1]).mean(axis=1)
    for k, t in enumerate(pressures):
        r.add("7", f"|phi_J - reference|, kappa = {kappa:g}, p_target = {t:.0e}", "falls to 1e7 and beyond", off[k])
        published = "about 10" if kappa == 3e-4 and t >= 1e7 else "about 3" if kappa < 3e-4 and t >= 1e7 else "none"
        r.add("7", f"LPs of the crunch, kappa = {kappa:g}, p_target = {t:.0e}", published, lps[k].mean())
    far = pressures >= 1e5
    msd = np.array([[m[f"msd_{t:.0e}"][-1] for m in made] for t in pressures]).mean(axis=1)
    slope = np.polyfit(np.log(pressures[far]), np.log(np.maximum(msd[far], 1e-36)), 1)[0]
    r.add("7", f"power of p in MSD_LP above 1e5, kappa = {kappa:g}", "0: plateau", slope)
    return phi, off, shared.mean(axis=1), lps.mean(axis=1)


def draw(axes, kappa, made, pressures, found, first):
    phi, off, shared, lps = found
    label = f"kappa = {kappa:g}"
    axes[0, 0].semilogx(pressures, phi.mean(axis=1), "o-", label=label)
    axes[0, 1].loglog(pressures[:-1], np.maximum(off[:-1], 1e-17), "o-")
    axes[0, 2].semilogx(pressures, shared, "o-")
    axes[0, 3].semilogx(pressures, lps, "o-")
    colour = axes[0, 0].lines[-1].get_color()
    msd = np.array([[m[f"msd_{t:.0e}"] for m in made] for t in pressures]).mean(axis=1)
    for k, style in ((0, "v:"), (1, "s--"), (2, "o-")):
        axes[1, 0].loglog(pressures, msd[:, k], style, ms=3, color=colour)
    if first:
        for k, which in enumerate(("first", "last")):
            for t in pressures:
                s = np.concatenate([m[f"{which}_{t:.0e}"] for m in made])
                axes[1, 1 + k].hist(
                    np.log10(np.maximum(s, 1e-18)), np.arange(-18, 0, 0.25), histtype="step", label=f"p = {t:.0e}"
                )
            axes[1, 1 + k].set(xlabel=f"lg |s_i| of the {which} LP, {label}", ylabel="spheres", yscale="log")
        axes[1, 2].legend(fontsize=6)
    for m in made:
        distance = m[f"phi_{pressures[-1]:.0e}"] - m["md_phi"]
        axes[1, 3].loglog(m["p"][distance > 0], distance[distance > 0] / m["md_phi"][-1], lw=0.5)


def kept_paths(o):
    """[(kappa, pressures, runs)] by the options; runs that are ordered or not isostatic are left out."""
    n, seeds = o.n or (1024 if o.large else 256), o.seeds or (20 if o.large else 3)
    kappas = getattr(o, "kappas", None) or ((3e-4, 1e-4, 3e-5, 1e-5) if o.large else (1e-3, 3e-4))
    pressures = 10.0 ** np.arange(3, 12, 1 if o.large else 2)
    study = f"path_n{n}" + ("" if o.large else "_coarse")
    found = []
    for kappa in kappas:
        there = seeded(o, study, f"kappa{kappa:g}_", seeds, lambda s: one(n, s, kappa, pressures))
        good = [m for m in there if m["score"] < MAX_ORDER and numbers([m], "jammed", pressures).all()]
        print(f"kappa = {kappa:g}: {len(good)} of {len(there)} runs are isostatic and without order")
        if len(good) > 1:
            found.append((kappa, pressures, good))
    return found


def main():
    p = arguments(__doc__.splitlines()[0])
    p.add_argument("--n", type=int, help="spheres (small 256, large 1024)")
    p.add_argument("--seeds", type=int, help="packings (small 3, large 20)")
    p.add_argument("--kappas", type=float, nargs="+", help="radius rates (small 1e-3 3e-4, large 3e-4 1e-4 3e-5 1e-5)")
    o = p.parse_args()
    r = Results(o, "path_to_jamming" + ("_large" if o.large else ""))
    figure, axes = plt.subplots(2, 4, figsize=(17, 8))
    found = kept_paths(o)
    for k, (kappa, pressures, made) in enumerate(found):
        glass(r, kappa, made)
        numbers_found = rows(r, kappa, made, pressures)
        draw(axes, kappa, made, pressures, numbers_found, k == 0)
    texts = ("phi_J", "mean |phi_J - phi_J(largest p)|", "contacts of the reference found", "LPs of the crunch")
    for axis, text in zip(axes[0], texts):
        axis.set(xlabel="p where growth stops", ylabel=text)
    axes[1, 0].set(xlabel="p where growth stops", ylabel="MSD_LP after LP 1 (dotted), 2 (dashed), last")
    axes[1, 3].set(xlabel="p", ylabel="1 - phi / phi_J of the growth")
    axes[1, 3].loglog([1e3, 1e11], [3e-3, 3e-11], "k--", lw=1, label="3 / p")
    axes[0, 0].legend(fontsize=8)
    axes[1, 3].legend(fontsize=8)
    r.write(figure)


if __name__ == "__main__":
    main()
