"""Radii as unknowns: known sums, exact gaps, the optimality of the end by another solver, bad input, stops, search, proof."""
import tempfile
import unittest
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np
from scipy.optimize import linprog, minimize

import jam
import jam.radii


def box(n, dim=2, seed=1, **more):
    return jam.System.random(n=n, dim=dim, walls="xyz"[:dim], seed=seed, **more)


SCENES = (  # n, dim, axes with walls, cell
    (1, 2, "xy", None), (2, 3, "xyz", None), (7, 2, "x", None), (12, 2, "xy", [[1.0, 0.0], [0.0, 0.4]]),
    (20, 3, "z", None), (16, 3, "xyz", None), (10, 2, "", [[1.0, 0.0], [0.3, 0.8]]), (9, 3, "", None), (40, 2, "xy", None),
)


def scenes():
    for n, dim, walls, cell in SCENES:
        yield jam.System.random(n=n, dim=dim, seed=3, **({"walls": walls} if walls else {}), **({} if cell is None else {"cell": cell}))


def walls_of(s):
    table = s.walls()
    return [(int(axis), bool(side)) for axis, side in zip(table.axis, table.side)]


def least_exact_gap(s):
    """The least |r|^2 - (R_i + R_j)^2 and distance - R, of nearest images, in exact numbers."""
    x, radius = [[Fraction(v) for v in row] for row in s.positions], [Fraction(v) / 2 for v in s.diameters]
    cell = [[Fraction(v) for v in row] for row in s.cell]
    walls = walls_of(s)
    closed = {axis for axis, _ in walls}
    shifts = [[]]
    for c in range(s.dim):
        shifts = [k + [m] for k in shifts for m in ((0,) if c in closed else (-1, 0, 1))]
    gaps = [(cell[a][a] - x[i][a] if far else x[i][a]) - radius[i] for i in range(s.n) for a, far in walls]
    for i in range(s.n):
        for j in range(i + 1):
            for k in shifts:
                if i == j and not any(k):
                    continue
                r = [x[i][c] - x[j][c] + sum(m * cell[b][c] for b, m in enumerate(k)) for c in range(s.dim)]
                gaps.append(sum(v * v for v in r) - (radius[i] + radius[j]) ** 2)
    return min(gaps)


def rows_of(s, reach):
    """Linear rows c + A x >= 0 of pairs and walls with gaps below reach, x: (s_i, t_i) of each sphere; nearest images."""
    x, radius, cell, d = s.positions, s.diameters / 2, s.cell, s.dim
    walls = walls_of(s)
    closed = {axis for axis, _ in walls}
    rows, gaps = [], []

    def add(gap, *parts):
        row = np.zeros((s.n, d + 1))
        for i, n in parts:
            row[i, :d] += n
            row[i, d] -= 1
        rows.append(row.ravel()), gaps.append(gap)

    for i in range(s.n):
        for axis, far in walls:
            e = np.eye(d)[axis]
            add((cell[axis, axis] - x[i, axis] if far else x[i, axis]) - radius[i], (i, -e if far else e))
        for j in range(i + 1):
            for k in np.ndindex(*[1 if c in closed else 3 for c in range(d)]):
                shift = np.array([m - (0 if c in closed else 1) for c, m in enumerate(k)])
                r = x[i] - x[j] + shift @ cell
                length = np.sqrt(r @ r)
                if length > 0 and length - radius[i] - radius[j] < reach:
                    add(length - radius[i] - radius[j], (i, r / length), (j, -r / length))
    return np.array(rows), np.array(gaps)


