#!/usr/bin/env python3
"""Checks a proof file of a jammed packing: jamproof.py FILE [OUT] [--xyz PACKING.xyz]

Proved is: exactly one packing within the printed radius touches exactly in the contacts that the file lists. All its
forces are positive, all other pairs are open, and its stable spheres are collectively jammed; of a file with the word
strict strictly: every motion and strain without overlap enlarges the volume; of a file with the word sum, that the
weighted sum of radii has a strict local maximum there. Integers and fractions decide. Forces and inverse are hints:
bad ones lose the proof, they cannot make one. A file without inverse gets one by floats, from numpy or else computed
here; OUT is then the file with it, but for files with a line symmetry, which stay without. A second line says what
packing that is: spheres, contacts, rattlers, and the packing fraction to the digits that are proved.

Exit status: 0 proved, 1 not proved, 2 a file cannot be read or written, or PACKING.xyz is another packing, 3 trapped
but not proved, 4 could not try: a file that this one needs is not beside it. Such files are jamproof_implied.py where
some contacts follow from others, jamproof_symmetric.py where a symmetry closes them, jamproof_trapped.py for crystals
and all else with more contacts than unknowns, and jamproof_xyz.py for --xyz. The guide has the proofs.

Theorem A. Unknown are the centres x of the stable spheres but the first, and G; if strict, in place of G the cell
vectors H, a lower triangle; of a sum, all diameters. F_c = |r_c|^2 - G sigma_c^2, r_c = x_i - x_j + n H, is to be 0
for each contact c = (i, j, n). J = F', and R is J without the column of G. D = 4 d, or d max_c (2 + |n|_1)^2 if
strict; 4 d + 1 of a sum. For any matrix A let, in the maximum norm, delta >= |1 - A J|, eta >= |A F|, alpha >= |A|,
and beta = D alpha.
(1) If eta + delta r + beta r^2 <= r and delta + 2 beta r < 1, then F has exactly one zero within r.
(2) Forces f are within (|R^T f - b|_1 + 2 D r |f|_1 + b') max |A_kc| / (1 - delta - 2 beta r) of those at the zero. Not
    strict, both have sum f sigma^2 = 1, and b = b' = 0. Strict, b is the gradient of log V, 1 / h on the diagonal of H,
    and b' = sum r / (h (h - r)) bounds its change. Of a sum, b = -w_i / 2 for each diameter, and b' = 0.
(3) A pair x with m stable spheres stays open if |x|^2 - 2 m r |x|_1 > (G + r_G) sigma^2; if strict, m + |n|_1 for m;
    of a sum with (sigma + r)^2 on the right.
A flat wall is a contact with the mirror image: r_c is twice the way from the wall to x_i, sigma_c the diameter, m = 2
for a stable sphere. Along an axis with walls the first sphere is unknown too.
A round wall of a container of width W has F_c = (W - g s_i)^2 - |r_c|^2, r_c = 2 x_i - W along its axes, s_i the ratio.
Of such a file g is unknown in place of G = g^2, D = 4 d + max sigma_c^2. For each rotation that the wall allows one
component of a sphere is pinned: where J is regular, no rotation leaves all of them at rest. The wall stays open if
|r|^2 + 2 m r |r|_1 + d (m r)^2 < (W - (g + r_g) s)^2, m = 2 for a stable sphere.
"""
import base64
import decimal
import math
import re
import runpy
import sys
import time
import zlib
from array import array
from fractions import Fraction
from operator import add, mul
from pathlib import Path

HERE = sys.modules[__name__]
BITS, CHUNK, BIAS = 24, 16, 1 << 62  # digits of J; columns of A summed at once; makes 64-bit digits positive
MOST_IMAGES, WAIT, FARTHEST = 10**6, 10, 10**4  # of a pair; seconds between lines of long loops; exponents of two
SEEN, TWO = Fraction(9, 8), Fraction(2)  # gaps are those of pairs closer than SEEN times their sigma
ONE, SIZE = ("dim", "unit", "non_additivity"), ("gamma", "growth")  # lines of one number; there is one of SIZE
HEADER = (*ONE, *SIZE, "cell")
WORDS = {*ONE, *"cell walls round pin sphere contact wall tile implied inverse strict sum symmetry".split()}
AT_LEAST = ("outer", "least_gap", "least_force")  # bounds from below; all others are bounds from above


