#!/usr/bin/env python3
"""Speed against accuracy of isoconfigurational runs: K[C, <dr>], its error and its bias against processor time.

usage: near_jamming_accuracy.py PICTURE.png [RUNS]      largest number of runs, default 1000
Event-driven dynamics at phi/phi_J = 0.995 to tau = 20 and Monte Carlo (alpha = 2, T = 1e-4) to 50 sweeps, N = 1024,
for 30, 100, 300, ... runs. 5000 runs take five minutes of one core. Prints JSON.
Left: K at an early and at a late instant. Right: its standard error, by resampling blocks of ten runs, and how far it
is from K of all runs. The error falls as one over the root of the runs. K grows with the runs, as the noise of means
over few runs hides part of it; the bars hold no part of that.
"""
import json
import sys
import time

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

import jam  # noqa: E402
from jam import near_jamming as nj  # noqa: E402

SCENES = {
    "molecular dynamics": ([2, 20], dict(density_ratio=0.995)),
    "Monte Carlo": ([5, 50], dict(monte_carlo=dict(alpha=2, temperature=1e-4, step=0.1))),
}


def counts(most):
    steps = [30, 100, 300, 1000, 3000]
    return [c for c in steps if c < most] + [most]


def measure(packing, structure, instants, options, most):
    """One row for each number of runs; the runs of a row are also those of the next."""
    runs, seconds, rows = None, 0.0, []
    for count in counts(most):
        first = runs.runs if runs else 0
        begin = time.process_time()
        made = packing.isoconf(instants, first_run=first, runs=count - first, block=10, **options)
        seconds += time.process_time() - begin
        runs = runs.merge(made) if runs else made
        k, e = nj.correlations(runs, structure), nj.correlation_errors(runs, structure, 40)
        between = nj.reliability(runs)["displacement"]
        for m, instant in enumerate(instants):
            rows.append(
                dict(
                    instant=instant,
                    runs=count,
                    seconds=seconds,
                    k=k["c"][m],
                    error=e["c"][m],
                    between_halves=between[m],
                )
            )
    return rows


def draw(axes, name, instant, rows, color, style):
    t, k, e = ([row[key] for row in rows] for key in ("seconds", "k", "error"))
    label = f"{name}, {instant} {'collisions' if name.startswith('mol') else 'sweeps'}"
    axes[0].errorbar(t, k, e, fmt="." + style, color=color, label=label)
    axes[1].loglog(t, e, "." + style, color=color, label=f"error: {label}")
    axes[1].loglog(t[:-1], [abs(x - k[-1]) for x in k[:-1]], "x:", color=color, lw=1 if style == "-" else 0.6)
    for x, y, row in zip(t, k, rows):
        if style == "-":
            axes[0].annotate(row["runs"], (x, y), xytext=(0, 6), textcoords="offset points", fontsize=6, ha="center")


def main(picture, most=1000):
    packing = jam.System.random(n=1024, seed=1)
    packing.compress([(1e-2, 500.0), (3e-3, 1e5)])
    packing.crunch()
    structure, out = nj.predictors(packing), []
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.4))
    for color, (name, (instants, options)) in zip(("C0", "C1"), SCENES.items()):
        rows = measure(packing, structure, instants, options, most)
        for instant, style in zip(instants, ("--", "-")):
            draw(axes, name, instant, [r for r in rows if r["instant"] == instant], color, style)
        out += [dict(scene=name, **row) for row in rows]
    axes[0].set(xscale="log", xlabel="processor time / s", ylabel="K[C, <dr>]", title="numbers: runs")
    axes[1].set(xlabel="processor time / s", ylabel="standard error; crosses: distance from the last K")
    axes[0].legend(fontsize=7)
    axes[1].legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(picture, dpi=75)
    print(json.dumps(out, indent=1))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1], *map(int, sys.argv[2:3]))
