"""Soft spheres in containers: energy, forces and Hessian against numpy, known minima, and down to the jamming point.

The energy is a sum over pairs and walls that is written here anew, from positions alone.
"""
import itertools
import unittest

import jam
import numpy as np
from wall_scenes import SCENES, energy, overlaps, start

ALPHAS = {"relative": 2.0, "absolute": 2.5, "bare": 1.5}


def soft(name, n, seed, phi, unequal=True):
    return start(name, n, seed, phi, unequal=unequal, overlap="allow")


def dense(name):
    return 1.0 if SCENES[name].get("dim") == 2 else 0.8


class Minima(unittest.TestCase):
    def test_energy_and_balance_agree_with_numpy(self):
        for name in SCENES:
            for scale, alpha in ALPHAS.items():
                with self.subTest(name, scale=scale):
                    s = soft(name, 24, 3, dense(name))
                    r = s.relax(scale=scale, alpha=alpha)
                    self.assertTrue(r.converged and r.contacts > 0)
                    at = lambda x: energy(SCENES[name], x, s, scale, alpha)
                    self.assertAlmostEqual(at(s.positions) / r.energy, 1, 10)
                    # Every displacement changes the energy at second order alone.
                    u = np.random.default_rng(1).normal(size=(8,) + s.positions.shape)
                    step = 1e-6 * s.diameters.mean()
                    # Contacts that are open by less than the step change sides: an error of step^alpha each.
                    limit = 1e-9 * r.energy / step + s.n * step ** (alpha - 1)
                    for v in u:
                        slope = (at(s.positions + step * v) - at(s.positions - step * v)) / (2 * step)
                        self.assertLess(abs(slope), limit)
                        # against the same sum at a place that is no minimum
                        far = s.positions + 0.01 * s.diameters.mean() * v
                        slope = (at(far + step * v) - at(far - step * v)) / (2 * step)
                        self.assertGreater(abs(slope), limit)

    def test_contacts_and_forces_are_those_of_the_overlaps(self):
        for name in SCENES:
            s = soft(name, 30, 2, dense(name))
            s.relax()
            delta, sigma, i, j = overlaps(SCENES[name], s.positions, s)
            stable, c = ~np.asarray(s.rattlers, bool), s.contacts
            on = (delta > 0) & stable[i] & ((j < 0) | stable[j])
            expected = sorted(zip(i[on], j[on], delta[on] / sigma[on] ** 2))
            got = sorted(zip(*c.pairs.T, s.forces))
            self.assertEqual([e[:2] for e in expected], [g[:2] for g in got], name)
            f = np.array([e[2] for e in expected])
            np.testing.assert_allclose([g[2] for g in got], f / f.mean(), rtol=1e-8)
            self.assertTrue((c.pairs[:, 1] < 0).any())

    def test_hessian_is_the_second_difference_of_the_energy(self):
        for name, alpha in itertools.product(SCENES, (2.0, 2.5)):
            s = soft(name, 20, 5, dense(name))
            s.relax(alpha=alpha)
            spheres = s.hessian_map()
            h = s.hessian(stiffness="soft", prestress=1.0)
            u = np.random.default_rng(2).normal(size=(len(spheres), s.dim))
            step = 1e-5 * s.diameters.mean()
            x = [s.positions.copy() for _ in range(3)]
            for k in (0, 2):
                x[k][spheres] += (k - 1) * step * u
            low, middle, high = (energy(SCENES[name], y, s, alpha=alpha) for y in x)
            second = (low + high - 2 * middle) / step**2
            self.assertAlmostEqual(u.ravel() @ (h @ u.ravel()) / second, 1, 3, (name, alpha))
            self.assertGreater(s.modes(k=2, stiffness="soft", prestress=1.0).values[0], 0)

    def test_walls_of_many_dimensions(self):
        s = jam.System.random(n=60, dim=4, seed=1, packing_fraction=0.7, walls=(1, 0, 1, 0), overlap="allow")
        r = s.relax()
        with self.assertRaisesRegex(jam.errors.UnsupportedError, "d = 2 and 3"):  # histograms, before the run
            s.call("observe", r_bins=10)
        self.assertAlmostEqual(energy({"walls": "xz"}, s.positions, s) / r.energy, 1, 10)
        self.assertTrue(r.converged)

    def test_the_unit_of_length_changes_no_bit(self):
        unit = 2.0**60
        for name in ("strip", "tube"):
            near = soft(name, 24, 3, dense(name))
            scene = dict(SCENES[name], cell=unit * near.cell)
            scene.pop("dim", None)
            far = jam.System.from_arrays(unit * near.positions, unit * near.diameters, overlap="allow", **scene)
            near.relax(), far.relax()
            np.testing.assert_array_equal(far.positions, unit * near.positions)


