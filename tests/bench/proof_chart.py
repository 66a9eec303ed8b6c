#!/usr/bin/python3
"""Time and radius of proofs against N, by Newton steps: draws what the program `proof` printed.

usage: build/tests/bench/proof 64,256,1024 3 | proof_chart.py --results proof.json --picture proof.png
       proof_chart.py --results proof.json --picture proof.png --only-draw

The JSON holds machine and commit beside the runs. Times are of the processor.
"""
import argparse
import json
import sys
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

sys.path.append(str(Path(__file__).resolve().parents[2] / "bindings/docs"))
import figures  # noqa: E402


def draw(runs, picture):
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(13, 4))
    names = {0: "doubles", 1: "one Newton step", 2: "two steps", 3: "three steps"}
    for dim, marker in ((2, "s"), (3, "o")):
        for steps, colour in zip(range(4), ("C3", "C1", "C0", "C2")):
            rows = [r for r in runs if r["dim"] == dim and r["steps"] == steps]
            label = names[steps] if dim == 3 else None
            proved = [r for r in rows if r["exact"]]
            left.loglog([r["n"] for r in proved], [r["radius"] for r in proved], marker, color=colour, label=label, mfc="none")
            middle.loglog(
                [r["n"] for r in rows], [r["force_error"] / r["least_force"] if r["force_error"] else np.nan for r in rows],
                marker, color=colour, label=label, mfc="none",
            )  # fmt: skip
        two = [r for r in runs if r["dim"] == dim and r["steps"] == 2]
        sizes = sorted({r["n"] for r in two})
        share = [np.median([r["seconds"] / r["crunch"] for r in two if r["n"] == n]) for n in sizes]
        right.semilogx(sizes, share, marker + "-", color="k", label=f"time over the crunch's, d = {dim}", mfc="none")
        rest = [np.median([r["rounding"] / r["eigenvalue"] for r in two if r["n"] == n]) for n in sizes]
        right.semilogx(sizes, rest, marker + ":", color="C4", label=f"rounding over eigenvalue, d = {dim}", mfc="none")
    left.set(xlabel="N", ylabel="radius (box)", title="Existence: radius")
    middle.set(xlabel="N", ylabel="error over least force", title="A proof needs this below 1")
    middle.axhline(1.0, color="grey", lw=1)
    right.set(xlabel="N", title="Cost, and room for rounding", yscale="log")
    right.axhline(0.6, color="grey", lw=1)
    for axis in (left, middle, right):
        axis.legend(fontsize=7)
    left.text(0.03, 0.5, "squares d = 2, circles d = 3", transform=left.transAxes, fontsize=7)
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--results", required=True)
parser.add_argument("--picture", required=True)
parser.add_argument("--only-draw", action="store_true")
options = parser.parse_args()
if not options.only_draw:
    found = {"command": "proof SIZES SEEDS", **figures.made_by(), "runs": json.load(sys.stdin)}
    with open(options.results, "w", encoding="ascii") as file:
        file.write(json.dumps({**found, "runs": None})[:-6] + "\n [" + ",\n  ".join(map(json.dumps, found["runs"])) + "]}\n")
with open(options.results, encoding="ascii") as file:
    draw(json.load(file)["runs"], options.picture)
