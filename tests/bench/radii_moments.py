"""Maxima of a factor of three moments: how many calls find one, contacts, spheres without contacts, packing fraction, time.

usage: radii_moments.py PACKINGS     of each size; writes results/radii_moments.json
"""
import sys
import time
from pathlib import Path

import numpy as np

import jam

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "bindings/docs"))

import figures  # noqa: E402

packings, rows = int(sys.argv[1]), []
for dim, n in ((2, 16), (2, 64), (2, 256), (3, 16), (3, 64)):
    found, begun = [], time.perf_counter()
    for seed in range(1, packings + 1):
        sizes = np.random.default_rng(seed).uniform(0.6, 1.4, n)
        packing = jam.System.random(n=n, dim=dim, seed=seed, diameters=sizes)
        report = packing.maximise_radii(moments=(1, 2, 3))
        if report.maximum:
            found.append(report)
    simple = sum(r.excess == 0 for r in found)
    explained = sum(r.excess == -dim * r.rattlers for r in found)
    rattlers = sum(r.rattlers for r in found)
    fraction = np.mean([r.packing_fraction for r in found])
    residual = max(r.moment_residual for r in found)
    seconds = (time.perf_counter() - begun) / packings
    rows.append([dim, n, packings, len(found), simple, explained, rattlers, f"{fraction:.4f}", f"{residual:.0e}", f"{seconds:.2g}"])
    print(*rows[-1], flush=True)
names = ["d", "n", "calls", "maxima", "excess 0", "excess -d rattlers", "rattlers", "mean packing fraction", "largest error of a moment", "seconds"]
figures.save(HERE / "results/radii_moments.json", "radii_moments.py", names, rows)
