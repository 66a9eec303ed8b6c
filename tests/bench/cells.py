#!/usr/bin/env python3
"""What a cell that is no cube costs: rates of molecular dynamics and Monte Carlo, and the error of p against time.

python3 tests/bench/cells.py [--sizes 1000,8000] [--seconds 10] [--out cells.json] [--picture cells.png]
Fluids of equal spheres at packing fraction 0.45. Processor time, one thread; the cells take turns.
"""
import argparse
import json
import time
from pathlib import Path

import jam

CELLS = {
    "cube": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
    "monoclinic": [[1, 0, 0], [0, 1.3, 0], [0.4, 0, 0.8]],
    "rhombic dodecahedron": [[0, 1, 1], [1, 0, 1], [1, 1, 0]],
    "long": [[1, 0, 0], [0, 1, 0], [0.3, 0.1, 6]],
}
FRACTION = 0.45


def carnahan_starling(x):
    return (1 + x + x**2 - x**3) / (1 - x) ** 3


def fluid(n, cell):
    s = jam.System.random(n, 3, 1, packing_fraction=0.25, cell=cell)
    s.compress(growth_rate=0.1, pressure=1e12, packing_fraction=FRACTION)
    s.run(collisions_per_particle=50)
    return s


def molecular_dynamics(s, length):
    r = s.run(collisions_per_particle=100 * length)
    return r.collisions, r.pressure, r.pressure_error


def monte_carlo(s, length):
    r = s.monte_carlo(sweeps=int(200 * length), step=0.08)
    return r.sweeps * s.n, r.pressure, r.pressure_error


def measure(n, seconds):
    rows = []
    state = {name: fluid(n, cell) for name, cell in CELLS.items()}
    for method in (molecular_dynamics, monte_carlo):
        spent, length = 0.0, 1000.0 / n
        while spent < seconds:
            for name, s in state.items():
                begin = time.process_time()
                work, p, error = method(s.copy(), length)
                spent = time.process_time() - begin
                rows.append(
                    {
                        "n": n,
                        "method": method.__name__,
                        "cell": name,
                        "seconds": spent,
                        "rate": work / spent,
                        "p": p,
                        "p_error": error,
                        "deviation": p / carnahan_starling(FRACTION) - 1,
                    }
                )
                print(rows[-1], flush=True)
            length *= 4
    return rows


def draw(rows, path):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    fig, axes = plt.subplots(1, 2, figsize=(9, 3.8), constrained_layout=True, sharey=True)
    for axis, method in zip(axes, ("molecular_dynamics", "monte_carlo")):
        for name, colour in zip(CELLS, ("#1a202c", "#2b6cb0", "#c05621", "#2f855a")):
            for n, style in zip(sorted({r["n"] for r in rows}), ("o-", "s--")):
                of = [r for r in rows if (r["method"], r["cell"], r["n"]) == (method, name, n)]
                x, y = [r["seconds"] for r in of], [r["p_error"] / r["p"] for r in of]
                axis.loglog(x, y, style, color=colour, mfc="white", label=f"{name}, N = {n}")
        axis.set_title("Monte Carlo" if method == "monte_carlo" else "molecular dynamics")
        axis.set_xlabel("processor time (s)")
    axes[0].set_ylabel("standard error of p, relative")
    axes[1].legend(fontsize=7)
    fig.savefig(path, dpi=130)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", default="1000,8000")
    parser.add_argument("--seconds", type=float, default=10.0, help="of the longest run")
    parser.add_argument("--out", default="cells.json")
    parser.add_argument("--picture")
    args = parser.parse_args()
    rows = [r for n in args.sizes.split(",") for r in measure(int(n), args.seconds)]
    Path(args.out).write_text(json.dumps(rows, indent=1))
    if args.picture:
        draw(rows, args.picture)


if __name__ == "__main__":
    main()
