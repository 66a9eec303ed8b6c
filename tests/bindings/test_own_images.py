"""Contacts of a sphere with its own image: modes, moduli and copies against springs on all closed pairs, by numpy."""
import itertools
import unittest

import jam
import numpy as np
from test_tile import waves


def triangular():
    """Two disks a cell: each touches the other four times, and its own image twice."""
    return jam.System.from_arrays([[0, 0], [0.5, np.sqrt(0.75)]], 1.0 - 1e-15, cell=np.diag([1, np.sqrt(3)]), dim=2)


def of_springs(s, wave):
    """Eigenvalues of unit springs on all closed pairs, images of one sphere too."""
    h = np.zeros((s.n * s.dim,) * 2, complex)
    for back in itertools.product((-1, 0, 1), repeat=s.dim):
        for i, j in itertools.product(range(s.n), repeat=2):
            r = s.positions[j] + back @ s.cell - s.positions[i]
            if 0 < np.linalg.norm(r) < (s.diameters[i] + s.diameters[j]) / 2 * (1 + 1e-9):
                block = np.outer(r, r) / (r @ r)
                a, b = (slice(s.dim * k, s.dim * k + s.dim) for k in (i, j))
                h[a, a] += block
                h[a, b] -= block * np.exp(2j * np.pi * np.dot(wave, back))
    return np.linalg.eigvalsh(h)


