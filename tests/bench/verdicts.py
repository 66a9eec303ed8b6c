#!/usr/bin/env python3
"""Verdicts of jam_rigidity, both kinds, flexes and contacts from geometry of a fixed set: share undecided, wrong ones, time.

usage: verdicts.py      with PYTHONPATH set to the built module; JSON to stdout
Wrong: a yes or no of crystals that differs from that of their lattice without noise, as long as this is below the gap of a contact,
or of packings as a crunch left them, each by the linear program of HiGHS and the singular values of tests/bindings/jamming_oracle.py; a
yes of shrunk ones. Of tubes and fluids no other verdict is known.
"""
import itertools
import json
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "bindings"))
from jamming_oracle import judge  # noqa: E402

ROOT3 = np.sqrt(3.0)


def lattice(basis, vectors, m):
    cells = np.array(list(itertools.product(range(m), repeat=len(vectors)))) @ np.array(vectors)
    return (cells[:, None] + np.array(basis)).reshape(-1, len(vectors)), m * np.array(vectors)


LATTICES = {
    "triangular": lattice([[0, 0.0]], [[1, 0], [0.5, ROOT3 / 2]], 8),
    "kagome": lattice([[0, 0.0], [1, 0], [0.5, ROOT3 / 2]], [[2, 0], [1, ROOT3]], 4),
    "square": lattice([[0, 0.0]], np.eye(2), 5),
    "fcc": lattice(np.array([[0, 0, 0.0], [0, 1, 1], [1, 0, 1], [1, 1, 0]]) / 2**0.5, 2**0.5 * np.eye(3), 2),
    "cubic": lattice([[0, 0, 0.0]], np.eye(3), 3),
}
TOUCHING = 1e-10  # the gap of a contact


def wanted(positions, diameters, cell):
    """Collective and strict verdict by another arithmetic."""
    return [("NO", "YES")[judge(positions, diameters, np.asarray(cell), strict)[0]] for strict in (False, True)]


def crystals():
    """Of each lattice without some of its spheres, moved by noise."""
    import jam

    for name, (x, cell) in LATTICES.items():
        for missing, seed in itertools.product((0, 2, 5), (1, 2)):
            keep = np.delete(x, np.random.default_rng(seed).choice(len(x), missing, replace=False), 0)
            exact = wanted(keep, np.ones(len(keep)), cell)
            for noise in (0, 1e-14, 1e-12, 1e-11, 1e-10, 1e-8, 1e-6):
                moved = keep + noise * np.random.default_rng(seed + 100).standard_normal(keep.shape)
                s = jam.System.from_arrays(np.mod(moved @ np.linalg.inv(cell), 1) @ cell, 1.0, cell=cell, overlap="shrink")
                yield f"{name}, noise", noise, s, exact if noise <= TOUCHING / 10 else [None] * 2


def packings():
    import jam

    for dim, n, seed in itertools.product((2, 3), (16, 64, 128), (1, 2)):
        for name, sizes in (("equal", [1.0] * n), ("mixture", [1.0] * (n // 2) + [1.4] * (n // 2))):
            s = jam.System.random(n, dim, seed, diameters=sizes)
            s.compress([(1e-2, 500.0), (3e-3, 1e7)])
            fluid = s.copy()
            s.crunch()
            yield f"{name}, d = {dim}", 0, s, wanted(s.positions, s.diameters, s.cell)
            yield f"{name}, d = {dim}, before", 0, fluid, [None, None]
            for factor in (1e-11, 1e-9, 1e-7, 1e-4):
                t = jam.System.from_arrays(s.positions, s.diameters * (1 - factor), cell=s.cell)
                yield "shrunk", factor, t, ["NO" if factor > TOUCHING else None] * 2
            for digits in (5, 8, 12):
                t = jam.System.from_arrays(np.round(s.positions, digits) % 1, np.round(s.diameters, digits), overlap="shrink")
                yield "few digits", digits, t, [None, None]


def tubes():
    import jam

    for n, seed in itertools.product((20, 60), (1, 2)):
        s = jam.System.random(n, 3, seed, container="cylinder", cell=[3.0, 3.0, n / 8])
        s.compress(growth_rate=1e-2, pressure=500.0)
        s.crunch()
        yield "tube", 0, s, [None, None]


def measure():
    import jam

    rows = []
    for scene, value, s, wanted in itertools.chain(crystals(), packings(), tubes()):
        row = {"scene": scene, "value": value, "n": s.n, "wanted": wanted, "verdict": [], "flex": []}
        began = time.process_time()
        for kind in ("collective", "strict"):
            try:
                row["verdict"].append(s.rigidity(kind).jammed.name)
            except jam.JamError as e:
                row["verdict"].append(e.status.name)
            if row["verdict"][-1] == "NO":
                try:
                    flex = s.flex(kind)
                    row["flex"].append(bool(max(abs(flex.out).max(), abs(flex.strain).max()) > 0))
                except jam.JamError:
                    row["flex"].append(False)
        row["seconds"] = time.process_time() - began
        if "tube" not in scene:
            g = s.copy().contacts_from_geometry()
            row["geometry"] = [g.status.name, g.contacts]
        rows.append(row)
    return rows


if __name__ == "__main__":
    print(json.dumps(measure()))
