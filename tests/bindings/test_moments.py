"""Radii that move while moments keep their ratios: known factors, exact moments, forces as certificate, another solver, bad input."""
import unittest
from fractions import Fraction

import numpy as np
from scipy.optimize import linprog, minimize

import jam
from test_radii import box, least_exact_gap, rows_of

SCENES = (  # n, dim, axes with walls, exponents
    (4, 2, "xy", (1, 2)), (12, 2, "xy", (1, 2, 3)), (25, 2, "x", (1, 2)), (30, 2, "", (1, 2, 3)), (24, 2, "", (-1, 0.5, 2.5)),
    (20, 3, "z", (1, 2, 3)), (30, 3, "", (1, 2, 3)), (16, 3, "xyz", (3, 1)), (40, 2, "", (1, 2, 3, 4)),
)


def mixture(n, dim, walls="", seed=1, **more):
    sizes = np.random.default_rng(seed).uniform(0.6, 1.4, n)
    return jam.System.random(n=n, dim=dim, seed=seed, diameters=sizes, **({"walls": walls} if walls else {}), **more)


def ended():
    """(system, radii before, exponents, report) of each scene."""
    for n, dim, walls, exponents in SCENES:
        s = mixture(n, dim, walls, seed=3)
        before = s.diameters / 2
        yield s, before, exponents, s.maximise_radii(moments=exponents)


def multipliers(report, exponents):
    return np.array([getattr(report, f"multiplier_{k}") for k in range(1, len(exponents) + 1)])


class Known(unittest.TestCase):
    def test_two_disks_and_two_moments_keep_their_ratio(self):
        """On the diagonal of the square R_1 + R_2 = 2 - sqrt(2), whatever the ratio."""
        for seed in range(1, 5):
            s = mixture(2, 2, "xy", seed)
            before = s.diameters.copy()
            report = s.maximise_radii(moments=(1, 2))
            self.assertTrue(report.maximum)
            self.assertLess(abs(report.value * before.sum() / 2 - (2 - 2**0.5)), 1e-14)
            np.testing.assert_allclose(s.diameters / before, report.value, rtol=1e-14)

    def test_one_disk(self):
        for q in (-2, 0.5, 3):
            s = box(1)
            before = s.diameters[0] / 2
            self.assertLess(abs(s.maximise_radii(moments=[q]).value - 0.5 / before), 1e-13 / before)

    def test_as_many_moments_as_spheres_are_a_crunch(self):
        s = jam.System.random(n=3, dim=2, walls="xy", seed=5, diameters=[0.7, 1.0, 1.3])  # roots that are far apart
        before = s.diameters.copy()
        report = s.maximise_radii(moments=(1, 2, 3))
        np.testing.assert_allclose(s.diameters / before, report.value, rtol=1e-13)
        crunched = s.copy().crunch()
        self.assertTrue(crunched.jammed)
        self.assertLess(abs(crunched.packing_fraction / report.packing_fraction - 1), 1e-12)

    def test_the_first_moment_alone_is_the_sum(self):
        by_sum, by_moment = box(12, seed=4), box(12, seed=4)
        before = by_sum.diameters.sum() / 2
        by_sum.maximise_radii()
        self.assertLess(abs(by_moment.maximise_radii(moments=[1]).value * before / by_sum.diameters.sum() * 2 - 1), 1e-13)

    def test_no_other_method_finds_more_nearby(self):
        """Sequential quadratic programming from the end moved a little: positions, radii, ln lambda."""
        n = 4
        s = mixture(n, 2, "xy", 3)
        before = s.diameters / 2
        report = s.maximise_radii(moments=(1, 2))
        pairs = [(i, j) for i in range(n) for j in range(i)]

        def gaps(v):
            u = v[:-1].reshape(n, 3)
            apart = [np.hypot(*(u[i, :2] - u[j, :2])) - u[i, 2] - u[j, 2] for i, j in pairs]
            return np.concatenate([apart, (u[:, :2] - u[:, 2:]).ravel(), (1 - u[:, :2] - u[:, 2:]).ravel(), u[:, 2]])

        def kept(v):
            radii = v[:-1].reshape(n, 3)[:, 2]
            return [np.log((radii**q).sum() / (before**q).sum()) / q - v[-1] for q in (1, 2)]

        end = np.append(np.c_[s.positions, s.diameters / 2].ravel(), np.log(report.value))
        rng, most = np.random.default_rng(2), 0.0
        rules = [{"type": "ineq", "fun": gaps}, {"type": "eq", "fun": kept}]
        for _ in range(10):
            made = minimize(lambda v: -v[-1], end + 0.01 * rng.normal(size=end.size), constraints=rules, method="SLSQP")
            if made.success and gaps(made.x).min() > -1e-9 and abs(made.x - end).max() < 0.03:
                most = max(most, made.x[-1])
        self.assertLess(abs(most - end[-1]), 1e-6)


