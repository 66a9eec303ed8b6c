"""Maxima of a factor of three moments: how many calls find one, contacts, spheres without contacts, packing fraction, time.
And a chart: by how much value is below that of the maximum against the processor time at which a call is stopped.

usage: radii_moments.py PACKINGS PICTURE.png    of each size PACKINGS; writes results/radii_moments.json
       radii_moments.py 0 PICTURE.png           the chart alone
"""
import sys
import time
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import jam  # noqa: E402

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "bindings/docs"))

import figures  # noqa: E402


def packing_of(dim, n, seed, walls=""):
    sizes = np.random.default_rng(seed).uniform(0.6, 1.4, n)
    return jam.System.random(n=n, dim=dim, seed=seed, diameters=sizes, walls=walls)


def table(packings):
    rows = []
    for dim, n in ((2, 16), (2, 64), (2, 256), (3, 16), (3, 64)):
        found, begun = [], time.perf_counter()
        for seed in range(1, packings + 1):
            report = packing_of(dim, n, seed).maximise_radii(moments=(1, 2, 3))
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
    figures.save(HERE / "results/radii_moments.json", f"radii_moments.py {packings} PICTURE.png", names, rows)


def stopped(start, steps, **options):
    """Value and processor seconds of a call that may make so many steps."""
    packing, begun = start.copy(), time.process_time()
    report = packing.maximise_radii(max_steps=steps, **options)
    return report.value, time.process_time() - begun, report.steps


def chart(picture):
    figure, axis = plt.subplots(figsize=(6.4, 4.6), layout="constrained")
    scenes = (
        ("26 disks in a square, sum", (2, 26, 1, "xy"), {}),
        ("256 disks, sum", (2, 256, 1), {}),
        ("256 disks, three moments", (2, 256, 1), {"moments": (1, 2, 3)}),
        ("256 spheres, three moments", (3, 256, 1), {"moments": (1, 2, 3)}),
    )
    for name, scene, options in scenes:
        start = packing_of(*scene)
        value, _, last = stopped(start, 10**6, **options)
        ends = [stopped(start, k, **options)[:2] for k in range(2, last + 1, max(1, last // 20))]
        below = [max(1 - v / value, 1e-16) for v, _ in ends]
        axis.loglog([t for _, t in ends], below, ".-", label=f"{name}: {last} steps")
    axis.set(xlabel="processor seconds", ylabel="1 - value / value at the maximum")
    axis.legend(fontsize=8)
    figure.savefig(picture, dpi=90)


if int(sys.argv[1]):
    table(int(sys.argv[1]))
chart(sys.argv[2])
