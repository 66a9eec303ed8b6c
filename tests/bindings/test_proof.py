"""Proofs: the checker, which does not know libjam, confirms its proofs and refuses what was changed."""
import contextlib
import io
import itertools
import math
import random
import sys
import unittest
from fractions import Fraction
from unittest import mock

import numpy as np
from proof_files import (
    ROOT, File, agree, centres_exchanged, doubled, dropped, file_of, force_times, jamproof, moved, other_image, rattler_into_neighbour, resized,
    scene_of, try_changes, value, verdict, wide_cell, word,
)  # fmt: skip

import jam


def packing(n, dim, seed):
    ratio = np.where(np.arange(n) % 2, 1.4, 1.0) if dim == 2 else np.ones(n)
    system = jam.System.random(n=n, dim=dim, seed=seed, diameters=ratio, packing_fraction={2: 0.3, 3: 0.2, 4: 0.1}[dim])
    system.compress(growth_rate=1e-2, pressure=1e4)
    system.crunch()
    return system, ratio


def fcc(m):
    """Centres of m^3 cubes in a cell of side 1."""
    base = np.array([[0, 0, 0], [0.5, 0.5, 0], [0.5, 0, 0.5], [0, 0.5, 0.5]])
    grid = np.stack(np.meshgrid(*[np.arange(m)] * 3, indexing="ij"), -1).reshape(-1, 3)
    return (grid[:, None] + base).reshape(-1, 3) / m


def refined_squares(system, ratio):
    """Of each contact, in fractions: the squared distance of refined centres over that of ratio."""
    high, low = system.refined_positions(ratio)
    x = [[Fraction(a) + Fraction(b) for a, b in zip(*rows)] for rows in zip(high.tolist(), low.tolist())]
    side, squares = Fraction(float(system.box)), []
    for i, j in system.contacts.pairs.tolist():
        r = [a - b for a, b in zip(x[i], x[j])]
        r = [v - side * round(v / side) for v in r]
        sigma = (Fraction(float(ratio[i])) + Fraction(float(ratio[j]))) / 2
        squares.append(sum(v * v for v in r) / sigma**2)
    return squares


def exchange_end(f, r):
    """A contact exchanged for another pair."""
    line = r.choice(f.contacts)
    others = [k for k in range(len(f.spheres)) if f.spheres[k][1] == "1" and str(k) not in line[1:3]]
    line[2] = str(r.choice(others))


def open_pairs(scene):
    """(squared distance over that of a contact, i, j, n) of all pairs and images but contacts, in fractions."""
    closed = {(i, j, n) for i, j, n in scene.contacts} | {(j, i, tuple(-v for v in n)) for i, j, n in scene.contacts}
    for i, j in itertools.combinations_with_replacement(range(len(scene.x)), 2):
        for n in itertools.product((-1, 0, 1), repeat=scene.dim):
            if (j, i, n) not in closed and (i != j or any(n)):
                square = Fraction(sum(c * c for c in scene.vector(j, i, n)), scene.one**2)
                yield square / (scene.gamma * scene.sigma2(i, j)), j, i, n


def nearest_open_pair(f, r):
    """A contact exchanged for the pair with the smallest gap that is none."""
    scene = scene_of(f.text())
    _, i, j, n = min(pair for pair in open_pairs(scene) if pair[1] != pair[2] and scene.stable[pair[1]] and scene.stable[pair[2]])
    r.choice(f.contacts)[1 : 3 + scene.dim] = map(str, (i, j, *n))


def called_rattler(f, r):
    r.choice(f.stable)[1] = "0"


def called_stable(f, r):
    rattlers = [s for s in f.spheres if s[1] == "0"]
    if rattlers:
        r.choice(rattlers)[1] = "1"
    else:
        called_rattler(f, r)


def new_large_sphere(f, r):
    stable = r.choice(f.stable)
    f.lines.append(["sphere", "0", stable[2], *[word(value(x) + Fraction(1, 50)) for x in stable[3:]]])


# Each kind changes what the file claims: change(file, random), or it and by how much the exact packing may then be away from the
# written one.
KINDS = {
    "contact missing": dropped("contact"),
    "contact twice": doubled("contact"),
    "contact with another image": other_image,
    "contact with another end": exchange_end,
    "contact exchanged for the nearest open pair": nearest_open_pair,
    "force negated": force_times(-1, "contact"),
    "force zero": force_times(0, "contact"),
    "stable sphere called rattler": called_rattler,
    "rattler called stable": called_stable,
    "rattler overlaps": rattler_into_neighbour,
    "sphere added into others": new_large_sphere,
    "two centres exchanged": centres_exchanged,
    "cell wider by 1e-2": wide_cell(Fraction(1, 100)),
    "centre off by 1e-3": moved(Fraction(1, 10**3)),
    "diameter larger by 1e-2": resized(Fraction(1, 100)),
    "gamma larger by 1e-1": lambda f, r: f.scale(f.gamma, 1, Fraction(11, 10)),
    "centre off by 1e-30": (moved(Fraction(1, 10**30)), 1e-30),
    "centre off by 1e-9": (moved(Fraction(1, 10**9)), 1e-9),
    "diameter larger by 1e-13": (resized(Fraction(1, 10**13)), 1e-16),
    "gamma larger by 1e-20": (lambda f, r: f.scale(f.gamma, 1, 1 + Fraction(1, 10**20)), 1e-25),
    "force larger by 1e-4": (force_times(Fraction(10001, 10000), "contact"), 0.0),
    "cell wider by 1e-15": (wide_cell(Fraction(1, 10**15)), 1e-18),
}


