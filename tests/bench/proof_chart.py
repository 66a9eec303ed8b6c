#!/usr/bin/python3
"""Time and radius of proofs against N, by Newton steps, in fixed cells and in free ones: draws what the program `proof`
printed.

usage: proof 64,256,1024 3 > A; proof 64,256,1024 3 strict > B; proof_chart.py --results proof.json --picture proof.png A B
       proof_chart.py --results proof.json --picture proof.png          draws again

The JSON holds machine and commit beside the runs. Times are of the processor.
"""
import argparse
import json
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / "bindings/docs"))
import figures  # noqa: E402

STEPS = (("doubles", "C3"), ("one Newton step", "C1"), ("two steps", "C0"), ("three steps", "C2"))


def draw_cells(axes, runs, cells):
    left, middle, right = axes
    for dim, marker in ((2, "s"), (3, "o")):
        for steps, (name, colour) in enumerate(STEPS):
            rows = [r for r in runs if r["dim"] == dim and r["steps"] == steps]
            look = dict(color=colour, label=name if dim == 3 else None, mfc="none")
            proved = [r for r in rows if r["exact"]]
            left.loglog([r["n"] for r in proved], [r["radius"] for r in proved], marker, **look)
            error = [r["force_error"] / r["least_force"] if r["force_error"] else np.nan for r in rows]
            middle.loglog([r["n"] for r in rows], error, marker, **look)
        two = [r for r in runs if r["dim"] == dim and r["steps"] == 2]
        sizes = sorted({r["n"] for r in two})
        share = [np.median([r["seconds"] / r["crunch"] for r in two if r["n"] == n]) for n in sizes]
        right.semilogx(sizes, share, marker + "-", color="k", label=f"time over the crunch's, d = {dim}", mfc="none")
        rest = [np.median([r["rounding"] / r["eigenvalue"] for r in two if r["n"] == n]) for n in sizes]
        right.semilogx(sizes, rest, marker + ":", color="C4", label=f"rounding over eigenvalue, d = {dim}", mfc="none")
    left.set(xlabel="N", ylabel="radius (box)", title=f"Existence: radius, {cells}")
    middle.set(xlabel="N", ylabel="error over least force", title="A proof needs this below 1")
    middle.axhline(1.0, color="grey", lw=1)
    right.set(xlabel="N", title="Cost, and room for rounding", yscale="log")
    right.axhline(0.6, color="grey", lw=1)
    middle.legend(fontsize=7), right.legend(fontsize=7)
    left.legend(fontsize=7, title="squares d = 2, circles d = 3", title_fontsize=7, loc="center right")


def draw(runs, picture):
    figure, axes = plt.subplots(2, 3, figsize=(13, 8))
    draw_cells(axes[0], [r for r in runs if not r["strict"]], "fixed cell")
    draw_cells(axes[1], [r for r in runs if r["strict"]], "free cell (strictly jammed)")
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--results", required=True)
parser.add_argument("--picture", required=True)
parser.add_argument("raw", nargs="*")
options = parser.parse_args()
if options.raw:
    runs = [run for path in options.raw for run in json.loads(Path(path).read_text(encoding="ascii"))]
    found = {"command": "proof SIZES SEEDS [strict]", **figures.made_by(), "runs": runs}
    with open(options.results, "w", encoding="ascii") as file:
        file.write(json.dumps({**found, "runs": None})[:-6] + "\n [" + ",\n  ".join(map(json.dumps, runs)) + "]}\n")
with open(options.results, encoding="ascii") as file:
    draw(json.load(file)["runs"], options.picture)
