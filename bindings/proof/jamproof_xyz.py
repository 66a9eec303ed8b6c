"""Compares a proof file with an XYZ file: centres, diameters, cell. jamproof.py loads this file for --xyz.

The packing that is proved lies within the printed radius of the centres of the proof file. An XYZ file that agrees with
these centres to rounding therefore has the proved packing, to the digits of that file. The comparison is in exact
fractions: a number of the XYZ file is the decimal that stands there. The file needs a Lattice, and the columns pos and
radius or diameter; beyond d = 3 a cell that is no cube needs all vectors as cell= or Lattice=.
"""
import re
from fractions import Fraction

OTHER = Fraction(1, 10**3)  # part of the least diameter: centres farther apart are another packing
NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]{1,3})?")  # a longer exponent would never end


def expect(right, words):
    if not right:
        raise ValueError(words)


def number(word):
    expect(NUMBER.fullmatch(word), f"{word!r} is not a decimal number")
    return Fraction(word)


def columns(words):
    """{name: (first column, how many)} of Properties, and how many there are."""
    found, at = {}, 0
    for name, _, many in zip(*[iter(words.split(":"))] * 3):
        expect(int(many) > 0, f"Properties gives {name} {many} columns")
        found[name], at = (at, int(many)), at + int(many)
    return found, at


def vectors(line, d):
    """Cell vectors of all d d numbers, of nine that have two or three of them, or of nine of a cube."""
    given = re.search(r'\bcell="([^"]*)"', line) if d > 3 else None
    given = given or re.search(r'Lattice="([^"]*)"', line)
    expect(given, "there is no Lattice")
    flat = list(map(number, given.group(1).split()))
    expect(len(flat) in (d * d, 9), f"the cell has {len(flat)} numbers, not {d * d}")
    if len(flat) < d * d:
        expect(flat == [flat[0] * (k % 4 == 0) for k in range(9)], f"Lattice is no cube, and lacks {d - 3} vectors")
        flat = [flat[0] * (k % (d + 1) == 0) for k in range(d * d)]
    wide = d if len(flat) == d * d else 3
    return [flat[wide * q : wide * q + d] for q in range(d)]


def read(path, dim):
    """Cell vectors, centres and diameters as fractions."""
    with open(path, encoding="utf-8") as file:
        count, head, *lines = file.read().splitlines()
    properties = re.search(r"Properties=(\S+)", head)
    expect(properties, "there are no Properties")
    named, many = columns(properties.group(1))
    rows = [line.split() for line in lines[: max(0, int(count))]]
    expect(len(rows) == int(count), f"{len(rows)} spheres follow, not {count}")
    expect(all(len(row) >= many for row in rows), f"a line has fewer than {many} columns")
    (x, wide), (size, _) = named["pos"], named.get("radius") or named["diameter"]
    expect(wide >= dim, f"pos has {wide} columns, d is {dim}")
    times = 2 if "radius" in named else 1
    centres = [list(map(number, row[x : x + dim])) for row in rows]
    return vectors(head, dim), centres, [times * number(row[size]) for row in rows]


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
        return compared(s, *read(path, s.dim))
    except (OSError, ValueError, LookupError, ArithmeticError) as error:
        return False, f"cannot be read: {error}"


def compared(s, cell, x, diameters):
    if len(x) != len(s.x):
        return False, f"another packing: {len(x)} spheres, the proof file has {len(s.x)}"
    expect(min(diameters) > 0, "a diameter is not positive")
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
