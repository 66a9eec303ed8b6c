"""Proofs between flat walls: of what libjam jams there, of algebraic packings, and none of files that were changed."""
import math
import random
import unittest
from fractions import Fraction
from pathlib import Path

import numpy as np
from proof_files import (
    AT_WALLS, File, agree, another_wall, doubled, dropped, file_of, moved, other_side, try_changes, value, verdict, word,
)  # fmt: skip

import jam

SCENES = {
    "box": {"dim": 2, "walls": "xy", "packing_fraction": 0.3},
    "strip": {"dim": 2, "walls": "y", "packing_fraction": 0.3},
    "slit": {"dim": 3, "walls": "z", "packing_fraction": 0.2},
    "brick": {"dim": 3, "walls": "xyz", "packing_fraction": 0.2},
    "tilted": {"dim": 3, "walls": "z", "cell": [[1.0, 0.0, 0.0], [0.2, 1.0, 0.0], [0.0, 0.0, 1.3]], "packing_fraction": 0.2},
}


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


def other_sphere(f, r):
    line = r.choice(f.at_walls)
    line[1] = r.choice([str(k) for k, s in enumerate(f.spheres) if s[1] == "1" and [str(k), *line[2:4]] not in [c[1:4] for c in f.at_walls]])


def walls_elsewhere(f, r):
    line = f.header("walls")
    line[1:] = [str(len(f.spheres[0]) - 3)]


def leaning(f, r):
    """The cell vector of the last axis, which has walls, leans."""
    cell = f.header("cell")
    cell[-2] = word(Fraction(1, 10**6))


def closer_walls(f, r):
    f.scale(f.header("cell"), -1, Fraction(999, 1000))


def through_a_wall(f, r):
    line = r.choice(f.contacts)
    line[2 + len(f.spheres[0]) - 3] = "1"


def outside(f, r):
    """A sphere reflected at the wall that it touches: F is the same."""
    line = r.choice(f.at_walls)
    sphere, axis = f.spheres[int(line[1])], int(line[2])
    edge = value(f.header("cell")[1 + (axis + 1) * (axis + 2) // 2 - 1])
    x = sum(value(part) for part in sphere[3 + axis].split(","))
    sphere[3 + axis] = word((2 * edge if line[3] == "1" else 0) - x)


def rattler_outside(f, r):
    sphere = r.choice(f.spheres)
    far = [word(-2 * value(f.header("cell")[1])), *sphere[4:]]
    f.lines.append(["sphere", "0", sphere[2], *far])


REFUSED = {
    **AT_WALLS, "another wall": another_wall, "the other side": other_side, "another sphere": other_sphere, "no line walls": dropped("walls"),
    "line walls of another axis": walls_elsewhere, "line walls twice": doubled("walls"), "leaning": leaning,
    "walls closer": closer_walls, "contact through a wall": through_a_wall, "outside": outside, "rattler outside": rattler_outside,
    "centre off by 1e-3": moved(Fraction(1, 1000)),
}  # fmt: skip


class Walls(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = {name: isostatic(scene, range(1, 7)) for name, scene in SCENES.items()}

    def test_isostatic_packings_are_proved_by_both(self):
        for name, made in self.made.items():
            self.assertGreaterEqual(len(made), 2, name)
            for system, ratio in made:
                with self.subTest(scene=name, seed=system.info.seed):
                    proof = system.prove(ratio)
                    agree(self, proof, verdict(file_of(system, ratio)))
                    self.assertAlmostEqual(proof.packing_fraction, system.packing_fraction, delta=1e-13)

    def test_changed_files_are_not_proved(self):
        generator = random.Random(4)
        for name in ("box", "brick"):
            for made in self.made[name]:
                try_changes(self, file_of(*made), REFUSED, generator, scene=name)

    def test_a_wall_is_no_first_sphere(self):
        """Five loose disks that one more line, 'contact -1 1 0 0', would hold: -1 is a wall, and no sphere that stays."""
        self.assertEqual(verdict(Path(__file__).with_name("loose.jamproof").read_text()), "unreadable")

    def test_small_changes_stay_within_the_radius(self):
        generator = random.Random(5)
        for system, ratio in self.made["box"]:
            for power in (30, 20, 12, 9):
                f = File(file_of(system, ratio))
                moved(Fraction(1, 10**power))(f, generator)
                found = verdict(f.text())
                self.assertIsInstance(found, dict, found)
                self.assertGreaterEqual(found["radius"], 0.5 * 10.0**-power)

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
