#!/usr/bin/python3
"""Convergence of both methods of crunch: distance of the density from its final value against time, within one run.

usage: crunch_convergence.py [--seed 1] [--states DIR] [--out CONVERGENCE.json] [--picture CONVERGENCE.png]

Two states: 1024 spheres grown at G = 1e-2 to p = 500 only; 4096 grown from there at G = 3e-4 to p = 1e7 (two minutes, the
crunches another). Each step of `history` is a point; the end of each curve is what LPs in full and polish add. PYTHONPATH: the
built module. --states: folder where grown states are kept and found again.
"""
import argparse
import json

import numpy as np

from grown import grown

STATES = {
    "N = 1024, G = 1e-2 to p = 500": (1024, [(1e-2, 500.0)]),
    "N = 4096, then G = 3e-4 to p = 1e7": (4096, [(1e-2, 500.0), (3e-4, 1e7)]),
}


def run(start, name, method):
    s = start.copy()
    r = s.crunch(method=method)
    h = s.history
    return dict(
        state=name,
        method=method,
        seconds=np.cumsum(h["seconds"]).tolist(),
        factorisations=np.cumsum(h["factorisations"]).tolist(),
        error=np.maximum(r.packing_fraction - h["phi"], 0.0).tolist(),
        phi=r.packing_fraction,
        jammed=r.jammed,
        excess=r.excess_contacts,
        force_residual=r.force_residual,
        total_seconds=r.seconds,
        total_factorisations=r.factorisations,
    )


def draw(rows, picture):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(11, 4), sharey=True)
    for axis, name in zip(axes, STATES):
        for colour, method in (("C0", "barrier_path"), ("C1", "sequential_lp")):
            for r in rows:
                if r["state"] == name and r["method"] == method:
                    axis.loglog(
                        r["seconds"],
                        np.maximum(r["error"], 1e-16),
                        ".-",
                        color=colour,
                        label=f"{method}: {r['total_factorisations']} factorisations, force residual {r['force_residual']:.0e}",
                    )
        axis.set(xlabel="seconds since the start", title=name)
        axis.grid(alpha=0.3, which="both")
        axis.legend(fontsize=8)
    axes[0].set_ylabel(r"$\varphi_J - \varphi$ of this run (at least 1e-16 drawn)")
    figure.tight_layout()
    figure.savefig(picture, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--states", default="")
    parser.add_argument("--out", default="crunch_convergence.json")
    parser.add_argument("--picture")
    args = parser.parse_args()
    rows = []
    for name, (n, stages) in STATES.items():
        start, _ = grown(n, args.seed, stages, args.states)
        rows += [run(start, name, method) for method in ("barrier_path", "sequential_lp")]
    json.dump(rows, open(args.out, "w"), indent=0)
    for r in rows:
        print(
            f"{r['state']}, {r['method']}: phi {r['phi']:.12f}, {r['total_factorisations']} factorisations, {r['total_seconds']:.2f} s, excess {r['excess']}"
        )
    if args.picture:
        draw(rows, args.picture)


if __name__ == "__main__":
    main()
