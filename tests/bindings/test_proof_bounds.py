"""Each bound of the checker is needed: where one is taken out, a false file passes.

A file is false where what the broken checker then says of it is wrong: an overlap, forces that do not balance, a radius
below the distance to the exact packing. What holds of implied contacts is in test_proof_truths.py: a file that names a
wrong one is refused twice, as the equations left over are singular.
"""
import functools
import importlib.util
import itertools
import random
import sys
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

import numpy as np

from proof_files import CHECKER, File, file_of, moved, scene_of, value, verdict, word
from test_proof import new_large_sphere, packing

FAR = Fraction(1, 10**6)
NUMBERS = itertools.count()


def checker(edit=None):
    """The checker as a module, with one piece of the text of its files exchanged."""
    folder = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
    times = 0
    for path in CHECKER.parent.glob("jamproof*.py"):
        text = path.read_text(encoding="ascii")
        times += text.count(edit[0]) if edit else 1
        Path(folder.name, path.name).write_text(text.replace(*edit) if edit else text, encoding="ascii")
    assert times == 1 or not edit, f"{edit[0]!r} stands {times} times in the checker"
    name = f"checker{next(NUMBERS)}"
    spec = importlib.util.spec_from_file_location(name, Path(folder.name, CHECKER.name))
    sys.modules[name] = found = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(found)
    found.folder = folder  # which lasts as long
    return found


@functools.lru_cache
def made(n, dim, excess):
    """The text of the first packing with so many contacts above one state of self-stress."""
    for seed in range(1, 120):
        system, ratio = packing(n, dim, seed)
        if system.report.jammed and system.report.excess_contacts == excess:
            return file_of(system, ratio)
    raise AssertionError("no seed gives such a packing")


def small():
    return File(made(16, 3, 0))


def overlap():
    f = small()
    new_large_sphere(f, random.Random(1))
    return f.text()


def overlap_across_the_boundary():
    """A small sphere at a wall of the cell, one whose centre is its image, but for a hundredth, at the other."""
    f = small()
    stable = f.stable[0]
    side = value(f.header("cell")[1])
    f.lines.append(["sphere", "0", word(Fraction(1, 100)), word(value(stable[3]) + side), *stable[4:]])
    return f.text()


def gap_below_the_radius():
    """A grain beside a sphere, open by less than the exact packing may be away."""
    intact, generator = checker(), random.Random(3)
    for _ in range(100):
        f = small()
        stable = generator.choice(f.stable)
        grain = Fraction(1, 1000)
        gamma = Fraction(float(value(f.gamma[1])) ** 0.5)
        direction = np.array([generator.gauss(0, 1) for _ in range(3)])
        direction /= np.linalg.norm(direction)
        reach = gamma * (value(stable[2]) + grain) / 2 * (1 + Fraction(1, 10**9))
        f.lines.append(["sphere", "0", word(grain), *[word(value(x) + Fraction(v) * reach) for x, v in zip(stable[3:], direction)]])
        f.spheres.append(f.lines[-1])
        if isinstance(verdict(f.text(), intact), dict):
            moved(FAR)(f, generator)
            return f.text()
    raise AssertionError("no place for a grain")


def far_centre():
    f = small()
    moved(FAR)(f, random.Random(1))
    return f.text()


def far_centre_and_no_inverse():
    text, intact = far_centre(), checker()
    n = len(scene_of(text, intact).contacts)
    data = intact.base64.b64encode(intact.zlib.compress(bytes(4 * n * (n - 1)))).decode()
    return text + f"inverse -30 {data}\n"


def other_forces():
    """All equal, while the last row of the inverse is the true state of self-stress."""
    f = small()
    for line in f.contacts:
        line.append(line[-1])
        line[-2] = "1p0"
    return f.text()


