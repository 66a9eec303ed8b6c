#!/usr/bin/env python3
"""Processor seconds of every call against N, a panel for each section of jam.h, with the exponents of call and task.

usage: scaling.py OUT.json [PICTURE.png]

Spheres in d = 3: fluids of packing fraction 0.3, and packings that a crunch jammed. A call stops at the first size that takes
more than LIMIT seconds. An exponent is that of the two largest sizes whose seconds are above CLOCK. The table keeps the calls
that take more than LONG seconds or grow faster than their task, by EXCESS. About a minute of processor time. PYTHONPATH: the
built module.
"""
import math
import os
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import jam

sys.path.append(str(Path(__file__).resolve().parents[2] / "bindings/docs"))
import figures  # noqa: E402

FLUID, JAMMED, FEW = (1000, 4000, 16000, 64000), (128, 256, 512, 1024), (128, 256, 512)
LIMIT, LONG, CLOCK, EXCESS = 3.0, 1.0, 2e-4, 0.3
LOCAL, SPARSE, DENSE = 1, 2, 3  # sums over neighbours; a sparse factor in d = 3, of N^2 operations; a dense matrix
EACH = 7 / 3  # a solve of N^(4/3) operations for each of N contacts
AXIS = np.array([0.5, 0.0, 0.0])
GROWN = {}  # N: a packing before its crunch


def in_folder(write):
    def call(s):
        with tempfile.TemporaryDirectory() as folder:
            write(s, os.path.join(folder, "packing"))

    return call


def reread(s, name):
    s.write(name + ".xyz")
    jam.System.read(name + ".xyz")


def reload(s, name):
    s.write_checkpoint(name)
    jam.System.from_checkpoint(name)


# section: {call: (sizes, exponent of the task, function)}
SECTIONS = {
    "dynamics, Monte Carlo, crunch": {
        "run, 10 collisions": (FLUID, LOCAL, lambda s: s.copy().run(10)),
        "monte_carlo, 10 sweeps": (FLUID, LOCAL, lambda s: s.copy().monte_carlo(sweeps=10, step=0.1)),
        "compress": (JAMMED, LOCAL, lambda s: grown(s.n)),
        "crunch": (JAMMED, SPARSE, lambda s: grown(s.n, kept=GROWN).copy().crunch()),
        "estimate_crunch": (JAMMED, SPARSE, lambda s: s.estimate_crunch()),
    },
    "the cell": {
        "tile": (FLUID, LOCAL, lambda s: s.tile((2, 1, 1))),
        "strain": (FLUID, LOCAL, lambda s: s.copy().strain(1e-3 * np.eye(3))),
    },
    "files": {
        "write, read": (FLUID, LOCAL, in_folder(reread)),
        "checkpoint": (FLUID, LOCAL, in_folder(reload)),
        "page": (FLUID, LOCAL, in_folder(lambda s, name: s.page(name + ".html"))),
    },
    "soft spheres": {
        "relax": (FEW, SPARSE, lambda s: soft(s).relax()),
        "decompress": (FEW, SPARSE, lambda s: soft(s).decompress(crunch=0)),
        "shear, 10 steps": (FEW, SPARSE, lambda s: soft(s).shear(1e-3, step=1e-4)),
    },
    "Hessian, modes": {
        "hessian": (JAMMED, LOCAL, lambda s: s.hessian()),
        "hessian_map": (JAMMED, LOCAL, lambda s: s.hessian_map()),
        "modes, 10": (JAMMED, SPARSE, lambda s: s.modes(10)),
        "modes, all": (FEW, DENSE, lambda s: s.modes(which="all")),
        "bloch_modes": (FEW, DENSE, lambda s: s.bloch_modes(AXIS)),
    },
    "network from geometry": {
        "contacts_from_geometry": (JAMMED, SPARSE, lambda s: s.copy().contacts_from_geometry()),
        "contacts_by_distance": (JAMMED, LOCAL, lambda s: s.copy().contacts_by_distance(0.1)),
        "stress_states": (JAMMED, SPARSE, lambda s: s.stress_states()),
    },
    "jammed or not, proof": {
        "check": (JAMMED, SPARSE, lambda s: s.check()),
        "rigidity": (JAMMED, SPARSE, lambda s: s.rigidity()),
        "strict": (JAMMED, SPARSE, lambda s: s.copy().rigidity("strict")),
        "bloch_rigidity": (JAMMED, SPARSE, lambda s: s.bloch_rigidity((2, 1, 1))),
        "prove": (JAMMED, SPARSE, lambda s: s.prove()),
    },
    "gaps, classes, angles": {
        "gaps": (FLUID, LOCAL, lambda s: s.gaps(0.5, stable_only=False)),
        "contact_classes": (JAMMED, LOCAL, lambda s: s.contact_classes()),
        "contact_dots": (JAMMED, LOCAL, lambda s: s.contact_dots(False)),
        "sphere_structure": (JAMMED, LOCAL, lambda s: s.sphere_structure(False)),
        "local_values": (JAMMED, LOCAL, lambda s: s.local_values("force_dot", "all")),
        "fabric_tensor": (JAMMED, LOCAL, lambda s: s.fabric_tensor()),
    },
    "structure": {
        "pair_correlation": (FLUID, LOCAL, lambda s: s.pair_correlation(r_max=3.0)),
        "structure_factor": (FLUID, LOCAL, lambda s: s.structure_factor(10.0)),
        "bond_order": (FLUID, LOCAL, lambda s: s.bond_order(6, 1.4)),
        "crystal_score": (FLUID, LOCAL, lambda s: s.crystal_score()),
        "local_fraction": (FLUID, LOCAL, lambda s: s.local_fraction()),
        "near_coordination": (FLUID, LOCAL, lambda s: s.near_coordination(0.5)),
    },
    "the pore space": {
        "solid_profile": (FLUID, LOCAL, lambda s: s.solid_profile(2, 100)),
        "pore_sizes": (FLUID, LOCAL, lambda s: s.pore_sizes(1000, 1)),
        "image": (FLUID, LOCAL, lambda s: s.image(size=s.diameters[0] / 4)),
        "write_stl": (FLUID, LOCAL, in_folder(lambda s, name: s.write_stl(name + ".stl"))),
    },
    "floppy modes": {
        "floppy_mode": (JAMMED, SPARSE, lambda s: s.floppy_mode(0)),
        "floppy_modes": (JAMMED, EACH, lambda s: s.floppy_modes()),
    },
    "spectrum, moduli, comparison": {
        "density_of_states": (JAMMED, LOCAL, lambda s: s.density_of_states()),
        "moduli": (JAMMED, SPARSE, lambda s: s.moduli()),
        "elastic_tensor": (JAMMED, SPARSE, lambda s: s.elastic_tensor()),
        "compare": (JAMMED, LOCAL, lambda s: s.compare(s)),
    },
}


