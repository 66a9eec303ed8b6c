"""Decimals of a largest sum of radii with a proved radius: theorem A of the guide's page on proofs with radii as unknowns.

Unknown are all centres and radii, but those of the first centre along axes without walls. Of a pair F = |r_ij|^2 - (R_i + R_j)^2 is 0, of a wall F = 4 distance^2 -
4 R_i^2, so that a simple maximum has as many equations as unknowns. F is quadratic: F(u + v) = F(u) + J v + Q(v), and |Q| <=
4 d |v|^2 in maximum norms. With A, delta, eta and beta as in digits.py exactly one zero of F lies within the radius. There
the forces f J = -w are unique; where they are all positive and every other gap is open, it is a strict local maximum of
sum w_i R_i. These are the equations of a proof file, whose unknowns are diameters.

With more contacts than unknowns the same is done with the orbits of a symmetry (_symmetry.py), if these are as many.
"""
from __future__ import annotations

import math
from decimal import Decimal, localcontext
from fractions import Fraction
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ._api.arrays import Array
from .digits import _bits, _bounds, _decimal, _images, _integers, _inverse, _number, _proved_radius, _solved
from ._formats.replacing import replacing
from ._symmetry import Fold, square_fold
from .errors import StateError
from .system import System


class Proved(NamedTuple):
    """A strict local maximum. Nothing in it is farther from the exact one than the radius beside it."""

    value: Decimal  #: the sum of w_i R_i
    value_radius: Decimal
    positions: Array  #: (n, d) of Decimal
    radii: Array  #: (n,) of Decimal
    radius: Decimal  #: of each of these numbers
    least_force: float  #: proved lower bound of the forces on the equations, > 0
    steps: int  #: of Newton's method


