#!/usr/bin/env python3
"""phi_J against growth rate: fit of the glass branch beside crunch at p = 1e3 and 1e5, as table and picture.

usage: growth_rate_table.py run RESULTS.jsonl [N [SEEDS [RATES]]]   appends a line a run; runs that are there are left out
       growth_rate_table.py draw RESULTS.jsonl PICTURE.png          the table on standard output
Needs the Python package `jam`, numpy, matplotlib.

Protocol: random start at 0.2, G = 1.732e-2 to p = 500, then RATE to p = 1e3, crunch of a copy; on to 1e5, crunch of a copy;
on to 1e7 in steps of 1.5 whose (p, phi) give phi_J of molecular dynamics by a fit of 1/p against phi. RATES (commas) are of
libjam's G = (d sigma/dt) / sqrt(kT/m). The published table (R. Diaz Hernandez Rojas, PhD thesis, Sapienza 2021: N = 1024,
d = 3, 20 samples) names a rate kappa of the Skoge-Donev code, radius over time at a mean v^2 of 1: G = 2 sqrt(3) kappa. That
reading of kappa is a conclusion from that code, not from the thesis.
"""
import json
import math
import os
import sys

import matplotlib.pyplot as plt
import numpy as np

import jam

PUBLISHED = {  # kappa: (phi_J of the fit, from 1e3, from 1e5, standard error)
    3e-4: (0.64223, 0.64212, 0.64223, 0.00019),
    1e-4: (0.64255, 0.64252, 0.64255, 0.00021),
    3e-5: (0.64291, 0.64288, 0.64291, 0.00024),
    1e-5: (0.64301, 0.64299, 0.64301, 0.00023),
}
TO_KAPPA = 1.0 / (2.0 * math.sqrt(3.0))
ORDERED = 1.0  # crystal_score above this: not a glass, and left out


def crunched(packing):
    with packing.copy() as copy:
        report = copy.crunch()
        return {"phi": report.packing_fraction, "lps": report.lp_solves}


def one(n, seed, rate):
    row = {"n": n, "seed": seed, "rate": rate}
    with jam.System.random(n, seed=seed) as packing:
        packing.compress([(1.732e-2, 500.0)])
        packing.compress([(rate, 1e3)])
        row["from 1e3"] = crunched(packing)
        packing.compress([(rate, 1e5)])
        row["from 1e5"] = crunched(packing)
        p, phi, target = [], [], 1e5
        while target < 1e7:
            target *= 1.5
            md = packing.compress([(rate, target)])
            p.append(md.pressure), phi.append(md.packing_fraction)
        row["fit"] = {"phi": jam.glass_fit(phi, p).jammed_fraction}
        row["score"] = packing.crystal_score()
    return row


def run(path, n=1024, seeds=10, rates=None):
    rates = rates or [kappa / TO_KAPPA for kappa in (3e-4, 1e-4, 3e-5)]
    there = set()
    if os.path.exists(path):
        there = {(r["n"], r["seed"], round(r["rate"], 12)) for r in map(json.loads, open(path))}
    for rate in rates:  # the fast ones first: a study that is cut short still has whole columns
        for seed in range(1, seeds + 1):
            if (n, seed, round(rate, 12)) not in there:
                row = one(n, seed, rate)
                with open(path, "a") as out:
                    out.write(json.dumps(row) + "\n")


def mean(values):
    return np.mean(values), np.std(values, ddof=1) / math.sqrt(len(values))


def draw(path, picture):
    every = [json.loads(line) for line in open(path)]
    rows = [r for r in every if r["score"] < ORDERED]
    print(f"{len(every)} runs, {len(every) - len(rows)} ordered ones left out; mean(standard error)")
    print("| G | kappa | seeds | MD fit | crunch from 1e3 | from 1e5 | LPs | published fit, 1e3, 1e5 |\n|---|---|---|---|---|---|---|---|")
    points = {"fit": [], "from 1e3": [], "from 1e5": []}
    for rate in sorted({r["rate"] for r in rows}, reverse=True):
        line, kappa = [r for r in rows if r["rate"] == rate], rate * TO_KAPPA
        found = {k: mean([r[k]["phi"] for r in line]) for k in points}
        for k in points:
            points[k].append((kappa, *found[k]))
        known = next((v for k, v in PUBLISHED.items() if abs(k / kappa - 1) < 0.01), None)
        told = "{:.5f}, {:.5f}, {:.5f} ({:.5f})".format(*known) if known else ""
        value = lambda x: f"{x[0]:.5f}({x[1]:.5f})"
        print(
            f"| {rate:.3g} | {kappa:.3g} | {len(line)} | {value(found['fit'])} | {value(found['from 1e3'])} | {value(found['from 1e5'])} | "
            f"{np.mean([r['from 1e5']['lps'] for r in line]):.1f} | {told} |"
        )
    plt.figure(figsize=(6.4, 4.4))
    for shift, (name, marker) in enumerate((("fit", "o"), ("from 1e3", "s"), ("from 1e5", "^"))):
        x, y, e = np.array(points[name]).T
        label = "fit of the glass branch" if name == "fit" else "crunch " + name.replace("1e", "p = 1e")
        plt.errorbar(x * 1.04**shift, y, yerr=e, fmt=marker, capsize=3, label=label)
    x = np.array(sorted(PUBLISHED))
    plt.errorbar(
        x / 1.06,
        [PUBLISHED[k][0] for k in x],
        yerr=[PUBLISHED[k][3] for k in x],
        fmt="x",
        color="grey",
        capsize=3,
        label="published fit",
    )
    plt.xscale("log")
    plt.xlabel(r"growth rate $\kappa = G / 3.46$ (published unit)")
    plt.ylabel(r"jamming density $\varphi_J$")
    plt.legend(fontsize=8)
    plt.tight_layout()
    plt.savefig(picture, dpi=110)


if __name__ == "__main__":
    if len(sys.argv) < 3 or sys.argv[1] not in ("run", "draw"):
        sys.exit(__doc__)
    if sys.argv[1] == "draw":
        draw(sys.argv[2], sys.argv[3])
    else:
        run(sys.argv[2], *map(int, sys.argv[3:5]), *[[float(g) for g in a.split(",")] for a in sys.argv[5:6]])
