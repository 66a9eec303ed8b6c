#!/usr/bin/python3
"""lp_precision.py CHART.png RESULT.json...: errors of gain and forces of one LP against time, in floats and in doubles."""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

LEAST = 1e-16  # errors below are drawn here; the reference itself is left out

figure, axes = plt.subplots(1, 2, figsize=(11, 4.4))
for k, path in enumerate(sys.argv[2:]):
    with open(path) as source:
        result = json.load(source)
    for precision, style in (("single", "o-"), ("double", "s:")):
        points = [p for p in result["points"] if p["precision"] == precision and p["force_error"] > 0.0]
        seconds = [p["seconds"] for p in points]
        label = f"N = {result['n']}, " + ("floats first" if precision == "single" else "doubles alone")
        gain = [max(p["gain_error"] / result["gain"], LEAST) for p in points]
        axes[0].semilogy(seconds, gain, style, color=f"C{k}", ms=4, label=label)
        axes[1].semilogy(seconds, [max(p["force_error"], LEAST) for p in points], style, color=f"C{k}", ms=4, label=label)
axes[0].set_ylabel("error of the gain, over the gain")
axes[1].set_ylabel("largest error of a force, over the mean")
for axis in axes:
    axis.set_xlabel("processor seconds of the LP")
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8)
figure.tight_layout()
figure.savefig(sys.argv[1], dpi=100)