class Known(unittest.TestCase):
    def test_sums_that_are_algebraic(self):
        for n, dim, value in ((1, 2, 0.5), (2, 2, 2 - 2**0.5), (1, 3, 0.5), (2, 3, 3**0.5 / (1 + 3**0.5))):
            for seed in range(1, 6):
                report = box(n, dim, seed).maximise_radii()
                self.assertTrue(report.maximum)
                self.assertLess(abs(report.value - value), 1e-14)

    def test_one_sphere_that_touches_its_images(self):
        s = jam.System.random(n=1, dim=2, cell=[[1.0, 0.0], [0.25, 2.0]], seed=1)
        self.assertLess(abs(s.maximise_radii().value - 0.5), 1e-14)

    def test_other_units_and_boxes(self):
        for box_side in (1e-6, 3e4):
            s = jam.System.random(n=2, dim=2, walls="xy", box=box_side, seed=2)
            self.assertLess(abs(s.maximise_radii().value / box_side - (2 - 2**0.5)), 1e-14)

    def test_a_symmetric_saddle_is_left(self):
        """Side by side forces balance, and neither disk can grow; off the line both can."""
        s = jam.System.from_arrays([[0.25, 0.5], [0.75, 0.5]], radii=0.25, box=1.0, walls="xy")
        report = s.maximise_radii()
        self.assertGreater(report.saddles, 0)
        self.assertLess(abs(report.value - (2 - 2**0.5)), 1e-14)

    def test_no_other_method_finds_more(self):
        """Sequential quadratic programming from random points, for four disks at most."""
        rng = np.random.default_rng(1)
        for n in (3, 4):
            pairs = [(i, j) for i in range(n) for j in range(i)]

            def gaps(u):
                u = u.reshape(n, 3)
                apart = [np.hypot(*(u[i, :2] - u[j, :2])) - u[i, 2] - u[j, 2] for i, j in pairs]
                return np.concatenate([apart, (u[:, :2] - u[:, 2:]).ravel(), (1 - u[:, :2] - u[:, 2:]).ravel(), u[:, 2]])

            most = 0.0
            for _ in range(40):
                start = np.c_[rng.random((n, 2)), np.full(n, 0.01)].ravel()
                made = minimize(lambda u: -u.reshape(n, 3)[:, 2].sum(), start, constraints={"type": "ineq", "fun": gaps}, method="SLSQP")
                if gaps(made.x).min() > -1e-9:
                    most = max(most, -made.fun)
            found = jam.radii.best_of(n, walls="xy", starts=4, workers=1)
            self.assertLess(abs(found.value - most), 1e-6)


