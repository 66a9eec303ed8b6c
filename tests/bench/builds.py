#!/usr/bin/python3
"""Crunches of the same states by two builds of jam-pack in turns: factorisations, processor time, density, force residual.
JSON to stdout.

usage: builds.py OLD_JAM_PACK NEW_JAM_PACK RUNS STATE...
"""
import json
import os
import statistics
import subprocess
import sys

programs = {"old": sys.argv[1], "new": sys.argv[2]}
runs = int(sys.argv[3])


def crunch(program, state):
    before = os.times().children_user
    run = subprocess.run([program, "--input", state, "--quiet", "--report", "-"], capture_output=True, text=True)
    report = json.loads(run.stdout)
    return os.times().children_user - before, report


rows = []
for state in sys.argv[4:]:
    seconds = {"old": [], "new": []}
    row = {"state": os.path.basename(state)}
    for _ in range(runs):
        for name, program in programs.items():
            spent, report = crunch(program, state)
            seconds[name].append(spent)
            for key in ("factorisations", "packing_fraction", "force_residual", "jammed"):
                row[f"{name}_{key}"] = report[key]
    for name in programs:
        row[f"{name}_seconds"] = round(statistics.median(seconds[name]), 3)
    row["ratio"] = round(row["new_seconds"] / row["old_seconds"], 3)
    rows.append(row)
    print(json.dumps(row), file=sys.stderr, flush=True)
ratios = [row["ratio"] for row in rows]
totals = {name: sum(row[f"{name}_seconds"] for row in rows) for name in programs}
json.dump(
    {"states": rows, "median_ratio": statistics.median(ratios), "ratio_of_sums": totals["new"] / totals["old"]},
    sys.stdout,
    indent=1,
)
print()
