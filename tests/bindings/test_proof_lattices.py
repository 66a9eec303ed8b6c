"""Lattices whose jamming is known, by whole numbers and by proofs."""
import unittest
from fractions import Fraction

import numpy as np

import jam
from proof_files import verdict
from test_proof_bounds import crystal

HALF, QUARTER = Fraction(1, 2), Fraction(1, 4)
BCC = [(0, 0, 0), (HALF, HALF, HALF)]
FCC = [(0, 0, 0), (HALF, HALF, 0), (HALF, 0, HALF), (0, HALF, HALF)]
D4 = [tuple(HALF if k in pair else 0 for k in range(4)) for pair in ((), (0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3), (0, 1, 2, 3))]
# Name, places in the unit cell, copies, square of the distance; jammed, strictly jammed (S. Torquato and F. H. Stillinger,
# Rev. Mod. Phys. 82, 2633 (2010), table I). Two spheres have one motion in a fixed cell, so bcc is jammed in a
# single cell.
LATTICES = (
    ("square", [(0, 0)], (4, 4), Fraction(1, 16), False, False),
    ("simple cubic", [(0, 0, 0)], (2, 2, 2), QUARTER, False, False),
    ("fcc", FCC, (1, 1, 1), HALF, True, True),
    ("fcc", FCC, (2, 2, 2), Fraction(1, 8), True, True),
    ("bcc", BCC, (1, 1, 1), Fraction(3, 4), True, False),
    ("bcc", BCC, (2, 2, 2), Fraction(3, 16), False, False),
    ("diamond", FCC + [tuple(x + QUARTER for x in row) for row in FCC], (1, 1, 1), Fraction(3, 16), False, False),
    ("D4", D4, (1, 1, 1, 1), HALF, True, True),
)


class Lattices(unittest.TestCase):
    def test_whole_numbers_say_which_are_jammed(self):
        """All of them are balanced by equal forces; the rank of whole numbers decides."""
        for name, base, copies, side, jammed, strictly in LATTICES:
            rows = [tuple((g + b) / c for g, b, c in zip(grid, x, copies)) for grid in np.ndindex(*copies) for x in base]
            lines = crystal(rows, side, 1)
            for words, expected in ((lines, jammed), ([lines[0], "strict", *lines[1:]], strictly)):
                with self.subTest(lattice=name, copies=copies, strict=words is not lines):
                    found = verdict("\n".join(words) + "\n")
                    self.assertEqual(found if isinstance(found, str) else found["radius"], 0.0 if expected else "singular")

    def test_lattices_of_triangles_are_trapped_or_not(self):
        """No binary fractions, so that the library's doubles decide: of these only triangular disks are jammed."""
        for name, side, stays, contacts, jammed in (
            ("triangular", 4, lambda a, b: True, 48, True),
            ("honeycomb", 6, lambda a, b: (a - b) % 3, 36, False),
            ("kagome", 4, lambda a, b: a % 2 or b % 2, 24, False),
        ):
            points = [(a, b) for a in range(side) for b in range(side) if stays(a, b)]
            cell = np.array([[side, 0], [side / 2, side * 0.75**0.5]])
            places = np.array([[a + b / 2, b * 0.75**0.5] for a, b in points])
            system = jam.System.from_arrays(places, 1 - 1e-15, cell=cell, dim=2)
            system.contacts_from_geometry()
            self.assertEqual(len(system.contacts), contacts, name)
            self.assertEqual(system.prove().theorem, jam.Theorem.TRAPPED if jammed else jam.Theorem.NONE, name)
