#!/usr/bin/python3
"""Crunches that end at a finite duality gap: what they cost, and what they know of the jamming point.

usage: finite_gap.py OUT.json [--sizes 1024,4096] [--seeds 3] [--states DIR] [--picture PICTURE.png]
       finite_gap.py OUT.json --draw PICTURE.png

States grown at G = 1e-2 to p = 500, then at 3e-4 to 1e5 (N up to 1024) or 1e7. Small states nearer to jamming need no path: LPs
end them at once, jammed. Each gap is a run of its own from the grown state; the run without a
gap gives the jamming point. Where the path leaves a saddle below the gap, the jamming point is denser than phi (1 + e)^(3/2)
by more than a tenth of what was missing, and the run is marked. PYTHONPATH: the built module. --states: folder where grown states are kept and found again.
"""
import argparse
import json
import time

import numpy as np

import jam
from grown import grown

GAPS = (1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12)


def timed(start, **options):
    s = start.copy()
    began = time.process_time()
    report = s.crunch(**options)
    return s, report, time.process_time() - began


def pairs_of(s):
    return {(int(i), int(j)): f for (i, j), f in zip(s.contacts.pairs, s.forces)}


def row_of(n, seed, gap, ended, exact):
    s, r, seconds = ended
    jammed, final, _ = exact
    named, true = pairs_of(s), pairs_of(jammed)
    both = sorted(named.keys() & true.keys())
    force = np.array([(named[k], true[k]) for k in both])
    told = r.packing_fraction * (1.0 + r.duality_gap) ** 1.5
    below = final.packing_fraction - r.packing_fraction
    return dict(
        n=n,
        seed=seed,
        gap=gap,
        reached=r.duality_gap,
        ended=r.stop_reason.name,
        seconds=seconds,
        factorisations=r.factorisations,
        below=below,
        told_error=abs(told - final.packing_fraction),
        same_point=bool(abs(told - final.packing_fraction) < 0.1 * below),
        wrong=len(named.keys() ^ true.keys()),
        undecided=r.undecided_contacts,
        contacts=r.contacts,
        excess=r.excess_contacts,
        force_residual=r.force_residual,
        force_error=float(np.abs(force[:, 0] - force[:, 1]).max()),
    )


def measured(n, seed, folder):
    start, _ = grown(n, seed, [(1e-2, 500.0), (3e-4, 1e5 if n <= 1024 else 1e7)], folder)
    exact = timed(start)
    rows = [row_of(n, seed, gap, timed(start, duality_gap=gap), exact) for gap in GAPS]
    r = exact[1]
    return rows, dict(n=n, seed=seed, seconds=exact[2], factorisations=r.factorisations, jammed=bool(r.jammed))


def draw(data, picture):
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 3, figsize=(13, 4.4))
    for k, n in enumerate(sorted({r["n"] for r in data["rows"]})):
        for seed in sorted({r["seed"] for r in data["rows"]}):
            rows = [r for r in data["rows"] if r["n"] == n and r["seed"] == seed and r["ended"] == "DUALITY_GAP"]
            good = [r for r in rows if r["same_point"]]
            style = dict(color=f"C{k}", marker="o", ms=4)

            def named(what):
                return f"N = {n}: {what}" if seed == 1 else None

            x = [r["seconds"] for r in good]
            axes[0].loglog(x, [r["below"] for r in good], ls="-", label=named("phi"), **style)
            floor = [max(r["told_error"], 1e-16) for r in good]
            axes[0].loglog(x, floor, ls=":", label=named("phi with duality gap"), **style)
            left = [r for r in rows if not r["same_point"]]
            x = [r["seconds"] for r in left]
            axes[0].loglog(x, [r["below"] for r in left], "x", color=f"C{k}", label=named("phi, a saddle left later"))
            x = [r["reached"] for r in good]
            axes[1].loglog(x, [r["undecided"] for r in good], ls="-", label=named("undecided"), **style)
            wrong = [max(r["wrong"], 0.5) for r in good]
            axes[1].loglog(x, wrong, ls=":", label=named("wrong (none at 0.5)"), **style)
            axes[2].loglog(x, [r["force_error"] for r in good], ls="-", label=named("forces"), **style)
    axes[0].set(xlabel="processor time (s)", ylabel="distance from phi_J")
    axes[1].set(xlabel="duality gap", ylabel="pairs")
    axes[2].set(xlabel="duality gap", ylabel="largest error of a force, over the mean")
    for axis in axes:
        axis.grid(alpha=0.3)
        axis.legend(fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.16), ncol=2)
    figure.tight_layout()
    figure.savefig(picture, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out")
    parser.add_argument("--sizes", default="1024,4096")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--states", default="")
    parser.add_argument("--picture")
    parser.add_argument("--draw")
    args = parser.parse_args()
    if args.draw:
        return draw(json.load(open(args.out)), args.draw)
    data = dict(rows=[], exact=[])
    for n in (int(x) for x in args.sizes.split(",")):
        for seed in range(1, args.seeds + 1):
            rows, exact = measured(n, seed, args.states)
            data["rows"] += rows
            data["exact"].append(exact)
            print(json.dumps(exact), flush=True)
            for r in rows:
                print(json.dumps(r), flush=True)
    json.dump(data, open(args.out, "w"), indent=0)
    if args.picture:
        draw(data, args.picture)


if __name__ == "__main__":
    main()