class Maximum(unittest.TestCase):
    def test_images_along_several_vectors_are_exact(self):
        """Sums of cell vectors are rounded in doubles: seed 6 had two spheres that overlapped by 1e-17."""
        for seed in (3, 5, 6):
            s = jam.System.random(n=7, dim=3, seed=seed, cell=[[1.0, 0.0, 0.0], [0.37, 0.81, 0.0], [-0.21, 0.333, 1.1]])
            self.assertTrue(s.maximise_radii().maximum)
            self.assertGreaterEqual(least_exact_gap(s), 0)

    def test_no_overlap_in_exact_numbers_and_no_rattlers(self):
        for s in scenes():
            report = s.maximise_radii()
            self.assertTrue(report.maximum, report)
            self.assertGreaterEqual(least_exact_gap(s), 0)
            self.assertEqual(report.rattlers, 0)
            self.assertLess(report.max_contact_gap, 1e-14)
            self.assertLess(report.balance_residual, 1e-12)
            self.assertGreater(report.min_force, 0)
            self.assertLess(abs(report.value - s.diameters.sum() / 2), 1e-14 * s.n)
            self.assertTrue(s.report.jammed)

    def test_another_solver_finds_no_ascent(self):
        """HiGHS on the linear rows at the end: within a step of 1e-3 nothing is gained beyond its tolerance."""
        for s in scenes():
            s.maximise_radii()
            a, c = rows_of(s, 0.1)
            cost = np.zeros((s.n, s.dim + 1))
            cost[:, -1] = -1.0
            answer = linprog(cost.ravel(), A_ub=-a, b_ub=np.maximum(c, 0.0), bounds=(-1e-3, 1e-3), method="highs")
            self.assertEqual(answer.status, 0)
            self.assertLess(-answer.fun, 1e-8)

    def test_forces_on_a_sphere_add_up_to_its_weight(self):
        weights = np.linspace(0.5, 2.0, 12)
        s = box(12, seed=5)
        report = s.maximise_radii(weights)
        self.assertEqual(s.calls[-1]["options"]["weights"], weights.tolist())
        self.assertTrue(report.maximum)
        self.assertLess(abs(report.value - weights @ s.diameters / 2), 1e-14)
        sums = np.zeros(12)
        for (i, j), f in zip(s.contacts.pairs, s.forces):
            sums[i] += f
            if j >= 0:
                sums[j] += f
        scale = weights / sums
        self.assertLess(np.ptp(scale) / scale.mean(), 1e-11)

    def test_bounds_hold_and_are_reported(self):
        free = box(10, seed=2)
        free.maximise_radii()
        low, high = 0.8 * free.diameters.mean() / 2, 1.1 * free.diameters.mean() / 2
        start = jam.System.from_arrays(free.positions, radii=1.05 * low, box=1.0, walls="xy", overlap="shrink")
        low = min(low, 0.95 * start.diameters[0] / 2)
        report = start.maximise_radii(radius_min=low, radius_max=high)
        self.assertTrue(report.maximum)
        self.assertGreater(report.at_bounds, 0)
        self.assertGreaterEqual(start.diameters.min() / 2, low * (1 - 1e-15))
        self.assertLessEqual(start.diameters.max() / 2, high)
        self.assertGreaterEqual(least_exact_gap(start), 0)
        self.assertEqual(int(np.sum(abs(start.diameters / 2 - high) < 1e-14) + np.sum(abs(start.diameters / 2 - low) < 1e-14)), report.at_bounds)

    def test_bounds_that_hold_many_radii(self):
        for seed in (35, 378):  # the polish left overlaps of other pairs
            rng = np.random.default_rng(seed)
            weights, most = 10.0 ** rng.uniform(-1, 1, 12), 12**-0.5 * rng.uniform(0.3, 0.6)
            s = jam.System.random(n=12, dim=2, seed=seed)
            self.assertTrue(s.maximise_radii(weights, radius_max=most).maximum)
            self.assertLessEqual(s.diameters.max() / 2, most * (1 + 1e-15))
            self.assertGreaterEqual(least_exact_gap(s), 0)
        s = box(30, seed=46)
        s.maximise_radii(radius_max=0.088)
        report = s.maximise_radii(radius_max=0.088, room=1e-5)
        self.assertTrue(report.maximum)
        self.assertEqual((report.contacts, report.at_bounds, report.rattlers), (0, 30, 30))

    def test_a_sphere_with_room_is_no_maximum(self):
        """A weight may be so small that its sphere has not grown; then no maximum is claimed."""
        for small in (1e-9, 3e-11, 1e-20):
            s, weights = box(8), np.ones(8)
            weights[3] = small
            report = s.maximise_radii(weights)
            if report.maximum:
                self.assertEqual(report.rattlers, 0)

    def test_the_least_other_gap_is_that_of_a_pair(self):
        s = box(6)
        report = s.maximise_radii()
        x, radius = s.positions, s.diameters / 2
        gaps = [np.linalg.norm(x[i] - x[j]) - radius[i] - radius[j] for i in range(6) for j in range(i)]
        gaps += [g for i in range(6) for c in range(2) for g in (x[i, c] - radius[i], 1 - x[i, c] - radius[i])]
        self.assertAlmostEqual(report.min_gap, sorted(gaps)[report.contacts], delta=1e-14)

    def test_little_room_ends_near_the_start(self):
        s = box(15, seed=4)
        value = s.maximise_radii().value
        again = s.copy()
        self.assertLess(abs(again.maximise_radii(room=1e-6).value - value), 1e-14)
        self.assertLess(abs(again.positions - s.positions).max(), 1e-12)

    def test_the_same_start_ends_at_the_same_bits(self):
        first, second = box(15, seed=4), box(15, seed=4)
        first.maximise_radii(), second.maximise_radii()
        np.testing.assert_array_equal(first.positions, second.positions)
        np.testing.assert_array_equal(first.diameters, second.diameters)


