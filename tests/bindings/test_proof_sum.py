"""Proof files of largest sums of radii: those of jam.radii.prove are proved by the checker, changed ones are not."""
import math
import pathlib
import random
import tempfile
import unittest
from decimal import Decimal
from fractions import Fraction

import numpy as np
from proof_files import (
    AT_WALLS, ROOT, File, another_wall, doubled, dropped, jamproof, moved, other_image, other_side, outside, resized, scene_of, try_changes,
    value, verdict, word,
)  # fmt: skip

import jam
import jam.radii

AUDIT = ROOT / "tests/bindings/sum26.jamproof"
LETTERS = "xyz"


def file_of(system, digits=30, weights=None):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "a.jamproof"
        proved = jam.radii.prove(system, digits, weights=weights, path=path)
        return proved, path.read_text(encoding="ascii")


def maximum(n, dim, seed, weights=None):
    system = jam.System.random(n=n, dim=dim, walls=LETTERS[:dim], seed=seed)
    system.maximise_radii(weights)
    return system


def sum_of(text):
    """Bounds of the sum, in fractions."""
    scene = scene_of(text)
    jamproof.check(scene)
    return jamproof.fraction(scene)


def both_prove(case, made):
    """Checker and library: one sum of radii, to the digits that were asked for."""
    for proved, text in made:
        found, (low, high) = verdict(text), sum_of(text)
        case.assertIsInstance(found, dict, found)
        case.assertLess(found["sum_error"], 1e-40)
        case.assertGreater(found["least_force"], 0)
        own, radius = Fraction(proved.value), Fraction(proved.value_radius)
        case.assertLess(radius, Fraction(1, 10**30))
        case.assertLess(low, own + radius)
        case.assertLess(own - radius, high)


def other_weight(f, r):
    """Not the sum that these forces balance."""
    f.header("sum")[1 + r.randrange(len(f.spheres))] = "3p0"


def no_weight(f, r):
    f.header("sum")[1] = "0p0"


def less_weights(f, r):
    f.header("sum").pop()


def rattler(f, r):
    r.choice(f.spheres)[1] = "0"


REFUSED = {
    **AT_WALLS, "another wall": another_wall, "the other side": other_side, "outside": outside, "centre off by 1e-1": moved(Fraction(1, 10)),
    "another weight": other_weight, "no weight": no_weight, "a weight missing": less_weights, "line sum twice": doubled("sum"),
    "no line sum": dropped("sum"), "contact missing": dropped("contact"), "a rattler": rattler, "diameter larger by 1e-2": resized(Fraction(1, 100)),
    "another gamma": lambda f, r: f.gamma.__setitem__(1, word(1 + Fraction(1, 10**9))), "strict": lambda f, r: f.lines.insert(1, ["strict"]),
}  # fmt: skip


