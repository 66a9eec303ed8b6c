"""Radii as unknowns in a cell that deforms at fixed volume: known lattices, exact gaps, other solvers, isotropic stress, bad input."""
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

import numpy as np
from scipy.optimize import linprog, minimize

import jam
import jam.radii

SCENES = (  # n, dim, axes with walls, exponents of moments or None
    (2, 2, "", None), (3, 2, "", None), (12, 2, "", None), (30, 2, "", (1, 2, 3)), (2, 3, "", None), (8, 3, "", None),
    (12, 3, "z", None), (16, 3, "x", (1, 2)), (20, 3, "", (1, 2, 3)), (24, 2, "", (-1, 0.5, 2.5)),
)


def scene(n, dim, walls="", seed=3, moments=None, **more):
    sizes = {} if moments is None else {"diameters": np.random.default_rng(seed).uniform(0.6, 1.4, n)}
    return jam.System.random(n=n, dim=dim, seed=seed, **({"walls": walls} if walls else {}), **sizes, **more)


def ended():
    """(system, radii before, axes with walls, exponents, report) of each scene."""
    for n, dim, walls, moments in SCENES:
        s = scene(n, dim, walls, moments=moments)
        before = s.diameters / 2
        yield s, before, {"xyz".index(c) for c in walls}, moments, s.maximise_radii(moments=moments, strain="free")


def images(s, closed):
    """Whole multiples of the cell vectors: enough for cells that are not far from a brick."""
    near = [(0,) if c in closed else range(-2, 3) for c in range(s.dim)]
    return np.stack(np.meshgrid(*near, indexing="ij"), -1).reshape(-1, s.dim)


def pairs_of(s, closed, reach):
    """(i, j, multiples, r_ij) of pairs with gaps below reach, each once."""
    x, radius, found = s.positions, s.diameters / 2, []
    for k in images(s, closed):
        r = x[:, None] - x[None] + k @ s.cell
        near = np.sqrt((r**2).sum(-1)) < radius[:, None] + radius[None] + reach
        found += [(i, j, k, r[i, j]) for i, j in np.argwhere(near) if i > j or (i == j and tuple(k) > (0,) * s.dim)]
    return found


def least_exact_gap(s, closed):
    """The least |r|^2 - (R_i + R_j)^2 and distance - R, in exact numbers."""
    x, radius = [[Fraction(v) for v in row] for row in s.positions], [Fraction(v) / 2 for v in s.diameters]
    cell = [[Fraction(v) for v in row] for row in s.cell]
    gaps = [g for i in range(s.n) for a in closed for g in (x[i][a] - radius[i], cell[a][a] - x[i][a] - radius[i])]
    for i, j, k, _ in pairs_of(s, closed, 0.3):
        r = [x[i][c] - x[j][c] + sum(int(m) * cell[b][c] for b, m in enumerate(k)) for c in range(s.dim)]
        gaps.append(sum(v * v for v in r) - (radius[i] + radius[j]) ** 2)
    return min(gaps)


def strains(dim, closed):
    """Traceless upper-triangular matrices on the axes without walls."""
    free = [c for c in range(dim) if c not in closed]
    out = []
    for a in range(len(free) - 1):
        out.append(np.zeros((dim, dim)))
        out[-1][free[a], free[a]], out[-1][free[-1], free[-1]] = 1, -1
    for a in range(len(free)):
        for b in range(a + 1, len(free)):
            out.append(np.zeros((dim, dim)))
            out[-1][free[a], free[b]] = 1
    return out


def rows_of(s, closed, reach):
    """Linear rows c + A x >= 0, x: (s_i, t_i) of each sphere, then the strains."""
    n, d, radius, basis = s.n, s.dim, s.diameters / 2, strains(s.dim, closed)
    rows, gaps = [], []
    for i in range(n):
        for a in closed:
            for far in (False, True):
                row = np.zeros(n * (d + 1) + len(basis))
                row[i * (d + 1) + a], row[i * (d + 1) + d] = (-1 if far else 1), -1
                rows.append(row), gaps.append((s.cell[a, a] - s.positions[i, a] if far else s.positions[i, a]) - radius[i])
    for i, j, _, r in pairs_of(s, closed, reach):
        length, row = np.sqrt(r @ r), np.zeros(n * (d + 1) + len(basis))
        for q, sign in ((i, 1), (j, -1)):
            row[q * (d + 1) : q * (d + 1) + d] += sign * r / length
            row[q * (d + 1) + d] -= 1
        row[n * (d + 1) :] = [r @ e @ r / length for e in basis]
        rows.append(row), gaps.append(length - radius[i] - radius[j])
    return np.array(rows), np.array(gaps)