def soft(s):
    return jam.System.random(s.n, 3, 1, packing_fraction=0.70, overlap="allow")


def grown(n, kept=None):
    if kept and n in kept:
        return kept[n]
    s = jam.System.random(n, 3, 1, packing_fraction=0.2)
    s.compress()
    return s


def start(n, jammed, kept={}):
    if (n, jammed) not in kept:
        s = jam.System.random(n, 3, 1, packing_fraction=0.3) if not jammed else grown(n)
        if jammed:
            GROWN[n] = s.copy()
            s.crunch()
        kept[n, jammed] = s
    return kept[n, jammed]


def seconds(call, s):
    """The least of several runs, of up to a quarter of a second together."""
    times = []
    while not times or (sum(times) < 0.25 and len(times) < 9):
        began = time.process_time()
        call(s)
        times.append(time.process_time() - began)
    return min(times)


def exponent(points):
    above = [p for p in points if p[1] > CLOCK][-2:]
    return math.log(above[1][1] / above[0][1]) / math.log(above[1][0] / above[0][0]) if len(above) > 1 else math.nan


def measured():
    found = {}
    for section, calls in SECTIONS.items():
        for name, (sizes, task, call) in calls.items():
            points = []
            for n in sizes:
                points.append((n, seconds(call, start(n, sizes is not FLUID))))
                if points[-1][1] > LIMIT:
                    break
            found[section, name] = points, task, exponent(points)
            print(section, name, [f"{n}: {t:.2g}" for n, t in points], f"{found[section, name][2]:.2f} of {task:.2f}", flush=True)
    return found


def draw(found, picture):
    import matplotlib.pyplot as plt
    from matplotlib.ticker import NullFormatter

    figure, axes = plt.subplots(3, 4, figsize=(15, 10))
    for axis, section in zip(axes.flat, SECTIONS):
        for (of, name), (points, task, slope) in found.items():
            if of == section:
                measured_as = "" if math.isnan(slope) else f"  {slope:.1f} ({task:.1f})"
                axis.loglog(*zip(*points), "o-", ms=3, label=name + measured_as)
        axis.set_title(section, fontsize=10)
        axis.set_xlim(100, 1e5)
        axis.yaxis.set_minor_formatter(NullFormatter())
        axis.legend(fontsize=7)
    for axis in axes[-1]:
        axis.set_xlabel("N")
    for axis in axes[:, 0]:
        axis.set_ylabel("processor seconds")
    figure.tight_layout()
    figure.savefig(picture, dpi=80)


if __name__ == "__main__":
    results = measured()
    rows = [
        [name, points[-1][0], points[-1][1], round(slope, 2), round(task, 2)]
        for (_, name), (points, task, slope) in results.items()
        if points[-1][1] > LONG or slope > task + EXCESS
    ]
    figures.save(sys.argv[1], "scaling.py OUT.json PICTURE.png", ["call", "N", "seconds", "exponent", "of its task"], rows)
    if len(sys.argv) > 2:
        draw(results, sys.argv[2])
