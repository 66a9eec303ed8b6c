"""Compares a proof file with an XYZ file: centres, diameters, cell. jamproof.py loads this file for --xyz.

The packing that is proved lies within the printed radius of the centres of the proof file. An XYZ file that agrees with
these centres to rounding therefore has the proved packing, to the digits of that file. The comparison is in exact
fractions: a number of the XYZ file is the decimal that stands there. The file needs a Lattice, and the columns pos and
radius or diameter.
"""
import re
from fractions import Fraction

OTHER = Fraction(1, 10**3)  # part of the least diameter: centres farther apart are another packing


def columns(words):
    """{name: (first column, how many)} of Properties."""
    found, at = {}, 0
    for name, _, many in zip(*[iter(words.split(":"))] * 3):
        found[name], at = (at, int(many)), at + int(many)
    return found


def read(path, dim):
    """Cell vectors, centres and diameters as fractions."""
    with open(path, encoding="utf-8") as file:
        lines = file.read().splitlines()
    count = int(lines[0])
    lattice = re.search(r'Lattice="([^"]*)"', lines[1])
    properties = re.search(r"Properties=(\S+)", lines[1])
    if not lattice or not properties:
        raise ValueError("there is no Lattice or no Properties")
    named, flat = columns(properties.group(1)), list(map(Fraction, lattice.group(1).split()))
    cell = [flat[3 * q : 3 * q + dim] for q in range(dim)]
    rows = [line.split() for line in lines[2 : 2 + count]]
    (x, _), width = named["pos"], named.get("radius") or named["diameter"]
    times = 2 if "radius" in named else 1
    centres = [list(map(Fraction, row[x : x + dim])) for row in rows]
    return cell, centres, [times * Fraction(row[width[0]]) for row in rows]


def away(a, b, cell):
    """Largest component of a - b, in the nearest image."""
    r = [p - q for p, q in zip(a, b)]
    for q in reversed(range(len(cell))):
        n = round(r[q] / cell[q][q])
        r = [c - n * h for c, h in zip(r, cell[q])]
    return max(map(abs, r))


def compare(s, path):
    """(whether it is the same packing, what was found)."""
    try:
        cell, x, diameters = read(path, s.dim)
    except (OSError, ValueError, LookupError, ZeroDivisionError) as error:
        return False, f"cannot be read: {error}"
    if len(x) != len(s.x):
        return False, f"another packing: {len(x)} spheres, the proof file has {len(s.x)}"
    unit = s.unit / s.one
    own = [[v * unit for v in row] for row in s.cell]
    shape = max(abs(a - b) for one, other in zip(own, cell) for a, b in zip(one, other))
    centres = [away([v * unit for v in a], b, own) for a, b in zip(s.x, x)]
    # sigma = ratio sqrt(gamma) unit, compared through squares: |a - b| / b = |a^2 - b^2| / b^2 / 2 to first order
    sizes = max(abs(d**2 - v**2 * s.gamma * s.unit**2) / d**2 / 2 for d, v in zip(diameters, s.ratio))
    parts = {"stable centres": [c for c, yes in zip(centres, s.stable) if yes],
             "rattlers": [c for c, yes in zip(centres, s.stable) if not yes]}  # fmt: skip
    text = [f"{name} within {float(max(found)):.2g}" for name, found in parts.items() if found]
    text += [f"diameters within {float(sizes):.2g} of themselves", f"cell within {float(shape):.2g}"]
    far = max(max(parts["stable centres"]), shape) > OTHER * min(diameters) or sizes > OTHER
    return not far, ("another packing: " if far else "the same packing: ") + ", ".join(text)
