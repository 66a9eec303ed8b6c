"""Quasi-static shear by steps of several sizes against the finest: 128 soft disks of ratio 1.4 at 0.90, to the strain 0.02.

usage: shear.py     writes results/shear.json, from which figures.py makes the table of the page on shear

An event of the finest steps counts as found where one lies within 1e-5 of its strain.
"""
import sys
import time
from pathlib import Path

import numpy as np

import jam

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "bindings/docs"))

import figures  # noqa: E402

SEEDS, END = range(1, 9), 0.02
runs = {}
for step in (5e-5, 1e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-2):
    found, seconds = [], 0.0
    for seed in SEEDS:
        disks = jam.System.random(n=128, dim=2, diameters=[1.0, 1.4] * 64, packing_fraction=0.9, overlap="allow", seed=seed)
        disks.relax()
        begun = time.process_time()
        report = disks.shear(END, step=step)
        seconds += time.process_time() - begun
        rows = disks.shear_rows
        found.append((rows["strain"][rows["event"] == 1], report.stress / report.pressure))
    runs[step] = found, seconds
finest = runs[min(runs)][0]
rows = []
for step, (found, seconds) in sorted(runs.items()):
    hits = sum(np.min(np.abs(events - at), initial=1.0) < 1e-5 for (events, _), (all_of_them, _) in zip(found, finest) for at in all_of_them)
    apart = sorted(abs(mine[1] - best[1]) for mine, best in zip(found, finest))
    rows.append([step, sum(len(events) for events, _ in found), int(hits), float(np.median(apart)), apart[-1], round(seconds / len(found), 3)])
columns = ["step", "events of 8 packings", "of them those of the finest steps", "stress over pressure at the end, off by (median)", "(most)", "seconds per packing"]
figures.save(HERE / "results/shear.json", "shear.py", columns, rows)