class Refused(ValueError):
    """The file cannot be read, or nothing was proved, and why."""


class Missing(Exception):
    """A file that is needed is not beside this one."""


def refuse(wrong, words):
    if wrong:
        raise Refused(words)


def integer(word):
    """As libjam writes one: digits alone, no plus sign, no leading zero."""
    refuse(not re.fullmatch("0|-?[1-9][0-9]*", word, re.ASCII), f"{word!r} is not a whole number")
    return int(word)


def number(word):
    """m p e is m 2^e; several with commas are a sum."""
    parts = [[integer(x) for x in part.split("p")] for part in word.split(",")]
    refuse(any(len(part) != 2 for part in parts), f"{word!r} is not of the form m p e")
    refuse(max(abs(e) for _, e in parts) > FARTHEST, f"an exponent of two is beyond {FARTHEST}")
    return sum(m * TWO**e for m, e in parts)


def whole(values):
    """Fractions over powers of two as integers over one of them."""
    one = max(v.denominator for v in values)
    return [v.numerator * (one // v.denominator) for v in values], one


def watched(items, what, power=1):
    """The items; a line to stderr now and then says how far it is. The work until item k grows as k^power."""
    began = last = time.monotonic()
    for k, item in enumerate(items, 1):
        yield item
        if (now := time.monotonic()) - last > WAIT:
            last, left = now, (now - began) * ((len(items) / k) ** power - 1)
            print(f"{what}: {k} of {len(items)}, about {left:.0f} s more", file=sys.stderr, flush=True)


def beside(name, function, *arguments):
    """Calls a function in a file beside this one. That imports from here, under whatever name this one runs."""
    path = Path(__file__).resolve().with_name(name + ".py")
    if not path.is_file():
        raise Missing(f"{path.name}, which this file needs, is not beside jamproof.py")
    sys.modules["jamproof"] = HERE
    return runpy.run_path(str(path))[function](*arguments)


class Scene:
    """The exact numbers of a file. Lengths `x` and `cell` are integers over `one`, `size` of spheres over `per`."""

    def __init__(self, path):
        self.text = (zlib.decompress(x, 31) if (x := Path(path).read_bytes())[:2] == b"\x1f\x8b" else x).decode("ascii")
        strange = re.search("[^ -~\n]", self.text)
        refuse(strange, "a character, such as a carriage return, is neither printable ASCII nor a line feed")
        lines = [line.split() for line in self.text.removesuffix("\n").split("\n")]
        refuse(lines[:1] != [["jamproof", "1"]], "the first line is not 'jamproof 1'")
        refuse([] in lines, "a line is empty")

        def take(name, *counts):
            """What follows a word in its lines, as many numbers as it must; in the header there is one line of it."""
            rows = [rest for other, *rest in lines[1:] if other == name]
            what = f"{'the' if name in HEADER else 'a'} line '{name}'"
            refuse(name in HEADER and len(rows) != 1, f"{what} is there {len(rows)} times, not once")
            what += " has not as many numbers as " + ("it must, one" if name in HEADER[:-1] else "dim asks for")
            refuse(any(len(rest) not in counts for rest in rows), what)
            return rows

        self.round = sum(integer(m) for (m,) in take("round", 1))  # axes of the round wall
        size = SIZE[self.round > 0]
        ((dim,),), ((unit,),), ((cross,),), ((grown,),) = (take(name, 1) for name in (*ONE, size))
        self.dim = d = integer(dim)
        refuse(d < 1, "dim is not 1 or more")
        (cell,), spheres = take("cell", d * (d + 1) // 2), take("sphere", d + 2)
        take("contact", d + 3, d + 4), take("wall", 4, 5)
        contacts = [line for line in lines if line[0] in ("contact", "wall")]
        closed, self.pins = take("walls", *range(1, d + 1)), [(integer(i), integer(k)) for i, k in take("pin", 2)]
        flat = [integer(c) for row in closed for c in row]
        self.closed = [*range(self.round), *flat]  # axes with walls
        self.unit, self.growth, cross = number(unit), number(grown), 1 + number(cross)
        self.gamma = self.growth**2 if self.round else self.growth
        refuse(any(s[0] not in ("0", "1") for s in spheres), "a sphere is neither 1, stable, nor 0, a rattler")
        self.stable, self.ratio = [s[0] == "1" for s in spheres], [number(s[1]) for s in spheres]
        self.contacts = [self.ends(name, list(map(integer, rest[: d + 2 if name == "contact" else 3])))
                         for name, *rest in contacts]  # fmt: skip
        forces = [list(map(number, rest[d + 2 if name == "contact" else 3 :])) for name, *rest in contacts]
        self.force, self.row = [f[0] for f in forces], [f[-1] for f in forces]  # row: without implied contacts
        self.tiles = [(name, list(map(integer, ring))) for name, *ring in lines if name in ("tile", "implied")]
        self.within, self.hint, packed = None, None, take("inverse", 2)
        self.strict, weights = bool(strict := take("strict", 0)), take("sum", len(spheres))
        self.weights = [number(w) for row in weights for w in row]
        self.fixed = self.strict or bool(self.weights)  # G is no unknown
        refuse(max(len(strict), len(packed)) > 1, "a line 'strict' or 'inverse' is there twice")
        refuse(max(len(closed), len(weights)) > 1, "a line 'walls' or 'sum' is there twice")
        for name in (line[0] for line in lines[1:]):
            refuse(name not in WORDS and name != size, f"unknown word {name}")
        lengths = [number(x) for s in [cell] + [s[2:] for s in spheres] for x in s]
        halves = [v / 2 for v in self.ratio] if self.weights else []
        lengths, self.one = whole(lengths + halves)
        self.cell = [lengths[r * (r + 1) // 2 : (r + 1) * (r + 2) // 2] + [0] * (d - r - 1) for r in range(d)]
        self.x = [lengths[at : at + d] for at in range(len(cell), len(lengths) - len(halves), d)]
        at_walls = {c for c, (_, j, _) in enumerate(self.contacts) if j < 0}
        ends, named = {i for c in self.contacts for i in c[:2]}, {c for _, ring in self.tiles for c in ring}
        again = {(j, i, tuple(-v for v in n)) for i, j, n in self.contacts} | set(self.contacts)
        positive = [self.unit, self.growth, *self.ratio, *(self.cell[q][q] for q in range(d))]
        refuse(not 0 < cross <= 2, "non_additivity must be above -1 and at most 1")
        refuse(not any(self.stable), "no sphere is stable")
        refuse(not contacts, "the file lists no contact")
        refuse(len(again) != 2 * len(contacts), "a contact is there twice, or of a sphere with itself")
        turned = any(row[c] for q, row in enumerate(self.cell) for c in range(q) if {q, c} & {*self.closed})
        refuse(turned or self.strict and self.closed, "an axis with walls leans, or the file is strict")
        refuse(not {*self.closed} <= {*range(d)} or len({*self.closed}) < len(self.closed), "'walls' names no axes")
        refuse(any(n[c] for *_, n in self.contacts for c in self.closed), "a contact reaches through a wall")
        widths = {self.cell[c][c] for c in range(min(d, self.round))}
        wrong = self.round and (len(widths) > 1 or not 2 <= self.round <= d or len(take("round", 1)) > 1)
        refuse(wrong, "a round wall is not one, about the first axes of a cell with equal edges")
        self.width, self.rim = self.cell[0][0], -2 - 2 * d  # of the round wall, and its partner of contacts
        self.walls = [-1 - 2 * c - side for c in flat for side in (0, 1)] + [self.rim] * (self.round > 0)
        no_sphere = min(i for i, *_ in self.contacts) < 0 or not ends <= {*range(len(spheres)), *self.walls}
        refuse(no_sphere, "a contact names a sphere that is not there")
        named -= {*range(len(contacts))} - at_walls
        refuse(named, "a tile or an implied contact names a contact that is not there")
        refuse(min(positive) <= 0, "a diameter, a cell edge, unit or gamma is not positive")
        other = self.strict or self.tiles or not all(self.stable) or (self.gamma, cross) != (1, 1)
        other = other or min(self.weights, default=1) <= 0 or self.round
        self.symmetries = [words for name, *words in lines if name == "symmetry"]
        refuse(self.symmetries and not self.weights, "a symmetry is not of a sum")
        refuse(self.weights and other, "a sum has positive weights, gamma 1, stable spheres, no tiles, strict, round")
        (self.size, self.per), self.cross = whole(self.ratio), cross**2
        first, spheres = self.stable.index(True), [i for i, yes in enumerate(self.stable) if yes]
        moving = [(i, k) for i in spheres for k in range(d) if i != first or k in self.closed]
        free = [at for at in moving if at not in self.pins]
        wrong = not len(moving) - len(free) == len(self.pins) == self.round * (self.round - 1) // 2
        refuse(wrong, "there is not one pin for each rotation, of stable spheres")
        self.place = {end: at for at, end in enumerate(free)}  # of component k of sphere i
        at = [len(free) + q * (q + 1) // 2 for q in range(d + 1)]  # the first unknown of each cell vector
        self.vectors, self.unknowns = (at[:-1], at[-1]) if self.strict else ([], at[0])  # their number without G
        self.sizes, self.unknowns = at[0], self.unknowns + len(self.weights)  # the first diameter
        self.inverse = self.unpacked(*packed[-1]) if packed else None
        self.edges = [Fraction(self.cell[q][q], self.one) for q, _ in enumerate(self.vectors)]
        self.gradient = {k + q: 1 / self.edges[q] for q, k in enumerate(self.vectors)}  # b
        self.gradient.update({self.sizes + i: -w / 2 for i, w in enumerate(self.weights)})

    def ends(self, name, numbers):
        """(i, j, n) of a contact; with a wall j is -1 - 2 axis - side."""
        if name == "contact":
            return numbers[0], numbers[1], tuple(numbers[2:])
        refuse(numbers[2] not in (0, 1) or numbers[1] < 0, "a wall is on side 0 or 1 of an axis")
        return numbers[0], -1 - 2 * numbers[1] - numbers[2], (0,) * self.dim

    def unpacked(self, e, data):
        """The inverse of the file: no more than a column of unknowns for each contact is unpacked."""
        stream, size = zlib.decompressobj(), array("i").itemsize * self.unknowns * len(self.contacts)
        flat = stream.decompress(base64.b64decode(data, validate=True), size + 1)
        refuse(len(flat) > size or not stream.eof, "the line 'inverse' has more numbers than the equations, or too few")
        return integer(e), array("i", flat)

    def vector(self, i, j, n):
        """r = x_i - x_j + n H, or twice the way from a wall, from the middle of a round one."""
        if j == self.rim:
            return [(2 * x - self.width) * (c < self.round) for c, x in enumerate(self.x[i])]
        if j < 0:
            axis, side = divmod(-1 - j, 2)
            return [2 * (x - side * self.cell[c][c]) * (c == axis) for c, x in enumerate(self.x[i])]
        a, b, cell = self.x[i], self.x[j], self.cell
        return [a[c] - b[c] + sum(n[q] * cell[q][c] for q in range(c, self.dim)) for c in range(self.dim)]

    def sigma(self, i, j):
        return (self.ratio[i] + self.ratio[i if j < 0 else j]) / 2

    def sigma2(self, i, j):
        """sigma^2, with sigma the mean of two diameters, times 1 + Delta where they differ. A wall has the sphere's."""
        j = i if j < 0 else j
        square = Fraction((self.size[i] + self.size[j]) ** 2, (2 * self.per) ** 2)
        return square if self.size[i] == self.size[j] else square * self.cross

    def equations(self, kept):
        """Of the contacts kept: F, -dF / dG or dg, and the columns of R as [(row, integer over one)]."""
        f, sigma2, columns = [], [], [[] for _ in range(self.unknowns)]
        for c, (i, j, n) in enumerate(self.contacts[k] for k in kept):
            loose = not self.stable[i] or j >= 0 and not self.stable[j]
            refuse(i == j or loose, f"images: contact {c} is not of two stable ones")
            r, square = self.vector(i, j, n), self.sigma2(i, j)
            f.append(Fraction(sum(map(mul, r, r)), self.one**2) - self.gamma * square)
            sigma2.append(2 * self.growth * square if self.round else square)
            if j == self.rim:
                room = Fraction(self.width, self.one) - self.growth * self.ratio[i]
                f[c], sigma2[c] = room**2 - f[c] - self.gamma * square, 2 * self.ratio[i] * room
            for end, times in ((i, 2), (j, -2)) if j >= 0 else ((i, -4 if j == self.rim else 4),):
                for k in range(self.dim):
                    if (end, k) in self.place:
                        columns[self.place[end, k]].append((c, times * r[k]))
                if self.weights:  # at a wall of the whole diameter
                    columns[self.sizes + end].append((c, -int(self.sigma(i, j) * self.one) * abs(times) // 2))
            for q, at in enumerate(self.vectors):
                for k in range(q + 1):
                    columns[at + k].append((c, 2 * n[q] * r[k]))
        return f, sigma2, columns

    def rounded(self, columns):
        """Entries in units of 2^-BITS, off by half a unit."""
        return [[(c, round(Fraction(v << BITS, self.one))) for c, v in column] for column in columns]

    def unbalanced(self, columns, forces):
        """R^T f - b."""
        forces, per = whole(forces)
        net = [Fraction(sum(v * forces[c] for c, v in column), self.one * per) for column in columns]
        return [v - self.gradient.get(k, 0) for k, v in enumerate(net)]

    def state(self, sigma2, columns, forces):
        """The forces, unless strict scaled to sum f sigma^2 = 1, and what they miss of it and of balance."""
        off = 0
        if not self.fixed:
            weight = sum(map(mul, sigma2, forces))
            forces = [Fraction(int(m * 2**90 / weight), 2**90) for m in forces]
            off = abs(1 - sum(map(mul, sigma2, forces)))
        return forces, off + sum(map(abs, self.unbalanced(columns, forces)))

    def reach(self, radius, gamma):
        """Spheres are open where a component of r is larger, and farther apart than SEEN. There is room for 4 radii,
        and strict for one more of each cell vector between them."""
        cell, way, most = self.cell, math.ceil(radius * self.one), [0] * self.dim
        refuse(self.weights and 16 * radius > min(self.ratio), "singular: a diameter may be 0")
        largest = max(self.ratio) ** 2 * max(1, self.cross)
        reach = math.isqrt(math.ceil(gamma * largest * (SEEN * self.one) ** 2)) + 1 + 4 * way
        for c in reversed(range(len(self.vectors))):  # most: |n| of spheres this near, in any cell within the radius
            refuse(cell[c][c] <= 2 * way, "gap: the cell is not larger than the radius")
            apart = max(x[c] for x in self.x) - min(x[c] for x in self.x)
            apart += sum(m * (abs(row[c]) + way) for m, row in zip(most, cell))
            most[c] = (reach + apart) // (cell[c][c] - way) + 1
        return reach + sum(most) * way

    def least_opening(self, radius, gamma, part=1):
        """Refuses if (3) fails for this part of gamma; the least left side over gamma sigma^2 below SEEN^2, or None."""
        reach, least, rows = self.reach(radius, gamma), None, list(enumerate(self.cell))
        many = math.prod(2 * reach // row[c] + 1 for c, row in rows if c not in self.closed)
        refuse(many > MOST_IMAGES, f"gap: the cell is so thin that a sphere meets more than {MOST_IMAGES} images")
        closed = {(j, i, tuple(-v for v in n)) for i, j, n in self.contacts} | set(self.contacts)
        closed |= {(i, i, (0,) * self.dim) for i in range(len(self.x))}
        for i in watched(range(len(self.x)), "pairs of spheres", 2):
            for j in [*self.walls, *range(i + 1)]:
                if j < 0:
                    near = [((0,) * self.dim, self.vector(i, j, ()))]
                    inside = sum(near[0][1]) * (1 if j % 2 else -1) > 4 * radius * self.one
                    inside = gamma * (self.ratio[i] * self.one) ** 2 < self.width**2 if j == self.rim else inside
                    refuse(not inside, f"gap: the centre of sphere {i} may be outside the walls")
                else:
                    near = [((), [a - b for a, b in zip(self.x[i], self.x[j])])]  # n and r, components within reach
                for c, row in reversed(rows) if j >= 0 else ():
                    some = [range(-((reach + r[c]) // row[c]), (reach - r[c]) // row[c] + 1) for _, r in near]
                    some = [range(abs(r[c]) <= reach) for _, r in near] if c in self.closed else some
                    near = [((m, *n), [a + m * b for a, b in zip(r, row)]) for k, (n, r) in zip(some, near) for m in k]
                for n, r in near:
                    if (i, j, n) in closed:
                        continue
                    both = self.stable[i] + self.stable[i if j < 0 else j]
                    moving = both * (i != j) + self.strict * sum(map(abs, n))
                    have, way = Fraction(sum(map(mul, r, r)), self.one**2), radius * moving
                    change = 2 * Fraction(sum(map(abs, r)), self.one) * way
                    if j == self.rim:
                        room = Fraction(self.width, self.one) - root(have + change + self.dim * way**2, 1)
                    have = room * abs(room) if j == self.rim else have - change
                    have /= (self.sigma(i, j) + radius) ** 2 if self.weights else gamma * self.sigma2(i, j)
                    refuse(have <= part, f"gap: spheres {i} and {j} are not open (image {n})")
                    least = min(least or have, have) if have < SEEN**2 else least
        return least


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


def hint(unknowns, j, count):
    """(e, the inverse of the columns j without its row of G, column by column in units of 2^e); `count`: rows of j. It
    is a hint: `bounds` bounds 1 - A J in integers."""
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


def inverse_of(s, j, count):
    """A without its row of G as (e, columns of 32-bit integers in units of 2^e), a hint; `count`: rows of J."""
    e, flat = s.hint = s.inverse or hint(s.unknowns, j, count)
    refuse(len(flat) != count * s.unknowns or e < -FARTHEST, "singular: the inverse does not fit the equations")
    return e, [flat[c * s.unknowns : (c + 1) * s.unknowns] for c in range(count)]


def bounds(s, f, columns, e, inverse, weights):
    """delta, eta and alpha of A's rows; column l of 1 - A J counts weights_l times. A's columns are long numbers of
    64-bit digits, so that A times a column costs as many products as this has entries."""
    n, large = len(inverse[0]), max(abs(v) for column in columns for _, v in column) >= 1 << 27
    refuse(e > BITS or large, "singular: entries are too large for the digits")  # 2^31 2^27 CHUNK = 2^62
    low = max([v.numerator.bit_length() - v.denominator.bit_length() - 24 for v in f if v], default=-600)
    short = [(c, round(v / TWO**low)) for c, v in enumerate(f)]  # 25 bits, off by half a unit
    long = lambda digits: int.from_bytes(array("Q", digits).tobytes(), sys.byteorder)
    bias = long([BIAS] * n)
    packed = [long([v + BIAS for v in column]) - bias for column in inverse]
    alpha = delta = [0] * n
    for column in inverse:
        alpha = list(map(add, alpha, map(abs, column)))
    for l, column in enumerate(watched(columns + [short], "columns of A J")):
        total = [0] * n
        for start in range(0, len(column), CHUNK):
            part = sum(packed[c] * v for c, v in column[start : start + CHUNK]) + bias
            total = [a + v - BIAS for a, v in zip(total, array("Q", part.to_bytes(8 * n, sys.byteorder)))]
        if l < n:
            total[l] -= 1 << (BITS - e)
        if l < len(columns):
            delta = [a + weights[l] * abs(v) for a, v in zip(delta, total)]
    # J was rounded: half a unit in each entry of a row. Of the cell it has d (d + 1) / 2, of a sum two, or one of G.
    width = (2 * s.dim + (s.dim * (s.dim + 1) // 2 if s.strict else 2 if s.weights else 1)) * max(weights)
    delta = [(2 * v + width * a) * TWO ** (e - BITS - 1) for v, a in zip(delta, alpha)]
    return delta, [(abs(v) + a) * TWO ** (e + low) for v, a in zip(total, alpha)], [a * TWO**e for a in alpha]


def radius_of(delta, eta, beta):
    """r with (1)."""
    room = (1 - delta) ** 2
    wrong = delta >= 1 or 4 * beta * eta >= room
    refuse(wrong, f"singular: delta {float(delta):.3g}, 4 beta eta {float(4 * beta * eta):.3g}")
    r = eta / (1 - delta) * (1 + 4 * beta * eta / room)
    wrong = eta + delta * r + beta * r * r > r or delta + 2 * beta * r >= 1  # (1)
    refuse(wrong, f"singular: radius {float(r):.3g}, beta {float(beta):.3g}")
    return r


def second_order(s):
    """D of Theorem A; by how many r a contact vector moves at most."""
    ways = 2 + s.strict * max(sum(map(abs, n)) for *_, n in s.contacts)
    return s.dim * ways**2 + bool(s.weights) + (max(s.sigma2(i, j) for i, j, _ in s.contacts) if s.round else 0), ways


def check(s):
    """Theorem A: what is proved."""
    every = range(len(s.contacts))
    if s.symmetries:
        return beside("jamproof_symmetric", "check", s)
    kept = beside("jamproof_implied", "kept_contacts", s) if s.tiles else every
    f, sigma2, columns = s.equations(kept)
    if len(kept) == len(every) and not any(f):
        return beside("jamproof_trapped", "closed", s, columns)
    count = s.unknowns + (not s.fixed)
    refuse(len(kept) != count, f"excess: {len(kept)} contacts, {count} unknowns" + ", too few" * (len(kept) < count))
    j = s.rounded(columns) + ([] if s.fixed else [[(c, round(-v * 2**BITS)) for c, v in enumerate(sigma2)]])
    e, inverse = inverse_of(s, j, count)
    delta, eta, alpha = bounds(s, f, j, e, inverse, [1] * count)
    row, delta_g = ([0], 0) if s.fixed else s.state(sigma2, columns, [s.row[c] for c in kept])
    eta_g, alpha_g = abs(sum(map(mul, f, row))), sum(map(abs, row))  # the row of G is minus a state of self-stress
    largest = max([max(max(map(abs, column)) for column in inverse) * TWO**e, *map(abs, row)])
    delta, eta, alpha = max(delta + [delta_g]), max(eta + [eta_g]), max(alpha + [alpha_g])
    wide, ways = second_order(s)
    beta = wide * alpha
    r = radius_of(delta, eta, beta)
    wrong = s.tiles and (ways * r) ** 2 * 10**12 > s.gamma * min(s.ratio) ** 2
    refuse(wrong, f"excess: radius {float(r):.3g} is too large for the angles of tiles")
    r_g = eta_g + delta_g * r + wide * alpha_g * r * r
    r_g *= 2 * s.growth + r_g if s.round else 1  # now of G
    # Forces on implied contacts are free: those of the file. The others balance them, with this A.
    _, sigma2, columns = s.equations(every) if s.tiles else (f, sigma2, columns)
    forces, off = s.state(sigma2, columns, s.force)
    size, least = sum(map(abs, forces)), min(forces)
    refuse(any(h <= r for h in s.edges), "singular: the cell is not larger than the radius")
    off += sum(r / (h * (h - r)) for h in s.edges)
    error, mean = (off + 2 * wide * size * r) / (1 - delta - 2 * beta * r) * largest, size / len(forces)  # (2)
    refuse(least <= error, f"force: the least is {float(least / mean):.3g}, its error {float(error / mean):.3g}")
    s.within = [r / h for h in s.edges] if s.strict else sum(s.weights) / 2 * r if s.weights else r_g / s.gamma
    sizes = {"sum_error": s.within * s.unit} if s.weights else {} if s.fixed else {"gamma_error": r_g / s.gamma}
    found = {"radius": r * s.unit, **sizes, "least_gap": gap(s.least_opening(r, s.gamma + r_g))}
    return {**found, "delta": delta, "least_force": least / mean, "force_error": error / mean}


def root(square, up=0):
    return Fraction(math.isqrt(math.floor(square * 4**400)) + up, 2**400)


def gap(square):
    """The root less one, from below; a thousandth if no pair was seen."""
    return root(square) - 1 if square else Fraction(1, 1000)


def shown(found):
    """As text of three digits, rounded so that each is a bound still."""
    ways = {name: decimal.ROUND_FLOOR if name in AT_LEAST else decimal.ROUND_CEILING for name in found}
    ratios = {name: map(decimal.Decimal, Fraction(value).as_integer_ratio()) for name, value in found.items()}
    digits = lambda name: decimal.Context(prec=3, rounding=ways[name], Emin=-307).divide(*ratios[name])
    return ", ".join(f"{name} {float(digits(name)):.3g}" for name in found)


def pi_between():
    """Two fractions about pi, 10^-120 apart: 16 atan(1/5) - 4 atan(1/239) (Machin)."""
    one, total = 10**130, 0
    for times, x in ((16, 5), (-4, 239)):
        power, k, sign = one // x, 0, times
        while power:
            total, power, k, sign = total + sign * (power // (2 * k + 1)), power // x**2, k + 1, -sign
    return Fraction(total - 10**10, one), Fraction(total + 10**10, one)


def ball(d):
    """The volume of a ball of diameter 1 over pi^(d//2)."""
    half = Fraction(2 ** ((d + 1) // 2), math.prod(range(d, 0, -2))) if d % 2 else Fraction(1, math.factorial(d // 2))
    return half / 2**d


def fraction(s):
    """The sum of radii, or the packing fraction, rattlers included, from below and above. The latter is pi^(d/2) / (2^d
    Gamma(d/2 + 1)) sum sigma^d / V.
    sigma^2 of a sphere is G ratio^2, G known to `within`; strict V is known to that part of each edge."""
    if s.weights:
        return [s.unit * (sum(map(mul, s.weights, s.ratio)) / 2 + sign * s.within) for sign in (-1, 1)]
    d = s.dim
    volume = Fraction(math.prod(s.cell[q][q] for q in range(d)), s.one**d) * ball(s.round)
    balls = sum(v**d for v in s.ratio) * ball(d)
    ends = []
    for up, pi in enumerate(pi_between()):
        change = Fraction(1)
        for v in s.within if s.strict else []:
            change *= 1 / (1 - v) if up else 1 / (1 + v)
        gamma = s.gamma if s.strict else s.gamma * (1 + (2 * up - 1) * s.within)
        spheres = balls * gamma ** (d // 2) * (root(gamma, up) if d % 2 else 1)
        ends.append(spheres * pi ** (d // 2 - s.round // 2) * change / volume)
    return ends


def summary(s):
    """What packing that is; the digits of phi are those that both bounds share."""
    low, high = (str(math.floor(v * 10**100)).zfill(101) for v in fraction(s)) if s.within is not None else ("", "")
    same = next((k for k, (a, b) in enumerate(zip(low, high)) if a != b), len(low))
    point, what, loose = len(low) - 100, "sum of radii" if s.weights else "phi", s.stable.count(False)
    digits = f", {what} = {low[:point]}.{low[point:same]}..." if same > point > 0 else ""
    return f"d = {s.dim}, N = {len(s.x)}, {len(s.contacts)} contacts, {loose} rattler{'s' * (loose != 1)}{digits}"


def conclusion(s):
    """Exit status and text."""
    strictly = " strictly" * s.strict
    try:
        return 0, f"proved{strictly}: {shown(check(s))}"
    except Missing as why:
        return 4, f"could not try: {why}"
    except (Refused, OverflowError, ZeroDivisionError) as why:
        text = f"not proved: {why}"
    if not text.startswith("not proved: excess") or s.weights:
        return 1, text
    try:
        return 3, f"trapped{strictly}: {shown(beside('jamproof_trapped', 'trapped', s))}; {text}"
    except Missing as why:
        return 4, f"could not try: {why}"
    except (Refused, OverflowError, ZeroDivisionError) as why:
        return 1, f"{text}; not trapped: {why}"


def complete(scene, out):
    """Writes the file again, with the inverse that was made for it, if any."""
    text = scene.text
    if scene.hint and not scene.inverse:
        e, flat = scene.hint
        text = text.rstrip("\n") + f"\ninverse {e} {base64.b64encode(zlib.compress(flat.tobytes())).decode()}\n"
    Path(out).write_text(text, encoding="ascii")


def main(path, out=None, xyz=None):
    try:
        scene = Scene(path)
    except (OSError, ValueError, LookupError, TypeError, OverflowError, MemoryError, zlib.error) as error:
        print(f"{path}: cannot be read: {error}")
        return 2
    try:
        status, text = conclusion(scene)
        print(text, summary(scene), sep="\n")
        same, compared = beside("jamproof_xyz", "compare", scene, xyz) if xyz else (True, None)
        if xyz:
            print(f"{xyz}: {compared}")
    except Missing as why:
        print(f"could not try: {why}")
        return 4
    except MemoryError:
        print("could not try: there is not enough memory")
        return 4
    try:
        if out:
            complete(scene, out)
    except OSError as error:
        print(f"{out}: cannot be written: {error}", file=sys.stderr)
        return 2
    return status if same else 2


if __name__ == "__main__":
    words = sys.argv[1:]
    at = words.index("--xyz") if "--xyz" in words else len(words)
    other, words = words[at + 1 : at + 2], words[:at] + words[at + 2 :]
    if len(words) not in (1, 2) or words[0].startswith("-") or at < len(sys.argv) - 1 and not other:
        print(__doc__)
        sys.exit(2)
    try:
        code = main(words[0], *words[1:], **({"xyz": other[0]} if other else {}))
        if sys.stdout:  # None where the descriptor is closed
            sys.stdout.flush()
    except OSError as error:  # of print: a traceback would end with 1, as if the proof had failed
        print(f"standard output: cannot be written: {error}", file=sys.stderr)
        sys.stdout, code = None, 2
    sys.exit(code)
