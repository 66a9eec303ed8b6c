#!/usr/bin/python3
"""ordering.py RESULT.json CHART.png: flops of libjam's nested dissection over those of METIS, and the time of the order."""
import json
import statistics
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

with open(sys.argv[1]) as source:
    runs = json.load(source)["runs"]
figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4))
for index, (dim, degree) in enumerate(sorted({(run["dim"], run["degree"]) for run in runs})):
    mine = [run for run in runs if run["dim"] == dim and run["degree"] == degree]
    sizes = sorted({run["n"] for run in mine})

    def median(value, n):
        return statistics.median(value(run) for run in mine if run["n"] == n)

    color, label = f"C{index}", f"d = {dim}, {degree} pairs a particle"
    if "metis" in mine[0]:
        left.semilogx(sizes, [median(lambda r: r["flops_ratio"], n) for n in sizes], "o-", color=color, label=label)
        right.loglog(sizes, [median(lambda r: r["metis"]["seconds"], n) for n in sizes], ":", color=color)
    right.loglog(sizes, [median(lambda r: r["own"]["seconds"], n) for n in sizes], "o-", color=color, label=label)
    timed = [run for run in mine if "factorise_s" in run]
    right.loglog([run["n"] for run in timed], [0.05 * run["factorise_s"] for run in timed], "x", color=color)
left.axhline(1.0, color="grey", lw=0.8)
left.axhspan(0.95, 1.05, color="grey", alpha=0.15)
left.set_xlabel("N")
left.set_ylabel("flops over those with METIS")
left.legend(fontsize=7)
right.set_xlabel("N")
right.set_ylabel("seconds for the order")
right.set_title("dots: METIS; crosses: 5 % of a factorisation", fontsize=9)
figure.tight_layout()
figure.savefig(sys.argv[2], dpi=120)
