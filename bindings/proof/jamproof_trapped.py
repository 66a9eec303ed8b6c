"""More contacts than unknowns: crystals that close exactly as written, and packings whose spheres are trapped.

jamproof.py loads this file where it needs it. F, R, b, A, D and delta are those of its Theorem A.

Crystals. Let all F = 0 and R have full column rank: modulo a prime that is at most the true rank. Forces f > 0 that
balance exactly are those of the file, or else f* = f - A^T y with (A R)^T y = R^T f - b, which is in
|f* - f| <= max |A_kc| |R^T f - b|_1 / (1 - delta). Then the written packing is jammed.

Trapping. Let no pair overlap, f > 0, e = F >= 0 of contacts, g = |R^T f - b|_1 and M = max |A_kc| / (u_k f_c). Let v be
a motion without overlap that does not enlarge V. With a unit u_i <= 1 of each sphere, rho = max |v_i| / u_i has

    rho (1 - delta - M g) <= M sum f e + |A e| + (M (sum_c f_c w_c + sum 1 / h^2) + max_k sum_c |A_kc| w_c / u_k) rho^2

with w_c = d (u_i + u_j + |n|_1 if strict)^2, at a wall u_j = u_i; rows of A e and 1 - A R over u_k, columns of 1 - A R
times u_l; 1 / h^2 if strict, of the cell's edges h. So rho <= `inner` or rho >= R = `outer` / min u_i, both between the
roots; if strict `outer` is at most h / 2.
"""
import math
from fractions import Fraction
from operator import mul

from jamproof import TWO, Refused, bounds, gap, inverse_of, refuse, root, whole

PRIME = (1 << 61) - 1
GAMMA, FORCE = 400, 120  # binary digits of gamma; more of forces
FINEST = 7  # units of ways are down to 2^-FINEST of the longest
OFF = Fraction(1, 1024)  # the file's gamma may be off by this part of it


def rank(rows):
    """Modulo a prime: at most the rank of the integers."""
    pivots = {}
    for row in rows:
        row = {k: v % PRIME for k, v in row.items() if v % PRIME}
        while row and min(row) in pivots:
            c = min(row)
            factor = row[c]
            for k, v in pivots[c].items():
                row[k] = (row.get(k, 0) - factor * v) % PRIME
            row = {k: v for k, v in row.items() if v}
        if row:
            inverse = pow(row[min(row)], PRIME - 2, PRIME)
            pivots[min(row)] = {k: v * inverse % PRIME for k, v in row.items()}
    return len(pivots)


def closed(s, columns):
    """F = 0 exactly, with any number of contacts."""
    rows = [{} for _ in s.contacts]
    for unknown, column in enumerate(columns):
        for c, v in column:
            rows[c][unknown] = v
    refuse(rank(rows) < s.unknowns, f"singular: the rank modulo a prime is below {s.unknowns}")
    least, rest = min(s.force), s.unbalanced(columns, s.force)
    refuse(least <= 0, "force: not all are positive")
    # In balance they may have any size: strict with an equal pressure on all axes, R^T f = p b.
    pressure = {(rest[k] + b) / b for k, b in s.gradient.items()} or {1}
    if any(v for k, v in enumerate(rest) if k not in s.gradient) or len(pressure) > 1 or min(pressure) <= 0:
        j = s.rounded(columns)
        e, inverse = inverse_of(s, j, len(rows))
        delta = max(bounds(s, [0] * len(rows), j, e, inverse, [1] * s.unknowns)[0])
        off = sum(map(abs, rest)) * max(max(map(abs, column)) for column in inverse) * TWO**e
        wrong = off >= (1 - delta) * least
        refuse(wrong, f"force: the least is {float(least):.3g}, what balances them {float(off):.3g}")
    s.within = [] if s.strict else 0
    return {"radius": 0, "sum_error" if s.weights else "gamma_error": 0, "least_gap": gap(s.least_opening(0, s.gamma))}


