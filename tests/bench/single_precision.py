#!/usr/bin/python3
"""single_precision.py RESULT.json CHART.png: error of a direction against time, from factors in floats and in doubles."""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

LEAST = 1e-15  # errors below are drawn here: the reference has no more digits

with open(sys.argv[1]) as source:
    result = json.load(source)
figure, axis = plt.subplots(figsize=(7, 4.5))
for k, case in enumerate(result["cases"]):
    for precision, style in (("single", "o-"), ("double", "s:")):
        points = [p for p in case["points"] if p["precision"] == precision and p["found"]]
        seconds, errors = [p["seconds"] for p in points], [max(p["error"], LEAST) for p in points]
        label = f"weights over {case['decades']:g} decades" if precision == "single" else None
        axis.semilogy(seconds, errors, style, color=f"C{k}", ms=4, label=label)
axis.set_xlabel(f"processor seconds of a factorisation and a solve, N = {result['n']}")
axis.set_ylabel("error in the norm of the matrix")
axis.legend(fontsize=8, title="circles: floats, squares: doubles", title_fontsize=8)
figure.tight_layout()
figure.savefig(sys.argv[2], dpi=100)
