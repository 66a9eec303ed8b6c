#!/usr/bin/python3
"""Density and time of both methods of crunch, the barrier path and sequential LPs, from the same starts.

usage: quench_chart.py [--n 256] [--seeds 8] [--out QUENCH.json] [--picture QUENCH.png] [--only-draw]

Starts: random at packing fraction 0.2 (d = 3), or grown at G = 1e-2 to a pressure. A start counts when both quenches end jammed. Times are
of the processor. PYTHONPATH: the built module.
"""
import argparse
import json
import time

import numpy as np

STARTS = ("random", 1e1, 1e2, 5e2, 1e4, 1e6)


def study(args):
    import jam

    rows = []
    for start in STARTS:
        for seed in range(1, args.seeds + 1):
            s = jam.System.random(args.n, 3, seed)
            if start != "random":
                s.compress([(1e-2, start)])
            for method in ("barrier_path", "sequential_lp"):
                copy, began = s.copy(), time.process_time()
                r = copy.crunch(method=method)
                rows.append(
                    dict(
                        start=str(start),
                        seed=seed,
                        method=method,
                        used=r.method.name.lower(),
                        jammed=int(r.jammed),
                        phi=r.packing_fraction,
                        excess=r.excess_contacts,
                        factorisations=r.factorisations,
                        lps=r.lp_solves,
                        seconds=time.process_time() - began,
                        force_residual=r.force_residual,
                    )
                )
    return dict(n=args.n, seeds=args.seeds, rows=rows)


def pairs(data, start, field):
    mine = {(r["seed"], r["method"]): r for r in data["rows"] if r["start"] == start and r["jammed"]}
    both = [
        seed
        for seed in range(1, data["seeds"] + 1)
        if (seed, "barrier_path") in mine and (seed, "sequential_lp") in mine
    ]
    return tuple(np.array([mine[seed, method][field] for seed in both]) for method in ("barrier_path", "sequential_lp"))


def draw(data, picture):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    starts = [str(s) for s in STARTS]
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.8))
    labels = [
        "random\n0.2" if s == "random" else f"p\n{float(s):g}" if float(s) < 1e3 else f"p\n1e{int(np.log10(float(s)))}"
        for s in starts
    ]
    for k, start in enumerate(starts):
        path, lps = pairs(data, start, "phi")
        axes[0].plot(np.full(len(path), k - 0.12), path, ".", color="C0", label="barrier path" if k == 0 else None)
        axes[0].plot(np.full(len(lps), k + 0.12), lps, ".", color="C1", label="sequential LPs" if k == 0 else None)
        difference = path - lps
        axes[1].errorbar(
            k, difference.mean(), difference.std(ddof=1) / np.sqrt(len(difference)), fmt="o", color="C2", capsize=3
        )
        for shift, (method, values) in zip((-0.12, 0.12), zip(("C0", "C1"), pairs(data, start, "seconds"))):
            axes[2].semilogy(np.full(len(values), k + shift), values, ".", color=method)
            axes[2].semilogy(k + shift, np.median(values), "_", ms=16, color=method)
    axes[1].axhline(0.0, color="k", lw=0.6)
    for axis, label in zip(
        axes, (r"$\varphi_J$", r"$\varphi_J$ of the path less $\varphi_J$ of sequential LPs", "processor seconds")
    ):
        axis.set(ylabel=label, xticks=range(len(starts)))
        axis.set_xticklabels(labels, fontsize=8)
        axis.grid(alpha=0.3)
    axes[0].legend(fontsize=8)
    axes[1].set_title(f"N = {data['n']}, d = 3, grown at G = 1e-2, {data['seeds']} seeds", fontsize=9)
    figure.tight_layout()
    figure.savefig(picture, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--n", type=int, default=256)
    parser.add_argument("--seeds", type=int, default=8)
    parser.add_argument("--out", default="quench_chart.json")
    parser.add_argument("--picture")
    parser.add_argument("--only-draw", action="store_true")
    args = parser.parse_args()
    data = json.load(open(args.out)) if args.only_draw else study(args)
    json.dump(data, open(args.out, "w"), indent=0)
    for start in map(str, STARTS):
        path, lps = pairs(data, start, "phi")
        d = path - lps
        seconds = pairs(data, start, "seconds")
        print(
            f"{start:>9}: phi path {path.mean():.5f} LPs {lps.mean():.5f} difference {d.mean():+.1e} +- {d.std(ddof=1) / np.sqrt(len(d)):.0e}, "
            f"seconds {np.median(seconds[0]):.2f} {np.median(seconds[1]):.2f}, both jammed {len(d)} of {args.seeds}"
        )
    if args.picture:
        draw(data, args.picture)


if __name__ == "__main__":
    main()