class Refused(unittest.TestCase):
    def refused(self, system, error, text, *given, **options):
        before = system.positions.copy(), system.diameters.copy()
        with self.assertRaisesRegex(error, text):
            system.maximise_radii(*given, **options)
        np.testing.assert_array_equal(system.positions, before[0])
        np.testing.assert_array_equal(system.diameters, before[1])

    def test_bad_input_moves_nothing(self):
        s, wrong = box(5), jam.errors.ArgumentError
        self.refused(s, wrong, "radius_max is 0.1 and radius_min 0.2", radius_min=0.2, radius_max=0.1)
        self.refused(s, wrong, "no room between", radius_min=0.1, radius_max=0.1)
        self.refused(s, wrong, "radius_min is -1", radius_min=-1.0)
        self.refused(s, wrong, "radius_min is 0.4, which spheres", radius_min=0.4)
        self.refused(s, wrong, "room is 0,", room=0.0)
        self.refused(s, wrong, "max_steps is 0", max_steps=0)
        self.refused(s, wrong, "wall_time is 0", wall_time=0.0)
        self.refused(s, wrong, r"weights\[2\] is 0", [1, 1, 0, 1, 1])
        self.refused(s, wrong, r"weights\[4\] is -1", [1, 1, 1, 1, -1])
        self.refused(s, wrong, r"weights\[1\] is 1e\+308, it must be positive and at most 1e\+100", [1, 1e308, 1, 1, 1])
        self.refused(s, wrong, "weights_len is 3", [1, 1, 1])
        self.refused(s, jam.errors.NonfiniteError, r"weights\[0\]", [np.nan, 1, 1, 1, 1])
        far = jam.errors.UnsupportedError
        self.refused(jam.System.random(n=5, dim=2, model="mk"), far, "Mari-Kurchan")
        mixture = jam.System.random(n=4, dim=2, diameters=[1, 1, 1.4, 1.4], non_additivity=0.1)
        self.refused(mixture, far, "non_additivity")
        soft = jam.System.random(n=20, dim=2, packing_fraction=0.9, overlap="allow")
        self.refused(soft, jam.errors.OverlapError, "overlap")


class Stops(unittest.TestCase):
    def stopped(self, reason, status, **options):
        s = box(20, seed=2)
        report = s.maximise_radii(**options)
        self.assertEqual((report.stop_reason.name, s.calls[-1]["status"]), (reason, status))
        self.assertFalse(report.maximum)
        self.assertEqual((report.contacts, report.rattlers, report.at_bounds, report.excess), (-1, -1, -1, -1))
        self.assertTrue(np.isnan(report.min_gap))
        self.assertGreater(least_exact_gap(s), 0)
        with self.assertRaises(jam.errors.StateError):
            s.contacts
        self.assertTrue(s.maximise_radii().maximum)  # and goes on from there

    def test_each_limit_leaves_a_valid_packing(self):
        self.stopped("STEPS", "limit", max_steps=3)
        self.stopped("WALL_TIME", "limit", wall_time=1e-9)
        self.stopped("CANCELLED", "cancelled", progress=lambda p: True)


