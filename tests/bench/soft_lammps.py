#!/usr/bin/env python3
"""Minimisers of soft spheres beside those of LAMMPS: processor time from random points to a balance of forces.

usage: soft_lammps.py FILE.json [N] [SEEDS]   then   soft_lammps.py FILE.json PICTURE.png
Harmonic spheres, d = 3, packing fraction 0.70. Each tolerance is a run of its own. LAMMPS has no harmonic repulsion in
Debian 12: it reads a table of it (pair_style table), and its residual is that of its own forces. The time of a run of no
step is taken off. Needs the program `lmp`.
"""
import json
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import jam

TOLERANCES = 10.0 ** np.arange(-2, -12.5, -2.0)
POINTS = 4000  # of the table
SCRIPT = """units lj
atom_style atomic
atom_modify map array
read_data start.data
mass 1 1.0
pair_style table linear {points}
pair_coeff 1 1 table.txt HARMONIC
neighbor {skin} bin
neigh_modify every 1 delay 0 check yes
timestep {step}
min_style {style}
{norm}
thermo_modify format float %.15g
{run}
dump end all custom 1 end.dump id fx fy fz
dump_modify end sort id format float %.17g
run 0 post no
"""


def write_start(folder, packing):
    """The start and the table: E = (1 - r / sigma)^2 / 2, tabulated in r^2."""
    sigma = packing.diameters[0]
    rows = "\n".join(f"{k} 1 {x:.17g} {y:.17g} {z:.17g}" for k, (x, y, z) in enumerate(packing.positions, 1))
    box = "\n".join(f"0 1 {c}lo {c}hi" for c in "xyz")
    (folder / "start.data").write_text(f"start\n\n{packing.n} atoms\n1 atom types\n\n{box}\n\nAtoms\n\n{rows}\n")
    low = 1e-3 * sigma
    r = np.sqrt(np.linspace(low**2, sigma**2, POINTS))
    table = "\n".join(
        f"{k} {x:.17g} {0.5 * (1 - x / sigma) ** 2:.17g} {(1 - x / sigma) / sigma:.17g}" for k, x in enumerate(r, 1)
    )
    (folder / "table.txt").write_text(f"HARMONIC\nN {POINTS} RSQ {low:.17g} {sigma:.17g}\n\n{table}\n")


def lammps(folder, packing, style, ftol):
    """(processor time, largest force on a sphere); ftol None: no step."""
    sigma = packing.diameters[0]
    run = "" if ftol is None else f"minimize 0.0 {ftol:.17g} 1000000 1000000"
    # FIRE's longest step is ten of these: 0.5 of the time sigma in which a contact of unit mass oscillates
    norm = "" if style == "hftn" else "min_modify norm max"
    text = SCRIPT.format(points=POINTS, skin=0.3 * sigma, step=0.05 * sigma, style=style, norm=norm, run=run)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    made = subprocess.run(["lmp", "-log", "none"], input=text, text=True, capture_output=True, cwd=folder)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if made.returncode:
        raise RuntimeError(made.stdout + made.stderr)
    forces = np.loadtxt(folder / "end.dump", skiprows=9)[:, 1:]
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds, np.linalg.norm(forces, axis=1).max()


def race(n, seeds):
    points = []
    for seed in range(1, seeds + 1):
        start = jam.System.random(n=n, seed=seed, packing_fraction=0.70, overlap="allow")
        minimum = start.copy()
        mean = minimum.relax().mean_overlap / start.diameters[0]
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            write_start(folder, start)
            idle = min(lammps(folder, start, "fire", None)[0] for _ in range(3))
            for tolerance in TOLERANCES:
                for style in ("fire", "hftn"):
                    norm = np.sqrt(n) / 3 if style == "hftn" else 1.0  # it looks at the Euclidean norm of all forces
                    seconds, force = lammps(folder, start, style, tolerance * mean * norm)
                    points.append((seed, f"LAMMPS {style}", tolerance, seconds - idle, force / mean))
                for minimiser in ("newton", "fire", "lbfgs"):
                    packing = start.copy()
                    begun = time.process_time()
                    report = packing.relax(minimiser=minimiser, force_tolerance=tolerance)
                    points.append(
                        (seed, f"libjam {minimiser}", tolerance, time.process_time() - begun, report.force_residual)
                    )
                for p in points[-5:]:
                    print(f"seed {p[0]}  {p[1]:14s} asked {p[2]:.0e}  {p[3]:8.3f} s  reached {p[4]:.1e}", flush=True)
    return points


def draw(data, picture):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axis = plt.subplots(figsize=(6.5, 4.5))
    for k, name in enumerate(dict.fromkeys(p[1] for p in data["points"])):
        rows = [[p[3:] for p in data["points"] if p[1] == name and p[2] == t] for t in data["tolerances"]]
        middle = np.array([np.median(r, axis=0) for r in rows])
        axis.loglog(*middle.T, "o-" if name.startswith("libjam") else "s:", ms=4, color=f"C{k}", label=name)
    axis.set(
        xlabel="processor time (s), median", ylabel="max |F_i| / <f>", title=f"N = {data['n']}, random points at 0.70"
    )
    axis.legend(fontsize=8)
    axis.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


def main():
    name = Path(sys.argv[1])
    if len(sys.argv) > 2 and sys.argv[2].endswith(".png"):
        return draw(json.loads(name.read_text()), sys.argv[2])
    if not shutil.which("lmp"):
        sys.exit("the program lmp is not installed (Debian: lammps)")
    n, seeds = int(sys.argv[2]) if len(sys.argv) > 2 else 1024, int(sys.argv[3]) if len(sys.argv) > 3 else 3
    points = race(n, seeds)
    name.write_text(json.dumps({"n": n, "tolerances": list(TOLERANCES), "points": points}))


if __name__ == "__main__":
    main()
