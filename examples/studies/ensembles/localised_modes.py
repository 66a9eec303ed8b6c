#!/usr/bin/env python3
"""Localised floppy modes and stability of three models: p(b), Sigma, and the criterion of the median force.

usage: localised_modes.py [--large] [--folder DIR] [--only-read] [--out DIR]

b is the median displacement of a mode over its norm, Sigma = s_return / s_plus; a contact with Sigma < 1 is not stable by this second-order
measure. Mean field: p(b) ~ b^theta_l for localised modes, and b independent of W = f / displacement. For Mari-Kurchan packings and
near-crystals theta_l is about 0, which breaks gamma >= (1 - theta_l) / 2. Localised: at a buckler. The other criterion takes the smallest
force of each sphere as localised and its median force as extended. Spheres and Mari-Kurchan packings are those of final_network.py;
near-crystals are FCC lattices of 108 spheres whose diameters spread by 1 %, grown at G = 1e-3 to p = 1e7. Small: N = 128. Large: 256, 512.
"""
import numpy as np
from common import THETA_E, THETA_L, Results, arguments, mean_error, seeded
from final_network import MODELS, SEEDS, SIZES, network, networks
from thermodynamics import fcc

import jam
from jam import scaling

RANGE = np.array((0.12, 0.4))  # b sqrt N between which one law is fitted: above, modes are extended; below, there are few
LOCALISED, SMALLEST, MEDIAN = (int(c) for c in (jam.ContactClass.LOCALISED, jam.ContactClass.SMALLEST, jam.ContactClass.MEDIAN))


def near_crystal(seed, deviation=1e-2):
    """FCC sites and log-normal diameters."""
    sizes = np.exp(np.log1p(deviation**2) ** 0.5 * np.random.default_rng(seed).normal(size=108))
    with fcc(3, 0.7, sizes, seed) as packing:
        packing.compress([(1e-3, 1e7)])
        return network(packing, "crystal")


def exponent(r, label, values, n, known):
    try:
        law = scaling.tail_exponent([np.sort(v) for v in values], n)
        r.add("modes", label, known, law.value, law.error)
    except ValueError as why:
        print(f"{label}: {why}")


def look(r, text, n, made):
    where = f"{text}, N = {n}"
    local = [(m["flags"] & LOCALISED) != 0 for m in made]
    share = mean_error([np.mean(m["sigma"][u] < 1) for m, u in zip(made, local) if u.any()])
    r.add("modes", f"share of localised contacts with Sigma < 1, {where}", "stable: 0", *share)
    b = [np.sort(m["b"][u]) for m, u in zip(made, local)]
    low, high = RANGE * n**-0.5
    law = scaling.fit_power(b, high, low)
    r.add("modes", f"power of b in p(b) of localised modes, b sqrt N = 0.12 to 0.4, {where}", THETA_L if text == "spheres" else 0.0, law.value, law.error)
    rank = [jam.statistics.spearman(m["b"][u], m["w"][u]) for m, u in zip(made, local) if u.sum() > 5]
    r.add("modes", f"rank correlation of b and W of localised modes, {where}", "0: independent", *mean_error(rank))
    for flag, name, known in ((SMALLEST, "smallest", THETA_L if text == "spheres" else 0.0), (MEDIAN, "median", THETA_E)):
        exponent(r, f"exponent of the {name} force of each sphere, {where}", [m["f"][(m["flags"] & flag) != 0] for m in made], n, known)


def main():
    o = arguments(__doc__.splitlines()[0]).parse_args()
    sizes = SIZES[2:4] if o.large else [128]
    r = Results(o, "localised_modes")
    for model, text in MODELS.items():
        for n in sizes:
            good, _ = networks(o, model, n, SEEDS[SIZES.index(n)] if o.large else 8)
            if len(good) > 3:
                look(r, text, n, good)
    good = [m for m in seeded(o, "localised_modes", "crystal_", 100 if o.large else 8, lambda s: near_crystal(s)) if m["good"]]
    if len(good) > 3:
        look(r, "near-crystals", 108, good)
    r.write()


if __name__ == "__main__":
    main()
