#!/usr/bin/python3
"""The same work by two builds of jam-pack in turns: processor time, collisions, factorisations, density, force residual, and
whether the packings have the same bits. JSON to stdout.

usage: builds.py OLD_JAM_PACK NEW_JAM_PACK RUNS WORK...
WORK: the options of one run, as '--input STATE' for a crunch, '--n 16384 --growth 1e-2:500 --no-crunch' for growth, or
'--input FLUID --nve 200 --no-crunch' for dynamics at constant volume.
"""
import json
import os
import shlex
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

KEPT = ("collisions", "factorisations", "packing_fraction", "force_residual", "jammed")
programs = {"old": sys.argv[1], "new": sys.argv[2]}
runs = int(sys.argv[3])


def work(program, options, output):
    before = os.times().children_user
    command = [program, *shlex.split(options), "--quiet", "--report", "-", "--output", output]
    report = json.loads(subprocess.run(command, capture_output=True, text=True).stdout)
    return os.times().children_user - before, report


rows = []
with tempfile.TemporaryDirectory() as folder:
    for options in sys.argv[4:]:
        seconds, row = {name: [] for name in programs}, {"work": options}
        made = {name: Path(folder, name + ".dat") for name in programs}
        for _ in range(runs):
            for name, program in programs.items():
                spent, report = work(program, options, made[name])
                seconds[name].append(spent)
                row.update({f"{name}_{key}": report[key] for key in KEPT if report[key] is not None})
        for name in programs:
            row[f"{name}_seconds"] = round(statistics.median(seconds[name]), 3)
        row["ratio"] = round(row["new_seconds"] / row["old_seconds"], 3)
        row["same_bits"] = made["old"].read_bytes() == made["new"].read_bytes()
        rows.append(row)
        print(json.dumps(row), file=sys.stderr, flush=True)
totals = {name: sum(row[f"{name}_seconds"] for row in rows) for name in programs}
json.dump(
    {"work": rows, "median_ratio": statistics.median(row["ratio"] for row in rows), "ratio_of_sums": totals["new"] / totals["old"]},
    sys.stdout,
    indent=1,
)
print()
