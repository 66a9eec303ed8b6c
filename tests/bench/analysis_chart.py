#!/usr/bin/env python3
"""Draws what the program `analysis` measured. usage: analysis > FILE.json; analysis_chart.py FILE.json PICTURE.png"""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

with open(sys.argv[1], encoding="ascii") as file:
    data = json.load(file)
figure, axes = plt.subplots(1, 3, figsize=(14, 4.4))
title = f"N = {data['n']}, d = {data['dim']}, {data['contacts']} contacts"
for method, marker in (("dense", "s"), ("lanczos", "o")):
    points = [q for q in data["spectrum"] if q["method"] == method]
    axes[0].loglog([q["seconds"] for q in points], [max(q["error"], 1e-17) for q in points], marker, label=method)
    for q in points:
        text = f"{q['count']} modes" if "count" in q else "all modes"
        axes[0].annotate(text, (q["seconds"], max(q["error"], 1e-17)), textcoords="offset points", xytext=(4, 4))
axes[0].set(xlabel="CPU time (s)", ylabel="largest relative error of the 20 lowest eigenvalues", title=title)
axes[0].legend()
points = [q for q in data["spectrum"] if q["method"] == "kernel polynomial"]
axes[1].loglog([q["seconds"] for q in points], [q["cumulative_error"] for q in points], "^-", label="kernel polynomial")
for q in points:
    axes[1].annotate(f"{q['vectors']} vectors", (q["seconds"], q["cumulative_error"]), textcoords="offset points", xytext=(4, 4))
axes[1].axvline(data["full_spectrum_with_vectors"]["cpu"], color="gray", linestyle=":", label="dense, exact")
axes[1].set(xlabel="CPU time (s)", ylabel="largest error of the cumulative spectrum", title="density of states")
axes[1].legend()
for method, marker in (("multipliers", "s"), ("null vector", "o")):
    points = [q for q in data["forces"] if q["method"] == method]
    axes[2].loglog([q["seconds"] for q in points], [max(q["error"], 1e-17) for q in points], marker, label=method)
    for q in points:
        if "refinements" in q:
            axes[2].annotate(f"{q['refinements']} refinements", (q["seconds"], max(q["error"], 1e-17)), textcoords="offset points", xytext=(4, 4))
axes[2].set(xlabel="CPU time (s)", ylabel="largest error of a force over the mean", title="forces (multipliers: time of the crunch)")
axes[2].legend()
for axis in axes:
    axis.margins(0.25, 0.1)
figure.tight_layout()
figure.savefig(sys.argv[2], dpi=110)
