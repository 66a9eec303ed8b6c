#!/usr/bin/python3
"""From a random start to the certificate with jam-pack: several seeds in d = 3, 2 and 4. JSON to stdout, one line a packing
to stderr.

usage: from_nothing.py JAM_PACK [SEEDS]
"""
import json
import resource
import subprocess
import sys
import time

program = sys.argv[1]
seeds = int(sys.argv[2]) if len(sys.argv) > 2 else 5
cases = [
    ("d3", ["--n", "1024"]),
    ("d2", ["--n", "1024", "--dim", "2", "--phi0", "0.4", "--diameters-ratio", "1.4"]),
    ("d4", ["--n", "512", "--dim", "4"]),
]
rows = []
for name, options in cases:
    for seed in range(1, seeds + 1):
        start = time.time()
        run = subprocess.run(
            [program, *options, "--seed", str(seed), "--quiet", "--report", "-"], capture_output=True, text=True
        )
        report = json.loads(run.stdout)
        row = {"case": name, "seed": seed, "seconds": round(time.time() - start, 2), "exit": run.returncode}
        for key in (
            "packing_fraction",
            "jammed",
            "excess_contacts",
            "rattlers",
            "lp_solves",
            "factorisations",
            "force_residual",
            "max_overlap",
            "min_force",
            "collisions",
            "collisions_per_second",
            "seconds_md",
            "seconds_crunch",
        ):
            row[key] = report[key]
        rows.append(row)
        print(json.dumps(row), file=sys.stderr, flush=True)
print(
    json.dumps(
        {"rows": rows, "peak_megabytes": resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024}, indent=1
    )
)
