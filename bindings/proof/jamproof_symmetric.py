"""Largest sums of radii with more contacts than unknowns, which a symmetry closes. jamproof.py loads this file.

A line of the file for each generator of a group, P a signed permutation of the axes about the middle of the cell:

    symmetry a1 .. ad p1 .. pn    component k of P x is component |a_k| of x, mirrored if a_k < 0; sphere i goes to p_i

It is tested in integers that P keeps the cell, that x_p(i) = P x_i, that diameters and weights are equal, and that
contacts go to contacts. Displacements with the symmetry have one unknown for each orbit of coordinates and diameters,
and F is equal on each orbit of contacts. If there are as many of both, Theorem A with these unknowns, in the same
norm, gives a zero with the symmetry, where all contacts are closed. Forces phi on orbits that balance there, over the
number of contacts of each, balance all displacements: what they leave has the symmetry, and so it is 0 if it is 0 on
displacements with the symmetry. The zero is a strict maximum if phi > 0 and J has full column rank: |1 - B J| <=
delta' + 2 D |B| r < 1 for a matrix B.
"""
import copy
from fractions import Fraction

from jamproof import TWO, bounds, gap, integer, inverse_of, radius_of, refuse, second_order


class Orbits:
    """Union of items that go to each other, with a sign. Items that go to minus themselves are 0."""

    def __init__(self, count):
        self.up, self.sign, self.zero = list(range(count)), [1] * count, set()

    def root(self, k):
        sign = 1
        while self.up[k] != k:
            k, sign = self.up[k], sign * self.sign[k]
        return k, sign

    def join(self, a, b, sign):
        """Item b is sign times item a."""
        (p, x), (q, y) = self.root(a), self.root(b)
        if p == q:
            self.zero |= {p} if sign * x != y else set()
            return
        self.up[q], self.sign[q] = p, sign * x * y
        self.zero |= {p} & self.zero | ({p} if q in self.zero else set())

    def numbered(self):
        """(number of the orbit, sign) of each item, None of those that are 0; how many orbits."""
        roots = [self.root(k) for k in range(len(self.up))]
        zero = {self.root(k)[0] for k in self.zero}
        names = {r: at for at, r in enumerate(sorted({r for r, _ in roots} - zero))}
        return [(names[r], sign) if r in names else None for r, sign in roots], len(names)


def moved(s, words):
    """The generator of a line, tested on cell, centres, diameters, weights and contacts: axes, signs, spheres."""
    d, count, numbers = s.dim, len(s.x), list(map(integer, words))
    refuse(len(numbers) != d + count, "excess: a symmetry has not as many numbers as it must")
    axes, signs, to = [abs(a) - 1 for a in numbers[:d]], [1 if a > 0 else -1 for a in numbers[:d]], numbers[d:]
    wrong = sorted(axes) != list(range(d)) or sorted(to) != list(range(count)) or sorted(s.closed) != list(range(d))
    refuse(wrong, "excess: a symmetry is no permutation, or not between walls on all axes")
    edge = [s.cell[c][c] for c in range(d)]
    refuse(any(edge[k] != edge[a] for k, a in enumerate(axes)), "excess: a symmetry changes the cell")
    for i, p in enumerate(to):
        image = [s.x[i][a] if sign > 0 else edge[a] - s.x[i][a] for a, sign in zip(axes, signs)]
        same = image == s.x[p] and s.ratio[i] == s.ratio[p] and s.weights[i] == s.weights[p]
        refuse(not same, f"excess: sphere {i} does not go to sphere {p}")
    return axes, signs, to


def image_of(contact, axes, signs, to):
    """The contact to which one goes, spheres in order."""
    i, j, n = contact
    if j >= 0:
        return (*sorted((to[i], to[j])), n)
    axis, side = divmod(-1 - j, 2)
    k = axes.index(axis)
    return to[i], -1 - 2 * k - (side if signs[k] > 0 else 1 - side), n


def check(s):
    """What is proved of a sum with symmetries."""
    d, size = s.dim, 2 * s.dim + 1
    unknowns, contacts = Orbits(s.unknowns), Orbits(len(s.contacts))
    at = {(*sorted((i, j)), n) if j >= 0 else (i, j, n): c for c, (i, j, n) in enumerate(s.contacts)}
    for words in s.symmetries:
        axes, signs, to = moved(s, words)
        for i, p in enumerate(to):
            unknowns.join(s.sizes + i, s.sizes + p, 1)
            for k in range(d):
                unknowns.join(s.place[i, axes[k]], s.place[p, k], signs[k])
        for contact, c in at.items():
            image = image_of(contact, axes, signs, to)
            refuse(image not in at, f"excess: contact {c} does not go to a contact")
            contacts.join(c, at[image], 1)
    (place, count), (orbit, rows) = unknowns.numbered(), contacts.numbered()
    refuse(rows != count, f"excess: {rows} orbits of contacts, {count} of unknowns")
    first, many = {}, [0] * rows
    for c, (at_row, _) in enumerate(orbit):
        first.setdefault(at_row, c)
        many[at_row] += 1
    f, _, columns = s.equations(range(len(s.contacts)))
    folded, b = [{} for _ in range(count)], [Fraction(0)] * count
    for unknown, column in enumerate(columns):
        if place[unknown]:
            z, sign = place[unknown]
            b[z] += sign * s.gradient.get(unknown, 0)
            for c, v in column:
                if first[orbit[c][0]] == c:
                    folded[z][orbit[c][0]] = folded[z].get(orbit[c][0], 0) + sign * v
    folded = [sorted(column.items()) for column in folded]
    part = copy.copy(s)
    part.unknowns, part.inverse = count, None
    j, (wide, _) = s.rounded(folded), second_order(s)
    e, inverse = inverse_of(part, j, count)
    delta, eta, alpha = map(max, bounds(s, [f[first[k]] for k in range(rows)], j, e, inverse, [1] * count))
    beta = wide * alpha
    r = radius_of(delta, eta, beta)
    part.unknowns, full = s.unknowns, s.rounded(columns)
    other, left = inverse_of(part, full, len(s.contacts))
    rest, _, large = map(max, bounds(s, [0] * len(s.contacts), full, other, left, [1] * s.unknowns))
    refuse(rest + 2 * wide * large * r >= 1, f"singular: of all equations delta is {float(rest):.3g}")
    forces = [s.force[first[k]] * many[k] for k in range(rows)]
    off = sum(abs(Fraction(sum(v * forces[c] for c, v in column)) / s.one - b[z]) for z, column in enumerate(folded))
    largest = max(max(map(abs, column)) for column in inverse) * TWO**e
    error, total = (off + 2 * wide * sum(map(abs, forces)) * r) / (1 - delta - 2 * beta * r) * largest, sum(s.force)
    least, mean = min(v - error for v in forces), total / len(s.force)
    refuse(least <= 0, f"force: the least is {float((least + error) / mean):.3g}, its error {float(error / mean):.3g}")
    s.within = sum(s.weights) / 2 * r
    weakest = min((v - error) / m for v, m in zip(forces, many)) / mean
    found = {"radius": r * s.unit, "sum_error": s.within * s.unit, "least_gap": gap(s.least_opening(r, s.gamma))}
    return {**found, "delta": delta, "least_force": weakest, "force_error": error / mean}
