"""Digits of a jammed packing against time, from the doubles of a crunch to a thousand, and where each step fails.

usage: digits.py [--sizes 64,256,1024] [--edges 6]     writes results/digits.json and results/digits_edge.json
       digits.py --picture FILE                          draws both

Times are of the processor. An edge is a packing of disks whose diameters differ from 1 by a part `disorder`: the less they do,
the nearer it is to a crystal, and the nearer its contacts are to dependent ones.
"""
import argparse
import sys
import time
from pathlib import Path

import numpy as np

import jam
import jam.digits
from jam.errors import JamError

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "bindings/docs"))

import figures  # noqa: E402

DIGITS = (30, 60, 100, 200, 400, 1000)
TIMES = ["N", "digits", "by", "Newton's steps", "seconds of processor time"]
EDGE = ["disorder", "packings", "isostatic", "doubles jammed", "two doubles proved", "refined", "least force (median)", "largest delta"]


def timed(call):
    begun = time.process_time()
    result = call()
    return result, round(time.process_time() - begun, 4)


def isostatic(n):
    """Packing of an equal mixture, with the time of its crunch."""
    for seed in range(1, 40):
        disks = jam.System.random(n=n, dim=2, seed=seed, diameters=[1.0, 1.4] * (n // 2))
        disks.compress()
        report, seconds = timed(disks.crunch)
        if report.jammed and report.excess_contacts == 0:
            return disks, seconds
    raise SystemExit(f"no isostatic packing of {n}")


def times(sizes):
    rows = []
    for n in sizes:
        disks, seconds = isostatic(n)
        rows.append([n, 15, "crunch", 0, seconds])
        rows.append([n, 31, "prove", 2, timed(disks.prove)[1]])
        for digits in DIGITS:
            found, seconds = timed(lambda digits=digits: jam.digits.refine(disks, digits))
            rows.append([n, digits, "refine", found.steps, seconds])
        for row in rows[-len(DIGITS) - 2 :]:
            print(*row, flush=True)
    return rows


def edge(disorder, count, n=64):
    """How many packings each step carries."""
    least, deltas, tally = [], [], dict.fromkeys(("isostatic", "jammed", "proved", "refined"), 0)
    for seed in range(1, count + 1):
        rng = np.random.default_rng(seed)
        disks = jam.System.random(n=n, dim=2, seed=seed, diameters=1.0 + disorder * rng.uniform(-1, 1, n))
        disks.compress()
        try:
            report = disks.crunch()
        except JamError:
            continue
        tally["jammed"] += report.jammed
        if not report.jammed:
            continue
        isostatic = report.excess_contacts == 0
        tally["isostatic"] += isostatic
        least.append(float(report.min_force))
        tally["proved"] += disks.prove().theorem.name == "EXACT"
        if isostatic:
            try:
                jam.digits.refine(disks, 100)
                tally["refined"] += 1
            except JamError as why:
                print(disorder, seed, why, flush=True)
            deltas.append(delta(disks))
    return [disorder, count, tally["isostatic"], tally["jammed"], tally["proved"], tally["refined"],
            float(np.median(least)) if least else float("nan"), max(deltas, default=float("nan"))]  # fmt: skip


def delta(disks):
    """The bound of |1 - A J| that `refine` computes, which has to be below 1."""
    equations = jam.digits._Equations(disks, 200)
    try:
        return float(jam.digits._bounds(equations.derivative(), np.linalg.inv(equations.derivative()))[0])
    except np.linalg.LinAlgError:
        return float("inf")


def draw(picture):
    import matplotlib.pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.2))
    rows, edges = figures.load(HERE / "results/digits.json")["rows"], figures.load(HERE / "results/digits_edge.json")["rows"]
    for colour, n in zip(("C0", "C1", "C2"), sorted({row[0] for row in rows})):
        for by, marker in (("crunch", "s"), ("prove", "^"), ("refine", "o")):
            some = [row for row in rows if row[0] == n and row[2] == by]
            label = f"N = {n}" if by == "refine" else None
            left.loglog([r[4] for r in some], [r[1] for r in some], marker + "-", color=colour, label=label, mfc="none")
    left.set(xlabel="seconds of processor time", ylabel="digits", title="square: crunch, triangle: prove, circles: refine")
    left.legend()
    x = [row[0] for row in edges]
    for at, label, marker in ((3, "jammed (doubles)", "s"), (2, "isostatic", "x"), (4, "exact (two doubles)", "^"), (5, "refined", "o")):
        right.semilogx(x, [row[at] / row[1] for row in edges], marker + "-", label=label, mfc="none")
    right.set(xlabel="disorder of diameters", ylabel="part of the packings", title="Near a crystal, N = 64, d = 2")
    right.legend()
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--sizes", default="64,256,1024")
parser.add_argument("--edges", type=int, default=6)
parser.add_argument("--picture")
arguments = parser.parse_args()
if arguments.picture:
    draw(arguments.picture)
else:
    figures.save(HERE / "results/digits.json", "digits.py", TIMES, times(list(map(int, arguments.sizes.split(",")))))
    rows = [edge(10.0**-k, arguments.edges) for k in range(1, 11)]
    figures.save(HERE / "results/digits_edge.json", "digits.py", EDGE, rows)
