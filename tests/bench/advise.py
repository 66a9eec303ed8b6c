"""What digits of a jammed packing cost: processor time and errors of crunch by tolerance, from a grown state.

usage: advise.py [N [SEEDS]]      The guide's table "Which digits cost what" is made of its rows.
"""
import statistics
import sys
import time

import numpy as np

import jam

ROWS = (
    ("gain_tolerance=1e-3, step_tolerance=1, polish=0", dict(gain_tolerance=1e-3, step_tolerance=1.0, polish=0)),
    ("gain_tolerance=1e-6, step_tolerance=1e-2, polish=0", dict(gain_tolerance=1e-6, step_tolerance=1e-2, polish=0)),
    ("gain_tolerance=1e-9, step_tolerance=1e-5, polish=0", dict(gain_tolerance=1e-9, step_tolerance=1e-5, polish=0)),
    ("polish=0", dict(polish=0)),
    ("the defaults", {}),
)


def main():
    n = int(sys.argv[1]) if len(sys.argv) > 1 else 1024
    seeds = int(sys.argv[2]) if len(sys.argv) > 2 else 3
    found = {name: [] for name, _ in ROWS}
    for seed in range(1, seeds + 1):
        start = jam.System.random(n, 3, seed)
        start.compress(stages=[(1e-2, 500), (3e-3, 1e5)])
        runs = {}
        for name, options in ROWS:
            s = start.copy()
            began = time.process_time()
            report = s.crunch(**options)
            runs[name] = time.process_time() - began, report
        exact = runs["the defaults"][1].packing_fraction
        for name, (seconds, r) in runs.items():
            found[name].append((seconds, abs(r.packing_fraction - exact), r.force_residual, r.max_overlap, r.jammed))
    print(f"N = {n}, {seeds} seeds, medians: options; seconds; error of phi_J; force residual; overlap; jammed")
    for name, rows in found.items():
        numbers = [statistics.median(float(x) for x in column) for column in zip(*[row[:4] for row in rows])]
        print(f"{name}; " + "; ".join(f"{x:.2g}" for x in numbers) + f"; {np.sum([row[4] for row in rows])}")


if __name__ == "__main__":
    main()
