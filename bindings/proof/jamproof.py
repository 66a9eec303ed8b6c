#!/usr/bin/env python3
"""Checks a proof file of a jammed packing: jamproof.py FILE [OUT]

Proved is: exactly one packing within the printed radius touches exactly in the contacts that the file lists. All its
forces are positive, all other pairs are open, and its stable spheres are collectively jammed.

Integers of Python decide, nothing else. Forces and inverse are hints: bad ones lose the proof, they cannot make one. A
file without inverse gets one from numpy, or from floats here; OUT is then the file with this inverse. Where contacts are
more than unknowns, as in crystals, it is shown that the stable spheres are trapped: no motion without overlap takes one
farther than `inner`, and no packing as dense lies between `inner` and `outer`. Exit status: 0 proved, 1 not proved, 2 the
file cannot be read, 3 trapped but not proved. The guide's page "The theorems behind proofs" has them.

    F_c(x, G) = |x_i - x_j + n H|^2 - G sigma_c^2 = 0 for every contact c = (i, j, n);  J = F'

For any matrix A let delta_k >= sum_l |1 - A J|_kl, eta_k >= |A F|_k, alpha_k >= sum_c |A_kc|, beta = 4 d max alpha.
If eta + delta r + beta r^2 <= r and delta + 2 beta r < 1, then F has exactly one zero within r. In crystals F = 0 as
it stands; then R has full rank modulo a prime, and forces that balance exactly are those of the file or near them. In d = 2 the file may name implied
contacts. They are left out of F: the others, where closed, close them by the exact angles of triangles and parallelograms.

A file with the word strict fixes G. The lower triangle of H, the cell vectors, takes its place among the unknowns, and
proved is that the packing is strictly jammed: no motion and strain without overlap leaves the volume as small.
"""
import base64
import decimal
import math
import sys
import time
import zlib
from array import array
from fractions import Fraction
from operator import mul

BITS, CHUNK, BIAS, MOST_IMAGES = 24, 16, 1 << 62, 10**6  # of J; columns summed at once; makes 64-bit digits positive; of a pair
GAMMA, FORCE = -400, 120  # trapping: exponent of gamma, more binary digits of forces
WAIT = 10  # seconds between lines that say how far a long loop is
FINEST = 7  # trapping: units of ways are down to 2^-FINEST of the longest
OFF = Fraction(1, 1024)  # trapping: the file's gamma may be off by this part of it
HEADER = ("dim", "unit", "cell", "non_additivity", "gamma")
AT_LEAST = ("outer", "least_gap", "least_force")  # bounds from below; all others are bounds from above


class Refused(Exception):
    pass


def refuse(wrong, words, kind=Refused):
    if wrong:
        raise kind(words)


def number(word):
    """m 2^e as (m, e); "m p e,m p e" is a sum."""
    m, e = 0, 0
    for a, b in (map(int, part.split("p")) for part in word.split(",")):
        m, e = (m << (e - min(e, b))) + (a << (b - min(e, b))), min(e, b)
    return m, e


def scaled(pairs):
    """All numbers as integers over one power of two, and its exponent."""
    low = min(e for _, e in pairs)
    return [m << (e - low) for m, e in pairs], low


def fraction(m, e):
    return Fraction(m << max(e, 0), 1 << max(-e, 0))


def shifted(m, e, to):
    """m 2^e in units of 2^to, off by half a unit at most."""
    return m << (e - to) if e >= to else (m + (1 << (to - e - 1))) >> (to - e)


def watched(items, what, power=1):
    """The items; a line to stderr now and then says how far it is. The work until item k grows as k^power."""
    began = last = time.monotonic()
    for k, item in enumerate(items, 1):
        yield item
        if (now := time.monotonic()) - last > WAIT:
            last, left = now, (now - began) * ((len(items) / k) ** power - 1)
            print(f"{what}: {k} of {len(items)}, about {left:.0f} s more", file=sys.stderr, flush=True)


