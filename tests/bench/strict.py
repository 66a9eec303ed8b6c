#!/usr/bin/env python3
"""What a free cell costs and gains: factorisations, seconds, density and residuals beside the fixed cell, by size.

python3 tests/bench/strict.py [--seeds 3] [--sizes2 64,256,1024] [--sizes3 128,256,1024] [--out strict.json]
Starts: grown at G = 1e-2 to p = 500; disks of diameters 1 and 1.4, equal spheres. Processor time, one thread.
"""
import argparse
import json
import statistics
import time
from pathlib import Path

import jam


def crunched(system, strain):
    copy = system.copy()
    begin = time.process_time()
    try:
        report = copy.crunch(strain=strain)
    except jam.JamError as error:
        report = copy.report
        print("  ", error)
    return report, time.process_time() - begin


def measure(dim, n, seed):
    system = jam.System.random(n, dim, seed, diameters=[1.0, 1.4] * (n // 2) if dim == 2 else None)
    system.compress(growth_rate=1e-2, pressure=500)
    fixed, fixed_seconds = crunched(system, "none")
    free, seconds = crunched(system, "free")
    return {
        "dim": dim,
        "n": n,
        "seed": seed,
        "fixed": {"phi": fixed.packing_fraction, "factorisations": fixed.factorisations, "seconds": fixed_seconds},
        "free": {"phi": free.packing_fraction, "factorisations": free.factorisations, "seconds": seconds},
        "jammed": [int(fixed.jammed), int(free.jammed), int(free.strictly_jammed)],
        "excess": free.contacts - free.strict_contacts_needed,
        "overlap": free.max_overlap,
        "force_residual": free.force_residual,
    }


def draw(rows, path):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    fig, axes = plt.subplots(1, 3, figsize=(12, 3.8), constrained_layout=True)
    for dim, colour in ((2, "#2b6cb0"), (3, "#c05621")):
        sizes = sorted({r["n"] for r in rows if r["dim"] == dim})
        of = {n: [r for r in rows if r["dim"] == dim and r["n"] == n] for n in sizes}
        for kind, style in (("fixed", "o--"), ("free", "s-")):
            seconds = [statistics.median(r[kind]["seconds"] for r in of[n]) for n in sizes]
            axes[0].loglog(sizes, seconds, style, color=colour, mfc="white", label=f"d = {dim}, {kind} cell")
        gain = [statistics.median(r["free"]["phi"] - r["fixed"]["phi"] for r in of[n]) for n in sizes]
        axes[1].loglog(sizes, gain, "s-", color=colour, mfc="white", label=f"d = {dim}")
        x = [r["free"]["seconds"] for r in rows if r["dim"] == dim]
        for key, marker in (("overlap", "v"), ("force_residual", "^")):
            y = [max(r[key], 1e-17) for r in rows if r["dim"] == dim]
            axes[2].loglog(x, y, marker, color=colour, mfc="white", label=f"d = {dim}, {key.replace('_', ' ')}")
    axes[0].set(xlabel="N", ylabel="processor time (s)", title="cost")
    axes[1].set(xlabel="N", ylabel="packing fraction, free minus fixed", title="density gained")
    axes[2].set(
        xlabel="processor time (s)", ylabel="relative error", title="error against time, free cell", ylim=(1e-17, 1e-12)
    )
    for ax in axes:
        ax.legend(fontsize=8, frameon=False)
    fig.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--sizes2", default="64,256,1024")
    parser.add_argument("--sizes3", default="128,256,1024")
    parser.add_argument("--out", default="strict.json")
    parser.add_argument("--picture", default="")
    o = parser.parse_args()
    rows = []
    for dim, sizes in ((2, o.sizes2), (3, o.sizes3)):
        for n in map(int, filter(None, sizes.split(","))):
            for seed in range(1, o.seeds + 1):
                rows.append(measure(dim, n, seed))
                r = rows[-1]
                print(
                    f"d {dim} N {n:5d} seed {seed}: jammed {r['jammed']}, excess {r['excess']}, factorisations "
                    f"{r['fixed']['factorisations']} -> {r['free']['factorisations']}, seconds "
                    f"{r['fixed']['seconds']:.2f} -> {r['free']['seconds']:.2f}, gain "
                    f"{r['free']['phi'] - r['fixed']['phi']:.2e}, residual {r['force_residual']:.1e}",
                    flush=True,
                )
    Path(o.out).write_text(json.dumps(rows, indent=1) + "\n")
    if o.picture:
        draw(rows, o.picture)


if __name__ == "__main__":
    main()
