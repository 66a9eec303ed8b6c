#!/usr/bin/python3
"""Crunches of the same states by builds with other dense products, in turns: processor time against accuracy. JSON, and a picture.

Accuracy is the force residual over the mean force, and the difference of the density from the median of all builds, where
they end with the same number of contacts.

usage: products.py OUT.json PICTURE.png FOLDER RUNS N[,N...] NAME=JAM_PACK [NAME=JAM_PACK ...]
FOLDER keeps the states: three seeds of each N, grown at 1e-2 to p = 500 and at 3e-3 to p = 1e7 by the first program.
"""
import json
import os
import statistics
import subprocess
import sys
from pathlib import Path

SEEDS = (1, 2, 3)
STAGES = ["--growth", "1e-2:500", "--growth", "3e-3:1e7"]


def state(program, folder, n, seed):
    path = folder / f"n{n}-seed{seed}.dat"
    if not path.exists():
        subprocess.run([program, "--n", str(n), "--seed", str(seed), *STAGES, "--no-crunch", "--quiet", "--output", path], check=True)
    return path


def crunch(program, path):
    before = os.times().children_user
    run = subprocess.run([program, "crunch", "--input", path, "--quiet", "--report", "-", "--output", "/dev/null"],
                         capture_output=True, text=True)
    return os.times().children_user - before, json.loads(run.stdout)


def measure(programs, folder, runs, n, seed):
    path = state(next(iter(programs.values())), folder, n, seed)
    seconds, report = {name: [] for name in programs}, {}
    for _ in range(runs):
        for name, program in programs.items():
            spent, report[name] = crunch(program, path)
            seconds[name].append(spent)
    phi = statistics.median(r["packing_fraction"] for r in report.values())
    counts = {r["contacts"] for r in report.values()}
    return [
        {
            "n": n, "seed": seed, "build": name, "seconds": statistics.median(seconds[name]), "jammed": bool(r["jammed"]),
            "factorisations": r["factorisations"], "residual": r["force_residual"], "kernel": r["blas_kernel"],
            "phi_error": abs(r["packing_fraction"] - phi) if len(counts) == 1 else None,
        }
        for name, r in report.items()
    ]  # fmt: skip


def draw(rows, picture):
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    for k, build in enumerate(dict.fromkeys(row["build"] for row in rows)):
        mine = [row for row in rows if row["build"] == build]
        cost = [row["seconds"] / row["factorisations"] for row in mine]
        axes[0].loglog([row["n"] * 1.03 ** (k - 1) for row in mine], cost, "os^D"[k], mfc="none", color=f"C{k}", label=build)
        axes[1].loglog([max(row["residual"], 1e-16) for row in mine], cost, "os^D"[k], mfc="none", color=f"C{k}")
    axes[0].set(xlabel="N", ylabel="processor seconds a factorisation")
    axes[1].set(xlim=(1e-16, 1e-14), xlabel="force residual / mean force", ylabel="processor seconds a factorisation")
    axes[0].legend(frameon=False)
    for axis in axes:
        axis.grid(alpha=0.3)
    figure.savefig(picture, dpi=110)


def main():
    out, picture, folder, runs, sizes = sys.argv[1:6]
    programs = dict(word.split("=", 1) for word in sys.argv[6:])
    Path(folder).mkdir(exist_ok=True)
    rows = []
    for n in map(int, sizes.split(",")):
        for seed in SEEDS:
            rows += measure(programs, Path(folder), int(runs), n, seed)
            Path(out).write_text(json.dumps(rows, indent=1))
            print(*(f"{row['build']} {row['seconds']:.3g} s, {row['factorisations']}" for row in rows[-len(programs):]), sep="; ", flush=True)
    draw(rows, picture)


if __name__ == "__main__":
    main()
