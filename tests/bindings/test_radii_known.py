"""Largest sums of radii and factors of moments that are known: closed values, lattices, and what other optimisers find."""
import unittest
from fractions import Fraction

import jam
import numpy as np
from radii_oracle import Programme, least_exact_gap

SQUARE, CUBE = {"dim": 2, "walls": "xy"}, {"dim": 3, "walls": "xyz"}
CIRCLE, BALL, TUBE = {"dim": 2, "container": "ball"}, {"dim": 3, "container": "ball"}, {"dim": 3, "container": "cylinder"}
TWO = 2 - 2**0.5  # of two disks in a square


class Sums(unittest.TestCase):
    def test_sums_that_are_algebraic(self):
        """Also of one disk that touches its images. Two spheres share a diameter; three equal disks touch each other and the circle."""
        for n, scene, value in (
            (1, SQUARE, 0.5), (2, SQUARE, TWO), (1, CUBE, 0.5), (2, CUBE, 3**0.5 / (1 + 3**0.5)), (2, CIRCLE, 0.5), (2, BALL, 0.5),
            (3, CIRCLE, 1.5 / (1 + 2 / 3**0.5)), (1, {"dim": 2, "cell": [[1.0, 0.0], [0.25, 2.0]]}, 0.5),
            (2, {**SQUARE, "box": 1e-6}, TWO * 1e-6), (2, {**SQUARE, "box": 3e4}, TWO * 3e4),
        ):
            for seed in (1, 2):
                report = jam.System.random(n=n, seed=seed, **scene).maximise_radii()
                self.assertTrue(report.maximum, scene)
                self.assertLess(abs(report.value / value - 1), 3e-14, scene)

    def test_a_sphere_that_fills_the_wall_is_named(self):
        for scene in (CIRCLE, BALL, TUBE, {**TUBE, "walls": "z"}):
            s = jam.System.random(n=1, seed=1, **scene)
            report = s.maximise_radii()
            self.assertEqual((report.maximum, s.calls[-1]["status"]), (False, "not_converged"))
            self.assertLess(abs(report.value - 0.5), 1e-12)
            self.assertGreaterEqual(least_exact_gap(s), 0)

    def test_a_symmetric_saddle_is_left(self):
        """In a row on a diameter forces balance, and no disk can grow; off the line their sum can."""
        for n, scene, least in ((2, {"walls": "xy"}, TWO - 1e-14), (4, {"container": "ball"}, 0.6)):
            x = np.c_[(np.arange(n) + 0.5) / n, np.full(n, 0.5)]
            report = jam.System.from_arrays(x, radii=0.5 / n, box=1.0, **scene).maximise_radii()
            self.assertTrue(report.maximum)
            self.assertGreater(report.saddles, 0)
            self.assertGreater(report.value, least)

    def test_no_other_method_finds_more(self):
        rng = np.random.default_rng(2)
        can = {**TUBE, "walls": "z"}
        for n, scene, edges, flat, axes in (
            (3, SQUARE, [1, 1], "xy", 0), (4, SQUARE, [1, 1], "xy", 0), (3, CIRCLE, [1, 1], "", 2), (5, CIRCLE, [1, 1], "", 2),
            (3, BALL, [1, 1, 1], "", 3), (4, BALL, [1, 1, 1], "", 3), (3, can, [1, 1, 1.3], "z", 2), (3, TUBE, [1, 1, 1.1], "", 2),
        ):
            ends = [jam.System.random(n=n, seed=seed, box=edges, **scene).maximise_radii() for seed in range(1, 13)]
            by = Programme(n, edges, flat, axes)
            most = max(by.sum_from(rng.uniform(0.2, 0.8, (n, len(edges))) * edges, 0.01 * np.ones(n)) for _ in range(12))
            self.assertLess(abs(max(r.value for r in ends if r.maximum) - most), 1e-8, (scene, n))


