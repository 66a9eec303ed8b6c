"""Jammed packings in containers: densest known ones, and the verdict by another arithmetic than the library's.

Walls, contacts, forces (HiGHS), rank (SVD) and curvature (differences of true distances) are computed here from positions.
"""
import unittest
from math import pi, sin, sqrt

import jam
import numpy as np
from jamming_oracle import support
from wall_scenes import SCENES, all_gaps, away, largest_growth, start, wall_distances

SYMMETRIES = {"lines": 1, "box": 0, "circle": 1, "slit": 2, "brick": 0, "tube": 2, "can": 1, "ball": 3, "cone": 1}


def rows_of(gaps, n, d):
    """Rows n . (u_i - u_j)."""
    rows = np.zeros((len(gaps), n * d))
    for row, (_, i, j, u, _) in zip(rows, gaps):
        row[i * d : i * d + d] += u
        if j >= 0:
            row[j * d : j * d + d] -= u
    return rows


def oracle(name, s, tolerance=1e-10):
    """Contacts with force, flexes beyond the symmetries of the scene, least curvature against them."""
    n, d = s.positions.shape
    found = [g for g in all_gaps(SCENES[name], s) if g[0] < tolerance]
    rows = rows_of(found, n, d)
    on = support(rows, None, d)
    spheres = sorted({q for k in np.flatnonzero(on) for q in found[k][1:3] if q >= 0})
    columns = np.concatenate([np.arange(b * d, b * d + d) for b in spheres])
    kept = rows[np.ix_(on, columns)]
    values, right = np.linalg.svd(kept)[1:]
    rank = int((values > 1e-6 * values[0]).sum())
    null = right[rank:]
    force = np.linalg.svd(kept.T)[2][-1]
    return {"on": {tuple(found[k][1:3]) for k in np.flatnonzero(on)}, "spheres": spheres, "null": null, "states": len(kept) - rank,
            "force": force / force.mean(), "found": [found[k] for k in np.flatnonzero(on)]}


