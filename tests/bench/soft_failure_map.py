#!/usr/bin/env python3
"""Where soft spheres can be balanced: exponent of the energy against distance from jamming, in d = 2, 3 and 4.

usage: soft_failure_map.py PICTURE.png [N] [SECONDS]     N = 100 spheres, at most 10 s a step
Each packing goes down a ladder of distances ln(R / R_J), to a force balance of 1e-12 at each. A ladder ends where a step does
not converge, or where contacts are too few to go on (isostatic). Prints a row a ladder.
"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

import jam  # noqa: E402

ALPHAS = (1.2, 1.5, 1.8, 2.0, 2.5, 3.0)
DISTANCES = [10.0**-k for k in range(2, 13)]
STEP = 20000  # evaluations of a step; one that needs more is taken back and its square root tried
START = {2: 0.95, 3: 0.72, 4: 0.55}  # packing fraction, well above jamming


def ladder(n, dim, alpha, seconds):
    """(distance, status, residual) of each step, the last one may have failed."""
    sizes = [1.0, 1.4] * (n // 2) if dim == 2 else [1.0] * n
    packing = jam.System.random(n=n, dim=dim, seed=1, packing_fraction=START[dim], diameters=sizes, overlap="allow")
    rows = []
    for target in DISTANCES:
        r = packing.decompress(
            alpha=alpha, distance=target, isostatic=0, crunch=0, wall_time=seconds, max_evaluations=STEP
        )
        rows.append((target, r.status, r.force_residual))
        if r.status != jam.StatusCode.OK:
            break
    return rows


def main():
    n = int(sys.argv[2]) if len(sys.argv) > 2 else 100
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 10.0
    figure, axes = plt.subplots(1, len(START), figsize=(4 * len(START), 3.4), sharey=True)
    print("d  alpha  reached   largest residual  then")
    for axis, dim in zip(axes, START):
        for alpha in ALPHAS:
            rows = ladder(n, dim, alpha, seconds)
            good = [q for q in rows if q[1] == jam.StatusCode.OK]
            failed = rows[len(good) :]
            axis.plot([q[0] for q in good], [alpha] * len(good), "go", ms=5)
            for distance, status, _ in failed:
                axis.plot(distance, alpha, "rx", ms=7)
                axis.annotate(status.name, (distance, alpha), fontsize=6, xytext=(4, 4), textcoords="offset points")
            least = f"{good[-1][0]:.0e}" if good else "none"
            worst = max((q[2] for q in good), default=float("nan"))
            print(
                f"{dim}  {alpha:5.2f}  {least:8s}  {worst:9.1e}         {failed[0][1].name if failed else ''}",
                flush=True,
            )
        axis.set(xscale="log", xlabel="ln(R / R_J)", title=f"d = {dim}, N = {n}")
        axis.invert_xaxis()
    axes[0].set_ylabel("alpha")
    figure.tight_layout()
    figure.savefig(sys.argv[1], dpi=90)


if __name__ == "__main__":
    main()
