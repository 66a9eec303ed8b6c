"""Copies of a packing, and their modes and flexes from one cell, against arithmetic of numpy and linear programs of HiGHS."""
import itertools
import os
import tempfile
import unittest

import jam
import numpy as np
from jamming_oracle import contacts, rigidity_rows
from scipy.optimize import linprog

HEXAGONAL = [[1, 0], [0.5, np.sqrt(0.75)]]


def jammed(n, seed, **more):
    """Disks or spheres of two sizes at their jamming point."""
    s = jam.System.random(n=n, seed=seed, diameters=[1.0] * (n // 2) + [1.4] * (n - n // 2), **more)
    s.crunch()
    return s


def waves(count):
    return [np.array(q) / count for q in itertools.product(*map(range, count))]


def square():
    return jam.System.from_arrays([[0.2, 0.3]], 1.0, cell=np.eye(2))


def kagome():
    """Three disks on the edges of a hexagonal cell."""
    return jam.System.from_arrays([[0.5, 0], [0.25, np.sqrt(3) / 4], [0.75, np.sqrt(3) / 4]], 0.5, cell=HEXAGONAL)


def rows_of(s, closed=1e-9):
    """Rigidity matrix of all closed pairs, from positions and cell alone. Images of one sphere have no row."""
    found, _ = contacts(s.positions, s.diameters, s.cell, closed, own_images=False, reach=1)
    return rigidity_rows(found, s.n, s.dim, strict=False)[0]


def can_move(s, seed=0):
    """Whether a motion of the spheres with contacts opens or keeps all of these: Donev's linear program."""
    rows = rows_of(s)
    used = np.abs(rows).reshape(-1, s.n, s.dim).sum((0, 2)) > 0
    cost = np.random.default_rng(seed).normal(size=(s.n, s.dim))
    cost[~used] = 0
    cost[used] -= cost[used].mean(0)
    found = linprog(-cost.ravel(), A_ub=-rows, b_ub=np.zeros(len(rows)), bounds=(-1, 1), method="highs")
    return -found.fun > 1e-6


class Tile(unittest.TestCase):

    def test_contacts_and_forces_go_along(self):
        """The network of the copies is the one that their geometry gives, and its forces balance."""
        for s, count in (
            (jammed(8, 1, dim=2, cell=[[1, 0], [0.4, 1.1]]), (2, 3)),
            (jammed(5, 4, dim=2), (2, 1)),
            (jammed(10, 2, dim=3), (1, 2, 2)),
        ):
            t = s.tile(count)
            copies, c, r = np.prod(count), t.contacts, t.report
            self.assertEqual((len(c), r.stable, r.rattlers), tuple(copies * v for v in (len(s.contacts), s.report.stable, s.report.rattlers)))
            self.assertFalse(r.jammed)  # untested
            self.assertEqual(r.flexes, -1)
            np.testing.assert_array_equal(np.sort(c.forces), np.sort(np.tile(s.forces, copies)))
            net = np.zeros((t.n, t.dim))
            np.add.at(net, c.pairs[:, 0], c.forces[:, None] * c.vectors)
            np.add.at(net, c.pairs[:, 1], -c.forces[:, None] * c.vectors)
            self.assertLess(np.abs(net).max(), 1e-12)
            again = jam.System.from_arrays(t.positions, t.diameters, cell=t.cell)  # fewer contacts than rigid packings have
            self.assertLess(again.contacts_from_geometry().force_residual, 1e-12)
            self.assertEqual(again.rigidity().jammed, t.rigidity().jammed)
            order = [np.lexsort((*n.vectors.T.round(6), n.pairs[:, 1], n.pairs[:, 0])) for n in (c, again.contacts)]
            np.testing.assert_array_equal(c.pairs[order[0]], again.contacts.pairs[order[1]])
            np.testing.assert_allclose(c.vectors[order[0]], again.contacts.vectors[order[1]], atol=1e-13)
            with tempfile.TemporaryDirectory() as folder:  # whose reader compares contacts with positions
                t.write_checkpoint(os.path.join(folder, "copies"))
                np.testing.assert_array_equal(jam.System.from_checkpoint(os.path.join(folder, "copies")).forces, t.forces)

    def test_own_images_become_contacts_of_copies(self):
        one = jam.System.random(n=1, dim=2, seed=3, cell=HEXAGONAL, packing_fraction=0.2)
        one.crunch(strain="free")
        t = one.tile((4, 3))
        self.assertEqual((len(one.contacts), len(t.contacts), set(t.coordination)), (3, 36, {6}))
        self.assertTrue((t.contacts.pairs[:, 0] < t.contacts.pairs[:, 1]).all())
        self.assertEqual(t.rigidity().jammed, jam.Verdict.YES)
        self.assertEqual((one.bloch_rigidity((4, 3)).flexes.sum(), one.status), (0, jam.StatusCode.OK))

    def test_walls_stay_and_bound_their_axes(self):
        s = jammed(12, 5, dim=2, walls="y")
        t = s.tile((3, 1))
        self.assertEqual(len(t.contacts), 3 * len(s.contacts))
        self.assertEqual((t.contacts.pairs[:, 1] < 0).sum(), 3 * (s.contacts.pairs[:, 1] < 0).sum())
        np.testing.assert_allclose(t.walls().area, 3 * s.walls().area, rtol=1e-15)
        self.assertAlmostEqual(t.packing_fraction, s.packing_fraction, delta=1e-14)
        tube = jam.System.random(n=20, seed=1, container="cylinder", packing_fraction=0.1)
        self.assertEqual(tube.tile((1, 1, 4)).info.container, tube.info.container)

    def test_soft_spheres_keep_stiffness(self):
        s = jam.System.random(n=10, dim=2, seed=2, packing_fraction=0.95, overlap="allow", diameters=[1.0] * 5 + [1.4] * 5)
        s.relax()
        t = s.tile((2, 2))
        direct = np.linalg.eigvalsh(t.hessian("soft", prestress=1.0).toarray())
        union = np.sort(np.concatenate([s.bloch_modes(q, "soft", prestress=1.0).values for q in waves((2, 2))]))
        np.testing.assert_allclose(union, direct, atol=1e-10 * direct[-1])

    def test_what_cannot_be_tiled_is_refused(self):
        with self.assertRaisesRegex((jam.errors.JamError, ValueError), "flat cell"):
            jam.System.random(n=10, dim=2, seed=1).tile((10**7, 1))
        shifted = jam.System.random(n=10, dim=2, seed=1, model="mk")
        self.assertEqual(shifted.tile((1, 1)).n, 10)
        with self.assertRaisesRegex(jam.errors.UnsupportedError, "shifts"):
            shifted.tile((2, 1))


class Rigidity(unittest.TestCase):
    def test_lattices_of_known_flexes(self):
        """L x L copies: the square lattice has 2 L - 2 (its rows slide), the kagome lattice 3 L - 2."""
        for make, flexes in ((square, lambda k: 2 * k - 2), (kagome, lambda k: 3 * k - 2)):
            for k in (2, 3, 4):
                s = make()
                s.contacts_from_geometry(tolerance=1e-9)
                self.assertEqual(s.bloch_rigidity((k, k)).flexes.sum(), flexes(k))
                self.assertEqual(s.status, jam.StatusCode.NOT_JAMMED)
                self.assertEqual(s.tile((k, k)).rigidity().flexes, flexes(k))

    def test_packings_jammed_in_one_cell_may_flex_in_several(self):
        """One state of self-stress leaves d - 1 flexes at every wave vector but 0, by the count of contacts; more contacts
        may leave none. The linear program knows nothing of forces and wave vectors."""
        unjammed = 0
        for seed in range(1, 9):
            s = jammed(4 + seed % 5, seed, dim=2)
            if not s.report.jammed:
                continue
            self.assertFalse(can_move(s))
            for count in ((2, 1), (2, 2)):
                t, found = s.tile(count), s.bloch_rigidity(count)
                moves = can_move(t)
                self.assertEqual(s.status, jam.StatusCode.NOT_JAMMED if moves else jam.StatusCode.OK)
                r = t.rigidity()
                self.assertEqual(r.jammed, jam.Verdict.NO if moves else jam.Verdict.YES)
                self.assertEqual(found.flexes.sum(), r.flexes)
                rows = rows_of(t)
                stable = np.abs(rows).sum(0) > 0
                self.assertEqual(found.flexes.sum(), stable.sum() - 2 - np.linalg.matrix_rank(rows, tol=1e-7))
                if s.report.excess_contacts == 0:
                    np.testing.assert_array_equal(found.flexes[1:], 1)
                unjammed += moves
        self.assertGreater(unjammed, 8)

    def test_many_spheres_have_the_flexes_and_margin_of_their_copies(self):
        """At q = 0 and 1/2 the rows are real, at 1/3 complex. An iteration finds the margin, to 1e-3 a pass."""
        s = jammed(160, 3, dim=2)
        for count in ((2, 1), (3, 1)):
            found, rows = s.bloch_rigidity(count), rows_of(s.tile(count))
            rows = rows[:, np.abs(rows).sum(0) > 0]
            eigenvalues = np.linalg.eigvalsh(rows.T @ rows)
            flexes = (eigenvalues < 1e-12).sum()
            self.assertEqual(found.flexes.sum(), flexes - 2)
            np.testing.assert_allclose(found.margin.min(), eigenvalues[flexes], rtol=2e-2)

    def test_what_is_not_jammed_in_one_cell(self):
        s = jam.System.random(n=6, dim=2, seed=1)
        found = s.bloch_rigidity((2, 1))
        self.assertEqual(s.status, jam.StatusCode.NOT_JAMMED)
        self.assertTrue(np.isnan(found.margin).all())
        with self.assertRaisesRegex(jam.errors.UnsupportedError, "round wall"):
            jam.System.random(n=6, seed=1, container="ball").bloch_rigidity((1, 1, 1))
        t = jam.System.from_arrays([[0, 0]], 1.0 - 1e-13, cell=HEXAGONAL).tile((2, 2))  # all of a crystal hold each other
        t.contacts_from_geometry(tolerance=1e-9)
        self.assertEqual((t.bloch_rigidity((3, 2)).flexes.sum(), t.status), (0, jam.StatusCode.OK))


class Modes(unittest.TestCase):
    def test_wave_vectors_together_have_the_modes_of_the_copies(self):
        for s, count, options in (
            (jammed(8, 1, dim=2, cell=[[1, 0], [0.4, 1.1]]), (3, 2), {}),
            (jammed(5, 4, dim=2), (4, 1), {"stiffness": "hard", "prestress": 1e-3}),
            (jammed(10, 2, dim=3), (2, 1, 3), {"stiffness": "power", "alpha": 2.5}),
            (jammed(12, 5, dim=2, walls="y"), (5, 1), {}),
        ):
            h = s.tile(count).hessian(**options).toarray()
            direct = np.linalg.eigvalsh(h)
            found = [s.bloch_modes(q, **options) for q in waves(count)]
            union = np.sort(np.concatenate([m.values for m in found]))
            np.testing.assert_allclose(union, direct, atol=1e-10 * direct[-1])
            self.follow(s, count, h, found)

    def follow(self, s, count, h, found):
        """Each mode on all copies is an eigenvector of their Hessian; those of one wave vector are orthonormal."""
        t = s.tile(count)
        place = {sphere: k for k, sphere in enumerate(t.hessian_map())}
        for q, m in zip(waves(count), found):
            flat = m.vectors.reshape(len(m), -1)
            np.testing.assert_allclose(flat.conj() @ flat.T, np.eye(len(m)), atol=1e-12)
            y = (np.abs(m.vectors) ** 2).sum(-1)
            np.testing.assert_allclose(m.participation, (y**2).sum(1), rtol=1e-10)
            u = np.zeros((len(m), len(place), s.dim), complex)
            for copy, k in enumerate(itertools.product(*map(range, count[::-1]))):
                for node, sphere in enumerate(m.spheres):
                    u[:, place[copy * s.n + sphere]] = m.vectors[:, node] * np.exp(2j * np.pi * q @ k[::-1])
            u = u.reshape(len(m), -1)
            self.assertLess(np.abs(u @ h - m.values[:, None] * u).max(), 1e-9 * np.abs(h).max())

    def test_vectors_next_to_real_wave_vectors_are_orthogonal(self):
        """Frequencies of a lattice lie there as near each other as the wave vectors: the matrix is nearly that of the real one."""
        m = 3
        cell = m * np.array([[1, 0], [0.5, np.sqrt(0.75)]])
        s = jam.System.from_arrays(np.stack([np.divmod(k, m) for k in range(m * m)]) / m @ cell, 1 - 1e-15, cell=cell)
        s.contacts_from_geometry()
        for near in (0.0, 0.5):
            matrix = None
            for off in (0.0, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8):
                found = s.bloch_modes((near + off, near + 0.4 * off))
                u = found.vectors.reshape(len(found.values), -1)
                np.testing.assert_allclose(u.conj() @ u.T, np.eye(len(u)), atol=1e-13)
                now = (u.T * found.values) @ u.conj()
                matrix = now if matrix is None else matrix
                np.testing.assert_allclose(now, matrix, atol=50 * off + 1e-12)

    def test_what_is_refused(self):
        s = jammed(12, 5, dim=2, walls="y")
        with self.assertRaisesRegex(ValueError, "nothing repeats along this axis"):
            s.bloch_modes((0, 0.5))
        for wave, why in (((0,), "wave has 1 numbers"), ((np.nan, 0), "wave.0. is nan"), ((1e9, 0), "wave is 1e")):
            with self.assertRaisesRegex((jam.errors.JamError, ValueError), why):
                s.bloch_modes(wave)
        shifted = jam.System.random(n=20, dim=2, seed=1, model="mk", packing_fraction=0.8)
        shifted.crunch()
        np.testing.assert_allclose(shifted.bloch_modes((0, 0)).values, shifted.modes(which="all").values, atol=1e-12)
        with self.assertRaisesRegex(ValueError, "Mari-Kurchan spheres have no copies"):
            shifted.bloch_modes((0, 0.5))
        with self.assertRaises(jam.errors.StateError):
            jam.System.random(n=5, dim=2, seed=1).bloch_modes((0, 0))