class Tolerance(unittest.TestCase):
    def test_what_balances_roughly_is_kept(self):
        """Mixtures of 1:100, whose last balance Newton's method left again from a residual of 1e-2."""
        for seed in (9, 21, 22):
            for tolerance in (1e-2, 1e-4):
                s = jam.System.random(60, 2, packing_fraction=1.1, overlap="allow", diameters=100 ** np.linspace(0, 1, 60), seed=seed, walls="x")
                r = s.relax(force_tolerance=tolerance)
                self.assertTrue(r.converged, str(r))
                self.assertLess(r.force_residual, tolerance)

    def test_a_descent_goes_on_below_a_loose_tolerance(self):
        """Free cells whose contacts change after the descent, so that neither it nor Newton's method met the tolerance."""
        for n, pressure, seed, tolerance in ((128, 1e-6, 15, 0.1), (256, 1e-4, 14, 0.1), (256, 1e-5, 1, 1e-3)):
            s = jam.System.random(n, seed=seed, packing_fraction=0.7, overlap="allow")
            bulk = pressure / s.diameters[0] ** 3
            s.relax(strain="all", pressure=1.5 * bulk, force_tolerance=1e-6)
            r = s.relax(strain="all", pressure=bulk, force_tolerance=tolerance)
            self.assertTrue(r.converged, str(r))


class Known(unittest.TestCase):
    def test_two_disks_and_two_balls_rest_on_a_diameter(self):
        # a radius, x distance from the centre: (a - 1/2 + x) / a^2 = (2 a - 2 x) / (4 a^2), so x = (1 - a) / 3.
        for name, phi in (("circle", 0.55), ("ball", 0.3)):
            s = soft(name, 2, 1, phi, unequal=False)
            r = s.relax()
            a, centre = s.diameters[0] / 2, s.positions - 0.5
            self.assertTrue(r.converged)
            np.testing.assert_allclose(np.linalg.norm(centre, axis=1), (1 - a) / 3, rtol=1e-12)
            np.testing.assert_allclose(centre.sum(0), 0, atol=1e-12)
            self.assertEqual((r.contacts, r.rattlers), (3, 0))


class Pressure(unittest.TestCase):
    def test_walls_carry_the_pressure_of_the_virial(self):
        for name in SCENES:
            s = soft(name, 40, 4, dense(name))
            r = s.relax(scale="absolute")
            delta, sigma, i, j = overlaps(SCENES[name], s.positions, s)
            on = delta > 0
            self.assertAlmostEqual((delta[on] * (sigma - delta)[on]).sum() / (s.dim * s.info.volume) / r.pressure, 1, 9)
            w = s.walls()
            for k in range(len(w.area)):
                mine = on & (j == -1 - k)
                self.assertAlmostEqual(delta[mine].sum() / w.area[k] / r.pressure / w.stress[k], 1, 8, name)
            if name == "ball" or name == "circle":  # one wall bears all
                self.assertAlmostEqual(w.stress[0], 1, 10)
            if name in ("box", "brick"):  # the mean over axes, weighted by nothing: each axis has P_aa
                self.assertAlmostEqual(w.stress.mean(), 1, 10)
                np.testing.assert_allclose(w.stress[::2], w.stress[1::2], rtol=1e-9)


class Jamming(unittest.TestCase):
    def test_decompression_ends_at_the_jamming_point_of_a_crunch(self):
        for name in SCENES:
            with self.subTest(name):
                s = soft(name, 30, 7, dense(name))
                soft_forces = s.copy()
                r = s.decompress()
                self.assertEqual((r.same_network, s.check().jammed), (1, 1))
                # the last overlaps explain the difference of both densities
                self.assertLess(abs(r.jammed_fraction / r.crunch_fraction - 1), max(1e-12, s.dim * r.distance))
                # Forces change in proportion to the distance, and differ from the jammed ones by what is left of it.
                far, near = (soft_forces.copy().decompress(isostatic=False, distance=x).force_difference for x in (1e-6, 1e-8))
                self.assertLess(near, max(1e-6, 0.05 * far))