class OwnImages(unittest.TestCase):
    """A fixed cell leaves out contacts of a sphere with its own image. Copies and strains must not."""

    def setUp(self):
        self.s = triangular()
        self.s.contacts_from_geometry()
        self.assertEqual(len(self.s.contacts), 4)

    def test_modes_that_need_them_are_refused(self):
        np.testing.assert_allclose(of_springs(self.s, (0.5, 0.5)), [2, 2, 6, 6], atol=1e-12)
        for wave in ((0.5, 0.5), (0.25, 0)):
            with self.assertRaisesRegex(jam.errors.UnsupportedError, "sphere 0 touches its own image.*strain=free"):
                self.s.bloch_modes(wave)
        for wave in ((0, 0), (0, 0.5), (1, 0.25)):  # both move alike
            np.testing.assert_allclose(self.s.bloch_modes(wave).values, of_springs(self.s, wave), atol=1e-12)

    def test_moduli_are_refused(self):
        for call in (self.s.moduli, self.s.elastic_tensor):
            with self.assertRaisesRegex(jam.errors.UnsupportedError, "sphere 0 touches its own image"):
                call()

    def test_copies_with_more_contacts_have_no_network(self):
        t = self.s.tile((2, 2))
        self.assertIn("sphere 0 touches its own image", t.notes)
        with self.assertRaises(jam.errors.StateError):
            t.forces
        self.assertEqual((t.rigidity().jammed, self.s.bloch_rigidity((2, 2)).flexes.sum()), (jam.Verdict.YES, 0))
        t.contacts_from_geometry()
        self.assertEqual(len(t.contacts), 24)
        union = np.concatenate([of_springs(self.s, q) for q in waves((2, 2))])
        np.testing.assert_allclose(t.modes(which="all").values, np.sort(union), atol=1e-12)
        self.assertEqual(len(self.s.tile((1, 3)).contacts), 12)  # own images stay own images

    def test_forces_of_a_vertex_are_not_taken(self):
        """Rows apart whose disks are as wide as the cell: an LP that simplex solves gives all force to one of them."""
        for dim, n in ((2, 2), (3, 2), (2, 3)):
            x = np.full((n, dim), 0.1)
            x[:, -1] += 1.1 * np.arange(n)
            for strain, polish in (("edges", True), ("tilts", True), ("tilts", False)):
                s = jam.System.from_arrays(x, 1 - 1e-6, cell=[1] * (dim - 1) + [1.1 * n], dim=dim)
                r = s.crunch(strain=strain, lp_solver="clp", polish=polish)
                self.assertEqual(len(s.forces), r.contacts)
                self.assertGreater(s.forces.min(), 0.1, (dim, n, strain, polish))
                self.assertEqual(r.excess_contacts, r.contacts - (dim * (r.stable - 1) + 1))
                if strain == "tilts":
                    np.testing.assert_allclose(s.forces, 1.0, rtol=1e-12)  # nothing tells the rows apart

    def test_strict_contacts_are_counted_with_own_images(self):
        c, strict = self.s.check(), self.s.rigidity("strict")
        self.assertEqual((c.contacts, strict.contacts, strict.contacts_needed), (4, 6, 5))
        self.assertEqual((c.excess_contacts, c.strict_excess_contacts), (1, 1))
        self.assertNotIn("-1", str(c).split("Proof")[0])

    def test_rows_of_a_cubic_lattice_slide(self):
        """Of few digits, but own images and contacts along the row are exact: a sideways motion opens those of the row."""
        for n, dim in ((2, 3), (3, 3), (2, 2), (5, 2)):
            x = np.full((n, dim), 0.5)
            x[:, 0] += np.arange(n)
            s = jam.System.from_arrays(x, 1.0, cell=[n] + [1] * (dim - 1), dim=dim)
            c = s.check()
            self.assertEqual((c.jammed, c.strictly_jammed, c.flexes), (jam.Verdict.NO, jam.Verdict.NO, (n - 1) * (dim - 1)), (n, dim))

    def test_every_call_counts_them_alike(self):
        """Big spheres that own images alone hold, and a rattler: contacts are the closed pairs of images, by numpy."""
        for dim, ratio, seed in ((2, 3.0, 1), (2, 6.0, 2), (3, 1.7, 1), (3, 3.0, 1)):
            s = jam.System.random(dim=dim, diameters=[1.0, ratio], seed=seed, packing_fraction=0.1)
            s.compress()
            r = s.crunch()
            steps = np.array([q for q in itertools.product((-1, 0, 1), repeat=dim) if q > (0,) * dim]) @ s.cell
            own = (np.linalg.norm(steps, axis=1) < s.diameters.max() * (1 + 1e-10)).sum()
            if own == 0:
                continue
            self.assertEqual(own, dim)
            self.assertTrue(r.jammed)
            check, rigidity = s.check(crunch=False), s.rigidity()
            for found in (r, check, rigidity):
                self.assertEqual(found.contacts, own)
            self.assertEqual([r.stable, r.rattlers, check.rattlers, rigidity.stable], [1, 1, 1, 1])
            self.assertEqual((s.rattlers.sum(), len(s.contacts), s.coordination.sum()), (1, own, 2 * own))
            self.assertLess(r.force_residual, 1e-12)
            self.assertEqual(jam.System.from_arrays(s.positions, s.diameters, cell=s.cell).check(crunch=False).contacts, own)

    def test_proofs_name_them(self):
        """Where a network does not list them, too."""
        one = jam.System.from_arrays([[0.25, 0.25]], 1.0, cell=np.eye(2))
        two = jam.System.from_arrays([[0, 0], [0.5, np.sqrt(0.75)]], 1 - 1e-15, cell=[1, np.sqrt(3)])
        for s in (one, two):
            s.contacts_from_geometry()
            for proof in (s.prove(), s.prove(strict=True)):
                self.assertEqual((proof.theorem, proof.cause), (jam.Theorem.NONE, jam.ProofCause.IMAGES))

    def test_a_free_cell_lists_them(self):
        s = jam.System.random(n=2, dim=2, seed=1, packing_fraction=0.1)
        s.crunch(strain="free")
        for wave in ((0.5, 0.5), (0.25, 0.1)):
            np.testing.assert_allclose(s.bloch_modes(wave).values, of_springs(s, wave), atol=1e-9)
        self.assertGreater(s.moduli().bulk, 0)
        s.contacts_from_geometry()  # of a fixed cell
        with self.assertRaisesRegex(jam.errors.UnsupportedError, "own image"):
            s.bloch_modes((0.5, 0.5))