class Verdicts(unittest.TestCase):
    def test_contacts_forces_and_rank_agree_with_another_arithmetic(self):
        for name, symmetries in SYMMETRIES.items():
            for seed in (1, 2):
                with self.subTest(name, seed=seed):
                    n = 30
                    s = start(name, n, seed, unequal=True)
                    r = s.crunch()
                    self.assertTrue(r.jammed)
                    gaps = np.array([g[0] for g in all_gaps(SCENES[name], s)])
                    self.assertGreater(gaps.min(), -1e-13)
                    told = oracle(name, s)
                    pairs = {tuple(p) for p in s.contacts.pairs}
                    self.assertEqual(told["on"], pairs)
                    self.assertEqual((len(pairs), len(told["spheres"])), (r.contacts, r.stable))
                    self.assertEqual(r.isostatic_contacts, s.dim * r.stable - symmetries + 1)
                    self.assertEqual(told["states"], 1 + r.excess_contacts + len(told["null"]) - symmetries)
                    self.assertEqual(len(told["null"]) - symmetries, r.flexes)
                    self.assertEqual(np.flatnonzero(s.rattlers).tolist(), [i for i in range(n) if i not in told["spheres"]])
                    if told["states"] == 1:
                        by_pair = {p[1:3]: f for p, f in zip(told["found"], told["force"])}
                        np.testing.assert_allclose([by_pair[tuple(p)] for p in s.contacts.pairs], s.forces, atol=1e-8)
                    self.assertEqual((s.rigidity().jammed, s.check().jammed), (1, 1))
                    ends = s.contacts.pairs
                    np.testing.assert_array_equal(s.coordination, np.bincount(ends[ends >= 0], minlength=n))
                    stable, own = s.coordination > 0, np.bincount(ends[ends[:, 1] >= 0].ravel(), minlength=n)
                    np.testing.assert_array_equal(s.near_coordination(1e-9)[stable], own[stable])

    def test_one_period_between_walls_is_held_by_contacts_along_it(self):
        """Without these the cell can shorten. Check and strict test agree, in closed boxes too."""
        no, yes = jam.Verdict.NO, jam.Verdict.YES
        root = sqrt(0.75)
        scenes = (
            ([[0.5, 0.5]], [3, 1], "y", yes, no),
            ([[0.5, 0.5, 0.5]], [3, 1, 1], "yz", yes, no),
            ([[0.5, 0.5], [0.5, 1.5]], [1.75, 2], "y", no, no),
            ([[0.5, 0.5], [1, 0.5 + root]], [1, 1 + root], "y", yes, yes),
            ([[0.5, 0.5]], [1, 1], "xy", yes, yes),
        )
        for x, cell, walls, collective, strict in scenes:
            s = jam.System.from_arrays(x, 1.0, cell=cell, walls=walls, dim=len(cell))
            c, r = s.check(), s.rigidity("strict")
            self.assertEqual((c.jammed, c.strictly_jammed, r.jammed), (collective, strict, strict), (cell, walls))
            if collective is yes and strict is no:
                motion, strain = s.flex("strict")
                self.assertEqual(strain[0, 0], -np.abs(strain).max())
                np.testing.assert_array_equal(motion, 0)

    def test_layers_along_lines_hold_weak_forces(self):
        # Positive forces that balance, on contacts that fix all disks but for a shift along the lines, are a proof (B. Roth and
        # W. Whiteley, Trans. Amer. Math. Soc. 265, 419 (1981)). Disks in layers are held from the side by forces below 1e-6.
        s = start("strip", 300, 1, 0.3)
        s.compress([(1e-2, 500.0), (3e-3, 1e7)])
        self.assertTrue(s.crunch().jammed)
        gaps = {g[1:3]: g for g in all_gaps(SCENES["strip"], s)}
        self.assertGreater(min(g[0] for g in gaps.values()), -1e-13)
        listed, force = [gaps[tuple(p)] for p in s.contacts.pairs], s.forces
        self.assertLess(max(g[0] for g in listed), 1e-10)
        self.assertGreater(force.min(), 0)
        self.assertLess(force.min(), 1e-6)
        rows = rows_of(listed, 300, 2)
        rows = rows[:, rows.any(0)]
        self.assertLess(np.abs(force @ rows).max(), 1e-12)
        values = np.linalg.svd(rows, compute_uv=False)
        self.assertEqual((values > 1e-4).sum(), rows.shape[1] - SYMMETRIES["lines"])

    def test_one_verdict_where_contacts_are_open_by_more_than_rounding(self):
        # Two spheres nearly in single file, as LPs leave them: contacts open by 2e-11, forces that balance to 5e-7.
        x = [[0.5026561775470215, 0.5005229948407548, 1.0937418726509747],
             [0.4973438486658495, 0.49947687204512475, 0.09917096246221566]]  # fmt: skip
        near = jam.System.from_arrays(x, [0.9945856476778542] * 2, container="cylinder", cell=[1, 1, 1.989141820377518])
        for verdict in (near.rigidity(), near.check()):
            self.assertEqual(verdict.jammed, jam.Verdict.UNDECIDED)

    def test_zigzags_nearly_in_single_file(self):
        # Two spheres opposite each other in a tube of width 1: d^2 = (L / 2)^2 + (1 - d)^2. A turn of one about the axis
        # opens their contacts by its square times 1 - d.
        random = np.random.default_rng(1)
        for seed in range(6):
            length = 2.0 - random.uniform(0.005, 0.2)
            tube = {"container": "cylinder", "cell": [1, 1, length]}
            s = jam.System.random(n=2, seed=seed, packing_fraction=0.12, **tube)
            self.assertTrue(s.crunch().jammed, length)
            self.assertAlmostEqual(s.diameters[0], 0.5 + length**2 / 8, delta=1e-14)
            fresh = jam.System.from_arrays(s.positions, s.diameters, **tube)
            for verdict in (s.rigidity(), s.check(), fresh.rigidity(), fresh.check()):
                self.assertEqual(verdict.jammed, jam.Verdict.YES, length)

    def test_spheres_as_wide_as_a_tube_are_named(self):
        # In a longer tube the width alone limits the diameters; the spheres stay free along the axis.
        for n, length in ((2, 2.7), (3, 3.9), (2, 4.0)):
            for walls in ({}, {"walls": "z"}):
                s = jam.System.random(n=n, seed=7, container="cylinder", cell=[1, 1, length], packing_fraction=0.1, **walls)
                report = s.crunch()
                self.assertFalse(report.jammed)
                self.assertAlmostEqual(s.diameters[0], 1.0, delta=1e-7)
                self.assertIn("fills the width of the container", str(report))


