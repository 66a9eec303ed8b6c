"""The set of certified packings of examples/studies/reference_set: its sums, its proofs and its densities."""
import csv
import hashlib
import math
import unittest
from fractions import Fraction
from pathlib import Path

import numpy as np

import jam
from compiled import compiled
from test_proof import ROOT, jamproof

FOLDER = ROOT / "examples/studies/reference_set"
# pi^k over the denominator: the volume of a ball of diameter 1
BALL = {2: (1, 4), 3: (1, 6), 4: (2, 32), 5: (2, 60)}


def pi(digits):
    """Machin's formula in whole numbers: pi 10^digits, off by less than 10^5."""
    one = 10**digits
    arctan = lambda x: sum((-1) ** k * (one // x ** (2 * k + 1)) // (2 * k + 1) for k in range(digits))
    return 4 * (4 * arctan(5) - arctan(239))


def phi(scene, digits=60):
    """The packing fraction of a file times 10^digits, by whole numbers alone."""
    power, denominator = BALL[scene.dim]
    spheres = sum(ratio**scene.dim for ratio in scene.ratio)
    volume = math.prod(Fraction(scene.cell[k][k], scene.one) for k in range(scene.dim))
    squared = scene.gamma**scene.dim * (spheres / volume / denominator) ** 2
    root = math.isqrt(math.floor(squared * 10 ** (2 * digits)))
    return Fraction(root) * (Fraction(pi(digits)) / 10**digits) ** power


class ReferenceSet(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with open(FOLDER / "index.csv", encoding="ascii") as file:
            cls.rows = list(csv.DictReader(file))

    def test_every_file_has_its_sum(self):
        sums = dict(reversed(line.split("  ")) for line in (FOLDER / "SHA256SUMS").read_text(encoding="ascii").splitlines())
        self.assertEqual(set(sums), {p.name for p in FOLDER.iterdir()} - {"SHA256SUMS"})
        for name, value in sums.items():
            self.assertEqual(hashlib.sha256((FOLDER / name).read_bytes()).hexdigest(), value, name)
        self.assertLess(sum(p.stat().st_size for p in FOLDER.iterdir()), 2e6)

    def test_packings_of_each_kind_and_theorem(self):
        kinds = {}
        for row in self.rows:
            kinds.setdefault((row["d"], row["N"], row["spheres"]), []).append((row["seed"], row["theorem"]))
        self.assertEqual({key[0] for key in kinds}, {"2", "3", "4", "5"})
        self.assertEqual(len(kinds), 8)
        for key, found in kinds.items():
            self.assertEqual({theorem for _, theorem in found}, {"trapped" if key[::2] == ("2", "equal") else "exact"}, key)

    def test_files_are_proved_and_have_the_density_of_the_index(self):
        first = {(row["d"], row["spheres"]): row for row in reversed(self.rows)}
        for row in first.values():
            with self.subTest(name=row["name"]):
                scene = jamproof.Scene(FOLDER / (row["name"] + ".jamproof"))
                status, words = jamproof.conclusion(scene)
                self.assertEqual((status, words.split(":")[0]), (0, "proved") if row["theorem"] == "exact" else (3, "trapped"))
                self.assertLess(float(row["error"]), 1e-26)
                self.assertLess(abs(phi(scene) / Fraction(10) ** 60 - Fraction(row["phi_J"])), Fraction(1, 10**25))

    def test_every_index_row_has_its_density(self):
        for row in self.rows:
            scene = jamproof.Scene(FOLDER / (row["name"] + ".jamproof"))
            self.assertLess(abs(phi(scene) / Fraction(10) ** 60 - Fraction(row["phi_J"])), Fraction(1, 10**25), row["name"])

    def test_frames_are_the_proved_packings(self):
        # In the order of the index. A proof refines the centres that a crunch ends with, which are at the maximum to about 1e-13.
        frames, dimensions = {}, compiled(2, 3, 4, 5)
        for row in self.rows:
            name = f"d{row['d']}-n{row['N']}.xyz"
            frames[name] = frames.get(name, -1) + 1
            scene = jamproof.Scene(FOLDER / (row["name"] + ".jamproof"))
            if int(row["d"]) not in dimensions:
                continue
            with jam.System.read(str(FOLDER / name), frame=frames[name]) as packing:
                centres = np.array([[float(Fraction(x, scene.one)) for x in sphere] for sphere in scene.x])
                off = (packing.positions - centres + 0.5) % 1 - 0.5
                self.assertLess(np.abs(off).max(), 1e-12, row["name"])
