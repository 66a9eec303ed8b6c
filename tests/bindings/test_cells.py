"""What libjam makes, it reads: random small packings saved by every means."""
import jam
import numpy as np
from compiled import compiled
from packings import InFolder


class Cells(InFolder):
    def expect_restored(self, s):
        names = ["a.xyz", "a.h5"] + ["a.data"] * (s.dim < 4)
        for name in names:
            (s.save if name == "a.h5" else s.write)(self.folder / name)
        s.write_checkpoint(self.folder / "a.check")
        back = [jam.load(self.folder / name) if name == "a.h5" else jam.System.read(self.folder / name, overlap="allow") for name in names]
        back.append(jam.System.from_checkpoint(self.folder / "a.check"))
        back.append(jam.System.from_arrays(s.positions, s.diameters, cell=s.cell, overlap="allow"))
        for name, t in zip(names + ["checkpoint", "arrays"], back):
            with self.subTest(way=name, d=s.dim, n=s.n):
                for of in ("positions", "diameters", "cell"):
                    np.testing.assert_array_equal(getattr(t, of), getattr(s, of))

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
            self.expect_restored(s)
            s.positions = s.positions
            s.strain(np.zeros((dim, dim)))
        self.assertGreater(made, 20)

    def test_vtp_has_the_cell_in_its_fields(self):
        s = jam.System.random(n=4, seed=1, cell=[[2, 0, 0], [0.5, 3, 0], [0.25, 0.125, 1]], packing_fraction=0.05)
        s.write(self.folder / "a.vtp")
        field = (self.folder / "a.vtp").read_bytes().split(b'Name="cell"')[1].split(b">")[1].split(b"<")[0]
        self.assertEqual(list(map(float, field.split())), list(np.ravel(s.cell)))

    def test_a_cell_that_is_turned_is_noted(self):
        s = jam.System.random(n=4, dim=2, seed=1, cell=[[0, 2], [-1, 0]], packing_fraction=0.05)
        self.assertEqual(s.notes, "the cell was rotated: its vectors are lower-triangular now")
        np.testing.assert_allclose(s.cell, [[2, 0], [0, 1]], atol=1e-15)

    def test_growth_to_an_own_image_is_read(self):
        for seed in range(1, 5):
            s = jam.System.random(diameters=[1, 20, 2, 60, 4, 100.0], seed=seed)
            s.compress(pressure=10)
            s.write(self.folder / "b.xyz")
            for policy in ("refuse", "shrink", "allow"):
                np.testing.assert_array_equal(jam.System.read(self.folder / "b.xyz", overlap=policy).diameters, s.diameters)
