"""Any number of digits of a jammed packing, with a proved radius.

Unknown are the centres x of the stable spheres but the first, and G, the square of the factor of all diameters. Of each
contact F = |x_i - x_j + n H|^2 - G sigma^2 is 0, so an isostatic packing has as many equations as unknowns. Newton's steps
with one factor J of doubles gain some 14 digits each, if F is computed in integers. Where A is the inverse of J in doubles,
|1 - A J| <= delta, |A F| <= eta and beta = 4 d |A| (maximum norms), exactly one zero of F lies within r = 2 eta if
delta r + beta r^2 <= eta and delta + 2 beta r < 1: theorem A of the guide's page on proofs.
"""
from __future__ import annotations

import math
from decimal import Decimal, localcontext
from fractions import Fraction
from typing import Any, Callable, NamedTuple

import numpy as np

from ._api.arrays import Array
from ._api.shown import only
from ._api.size_laws import contact_distance
from .errors import StateError
from .system import System

__all__ = ["Refined", "refine"]
__dir__ = only(__all__)

GUARD = 64  # bits behind the last digit that is asked for
SLACK = 16  # of these may stay wrong when the steps end
FEWEST_DIGITS = 20
ULP = 2.0**-53
STEPS = 40  # without a gain of digits a step fails long before


class Refined(NamedTuple):
    """A jammed packing in decimals. Nothing in it is farther from the exact packing than the radius beside it."""

    packing_fraction: Decimal
    packing_fraction_radius: Decimal
    positions: Array  #: (n, d) of Decimal, in the unit of the box; rattlers stay where they were
    radius: Decimal  #: of each coordinate of a stable sphere
    forces: Array  #: (contacts,) of Decimal, mean 1
    forces_radius: Decimal
    steps: int  #: of Newton's method


def _bits(digits: int) -> int:
    """Behind the point, for so many digits."""
    if digits < FEWEST_DIGITS:
        raise ValueError(f"digits is {digits}; doubles have nearly 16, so {FEWEST_DIGITS} and more are computed here")
    return int(digits * math.log2(10)) + GUARD


def _integers(values: Any, bits: int) -> Array:
    """Doubles times 2^bits, as Python's integers: exact."""
    flat = [int(Fraction(float(v)) * (1 << bits)) for v in np.ravel(values)]
    return np.array(flat, dtype=object).reshape(np.shape(values))


def _doubles(values: Array, bits: int) -> tuple[Array, int]:
    """Integers over 2^bits as doubles times 2^power, with the largest near 1."""
    power = max((int(abs(v)).bit_length() for v in values), default=0)
    return np.array([math.ldexp(int(v) >> max(power - 64, 0), max(power - 64, 0) - power) for v in values]), power - bits


def _number(value: Any, bits: int) -> float:
    """One of them, rounded once."""
    return math.ldexp(int(value) >> (bits - 80), -80)


def _fixed(step: Array, power: int, bits: int) -> Array:
    """Doubles times 2^power, as integers over 2^bits."""
    shift = bits + power - 60
    whole = [int(v) for v in np.round(step * 2.0**60)]
    return np.array([v << shift if shift >= 0 else v >> -shift for v in whole], dtype=object)


