"""Minimal polynomials of the largest sums of radii of n <= 8 disks in the unit square, and balls in the cube, from their digits.

usage: minimal_polynomials.py [LARGEST DEGREE] [SECONDS A VALUE]     writes results/minimal_polynomials.json

A relation of powers with whole numbers is found by PSLQ (mpmath) from D digits, D = 14 (degree + 1) + 40, and is kept if it is
0 at twice as many proved digits. That is no proof, but a chance of 10^-D.
"""
import sys
import time
from decimal import Decimal
from pathlib import Path

import mpmath

import jam
import jam.radii
from jam.errors import StateError

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "bindings/docs"))

import figures  # noqa: E402

LARGEST = 10**12  # coefficient
COLUMNS = ["dim", "n", "sum of radii", "degree", "polynomial", "digits of the search", "residual at twice the digits"]


def text_of(coefficients):
    """Highest power first."""
    terms = []
    for k in range(len(coefficients) - 1, -1, -1):
        c = coefficients[k]
        if c:
            size = "" if abs(c) == 1 and k else str(abs(c))
            terms.append(("- " if c < 0 else "+ ") + size + ("" if k == 0 else "x" if k == 1 else f"x^{k}"))
    return " ".join(terms).removeprefix("+ ")


def relation(value, degree):
    """Coefficients by growing power, or None."""
    digits = 14 * (degree + 1) + 40
    with mpmath.workdps(digits):
        x = mpmath.mpf(value)
        found = mpmath.pslq([x**k for k in range(degree + 1)], maxcoeff=LARGEST, maxsteps=10**6, tol=mpmath.mpf(10) ** (15 - digits))
    if not found or not found[degree]:
        return None, digits, None
    found = [c if found[degree] > 0 else -c for c in found]
    with mpmath.workdps(2 * digits):
        x = mpmath.mpf(value)
        rest = abs(sum(c * x**k for k, c in enumerate(found)))
        if rest > mpmath.mpf(10) ** (40 - 2 * digits):
            return None, digits, None
        return found, digits, mpmath.nstr(rest, 1) if rest else "0"


def best(n, dim):
    scene = {"walls": "xyz"[:dim], "box": 1.0}
    found = jam.radii.best_of(n, dim, **scene, starts=12 if dim == 2 else 3, workers=1).best[0]
    packing = jam.System.from_arrays(found.positions, radii=found.radii, overlap="shrink", **scene)
    packing.maximise_radii(room=1e-9)
    return packing


most, seconds = [int(a) for a in sys.argv[1:3]] + [20, 60][len(sys.argv) - 1 :]
rows = []
for dim, n in [(2, n) for n in range(3, 9)] + [(3, n) for n in range(3, 9)]:
    begun = time.monotonic()
    try:
        value = str(jam.radii.prove(best(n, dim), 2 * (14 * (most + 1) + 40) + 20).value)
    except StateError as why:
        print(dim, n, why, flush=True)
        continue
    for degree in range(1, most + 1):
        found, digits, rest = relation(value, degree)
        if found or time.monotonic() - begun > seconds:
            break
    shown = text_of(found) if found else f"none of degree {degree} or less with coefficients below 10^12"
    rows.append([dim, n, f"{Decimal(value):.30f}", degree if found else "", shown, digits, rest or ""])
    print(*rows[-1], flush=True)
figures.save(HERE / "results/minimal_polynomials.json", "minimal_polynomials.py", COLUMNS, rows)