def crystal(rows, side, sphere_ratio):
    """A closed file by hand: centres as binary fractions, all contacts, forces 1."""
    lines = ["jamproof 1", f"dim {len(rows[0])}", "unit 1p0", "cell " + " ".join("1p0" if a == b else "0p0" for a in range(len(rows[0])) for b in range(a + 1)), "non_additivity 0p0"]
    lines.append("gamma " + word(side))
    lines += [f"sphere 1 {word(sphere_ratio)} " + " ".join(word(Fraction(x)) for x in row) for row in rows]
    for i, x in enumerate(rows):
        for j in range(i):
            for n in np.ndindex(*[3] * len(x)):
                r = [Fraction(a) - Fraction(b) + k - 1 for a, b, k in zip(x, rows[j], n)]
                if sum(v * v for v in r) == side:
                    lines.append(f"contact {i} {j} " + " ".join(str(k - 1) for k in n) + " 1p0")
    return lines


def square_lattice():
    rows = [(a / 4, b / 4) for a in range(4) for b in range(4)]
    return "\n".join(crystal(rows, Fraction(1, 16), 1)) + "\n"


def fcc(keeps=lambda x: True):
    """The lines of 32 spheres, or of those that stay."""
    base = [(0, 0, 0), (0.5, 0.5, 0), (0.5, 0, 0.5), (0, 0.5, 0.5)]
    rows = [tuple((g + b) / 2 for g, b in zip(grid, x)) for grid in np.ndindex(2, 2, 2) for x in base]
    return crystal([x for x in rows if keeps(x)], Fraction(1, 8), 1)


def fcc_without_the_upper_neighbours_of_a_sphere():
    """No positive forces balance on that sphere, though the rank is full."""
    return "\n".join(fcc(lambda x: x[2] != 0.25 or not (x[:2] in ((0.25, 0), (0.75, 0), (0, 0.25), (0, 0.75))))) + "\n"


def one_disk_at_a_round_wall():
    """All of its coordinates are pinned, where there is one rotation."""
    header = ["jamproof 1", "dim 2", "unit 1p0", "cell 1p0 0p0 1p0", "non_additivity 0p0", "growth 1p-2", "round 2"]
    return "\n".join([*header, "pin 0 0", "pin 0 1", "sphere 1 1p0 7p-3 1p-1", "wall 0 2 1 1p0"]) + "\n"


# Bound, what stands in the checker, what it is exchanged for, a false file, and the radius that would be true.
TABLE = (
    ("pairs stay apart", "refuse(have <= part,", "refuse(False,", overlap, None),
    ("pairs in other images", "some = [range(-((reach + r[c]) // row[c]), (reach - r[c]) // row[c] + 1) for _, r in near]",
     "some = [range(1) for _ in near]", overlap_across_the_boundary, None),
    ("radius in a gap", "radius * moving", "0 * moving", gap_below_the_radius, None),
    ("one pin for each rotation", 'refuse(wrong, "there is not one pin', 'refuse(False, "there is not one pin', one_disk_at_a_round_wall, None),
    ("eta", "[(abs(v) + a) * TWO ** (e + low) for v, a in zip(total, alpha)]", "[Fraction(0)] * n", far_centre, FAR),
    ("delta", "delta = [(2 * v + width * a) * TWO ** (e - BITS - 1) for v, a in zip(delta, alpha)]", "delta = [Fraction(0)] * n",
     far_centre_and_no_inverse, FAR),
    ("error of forces", "refuse(least <= error,", "refuse(least <= 0,", other_forces, None),
    ("rank of a crystal", "refuse(rank(rows) < s.unknowns,", "refuse(False,", square_lattice, None),
    ("balance of a crystal", "wrong = off >= (1 - delta) * least", "wrong = False", fcc_without_the_upper_neighbours_of_a_sphere, None),
)  # fmt: skip


def is_false(found, radius):
    """Whether a verdict is a proof of what is not so."""
    return isinstance(found, dict) and (radius is None or found["radius"] < radius / 2)


class Bounds(unittest.TestCase):
    def test_each_bound_is_needed(self):
        for name, old, new, make, radius in TABLE:
            with self.subTest(bound=name):
                text = make()
                self.assertFalse(is_false(verdict(text, checker()), radius))
                broken = verdict(text, checker((old, new)))
                self.assertTrue(is_false(broken, radius), broken)
