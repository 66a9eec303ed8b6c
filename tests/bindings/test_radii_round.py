"""Radii as unknowns within round walls: known sums, exact gaps, other optimisers, forces by least squares."""
import unittest
from fractions import Fraction

import numpy as np
from scipy.optimize import minimize, nnls

import jam

SHAPES = {  # name: dim, container, axes with flat walls, axes that the round wall closes
    "circle": (2, "ball", "", 2), "ball": (3, "ball", "", 3), "cylinder": (3, "cylinder", "z", 2), "tube": (3, "cylinder", "", 2),
}


def scene(shape, n, seed=1, **more):
    dim, container, walls, _ = SHAPES[shape]
    return jam.System.random(n=n, dim=dim, container=container, seed=seed, **({"walls": walls} if walls else {}), **more)


def rows_of(shape, x, radius, box):
    """(gap, spheres, normals of their displacements) of all walls and pairs; a tube repeats along z."""
    dim, _, flat, round_axes = SHAPES[shape]
    rows, half = [], box[0] / 2
    for i in range(len(x)):
        rho = [x[i][c] - half for c in range(round_axes)]
        length = np.sqrt(sum(v * v for v in rho))
        rows.append((half - radius[i] - length, (i,), ([-v / length for v in rho] + [0.0] * (dim - round_axes),)))
        if flat:
            rows.append((x[i][2] - radius[i], (i,), ([0.0, 0.0, 1.0],)))
            rows.append((box[2] - x[i][2] - radius[i], (i,), ([0.0, 0.0, -1.0],)))
        for j in range(i + 1):
            for k in (-1, 0, 1) if shape == "tube" else (0,):
                if i == j and k <= 0:
                    continue
                r = [x[i][c] - x[j][c] + (k * box[2] if c == 2 else 0.0) for c in range(dim)]
                length = np.sqrt(sum(v * v for v in r))
                n = [v / length if i != j else 0.0 for v in r]
                rows.append((length - radius[i] - radius[j], (i, j), (n, [-v for v in n])))
    return rows


def forces_of(shape, s, goals):
    """Nonnegative forces of closed rows by least squares, with free multipliers of `goals`, (goals, n): the residual over the weight."""
    rows = [r for r in rows_of(shape, s.positions, s.diameters / 2, np.diag(s.cell)) if r[0] < 1e-12]
    a = np.zeros((len(rows) + 2 * (len(goals) - 1), s.n, s.dim + 1))
    for row, (_, spheres, normals) in zip(a, rows):
        for i, n in zip(spheres, normals):
            row[i, : s.dim] += n
            row[i, s.dim] -= 1
    for q, goal in enumerate(goals[1:]):
        a[len(rows) + 2 * q, :, s.dim], a[len(rows) + 2 * q + 1, :, s.dim] = goal, -goal
    load = np.zeros((s.n, s.dim + 1))
    load[:, s.dim] = -goals[0]
    return len(rows), nnls(a.reshape(-1, load.size).T, load.ravel())[1] / goals[0].mean()


def least_exact_gap(shape, s):
    """The least A - R, (A - R)^2 - |r|^2, |r|^2 - (R_i + R_j)^2 and distance - R, in exact numbers."""
    dim, _, flat, round_axes = SHAPES[shape]
    x, radius = [[Fraction(v) for v in row] for row in s.positions], [Fraction(v) / 2 for v in s.diameters]
    box, gaps = [Fraction(s.cell[c][c]) for c in range(dim)], []
    for i in range(s.n):
        room = box[0] / 2 - radius[i]
        gaps += [room, room**2 - sum((x[i][c] - box[0] / 2) ** 2 for c in range(round_axes))]
        gaps += [x[i][2] - radius[i], box[2] - x[i][2] - radius[i]] if flat else []
        for j in range(i + 1):
            for k in (-1, 0, 1) if shape == "tube" else (0,):
                if i != j or k > 0:
                    r = [x[i][c] - x[j][c] + (k * box[2] if c == 2 else 0) for c in range(dim)]
                    gaps.append(sum(v * v for v in r) - (radius[i] + radius[j]) ** 2)
    return min(gaps)


