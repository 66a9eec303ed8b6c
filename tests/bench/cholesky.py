#!/usr/bin/python3
"""cholesky.py RESULT.json CHART.png: seconds per factorisation against N, and its rate over that of the matrix product."""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

with open(sys.argv[1]) as source:
    result = json.load(source)
runs = [run for run in result["runs"] if run["graph"] == "relaxed"]
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4))
for key, label in (
    ("jam_1", "libjam"),
    ("jam_2", "libjam, 2 threads"),
    ("mumps", "MUMPS"),
):
    rows = [(run["n"], run[key]) for run in runs if key in run]
    if not rows:
        continue
    left.loglog([n for n, _ in rows], [r["factorise_s"] for _, r in rows], "o-", label=label)
    if key != "mumps":
        right.semilogx([n for n, _ in rows], [r["share_of_dgemm"] for _, r in rows], "o-", label=label)
left.set_xlabel("N")
left.set_ylabel("seconds per factorisation")
left.legend()
right.set_xlabel("N")
right.set_ylabel("flop rate over that of the matrix product")
right.set_ylim(bottom=0)
figure.tight_layout()
figure.savefig(sys.argv[2], dpi=120)
