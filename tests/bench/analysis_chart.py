#!/usr/bin/env python3
"""Draws what the program `analysis` measured. usage: analysis > FILE.json; analysis_chart.py FILE.json PICTURE.png"""
import json
import sys

import matplotlib.pyplot as plt

with open(sys.argv[1], encoding="ascii") as file:
    data = json.load(file)
figure, (modes, density, forces) = plt.subplots(1, 3, figsize=(13, 4.2))


def draw(axis, points, error, marker, label, line=""):
    axis.loglog([q["seconds"] for q in points], [max(q[error], 1e-17) for q in points], marker + line, label=label)


def note(axis, point, error, text, offset=(6, 4)):
    axis.annotate(
        text, (point["seconds"], max(point[error], 1e-17)), textcoords="offset points", xytext=offset, fontsize=8
    )


spectrum = data["spectrum"]
dense = [q for q in spectrum if q["method"] == "dense"]
draw(modes, dense, "error", "s", "dense: all modes")
few = [q for q in spectrum if q["method"] == "lanczos"]
draw(modes, few, "error", "o", "Lanczos (Spectra)", "-")
for q in few:
    note(modes, q, "error", str(q["count"]), (-6, 8))
modes.set(
    xlabel="CPU time (s)",
    ylabel="largest relative error of the 20 lowest eigenvalues",
    title=f"N = {data['n']}, d = {data['dim']}; numbers: modes",
)
kernel = [q for q in spectrum if q["method"] == "kernel polynomial"]
for moments in sorted({q["moments"] for q in kernel}):
    points = [q for q in kernel if q["moments"] == moments]
    draw(density, points, "cumulative_error", "o", f"{moments} moments", "-")
    for q in points:
        note(density, q, "cumulative_error", str(q["vectors"]))
density.axvline(data["full_spectrum_with_vectors"]["cpu"], color="gray", linestyle=":", label="dense: exact")
density.set(
    xlabel="CPU time (s)",
    ylabel="largest error of the cumulative spectrum",
    title="kernel polynomial; numbers: random vectors",
)
for method, marker in (("multipliers, no polish", "s"), ("multipliers", "D"), ("null vector", "o")):
    points = [q for q in data["forces"] if q["method"] == method]
    draw(forces, points, "error", marker, {"multipliers": "multipliers, polished"}.get(method, method))
    for q in points:
        if "refinements" in q:
            note(forces, q, "error", f"{q['refinements']} refinements")
forces.set(
    xlabel="CPU time (s)",
    ylabel="largest error of a force over the mean",
    title="forces; multipliers: time of the crunch",
)
for axis in (modes, density, forces):
    axis.margins(0.3, 0.12)
    axis.legend(fontsize=8)
figure.tight_layout()
figure.savefig(sys.argv[2], dpi=100)
