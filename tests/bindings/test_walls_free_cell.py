"""Cells whose axes without walls deform: strictly jammed layers, channels at a pressure, strains by hand."""
import unittest

import jam
import numpy as np
from radii_oracle import pairs_of, rows_of, strains
from scipy.optimize import linprog


def growth_by_highs(s):
    """Largest growth of all radii in a linear program over displacements and traceless strains along x and y."""
    a, c = rows_of(s, 0.5 * np.max(s.diameters), strains(s))
    a, bends = np.split(a, [s.n * (s.dim + 1)], axis=1)
    a = a.reshape(len(a), s.n, s.dim + 1)
    a = np.c_[a[:, :, : s.dim].reshape(len(a), -1), bends, a[:, :, s.dim] @ (s.diameters / 2)]
    most = 0.05 * np.mean(s.diameters)
    bounds = [(-most, most)] * (s.dim * s.n) + [(-0.02, 0.02)] * bends.shape[1] + [(0, 1)]
    found = linprog(-np.eye(1, a.shape[1], a.shape[1] - 1)[0], -a, c, bounds=bounds, method="highs")
    return found.x[-1]


class FreeCell(unittest.TestCase):
    def test_layers_between_walls_end_strictly_jammed(self):
        for n, seed in ((2, 1), (3, 2), (12, 3), (40, 1)):
            with self.subTest(n=n):
                s = jam.System.random(n, 3, seed, walls="z", packing_fraction=0.2)
                s.compress()
                fixed = s.copy().crunch()
                report = s.crunch(strain="free")
                self.assertTrue(report.jammed)
                self.assertEqual(str(s.rigidity("strict").jammed), "yes")
                self.assertGreaterEqual(report.packing_fraction, fixed.packing_fraction - 1e-12)
                cell = np.asarray(s.cell)
                self.assertEqual(cell[2, 2], 1.0)
                self.assertFalse(cell[2, :2].any() or cell[:2, 2].any())
                # a product of d factors, each rounded in every step
                self.assertAlmostEqual(np.linalg.det(cell), 1.0, delta=1e-12)
                self.assertLess(growth_by_highs(s), 1e-9)  # HiGHS keeps rows to 1e-7 times its scaling of them

    def stress(self, s):
        """V times the stress of harmonic spheres, from all overlaps: f = (sigma - r) / sigma^2."""
        total = np.zeros((s.dim, s.dim))
        for i, j, _, r in pairs_of(s, 0.0):
            sigma, length = (s.diameters[i] + s.diameters[j]) / 2, np.sqrt(r @ r)
            total += (sigma - length) / sigma**2 * np.outer(r, r) / length
        return total

    def test_channels_and_tubes_find_their_length_at_a_pressure(self):
        pressure = 0.01
        for dim, scene, n, axes, volume in (
            (2, {"walls": "y"}, 40, [0], lambda c: c[0, 0] * c[1, 1]),
            (3, {"walls": "yz"}, 40, [0], np.linalg.det),
            (3, {"container": "cylinder", "cell": [1.0, 1.0, 2.0]}, 40, [2], lambda c: np.pi / 4 * c[2, 2]),
            (3, {"walls": "z"}, 50, [0, 1], np.linalg.det),
        ):
            with self.subTest(scene=scene):
                s = jam.System.random(n, dim, 3, packing_fraction=0.9 if dim == 2 else 0.72, overlap="allow", **scene)
                before = np.asarray(s.cell).copy()
                self.assertTrue(s.relax(strain="all", pressure=pressure).converged)
                cell = np.asarray(s.cell)
                for c in range(dim):
                    if c not in axes:
                        np.testing.assert_array_equal(cell[c], before[c])
                stress = self.stress(s) / volume(cell)
                for a in axes:
                    for b in axes:
                        # forces balance to 1e-12 of the mean force
                        self.assertAlmostEqual(stress[a, b], pressure if a == b else 0.0, delta=1e-10 * pressure)

    def test_what_walls_do_not_allow_is_said(self):
        pressed = jam.System.random(40, 2, 3, packing_fraction=10.0, overlap="allow", walls="y")
        with self.assertRaisesRegex(jam.errors.OverlapError, "outside the wall .*: the overlaps pushed it out"):
            pressed.relax()
        channel = jam.System.random(40, 2, 1, walls="y", packing_fraction=0.3)
        with self.assertRaisesRegex(jam.errors.UnsupportedError, "axes that walls close keep their lengths"):
            channel.strain([[0.0, 0.0], [0.0, 0.1]])
        with self.assertRaisesRegex(jam.errors.UnsupportedError, "axes that walls close keep their lengths"):
            channel.strain([[0.0, 0.1], [0.0, 0.0]])
        channel.strain([[0.5, 0.0], [0.0, 0.0]])
        np.testing.assert_allclose(channel.cell, [[1.5, 0.0], [0.0, 1.0]], rtol=1e-15)
        self.assertAlmostEqual(channel.packing_fraction, 0.2, delta=1e-12)
        box = jam.System.random(10, 2, 1, walls="xy", packing_fraction=0.9, overlap="allow")
        with self.assertRaisesRegex(jam.errors.UnsupportedError, "at least 1 axis without walls, this scene has 0"):
            box.relax(strain="all", pressure=0.1)


if __name__ == "__main__":
    unittest.main()
