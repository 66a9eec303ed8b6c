"""Trapping by the checker: crystals and other packings with more contacts than unknowns, and what it must refuse."""
import random
import sys
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

import numpy as np

import jam

sys.path.insert(0, str(Path(__file__).parent))
from test_proof import File, drop, file_of, jamproof, rattler_into_neighbour, value, word
from test_proof_bounds import checker, crystal, square_lattice


def disks(n, seed):
    system = jam.System.random(n, 2, seed)
    system.compress([(1e-2, 500.0), (3e-3, 1e7)])
    system.crunch()
    return system


def trapped(text, program=jamproof):
    """What the checker finds of a text, or the first word of its refusal."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "a.jamproof"
        path.write_text(text, encoding="ascii")
        try:
            return program.trapped(program.Scene(path))
        except program.Refused as why:
            return str(why).split(":")[0]


def density(text):
    """Gamma at which no pair of the file overlaps, and what the checker finds."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "a.jamproof"
        path.write_text(text, encoding="ascii")
        scene = jamproof.Scene(path)
    try:
        found = jamproof.trapped(scene)
    except jamproof.Refused as why:
        found = str(why)
    return jamproof.fraction(scene.g, scene.ge), found


def moved(text, by, generator):
    f = File(text)
    f.shift(generator.choice([s for s in f.spheres if s[1] == "1"]), 3, by)
    return f.text()


class Trapped(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.systems = [s for s in (disks(64, seed) for seed in range(1, 9)) if s.report.jammed and s.report.excess_contacts > 0]
        cls.texts = [file_of(s, None) for s in cls.systems]

    def test_the_checker_agrees_with_the_library(self):
        self.assertGreaterEqual(len(self.texts), 3)
        for system, text in zip(self.systems, self.texts):
            proof, found = system.prove(), trapped(text)
            self.assertNotEqual(proof.theorem, jam.Theorem.NONE)
            self.assertIsInstance(found, dict, found)
            self.assertLess(found["inner"], 1e-18)
            self.assertGreater(found["outer"], 1e-12)
            self.assertAlmostEqual(min(proof.least_gap, 1e-3), min(found["least_gap"], 1e-3), delta=1e-9)

    def test_status_and_words(self):
        with tempfile.TemporaryDirectory() as folder:
            path, other = folder + "/a.jamproof", folder + "/b.jamproof"
            for text in self.texts[:2]:
                Path(path).write_text(text, encoding="ascii")
                status, words = jamproof.conclusion(jamproof.Scene(path))
                self.assertIn((status, words.split(":")[0]), ((0, "proved"), (3, "trapped")))
                self.assertEqual(jamproof.main(path, other), status)
                self.assertEqual(jamproof.conclusion(jamproof.Scene(other)), (status, words))

    def test_a_packing_out_of_place_widens_the_trap(self):
        """The denser packing that was moved away from lies within inner, or nothing is claimed."""
        generator = random.Random(1)
        for text in self.texts:
            gamma, found = density(text)
            self.assertLess(found["gamma_error"], 1e-28)
            for power in (30, 20, 15, 12, 9, 6, 3):
                lower, found = density(moved(text, Fraction(1, 10**power), generator))
                if isinstance(found, dict):
                    self.assertGreater(found["inner"], 0.4 * 10.0**-power)
                    self.assertLess(lower, gamma * (1 + Fraction(1, 10**28)))
                    self.assertLess(gamma, lower * (1 + Fraction(found["gamma_error"]) * (1 + Fraction(1, 10**9))))

    def test_what_is_not_trapped_is_refused(self):
        generator = random.Random(2)
        for text in self.texts:
            f = File(text)
            rattler_into_neighbour(f, generator)
            self.assertEqual(trapped(f.text()), "gap")
            f = File(text)
            for line in f.contacts:  # forces are hints: one step balances them, but not from the opposite of all
                f.scale(line, 5, -1)
            self.assertEqual(trapped(f.text()), "force")
        self.assertIsInstance(trapped(square_lattice()), str)
        for take in range(1, 12):  # too few contacts hold nothing
            f = File(self.texts[0])
            while len(f.contacts) > 2 * sum(s[1] == "1" for s in f.spheres) - 2 - take:
                drop(f, generator)
                f = File(f.text())
            self.assertIsInstance(trapped(f.text()), str)

    def test_a_crystal_is_trapped_and_stays_so_when_rounded(self):
        base = [(0, 0, 0), (0.5, 0.5, 0), (0.5, 0, 0.5), (0, 0.5, 0.5)]
        rows = [tuple((g + b) / 2 for g, b in zip(grid, x)) for grid in np.ndindex(2, 2, 2) for x in base]
        text = "\n".join(crystal(rows, Fraction(1, 8), 1)) + "\n"
        found = trapped(text)
        self.assertIsInstance(found, dict, found)
        self.assertLess(found["inner"], 1e-30)
        f, generator = File(text), random.Random(3)
        for s in f.spheres:
            s[3:] = [word(value(x) + Fraction(generator.randrange(-9, 10), 10**17)) for x in s[3:]]
        found = trapped(f.text())
        self.assertIsInstance(found, dict, found)
        self.assertTrue(1e-17 < found["inner"] < 1e-10 < found["outer"])

    def test_each_bound_is_needed(self):
        """With one bound taken out of the checker a false file passes."""
        far, generator = Fraction(1, 10**6), random.Random(4)
        text = moved(self.texts[0], far, generator)
        far_off = moved(self.texts[0], Fraction(1, 10**2), generator)
        f = File(self.texts[0])
        rattler_into_neighbour(f, generator)
        overlap = f.text()
        table = (
            ("opening", "opening, _, columns = equations(s, every)", "opening, _, columns = [(1, -200)] * len(every), 0, equations(s, every)[2]", text),
            ("room for second order", "if left <= 0 or 4 * constant * square >= left**2:", "if left <= 0:", far_off),
            ("pairs stay apart", "if have <= need:", "if False:", overlap),
        )  # fmt: skip
        for name, old, new, false in table:
            with self.subTest(bound=name):
                near = 0.4 * float(far) if false is text else 0.0
                claims = lambda found: isinstance(found, dict) and (false is overlap or found["inner"] < near or found["outer"] <= found["inner"])
                self.assertFalse(claims(trapped(false)), trapped(false))
                program = checker((old, new))
                self.assertTrue(claims(trapped(false, program)), trapped(false, program))


if __name__ == "__main__":
    unittest.main()
