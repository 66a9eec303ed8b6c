#!/usr/bin/env python3
"""Exponent of the density of all forces in d = 2, 3 and 4, by one method and at one number of spheres.

usage: force_dimensions.py [--large] [--seeds K] [--folder DIR] [--only-read] [--out DIR]

Published for all forces together: 0.19 (d = 2), 0.25 (d = 3), 0.30 (d = 4). Fits as in tail_exponents.py: the error contains the
choice of range and correction. Disks have diameters 1 and 1.4 in equal numbers. Small: N = 1024, 8 packings. Large: N = 2048, 40.
"""
import numpy as np
from common import Results, options, seeded

import jam
from jam.scaling import tail_exponent

PUBLISHED = {2: 0.19, 3: 0.25, 4: 0.30}


def forces(dim, n, seed):
    """Forces of a grown and crunched packing over their mean; none when it has no single state of self-stress."""
    sizes = {"diameters": [1.0] * (n // 2) + [1.4] * (n - n // 2)} if dim == 2 else {}
    with jam.System.random(n=n, dim=dim, seed=seed, **sizes) as packing:
        packing.compress([(1e-2, 500.0), (3e-3, 1e7)])
        report = packing.crunch()
        good = report.jammed and report.excess_contacts == 0
        return {"forces": np.sort(packing.forces / packing.forces.mean()) if good else np.zeros(0)}


def main():
    o = options(__doc__.splitlines()[0], seeds=(8, 40))
    n, seeds = 2048 if o.large else 1024, o.seeds
    r = Results(o, "force_dimensions")
    for dim, law in PUBLISHED.items():
        made = seeded(o, f"force_dimensions_{dim}d_n{n}", "", seeds, lambda s: forces(dim, n, s))
        values = [m["forces"] for m in made if m is not None and len(m["forces"])]
        if len(values) < 4:
            continue
        fit = tail_exponent(values, n)
        r.add("1, 3", f"d = {dim}: exponent of all forces, averaged over ranges", law, fit.value, fit.error)
    r.write()


if __name__ == "__main__":
    main()