class Known(unittest.TestCase):
    def test_one_sphere_finds_the_densest_lattice(self):
        for dim, radius in ((2, (1 / (2 * 3**0.5)) ** 0.5), (3, 2 ** (-5 / 6))):
            for cell in (None, np.diag([2.0] + [2.0 ** (-1 / (dim - 1))] * (dim - 1)), np.eye(dim) + 0.3 * np.tri(dim, k=-1)):
                s = jam.System.random(n=1, dim=dim, seed=1, **({} if cell is None else {"cell": cell}))
                report = s.maximise_radii(strain="free")
                self.assertTrue(report.maximum, (dim, report))
                self.assertLess(abs(report.value - radius), 1e-14)
                self.assertEqual((report.contacts, report.excess), ((3, 0), (6, 0))[dim - 2])
                self.assertTrue(s.report.jammed)
                self.assertEqual(s.report.strictly_jammed.name, "YES")

    def test_the_least_four_dimensions(self):
        s = jam.System.random(n=1, dim=4, seed=1)
        report = s.maximise_radii(strain="free")
        self.assertTrue(report.maximum)
        self.assertLess(abs(report.value - 2**-0.75), 1e-14)  # D4: centre density 1/8

    def test_edges_alone_keep_right_angles(self):
        for dim in (2, 3):
            s = jam.System.random(n=1, dim=dim, seed=1, cell=np.diag([1.7, 1 / 1.7, 1.0][:dim]))
            report = s.maximise_radii(strain="edges")
            self.assertTrue(report.maximum)
            self.assertLess(abs(report.value - 0.5), 1e-14)
            np.testing.assert_allclose(s.cell, np.eye(dim), atol=1e-14)

    def test_tilts_alone_keep_edges(self):
        """A disk in a cell of edges 1: the tilt that makes both lattice vectors and their difference widest is 1 / 2."""
        s = jam.System.random(n=1, dim=2, seed=1)
        report = s.maximise_radii(strain="tilts")
        self.assertTrue(report.maximum)
        self.assertEqual(np.diag(s.cell).tolist(), [1.0, 1.0])
        self.assertLess(abs(report.value - 0.5), 1e-14)

    def test_few_disks_find_the_triangular_lattice(self):
        for n in (2, 3, 4, 7, 8):
            most = max(scene(n, 2, seed=k).maximise_radii(strain="free").value for k in range(1, 4))
            self.assertLess(abs(most - (n / 12**0.5) ** 0.5), 1e-14 * n)

    def test_no_other_method_finds_a_larger_sum_of_two_disks(self):
        """Sequential quadratic programming over the cell, one position and two radii, from random starts."""
        def unpacked(u):
            a, b, x, y, first, second = u  # rows (a, 0), (b, 1 / a)
            return np.array([[a, 0.0], [b, 1.0 / a]]), np.array([x, y]), first, second

        def gaps(u):
            cell, x, first, second = unpacked(u)
            out = [first, second]
            for k in np.ndindex(5, 5):
                m = np.array(k) - 2
                out.append(np.linalg.norm(x + m @ cell) - first - second)
                if m.any():
                    out += [np.linalg.norm(m @ cell) - 2 * first, np.linalg.norm(m @ cell) - 2 * second]
            return np.array(out)

        rng, most = np.random.default_rng(1), 0.0
        for _ in range(40):
            start = np.r_[rng.uniform(0.7, 1.4), rng.uniform(-0.5, 0.5), rng.uniform(0, 1, 2), 0.01, 0.01]
            made = minimize(lambda u: -u[4] - u[5], start, constraints={"type": "ineq", "fun": gaps}, method="SLSQP")
            if gaps(made.x).min() > -1e-9:
                most = max(most, -made.fun)
        found = max(scene(2, 2, seed=k).maximise_radii(strain="free").value for k in range(1, 9))
        self.assertLess(abs(found - most), 1e-6)

    def test_free_cells_have_larger_sums(self):
        for n, dim in ((5, 2), (12, 2), (6, 3)):
            s = scene(n, dim)
            fixed = s.maximise_radii().value
            self.assertGreater(s.maximise_radii(strain="free", room=1e-3).value, fixed)


