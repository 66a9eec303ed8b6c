#!/usr/bin/env python3
"""Modes and flexes of L x L copies of a packing of disks: from one cell by wave vectors, and directly.

python3 tests/bench/bloch.py [--n 24] [--copies 1,2,3,4,6,8] [--direct 6] [--out bloch.json] [--picture bloch.png]
Processor time, one thread. The direct modes, a dense problem of the copies, are left out beyond --direct.
"""
import argparse
import json
import time
from itertools import product
from pathlib import Path

import jam
import numpy as np


def timed(call):
    begin = time.process_time()
    found = call()
    return found, time.process_time() - begin


def measure(s, copies, direct):
    count = (copies, copies)
    row = {"copies": copies, "n": s.n * copies**2}
    large, row["tile_seconds"] = timed(lambda: s.tile(count))
    waves = [np.array(q) / copies for q in product(range(copies), repeat=2)]
    found, row["bloch_modes_seconds"] = timed(lambda: [s.bloch_modes(q).values for q in waves])
    flexes, row["bloch_rigidity_seconds"] = timed(lambda: s.bloch_rigidity(count))
    report, row["rigidity_seconds"] = timed(large.rigidity)
    row["flexes"], row["flexes_direct"] = int(flexes.flexes.sum()), report.flexes
    if copies <= direct:
        modes, row["modes_seconds"] = timed(lambda: large.modes(which="all", memory_limit=1e10).values)
        row["error"] = float(np.abs(np.sort(np.concatenate(found)) - modes).max() / modes[-1])
    return row


def draw(rows, path):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    fig, axes = plt.subplots(1, 3, figsize=(11, 3.4), constrained_layout=True)
    for axis, kind in zip(axes, ("modes", "rigidity")):
        for key, label, colour in ((f"{kind}_seconds", "direct", "#c05621"), (f"bloch_{kind}_seconds", "from one cell", "#2b6cb0")):
            known = [r for r in rows if key in r]
            axis.plot([r["copies"] for r in known], [r[key] for r in known], "o-", color=colour, label=label)
        axis.set(xscale="log", yscale="log", xlabel="copies along each axis", ylabel="seconds", title={"modes": "all modes", "rigidity": "flexes"}[kind])
    known = [r for r in rows if r.get("error", 0) > 0]
    axes[2].plot([r["copies"] for r in known], [r["error"] for r in known], "o-", color="#2f855a")
    axes[2].set(xscale="log", yscale="log", ylim=(1e-17, 1e-13), xlabel="copies along each axis", ylabel="difference over the largest eigenvalue", title="eigenvalues")
    ticks = [r["copies"] for r in rows]
    for axis in axes:
        axis.set_xticks(ticks, ticks)
        axis.minorticks_off()
        axis.grid(alpha=0.3)
    axes[0].legend()
    fig.savefig(path, dpi=110)


def main():
    p = argparse.ArgumentParser()
    p.add_argument("--n", type=int, default=24)
    p.add_argument("--copies", type=lambda t: [int(x) for x in t.split(",")], default=[1, 2, 3, 4, 6, 8])
    p.add_argument("--direct", type=int, default=6)
    p.add_argument("--out", type=Path, default=Path("bloch.json"))
    p.add_argument("--picture", type=Path)
    a = p.parse_args()
    s = jam.System.random(a.n, 2, 1, diameters=[1.0] * (a.n // 2) + [1.4] * (a.n - a.n // 2))
    s.crunch()
    rows = []
    for copies in a.copies:
        rows.append(measure(s, copies, a.direct))
        print(rows[-1], flush=True)
    a.out.write_text(json.dumps(rows, indent=1) + "\n")
    if a.picture:
        draw(rows, a.picture)


main()
