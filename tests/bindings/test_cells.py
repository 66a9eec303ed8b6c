"""What libjam makes, it reads: copies, relaxed cells and random small packings, saved by every means."""
import os
import pickle

import jam
import numpy as np
from compiled import compiled
from packings import InFolder


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
                self.assertNotRegex(t.notes, "rotated|replaced")
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
