"""Proofs between flat and round walls: of what libjam jams there, of algebraic packings, by Newton's method in decimals, and none of
files that were changed."""
import copy
import decimal
import math
import random
import re
import unittest
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np
from proof_files import FLAT, ROUND, File, agree, apart, file_of, jamproof, moved, scene_of, try_changes, value, verdict

import jam

SCENES = {
    "box": {"dim": 2, "walls": "xy", "packing_fraction": 0.3},
    "strip": {"dim": 2, "walls": "y", "packing_fraction": 0.3},
    "slit": {"dim": 3, "walls": "z", "packing_fraction": 0.2},
    "brick": {"dim": 3, "walls": "xyz", "packing_fraction": 0.2},
    "tilted": {"dim": 3, "walls": "z", "cell": [[1.0, 0.0, 0.0], [0.2, 1.0, 0.0], [0.0, 0.0, 1.3]], "packing_fraction": 0.2},
    "circle": {"dim": 2, "container": "ball", "packing_fraction": 0.3},
    "ball": {"dim": 3, "container": "ball", "packing_fraction": 0.2},
    "tube": {"dim": 3, "container": "cylinder", "packing_fraction": 0.2},
    "can": {"dim": 3, "container": "cylinder", "walls": "z", "packing_fraction": 0.2},
}
PINS = {"circle": 1, "ball": 3, "tube": 1, "can": 1}


def isostatic(scene, seeds, n=24):
    """Packings of two sizes with as many contacts as unknowns, and their ratio."""
    ratio, made = np.where(np.arange(n) % 2, 1.4, 1.0), []
    for seed in seeds:
        system = jam.System.random(n=n, seed=seed, diameters=ratio, **scene)
        system.compress(growth_rate=1e-2, pressure=1e4)
        system.crunch()
        if system.report.jammed and system.report.excess_contacts == 0:
            made.append((system, ratio))
    return made


def ring(n, loose=0):
    """Disks in a circle of width 1, at the wall in a ring; others in the middle."""
    angle = 2 * math.pi * np.arange(n) / n + 0.3
    near = math.sin(math.pi / n) / (1 + math.sin(math.pi / n))
    x = 0.5 + (0.5 - near / 2) * np.stack([np.cos(angle), np.sin(angle)], 1)
    x = np.concatenate([x, np.full((loose, 2), 0.5)])
    system = jam.System.from_arrays(x, near * (1 - 1e-3), cell=[1.0, 1.0], container="ball", dim=2)
    system.crunch()
    return system


def root(x):
    """Of a fraction, to 60 digits."""
    return Fraction(math.isqrt(math.floor(x * 10**120)), 10**60)


def newton(scene):
    """The centres (n, d) and g where all contacts close, in decimals: distances by square roots, not F of the file."""
    with decimal.localcontext() as context:
        context.prec = 80
        exact = lambda v: Decimal(v.numerator) / Decimal(v.denominator)
        one, d = Decimal(scene.one), scene.dim
        x, g = [[Decimal(c) / one for c in row] for row in scene.x], exact(scene.growth)
        cell, ratio = [[Decimal(c) / one for c in row] for row in scene.cell], list(map(exact, scene.ratio))
        middle = cell[0][0] / 2
        for _ in range(12):
            gaps, rows = [], []
            for i, j, n in scene.contacts:
                row = np.zeros(scene.unknowns + 1)
                if j == scene.rim:
                    way, sign = [(x[i][c] - middle) if c < scene.round else Decimal(0) for c in range(d)], -1
                elif j < 0:
                    axis, far = divmod(-1 - j, 2)
                    way, sign = [Decimal(0)] * d, 1
                    way[axis] = x[i][axis] - far * cell[axis][axis]
                else:
                    way = [a - b + sum(n[q] * cell[q][c] for q in range(d)) for c, (a, b) in enumerate(zip(x[i], x[j]))]
                    sign = 1
                length = sum(v * v for v in way).sqrt()
                need = (ratio[i] + ratio[j]) / 2 if j >= 0 else ratio[i] / 2
                gaps.append((middle - length if j == scene.rim else length) - g * need)
                for end, part in ((i, sign), (j, -sign)):
                    for c in range(d):
                        if (end, c) in scene.place:
                            row[scene.place[end, c]] += part * float(way[c] / length)
                row[-1] = -float(need)
                rows.append(row)
            size = max(map(abs, gaps))
            if size < Decimal(10) ** -60:
                break
            step = np.linalg.solve(np.array(rows), [float(v / size) for v in gaps])
            for (i, c), at in scene.place.items():
                x[i][c] -= Decimal(float(step[at])) * size
            g -= Decimal(float(step[-1])) * size
        return x, g, size