class _Rows:
    """F and its derivative, with numbers of `bits` bits behind the point."""

    def __init__(self, system: System, bits: int, weights: list[Fraction]):
        info = system.info
        self.d, self.n, self.bits = info.dim, info.n, bits
        if info.container or info.model or info.non_additivity:
            raise StateError("prove: only additive spheres in periodic cells and between flat walls have a proof of their sum")
        self.unit = 2.0 ** round(math.log2(info.box))  # an exact factor
        self.cell = _integers(system.cell / self.unit, bits)
        self.edge = np.diag(self.cell)
        self.open = [c for c in range(self.d) if not info.walls >> c & 1]
        walls = system.walls() if info.walls else None
        self.walls = [(int(axis), bool(side)) for axis, side in zip(walls.axis, walls.side)] if walls is not None else []
        self.pairs = np.asarray(system.contacts.pairs)
        self.images = [tuple(map(int, n)) for n in _images(system)]
        self.size = self.n * (self.d + 1)
        more = len(self.pairs) - self.size + len(self.open)
        if more > 0 and system.report.strictly_jammed.name == "YES":  # maximise_radii(strain="free") alone says so
            raise StateError(f"prove: a maximum of a free cell has {more} contacts more than a fixed cell has unknowns: only those of fixed cells have a proof")
        if any(i == j for i, j in self.pairs):
            raise StateError("prove: a sphere touches its own image")
        fold = self._folded(system, weights)
        if len(fold.rows) != len(fold.unknowns):
            raise StateError(f"prove: {len(self.pairs)} contacts and {self.size - len(self.open)} unknowns: only simple maxima are proved, "
                             "which have as many, or as many orbits under a symmetry, and no radius at a bound")
        self.fold = fold
        self.u = np.concatenate([_integers(system.positions / self.unit, bits), _integers(system.diameters / (2 * self.unit), bits)[:, None]], 1)

    def _folded(self, system: System, weights: list[Fraction]) -> Fold:
        """Of no symmetry where an axis has no walls."""
        plain = Fold([], np.arange(self.size), np.ones(self.size, int), np.arange(len(self.pairs)))
        plain.sign[self.open] = 0
        ends = [(int(i), int(j)) for i, j in self.pairs]
        found = None if self.open else square_fold(
            system.positions, system.diameters / 2, weights, np.diag(system.cell), ends, self.walls)  # fmt: skip
        return found or plain

    def separation(self, i: int, j: int, n: Any) -> Array:
        return self.u[i][: self.d] - self.u[j][: self.d] + np.array(n, dtype=object) @ self.cell

    def distance(self, i: int, wall: int) -> int:
        axis, far = self.walls[-1 - wall]
        return int(self.edge[axis] - self.u[i][axis] if far else self.u[i][axis])

    def gap(self, k: int) -> int:
        """F of a contact."""
        d, (i, j) = self.d, self.pairs[k]
        if j < 0:
            return 4 * (self.distance(i, j) ** 2 - int(self.u[i][d]) ** 2) >> self.bits
        r = self.separation(i, j, self.images[k])
        return int((r * r).sum() - (self.u[i][d] + self.u[j][d]) ** 2) >> self.bits

    def residuals(self) -> Array:
        return np.array([self.gap(int(k)) for k in self.fold.rows], dtype=object)

    def keep_symmetry(self) -> None:
        """Centres and radii become those of the first of their orbit."""
        d, flat = self.d, self.u.ravel()
        for at, (first, sign) in enumerate(zip(self.fold.first, self.fold.sign)):
            if sign == 0 and self.fold.generators:
                flat[at] = self.edge[at % (d + 1)] // 2
            elif sign and first != at:
                flat[at] = flat[first] if sign > 0 else self.edge[at % (d + 1)] - flat[first]
        self.u = flat.reshape(self.n, d + 1)

    def derivative(self) -> Array:
        d, found = self.d, np.zeros((len(self.pairs), self.size))
        for k, (i, j) in enumerate(self.pairs):
            at = int(i) * (d + 1)
            if j < 0:
                axis, far = self.walls[-1 - int(j)]
                found[k, at + axis] = 8 * _number(self.distance(i, j), self.bits) * (-1.0 if far else 1.0)
                found[k, at + d] = -8 * _number(self.u[i][d], self.bits)
                continue
            to, r = int(j) * (d + 1), self.separation(i, j, self.images[k])
            for c in range(d):
                found[k, at + c] = 2 * _number(r[c], self.bits)
                found[k, to + c] = -found[k, at + c]
            found[k, at + d] = found[k, to + d] = -2 * _number(self.u[i][d] + self.u[j][d], self.bits)
        return found

    def move(self, step: Array) -> None:
        """u less a step."""
        flat = self.u.ravel()
        flat[self.fold.unknowns] -= step
        self.u = flat.reshape(self.n, self.d + 1)
        self.keep_symmetry()

    def closest(self, r: int) -> str | None:
        """What may overlap, or be no sphere, where each number is within r; None: nothing."""
        touching = {(int(i), int(j), n) for (i, j), n in zip(self.pairs, self.images)}
        touching |= {(j, i, tuple(-v for v in n)) for i, j, n in touching}
        d, none = self.d, (0,) * self.d
        for i in range(self.n):
            if int(self.u[i][d]) <= r:
                return f"the radius of sphere {i} may be 0"
            if any(self.distance(i, -1 - w) <= r for w in range(len(self.walls))):
                return f"the centre of sphere {i} may be outside the walls"
            for w in range(len(self.walls)):
                if (i, -1 - w, none) not in touching and self.distance(i, -1 - w) - int(self.u[i][d]) <= 2 * r:
                    return f"sphere {i} may touch wall {w}"
            for j in range(i + 1):
                sides = int(self.u[i][d] + self.u[j][d]) + 2 * r + 2 * d * r  # |r_ij| changes by 2 sqrt(d) r at most
                for n in self.near(i, j, sides):
                    apart = self.separation(i, j, n)
                    if (i, j, n) not in touching and (i, n) != (j, none) and int((apart * apart).sum()) <= sides * sides:
                        return f"spheres {j} and {i} may touch"
        return None

    def near(self, i: int, j: int, reach: int) -> list[tuple[int, ...]]:
        """All images in which no component of the separation is larger: cell vectors are a lower triangle."""
        found: list[tuple[tuple[int, ...], Array]] = [((), self.separation(i, j, (0,) * self.d))]
        for c in reversed(range(self.d)):
            h = int(self.edge[c])
            some = [range(-((reach + int(r[c])) // h), (reach - int(r[c])) // h + 1) if c in self.open else range(1) for _, r in found]
            found = [((m, *n), r + m * self.cell[c]) for ms, (n, r) in zip(some, found) for m in ms]
        return [n for n, _ in found]


    def file(self, weights: list[Fraction], forces: Array) -> str:
        """A proof file: bindings/docs/proof.md, "The file"."""

        def numbers(values: Array, less: int) -> str:
            return " ".join(f"{int(v)}p{less - self.bits}" for v in values)

        d = self.d
        cell = " ".join(numbers(self.cell[q][: q + 1], 0) for q in range(d))
        lines = ["jamproof 1", "sum " + " ".join(map(_binary, weights)), f"dim {d}", "unit " + _binary(Fraction(self.unit)), "cell " + cell]
        lines += ["non_additivity 0p0", "gamma 1p0"]
        lines += ["walls " + " ".join(str(c) for c in range(d) if c not in self.open)] * (len(self.open) < d)
        lines += ["symmetry " + g.words() for g in self.fold.generators]
        lines += [f"sphere 1 {numbers(row[d:], 1)} {numbers(row[:d], 0)}" for row in self.u]
        for (i, j), n, force in zip(self.pairs, self.images, forces):
            axis, far = self.walls[-1 - j] if j < 0 else (0, False)
            ends = f"wall {i} {axis} {far:d}" if j < 0 else f"contact {i} {j} " + " ".join(map(str, n))
            lines.append(f"{ends} {_binary(Fraction(float(force)))}")
        return "\n".join(lines) + "\n"


def _binary(value: Fraction) -> str:
    """A double as m p e."""
    return f"{value.numerator}p{1 - value.denominator.bit_length()}"


def _exact(value: Fraction) -> Decimal:
    return Decimal(value.numerator) / Decimal(value.denominator)


def prove_sum(system: System, digits: int, weights: Any, path: Any) -> Proved:
    """See jam.radii.prove."""
    bits = _bits(digits)
    n, d = system.n, system.dim
    w = [Fraction(1)] * n if weights is None else [Fraction(float(v)) for v in weights]
    rows = _Rows(system, bits, w)
    rows.keep_symmetry()
    whole, kept, fold = rows.fold.matrix(), rows.fold.rows, rows.fold
    inverse = _inverse("prove", rows.derivative()[kept] @ whole)
    step = _solved("prove: Newton's steps", rows.residuals, rows.move, inverse, bits)
    derivative = rows.derivative()
    last = max(abs(int(v)) for v in rows.residuals()) + 1  # rounded down
    r, share = _proved_radius("prove", derivative[kept] @ whole, inverse, last, d + 1, bits)
    if len(kept) < len(derivative):  # that the equations have full rank
        left = np.linalg.pinv(derivative)
        rest, large = _bounds(derivative, left)
        if not Fraction(rest) + 8 * (d + 1) * Fraction(large) * r < 1:
            raise StateError("prove: the contacts leave a motion")
    full = np.zeros(rows.size)
    full[d :: d + 1] = [float(v) for v in w]
    orbits, total = -(full @ whole @ inverse), float(sum(w))
    many = np.bincount(fold.row, minlength=len(fold.row))[kept]
    forces = (orbits / many)[np.searchsorted(kept, fold.row)]
    # f = -w (1 - E)^-1 A with |E| <= share, and the rounding of a product of so many doubles
    near = total * float(abs(inverse).max()) * (float(share / (1 - share)) + 2.0**-50 * rows.size) * (1 + 2.0**-40)
    least = float(((orbits - near) / many).min())
    if not least > 0.0:
        raise StateError(f"prove: the least force is {forces.min():.2g}, known to {near:.2g}: it may pull")
    why = rows.closest(math.ceil(r * (1 << bits)))
    if why:
        raise StateError(f"prove: {why}")
    if path is not None:
        with replacing(Path(path)) as file:
            file.write(rows.file(w, forces).encode("ascii"))
    unit = Fraction(rows.unit)
    value = sum((w[i] * int(rows.u[i][d]) for i in range(n)), Fraction(0)) * unit
    value_radius = sum(w) * r * unit
    with localcontext() as context:
        context.prec = digits + 20
        numbers = np.array([[_decimal(int(v), bits) * Decimal(rows.unit) for v in row] for row in rows.u], dtype=object)
        rounding = Fraction(1, 10 ** (digits + 10)) * (1 + abs(value) / (1 << bits))  # of the decimals
        return Proved(
            _exact(value / (1 << bits)), _exact(value_radius + rounding), numbers[:, :d], numbers[:, d],
            _exact(r * unit + rounding), least, step,
        )
