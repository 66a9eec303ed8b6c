#!/usr/bin/python3
"""Time, factorisations and LPs of a crunch against the number of spheres, with fitted exponents beside the published ones.

usage: size_chart.py [--sizes 128,256,512,1024] [--seeds 3] [--growth 1e-3] [--pressure 1e5] [--out SIZE.json] [--picture SIZE.png]
                     [--threads 1] [--methods barrier_path,sequential_lp] [--only-draw]

States: random at phi 0.2, grown at G = 1e-2 to p = 500 and then at --growth to --pressure. Times are of the processor, with two
threads of the clock (let nothing else run then); lines go through medians over seeds. A run that is in the JSON already is not
made again, so large sizes can be added one by one. PYTHONPATH: the built module.
"""
import argparse
import json
import os
import time

import numpy as np

import jam

# Diaz Hernandez Rojas, thesis (2021): whole crunch and LPs
PUBLISHED = {"seconds": 2.75, "lps": 0.59, "factorisations": None}


def grown(n, seed, stages):
    """n spheres in d = 3 after stages of (growth rate, pressure)."""
    system = jam.System.random(n, 3, seed)
    system.compress(stages)
    return system


def run(start, n, seed, method, args):
    s = start.copy()
    clock = time.process_time if args.threads == 1 else time.perf_counter
    began = clock()
    r = s.crunch(method=method, threads=args.threads)
    seconds = clock() - began
    return dict(
        n=n,
        seed=seed,
        method=method,
        threads=args.threads,
        growth=args.growth,
        pressure=args.pressure,
        seconds=seconds,
        factorisations=r.factorisations,
        lps=r.lp_solves,
        jammed=r.jammed,
    )


def fit(sizes, values):
    """Exponent of a least-squares line through the logarithms, and its standard error."""
    x, y = np.log(sizes), np.log(values)
    if len(x) < 3:
        return (np.diff(y) / np.diff(x))[0] if len(x) == 2 else np.nan, np.nan
    coefficients, covariance = np.polyfit(x, y, 1, cov="unscaled")
    rest = y - np.polyval(coefficients, x)
    return coefficients[0], np.sqrt(covariance[0, 0] * (rest @ rest) / (len(x) - 2))


def draw(rows, picture):
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 3, figsize=(12, 4))
    exponents, kinds = {}, sorted({(r["method"], r["threads"]) for r in rows}, reverse=True)
    for axis, (field, label) in zip(
        axes, (("seconds", "seconds of the whole crunch"), ("factorisations", "factorisations"), ("lps", "LPs solved"))
    ):
        for m, (method, threads) in enumerate(kinds):
            mine = [r for r in rows if (r["method"], r["threads"]) == (method, threads) and r["jammed"]]
            name = method if threads == 1 else f"{method}, {threads} threads"
            sizes = sorted({r["n"] for r in mine})
            if not sizes:
                continue
            middle = [np.median([r[field] for r in mine if r["n"] == n]) for n in sizes]
            power, error = fit(sizes, middle)
            exponents[name, field] = power, error
            axis.loglog([r["n"] for r in mine], [r[field] for r in mine], ".", color=f"C{m}", alpha=0.4)
            axis.loglog(
                sizes,
                middle,
                "o-",
                color=f"C{m}",
                label=f"{name}: $N^{{{power:.2f} \\pm {error:.2f}}}$"
                if error == error
                else f"{name}: $N^{{{power:.2f}}}$",
            )
            if PUBLISHED[field] and (
                method == "sequential_lp" or len(kinds) == 1
            ):  # the published exponent is of sequential LPs
                axis.loglog(
                    sizes,
                    [middle[0] * (n / sizes[0]) ** PUBLISHED[field] for n in sizes],
                    "k--",
                    lw=1,
                    label=f"published slope $N^{{{PUBLISHED[field]}}}$",
                )
        axis.set(xlabel="N", ylabel=label)
        low, high = axis.get_ylim()
        axis.set_ylim(low, high * (high / low) ** 0.4)  # room for the legend above the points
        axis.legend(fontsize=8, framealpha=0.5, loc="upper left")
        axis.grid(alpha=0.3, which="both")
    growth, pressure = rows[0]["growth"], rows[0]["pressure"]
    axes[1].set_title(
        f"d = 3, grown at G = {growth:g} to p = {pressure:g}, up to {max(r['seed'] for r in rows)} seeds", fontsize=9
    )
    figure.tight_layout()
    figure.savefig(picture, dpi=100)
    return exponents


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", default="128,256,512,1024")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--growth", type=float, default=1e-3)
    parser.add_argument("--pressure", type=float, default=1e5)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--methods", default="barrier_path,sequential_lp")
    parser.add_argument("--out", default="size_chart.json")
    parser.add_argument("--picture")
    parser.add_argument("--only-draw", action="store_true")
    args = parser.parse_args()
    rows = json.load(open(args.out)) if os.path.exists(args.out) else []
    wanted = (
        [] if args.only_draw else [(int(n), seed) for n in args.sizes.split(",") for seed in range(1, args.seeds + 1)]
    )
    for n, seed in wanted:
        same = dict(n=n, seed=seed, threads=args.threads, growth=args.growth, pressure=args.pressure)
        made = {r["method"] for r in rows if all(r[k] == v for k, v in same.items())}
        methods = [m for m in args.methods.split(",") if m not in made]
        start = grown(n, seed, [(1e-2, 500.0), (args.growth, args.pressure)]) if methods else None
        for method in methods:
            rows.append(run(start, n, seed, method, args))
            print(json.dumps(rows[-1]), flush=True)
            json.dump(rows, open(args.out, "w"), indent=0)
    if args.picture and rows:
        for (name, field), (power, error) in draw(rows, args.picture).items():
            print(f"{name} {field}: N^{power:.2f} +- {error:.2f}")


if __name__ == "__main__":
    main()
