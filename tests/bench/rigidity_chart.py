#!/usr/bin/python3
"""Cost of the rigidity test against the number of spheres, beside the force residual of its proof.

usage: rigidity_chart.py JSON [JSON ...] [--out PICTURE.png]     JSON: what tests/bench/rigidity printed
"""
import argparse
import json

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("json", nargs="+")
    parser.add_argument("--out", default="rigidity_cost.png")
    args = parser.parse_args()
    rows = [row for name in args.json for row in json.load(open(name))]
    groups = {}
    for row in rows:
        family = "FCC crystal" if row["name"] == "fcc" else f"d = {row['dim']}, {row['family']}"
        groups.setdefault((family, row["kind"]), []).append(row)
    figure, (cost, error) = plt.subplots(1, 2, figsize=(11, 4.2))
    for k, ((family, kind), found) in enumerate(sorted(groups.items())):
        found.sort(key=lambda row: row["n"])
        style = dict(
            color=f"C{k // 2}", ls="-" if kind == "collective" else "--", marker="o", ms=4, label=f"{family}, {kind}"
        )
        cost.loglog([row["n"] for row in found], [row["cpu"] for row in found], **style)
        proved = [row for row in found if row["contacts"] > 0 and row["residual"] > 0.0]
        error.loglog([row["cpu"] for row in proved], [row["residual"] for row in proved], **{**style, "ls": "none"})
    cost.axhline(3.0, color="0.6", lw=0.8)
    cost.axvline(1e4, color="0.6", lw=0.8)
    cost.set(xlabel="spheres N", ylabel="processor time (s)", title="cost of the test")
    error.axhline(1e-10, color="0.6", lw=0.8)
    error.set(xlabel="processor time (s)", ylabel="force residual over mean force", title="the proof (limit: 1e-10)")
    cost.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(args.out, dpi=110)


if __name__ == "__main__":
    main()