class Densest(unittest.TestCase):
    """Best of many starts against published optima (R. L. Graham et al., Discrete Math. 181, 139 (1998) for disks)."""

    def best(self, name, n, seeds, phi):
        ratios = []
        for seed in range(1, seeds + 1):
            s = start(name, n, seed, phi)
            s.crunch()
            ratios.append(s.cell[0, 0] / s.diameters[0])
        return min(ratios)

    def test_disks_in_a_circle(self):
        known = {2: 2, 3: 1 + 2 / sqrt(3), 4: 1 + sqrt(2), 5: 1 + sqrt(2 + 2 / sqrt(5)), 6: 3, 7: 3, 8: 1 + 1 / sin(pi / 7),
                 9: 1 + sqrt(4 + 2 * sqrt(2)), 11: 1 + 1 / sin(pi / 9), 13: 2 + sqrt(5), 19: 1 + sqrt(2) + sqrt(6)}
        for n, ratio in known.items():
            self.assertAlmostEqual(self.best("circle", n, 16, 0.15), ratio, 12, n)
        for n, radius in {10: 0.262258924190, 12: 0.248163470572}.items():  # of the disks in a unit circle
            self.assertAlmostEqual(1 / self.best("circle", n, 16, 0.15), radius, 11, n)

    def test_spheres_in_a_ball(self):
        known = {2: 2, 3: 1 + 2 / sqrt(3), 4: 1 + sqrt(1.5), 5: 1 + sqrt(2), 6: 1 + sqrt(2), 9: 1 + sqrt(3), 12: 1 + sqrt((5 + sqrt(5)) / 2)}
        for n, ratio in known.items():
            self.assertAlmostEqual(self.best("ball", n, 8, 0.05), ratio, 12, n)

    def test_zigzags_in_a_channel_and_a_tube(self):
        # Neighbours touch, and each its wall: d^2 = (L / n)^2 + (D - d)^2.
        for name, dim in (("lines", 2), ("tube", 3)):
            for n, length in ((4, 3.0), (6, 4.0), (8, 6.5)):
                found = 0
                for seed in range(1, 9):
                    s = jam.System.random(n=n, seed=seed, packing_fraction=0.1, **{**SCENES[name], "cell": ([length, 1], [1, 1, length])[dim - 2]})
                    r = s.crunch()
                    found += r.jammed and abs(s.diameters[0] / (((length / n) ** 2 + 1) / 2) - 1) < 1e-12
                    if name == "tube" and r.jammed:  # two contacts a sphere: the curvature of the wall holds the rest
                        self.assertGreater(r.flexes, 0)
                self.assertGreater(found, 0, (name, n))

    def test_layers_of_two_and_of_three_in_a_tube(self):
        # Where the tube just holds k = 2 or 3 spheres side by side, these lie in layers that are turned by pi / k. Two
        # spheres of neighbouring layers are 2 r sin(pi / 2 k) apart across the axis, r = (1 - d) / 2, and touch (G. T.
        # Pickett, M. Gross and H. Okuyama, Phys. Rev. Lett. 85, 3652 (2000)). Each sphere touches the wall, the others of
        # its layer and two of each layer beside it.
        for k, layers, contacts in ((2, 2, 14), (2, 4, 28), (3, 2, 24), (3, 4, 48)):
            d = 1 / (1 + 1 / np.sin(np.pi / k))
            height = layers * np.sqrt(d**2 - ((1 - d) * np.sin(np.pi / (2 * k))) ** 2)
            best = 0.0
            for seed in range(1, 7):
                s = jam.System.random(n=k * layers, seed=seed, packing_fraction=0.1, container="cylinder", cell=[1, 1, height])
                r = s.crunch()
                if s.diameters[0] > best:
                    best, report = s.diameters[0], r
            self.assertAlmostEqual(best / d, 1, 12, (k, layers))
            self.assertEqual(report.contacts, contacts)


