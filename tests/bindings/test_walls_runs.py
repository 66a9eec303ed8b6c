"""Runs from one configuration, Monte Carlo of soft spheres, floppy modes and ensembles between walls."""
import tempfile
import unittest

import jam
import numpy as np
from wall_scenes import NARROW, SCENES, contact_rows, energy, start, wall_distances


class Runs(unittest.TestCase):
    def test_no_run_leaves_the_container(self):
        for name in ("slit", "can", "ball", "square", "circle"):
            for monte_carlo in (None, {"step": 0.1}):
                n = 30
                s = jam.System.random(n=n, seed=4, packing_fraction=0.2, diameters=1 + 0.5 * (np.arange(n) % 2), **NARROW[name])
                runs = s.isoconf([5, 20], runs=20, keep=[0, 1], monte_carlo=monte_carlo, density_ratio=0.999)
                a = s.diameters / 2 * 0.999 ** (1 / s.dim)
                for m in (0, 1):
                    for moved in runs.kept[m]:
                        least = wall_distances(NARROW[name], s.positions + moved, np.diag(s.cell))[0].min(1) / a
                        self.assertGreater(least.min(), 1 - 1e-9, name)
                self.assertGreater(np.abs(runs.kept[1]).max(), 2 * s.diameters.mean() * 0.2)

    def test_walls_take_momentum_and_open_axes_keep_it(self):
        s = start("slit", 60, 2)
        runs = s.isoconf([3.0], runs=10, keep=[0], density_ratio=0.999)
        for moved in runs.kept[0]:
            np.testing.assert_allclose(moved.mean(0)[:2], 0, atol=1e-12)
            self.assertGreater(abs(moved.mean(0)[2]), 1e-6)


class Observed(unittest.TestCase):
    def test_histograms_of_a_dilute_gas_are_1_beside_any_walls(self):
        """Pairs over those of partners spread evenly within the walls: without that a small container has fewer pairs by half."""
        for name, scene in NARROW.items():
            s = jam.System.random(n=100, seed=1, packing_fraction=0.02, diameters=1 + 0.5 * (np.arange(100) % 2), **scene)
            s.run(50)
            with s.observing(sample_every=4, gap_bins=4, gap_min=0.5, gap_max=2.0, r_bins=8, r_max=4.0) as seen:
                s.run(900 if s.dim == 2 else 300)
            np.testing.assert_allclose(seen.correlation.g[4:], 1, atol=0.08, err_msg=name)
            np.testing.assert_allclose(seen.gaps.density, 1, atol=0.15, err_msg=name)
            self.assertLess(np.abs(seen.gaps.density - 1).mean(), 0.06, name)


class SoftMonteCarlo(unittest.TestCase):

    def test_energy_counts_pairs_and_walls(self):
        for name in ("slit", "can", "circle", "square"):
            for unit, scale in (("length", "absolute"), ("relative", "relative")):
                s = jam.System.random(n=20, seed=3, packing_fraction=0.5, overlap="allow", diameters=1 + 0.5 * (np.arange(20) % 2), **NARROW[name])
                s.scale_diameters(1.3)
                expected = 2.5 * energy(NARROW[name], s.positions, s, scale, 2.5)
                self.assertTrue((wall_distances(NARROW[name], s.positions, np.diag(s.cell))[0].min(1) < s.diameters / 2).any())
                options = {"alpha": 2.5, "energy_unit": unit, "temperature": 1e-12, "step": 1e-12}
                runs = s.isoconf([1], runs=1, monte_carlo=options)
                self.assertAlmostEqual(runs.series["energy"].sum() * s.n / expected, 1, 9, (name, unit))

    def test_swaps_keep_the_boltzmann_weight_at_walls(self):
        # Two disks far apart, each held at a wall or free: the large one is at the wall with the weight of its overlap.
        s = jam.System.from_arrays([[0.2, 0.1], [0.7, 0.5]], [0.3, 0.4], dim=2, walls="y", overlap="allow")
        energy = {0.3: 0.05**2, 0.4: 0.1**2}
        temperature, at_wall = 0.005, []
        for _ in range(1500):
            s.monte_carlo(sweeps=2, alpha=2, temperature=temperature, step=1e-9, swap_share=0.5)
            at_wall.append(s.diameters[0] > 0.35)
        weight = np.exp(-(energy[0.4] - energy[0.3]) / temperature)
        self.assertLess(abs(np.mean(at_wall) - weight / (1 + weight)), 0.08)


