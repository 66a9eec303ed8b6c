"""g(r), S(q), Voronoi cells and pore sizes between walls, against sampling, sums and grids."""
import itertools
import unittest

import jam
import numpy as np
from numpy.random import default_rng
from wall_scenes import NARROW, away, closed_axes, wall_distances


def depth(name, s, x):
    """Distance of points to the nearest wall, negative outside."""
    return wall_distances(NARROW[name], x, np.diag(s.cell))[0].min(1)


def start(name, n, seed, **more):
    more.setdefault("diameters", np.where(np.arange(n) % 2, 1, 1.6))
    return jam.System.random(n=n, seed=seed, **NARROW[name], **more)


class PairCorrelation(unittest.TestCase):
    def test_expected_pairs_are_those_of_points_spread_where_centres_can_be(self):
        # g times the expected number is the number of pairs: so the expected one can be read off and sampled.
        r = default_rng(1)
        for name in NARROW:
            s = start(name, 6, 2, packing_fraction=0.2)
            d, bins, r_max = s.dim, 4, 0.35 / s.diameters.mean()
            even = r.random((60000, d)) * np.diag(s.cell)
            x = s.positions
            expected, error2, count = np.zeros(bins), np.zeros(bins), np.zeros(bins)
            for j in range(s.n):
                room = even[depth(name, s, even) >= s.diameters[j] / 2]
                for i in range(s.n):
                    for y, out in ((room, expected), (x[j : j + 1] if i != j else x[:0], count)):
                        h = np.histogram(np.linalg.norm(away(NARROW[name], s, y - x[i]), axis=1), bins, (0, 0.35))[0]
                        out += h / len(y) if len(y) else 0
                        if y is room:
                            error2 += h / len(y) ** 2
            g = s.pair_correlation(r_max=r_max, bins=bins)
            seen = count > 0
            self.assertTrue(seen.any())
            self.assertLess(np.abs(count[seen] / g[seen] / expected[seen] - 1).max(), 5 * (np.sqrt(error2) / expected)[seen].max(), name)
            np.testing.assert_array_equal(g[~seen], 0)

    def test_many_sizes_go_into_classes(self):
        n = 400
        s = start("slit", n, 5, packing_fraction=0.3, overlap="allow", diameters=0.8 + 0.4 * np.arange(n) / n)
        self.assertLess(abs(s.pair_correlation(r_max=0.3 / s.diameters.mean(), bins=1)[0] - 1), 0.05)

    def test_a_fluid_between_walls_is_no_crystal(self):
        s = start("slit", 400, 1, packing_fraction=0.3, diameters=None)
        s.run(collisions_per_particle=20)
        self.assertLess(s.crystal_score(), 1.5)

    def test_refusals(self):
        s = jam.System.random(n=4, dim=4, packing_fraction=0.01, walls=(True, False, False, False))
        with self.assertRaisesRegex(jam.errors.UnsupportedError, "d = 2 and 3"):
            s.pair_correlation()
        s = jam.System.from_arrays([[0.5, 0.5, 0.1], [0.2, 0.1, 0.1]], 0.2, cell=[1, 1, 0.2], walls="z", dim=3)
        with self.assertRaisesRegex(jam.errors.UnsupportedError, "as wide as the container"):
            s.pair_correlation()


class StructureFactor(unittest.TestCase):
    def test_waves_run_along_the_axes_that_repeat(self):
        for name, axes in (("slit", (0, 1)), ("tube", (2,)), ("lines", (0,))):
            s = start(name, 60, 4, packing_fraction=0.2)
            table = s.structure_factor(30 * s.diameters.mean())
            edge, sums = np.diag(s.cell), {}
            most = [int(30 * edge[c] / (2 * np.pi)) for c in axes]
            for m in np.stack(np.meshgrid(*[np.arange(-k, k + 1) for k in most]), -1).reshape(-1, len(axes)):
                q = np.zeros(s.dim)
                q[list(axes)] = 2 * np.pi * m / edge[list(axes)]
                if m.any() and np.linalg.norm(q) <= 30:
                    sums.setdefault(round(np.linalg.norm(q), 9), []).append(abs(np.exp(1j * s.positions @ q).sum()) ** 2 / s.n)
            np.testing.assert_allclose(table.q / s.diameters.mean(), sorted(sums), rtol=1e-8)
            np.testing.assert_allclose(table.s, [np.mean(sums[q]) for q in sorted(sums)], rtol=1e-8, atol=1e-10)