class Search(unittest.TestCase):
    def test_workers_and_folders_change_nothing(self):
        whole = jam.radii.best_of(6, walls="xy", starts=6, workers=2)
        with tempfile.TemporaryDirectory() as folder:
            jam.radii.best_of(6, walls="xy", starts=2, workers=1, folder=Path(folder, "six"))
            parts = jam.radii.best_of(6, walls="xy", starts=6, workers=1, folder=Path(folder, "six"))
            with self.assertRaisesRegex(ValueError, "another search"):
                jam.radii.best_of(7, walls="xy", starts=2, workers=1, folder=Path(folder, "six"))
            for text in ("", "{", "[1]", '{"asked": 1}', '{"asked": 1, "best": [1], "done": [], "maxima": 0, "seconds": 0}'):
                Path(folder, "six", "search.json").write_text(text)
                with self.assertRaisesRegex(ValueError, r"search\.json is damaged .*remove it"):
                    jam.radii.best_of(6, walls="xy", starts=6, workers=1, folder=Path(folder, "six"))
        self.assertEqual((whole.starts, whole.maxima), (parts.starts, parts.maxima))
        self.assertEqual([b.value for b in whole.best], [b.value for b in parts.best])
        np.testing.assert_array_equal(whole.best[0].positions, parts.best[0].positions)
        values = [b.value for b in whole.best]
        self.assertEqual(values, sorted(values, reverse=True))
        self.assertLessEqual(len(values), 10)

    def test_a_search_without_an_end_is_refused(self):
        with self.assertRaisesRegex(ValueError, "starts, seconds or until"):
            jam.radii.best_of(5)
        with self.assertRaises(jam.errors.ArgumentError):  # before a worker begins
            jam.radii.best_of(5, starts=1, radius_min=0.4)

    def test_until_ends_it(self):
        found = jam.radii.best_of(2, 3, walls="xyz", until=0.63397459, workers=1)
        self.assertLess(abs(found.value - 3**0.5 / (1 + 3**0.5)), 1e-14)

    def test_periodic_cells(self):
        found = jam.radii.best_of(4, cell=[[1.0, 0.0], [0.2, 0.9]], starts=2, workers=1, keep=1)
        self.assertEqual(len(found.best), 1)


class Proof(unittest.TestCase):
    def test_the_sum_of_three_disks(self):
        s = box(3)
        report = s.maximise_radii()
        found = jam.radii.prove(s, 60)
        self.assertLess(found.value_radius, Decimal(10) ** -60)
        self.assertLess(abs(float(found.value) - report.value), 1e-15)
        self.assertLess(abs(found.least_force), 1)
        with_less = jam.radii.prove(s, 30)
        self.assertLessEqual(abs(with_less.value - found.value), with_less.value_radius + found.value_radius)
        # decimals close the contacts: a pair to 4 d times the radius
        x, radius = found.positions, found.radii
        for i, j in s.contacts.pairs:
            if j >= 0:
                gap = sum((a - b) ** 2 for a, b in zip(x[i], x[j])) - (radius[i] + radius[j]) ** 2
                self.assertLess(abs(gap), 16 * found.radius + Decimal(10) ** -26)

    def test_what_has_no_proof_is_refused(self):
        wrong = jam.errors.StateError
        with self.assertRaisesRegex(wrong, "simple maxima"):  # two disks keep their sum along a line
            s = box(2)
            s.maximise_radii()
            jam.radii.prove(s)
        with self.assertRaisesRegex(wrong, "flat walls"):
            s = jam.System.random(n=12, dim=2, seed=1, container="ball", packing_fraction=0.3)
            s.compress()
            s.crunch()
            jam.radii.prove(s)
        with self.assertRaisesRegex(wrong, "no contact network"):
            jam.radii.prove(box(3))
        with self.assertRaisesRegex(ValueError, "digits is 10"):
            s = box(3)
            s.maximise_radii()
            jam.radii.prove(s, 10)
        s = box(3)
        s.maximise_radii()
        with self.assertRaisesRegex(wrong, "may pull"):  # no maximum of another sum
            jam.radii.prove(s, weights=[1, 1e-3, 1e-3])