class Scene:
    """The exact numbers of a file: lengths in units of 2^k, ratios of diameters of 2^se, gamma g 2^ge."""

    def __init__(self, path):
        self.contacts, self.inverse, self.strict, spheres = [], None, False, []
        self.tiles, self.rows = [], {}  # walks round tiles and implied contacts, as they come; state of the kept alone
        with open(path, encoding="ascii") as file:
            lines = [line.split() for line in file if line.strip()]
        refuse(lines[:1] != [["jamproof", "1"]], "the first line is not 'jamproof 1'", ValueError)
        word = {name: rest for name, *rest in lines[1:] if name in HEADER}
        for name in HEADER:
            refuse((times := sum(line[0] == name for line in lines[1:])) != 1, f"the line '{name}' is there {times} times, not once", ValueError)
            refuse(name != "cell" and len(word[name]) != 1, f"the line '{name}' has not as many numbers as it must, one", ValueError)
        self.dim = d = int(word["dim"][0])
        refuse(d < 1, "dim is not 1 or more", ValueError)
        cell = [number(x) for x in word["cell"]]
        refuse(len(cell) != d * (d + 1) // 2, "the line 'cell' has not as many numbers as dim asks for", ValueError)
        self.unit = fraction(*number(word["unit"][0]))
        self.delta, (self.g, self.ge) = number(word["non_additivity"][0]), number(word["gamma"][0])
        refuse(not -1 < fraction(*self.delta) <= 1, "non_additivity must be above -1 and at most 1", ValueError)
        sizes = {"sphere": (2 + d,), "contact": (3 + d, 4 + d), "inverse": (2,), "strict": (0,)}
        for name, *rest in lines[1:]:
            refuse(len(rest) not in sizes.get(name, (len(rest),)), f"a line '{name}' has not as many numbers as dim asks for", ValueError)
            if name == "sphere":
                stable, *numbers = rest
                spheres.append((stable == "1", [number(x) for x in numbers]))
            elif name == "contact":
                i, j, *n = map(int, rest[: 2 + d])
                if len(rest) > 3 + d:
                    self.rows[len(self.contacts)] = number(rest[3 + d])
                self.contacts.append((i, j, tuple(n), number(rest[2 + d])))
            elif name in ("tile", "implied"):
                self.tiles.append((name, list(map(int, rest))))
            elif name == "inverse":
                self.inverse = int(rest[0]), array("i", zlib.decompress(base64.b64decode(rest[1])))
            elif name == "strict":
                self.strict = True
            elif name not in word:
                raise ValueError(f"unknown word {name}")
        self.stable, ratio = [stable for stable, _ in spheres], [numbers[0] for _, numbers in spheres]
        refuse(not any(self.stable), "no sphere is stable", ValueError)
        refuse(not self.contacts, "the file lists no contact", ValueError)
        refuse(any(not 0 <= i < len(ratio) for contact in self.contacts for i in contact[:2]), "a contact names a sphere that is not there", ValueError)
        refuse(any(not 0 <= c < len(self.contacts) for _, ring in self.tiles for c in ring), "a tile or an implied contact names a contact that is not there", ValueError)
        both, self.k = scaled(cell + [x for _, numbers in spheres for x in numbers[1:]])
        self.cell = [both[r * (r + 1) // 2 : (r + 1) * (r + 2) // 2] + [0] * (d - r - 1) for r in range(d)]
        self.x = [both[len(cell) + d * i : len(cell) + d * (i + 1)] for i in range(len(ratio))]
        self.ratio, self.se = scaled(ratio)
        refuse(min(self.ratio + [self.g, self.unit] + [self.cell[r][r] for r in range(d)]) <= 0, "a diameter, a cell edge, unit or gamma is not positive", ValueError)

    def vector(self, i, j, n):
        """x_i - x_j + n A."""
        a, b, cell = self.x[i], self.x[j], self.cell
        return [a[c] - b[c] + sum(n[q] * cell[q][c] for q in range(c, self.dim)) for c in range(self.dim)]

    def sigma2(self, i, j):
        """sigma^2 as (m, e)."""
        m, e = self.ratio[i] + self.ratio[j], self.se
        if self.delta[0] and self.ratio[i] != self.ratio[j]:
            one, low = scaled([(1, 0), self.delta])
            m, e = m * sum(one), e + low
        return m * m, 2 * e - 2


def equations(s, kept):
    """Of the contacts kept: F_c as (m, e), the rows of R as {unknown: integer} and the columns of J as [(contact, integer in 2^-BITS)]."""
    d, stable = s.dim, [i for i, yes in enumerate(s.stable) if yes]
    node = {i: k for k, i in enumerate(stable)}  # node 0 is pinned
    entries = [(q, v) for q in range(d) for v in range(q + 1)] if s.strict else []  # of the cell
    f, rows, columns = [], [], [[] for _ in range(d * (len(stable) - 1) + (len(entries) or 1))]
    s.diagonal = {len(columns) - len(entries) + k: q for k, (q, v) in enumerate(entries) if q == v}
    for c, (i, j, n, _) in enumerate(s.contacts[k] for k in kept):
        refuse(i == j or i not in node or j not in node, f"images: contact {c} is not one of two stable spheres")
        r, (m, e) = s.vector(i, j, n), s.sigma2(i, j)
        terms, low = scaled([(sum(v * v for v in r), 2 * s.k), (-s.g * m, s.ge + e)])
        f.append((sum(terms), low))
        ends = [(node[i], 2), (node[j], -2)]
        rows.append({d * (at - 1) + q: sign * r[q] for at, sign in ends if at for q in range(d) if r[q]})
        rows[-1].update({len(columns) - len(entries) + k: 2 * n[q] * r[v] for k, (q, v) in enumerate(entries) if n[q] * r[v]})
        for unknown, value in rows[-1].items():
            columns[unknown].append((c, shifted(value, s.k, -BITS)))
        if not s.strict:
            columns[-1].append((c, shifted(-m, e, -BITS)))
    return f, rows, columns


def plus(a, b, times=1):
    """Angles as {name: how often}; the name of 60 degrees is ()."""
    total = {name: a.get(name, 0) + times * b.get(name, 0) for name in {**a, **b}}
    total[()] = total.get((), 0) % 6
    return {name: times for name, times in total.items() if times}


def walk(s, ring):
    """The contacts of a walk as (contact, half turn or none, vector); where it leads, with the sum of images."""
    ends = [s.contacts[c][:2] for c in ring]
    at = start = ends[0][0] if ends[0][1] in ends[1] else ends[0][1]
    sides, image = [], [0] * s.dim
    for c, (i, j) in zip(ring, ends):
        sign = 1 if at == j else -1
        refuse(at not in (i, j), f"excess: contact {c} does not go on from sphere {at}")
        at, image = i if sign > 0 else j, [a + sign * b for a, b in zip(image, s.contacts[c][2])]
        sides.append((c, {(): (1 - sign) // 2 * 3}, [sign * v for v in s.vector(i, j, s.contacts[c][2])]))
    return sides, (start, at, tuple(image))


def relate(turned, p, q, angle):
    """The direction of q is that of p and an angle: {contact: (root, angle to it)}."""
    (a, x), (b, y) = (turned.setdefault(c[0], (c[0], {})) for c in (p, q))
    angle = plus(plus(plus(angle, p[1]), x), plus(q[1], y), -1)
    if a != b:
        turned.update({c: (a, plus(z, angle)) for c, (root, z) in turned.items() if root == b})


def lay(s, turned, ring, length):
    """The angles of a tile: a parallelogram, or a triangle with two equal sides."""
    sides, (start, end, image) = walk(s, ring)
    size, sine = len(sides), lambda u, v: (u[0] * v[1] - u[1] * v[0]) / math.sqrt((u[0] ** 2 + u[1] ** 2) * (v[0] ** 2 + v[1] ** 2))
    cross = [sine(u, v) * 1000.0 for (_, _, u), (_, _, v) in zip(sides, sides[1:] + sides[:1])]
    refuse(start != end or any(image) or not (min(cross) > 0.5 or max(cross) < -0.5), "excess: a tile is not closed and convex")  # the radius is far below such a turn
    if size == 4 and length[ring[0]] == length[ring[2]] and length[ring[1]] == length[ring[3]]:
        relate(turned, sides[0], sides[2], {(): 3}), relate(turned, sides[1], sides[3], {(): 3})
    elif size != 3:
        raise Refused("excess: a tile is no triangle and no parallelogram")
    for k in range(2 if size == 3 else 0):
        p, q, opposite = (length[ring[(k + m) % 3]] for m in range(3))
        if p == q:  # 180 degrees less the angle between them
            outer = {(): 2} if opposite == p else {(p, opposite): 2}
        elif opposite in (p, q):
            outer = {(): 3, (opposite, p if opposite == q else q): -1}
        else:
            raise Refused("excess: three unequal sides")
        relate(turned, sides[k], sides[k + 1], plus({}, outer, 1 if cross[0] > 0 else -1))


def kept_contacts(s):
    """The contacts but those that the others imply, each by a walk that sums to one vector of its length."""
    implied, turned = {ring[0] for word, ring in s.tiles if word == "implied"}, {}
    known = set(range(len(s.contacts))) - implied
    length = [fraction(*s.sigma2(i, j)) for i, j, _, _ in s.contacts] if s.tiles else []
    for word, ring in s.tiles:
        refuse(s.dim != 2 or not 3 <= len(ring) <= 4 or not known.issuperset(ring if word == "tile" else ring[1:]), f"excess: {word} {ring} does not rest on known contacts")
        if word == "tile":
            lay(s, turned, ring, length)
            continue
        (i, j, n, _), (sides, (start, end, image)), total = s.contacts[ring[0]], walk(s, ring[1:]), {}
        refuse((end, start, image) not in ((i, j, n), (j, i, tuple(-v for v in n))), f"excess: the walk of contact {ring[0]} leads elsewhere")
        for c, half, _ in sides:
            root, angle = turned.get(c, (c, {}))
            angle = plus(angle, half)
            key, turn = (root, length[c], frozenset((k, v) for k, v in angle.items() if k)), angle.get((), 0)
            a, b = ((1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1))[turn]
            total[key] = total.get(key, (0, 0))[0] + a, total.get(key, (0, 0))[1] + b
        left = [(key[1], a * a + a * b + b * b) for key, (a, b) in total.items() if a or b]
        refuse(left != [(length[ring[0]], 1)], f"excess: contact {ring[0]} does not follow")
        known.add(ring[0])
    return sorted(known - implied)


def rank(rows, p=(1 << 61) - 1):
    """Modulo a prime: at most the rank of the integers."""
    pivots = {}
    for row in rows:
        row = {k: v % p for k, v in row.items() if v % p}
        while row and min(row) in pivots:
            c = min(row)
            factor = row[c]
            for k, v in pivots[c].items():
                row[k] = (row.get(k, 0) - factor * v) % p
            row = {k: v for k, v in row.items() if v}
        if row:
            inverse = pow(row[min(row)], p - 2, p)
            pivots[min(row)] = {k: v * inverse % p for k, v in row.items()}
    return len(pivots)


def float_inverse(rows):
    """An inverse from the left, (J^T J)^-1 J^T where there are more rows than columns."""
    try:
        import numpy

        j = numpy.array(rows)
        return (numpy.linalg.inv(j) if len(rows) == len(rows[0]) else numpy.linalg.inv(j.T @ j) @ j.T).tolist()
    except ImportError:
        flat, n = list(zip(*rows)), len(rows[0])
        a = [
            [*row, *(float(k == i) for k in range(n))] if len(rows) == n else [*(sum(map(mul, row, b)) for b in flat), *row]
            for i, row in enumerate(rows if len(rows) == n else watched(flat, "rows of J^T J"))
        ]
        for c in watched(range(n), "columns of the inverse"):
            p = max(range(c, n), key=lambda r: abs(a[r][c]))
            a[c], a[p] = a[p], a[c]
            a[c] = [v / a[c][c] for v in a[c]]
            for r in range(n):
                if r != c and a[r][c]:
                    a[r] = [x - a[r][c] * y for x, y in zip(a[r], a[c])]
        return [row[n:] for row in a]


def inverse_of(s, columns, count, wanted):
    """The first `wanted` rows of a matrix A near the inverse of J from the left, as (e, columns of 32-bit integers in
    units of 2^e); `count`: rows of J. A hint."""
    if s.inverse:
        e, flat = s.inverse
        refuse(len(flat) != count * wanted, "singular: the inverse has not the size of the equations")
        return e, [flat[c * wanted : (c + 1) * wanted] for c in range(count)]
    rows = [[0.0] * len(columns) for _ in range(count)]
    for l, column in enumerate(columns):
        for c, value in column:
            rows[c][l] += value / 2.0**BITS
    try:
        a = float_inverse(rows)
        e = int(max(abs(v) for row in a for v in row)).bit_length() - 30
        return e, [array("i", (round(a[k][c] * 2.0**-e) for k in range(wanted))) for c in range(count)]
    except Exception as error:  # of a hint, whoever made it
        raise Refused(f"singular: {error}") from None


def bounds(s, f, columns, e, inverse, grown):
    """delta, eta and alpha of A's rows, where unknown k is measured in units of 1 / grown_k. (A J)_.l costs 2 z + 1
    products: A's columns are long integers."""
    rows, top = len(inverse[0]), max(grown)
    offset = int.from_bytes(array("Q", [BIAS] * rows).tobytes(), "little")
    packed = [int.from_bytes(array("Q", [v + BIAS for v in c]).tobytes(), "little") - offset for c in inverse]
    alpha, delta, eta = [0] * rows, [0] * rows, [0] * rows
    for column in inverse:
        alpha = [a + abs(v) for a, v in zip(alpha, column)]
    refuse(e > BITS or max(abs(v) for column in columns for _, v in column) >= 1 << 27, "singular: entries are too large for the digits")  # 2^31 2^27 CHUNK = 2^62
    for l, column in enumerate(watched(columns, "columns of A J")):
        total = [-(1 << (BITS - e)) * (k == l) for k in range(rows)]
        for start in range(0, len(column), CHUNK):
            part = sum(packed[c] * v for c, v in column[start : start + CHUNK]) + offset
            digits = array("Q", part.to_bytes(8 * rows, "little"))
            total = [a + v - BIAS for a, v in zip(total, digits)]
        delta = [a + abs(b) * (top // grown[l]) for a, b in zip(delta, total)]
    # J was rounded: half a unit in each entry of a row. Of the cell it has d (d + 1) / 2, or else one of G.
    width = 2 * s.dim + (s.dim * (s.dim + 1) // 2 if s.strict else 1)
    delta = [fraction((2 * v + width * a * top) * g, e - BITS - 1) / top for v, a, g in zip(delta, alpha, grown)]
    low = max(m.bit_length() + x for m, x in f) - 25
    for column, (m, x) in zip(inverse, f):
        short = shifted(m, x, low)
        eta = [a + b * short for a, b in zip(eta, column)]
    eta = [fraction((abs(v) + a) * g, e + low) for v, a, g in zip(eta, alpha, grown)]
    return delta, eta, [fraction(a, e) for a in alpha]


def unbalanced(s, rows, stress, low=0):
    """R^T f of whole forces in 2^low, exactly, in 2^(k + low); strict less the gradient of log V, 1 / h on the diagonal."""
    count = s.dim * (sum(s.stable) - 1) + (s.dim * (s.dim + 1) // 2 if s.strict else 0)
    net = [0] * count
    for row, m in zip(rows, stress):
        for unknown, v in row.items():
            net[unknown] += v * m
    for unknown, q in s.diagonal.items():
        net[unknown] -= fraction(1, -2 * s.k - low) / s.cell[q][q]
    return net


def stretch(s, contact):
    """|w_c| over the largest way of its ends, in each component: two spheres, and strict its image's cell vectors."""
    return 2 + s.strict * sum(map(abs, contact[2]))


def force_row(s, f, kept, rows, values):
    """The last row of A is minus the stress: that, and its delta, eta and alpha, in exact sums."""
    stress, low = scaled(values)
    sigma2 = [fraction(*s.sigma2(*s.contacts[c][:2])) for c in kept]
    weight = sum(a * m for a, m in zip(sigma2, stress))
    stress = [Fraction(int((m << 90) / weight), 1 << 90) for m in stress]  # sum stress sigma^2 = 1 but for rounding
    off = sum(map(abs, unbalanced(s, rows, [int(m * (1 << 90)) for m in stress])))
    delta = fraction(off, s.k - 90) + abs(1 - sum(a * m for a, m in zip(sigma2, stress)))
    return stress, delta, abs(sum(fraction(*v) * m for v, m in zip(f, stress))), sum(map(abs, stress))


def images(s, i, j, reach):
    """All n with components of x_i - x_j + n A within reach, a whole number of 2^k: in integers, so that none is missed."""

    def descend(c, x, n):
        if c < 0:
            yield n
            return
        for m in range(-((reach + x[c]) // s.cell[c][c]), (reach - x[c]) // s.cell[c][c] + 1):
            yield from descend(c - 1, [a + m * b for a, b in zip(x, s.cell[c])], (m,) + n)

    return descend(s.dim - 1, [a - b for a, b in zip(s.x[i], s.x[j])], ())


def reach_of(s, radius, gamma):
    """Beyond this, in 2^k, spheres are open: the largest contact distance and 4 radii, strict one more for each cell
    vector between them, rounded up."""
    widest, way = fraction(max(s.ratio), s.se) * (1 + abs(fraction(*s.delta))), math.ceil(radius / fraction(1, s.k))
    reach = math.isqrt(math.ceil(gamma * widest**2 / fraction(1, 2 * s.k))) + 1 + 4 * way
    most = [0] * s.dim  # |n| of two spheres this near, component after component, in any cell within the radius
    for c in reversed(range(s.dim if s.strict else 0)):
        refuse(s.cell[c][c] <= 2 * way, "gap: the cell is not larger than the radius")
        apart = max(x[c] for x in s.x) - min(x[c] for x in s.x) + sum(m * (abs(row[c]) + way) for m, row in zip(most, s.cell))
        most[c] = (reach + apart) // (s.cell[c][c] - way) + 1
    reach += sum(most) * way
    refuse(math.prod(2 * reach // s.cell[c][c] + 1 for c in range(s.dim)) > MOST_IMAGES, f"gap: the cell is so thin that a sphere meets more than {MOST_IMAGES} images")
    return reach


def least_opening(s, radius, gamma, part=1):
    """Every pair and image that is no contact stays open at a part of gamma; the least |r|^2 / (gamma sigma^2), or None."""
    closed, least = {c[:3] for c in s.contacts}, None
    closed |= {(j, i, tuple(-v for v in n)) for i, j, n in closed}
    reach = reach_of(s, radius, gamma)
    for i in watched(range(len(s.x)), "pairs of spheres", 2):
        for j in range(i + 1):
            for n in images(s, i, j, reach):
                if (i == j and not any(n)) or (i, j, n) in closed:
                    continue
                r, moving = s.vector(i, j, n), (s.stable[i] + s.stable[j]) * (i != j) + s.strict * sum(map(abs, n))
                have = fraction(sum(v * v for v in r), 2 * s.k)
                have -= 2 * fraction(sum(map(abs, r)), s.k) * radius * moving
                need = part * gamma * fraction(*s.sigma2(i, j))
                if have <= need:
                    raise Refused(f"gap: spheres {i} and {j} are not open (image {n})")
                least = min(least or part * have / need, part * have / need)
    return least


def closed(s, rows, columns):
    """F = 0 exactly, with any number of contacts. Forces that balance are those of the file, or next to them."""
    unknowns = len(columns) - (not s.strict)
    refuse(rank(rows) < unknowns, f"singular: the rank modulo a prime is below {unknowns}")
    stress, low = scaled([c[3] for c in s.contacts])
    net = [sum(row.get(k, 0) * m for row, m in zip(rows, stress)) for k in range(unknowns)]
    pressure = {net[k] * s.cell[q][q] for k, q in s.diagonal.items()} or {1}  # strict: in balance with an equal one on all axes
    refuse(min(stress) <= 0, "force: not all are positive")
    if any(net[k] for k in range(unknowns) if k not in s.diagonal) or len(pressure) > 1 or min(pressure) <= 0:
        # h = A^T y with (A R)^T y = R^T f is what they miss, and |y|_1 <= |R^T f|_1 / (1 - delta).
        s.hint = e, inverse = inverse_of(s, columns[:unknowns], len(rows), unknowns)
        delta = max(bounds(s, [(0, 0)] * len(rows), columns[:unknowns], e, inverse, [1] * unknowns)[0])
        off = sum(map(abs, unbalanced(s, rows, stress, low))) * fraction(1, s.k) * fraction(max(max(map(abs, v)) for v in inverse), e)
        refuse(off >= (1 - delta) * min(stress), f"force: the least is {float(fraction(min(stress), low)):.3g}, what balances them {float(off * fraction(1, low)):.3g}")
    least = least_opening(s, 0, fraction(s.g, s.ge))
    return {"radius": 0.0, "gamma_error": 0.0, "least_gap": float(least) ** 0.5 - 1.0 if least else 1e-3}


def check(s):
    """What was proved; Refused where nothing was."""
    every = range(len(s.contacts))
    kept = kept_contacts(s)
    f, rows, columns = equations(s, kept)
    if len(kept) == len(every) and kept and not any(m for m, _ in f):
        return closed(s, rows, columns)
    refuse(len(kept) != len(columns), f"excess: {len(kept)} contacts, {len(columns)} unknowns" + ", too few" * (len(kept) < len(columns)))
    unknowns = len(columns) - (not s.strict)
    s.hint = e, inverse = inverse_of(s, columns, len(columns), unknowns)
    delta, eta, alpha = bounds(s, f, columns, e, inverse, [1] * len(columns))
    largest, square = fraction(max(max(map(abs, column)) for column in inverse), e), s.dim * max(stretch(s, c) for c in s.contacts) ** 2
    if not s.strict:
        row, delta_g, eta_g, alpha_g = force_row(s, f, kept, rows, [s.rows.get(c, s.contacts[c][3]) for c in kept])
        delta, eta, alpha, largest = delta + [delta_g], eta + [eta_g], alpha + [alpha_g], max([largest] + [abs(v) for v in row])
    delta, eta, beta = max(delta), max(eta), square * max(alpha)
    refuse(delta >= 1 or 4 * beta * eta >= (1 - delta) ** 2, f"singular: delta {float(delta):.3g}, 4 beta eta {float(4 * beta * eta):.3g}")
    r = eta / (1 - delta) * (1 + 4 * beta * eta / (1 - delta) ** 2)
    refuse(eta + delta * r + beta * r * r > r or delta + 2 * beta * r >= 1, f"singular: radius {float(r):.3g}, beta {float(beta):.3g}")
    refuse(s.tiles and r**2 * 10**12 > fraction(s.g, s.ge) * fraction(min(s.ratio), s.se) ** 2, f"excess: radius {float(r):.3g} is too large for the angles of tiles")
    r_g = 0 if s.strict else eta_g + delta_g * r + square * alpha_g * r * r
    # The forces on implied contacts are free; the others solve J^T f = the rest, within the inverse times what is left.
    if s.strict:
        values, low = scaled([c[3] for c in s.contacts])
        edges = [fraction(s.cell[q][q], s.k) for q in range(s.dim)]
        refuse(min(edges) <= r, "singular: the cell is not larger than the radius")
        off = sum(map(abs, unbalanced(s, rows, values, low))) * fraction(1, s.k + low)
        off += sum(r / (h * (h - r)) for h in edges)  # what the way changes of the gradient of log V
        stress = [fraction(m, low) for m in values]
    else:
        stress, off, _, _ = force_row(s, [], every, equations(s, every)[1] if s.tiles else rows, [c[3] for c in s.contacts])
    size = sum(map(abs, stress))
    error = (off + 2 * square * size * r) / (1 - delta - 2 * beta * r) * largest
    mean, gamma = size / len(stress), fraction(s.g, s.ge)
    refuse(min(stress) <= error, f"force: the least is {float(min(stress) / mean):.3g}, its error {float(error / mean):.3g}")
    least = least_opening(s, r, gamma + r_g)
    found = {"radius": r * s.unit, **({} if s.strict else {"gamma_error": r_g / gamma}), "least_gap": float(least) ** 0.5 - 1.0 if least else 1e-3}
    found.update(delta=delta, least_force=min(stress) / mean, force_error=error / mean)
    return outward(found)


def trapped(s):
    """Of any network with positive forces: inner and outer of the theorem "Trapped", and the least gap."""
    gamma, every = fraction(s.g, s.ge), range(len(s.contacts))
    size = [fraction(sum(v * v for v in s.vector(i, j, n)), 2 * s.k) / fraction(*s.sigma2(i, j)) for i, j, n, _ in s.contacts]
    least = least_opening(s, 0, min(size), Fraction(1, 2)) or 2  # pairs without force may be closed too
    own = min(size) * min(1, least)
    refuse(abs(gamma - own) > OFF * gamma, f"gamma: without overlap it is {float(own):.6g}, not that of the file")
    # The smaller of both, as spheres of a smaller gamma have more room. What is shown of it is true of a larger one.
    s.g, s.ge = math.floor(min(own, gamma) / fraction(1, GAMMA)), GAMMA  # no pair overlaps: F >= 0
    opening, rows, columns = equations(s, every)
    columns = columns if s.strict else columns[:-1]
    s.hint = e, inverse = inverse_of(s, columns, len(every), len(columns))
    stress, low = scaled([c[3] for c in s.contacts])
    stress, low = [m << FORCE for m in stress], low - FORCE  # a step of Newton balances them to these digits
    rest = list(map(round, unbalanced(s, rows, stress, low)))
    stress = [m - shifted(sum(map(mul, column, rest)), s.k + e, 0) for m, column in zip(stress, inverse)]
    refuse(min(stress) <= 0, "force: not all are positive")
    rest = sum(map(abs, unbalanced(s, rows, stress, low))) * fraction(1, s.k + low)
    opened = sum(fraction(*v) * m for v, m in zip(opening, stress)) * fraction(1, low)
    # Strict: log V falls by no more than the sum of (way / edge)^2 below its gradient, for ways up to half an edge.
    edges = [fraction(s.cell[q][q], s.k) for q in s.diagonal.values()]
    for grown in [[1] * len(columns)] + ([] if s.strict else [loosely_held(s, columns, inverse, stress)]):
        delta, eta, _ = map(max, bounds(s, opening, columns, e, inverse, grown))
        square, alpha, largest = 0, [0] * len(columns), 0
        unit = [Fraction(1, g) for g in [max(grown)] * s.dim + grown][:: s.dim]  # of each stable sphere; the pinned one is at rest
        node = {i: k for k, i in enumerate(i for i, yes in enumerate(s.stable) if yes)}
        for contact, column, m in zip(s.contacts, inverse, stress):
            wide = s.dim * (unit[node[contact[0]]] + unit[node[contact[1]]] + stretch(s, contact) - 2) ** 2  # |w|^2 of a motion of length 1
            square, column = square + wide * m, [abs(v) * g for v, g in zip(column, grown)]
            largest = max(largest, Fraction(max(column), m))
            scale = int(wide * max(grown) ** 2)
            alpha = [a + scale * v for a, v in zip(alpha, column)]
        largest, square = largest * fraction(1, e - low), square * fraction(1, low) + sum(1 / h**2 for h in edges)
        left, constant = 1 - delta - largest * rest, largest * opened + eta
        second = largest * square + fraction(max(alpha), e) / max(grown) ** 2
        if left > 0 and 4 * constant * second < left**2:
            break
    else:
        raise Refused(f"singular: left {float(left):.3g}, 4 a0 a2 {float(4 * constant * second):.3g}")
    inner = 2 * constant / left  # the gamma of the densest packing within inner lies at most above / weight above s.g:
    above = opened + rest * inner + square * inner**2
    weight = sum(fraction(*s.sigma2(*c[:2])) * m for c, m in zip(s.contacts, stress)) * fraction(1, low)
    error = (abs(gamma - fraction(s.g, s.ge)) + (0 if s.strict else above / weight)) / gamma
    outer = min([left / (2 * second * max(grown))] + [h / 2 for h in edges])
    refuse(s.strict and inner >= outer, f"singular: inner {float(inner):.3g} is not below outer {float(outer):.3g}")
    found = {"inner": inner * s.unit, **({"outer": outer * s.unit} if outer > inner else {})}
    found.update({"volume_error": above} if s.strict else {}, gamma_error=error, least_gap=max(0.0, float(least * min(size) / gamma) ** 0.5 - 1.0), delta=delta)
    return outward(found)


def loosely_held(s, columns, inverse, stress):
    """How much shorter than of the sphere that is held least the ways of others are, as powers of two: a hint."""
    way = [0.0] * len(columns)
    for column, m in zip(inverse, stress):
        part = 1.0 / m
        way = [max(a, abs(v) * part) for a, v in zip(way, column)]
    way = [max(way[k : k + s.dim]) for k in range(0, len(way), s.dim)]
    return [1 << min(FINEST, int(math.log2(max(way) / max(a, 1e-300)))) for a in way for _ in range(s.dim)]


def outward(found):
    """As floats that are bounds still."""
    floats = {}
    for name, value in found.items():
        near, sign = float(value), -1 if name in AT_LEAST else 1
        floats[name] = near if sign * near >= sign * value else math.nextafter(near, sign * math.inf)
    return floats


def shown(found):
    """As text of three digits, rounded so that each is a bound still."""
    down, up = (decimal.Context(prec=3, rounding=way) for way in (decimal.ROUND_FLOOR, decimal.ROUND_CEILING))
    digits = lambda name, value: (down if name in AT_LEAST else up).create_decimal_from_float(value)
    return ", ".join(f"{name} {float(digits(name, value)):.3g}" for name, value in found.items())


def conclusion(s):
    """Exit status and text."""
    try:
        return 0, ("proved strictly: " if s.strict else "proved: ") + shown(check(s))
    except (Refused, OverflowError, ZeroDivisionError) as why:
        if not str(why).startswith("excess"):
            return 1, f"not proved: {why}"
        text = f"not proved: {why}"
    try:
        return 3, f"trapped{' strictly' if s.strict else ''}: {shown(trapped(s))}; {text}"
    except (Refused, OverflowError, ZeroDivisionError) as why:
        return 1, f"{text}; not trapped: {why}"


def main(path, out=None):
    try:
        scene = Scene(path)
    except (OSError, ValueError, LookupError, TypeError, zlib.error) as error:
        print(f"{path}: cannot be read: {error}")
        return 2
    status, text = conclusion(scene)
    print(text)
    if out and hasattr(scene, "hint"):
        e, columns = scene.hint
        with open(path, encoding="ascii") as old, open(out, "w", encoding="ascii") as new:
            new.write(old.read() + f"inverse {e} ")
            new.write(base64.b64encode(zlib.compress(b"".join(c.tobytes() for c in columns))).decode() + "\n")
    return status


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or sys.argv[1].startswith("-"):
        print(__doc__)
        sys.exit(2)
    sys.exit(main(*sys.argv[1:]))
