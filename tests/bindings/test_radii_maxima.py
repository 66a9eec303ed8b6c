"""Maxima of the sum of radii, and of moments that keep their ratios, in fixed and free cells and within walls: exact gaps,
counts of contacts, forces, and HiGHS, which finds no ascent."""
import unittest

import jam
import numpy as np
from radii_oracle import ascent, closed_by, least_exact_gap, open_axes, strains

CIRCLE, BALL, TUBE = {"dim": 2, "container": "ball"}, {"container": "ball"}, {"container": "cylinder"}
CAN = {**TUBE, "walls": "z"}
SCENES = (  # spheres, scene, exponents of moments, whether the cell deforms
    (1, {"dim": 2, "walls": "xy"}, None, False), (7, {"dim": 2, "walls": "x"}, None, False), (16, {"walls": "xyz"}, None, False),
    (12, {"dim": 2, "walls": "xy", "cell": [1, 0.4]}, None, False), (10, {"dim": 2, "cell": [[1, 0], [0.3, 0.8]]}, None, False),
    (9, {}, None, False), (40, {"dim": 2, "walls": "xy"}, None, False),
    (7, CIRCLE, None, False), (30, CIRCLE, None, False), (8, BALL, None, False), (20, BALL, None, False), (10, CAN, None, False),
    (9, {**TUBE, "box": [1, 1, 2]}, None, False), (16, {**TUBE, "box": [1, 1, 1.4]}, None, False),
    (2, {"dim": 2}, None, True), (12, {"dim": 2}, None, True), (8, {}, None, True), (12, {"walls": "z"}, None, True),
    (4, {"dim": 2, "walls": "xy"}, (1, 2), False), (25, {"dim": 2, "walls": "x"}, (1, 2), False), (24, {"dim": 2}, (-1, 0.5, 2.5), False),
    (20, {"walls": "z"}, (1, 2, 3), False), (16, {"walls": "xyz"}, (3, 1), False), (40, {"dim": 2}, (1, 2, 3, 4), False),
    (12, CIRCLE, (1, 2, 3), False), (12, BALL, (1, 2), False), (10, CAN, (1, 2, 3), False), (12, {**TUBE, "box": [1, 1, 1.5]}, (1, 2), False),
    (30, {"dim": 2}, (1, 2, 3), True), (16, {"walls": "x"}, (1, 2), True), (24, {"dim": 2}, (-1, 0.5, 2.5), True),
)  # fmt: skip


