#!/usr/bin/env python3
"""What large size ratios cost: growth, Monte Carlo, crunch and factorisations against the ratio of two sizes, beside equal spheres.

python3 tests/bench/ratios.py [--n 2000] [--large 2] [--dims 2,3] [--seconds 600] [--out ratios.json] [--picture ratios.png]
n spheres, a few of which are `ratio` times as wide as the others, grown to p = 500 and crunched. Large and small ones fill
the same volume where n allows it, else `large` spheres are large. Monte Carlo moves the grown packing, half of its trials accepted. The small ones have diameters 1 and 1.4, so that disks
do not crystallise. Processor time, one thread.
"""
import argparse
import json
import time
from pathlib import Path

import jam
import numpy as np

RATIOS = (1, 2, 4, 10, 20, 50, 100)


def diameters(n, ratio, d, large):
    count = max(large, round(n / (ratio**d + 1))) if ratio > 1 else 0
    small = np.where(np.arange(n - count) % 2, 1.4, 1.0)
    return np.r_[np.full(count, 1.2 * ratio), small], count


def measure(n, ratio, d, large, seconds):
    sizes, count = diameters(n, ratio, d, large)
    begin = time.process_time()
    s = jam.System.random(n, d, 1, diameters=sizes)
    row = {"d": d, "ratio": ratio, "n": n, "large": count, "volume_of_large": float((sizes[:count] ** d).sum() / (sizes**d).sum())}
    grown = s.compress(growth_rate=1e-2, pressure=500, wall_time=seconds)
    row["growth_seconds"] = time.process_time() - begin
    row["collisions"] = grown.collisions
    row["rate"] = grown.collisions / row["growth_seconds"]
    row["pressure"] = grown.pressure
    moved = s.copy()
    step = moved.monte_carlo(sweeps=1, acceptance=0.5).step
    sweeps, begin = max(1, 400000 // n), time.process_time()
    moved.monte_carlo(sweeps=sweeps, step=step)
    row["trial_rate"] = sweeps * n / (time.process_time() - begin)
    begin = time.process_time()
    r = s.crunch(wall_time=seconds)
    row["crunch_seconds"] = time.process_time() - begin
    row.update(factorisations=r.factorisations, status=str(r.status), jammed=bool(r.jammed), contacts=r.contacts)
    row["packing_fraction"], row["force_residual"] = r.packing_fraction, r.force_residual
    return row


def draw(rows, path):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    fig, axes = plt.subplots(1, 4, figsize=(13, 3.4), constrained_layout=True)
    panels = (("growth_seconds", "seconds to p = 500"), ("trial_rate", "Monte Carlo trials a second"), ("crunch_seconds", "seconds of the crunch"), ("factorisations", "factorisations"))
    for axis, (key, label) in zip(axes, panels):
        for d, colour in ((2, "#2b6cb0"), (3, "#c05621")):
            mine = [r for r in rows if r["d"] == d]
            axis.plot([r["ratio"] for r in mine], [r[key] for r in mine], "o-", color=colour, label=f"d = {d}")
            alone = [r for r in mine if r["contacts"] < r["n"] // 10]
            axis.plot([r["ratio"] for r in alone], [r[key] for r in alone], "o", mfc="white", color=colour)
        axis.set(xscale="log", yscale="log", xlabel="ratio of the diameters", ylabel=label)
        axis.grid(alpha=0.3)
    axes[2].plot([], [], "o", mfc="white", color="grey", label="the large jam alone")
    axes[2].legend(loc="lower left", fontsize=8)
    fig.savefig(path, dpi=110)


def main():
    p = argparse.ArgumentParser()
    p.add_argument("--n", type=int, default=2000)
    p.add_argument("--large", type=int, default=2)
    p.add_argument("--dims", type=lambda t: [int(x) for x in t.split(",")], default=[2, 3])
    p.add_argument("--seconds", type=float, default=600)
    p.add_argument("--ratios", type=lambda t: [float(x) for x in t.split(",")], default=RATIOS)
    p.add_argument("--out", type=Path, default=Path("ratios.json"))
    p.add_argument("--picture", type=Path)
    p.add_argument("--draw", type=Path, help="only draw these results")
    a = p.parse_args()
    if a.draw:
        return draw(json.loads(a.draw.read_text()), a.picture)
    rows = []
    for d in a.dims:
        for ratio in a.ratios:
            rows.append(measure(a.n, ratio, d, a.large, a.seconds))
            print(rows[-1], flush=True)
            a.out.write_text(json.dumps(rows, indent=1) + "\n")
    if a.picture:
        draw(rows, a.picture)


main()