class Maximum(unittest.TestCase):
    def test_moments_are_exact_and_nothing_overlaps(self):
        for s, before, exponents, report in ended():
            self.assertTrue(report.maximum, (exponents, report))
            radii = s.diameters / 2
            for q in exponents:
                self.assertLess(abs((radii**q).sum() / (before**q).sum() / report.value**q - 1), 1e-14)
            self.assertLess(report.moment_residual, 1e-14)
            self.assertGreaterEqual(least_exact_gap(s), 0)
            self.assertLess(report.max_contact_gap, 1e-14)
            self.assertTrue(s.report.jammed)

    def test_moments_are_exact_where_they_change_by_much(self):
        """Sums of negative powers fall to 1e-7 of those at the start; the fractions are exact."""
        s = jam.System.random(n=2, dim=2, walls="xy", seed=1, diameters=[1, 3.0], packing_fraction=0.01)
        before = s.diameters / 2
        report = s.maximise_radii(moments=(-6,))
        moment = [sum(Fraction(r) ** -6 for r in radii) for radii in (before, s.diameters / 2)]
        self.assertAlmostEqual(float(moment[1] / moment[0] * Fraction(report.value) ** 6 - 1), 0, 13)

    def test_as_many_contacts_as_unknowns(self):
        """d (n - 1) + 1 + n - m in a periodic cell; a sphere without contacts leaves out its d displacements."""
        for s, _, exponents, report in ended():
            free = s.dim - len({axis for axis, _ in zip(s.walls().axis, s.walls().side)}) if len(s.walls()) else s.dim
            count = (s.dim + 1) * s.n - free + 1 - len(exponents) - s.dim * report.rattlers - report.at_bounds
            self.assertEqual(report.contacts - report.excess - s.dim * report.rattlers, count)
            self.assertLessEqual(report.excess, 0)
            self.assertGreaterEqual(report.excess, -s.dim * report.rattlers - 1)  # 1: where moments curve
            self.assertLess(report.rattlers, len(exponents))

    def test_forces_on_a_sphere_follow_from_the_multipliers(self):
        for s, _, exponents, report in ended():
            radii, sums = s.diameters / 2, np.zeros(s.n)
            for (i, j), f in zip(s.contacts.pairs, s.forces):
                sums[i] += f
                if j >= 0:
                    sums[j] += f
            carried = sum(m * q * radii ** (q - 1) for m, q in zip(multipliers(report, exponents), exponents))
            sums *= report.min_force / s.forces.min()  # forces of the network have mean 1
            self.assertLess(abs(sums - carried).max() / abs(carried).mean(), 1e-9)
            whole = sum(m * q * (radii**q).sum() for m, q in zip(multipliers(report, exponents), exponents))
            self.assertLess(abs(whole / report.value - 1), 1e-12)

    def test_another_solver_finds_no_ascent(self):
        """HiGHS on rows and moments linear in displacements, radii and ln lambda."""
        for s, _, exponents, _ in ended():
            a, c = rows_of(s, 0.1)
            radii = s.diameters / 2
            same = np.zeros((len(exponents), s.n, s.dim + 1))
            for k, q in enumerate(exponents):
                same[k, :, -1] = radii ** (q - 1) / (radii**q).sum()
            same = np.c_[same.reshape(len(exponents), -1), -np.ones(len(exponents))]
            cost = np.zeros(a.shape[1] + 1)
            cost[-1] = -1.0
            answer = linprog(cost, A_ub=np.c_[-a, np.zeros(len(a))], b_ub=np.maximum(c, 0.0), A_eq=same, b_eq=np.zeros(len(exponents)),
                             bounds=(-1e-3, 1e-3), method="highs")
            self.assertEqual(answer.status, 0)
            self.assertLess(-answer.fun, 1e-8)

    def test_numbering_and_units_do_not_matter(self):
        n, exponents = 10, (1, 2, 3)
        s = mixture(n, 2, "xy", 7)
        x, d = s.positions.copy(), s.diameters.copy()
        value = s.maximise_radii(moments=exponents).value
        order = np.random.default_rng(1).permutation(n)
        other = jam.System.from_arrays(x[order], diameters=d[order], box=1.0, walls="xy")
        self.assertLess(abs(other.maximise_radii(moments=exponents).value / value - 1), 1e-12)
        np.testing.assert_allclose(other.diameters, s.diameters[order], rtol=1e-9)
        for unit in (1e-6, 300.0):
            other = jam.System.from_arrays(unit * x, diameters=unit * d, box=unit, walls="xy")
            self.assertLess(abs(other.maximise_radii(moments=exponents).value / value - 1), 1e-12)

    def test_a_bound_that_must_stop_a_radius(self):
        """Two disks keep R_1 + R_2 = 2 - sqrt(2), and a sum of cubes on that line is largest at its ends."""
        both, most = 2 - 2**0.5, 0.4
        for seed in (1, 2, 3):
            s = mixture(2, 2, "xy", seed)
            before = (s.diameters**3).sum() / 8
            report = s.maximise_radii(moments=(3,), radius_max=most)
            self.assertEqual((report.maximum, report.at_bounds), (True, 1))
            self.assertLessEqual(s.diameters.max() / 2, most)
            self.assertLess(most - s.diameters.max() / 2, 1e-15)
            self.assertLess(abs(report.value - ((most**3 + (both - most) ** 3) / before) ** (1 / 3)), 1e-14)

    def test_equal_disks_with_one_moment(self):
        """On that line a sum of powers above 1 is least where radii are equal, one of powers below 1 largest."""
        for q, radii in ((2, (1.5 - 2**0.5, 0.5)), (3, (1.5 - 2**0.5, 0.5)), (0.5, [1 - 0.5**0.5] * 2), (-1, [1 - 0.5**0.5] * 2)):
            s = jam.System.from_arrays([[0.3, 0.3], [0.7, 0.7]], radii=0.2, box=1.0, walls="xy")
            self.assertTrue(s.maximise_radii(moments=(q,)).maximum)
            self.assertLess(abs(np.sort(s.diameters / 2) - radii).max(), 1e-7)

    def test_bounds_are_kept_and_counted(self):
        for seed in (1, 4, 5, 7):
            free, s = mixture(30, 2, "", seed), mixture(30, 2, "", seed)
            before = s.diameters / 2
            free.maximise_radii(moments=(1, 2))
            most = 0.97 * free.diameters.max() / 2
            report = s.maximise_radii(moments=(1, 2), radius_max=most)
            self.assertTrue(report.maximum)
            self.assertEqual(int(np.sum(abs(s.diameters / 2 - most) < 1e-14)), report.at_bounds)
            self.assertLessEqual(s.diameters.max() / 2, most)
            for q in (1, 2):
                self.assertLess(abs(((s.diameters / 2) ** q).sum() / (before**q).sum() / report.value**q - 1), 1e-14)

    def test_a_stopped_call_keeps_moments(self):
        s = mixture(30, 2, "", 2)
        before = s.diameters / 2
        report = s.maximise_radii(moments=(1, 2, 3), max_steps=7)
        self.assertFalse(report.maximum)
        self.assertTrue(np.isnan(report.multiplier_1))
        for q in (1, 2, 3):
            self.assertLess(abs(((s.diameters / 2) ** q).sum() / (before**q).sum() / report.value**q - 1), 1e-14)
        self.assertGreater(least_exact_gap(s), 0)


