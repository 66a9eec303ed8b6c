#!/usr/bin/env python3
"""Certified packings for tests of other programs: makes them, proves them, and lists phi_J to 25 digits.

usage: reference_set.py FOLDER [--sizes 64,256,1024,4096] [--dims 2,3,4,5] [--count 10] [--minutes 30] [--results FILE.json#NAME]

A kind is a dimension, a number of spheres, and equal spheres or half of them 1.4 times wider. Seeds 1, 2, ... are tried until
`count` packings of each kind are proved exact or, as equal disks, trapped within `radius`. FOLDER, which is made, gets

    dD-nN.xyz       a frame for each packing of this d and N: centres and diameters as doubles
    NAME.jamproof   the exact numbers: centres of two doubles, contacts, forces

SHA256SUMS, and index.csv, which lists what was proved. `python3 jamproof.py NAME.jamproof` checks a file without libjam; it was
run on all packings of up to 1024 spheres, and one that it does not confirm is left out. Larger ones rest on libjam, and equal
disks are left out there. --minutes: of the processor, after which no
packing is begun. Needs the Python package `jam`; --results needs the source tree.
"""
import argparse
import csv
import hashlib
import itertools
import sys
import time
from decimal import Decimal, localcontext
from fractions import Fraction
from pathlib import Path

import numpy as np

import jam

ROOT = Path(__file__).resolve().parents[2]
START = {2: 0.3, 3: 0.2, 4: 0.1, 5: 0.05}  # packing fraction
MOST_FOR_CHECKER = 1024
TRIES = 3  # seeds for each packing that is wanted
PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459230781640628620899")
COLUMNS = ["name", "d", "N", "spheres", "seed", "theorem", "phi_J", "error", "radius", "contacts", "rattlers", "least force", "least gap"]

sys.path.append(str(ROOT / "bindings/proof"))
import jamproof  # noqa: E402


def decimal(x):
    return Decimal(x.numerator) / Decimal(x.denominator)


def packing_fraction(scene, error):
    """phi_J from the exact numbers of a proof file, to 25 digits or as many as the relative error leaves."""
    d, volume = scene.dim, Fraction(1)
    for k in range(d):
        volume *= Fraction(scene.cell[k][k], scene.one)
    spheres = sum(ratio**d for ratio in scene.ratio)
    with localcontext() as context:
        context.prec = 60
        of_ball = {2: PI / 4, 3: PI / 6, 4: PI**2 / 32, 5: PI**2 / 60}[d]  # of diameter 1
        phi = of_ball * decimal(scene.gamma).sqrt() ** d * decimal(spheres / volume)
        for digits in range(25, 0, -1):
            low, high = (round(phi * (1 + sign * Decimal(error)), digits) for sign in (-1, 1))
            if low == high:
                return str(low)
    raise ValueError("the error leaves no digit")


def made(folder, d, n, mixed, seed):
    """One packing: its row of the index, or None where nothing is proved."""
    ratio = np.where(np.arange(n) % 2, 1.4, 1.0) if mixed else np.ones(n)
    system = jam.System.random(n=n, dim=d, seed=seed, diameters=ratio, packing_fraction=START[d])
    system.compress(growth_rate=1e-2, pressure=1e4)
    if not system.crunch(wall_time=600).jammed:
        return None
    proof = system.prove(ratio)
    exact = proof.theorem == jam.Theorem.EXACT
    if proof.theorem == jam.Theorem.NONE or not (exact or n <= MOST_FOR_CHECKER):
        return None
    name = f"d{d}-n{n}-{'mixed' if mixed else 'equal'}-{seed:02d}"
    file = folder / f"{name}.jamproof"
    system.write_proof(str(file), ratio)
    scene, error, radius = jamproof.Scene(file), proof.fraction_error, proof.radius
    try:
        if not exact:
            found = jamproof.beside("jamproof_trapped", "trapped", scene)  # in the scene's gamma no pair overlaps
            error, radius = 0.51 * d * float(found["gamma_error"]), float(found["inner"])
        elif n <= MOST_FOR_CHECKER:
            jamproof.check(scene)
    except jamproof.Refused as why:
        print(f"{name}: {why}", file=sys.stderr, flush=True)
        file.unlink()
        return None
    one = folder / f"{name}.xyz"
    system.write(one)
    with open(folder / f"d{d}-n{n}.xyz", "a", encoding="ascii") as frames:
        frames.write(one.read_text(encoding="ascii"))
    one.unlink()
    row = [name, d, n, "half 1.4" if mixed else "equal", seed, proof.theorem.name.lower(), packing_fraction(scene, error)]
    row += [f"{error:.1e}", f"{radius:.1e}", proof.contacts, n - proof.stable]
    return [*row, f"{proof.least_force:.3e}", f"{proof.least_gap:.3e}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    whole = lambda text: [int(x) for x in text.split(",")]
    parser.add_argument("folder", type=Path)
    parser.add_argument("--sizes", type=whole, default=[64, 256, 1024, 4096])
    parser.add_argument("--dims", type=whole, default=[2, 3, 4, 5])
    parser.add_argument("--count", type=int, default=10)
    parser.add_argument("--minutes", type=float, default=30.0)
    parser.add_argument("--results")
    options = parser.parse_args()
    options.folder.mkdir(parents=True)
    rows, begin, over = [], time.process_time(), False
    for n, d, mixed in itertools.product(options.sizes, options.dims, (False, True)):
        found, seed = 0, 0
        while found < options.count and seed < TRIES * options.count and not over:
            seed += 1
            row = made(options.folder, d, n, mixed, seed)
            over = time.process_time() - begin > 60.0 * options.minutes
            if row:
                rows.append(row)
                found += 1
                print(*row[:8], flush=True)
        print(f"d = {d}, N = {n}, {'half 1.4' if mixed else 'equal'}: {found} proved of {seed}", file=sys.stderr, flush=True)
    with open(options.folder / "index.csv", "w", newline="", encoding="ascii") as file:
        csv.writer(file).writerows([COLUMNS, *rows])
    files = sorted(p for p in options.folder.iterdir() if p.suffix in (".xyz", ".jamproof", ".csv"))
    sums = "".join(f"{hashlib.sha256(p.read_bytes()).hexdigest()}  {p.name}\n" for p in files)
    (options.folder / "SHA256SUMS").write_text(sums, encoding="ascii")
    if options.results:
        sys.path.append(str(ROOT / "bindings/docs"))
        import figures

        first = [next(r for r in rows if (r[1], r[3]) == kind) for kind in dict.fromkeys((r[1], r[3]) for r in rows)]
        command = f"reference_set.py FOLDER --sizes {','.join(map(str, options.sizes))} --count {options.count}"
        figures.save(options.results, command, ["packing", "proved", "phi_J", "relative error"], [[r[0], *r[5:8]] for r in first])


if __name__ == "__main__":
    main()