class Programme:
    """The sum of radii, or the factor of moments, for sequential quadratic programming."""

    def __init__(self, shape, n, box):
        self.dim, _, self.flat, self.round_axes = SHAPES[shape]
        self.shape, self.n, self.box, self.half = shape, n, np.asarray(box)[: self.dim], box[0] / 2
        self.a, self.b = np.triu_indices(n, 1)

    def gaps(self, u):
        u = u.reshape(self.n, self.dim + 1)
        x, radius = u[:, : self.dim], u[:, self.dim]
        out = [self.half - radius - np.sqrt(((x[:, : self.round_axes] - self.half) ** 2).sum(1) + 1e-30), radius]
        if self.flat:
            out += [x[:, 2] - radius, self.box[2] - x[:, 2] - radius]
        for k in (-1, 0, 1) if self.shape == "tube" else (0,):
            r = x[self.a] - x[self.b] + np.eye(self.dim)[-1] * (k * self.box[-1])
            out.append(np.sqrt((r**2).sum(1)) - radius[self.a] - radius[self.b])
        if self.shape == "tube":
            out.append(self.box[2] - 2 * radius)
        return np.concatenate(out)

    def sum_from(self, x, radius):
        """The sum at the end and how far the end is; 0 where it overlaps."""
        start = np.c_[x, radius].ravel()
        made = minimize(lambda u: -u.reshape(self.n, -1)[:, -1].sum(), start, constraints={"type": "ineq", "fun": self.gaps},
                        method="SLSQP", options={"maxiter": 300, "ftol": 1e-12})
        return (-made.fun, abs(made.x - start).max()) if self.gaps(made.x).min() > -1e-9 else (0.0, 0.0)


def ended(shape, n, seed, box=None, **more):
    s = scene(shape, n, seed, **({"box": box} if box else {}))
    return s, s.maximise_radii(**more)


CASES = (
    ("circle", 7, None), ("circle", 12, None), ("circle", 30, None), ("ball", 8, None), ("ball", 20, None), ("cylinder", 10, None),
    ("tube", 9, [1.0, 1.0, 2.0]), ("tube", 16, [1.0, 1.0, 1.4]),
)


class Known(unittest.TestCase):
    def test_sums_that_are_algebraic(self):
        """Two spheres share a diameter. Three equal disks touch each other and the circle."""
        for shape in ("circle", "ball"):
            for seed in range(1, 6):
                _, report = ended(shape, 2, seed)
                self.assertTrue(report.maximum)
                self.assertLess(abs(report.value - 0.5), 1e-14)
        _, report = ended("circle", 3, 1)
        self.assertLess(abs(report.value - 1.5 / (1 + 2 / 3**0.5)), 1e-14)

    def test_a_sphere_that_fills_the_wall_is_named(self):
        for shape in SHAPES:
            s, report = ended(shape, 1, 1)
            self.assertEqual((report.maximum, s.calls[-1]["status"]), (False, "not_converged"))
            self.assertLess(abs(report.value - 0.5), 1e-12)
            self.assertGreaterEqual(least_exact_gap(shape, s), 0)

    def test_no_other_method_finds_more(self):
        cases = (
            ("circle", 3, None), ("circle", 4, None), ("circle", 5, None), ("ball", 3, None), ("ball", 4, None),
            ("cylinder", 2, [1.0, 1.0, 0.7]), ("cylinder", 3, [1.0, 1.0, 1.3]), ("tube", 3, [1.0, 1.0, 1.1]),
        )
        rng = np.random.default_rng(2)
        for shape, n, box in cases:
            values = [r.value for r in (ended(shape, n, seed, box)[1] for seed in range(1, 13)) if r.maximum]
            by = Programme(shape, n, box or [1.0] * 3)
            most = max(by.sum_from(rng.uniform(0.2, 0.8, (n, by.dim)) * by.box, 0.01 * np.ones(n))[0] for _ in range(12))
            self.assertLess(abs(max(values) - most), 1e-8, (shape, n))