class FloppyModes(unittest.TestCase):
    def test_opening_one_contact_keeps_the_others_closed(self):
        tried = 0
        for name in SCENES:
            s = start(name, 30, 1, unequal=True)
            r = s.crunch()
            if not r.jammed or s.rigidity().self_stresses != 1 or r.flexes:
                continue
            tried += 1
            table, c, a, d = s.floppy_modes(), s.contacts, s.diameters / 2, s.dim
            i, j = c.pairs.T
            wall = j < 0
            sigma, rows = a[i] + np.where(wall, 0, a[np.maximum(j, 0)]), contact_rows(s)[0]
            for k in (0, int(np.argmax(wall)), int(np.argmin(wall))):
                u = np.zeros((s.n, d))
                u[s.hessian_map()] = s.floppy_mode(k)
                shrink = -s.forces[k] / (s.forces @ sigma)
                np.testing.assert_allclose(rows @ u.ravel(), shrink * sigma + (np.arange(len(rows)) == k), atol=1e-10)
                # B is the second derivative of sum f r along the mode, by differences of true distances.
                h, twice = 1e-4 * s.diameters.mean() / np.abs(u).max(), 0.0
                for t, weight in ((-h, 1), (0, -2), (h, 1)):
                    y = s.positions + t * u
                    length = sigma[:, None] * c.vectors + t * (u[i] - u[np.maximum(j, 0)])
                    between = np.linalg.norm(length, axis=1)
                    beside = wall_distances(SCENES[name], y[i[wall]], np.diag(s.cell))[0][np.arange(wall.sum()), -1 - j[wall]]
                    twice += weight * ((s.forces[~wall] * between[~wall]).sum() + (s.forces[wall] * beside).sum())
                bend = twice / h**2
                if abs(bend) > 1e-3 * s.forces.sum() / s.diameters.mean() * (u**2).sum():
                    if bend > 0:
                        self.assertAlmostEqual(table.s_star[k] * bend / s.forces[k], 1, 3, name)
                    else:
                        self.assertTrue(np.isinf(table.s_star[k]), name)
        self.assertGreaterEqual(tried, 5)


class Ensembles(unittest.TestCase):
    def test_a_protocol_names_walls_and_container(self):
        for scene in (dict(cell=[1, 1, 2.4], walls="z"), dict(container="cylinder", walls="z", cell=[1, 1, 2]), dict(dim=2, container="ball")):
            with tempfile.TemporaryDirectory() as folder:
                e = jam.ensemble.Ensemble(folder, dict(n=20, stages=[], **scene))
                e.run([1, 2], progress=False, workers=1)
                for entry in e:
                    alone = jam.System.random(n=20, seed=entry.seed, packing_fraction=e.protocol["start"]["packing_fraction"], **scene)
                    alone.crunch()
                    np.testing.assert_array_equal(entry.positions, alone.positions)
                    np.testing.assert_array_equal(entry.system().walls().gap, alone.walls().gap)
                self.assertEqual(jam.ensemble.Ensemble(folder).protocol, e.protocol)

    def test_two_ways_to_write_a_scene_are_one_protocol(self):
        name = lambda **start: jam.ensemble.identity(jam.ensemble.complete(start))
        self.assertEqual(name(walls="z"), name(walls=(False, False, True)))
        self.assertEqual(name(walls="z", cell=[1, 1, 2]), name(walls="z", cell=np.diag([1, 1, 2])))
        self.assertEqual(name(), name(container="brick", walls=None))
        self.assertEqual(name(cell=[2, 2, 2]), name(box=2))
        self.assertNotEqual(name(walls="z"), name(walls="y"))
        self.assertEqual(name(n=128), "2c3245921be5")

    def test_wrong_scenes_are_named_before_the_work(self):
        for start, text in (
            (dict(container="torus"), "container must be one of"),
            (dict(container="ball", walls="x"), "no flat walls"),
            (dict(n=8, model="mk", walls="z"), "start: walls: Mari-Kurchan"),
            (dict(n=8, walls="yz", crunch={"strain": "free"}), "crunch: a crunch that changes the cell at fixed volume needs at least 2 axes without walls"),
            (dict(n=8, model="mk", stages=[{"verb": "monte_carlo"}]), r"stages\[0\]: Monte Carlo has no"),
            (dict(n=8, walls="z", non_additivity=0.1), "non_additivity is 0.1, with walls"),
            (dict(n=8, stages=[(0.1, 10), {"verb": "decompress"}]), r"stages\[1\]: decompress needs overlaps"),
        ):
            with self.assertRaisesRegex(jam.ensemble.ProtocolError, text):
                jam.ensemble.complete(start)