def trapped(s):
    """Of any network with positive forces: inner and outer, and the least gap."""
    gamma, every = s.gamma, range(len(s.contacts))
    size = []
    for i, j, n in s.contacts:
        r = s.vector(i, j, n)
        square, room = Fraction(sum(map(mul, r, r)), s.one**2), Fraction(s.width, s.one)
        size.append((max(0, room - root(square, 1)) ** 2 if j == s.rim else square) / s.sigma2(i, j))
    least = s.least_opening(0, min(size), Fraction(1, 2))  # pairs without force may be closed too
    own = min(size) * min(1, least or 1)
    refuse(abs(gamma - own) > OFF * gamma, f"gamma: without overlap it is {float(own):.6g}, not that of the file")
    # The smaller of both, as spheres of a smaller gamma have more room. What is shown of it is true of a larger one.
    s.gamma = s.growth = Fraction(math.floor(min(own, gamma) * 2**GAMMA), 2**GAMMA)  # no pair overlaps: F >= 0
    if s.round:
        s.growth, s.gamma = root(s.gamma), root(s.gamma) ** 2
    f, sigma2, columns = s.equations(every)
    j = s.rounded(columns)
    e, inverse = inverse_of(s, j, len(every))
    stress, per = balanced(s, columns, e, inverse)
    refuse(min(stress) <= 0, "force: not all are positive")
    forces = [Fraction(m, per) for m in stress]
    rest, opened = sum(map(abs, s.unbalanced(columns, forces))), sum(map(mul, f, forces))
    # Strict: log V falls by no more than the sum of (way / edge)^2 below its gradient, for ways up to half an edge.
    edges = s.edges
    for grown in [[1] * s.unknowns] + ([] if s.strict else [loosely_held(s, inverse, stress)]):
        top = max(grown)
        delta, eta, _ = bounds(s, f, j, e, inverse, [top // g for g in grown])
        delta, eta = (max(v * g for v, g in zip(values, grown)) for values in (delta, eta))
        unit = {i: Fraction(1, grown[at]) for (i, _), at in s.place.items()}
        square, alpha, largest = sum(1 / h**2 for h in edges), [0] * s.unknowns, 0
        for (i, k, n), column, m in zip(s.contacts, inverse, stress):
            ways = sum(unit.get(p, Fraction(1, top)) for p in (i, i if k < 0 else k)) + s.strict * sum(map(abs, n))
            wide = s.dim * ways**2  # |w|^2 of a motion of length 1
            square, column = square + wide * Fraction(m, per), [abs(v) * g for v, g in zip(column, grown)]
            largest, scale = max(largest, Fraction(max(column) * per, m)), int(wide * top**2)
            alpha = [a + scale * v for a, v in zip(alpha, column)]
        largest *= TWO**e
        left, constant = 1 - delta / top - largest * rest, largest * opened + eta
        second = largest * square + max(alpha) * TWO**e / top**2
        if left > 0 and 4 * constant * second < left**2:
            break
    else:
        raise Refused(f"singular: left {float(left):.3g}, 4 a0 a2 {float(4 * constant * second):.3g}")
    inner, weight = 2 * constant / left, sum(map(mul, sigma2, forces))
    above = opened + rest * inner + square * inner**2  # over weight: above s.gamma of the densest packing within inner
    # With a round wall g grows: at the wall -dF / dg falls to no less than half while W - g s stays positive.
    climb = above / weight if not s.round else 2 * above / weight * (2 * s.growth + 2 * above / weight)
    error = (gamma - s.gamma + (0 if s.strict else climb)) / gamma
    outer = min([left / (2 * second * top)] + [h / 2 for h in edges])
    s.within = [2 * above + s.dim * error] if s.strict else 2 * error  # s.gamma is the file's less at most error
    refuse(s.strict and inner >= outer, f"singular: inner {float(inner):.3g} is not below outer {float(outer):.3g}")
    found = {"inner": inner * s.unit, **({"outer": outer * s.unit} if outer > inner else {})}
    found.update({"volume_error": above} if s.strict else {}, gamma_error=error)
    return {**found, "least_gap": max(0, gap(least and least * min(size) / gamma)), "delta": delta / top}


def balanced(s, columns, e, inverse):
    """The forces after a step of Newton as whole numbers, and over which."""
    forces, per = whole(s.force)
    forces, per = [m << FORCE for m in forces], per << FORCE
    rest = [round(v * s.one * per) for v in s.unbalanced(columns, [Fraction(m, per) for m in forces])]
    return [m - round(sum(map(mul, column, rest)) * TWO**e / s.one) for m, column in zip(forces, inverse)], per


def loosely_held(s, inverse, stress):
    """How much shorter than of the sphere that is held least the ways of others are, as powers of two: a hint."""
    way = [0.0] * s.unknowns
    for column, m in zip(inverse, stress):
        part = 1.0 / m
        way = [max(a, abs(v) * part) for a, v in zip(way, column)]
    longest = {}
    for (i, _), at in s.place.items():
        longest[i] = max(1e-300, way[at], longest.get(i, 0.0))
    return [1 << int(min(FINEST, math.log2(max(longest.values()) / longest[i]))) for i, _ in s.place]