class Refused(unittest.TestCase):
    def refused(self, text, *given, system=None, **options):
        s = mixture(6, 2, "xy") if system is None else system
        before = s.positions.copy(), s.diameters.copy()
        with self.assertRaisesRegex(jam.errors.ArgumentError, text):
            s.maximise_radii(*given, **options)
        np.testing.assert_array_equal(s.positions, before[0])
        np.testing.assert_array_equal(s.diameters, before[1])

    def test_bad_input_moves_nothing(self):
        self.refused("exponent_1 is 2 and exponent_3 2: nearer than 0.001 they count as one moment twice", moments=(2, 1, 2))
        self.refused("exponent_2 is 0, .* the number of spheres", moments=(1, 0))
        self.refused("exponent_1 is 9, its size must be 0.001 to 8", moments=[9])
        with self.assertRaisesRegex(ValueError, "moments has 5 exponents, one to four are possible"):
            mixture(6, 2, "xy").maximise_radii(moments=(1, 2, 3, 4, 5))
        self.refused("weights and moments", np.ones(6), moments=(1, 2))
        self.refused("radius_min 0.5 and radius_max inf", moments=(1, 2), radius_min=0.5)
        self.refused("not between radius_min", moments=(1, 2), radius_max=1e-3)
        self.refused("too alike for 2 moments", system=box(6), moments=(1, 2))
        two = jam.System.random(n=6, dim=2, walls="xy", seed=1, diameters=[1, 1, 1, 1.4, 1.4, 1.4])
        self.refused("too alike for 3 moments.* at least 3 values", system=two, moments=(1, 2, 3))
