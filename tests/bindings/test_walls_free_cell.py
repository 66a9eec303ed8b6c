"""Cells whose axes without walls deform: strictly jammed layers, channels at a pressure, strains by hand."""
import unittest

import jam
import numpy as np
from scipy.optimize import linprog


def pairs_within(s, reach, closed):
    """i, j and r_ij of all pairs and images nearer than `reach`, by all images next to the cell along axes without walls."""
    x, rows = np.asarray(s.positions), np.asarray(s.cell)
    images = [[0] if "xyz"[c] in closed else np.arange(-2, 3) for c in range(s.dim)]
    steps = np.stack(np.meshgrid(*images, indexing="ij"), -1)
    found = []
    for step in steps.reshape(-1, s.dim):
        r = x[None] + step @ rows - x[:, None]
        i, j = np.nonzero((r**2).sum(-1) < reach**2)
        keep = (i < j) | ((i == j) & (tuple(step) > (0,) * s.dim))
        found.append((i[keep], j[keep], r[i[keep], j[keep]]))
    return (np.concatenate(part) for part in zip(*found))


def growth_by_highs(s):
    """Largest growth of all radii in a linear program over displacements and traceless strains along x and y."""
    n, reach = s.n, 1.5 * np.max(s.diameters)
    i, j, r = pairs_within(s, reach, "z")
    radii = np.asarray(s.diameters) / 2
    length = np.sqrt((r**2).sum(1))
    u = r / length[:, None]
    # unknowns: s, e_xx = -e_yy, e_xy, g;   u . (s_j - s_i + E r) - g (R_i + R_j) >= R_i + R_j - length
    a = np.zeros((len(i), 3 * n + 3))
    k = np.arange(len(i))
    for c in range(3):
        np.add.at(a, (k, 3 * j + c), u[:, c])
        np.subtract.at(a, (k, 3 * i + c), u[:, c])
    a[:, -3] = u[:, 0] * r[:, 0] - u[:, 1] * r[:, 1]
    a[:, -2] = u[:, 0] * r[:, 1]
    a[:, -1] = -(radii[i] + radii[j])
    rows, least = [a], [radii[i] + radii[j] - length]
    z, height = np.asarray(s.positions)[:, 2], np.asarray(s.cell)[2, 2]
    for sign, distance in ((1.0, z), (-1.0, height - z)):
        wall = np.zeros((n, 3 * n + 3))
        wall[np.arange(n), 3 * np.arange(n) + 2] = sign
        wall[:, -1] = -radii
        rows.append(wall), least.append(radii - distance)
    most = 0.05 * np.mean(s.diameters)
    bounds = [(-most, most)] * (3 * n) + [(-0.02, 0.02)] * 2 + [(0, 1)]
    found = linprog(-np.eye(1, 3 * n + 3, 3 * n + 2)[0], -np.concatenate(rows), -np.concatenate(least), bounds=bounds, method="highs")
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

    def test_edges_alone_keep_right_angles(self):
        s = jam.System.random(5, 3, 1, walls="z", packing_fraction=0.2)
        s.compress()
        self.assertTrue(s.crunch(strain="edges").jammed)
        self.assertFalse((np.asarray(s.cell) - np.diag(np.diag(s.cell))).any())

    def stress(self, s, closed):
        """V times the stress of harmonic spheres, from all overlaps: f = (sigma - r) / sigma^2."""
        i, j, r = pairs_within(s, np.max(s.diameters), closed)
        sigma = (np.asarray(s.diameters)[i] + np.asarray(s.diameters)[j]) / 2
        length = np.sqrt((r**2).sum(1))
        f = np.maximum(0.0, sigma - length) / sigma**2
        return (f[:, None, None] * r[:, :, None] * r[:, None, :] / length[:, None, None]).sum(0)

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
                stress = self.stress(s, "".join("xyz"[c] for c in range(dim) if c not in axes)) / volume(cell)
                for a in axes:
                    for b in axes:
                        # forces balance to 1e-12 of the mean force
                        self.assertAlmostEqual(stress[a, b], pressure if a == b else 0.0, delta=1e-10 * pressure)

    def test_a_limit_of_time_keeps_what_was_reached(self):
        s = jam.System.random(40, 2, 3, packing_fraction=0.9, overlap="allow")
        start = np.array(s.positions)
        report = s.relax(strain="all", pressure=1e-7, wall_time=0.5)
        self.assertGreater(report.evaluations, 0)
        self.assertTrue(np.isfinite(report.pressure))
        self.assertGreater(np.abs(np.asarray(s.positions) - start).max(), 0.0)

    def test_what_walls_do_not_allow_is_said(self):
        pressed = jam.System.random(40, 2, 3, packing_fraction=10.0, overlap="allow", walls="y")
        with self.assertRaisesRegex(jam.errors.OverlapError, "outside the wall .*: the overlaps pushed it out"):
            pressed.relax()
        channel = jam.System.random(40, 2, 1, walls="y", packing_fraction=0.3)
        with self.assertRaisesRegex(jam.errors.UnsupportedError, "at fixed volume needs at least 2 axes without walls, this scene has 1"):
            channel.crunch(strain="free")
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
