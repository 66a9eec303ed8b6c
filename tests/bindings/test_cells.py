"""A cell stays as it was given, by every way in and out, and what is done in it follows the names of its axes. What libjam
makes, it reads: random small packings saved by every means."""
import os
import pickle

import jam
import numpy as np
from compiled import compiled
from packings import InFolder

RATIOS = (1.0, 1.19, 1.21, 4.0, 50.0)


def bricks(dim):
    """Sides of 1 and one other side, along each axis."""
    for ratio in RATIOS:
        for axis in range(dim):
            yield axis, np.where(np.arange(dim) == axis, ratio, 1.0)


def changed(s):
    """What the notes say about the cell."""
    return [line for line in s.notes.splitlines() if "rotated" in line or "replaced" in line]


class Cells(InFolder):
    def path(self, name):
        return os.path.join(self.folder, name)

    def restored(self, s, policy=None):
        """The packing as each of its files gives it back, by name."""
        more = {"overlap": policy} if policy else {}
        s.write(self.path("a.xyz"))
        yield "xyz", jam.System.read(self.path("a.xyz"), **more)
        if s.dim < 4:
            s.write(self.path("a.data"))
            yield "lammps", jam.System.read(self.path("a.data"), **more)
        yield "arrays", jam.System.from_arrays(s.positions, s.diameters, cell=s.cell, **more)
        s.write_checkpoint(self.path("a.check"))
        yield "checkpoint", jam.System.from_checkpoint(self.path("a.check"))
        yield "pickle", pickle.loads(pickle.dumps(s))
        s.save(self.path("a.h5"))
        yield "h5", jam.load(self.path("a.h5"))

    def expect_restored(self, s, policy=None):
        for name, t in self.restored(s, policy):
            with self.subTest(way=name, d=s.dim, n=s.n):
                for of in ("positions", "diameters", "cell"):
                    np.testing.assert_array_equal(getattr(t, of), getattr(s, of))
                self.assertEqual(s.compare(t).comparison.displacement_max, 0.0)

    def test_bricks_by_every_way_in(self):
        rng = np.random.default_rng(1)
        for dim in (2, 3):
            for axis, sides in bricks(dim):
                with self.subTest(sides=sides.tolist()):
                    s = jam.System.random(n=12, dim=dim, seed=1, cell=sides, packing_fraction=0.05)
                    x = rng.random((1, dim)) * sides
                    t = jam.System.from_arrays(x, 0.01, cell=sides)
                    np.testing.assert_array_equal(t.positions, x)
                    for made in (s, t):
                        np.testing.assert_array_equal(made.cell, np.diag(sides))
                        self.assertEqual(made.notes, "")
                    self.expect_restored(s)
                    copies = np.where(np.arange(dim) == axis, 3, 1)
                    many = s.tile(copies)
                    np.testing.assert_array_equal(many.cell, np.diag(copies * sides))
                    self.expect_restored(many)
                    strain = np.zeros((dim, dim))
                    strain[axis, axis] = 0.1
                    t.strain(strain)
                    np.testing.assert_allclose(np.diag(t.cell), sides * np.where(np.arange(dim) == axis, 1.1, 1.0), rtol=1e-15)
                    t.cell = np.diag(sides)
                    t.positions = x
                    np.testing.assert_array_equal(t.positions, x)

    def test_bricks_of_other_programs(self):
        dump = self.path("a.dump")
        with open(dump, "w") as file:
            file.write(
                "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 20\n0 10\n0 10\n"
                "ITEM: ATOMS id x y z radius\n1 15 7 3 1\n"
            )
        s = jam.System.read(dump)
        np.testing.assert_array_equal(s.cell, np.diag([20, 10, 10]))
        np.testing.assert_array_equal(s.positions, [[15, 7, 3]])
        for name, reader in (("a.gsd", "gsd.hoomd"), ("b.xyz", "ase")):
            try:
                __import__(reader)
            except ImportError:
                continue
            t = jam.System.random(n=5, seed=1, cell=[7, 2, 3], packing_fraction=0.05)
            t.write(self.path(name))
            back = jam.System.read(self.path(name)) if name != "b.xyz" else jam.files.read_ase(self.path(name), t.diameters)
            np.testing.assert_allclose(back.cell, t.cell, rtol=1e-7)
            np.testing.assert_allclose(back.positions, t.positions, rtol=1e-6)

    def test_axes_of_what_is_measured(self):
        """The same spheres under other names of the axes: profiles, images, waves, shares of the void and moduli."""
        first = jam.System.random(n=40, seed=3, cell=[5, 1, 2], packing_fraction=0.2)
        for shift in range(3):
            roll = lambda v: np.roll(v, shift, axis=-1)
            s = jam.System.from_arrays(roll(first.positions), first.diameters, cell=roll(np.array([5.0, 1, 2])))
            for axis in range(3):
                p, q = first.solid_profile(axis, 7), s.solid_profile((axis + shift) % 3, 7)
                np.testing.assert_allclose(q.solid, p.solid, atol=1e-12)
                np.testing.assert_allclose(q.high, p.high, rtol=1e-14)
            np.testing.assert_allclose(s.pair_correlation(r_max=3), first.pair_correlation(r_max=3), atol=1e-9)
            np.testing.assert_allclose(s.structure_factor(8.0).s, first.structure_factor(8.0).s, rtol=1e-9)
            np.testing.assert_allclose(np.sort(s.local_fraction()), np.sort(first.local_fraction()), rtol=1e-7)

    def test_tilts_change_nothing_but_the_vectors(self):
        """One lattice by vectors with tilts below and above half an edge: the same spheres, pairs and waves."""
        cell = np.array([[3.0, 0, 0], [0.6, 2.0, 0], [-0.4, 0.5, 2.5]])
        more = np.array([[1, 0, 0], [2, 1, 0], [1, -1, 1]]) @ cell
        s = jam.System.random(n=200, seed=2, cell=cell, packing_fraction=0.25)
        t = jam.System.from_arrays(s.positions, s.diameters, cell=more)
        np.testing.assert_array_equal(t.cell, more)
        np.testing.assert_allclose(t.positions, s.positions, atol=1e-14)
        np.testing.assert_allclose(t.pair_correlation(), s.pair_correlation(), atol=1e-9)
        np.testing.assert_allclose(np.sort(t.local_fraction()), np.sort(s.local_fraction()), rtol=1e-7)
        for u in (s, t):
            u.compress(pressure=1e3)
        self.assertLess(abs(s.packing_fraction - t.packing_fraction), 0.02)
        self.assertGreater(t.check(crunch=False).nearest_gap, -1e-12)
        np.testing.assert_array_equal(t.cell, more)

    def test_copies_and_relaxed_cells_are_read_back(self):
        for seed in range(1, 6):
            s = jam.System.random(n=12, dim=2, seed=seed)
            s.compress()
            s.crunch()
            for counts in ((2, 1), (1, 2), (5, 1), (1, 7)):
                self.expect_restored(s.tile(counts))
            s.crunch(strain="free")
            for counts in ((1, 1), (3, 1), (1, 9)):
                self.expect_restored(s.tile(counts))
            for dim, cell in ((2, [[1.0, 0], [0.45, 0.9]]), (3, [1.3, 1, 0.8])):
                t = jam.System.random(n=20, dim=dim, seed=seed, cell=cell, overlap="allow", packing_fraction=1.0 if dim == 2 else 0.8)
                t.relax(strain=("free", "all")[seed % 2], **({"pressure": 1e-2} if seed % 2 else {}))
                self.assertEqual(changed(t), [])
                self.expect_restored(t, "allow")
                self.expect_restored(t.tile([2] + [1] * (dim - 1)), "allow")

    def test_what_is_made_is_read(self):
        """Few spheres of very different sizes, crunched in a free cell until they touch their own images."""
        rng = np.random.default_rng(7)
        made, dims = 0, compiled(2, 3, 4)
        for k in range(60):
            dim, n = int(rng.choice(dims)), int(rng.integers(1, 5))
            sizes = np.r_[rng.uniform(1, 15), np.ones(n - 1)] if n > 1 else np.ones(1)
            policy = ("refuse", "allow")[k % 2]
            s = jam.System.random(dim=dim, seed=k, diameters=sizes, packing_fraction=0.05, overlap=policy)
            try:
                s.crunch(strain="free")
            except jam.JamError:  # a random start of spheres that may overlap is none for a crunch
                continue
            made += 1
            self.expect_restored(s, "allow")
            s.positions = s.positions
            s.strain(np.zeros((dim, dim)))
        self.assertGreater(made, 20)

    def test_growth_to_an_own_image_is_read(self):
        for seed in range(1, 5):
            s = jam.System.random(diameters=[1, 20, 2, 60, 4, 100.0], seed=seed)
            s.compress(pressure=10)
            for policy in ("refuse", "shrink", "allow"):
                s.write(self.path("b.xyz"))
                np.testing.assert_array_equal(jam.System.read(self.path("b.xyz"), overlap=policy).diameters, s.diameters)

    def test_notes_of_changed_cells_are_true(self):
        turned = jam.System.random(n=4, dim=2, seed=1, cell=[[0, 2], [-1, 0]], packing_fraction=0.05)
        self.assertEqual(turned.notes, "the cell was rotated: its vectors are lower-triangular now")
        np.testing.assert_allclose(turned.cell, [[2, 0], [0, 1]], atol=1e-15)
        long = jam.System.random(n=4, dim=2, seed=1, cell=[[1, 0], [100.25, 1]], packing_fraction=0.05)
        self.assertIn("replaced by shorter ones of the same lattice: the product of their lengths was over", long.notes)
        np.testing.assert_allclose(long.cell, [[1, 0], [0.25, 1]], atol=1e-13)