def away(scene):
    """How far the written numbers are from those: the largest difference, of centres and g."""
    x, g, left = newton(scene)
    with decimal.localcontext() as context:
        context.prec = 80
        far = [abs(a - Decimal(b) / scene.one) for row, own in zip(x, scene.x) for a, b in zip(row, own)]
        far.append(abs(g - Decimal(scene.growth.numerator) / scene.growth.denominator))
        return max(far), left


class Walls(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = {name: isostatic(scene, range(1, 6)) for name, scene in SCENES.items()}

    def test_isostatic_packings_are_proved_by_both(self):
        for name, made in self.made.items():
            self.assertGreaterEqual(len(made), 2, name)
            for system, ratio in made:
                with self.subTest(scene=name, seed=system.info.seed):
                    text, proof = file_of(system, ratio), system.prove(ratio)
                    scene = scene_of(text)
                    agree(self, proof, jamproof.check(scene), 1e-27)
                    low, high = jamproof.fraction(scene)
                    self.assertLess(high / low - 1, Fraction(1, 10**25))
                    for fraction in (float(low), proof.packing_fraction):
                        self.assertAlmostEqual(fraction, system.packing_fraction, delta=1e-13)
                    self.assertEqual(len(File(text).of("pin")), PINS.get(name, 0))

    def test_changed_files_are_not_proved(self):
        generator = random.Random(4)
        for name, kinds in (("box", FLAT), ("brick", FLAT), *((name, ROUND) for name in PINS)):
            for made in self.made[name][:2]:
                try_changes(self, file_of(*made), kinds, generator, scene=name)

    def test_a_wall_is_no_first_sphere(self):
        """Five loose disks that one more line, 'contact -1 1 0 0', would hold: -1 is a wall, and no sphere that stays."""
        self.assertEqual(verdict(Path(__file__).with_name("loose.jamproof").read_text()), "unreadable")

    def test_the_second_order_is_bounded(self):
        """D of Theorem A bounds the bilinear form of F'' / 2 on motions and changes of g, also where unlike spheres stay farther apart."""
        for name in PINS:
            scene = scene_of(apart(file_of(*self.made[name][0])))
            bound, every = jamproof.second_order(scene)[0], range(len(scene.contacts))

            def f_at(c, way, grown):
                moved = copy.deepcopy(scene)
                i, j, _ = moved.contacts[c]
                for k in range(moved.dim):
                    for end, sign in ((i, 1), (j, -1)):
                        if (end, k) in moved.place:
                            moved.x[end][k] += sign * way * moved.one
                moved.growth += grown
                moved.gamma = moved.growth**2
                return moved.equations(every)[0][c]

            for c in every:
                square = f_at(c, 2, 0) - f_at(c, 1, 1) - f_at(c, 1, -1) + f_at(c, 0, 0)
                self.assertLessEqual(abs(square) / 2, bound, (name, scene.contacts[c]))

    def test_small_changes_stay_within_the_radius(self):
        generator = random.Random(5)
        for system, ratio in self.made["box"]:
            for power in (30, 20, 12, 9):
                f = File(file_of(system, ratio))
                moved(Fraction(1, 10**power))(f, generator)
                found = verdict(f.text())
                self.assertIsInstance(found, dict, found)
                self.assertGreaterEqual(found["radius"], 0.5 * 10.0**-power)

    def test_decimals_lie_within_the_radius(self):
        """Of the file, and of files whose spheres are moved: there the radius has no more than two digits to spare."""
        generator = random.Random(3)
        for name in PINS:
            for power in (None, 20, 9):
                with self.subTest(scene=name, power=power):
                    system, ratio = self.made[name][0]
                    f = File(file_of(system, ratio))
                    if power:
                        moved(Fraction(1, 10**power))(f, generator)
                    scene = scene_of(f.text())
                    found, (far, left) = verdict(f.text()), away(scene)
                    self.assertIsInstance(found, dict, found)
                    self.assertLess(left, Decimal(10) ** -60)
                    radius = found["radius"] / scene.unit
                    self.assertLess(Fraction(far), radius)
                    if power:
                        self.assertLess(radius, 10**5 * Fraction(far))

    def test_sums_and_symmetries_have_no_round_wall(self):
        for line in (["sum", *["1p0"] * 24], ["symmetry", "2", "1", *map(str, range(24))]):
            f = File(file_of(*self.made["circle"][0]))
            f.lines.append(line)
            self.assertEqual(verdict(f.text()), "unreadable")

    def test_a_pin_that_no_rotation_moves_proves_nothing(self):
        """Along the axis of a tube: the rotation about it leaves every height as it is."""
        for system, ratio in self.made["tube"]:
            f = File(file_of(system, ratio))
            f.header("pin")[2] = "2"
            first = next(str(k) for k, s in enumerate(f.spheres) if s[1] == "1")
            f.header("pin")[1] = next(str(k) for k, s in enumerate(f.spheres) if s[1] == "1" and str(k) != first)
            self.assertEqual(verdict(f.text()), "singular")

    def enclosed(self, system, known):
        """Whether the proved g encloses the exact one: the diameter over the width of the wall."""
        text = file_of(system, np.ones(system.n))
        found, scene = verdict(text), scene_of(text)
        self.assertIsInstance(found, dict, found)
        ratio = scene.growth * scene.one / scene.width
        self.assertLess(abs(ratio / known - 1), Fraction(found["gamma_error"]) + Fraction(1, 10**55))
        self.assertLess(found["gamma_error"], 1e-28)
        self.assertEqual(system.prove(np.ones(system.n)).theorem, jam.Theorem.EXACT)

    def test_rings_of_disks(self):
        """sin(pi / n) is that of square roots."""
        sines = {3: root(Fraction(3, 4)), 4: root(Fraction(1, 2)), 5: root((5 - root(Fraction(5))) / 8), 6: Fraction(1, 2)}
        for n, sine in sines.items():
            with self.subTest(n=n):
                system = ring(n)
                self.assertEqual(system.report.contacts, 2 * n)
                self.enclosed(system, sine / (1 + sine))

    def test_seven_disks_are_trapped(self):
        """The sixth of the circle leaves room for just one more in the middle: 18 contacts, where 14 would do."""
        system = ring(6, loose=1)
        proof = system.prove(np.ones(7))
        self.assertEqual((proof.contacts, proof.theorem, proof.cause), (18, jam.Theorem.TRAPPED, jam.ProofCause.EXCESS))
        self.assertAlmostEqual(proof.gamma, 1 / 9, delta=1e-15)
        scene = scene_of(file_of(system, np.ones(7)))
        status, text = jamproof.conclusion(scene)
        self.assertEqual((status, text.split(":")[0]), (3, "trapped"), text)
        inner, error = (float(re.search(f"{name} ([0-9.e+-]+)", text)[1]) for name in ("inner", "gamma_error"))
        self.assertLess(max(proof.inner, inner, error), 1e-20)
        known = (Fraction(scene.width, scene.one) / 3) ** 2
        self.assertLess(abs(scene.gamma / known - 1), Fraction(error) + Fraction(1, 10**20))

    def test_two_disks_are_kept_by_the_curvature_alone(self):
        system = jam.System.from_arrays([[0.26, 0.5], [0.74, 0.5]], 0.47, cell=[1.0, 1.0], container="ball", dim=2)
        system.crunch()
        proof = system.prove(np.ones(2))
        self.assertEqual((proof.theorem, proof.cause), (jam.Theorem.NONE, jam.ProofCause.EXCESS))
        self.assertEqual((proof.cause_value, proof.cause_bound), (3, 4))
        self.assertIn(verdict(file_of(system, np.ones(2))), ("excess", "singular"))  # the latter where all F are 0

    def test_two_spheres_on_the_diagonal(self):
        """Of a square and a cube of edge 1: the diameter is sqrt(d) / (1 + sqrt(d)), by square roots of whole numbers."""
        for d in (2, 3):
            near = math.sqrt(d) / (1 + math.sqrt(d))
            x = np.array([[near / 2] * d, [1 - near / 2] * d])
            system = jam.System.from_arrays(x, near * (1 - 1e-3), walls="xyz"[:d], dim=d)
            system.crunch()
            self.assertEqual(system.report.contacts, 2 * d + 1)
            text = file_of(system, np.ones(2))
            found, root = verdict(text), math.isqrt(d * 10**120)  # of d, times 10^60
            self.assertIsInstance(found, dict, found)
            gamma = Fraction(root, 10**60 + root) ** 2
            known = sum(map(value, File(text).gamma[1].split(",")))
            self.assertLess(abs(known / gamma - 1), Fraction(found["gamma_error"]) + Fraction(1, 10**55))
            self.assertLess(found["gamma_error"], 1e-28)

    def test_two_disks_in_a_row_close_exactly(self):
        system = jam.System.from_arrays([[0.5, 0.5], [1.5, 0.5]], 0.99, cell=[2.0, 1.0], walls="xy", dim=2)
        system.crunch()
        text = file_of(system, np.ones(2))
        self.assertEqual(system.prove(np.ones(2)).theorem, jam.Theorem.EXACT)
        self.assertEqual(verdict(text)["radius"], 0, text)