class Voronoi(unittest.TestCase):
    def test_cells_fill_the_container(self):
        for name, accuracy in (("slit", 1e-12), ("duct", 1e-12), ("box", 1e-12), ("tube", 1e-5), ("can", 1e-5), ("ball", 1e-5)):
            for n, seed in ((1, 2), (2, 2), (3, 45), (2, 48), (3, 7), (60, 2)):
                s = start(name, n, seed, packing_fraction=0.1 if n == 60 else 0.05)
                cells = np.pi / 6 * s.diameters**3 / s.local_fraction()
                self.assertLess(abs(cells.sum() / s.info.volume - 1), accuracy, (name, n))

    def test_each_cell_holds_the_points_nearest_to_its_sphere(self):
        for name in ("slit", "box", "can", "ball"):
            s = start(name, 12, 3, packing_fraction=0.1)
            x = default_rng(1).random((200000, 3)) * np.diag(s.cell)
            x = x[depth(name, s, x) > 0]
            v = away(NARROW[name], s, x[:, None] - s.positions)
            nearest = np.argmin((v**2).sum(-1) - s.diameters**2 / 4, 1)
            share = np.bincount(nearest, minlength=s.n) / len(x)
            cells = np.pi / 6 * s.diameters**3 / s.local_fraction() / s.info.volume
            self.assertLess(np.abs(cells - share).max(), 6 * np.sqrt(0.25 / len(x)), name)

    def test_a_tilted_cell_is_refused(self):
        s = jam.System.random(n=20, packing_fraction=0.1, cell=[[1, 0, 0], [0.3, 1, 0], [0, 0, 1]], walls="z")
        with self.assertRaisesRegex(jam.errors.UnsupportedError, "brick"):
            s.local_fraction()


class PoreSizes(unittest.TestCase):
    def test_radii_lie_between_bounds_of_a_grid(self):
        # The clearance of points changes by no more than their distance, so a grid bounds the largest sphere about a point.
        for scene, n in itertools.product((*NARROW.values(), {"dim": 2}, {"dim": 3}), (1, 2, 12)):
            sizes = np.where(np.arange(n) % 2, 1, 1.6)
            s = jam.System.random(n=n, seed=7, packing_fraction=0.12 if n == 12 else 0.05, diameters=sizes, **scene)
            d, edge = s.dim, np.diag(s.cell)
            pores = s.pore_sizes(12, 3)
            count = [int(np.ceil(e * (300 if d == 2 else 50))) for e in edge]
            grid = np.stack(np.meshgrid(*[(np.arange(k) + 0.5) / k * e for k, e in zip(count, edge)], indexing="ij"), -1).reshape(-1, d)
            step = np.linalg.norm(edge / count) / 2
            clear = wall_distances(scene, grid, edge)[0].min(1) if closed_axes(scene, d) else np.full(len(grid), np.inf)
            for x, a in zip(s.positions, s.diameters / 2):
                clear = np.minimum(clear, np.linalg.norm(away(scene, s, grid - x), axis=1) - a)
            grid, clear = grid[clear > -step], clear[clear > -step]
            for x, y, z, near, radius in zip(pores.x, pores.y, pores.z, pores.distance, pores.radius):
                r = np.linalg.norm(away(scene, s, grid - np.array([x, y, z])[:d]), axis=1)
                self.assertGreaterEqual(radius, near)
                self.assertGreaterEqual(radius, clear[r <= clear].max(initial=0) - 1e-9, (scene, n))
                self.assertLessEqual(radius, (clear + step)[r <= clear + 2 * step].max() + 1e-9, (scene, n))

    def test_the_widest_pore_of_a_box_touches_walls_alone(self):
        s = jam.System.from_arrays([[0.1, 0.1, 0.9]], 0.1, cell=[1, 1.1, 1.2], walls="xyz")
        self.assertAlmostEqual(s.pore_sizes(200, 1).radius.max(), 0.5, 12)