class Sums(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.made = [file_of(maximum(*scene)) for scene in ((3, 2, 1), (8, 2, 1), (13, 2, 2))]

    def test_both_prove_the_same_sum(self):
        both_prove(self, self.made)

    def test_the_equations_have_their_derivatives(self):
        """R is the derivative of F, in fractions. At a wall F falls with the square of the whole diameter."""
        step = Fraction(1, 2**20)
        for _, text in self.made:
            scene = scene_of(text)
            columns, f = [dict(column) for column in scene.equations(range(len(scene.contacts)))[2]], {}
            for i in range(len(scene.x)):
                for at, unknown in [(2, scene.sizes + i), *((3 + c, scene.place[i, c]) for c in range(2) if (i, c) in scene.place)]:
                    for sign in (1, -1):
                        file = File(text)
                        file.shift(file.spheres[i], at, sign * step)
                        f[sign] = scene_of(file.text()).equations(range(len(scene.contacts)))[0]
                    for c, (up, low) in enumerate(zip(f[1], f[-1])):
                        have = Fraction(columns[unknown].get(c, 0), scene.one)
                        self.assertLess(abs((up - low) / (2 * step) - have), Fraction(1, 10**30), (i, at, c))

    def test_a_sum_that_closes_as_written(self):
        """One disk in a square touches four walls, with three unknowns."""
        lines = ["jamproof 1", "sum 1p0", "dim 2", "unit 1p0", "cell 1p0 0p0 1p0", "non_additivity 0p0", "gamma 1p0", "walls 0 1"]
        lines += ["sphere 1 1p0 1p-1 1p-1", *(f"wall 0 {axis} {side} 1p-4" for axis in (0, 1) for side in (0, 1))]
        text = "\n".join(lines) + "\n"
        found = verdict(text)
        self.assertIsInstance(found, dict, found)
        self.assertEqual((found["radius"], found["sum_error"], "gamma_error" in found), (0, 0, False))
        self.assertEqual(sum_of(text), [Fraction(1, 2)] * 2)

    def test_weights_and_balls(self):
        weights = np.array([1.0, 2.0, 1.5])
        proved, text = file_of(maximum(3, 2, 1, weights), weights=weights)
        self.assertIsInstance(verdict(text), dict)
        low, high = sum_of(text)
        self.assertLess(abs((low + high) / 2 - Fraction(proved.value)), Fraction(1, 10**29))
        made = [maximum(n, 3, seed) for n in (3, 7, 8) for seed in (1, 2, 3)]
        texts = [file_of(s)[1] for s in made if len(s.contacts.pairs) == 4 * s.n]
        self.assertGreater(len(texts), 2)
        for text in texts:
            self.assertIsInstance(verdict(text), dict)

    def test_the_audited_sum_of_26_disks(self):
        """The value that another proof in rational numbers gives, from the file and by a maximum from its centres."""
        known = Decimal("2.635983084917607783186569485443")
        text = AUDIT.read_text(encoding="ascii")
        low, high = sum_of(text)
        half = Fraction(1, 2 * 10**30)
        self.assertLess(Fraction(known) - half, low)
        self.assertLess(high, Fraction(known) + half)
        rows = [[float(value(x)) for x in line[2:]] for line in File(text).spheres]
        x, radii = np.array(rows)[:, 1:], np.array(rows)[:, 0] / 2
        system = jam.System.from_arrays(x, radii=radii, overlap="shrink", walls="xy", box=1.0)
        system.maximise_radii(room=1e-9)
        proved, again = file_of(system)
        self.assertLess(abs(proved.value - known), Decimal("5e-31"))
        self.assertIsInstance(verdict(again), dict)

    def test_changed_files_are_not_proved(self):
        generator = random.Random(6)
        for _, text in self.made:
            try_changes(self, text, REFUSED, generator)

    def test_small_changes_stay_within_the_radius(self):
        """A centre is farther from the exact one by the change, a diameter by that part of itself."""
        generator = random.Random(7)
        for _, text in self.made:
            least = min(float(value(line[2])) for line in File(text).spheres)
            for change, part in ((moved, 1.0), (resized, least)):
                for power in (25, 15, 10, 3):
                    f = File(text)
                    change(Fraction(1, 10**power))(f, generator)
                    if isinstance(found := verdict(f.text()), dict):
                        self.assertGreaterEqual(found["radius"], 0.999 * part * 10.0**-power)
                    self.assertTrue(power == 3 or isinstance(found, dict), found)


def pull(f, r):
    for line in f.contacts + f.at_walls:
        f.scale(line, -1, -1)


def other_mirror(f, r):
    line = f.header("symmetry")
    k = 1 + r.randrange(2)
    line[k] = str(-int(line[k]))


def same_axis(f, r):
    line = f.header("symmetry")
    line[2] = line[1]


def other_spheres(f, r):
    line = f.header("symmetry")
    a, b = r.sample(range(3, len(line)), 2)
    line[a], line[b] = line[b], line[a]


def one_sphere_twice(f, r):
    line = f.header("symmetry")
    line[3] = line[4]


def not_quite(at):
    """A sphere that goes to another one, off by less than a radius covers: the symmetry is not exact."""

    def change(f, r):
        to = f.header("symmetry")[len(f.spheres[0]) - 2 :]
        f.shift(f.spheres[r.choice([i for i, p in enumerate(to) if int(p) != i])], at, Fraction(1, 10**40))

    return change


def weight_without_symmetry(f, r):
    line, to = f.header("sum"), f.header("symmetry")[len(f.spheres[0]) - 2 :]
    line[1 + next(i for i, p in enumerate(to) if int(p) != i)] = "3p-1"


SYMMETRIC = {
    "no symmetry": dropped("symmetry"), "another mirror": other_mirror, "one axis twice": same_axis, "other spheres": other_spheres,
    "one sphere twice": one_sphere_twice, "centre off by 1e-40": not_quite(3), "diameter off by 1e-40": not_quite(2),
    "a weight without the symmetry": weight_without_symmetry, "pull": pull, "contact missing": dropped("contact"),
    "wall missing": dropped("wall"), "all the same": lambda f, r: f.lines.append(["symmetry", "1", "2"]),
}  # fmt: skip


class Symmetric(unittest.TestCase):
    """Maxima with more contacts than unknowns."""

    @classmethod
    def setUpClass(cls):
        cls.made = []
        for n, dim in ((4, 2), (5, 2), (6, 2), (7, 2), (9, 2), (12, 2), (4, 3), (5, 3)):
            for seed in range(1, 20):
                system = maximum(n, dim, seed)
                if len(system.contacts.pairs) > n * (dim + 1):
                    try:
                        cls.made.append((n, *file_of(system)))
                    except jam.errors.StateError as why:
                        assert "symmetry" in str(why), why
                        continue
                    break

    def test_both_prove_them(self):
        self.assertGreater(len(self.made), 6)
        both_prove(self, [made[1:] for made in self.made])

    def test_a_symmetric_saddle_is_refused(self):
        """Two equal disks on the diagonal: closed by the half turn, forces balance, but the sum stays along a family."""
        root = Fraction(math.isqrt(2 * 10**120), 10**60)
        size = 2 - root
        pair = 1 / (2 * size * (1 + root))
        at_wall, corner = pair / (2 * root), word(size / 2, -180)
        lines = ["jamproof 1", "sum 1p0 1p0", "dim 2", "unit 1p0", "cell 1p0 0p0 1p0", "non_additivity 0p0", "gamma 1p0", "walls 0 1"]
        far = word(1 - value(corner), -180)
        lines += ["symmetry -1 -2 1 0", *(f"sphere 1 {word(size, -180)} {x} {x}" for x in (corner, far)), f"contact 0 1 0 0 {word(pair)}"]
        lines += [f"wall {i} {axis} {i} {word(at_wall)}" for i in (0, 1) for axis in (0, 1)]
        self.assertEqual(verdict("\n".join(lines) + "\n"), "singular")

    def test_four_balls(self):
        """In every second corner of a cube: each touches three faces and the others, so that R (2 + sqrt(2)) = 1 of equal ones."""
        x = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]])
        near = 1 / (2 + 2**0.5)
        system = jam.System.from_arrays(near + (1 - 2 * near) * x, radii=np.full(4, 0.99 * near), walls="xyz", dim=3)
        system.maximise_radii()
        low, high = sum_of(file_of(system)[1])
        root = Fraction(math.isqrt(2 * 10**120), 10**60)
        self.assertLess(abs((low + high) / 2 - (4 - 2 * root)), Fraction(1, 10**45))

    def test_changed_files_are_not_proved(self):
        generator = random.Random(8)
        for n, _, text in self.made:
            try_changes(self, text, SYMMETRIC, generator, n=n)


PERIODIC = {"pull": pull, "contact missing": dropped("contact"), "another image": other_image, "another weight": other_weight,
            "diameter larger by 1e-1": resized(Fraction(1, 10))}  # fmt: skip


class Periodic(unittest.TestCase):
    def test_cells_without_walls_and_with_some(self):
        generator = random.Random(9)
        for scene in ({"n": 8, "seed": 1}, {"n": 12, "seed": 2, "walls": "y"}, {"n": 9, "seed": 3, "cell": [[1, 0], [0.3, 0.9]]}):
            system = jam.System.random(dim=2, **scene)
            system.maximise_radii()
            proved, text = file_of(system)
            low, high = sum_of(text)
            self.assertLess(abs((low + high) / 2 - Fraction(proved.value)), Fraction(proved.value_radius))
            try_changes(self, text, PERIODIC, generator, scene=scene)