class Maximum(unittest.TestCase):
    def test_no_overlap_in_exact_numbers_at_the_volume_of_the_start(self):
        for s, _, closed, moments, report in ended():
            with self.subTest(n=s.n, dim=s.dim, closed=closed, moments=moments):
                self.assertTrue(report.maximum, report)
                self.assertGreaterEqual(least_exact_gap(s, closed), 0)
                self.assertLess(abs(np.prod(np.diag(s.cell)) - 1), 1e-14)
                self.assertLess(report.max_contact_gap, 1e-14)
                self.assertLess(report.balance_residual, 1e-12)
                for a in closed:
                    self.assertEqual((s.cell[a, a], abs(s.cell[a]).sum(), abs(s.cell[:, a]).sum()), (1.0, 1.0, 1.0))

    def test_contacts_are_as_many_as_unknowns_and_strictly_jammed(self):
        for s, _, closed, moments, report in ended():
            with self.subTest(n=s.n, dim=s.dim, closed=closed, moments=moments):
                unknowns = (s.dim + 1) * s.n - (s.dim - len(closed)) + len(strains(s.dim, closed)) - (len(moments) - 1 if moments else 0)
                self.assertEqual(report.excess, report.contacts + report.at_bounds - unknowns)
                self.assertGreaterEqual(report.excess, -s.dim * report.rattlers - 1)
                self.assertTrue(s.report.jammed)
                self.assertEqual(s.report.strictly_jammed.name, "YES")

    def test_moments_are_exact(self):
        for s, before, _, moments, report in ended():
            for q in moments or ():
                self.assertLess(abs(((s.diameters / 2) ** q).sum() / (before**q).sum() / report.value**q - 1), 1e-14)

    def test_forces_press_alike_along_free_axes(self):
        for s, _, closed, moments, _ in ended():
            stress = np.zeros((s.dim, s.dim))
            for (i, j), u, f in zip(s.contacts.pairs, s.contacts.vectors, s.forces):
                if j >= 0:  # walls press along closed axes alone
                    stress += f * (s.diameters[i] + s.diameters[j]) / 2 * np.outer(u, u)
            free = [a for a in range(s.dim) if a not in closed]
            stress = stress[np.ix_(free, free)]
            pressure = np.trace(stress) / len(free)
            self.assertLess(abs(stress / pressure - np.eye(len(free))).max(), 1e-11)

    def test_another_solver_finds_no_ascent(self):
        """HiGHS on the linear rows of positions, radii and traceless strains at the end."""
        for s, _, closed, moments, _ in ended():
            with self.subTest(n=s.n, dim=s.dim, closed=closed, moments=moments):
                a, c = rows_of(s, closed, 0.1)
                radii, more = s.diameters / 2, {}
                goal = np.zeros(a.shape[1] + 1)
                goal[s.dim : s.n * (s.dim + 1) : s.dim + 1] = 1
                if moments:
                    same = np.zeros((len(moments), goal.size))
                    for k, q in enumerate(moments):
                        same[k, s.dim : s.n * (s.dim + 1) : s.dim + 1] = radii ** (q - 1) / (radii**q).sum()
                    same[:, -1] = -1
                    goal, more = np.eye(1, goal.size, goal.size - 1)[0], {"A_eq": same, "b_eq": np.zeros(len(moments))}
                answer = linprog(-goal, A_ub=np.c_[-a, np.zeros(len(a))], b_ub=np.maximum(c, 0.0), bounds=(-1e-3, 1e-3), method="highs", **more)
                self.assertEqual(answer.status, 0)
                self.assertLess(-answer.fun, 1e-9)

    def test_many_starts_end_at_maxima(self):
        ends = [scene(n, dim, seed=k).maximise_radii(strain="free") for n, dim in ((4, 2), (20, 2), (5, 3)) for k in range(1, 11)]
        self.assertGreaterEqual(sum(r.maximum for r in ends), len(ends) - 1)

    def test_the_cell_stays_in_files_and_in_the_next_call(self):
        s = scene(12, 2)
        value = s.maximise_radii(strain="free").value
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "end.extxyz")
            s.write(path)
            again = jam.System.read(path)
        np.testing.assert_array_equal(again.cell, s.cell)
        self.assertLess(abs(again.maximise_radii(strain="free", room=1e-6).value - value), 1e-14)
        stopped = scene(12, 2)
        self.assertFalse(stopped.maximise_radii(strain="free", max_steps=12).maximum)
        self.assertGreater(abs(stopped.cell - np.eye(2)).max(), 1e-6)
        self.assertLess(abs(np.linalg.det(stopped.cell) - 1), 1e-14)
        self.assertGreater(least_exact_gap(stopped, ()), 0)
        self.assertTrue(stopped.maximise_radii(strain="free").maximum)


class Refused(unittest.TestCase):
    def refused(self, s, error, text, **options):
        before = s.positions.copy(), s.diameters.copy(), s.cell.copy()
        with self.assertRaisesRegex(error, text):
            s.maximise_radii(**options)
        for was, now in zip(before, (s.positions, s.diameters, s.cell)):
            np.testing.assert_array_equal(was, now)

    def test_bad_input_moves_nothing(self):
        few = "a maximum of radii that changes the cell at fixed volume needs at least 2 axes without walls, this scene has {}"
        wrong = jam.errors.UnsupportedError
        self.refused(scene(5, 3, "yz"), wrong, few.format(1), strain="free")
        self.refused(scene(5, 2, "xy"), wrong, few.format(0), strain="tilts")
        self.refused(jam.System.random(n=5, dim=3, seed=1, container="cylinder"), wrong, few.format(1), strain="edges")
        self.refused(scene(5, 2), jam.errors.ArgumentError, "strain is 7, which frees the volume.* a maximum of radii takes none, edges", strain="all")

    def test_a_maximum_of_a_free_cell_has_no_proof_yet(self):
        s = scene(5, 2)
        s.maximise_radii(strain="free")
        with self.assertRaisesRegex(jam.errors.StateError, "a maximum of a free cell has 2 contacts more than a fixed cell has unknowns"):
            jam.radii.prove(s)


if __name__ == "__main__":
    unittest.main()