class Proofs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = [packing(n, dim, seed) for n, dim, seed in ((32, 2, 2), (32, 3, 1), (24, 3, 5), (32, 4, 3))]
        cls.files = [(file_of(*made), made) for made in cls.made if made[0].report.excess_contacts == 0]

    def test_the_checker_agrees_with_the_library(self):
        self.assertGreaterEqual(len(self.files), 3)
        for text, (system, ratio) in self.files:
            agree(self, system.prove(ratio), verdict(text))

    def test_refined_centres_close_all_contacts(self):
        """In fractions: every contact distance is the same multiple of sigma to 30 digits."""
        for _, (system, ratio) in self.files:
            squares = refined_squares(system, ratio)
            self.assertLess(float(max(squares) / min(squares) - 1), 1e-29)
            doubles = [float(system.diameters[0] / ratio[0]) ** 2, float(squares[0])]
            self.assertAlmostEqual(doubles[0] / doubles[1], 1.0, delta=1e-13)

    def test_changed_files_are_not_proved(self):
        """Every kind of change on thirty files."""
        self.assertGreater(len(KINDS), 20)
        generator, texts, seed = random.Random(1), [], 0
        while len(texts) < 30:
            seed += 1
            made = packing(12 + seed % 7, 2 + seed % 2, seed)
            if made[0].report.jammed and made[0].report.excess_contacts == 0:
                texts.append(file_of(*made))
        for text in texts:
            self.assertIsInstance(verdict(text), dict)
            try_changes(self, text, KINDS, generator)

    def test_a_sphere_on_another_is_seen_however_far_it_is_written(self):
        """The cell is periodic: a sphere whole cells away lies in the same place."""
        for text, _ in self.files[:2]:
            lines = text.splitlines()
            last = max(k for k, line in enumerate(lines) if line.startswith("sphere"))
            word = lines[last].split()
            cell = next(line for line in lines if line.startswith("cell")).split()[1:]
            for power in (0, 40, 80, 2000):
                edge = cell[0]  # first vector: along the first axis alone
                pieces = [p.split("p") for p in edge.split(",")]  # 2^power + 1000 cells
                parts = ",".join(f"{m}p{int(e) + power},{125 * int(m)}p{int(e) + 3}" for m, e in pieces)
                far = " ".join([f"{word[3]},{parts}", *word[4:]])
                added = lines[: last + 1] + [f"sphere 0 {word[2]} {far}"] + lines[last + 1 :]
                self.assertNotIsInstance(verdict("\n".join(added) + "\n"), dict, power)

    def test_the_unit_of_ratio_is_free(self):
        s = jam.System.random(n=24, dim=2, seed=3, diameters=[1.0] * 12 + [1.4] * 12)
        s.compress()
        s.crunch()
        ratio = np.array([5.0] * 12 + [7.0] * 12)
        right = s.prove(ratio)
        self.assertEqual(right.theorem, jam.Theorem.EXACT)
        for power in (3, -3, 40, -40, 700, -700, 1000, -1000):
            found = s.prove(ratio * 2.0**power)
            self.assertEqual((found.theorem, found.radius), (right.theorem, right.radius), power)

    def test_long_work_says_how_far_it_is(self):
        """To stderr alone, in loops with and without numpy; what is printed to stdout stays one line."""
        lines = io.StringIO()
        square = [[2.0, 1.0], [1.0, 3.0]]
        with mock.patch.object(jamproof, "WAIT", -1), mock.patch.dict(sys.modules, numpy=None), contextlib.redirect_stderr(lines):
            inverse = jamproof.float_inverse(square)
            left = jamproof.left_inverse(square + [[0.0, 0.0]])
            self.assertIn("radius", verdict(self.files[0][0]))
        for found in (inverse, [row[:2] for row in left]):
            self.assertLess(abs(np.array(found) @ np.array(square) - np.eye(2)).max(), 1e-14)
        said = lines.getvalue().splitlines()
        for part in ("columns of the inverse: 1 of 2,", "rows of J^T J: 2 of 2, about 0 s", "columns of A J: 1 of ", "pairs of spheres: 3 of "):
            self.assertTrue(any(line.startswith(part) and line.endswith(" s more") for line in said), part)

    def test_printed_bounds_are_rounded_outward(self):
        found = {"radius": 1.2341e-30, "inner": 1.0000001e-9, "gamma_error": 9.999e-32, "outer": 1.2399e-5, "least_gap": 0.0, "least_force": 9.999e-3}
        words = "radius 1.24e-30, inner 1.01e-9, gamma_error 1.00e-31, outer 0.0000123, least_gap 0, least_force 0.00999"
        self.assertEqual([float(w.split()[1]) for w in jamproof.shown(found).split(", ")], [float(w.split()[1]) for w in words.split(", ")])
        third = {"radius": Fraction(1, 3), "outer": Fraction(1, 3), "inner": Fraction(0), "least_force": Fraction(2, 3)}
        self.assertEqual(jamproof.shown(third), "radius 0.334, outer 0.333, inner 0, least_force 0.666")
        least = jamproof.shown({"radius": Fraction(1, 1 << 4000), "least_gap": Fraction(1, 1 << 4000)})
        self.assertRegex(least, r"^radius 1e-30\d, least_gap 0$")

    def test_crystals_are_trapped(self):
        """fcc of exact numbers: all contacts close, more than one state of self-stress."""
        x = fcc(2)
        system = jam.System.from_arrays(x, 0.5 * 0.5**0.5 * (1 - 1e-16))
        system.contacts_from_geometry()
        proof = system.prove()
        self.assertEqual(proof.theorem, jam.Theorem.EXACT)  # its numbers are binary fractions: all contacts close exactly
        self.assertGreater(proof.outer, 1e-4)
        text = file_of(system)
        self.assertEqual(verdict(text)["radius"], 0.0)
        f = File(text)
        f.lines = [line for line in f.lines if line[0] != "contact" or line[1] != "0"]
        f.spheres[0][1] = "0"  # a vacancy would be stable too, but forces of one size are far from a balance
        self.assertEqual(verdict(f.text()), "force")
        # Vacancies: forces that balance exactly are no doubles, and lie next to those of the file.
        for gone in ([5], [5, 20]):
            system = jam.System.from_arrays(np.delete(x, gone, axis=0), 0.5 * 0.5**0.5 * (1 - 1e-16))
            system.contacts_from_geometry()
            self.assertEqual(system.prove().theorem, jam.Theorem.EXACT)
            f = File(file_of(system))
            self.assertEqual(verdict(f.text())["radius"], 0.0)
            f.lines = [[*line[:-1], word(2 * value(line[-1]))] if line[0] == "contact" and line[1] == "0" else line for line in f.lines]
            self.assertEqual(verdict(f.text()), "force")