def _pi(bits: int) -> int:
    """Machin: pi/4 = 4 atan(1/5) - atan(1/239)."""

    def atan_inverse(k: int) -> int:
        term, total, n = (1 << (bits + 32)) // k, 0, 0
        while term:
            total += (-1) ** n * (term // (2 * n + 1))
            term //= k * k
            n += 1
        return total

    return (4 * (4 * atan_inverse(5) - atan_inverse(239))) >> 32


def _images(system: System) -> Array:
    """n of each contact, r = x_i - x_j + n H, 0 at walls: whole numbers for one sign of the contact vectors."""
    (i, j), x, sigma, inverse = system.contacts.pairs.T, system.positions, system.diameters, np.linalg.inv(system.cell)
    pair, j = (j >= 0)[:, None], np.where(j < 0, i, j)
    distance = contact_distance(sigma[i], sigma[j], system.info.non_additivity)
    ways = [sign * distance[:, None] * system.contacts.vectors - (x[i] - x[j]) for sign in (1, -1)]
    parts = [pair * (way @ inverse) for way in ways]
    return np.round(min(parts, key=lambda n: float(abs(n - np.round(n)).max(initial=0.0)))).astype(int)


class _Equations:
    """F, its derivative, and what both need, with numbers of `bits` bits behind the point."""

    def __init__(self, system: System, bits: int):
        info = system.info
        self.unit = 2.0 ** round(math.log2(info.box))  # an exact factor
        cell, x, sigma = system.cell / self.unit, system.positions / self.unit, system.diameters / self.unit
        if info.container or info.walls or info.model:
            raise StateError("digits: only periodic packings of the Euclidean model have a proof of their digits")
        self.d, self.bits, self.pairs, self.cell, self.sigma = info.dim, bits, system.contacts.pairs, cell, sigma
        self.stable = np.unique(self.pairs)
        self.index = np.full(info.n, -1)
        self.index[self.stable[1:]] = np.arange(len(self.stable) - 1)  # the first one stands still
        self.unknowns = self.d * (len(self.stable) - 1) + 1
        if len(self.pairs) != self.unknowns:
            raise StateError(
                f"digits: {len(self.pairs)} contacts and {self.unknowns} unknowns: only isostatic packings are refined"
            )
        self.shift = _images(system).astype(object) @ _integers(cell, bits)
        half = _integers(sigma, bits)
        delta = Fraction(info.non_additivity)
        # sigma of each contact, exactly, and its square
        exact = [Fraction(1) * (half[a] + half[b]) * (1 if half[a] == half[b] else 1 + delta) / 2 for a, b in self.pairs]
        self.distance = np.array([int(v) for v in exact], dtype=object)
        self.square = np.array([int(v * v) >> bits for v in exact], dtype=object)
        self.x, self.gamma = _integers(x, bits), 1 << bits

    def separations(self) -> Array:
        i, j = self.pairs.T
        return self.x[i] - self.x[j] + self.shift

    def residuals(self) -> Array:
        r = self.separations()
        return ((r * r).sum(1) - self.gamma * self.square) >> self.bits

    def derivative(self) -> Array:
        """J in doubles, each entry rounded once."""
        m, d = len(self.pairs), self.d
        r = np.array([[_number(v, self.bits) for v in row] for row in self.separations()])
        found = np.zeros((m, self.unknowns))
        for column, sign in ((0, 2.0), (1, -2.0)):
            at = self.index[self.pairs[:, column]]
            rows = np.flatnonzero(at >= 0)
            for k in range(d):
                found[rows, d * at[rows] + k] += sign * r[rows, k]
        found[:, -1] = [-_number(v, self.bits) for v in self.square]
        return found

    def move(self, step: Array) -> None:
        """x and G less a step."""
        self.x[self.stable[1:]] -= step[:-1].reshape(-1, self.d)
        self.gamma -= step[-1]

    def imbalance(self, forces: Array) -> Array:
        """J^T f + e_G, which is 0 where forces balance and sum f sigma^2 = 1."""
        net = np.zeros((len(self.index), self.d), dtype=object)
        part = (2 * forces[:, None] * self.separations()) >> self.bits
        np.add.at(net, self.pairs[:, 0], part)
        np.subtract.at(net, self.pairs[:, 1], part)
        last = (1 << self.bits) - (int((forces * self.square).sum()) >> self.bits)
        return np.append(net[self.stable[1:]].ravel(), last)


def _bounds(derivative: Array, inverse: Array) -> tuple[float, float]:
    """delta and alpha: bounds of |1 - A J| and |A| that contain all rounding, of J's entries too."""
    m = inverse.shape[1]
    alpha = float(abs(inverse).sum(1).max()) * (1 + 2 * m * ULP)
    left = np.eye(len(inverse)) - inverse @ derivative
    rounding = 2 * (m + 4) * ULP * alpha * float(abs(derivative).sum(1).max())
    return float(abs(left).sum(1).max()) * (1 + 2 * m * ULP) + rounding, alpha


def _decimal(value: int, bits: int) -> Decimal:
    return Decimal(value) / (1 << bits)


def _inverse(name: str, derivative: Array) -> Array:
    try:
        return np.linalg.inv(derivative)
    except np.linalg.LinAlgError:
        raise StateError(f"{name}: the contacts depend on each other") from None


def _solved(name: str, wrong: Callable[[], Array], move: Callable[[Array], Any], inverse: Array, bits: int) -> int:
    """Newton's steps until what is wrong has only its last bits; their number."""
    for step in range(STEPS + bits // 8):
        left, power = _doubles(wrong(), bits)
        if power <= SLACK - bits:
            return step
        move(_fixed(inverse @ left, power, bits))
    raise StateError(f"{name} gain no digits; contacts nearly depend on each other")


def _proved_radius(name: str, derivative: Array, inverse: Array, last: int, d: int, bits: int) -> tuple[Fraction, Fraction]:
    """r of theorem A where |F| is at most last over 2^bits, and delta + 2 beta r; refuses where it does not hold."""
    delta, alpha = _bounds(derivative, inverse)
    eta, beta = Fraction(alpha) * Fraction(last, 1 << bits), 4 * d * Fraction(alpha)
    r = 2 * eta
    share = Fraction(delta) + 2 * beta * r
    if not (Fraction(delta) * r + beta * r * r <= eta and share < 1):
        raise StateError(f"{name}: nothing is proved, since |1 - A J| is only known to be at most {delta:.2g}")
    return r, share


def _balanced(equations: _Equations, inverse: Array) -> Array:
    forces = np.array([0] * len(inverse), dtype=object)
    _solved("digits: the forces", lambda: equations.imbalance(forces), forces.__isub__, inverse.T, equations.bits)
    return forces


def _fraction(equations: _Equations) -> int:
    """The packing fraction: that of the diameters as they are, times G^(d/2)."""
    d, bits = equations.d, equations.bits
    k, pi = d // 2, _pi(bits)
    ball = Fraction(1, math.factorial(k)) if d % 2 == 0 else Fraction(2 * math.factorial(k) * 4**k, math.factorial(d))
    volume = Fraction(1)
    for row, entry in enumerate(np.diag(equations.cell)):  # a lower triangle
        volume *= Fraction(float(entry))
    ball *= sum((Fraction(float(s)) ** d for s in equations.sigma), Fraction(0)) / volume / 2**d
    value = int(ball * (1 << bits))
    root = math.isqrt(equations.gamma << bits)
    for factor in [pi] * k + [root] * d:
        value = value * factor >> bits
    return value


def refine(system: System, digits: int = 1000) -> Refined:
    """Packing fraction, centres and forces of a jammed packing to so many digits, with the radius that is proved.

    Parameters
    ----------
    system : System
        After a crunch: periodic, Euclidean, isostatic. Its contacts are taken as exact, and its diameters and cell as they
        are. That the packing is jammed, `system.prove()` shows.
    digits : int
        From 20 on.

    Raises
    ------
    StateError
        No contacts, not isostatic, walls, the Mari-Kurchan model, or contacts so nearly dependent that doubles cannot
        factor their equations.

    Examples
    --------
    >>> import jam, jam.digits
    >>> disks = jam.System.random(n=32, dim=2, seed=1, diameters=[1.0, 1.4] * 16)
    >>> report = disks.crunch()
    >>> found = jam.digits.refine(disks, 60)
    >>> abs(float(found.packing_fraction) - report.packing_fraction) < 1e-13, found.packing_fraction_radius < 1e-60
    (True, True)
    """
    bits = _bits(digits)
    e = _Equations(system, bits)
    inverse = _inverse("digits", e.derivative())
    steps = _solved("digits: Newton's steps", e.residuals, e.move, inverse, bits)
    last = max(abs(int(v)) for v in e.residuals()) + e.d + 4  # with the rounding of its sums
    r, share = _proved_radius("digits", e.derivative(), inverse, last, e.d, bits)
    forces = _balanced(e, inverse)
    wrong = sum(abs(int(v)) for v in e.imbalance(forces)) + (len(forces) + 1) * (e.d + 2)
    near = Fraction(wrong, 1 << bits) + 8 * e.d * r * Fraction(sum(abs(int(f)) for f in forces), 1 << bits)
    near *= Fraction(float(abs(inverse).max())) / (1 - share)
    longest = Fraction(max(int(s) for s in e.distance), 1 << bits)
    forces = forces * e.distance >> bits  # of f = force / distance
    near, total = near * longest + Fraction(1, 1 << bits), int(forces.sum())
    mean, largest = Fraction(total, len(forces) << bits), Fraction(max(int(f) for f in forces), 1 << bits)
    phi, unit = _fraction(e), Decimal(e.unit)
    with localcontext() as context:
        context.prec = digits + 20
        gamma, radius = Fraction(e.gamma, 1 << bits), Decimal(r.numerator) / r.denominator
        spread = near / mean * (1 + largest / (mean - near))
        scaled = [Decimal(int(f) * len(forces)) / total for f in forces]
        grown = Fraction(phi, 1 << bits) * Fraction(e.d, 2) * r / (gamma - r) + Fraction(32, 1 << bits)
        where = np.array([[_decimal(int(v), bits) * unit for v in row] for row in e.x], dtype=object)
        return Refined(
            _decimal(phi, bits), Decimal(grown.numerator) / grown.denominator, where, radius * unit,
            np.array(scaled, dtype=object), Decimal(spread.numerator) / spread.denominator, steps,
        )
