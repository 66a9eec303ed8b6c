"""The set of certified packings of examples/studies/reference_set: its sums, its proofs, its densities, and the script that makes it."""
import csv
import hashlib
import json
import math
import sys
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

import numpy as np

import jam
from compiled import compiled
from proof_files import ROOT, jamproof

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

    def test_a_packing_of_each_kind_and_theorem(self):
        kinds = {(row["d"], row["N"], row["spheres"]): row["theorem"] for row in self.rows}
        self.assertEqual({key[0] for key in kinds}, {"2", "3"})
        self.assertEqual(len(kinds), len(self.rows))
        for key, theorem in kinds.items():
            self.assertEqual(theorem, "trapped" if key[::2] == ("2", "equal") else "exact", key)

    def test_files_are_proved_and_have_the_density_of_the_index(self):
        for row in self.rows:
            with self.subTest(name=row["name"]):
                scene = jamproof.Scene(FOLDER / (row["name"] + ".jamproof"))
                status, words = jamproof.conclusion(scene)
                self.assertEqual((status, words.split(":")[0]), (0, "proved") if row["theorem"] == "exact" else (3, "trapped"))
                self.assertLess(float(row["error"]), 1e-26)
                self.assertLess(abs(phi(scene) / Fraction(10) ** 60 - Fraction(row["phi_J"])), Fraction(1, 10**25))

    def test_the_script_proves_the_table_of_the_page(self):
        # Same seed, same packing: phi_J has all digits of the table, also of those whose files the folder has not.
        sys.path.insert(0, str(FOLDER.parent))
        self.addCleanup(sys.path.remove, str(FOLDER.parent))
        import reference_set

        table = json.loads((FOLDER.parent / "results.json").read_text(encoding="utf-8"))["reference_set"]["rows"]
        dimensions, shown = compiled(2, 3, 4, 5), {row[0]: row[1:3] for row in table}
        self.assertEqual(len(shown), 8)
        self.assertEqual([shown[row["name"]] for row in self.rows], [[row["theorem"], row["phi_J"]] for row in self.rows])
        with tempfile.TemporaryDirectory() as folder:
            for name, found in shown.items():
                dim, seed = int(name[1]), int(name[-2:])
                if dim in dimensions:
                    made = reference_set.made(Path(folder), dim, 64, "mixed" in name, seed)
                    self.assertEqual([made[0], *made[5:7]], [name, *found])

    def test_frames_are_the_proved_packings(self):
        # In the order of the index. A proof refines the centres that a crunch ends with, which are at the maximum to about 1e-13.
        frames = {}
        for row in self.rows:
            name = f"d{row['d']}-n{row['N']}.xyz"
            frames[name] = frames.get(name, -1) + 1
            scene = jamproof.Scene(FOLDER / (row["name"] + ".jamproof"))
            with jam.System.read(str(FOLDER / name), frame=frames[name]) as packing:
                centres = np.array([[float(Fraction(x, scene.one)) for x in sphere] for sphere in scene.x])
                off = (packing.positions - centres + 0.5) % 1 - 0.5
                self.assertLess(np.abs(off).max(), 1e-12, row["name"])