class Maxima(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = []
        for n, scene, moments, free in SCENES:
            sizes = {"diameters": np.random.default_rng(3).uniform(0.6, 1.4, n)} if moments else {}
            s = jam.System.random(n=n, seed=3, **{"dim": 3, **scene}, **sizes)
            before = s.diameters / 2, s.cell.copy()
            cls.made.append((s, before, s.maximise_radii(moments=moments, strain="free" if free else "none"), moments, free))

    def each(self, check):
        for scene, made in zip(SCENES, self.made):
            with self.subTest(scene=scene):
                check(*made)

    def test_nothing_overlaps_in_exact_numbers(self):
        def check(s, before, report, moments, free):
            self.assertTrue(report.maximum, report)
            self.assertGreaterEqual(least_exact_gap(s), 0)
            self.assertLess(report.max_contact_gap, 1e-14)
            self.assertLess(report.balance_residual, 1e-10 if closed_by(s)[1] else 1e-12)
            self.assertGreater(report.min_force, 0)
            self.assertTrue(s.report.jammed or closed_by(s)[1])

        self.each(check)

    def test_sums_and_moments_are_exact(self):
        def check(s, before, report, moments, free):
            radii = s.diameters / 2
            if not moments:
                self.assertLess(abs(report.value - radii.sum()), 1e-14 * s.n)
            for q in moments or ():
                self.assertLess(abs((radii**q).sum() / (before[0]**q).sum() / report.value**q - 1), 1e-14)

        self.each(check)

    def test_volume_and_closed_axes_are_those_of_the_start(self):
        def check(s, before, report, moments, free):
            if not free:
                np.testing.assert_array_equal(s.cell, before[1])
                return
            self.assertLess(abs(np.prod(np.diag(s.cell)) - 1), 1e-14)
            for a in closed_by(s)[0]:
                self.assertEqual((s.cell[a, a], abs(s.cell[a]).sum(), abs(s.cell[:, a]).sum()), (1.0, 1.0, 1.0))
            self.assertEqual(s.report.strictly_jammed.name, "YES")

        self.each(check)

    def test_contacts_are_as_many_as_unknowns(self):
        """Of these translations and rotations change nothing; a sphere without contacts leaves out its d displacements, and moments
        may curve. In a round wall its bend alone stops some motions."""

        def check(s, before, report, moments, free):
            rotations = {0: 0, 2: 1, 3: 3}[closed_by(s)[1]]
            unknowns = (s.dim + 1) * s.n - len(open_axes(s)) - rotations - (len(moments) - 1 if moments else 0)
            unknowns += len(strains(s)) if free else 0
            self.assertEqual(report.excess, report.contacts + report.at_bounds - unknowns)
            self.assertLess(report.rattlers, len(moments or (1,)))
            if not rotations:
                self.assertGreaterEqual(report.excess, -s.dim * report.rattlers - 1)

        self.each(check)

    def test_forces_are_those_of_the_multipliers(self):
        """On a sphere they add up to its weight, 1, or with moments to sum_q lambda_q q R^(q - 1); those of a free cell press alike."""

        def check(s, before, report, moments, free):
            radii, sums, stress = s.diameters / 2, np.zeros(s.n), np.zeros((s.dim, s.dim))
            for (i, j), u, f in zip(s.contacts.pairs, s.contacts.vectors, s.forces * report.min_force / s.forces.min()):
                sums[i] += f
                if j >= 0:  # walls press along closed axes alone
                    sums[j] += f
                    stress += f * (radii[i] + radii[j]) * np.outer(u, u)
            found = [getattr(report, f"multiplier_{k + 1}") for k in range(len(moments or ()))]
            carried = sum(m * q * radii ** (q - 1) for m, q in zip(found, moments)) if moments else np.ones(s.n)
            self.assertLess(abs(sums - carried).max() / abs(carried).mean(), 1e-9)
            if moments:
                self.assertLess(abs(carried @ radii / report.value - 1), 1e-12)
            if free:
                stress = stress[np.ix_(open_axes(s), open_axes(s))]
                self.assertLess(abs(stress / np.trace(stress) * len(stress) - np.eye(len(stress))).max(), 1e-11)

        self.each(check)

    def test_another_solver_finds_no_ascent(self):
        self.each(lambda s, before, report, moments, free: self.assertLess(ascent(s, moments, strains(s) if free else []), 1e-8))


class RoundWalls(unittest.TestCase):
    """What linear rows do not see: the bend of the wall."""

    def test_maps_of_a_circle_onto_itself_keep_contacts(self):
        """Moebius maps: two motions beside the rotation, which only the bend of the wall stops: 3 n - 3 contacts."""
        for n in (5, 7, 12, 30):
            report = jam.System.random(n=n, seed=1, **CIRCLE).maximise_radii()
            self.assertEqual((report.contacts, report.excess), (3 * n - 3, -2))

    def test_sizes_that_spread_too_wide_are_named(self):
        """Disks whose weights are almost 0 fill ever smaller holes."""
        ends = set()
        for seed in range(4):
            for n in (12, 30):
                s = jam.System.random(n=n, seed=seed, **CIRCLE)
                report = s.maximise_radii(10.0 ** np.random.default_rng(seed).uniform(-14, 0, n))
                self.assertLessEqual(s.diameters.max() / s.diameters.min(), 1e4)
                self.assertGreaterEqual(least_exact_gap(s), 0)
                ends.add((report.maximum, s.calls[-1]["status"]))
        self.assertLessEqual(ends, {(False, "not_converged"), (True, "ok")})