def body_centred(height):
    """Two spheres and eight contacts. At a height of sqrt(2 / 3) each touches its image above too."""
    lines = ["jamproof 1", "dim 3", "unit 1p0", "non_additivity 0p0", f"cell 1p0 0p0 1p0 0p0 0p0 {word(height, -90)}"]
    height = value(lines[-1].split()[-1])
    lines.append(f"gamma {word(Fraction(1, 2) + height**2 / 4, -190)}")
    lines += ["sphere 1 1p0 0p0 0p0 0p0", f"sphere 1 1p0 1p-1 1p-1 {word(height / 2, -100)}"]
    lines += [f"contact 1 0 {a} {b} {c} 1p0" for a, b, c in itertools.product((0, -1), repeat=3)]
    return File("\n".join(lines) + "\n")


class Gaps(unittest.TestCase):
    """What is printed as the least gap is at most that of the file's centres."""

    def check(self, scene, within):
        status, words = jamproof.conclusion(scene)
        self.assertIn(status, (0, 3), words)
        square = (1 + Fraction(words.split("least_gap ")[1].split(",")[0].split(";")[0])) ** 2
        true = min(open_pairs(scene))[0]
        self.assertLessEqual(square, true, words)
        self.assertGreaterEqual((square - 1) / (true - 1), within, words)

    def test_along_an_axis_of_the_cell(self):
        """There a component of r exceeds the largest sigma although the gap is small."""
        self.check(jamproof.Scene(ROOT / "examples/studies/reference_set/d2-n64-equal-07.jamproof"), 0.98)
        self.check(scene_of(body_centred(Fraction(2, 3) ** Fraction(1, 2) + 1e-6).text()), 0.98)

    def test_below_the_rounding_of_doubles(self):
        root = Fraction(math.isqrt(2 * 3 * 10**80), 3 * 10**40)
        for above in (Fraction(17, 10**17), Fraction(3, 10**16), Fraction(1, 10**20)):
            self.check(scene_of(body_centred(root * (1 + Fraction(4, 3) * above)).text()), 0.98)