class FreeCell(unittest.TestCase):
    def test_one_sphere_finds_the_densest_lattice(self):
        for dim, radius, contacts in ((2, (1 / (2 * 3**0.5)) ** 0.5, 3), (3, 2 ** (-5 / 6), 6), (4, 2**-0.75, 12)):
            for cell in (np.eye(dim), np.diag([2.0] + [2.0 ** (-1 / (dim - 1))] * (dim - 1)), np.eye(dim) + 0.3 * np.tri(dim, k=-1)):
                s = jam.System.random(n=1, dim=dim, seed=1, cell=cell)
                report = s.maximise_radii(strain="free")
                self.assertTrue(report.maximum, (dim, report))
                self.assertLess(abs(report.value - radius), 1e-14)
                self.assertEqual(report.contacts, contacts)
                self.assertEqual(s.report.strictly_jammed.name, "YES")
                if dim == 4:
                    break

    def test_edges_alone_keep_right_angles_and_tilts_alone_edges(self):
        """The tilt of a cell of edges 1 that makes both lattice vectors and their difference widest is 1 / 2."""
        for dim, strain in ((2, "edges"), (3, "edges"), (2, "tilts")):
            s = jam.System.random(n=1, dim=dim, seed=1, cell=np.diag([1.7, 1 / 1.7, 1.0][:dim]) if strain == "edges" else np.eye(dim))
            report = s.maximise_radii(strain=strain)
            self.assertTrue(report.maximum)
            self.assertLess(abs(report.value - 0.5), 1e-14)
            np.testing.assert_allclose(np.diag(s.cell), 1, atol=1e-14)
            self.assertTrue(strain == "tilts" or not (s.cell - np.diag(np.diag(s.cell))).any())

    def test_few_disks_find_the_triangular_lattice(self):
        for n in (2, 3, 4, 7, 8):
            most = max(jam.System.random(n=n, dim=2, seed=k).maximise_radii(strain="free").value for k in range(1, 4))
            self.assertLess(abs(most - (n / 12**0.5) ** 0.5), 1e-14 * n)


class Moments(unittest.TestCase):
    def test_as_many_moments_as_spheres_are_a_crunch(self):
        s = jam.System.random(n=3, dim=2, walls="xy", seed=5, diameters=[0.7, 1.0, 1.3])  # roots that are far apart
        before = s.diameters.copy()
        report = s.maximise_radii(moments=(1, 2, 3))
        np.testing.assert_allclose(s.diameters / before, report.value, rtol=1e-13)
        crunched = s.copy().crunch()
        self.assertTrue(crunched.jammed)
        self.assertLess(abs(crunched.packing_fraction / report.packing_fraction - 1), 1e-12)

    def test_moments_are_exact_where_they_change_by_much(self):
        """Sums of negative powers fall to 1e-7 of those at the start; the fractions are exact."""
        s = jam.System.random(n=2, dim=2, walls="xy", seed=1, diameters=[1, 3.0], packing_fraction=0.01)
        before = s.diameters / 2
        report = s.maximise_radii(moments=(-6,))
        moment = [sum(Fraction(r) ** -6 for r in radii) for radii in (before, s.diameters / 2)]
        self.assertAlmostEqual(float(moment[1] / moment[0] * Fraction(report.value) ** 6 - 1), 0, 13)

    def test_a_bound_that_must_stop_a_radius(self):
        """Two disks keep R_1 + R_2 = 2 - sqrt(2), and a sum of cubes on that line is largest at its ends."""
        most = 0.4
        for seed in (1, 2, 3):
            s = jam.System.random(n=2, seed=seed, diameters=np.random.default_rng(seed).uniform(0.6, 1.4, 2), **SQUARE)
            before = (s.diameters**3).sum() / 8
            report = s.maximise_radii(moments=(3,), radius_max=most)
            self.assertEqual((report.maximum, report.at_bounds), (True, 1))
            self.assertLessEqual(s.diameters.max() / 2, most)
            self.assertLess(most - s.diameters.max() / 2, 1e-15)
            self.assertLess(abs(report.value - ((most**3 + (TWO - most) ** 3) / before) ** (1 / 3)), 1e-14)

    def test_equal_disks_with_one_moment(self):
        """On that line a sum of powers above 1 is least where radii are equal, one of powers below 1 largest."""
        for q, radii in ((2, (1.5 - 2**0.5, 0.5)), (3, (1.5 - 2**0.5, 0.5)), (0.5, [1 - 0.5**0.5] * 2), (-1, [1 - 0.5**0.5] * 2)):
            s = jam.System.from_arrays([[0.3, 0.3], [0.7, 0.7]], radii=0.2, box=1.0, walls="xy")
            self.assertTrue(s.maximise_radii(moments=(q,)).maximum)
            self.assertLess(abs(np.sort(s.diameters / 2) - radii).max(), 1e-7)