class Curvature(unittest.TestCase):
    def test_flexes_that_a_round_wall_holds_close_contacts(self):
        for name, n, phi in (("circle", 2, 0.1), ("ball", 2, 0.05), ("ball", 3, 0.05), ("tube", 4, 0.05)):
            s = jam.System.random(n=n, seed=2, packing_fraction=phi, **{**SCENES[name], **({"cell": [1, 1, 3]} if name == "tube" else {})})
            r = s.crunch()
            told = oracle(name, s)
            self.assertTrue(r.jammed and r.flexes > 0 and r.excess_contacts < 0)
            self.assertEqual(told["states"], 1)
            d, step = s.dim, 1e-4
            index = {tuple(g[1:3]): k for k, g in enumerate(told["found"])}

            def load(u):
                x = s.positions.copy()
                x[told["spheres"]] += step * u.reshape(-1, d)
                distance = wall_distances(SCENES[name], x, np.diag(s.cell))[0]
                total = 0.0
                for (i, j), k in index.items():
                    if j < 0:
                        total += told["force"][k] * distance[i, -1 - j]
                    else:
                        total += told["force"][k] * np.linalg.norm(away(SCENES[name], s, x[i] - x[j]))
                return total

            null = told["null"]
            form = np.zeros((len(null), len(null)))
            for a, b in np.ndindex(form.shape):
                u, v = null[a], null[b]
                form[a, b] = (load(u + v) + load(-u - v) - load(u - v) - load(v - u)) / (4 * step**2)
            held = np.linalg.eigvalsh(form)
            self.assertLess(held.max(), 1e-4)  # flat along the symmetries alone
            self.assertEqual((held < -1e-3).sum(), r.flexes)

    def test_hessian_has_the_curvature_of_the_wall(self):
        for name in ("circle", "tube", "ball", "cone"):
            s = start(name, 20, 2, unequal=True)
            s.crunch()
            spheres, (c, f) = s.hessian_map(), (s.contacts, s.forces)
            u = np.random.default_rng(3).normal(size=(len(spheres), s.dim))
            edges, step, t = np.diag(s.cell), 1e-4, 0.5

            def lengths(step):
                x = s.positions.copy()
                x[spheres] += step * u
                i, j = c.pairs.T
                r = np.linalg.norm(away(SCENES[name], s, x[i] - x[np.maximum(j, 0)]), axis=1)
                walls = wall_distances(SCENES[name], x, edges)[0]
                return np.where(j < 0, walls[i, np.where(j < 0, -1 - j, 0)], r)

            bend = (lengths(step) + lengths(-step) - 2 * lengths(0)) / step**2
            plain, stressed = (s.hessian(prestress=p) for p in (0.0, t))
            flat = u.ravel()
            expected = -t * s.diameters.mean() * (f * bend).sum()
            got = flat @ (stressed @ flat) - flat @ (plain @ flat)
            self.assertAlmostEqual(got / expected, 1, 4)
            slope = (lengths(step) - lengths(-step)) / (2 * step)
            self.assertAlmostEqual((slope**2).sum() / (flat @ (plain @ flat)), 1, 5)
            rotation = s.positions[spheres] - edges / 2  # about z, or in the plane
            rotation = np.stack([-rotation[:, 1], rotation[:, 0]] + [0 * rotation[:, 0]] * (s.dim - 2), axis=1).ravel()
            self.assertLess(np.abs(stressed @ rotation).max(), 1e-11)
            self.assertGreater(s.modes(k=3).values[0], 1e-7)  # the rotation is none of them


class Steps(unittest.TestCase):
    def test_no_step_leaves_a_round_wall(self):
        for name in ("circle", "tube", "ball", "cone"):
            for method in ("sequential_lp", "barrier_path"):
                s = start(name, 12, 4)
                x, phi, moves = s.positions.copy(), s.packing_fraction, []
                s.crunch(method=method, on_step=lambda step, moves=moves: moves.append(step.displacements.copy()))
                steps, edges = s.history["phi"], np.diag(s.cell)
                self.assertEqual(len(moves), len(steps))
                for move, now in zip(moves, steps):
                    x += move
                    factor = (now / s.packing_fraction) ** (1 / s.dim)  # diameters over those of the end
                    self.assertGreater(largest_growth(SCENES[name], s, x) / factor, 1 - 1e-12, (name, method))
                self.assertLess(np.abs(np.mod(x - s.positions + edges / 2, edges) - edges / 2).max(), 1e-9)
                if method == "sequential_lp":  # diameters never shrink
                    self.assertGreater(np.diff(np.concatenate([[phi], steps])).min(), -1e-13)


class CurvatureMargin(unittest.TestCase):
    def test_two_disks_in_a_circle(self):
        """By hand, for diameter 1: both move across the line of centres by 1 / sqrt(2), and the walls at 1 / 2 close by
        second derivatives of -2. Their sum is 2, over the mean 5 / 3 of curvatures 2, 2 and 1."""
        s = jam.System.from_arrays([[0.25, 0.5], [0.75, 0.5]], 0.5, box=1.0, dim=2, container="ball")
        for found in (s.rigidity(), s.check(crunch=False)):
            self.assertEqual((found.jammed, found.flexes), (jam.Verdict.YES, 1))
            self.assertAlmostEqual(found.curvature_margin, 1.2, 12)
            self.assertAlmostEqual(found.rigidity_margin, 1.0, 12)  # of the two motions along the line: 1 and 3
        square = jam.System.from_arrays([[0, 0], [0.5, 0.5]], 0.5**0.5, box=1.0, dim=2)
        self.assertEqual(square.rigidity().curvature_margin, 0.0)
