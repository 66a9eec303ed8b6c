"""Analysis calls from Python: hessian, modes, and the methods that are made from the header."""
import inspect
import unittest

import numpy as np

import jam
from wall_scenes import contact_rows


class Network(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.s = jam.System.random(n=60, dim=2, seed=3, diameters=[1.0, 1.4] * 30)
        cls.r = cls.s.crunch()

    def test_the_median_of_a_floppy_mode_is_that_of_numpy(self):
        stable = []
        for sizes in ([1.0] * 60 + [3.0] * 20, [1.0] * 32 + [1.4] * 32):
            s = jam.System.random(n=len(sizes), dim=3, seed=5, diameters=sizes)
            s.compress()
            s.crunch()
            table = s.floppy_modes()
            for k in range(3):
                size = np.linalg.norm(s.floppy_mode(k), axis=1)
                self.assertAlmostEqual(table.median[k] * np.linalg.norm(size) / np.median(size), 1.0, 10)
                self.assertAlmostEqual(table.weight[k] * np.median(size) / s.forces[k], 1.0, 6)
            stable.append(len(size))
        self.assertIn(0, [n % 2 for n in stable])

    def test_hessian_is_the_contact_matrix_squared(self):
        s, c = self.s, self.s.contacts
        a = contact_rows(s)[0][:, (2 * s.hessian_map()[:, None] + [0, 1]).ravel()]
        np.testing.assert_allclose(s.hessian().toarray(), a.T @ a, atol=1e-12)
        hard = s.hessian("hard").toarray()
        np.testing.assert_allclose(hard, a.T @ (c.forces[:, None] ** 2 * a), atol=1e-10)

    def test_modes(self):
        s, h = self.s, self.s.hessian()
        every, low = s.modes(which="all"), s.modes(5)
        self.assertEqual((len(every), len(low), low.status), (2 * self.r.stable, 5, 0))
        np.testing.assert_allclose(every.values, np.linalg.eigvalsh(h.toarray()), atol=1e-10)
        np.testing.assert_allclose(low.values, every.values[2:7], atol=1e-9)
        v = low.vectors.reshape(5, -1)
        np.testing.assert_allclose(h @ v.T, v.T * low.values, atol=1e-7)
        np.testing.assert_allclose(low.participation, (low.vectors**2).sum(2).__pow__(2).sum(1), rtol=1e-9)
        with self.assertRaises(ValueError):
            s.modes(which="some")
        with self.assertRaisesRegex(TypeError, "as k"):
            s.modes(count=5)

    def test_distributions(self):
        s, r = self.s, self.r
        local, extended = s.local_values("force", "localised"), s.local_values("force", "extended")
        flags = s.contact_classes()
        self.assertEqual(len(local), (flags & 1 != 0).sum())
        np.testing.assert_allclose(local, s.forces[flags & 1 != 0] / s.forces[flags & 1 != 0].mean(), rtol=1e-12)
        self.assertAlmostEqual(extended.mean(), 1, 12)
        z = s.local_values("coordination", "all")
        self.assertEqual((len(z), z.sum()), (r.stable, 2 * r.contacts))
        np.testing.assert_allclose(s.local_values("vector_dot", "all"), s.contact_dots(weighted=0).dot, rtol=1e-12)

    def test_made_methods(self):
        s, r = self.s, self.r
        gap, pair = s.gaps(1.0, True)
        self.assertEqual(pair.shape, (len(gap), 2))
        made = s.sphere_structure(weighted=True)
        self.assertEqual((made.c.shape, made.s.shape), ((s.n, 2), (s.n,)))
        self.assertEqual(len(s.contact_classes()), r.contacts)
        floppy = s.floppy_modes()
        self.assertEqual(len(floppy.s_plus), r.contacts)
        self.assertEqual(s.floppy_mode(3).shape, (r.stable, 2))
        g = s.pair_correlation(2.0, 30)
        self.assertEqual(len(g), 30)
        kinds = np.arange(s.n) % 2
        self.assertTrue((s.pair_correlation(2.0, 30, kind=kinds, a=0, b=1) != g).any())
        moduli, tensor = s.moduli(), s.elastic_tensor()
        self.assertEqual(tensor.relaxed.shape, (s.dim,) * 4)
        self.assertAlmostEqual(np.einsum("iijj", tensor.relaxed) / s.dim**2, moduli.bulk)
        self.assertIn("bulk_affine", repr(moduli))
        self.assertEqual(len(s.density_of_states(points=50, vectors=8).omega), 50)
        force, basis, _ = s.stress_states()
        np.testing.assert_allclose(force, s.forces, atol=1e-8)
        self.assertEqual(basis.shape, (1, r.contacts))
        loose = jam.System.random(5, 2, 1, packing_fraction=0.15)
        loose.compress(pressure=100.0)
        loose.contacts_from_geometry(tolerance=0.01)  # a network without a state of self-stress
        force, basis, residual = loose.stress_states()
        contacts = loose.report.contacts
        self.assertEqual((force.tolist(), basis.shape, residual), ([0.0] * contacts, (0, contacts), 0.0))
        comparison, moved = s.compare(s.copy())
        self.assertEqual((comparison.overlap, np.abs(moved).max()), (1.0, 0.0))
        other = jam.System.random(s.n, s.dim, 9, packing_fraction=0.3)
        other.crunch()
        c, _ = s.compare(other)
        self.assertEqual(c.overlap_a, c.common_contacts / c.contacts_a)
        self.assertNotEqual(c.overlap_a, c.overlap)

    def test_order_by_the_pair_correlation(self):
        cube = np.indices((4, 4, 4)).reshape(3, -1).T
        sites = np.concatenate([cube + shift for shift in ([0, 0, 0], [0, 0.5, 0.5], [0.5, 0, 0.5], [0.5, 0.5, 0])])
        self.assertGreater(jam.System.from_arrays(sites, 0.7, box=4).crystal_score(), 5)
        self.assertLess(jam.System.random(2000, 3, 1, packing_fraction=0.3).crystal_score(), 1.5)

    def test_minima_of_a_fixed_cell_may_be_unstable_against_shear(self):
        """As the page on soft spheres says. A minimum in all strains has no negative modulus."""
        fixed, free = [], []
        for seed in range(1, 9):
            s = jam.System.random(n=16, dim=2, seed=seed, packing_fraction=0.87, diameters=[1.0] * 8 + [1.4] * 8, overlap="allow")
            pressure = s.relax().pressure
            self.assertGreater(pressure, 0.0)
            fixed.append(s.moduli(stiffness="soft", prestress=1.0).shear)
            self.assertTrue(s.relax(strain="all", pressure=pressure).converged)
            free.append(s.moduli(stiffness="soft", prestress=1.0).shear)
        self.assertLess(min(fixed), 0.0)
        self.assertGreater(min(free), 0.0)

    def test_wrong_calls(self):
        with self.assertRaisesRegex(TypeError, "cutoff"):
            self.s.bond_order(6)
        np.testing.assert_array_equal(self.s.gaps().gap, self.s.gaps(1.0, True).gap)
        with self.assertRaisesRegex(TypeError, "h_max"):
            self.s.call("gaps", stable_only=1)
        with self.assertRaisesRegex(TypeError, "stifness"):
            self.s.moduli(stifness="hard")
        with self.assertRaises(jam.errors.ArgumentError):
            self.s.floppy_mode(len(self.s.forces))
        with self.assertRaises(jam.errors.ArgumentError):
            self.s.prove([1.0] * self.s.n, strict=True)
        for setter in (self.s.add_note, self.s.set_memory_limit, self.s.stop_observing):
            self.assertNotIn("progress", inspect.signature(setter).parameters)  # nothing that takes long
        with self.assertRaises(jam.errors.StateError):
            jam.System.random(n=10).gaps(1.0, True)
