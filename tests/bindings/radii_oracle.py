"""What tests of largest radii compute by themselves, from positions, radii and cell: gaps in exact numbers and as linear rows,
HiGHS on these rows, and sequential quadratic programming."""
from fractions import Fraction
from itertools import product

import numpy as np
from scipy.optimize import linprog, minimize


def closed_by(s):
    """Axes with flat walls, and how many axes the round wall closes."""
    return [c for c in range(s.dim) if s.info.walls >> c & 1], {"BRICK": 0, "CYLINDER": 2, "BALL": s.dim}[s.info.container.name]


def open_axes(s):
    flat, round_axes = closed_by(s)
    return [c for c in range(round_axes, s.dim) if c not in flat]


def pairs_of(s, reach):
    """(i, j, multiples of the cell vectors, r_ij) of pairs with gaps below reach, each once, in cells not far from a brick."""
    x, radius, found, along = s.positions, s.diameters / 2, [], open_axes(s)
    for k in product(*[range(-2, 3) if c in along else (0,) for c in range(s.dim)]):
        r = x[:, None] - x[None] + np.array(k) @ s.cell
        near = np.sqrt((r**2).sum(-1)) < radius[:, None] + radius + reach
        found += [(i, j, k, r[i, j]) for i, j in np.argwhere(near) if i > j or (i == j and k > (0,) * s.dim)]
    return found


def least_exact_gap(s):
    """The least distance - R at walls, (A - R)^2 - |r|^2 at a round one and |r|^2 - (R_i + R_j)^2 of pairs, in exact numbers."""
    x, cell = ([[Fraction(v) for v in row] for row in rows] for rows in (s.positions, s.cell))
    radius = [Fraction(v) / 2 for v in s.diameters]
    flat, round_axes = closed_by(s)
    gaps = [g for y, a in zip(x, radius) for c in flat for g in (y[c] - a, cell[c][c] - y[c] - a)]
    if round_axes:
        half = cell[0][0] / 2
        for y, a in zip(x, radius):
            gaps += [half - a, (half - a) ** 2 - sum((v - half) ** 2 for v in y[:round_axes])]
    for i, j, k, _ in pairs_of(s, 0.3):
        r = [x[i][c] - x[j][c] + sum(m * cell[b][c] for b, m in enumerate(k)) for c in range(s.dim)]
        gaps.append(sum(v * v for v in r) - (radius[i] + radius[j]) ** 2)
    return min(gaps)


def strains(s):
    """Traceless upper-triangular matrices on the axes without walls."""
    free, out = open_axes(s), []
    for a in range(len(free) - 1):
        out.append(np.zeros((s.dim, s.dim)))
        out[-1][free[a], free[a]], out[-1][free[-1], free[-1]] = 1, -1
    for a in range(len(free)):
        for b in range(a + 1, len(free)):
            out.append(np.zeros((s.dim, s.dim)))
            out[-1][free[a], free[b]] = 1
    return out


def rows_of(s, reach, basis):
    """Linear rows c + A x >= 0 of walls, and of pairs with gaps below reach; x: (s_i, t_i) of each sphere, then the strains."""
    d, radius, rows, gaps = s.dim, s.diameters / 2, [], []
    flat, round_axes = closed_by(s)

    def add(gap, normals, bends=np.zeros(len(basis))):
        row = np.zeros((s.n, d + 1))
        for i, normal in normals:
            row[i, :d] += normal
            row[i, d] -= 1
        rows.append(np.append(row, bends)), gaps.append(gap)

    for i, y in enumerate(s.positions):
        for c in flat:
            for sign, distance in ((1, y[c]), (-1, s.cell[c, c] - y[c])):
                add(distance - radius[i], [(i, sign * np.eye(d)[c])])
        if round_axes:
            rho = np.where(np.arange(d) < round_axes, y - s.cell[0, 0] / 2, 0.0)
            length = np.sqrt(rho @ rho)
            add(s.cell[0, 0] / 2 - length - radius[i], [(i, -rho / length)])
    for i, j, _, r in pairs_of(s, reach):
        length = np.sqrt(r @ r)
        add(length - radius[i] - radius[j], [(i, r / length), (j, -r / length)], [r @ e @ r / length for e in basis])
    return np.array(rows), np.array(gaps)


def ascent(s, exponents, basis):
    """What HiGHS gains within steps of 1e-3: of the sum of radii, or of ln lambda where moments keep their ratios."""
    a, c = rows_of(s, 0.1, basis)
    radii, goal, more = s.diameters / 2, np.zeros(a.shape[1] + 1), {}
    of_radii = slice(s.dim, s.n * (s.dim + 1), s.dim + 1)
    goal[of_radii] = 1
    if exponents:
        same = np.zeros((len(exponents), goal.size))
        for row, q in zip(same, exponents):
            row[of_radii] = radii ** (q - 1) / (radii**q).sum()
        same[:, -1] = -1
        goal, more = np.eye(1, goal.size, goal.size - 1)[0], {"A_eq": same, "b_eq": np.zeros(len(exponents))}
    answer = linprog(-goal, A_ub=np.c_[-a, np.zeros(len(a))], b_ub=np.maximum(c, 0.0), bounds=(-1e-3, 1e-3), method="highs", **more)
    assert answer.status == 0, answer.message
    return -answer.fun


class Programme:
    """The sum of radii of n spheres in a brick of these edges for sequential quadratic programming; one row a sphere, its radius last."""

    def __init__(self, n, edges, flat="", round_axes=0):
        self.n, self.edges, self.half = n, np.array(edges, float), edges[0] / 2
        self.flat, self.round_axes = ["xyz".index(c) for c in flat], round_axes
        along = [c for c in range(round_axes, len(edges)) if c not in self.flat]
        self.steps = [np.array(k) * edges for k in product(*[(-1, 0, 1) if c in along else (0,) for c in range(len(edges))])]
        self.a, self.b = np.triu_indices(n, 1)

    def gaps(self, u):
        u = u.reshape(self.n, -1)
        x, radius, out = u[:, :-1], u[:, -1], [u[:, -1]]
        for c in self.flat:
            out += [x[:, c] - radius, self.edges[c] - x[:, c] - radius]
        if self.round_axes:
            out.append(self.half - radius - np.sqrt(((x[:, : self.round_axes] - self.half) ** 2).sum(1) + 1e-30))
        for step in self.steps:
            out.append(np.sqrt(((x[self.a] - x[self.b] + step) ** 2).sum(1)) - radius[self.a] - radius[self.b])
            if step.any():
                out.append(np.linalg.norm(step) - 2 * radius)
        return np.concatenate(out)

    def sum_from(self, x, radius):
        """The sum at the end; 0 where it overlaps."""
        start = np.c_[x, radius].ravel()
        made = minimize(lambda u: -u.reshape(self.n, -1)[:, -1].sum(), start, constraints={"type": "ineq", "fun": self.gaps},
                        method="SLSQP", options={"maxiter": 300, "ftol": 1e-12})
        return -made.fun if self.gaps(made.x).min() > -1e-9 else 0.0
