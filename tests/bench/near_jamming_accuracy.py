#!/usr/bin/env python3
"""Speed against accuracy of isoconfigurational runs: K[C, <dr>] and its standard error against processor time.

usage: near_jamming_accuracy.py PICTURE.png [RUNS]      largest number of runs, default 480
Event-driven dynamics at phi/phi_J = 0.995 to tau = 20 and Monte Carlo (alpha = 2, T = 1e-4) to 50 sweeps, N = 1024.
Prints JSON. The error falls as one over the root of the runs; the value grows towards that of noiseless means.
"""
import json
import sys
import time

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

import jam  # noqa: E402
from jam import near_jamming as nj  # noqa: E402


def main(picture, most=480):
    packing = jam.System.random(n=1024, seed=1)
    packing.compress([(1e-2, 500.0), (3e-3, 1e5)])
    packing.crunch()
    structure, rows = nj.predictors(packing), []
    figure, axes = plt.subplots(1, 2, figsize=(10, 4))
    scenes = {
        "molecular dynamics": ([2, 20], dict(density_ratio=0.995)),
        "Monte Carlo": ([5, 50], dict(monte_carlo=dict(alpha=2, temperature=1e-4, step=0.1))),
    }
    for name, (instants, options) in scenes.items():
        count = 30
        points = []
        while count <= most:
            begin = time.process_time()
            runs = packing.isoconfigurational(instants, runs=count, block=max(1, count // 15), **options)
            seconds = time.process_time() - begin
            k, e = nj.correlations(runs, structure), nj.correlation_errors(runs, structure, 40)
            halves = nj.reliability(runs)["displacement"]
            points.append((seconds, k["c"][1], e["c"][1]))
            rows.append(
                dict(scene=name, runs=count, seconds=seconds, k=k["c"][1], error=e["c"][1], reliability=halves[1])
            )
            count *= 2
        t, k, e = zip(*points)
        axes[0].errorbar(t, k, e, fmt=".-", label=name)
        axes[1].loglog(t, e, ".-", label=name)
    axes[0].set(xscale="log", xlabel="processor time / s", ylabel="K[C, <dr>]")
    axes[1].set(xlabel="processor time / s", ylabel="its standard error")
    axes[0].legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(picture, dpi=75)
    print(json.dumps(rows, indent=1))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1], *map(int, sys.argv[2:3]))