class Maximum(unittest.TestCase):
    def test_gaps_forces_and_counts(self):
        for shape, n, box in CASES:
            for seed in (1, 2, 3):
                s, report = ended(shape, n, seed, box)
                self.assertTrue(report.maximum, (shape, n, seed))
                self.assertGreaterEqual(least_exact_gap(shape, s), 0)
                contacts, residual = forces_of(shape, s, [np.ones(n)])
                self.assertEqual(contacts, report.contacts)
                self.assertLess(residual, 1e-9)  # closed to 1e-15, and balanced to 1e-10
                self.assertEqual(report.rattlers, 0)
                rigid = {"circle": 1, "ball": 3, "cylinder": 1, "tube": 2}[shape]
                self.assertEqual(report.excess, contacts - (s.dim + 1) * n + rigid)

    def test_maps_of_a_circle_onto_itself_keep_contacts(self):
        """Moebius maps: two motions beside the rotation, which only the bend of the wall stops: 3 n - 3 contacts."""
        for n in (5, 7, 12, 30):
            _, report = ended("circle", n, 1)
            self.assertEqual((report.contacts, report.excess), (3 * n - 3, -2))

    def test_no_ascent_near_the_end(self):
        rng = np.random.default_rng(1)
        for shape, n, box in (("circle", 7, None), ("ball", 6, None), ("cylinder", 6, [1.0, 1.0, 1.2]), ("tube", 6, [1.0, 1.0, 1.5])):
            s, report = ended(shape, n, 1, box)
            self.assertTrue(report.maximum)
            by = Programme(shape, n, box or [1.0] * 3)
            near = [by.sum_from(s.positions + 1e-3 * rng.normal(size=s.positions.shape), 0.97 * s.diameters / 2) for _ in range(3)]
            self.assertLess(max(value for value, far in near if far < 0.1) - report.value, 1e-8, shape)

    def test_a_symmetric_saddle_is_left(self):
        """Four equal disks on a diameter balance; off the line their sum grows."""
        x = np.c_[[0.125, 0.375, 0.625, 0.875], np.full(4, 0.5)]
        s = jam.System.from_arrays(x, radii=0.125, box=1.0, container="ball")
        report = s.maximise_radii()
        self.assertTrue(report.maximum)
        self.assertGreater(report.saddles, 0)
        self.assertGreater(report.value, 0.6)

    def test_moments_of_two_and_three_exponents(self):
        for shape, n, box in (("circle", 12, None), ("ball", 12, None), ("cylinder", 10, None), ("tube", 12, [1.0, 1.0, 1.5])):
            for exponents in ((1, 2), (1, 2, 3)):
                sizes = np.random.default_rng(n).uniform(0.6, 1.4, n)
                s = scene(shape, n, 2, diameters=sizes, **({"box": box} if box else {}))
                before = s.diameters / 2
                report = s.maximise_radii(moments=exponents)
                self.assertTrue(report.maximum, (shape, exponents))
                radii = s.diameters / 2
                for q in exponents:
                    self.assertLess(abs((radii**q).sum() / (before**q).sum() / report.value**q - 1), 1e-14)
                self.assertGreaterEqual(least_exact_gap(shape, s), 0)
                goals = [radii ** (q - 1) / (radii**q).sum() * n for q in exponents]
                self.assertLess(forces_of(shape, s, [goals[0], *(g - goals[0] for g in goals[1:])])[1], 1e-9)

    def test_a_stopped_call_stays_inside(self):
        for steps in (1, 4, 9, 15):
            s, report = ended("circle", 9, 3, max_steps=steps)
            self.assertFalse(report.maximum)
            self.assertGreater(least_exact_gap("circle", s), 0)

    def test_sizes_that_spread_too_wide_are_named(self):
        """Disks whose weights are almost 0 fill ever smaller holes."""
        ends = set()
        for seed in range(4):
            for n in (12, 30):
                s = jam.System.random(n=n, dim=2, container="ball", seed=seed)
                report = s.maximise_radii(10.0 ** np.random.default_rng(seed).uniform(-14, 0, n))
                self.assertLessEqual(s.diameters.max() / s.diameters.min(), 1e4)
                self.assertGreaterEqual(least_exact_gap("circle", s), 0)
                ends.add((report.maximum, s.calls[-1]["status"]))
        self.assertLessEqual(ends, {(False, "not_converged"), (True, "ok")})


if __name__ == "__main__":
    unittest.main()
