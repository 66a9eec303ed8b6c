"""The inverse of the equations of a proof file that has none, by floats: from numpy, or else computed here.

jamproof.py loads this file where it needs it. The inverse is a hint: jamproof.py bounds 1 - A J in integers, so that
nothing here can make a false proof.
"""
import base64
import zlib
from array import array
from operator import mul
from pathlib import Path

from jamproof import BITS, Refused, watched


def float_inverse(rows):
    """Of a square matrix, without numpy by Gauss and Jordan."""
    try:
        import numpy

        return numpy.linalg.inv(numpy.array(rows)).tolist()
    except ImportError:
        n = len(rows)
    a = [[*row, *(float(k == i) for k in range(n))] for i, row in enumerate(rows)]
    for c in watched(range(n), "columns of the inverse"):
        p = max(range(c, n), key=lambda r: abs(a[r][c]))
        a[p], a[c] = a[c], [v / a[p][c] for v in a[p]]
        for r, row in enumerate(a):
            if r != c and row[c]:
                a[r] = [x - row[c] * y for x, y in zip(row, a[c])]
    return [row[n:] for row in a]


def left_inverse(rows):
    """(R^T R)^-1 R^T of floats."""
    if len(rows) == len(rows[0]):
        return float_inverse(rows)
    try:
        import numpy

        r = numpy.array(rows)
        return (numpy.linalg.inv(r.T @ r) @ r.T).tolist()
    except ImportError:
        flat = list(zip(*rows))
    square = float_inverse([[sum(map(mul, a, b)) for b in flat] for a in watched(flat, "rows of J^T J")])
    return [[sum(map(mul, a, b)) for b in rows] for a in square]


def complete(scene, out):
    """Writes the file again, with the inverse that was made for it, if any."""
    text = scene.text
    if scene.hint and not scene.inverse:
        e, flat = scene.hint
        text = text.rstrip("\n") + f"\ninverse {e} {base64.b64encode(zlib.compress(flat.tobytes())).decode()}\n"
    Path(out).write_text(text, encoding="ascii")


def hint(unknowns, j, count):
    """(e, the inverse of the columns j without its row of G, column by column in units of 2^e); `count`: rows of j."""
    rows = [[0.0] * len(j) for _ in range(count)]
    for l, column in enumerate(j):
        for c, value in column:
            rows[c][l] += value / 2.0**BITS
    try:
        a = left_inverse(rows)
        e = int(max(max(map(abs, row)) for row in a)).bit_length() - 30
        return e, array("i", [round(v * 2.0**-e) for column in zip(*a[:unknowns]) for v in column])
    except Exception as error:  # of a hint, whoever made it
        raise Refused(f"singular: {error}") from None
