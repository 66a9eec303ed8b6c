"""Proofs: the checker, which does not know libjam, confirms its proofs and refuses what was changed."""
import contextlib
import io
import itertools
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction
from unittest import mock

import numpy as np

import jam

ROOT = pathlib.Path(__file__).resolve().parents[2]
CHECKER = ROOT / "bindings/proof/jamproof.py"
sys.path.insert(0, str(CHECKER.parent))
import jamproof  # noqa: E402


def packing(n, dim, seed):
    ratio = np.where(np.arange(n) % 2, 1.4, 1.0) if dim == 2 else np.ones(n)
    system = jam.System.random(n=n, dim=dim, seed=seed, diameters=ratio, packing_fraction={2: 0.3, 3: 0.2, 4: 0.1}[dim])
    system.compress(growth_rate=1e-2, pressure=1e4)
    system.crunch()
    return system, ratio


def file_of(system, ratio=None, **options):
    with tempfile.TemporaryDirectory() as folder:
        path = folder + "/a.jamproof"
        system.write_proof(path, ratio, **options)
        return pathlib.Path(path).read_text(encoding="ascii")


def scene_of(text, program=jamproof):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "a.jamproof"
        path.write_text(text, encoding="ascii")
        return program.Scene(path)


def verdict(text, program=jamproof):
    """What the checker proves of a text, or the first word of its refusal."""
    try:
        scene = scene_of(text, program)
    except (ValueError, LookupError, TypeError, OverflowError, MemoryError):
        return "unreadable"
    try:
        return program.check(scene)
    except (program.Refused, OverflowError, ZeroDivisionError) as why:
        return str(why).split(":")[0]


def agree(case, proof, found, radius=1e-28):
    """Library and checker prove one packing. Each bounds a distance, in the 2-norm and the largest norm: neither may be below what the other knows."""
    case.assertEqual(proof.theorem, jam.Theorem.EXACT, proof)
    case.assertIsInstance(found, dict, found)
    case.assertLess(max(proof.radius, found["radius"]), radius)
    case.assertAlmostEqual(proof.least_force / found["least_force"], 1.0, delta=1e-6)
    case.assertAlmostEqual(min(proof.least_gap, 1e-3), min(found["least_gap"], 1e-3), delta=1e-9)


def fcc(m):
    """Centres of m^3 cubes in a cell of side 1."""
    base = np.array([[0, 0, 0], [0.5, 0.5, 0], [0.5, 0, 0.5], [0, 0.5, 0.5]])
    grid = np.stack(np.meshgrid(*[np.arange(m)] * 3, indexing="ij"), -1).reshape(-1, 3)
    return (grid[:, None] + base).reshape(-1, 3) / m


def word(value, exponent=-140):
    """A number of a proof file: value rounded to 2^exponent."""
    return f"{round(Fraction(value) / Fraction(2) ** exponent)}p{exponent}"


def value(text):
    return jamproof.number(text)


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


class File:
    """The lines of a proof file, to be changed."""

    def __init__(self, text):
        self.lines = [line.split() for line in text.splitlines()]
        self.spheres = [line for line in self.lines if line[0] == "sphere"]
        self.contacts = [line for line in self.lines if line[0] == "contact"]
        self.gamma = next(line for line in self.lines if line[0] in ("gamma", "growth"))

    def text(self):
        return "\n".join(" ".join(line) for line in self.lines) + "\n"

    def scale(self, line, at, factor):
        line[at] = word(value(line[at]) * Fraction(factor))

    def shift(self, line, at, by):
        line[at] = word(value(line[at]) + Fraction(by))


# Each kind changes what the file claims. Name, change(file, random), and by how much the exact packing may then be
# away from the written one: None where nothing may be proved.
def moved(by):
    return lambda f, r: f.shift(r.choice([s for s in f.spheres if s[1] == "1"]), 3 + r.randrange(2), by)


def resized(by):
    return lambda f, r: f.scale(r.choice([s for s in f.spheres if s[1] == "1"]), 2, 1 + by)


def swap_images(f, r):
    line = r.choice(f.contacts)
    line[3] = str(int(line[3]) + r.choice((-1, 1)))


def exchange_end(f, r):
    """A contact exchanged for another pair."""
    line = r.choice(f.contacts)
    others = [k for k in range(len(f.spheres)) if f.spheres[k][1] == "1" and str(k) not in line[1:3]]
    line[2] = str(r.choice(others))


def nearest_open_pair(f, r):
    """A contact exchanged for the pair with the smallest gap that is none."""
    scene = scene_of(f.text())
    closed = {frozenset(map(int, line[1:3])) for line in f.contacts}
    best = None
    for i in range(len(scene.x)):
        for j in range(i):
            if not (scene.stable[i] and scene.stable[j]) or frozenset((i, j)) in closed:
                continue
            for n in itertools.product((-1, 0, 1), repeat=scene.dim):
                ratio = sum((c / scene.one) ** 2 for c in scene.vector(i, j, n)) / float(scene.sigma2(i, j))
                if best is None or ratio < best[0]:
                    best = ratio, i, j, n
    line = r.choice(f.contacts)
    line[1:3] = [str(best[1]), str(best[2])]
    line[3 : 3 + scene.dim] = [str(k) for k in best[3]]


def drop(f, r):
    f.lines.remove(r.choice(f.contacts))


def drop_weakest(f, r):
    f.lines.remove(min(f.contacts, key=lambda line: value(line[-1])))


def double(f, r):
    f.lines.append(list(r.choice(f.contacts)))


def replace_by_double(f, r):
    a, b = r.sample(f.contacts, 2)
    f.lines[f.lines.index(a)] = list(b)


def negate(f, r):
    f.scale(r.choice(f.contacts), -1, -1)


def no_force(f, r):
    r.choice(f.contacts)[-1] = "0p0"


def called_rattler(f, r):
    r.choice([s for s in f.spheres if s[1] == "1"])[1] = "0"


def called_stable(f, r):
    rattlers = [s for s in f.spheres if s[1] == "0"]
    if rattlers:
        r.choice(rattlers)[1] = "1"
    else:
        called_rattler(f, r)


def rattler_into_neighbour(f, r):
    """A rattler put where it overlaps, or a new sphere where there is none."""
    stable = r.choice([s for s in f.spheres if s[1] == "1"])
    rattlers = [s for s in f.spheres if s[1] == "0"]
    if rattlers:
        r.choice(rattlers)[3:] = stable[3:]
    else:
        f.lines.append(["sphere", "0", stable[2], *stable[3:]])


def new_large_sphere(f, r):
    stable = r.choice([s for s in f.spheres if s[1] == "1"])
    f.lines.append(["sphere", "0", stable[2], *[word(value(x) + Fraction(1, 50)) for x in stable[3:]]])


def wide_cell(by):
    def change(f, r):
        line = next(line for line in f.lines if line[0] == "cell")
        f.scale(line, 1, 1 + by)

    return change


def swap_two(f, r):
    a, b = r.sample([s for s in f.spheres if s[1] == "1"], 2)
    a[3:], b[3:] = b[3:], a[3:]


def swap_sizes(f, r):
    a = r.choice([s for s in f.spheres if s[1] == "1"])
    b = r.choice([s for s in f.spheres if s[1] == "1" and s[2] != a[2]] or [a])
    if a is b:
        f.scale(a, 2, Fraction(11, 10))
    a[2], b[2] = b[2], a[2]


def round_diameters(f, r):
    """Diameters of eight digits, centres not moved accordingly."""
    for s in f.spheres:
        s[2] = word(Fraction(round(value(s[2]) * 10**4 * (1 + Fraction(r.randrange(-9, 9), 9999))), 10**4))


def one_force_larger(f, r):
    f.scale(r.choice(f.contacts), -1, Fraction(10001, 10000))


def all_forces_equal(f, r):
    for line in f.contacts:
        line[-1] = "1p0"


NOT = None
KINDS = {
    "contact missing": (drop, NOT),
    "weakest contact missing": (drop_weakest, NOT),
    "contact twice": (double, NOT),
    "contact in the place of another": (replace_by_double, NOT),
    "contact with another image": (swap_images, NOT),
    "contact with another end": (exchange_end, NOT),
    "contact exchanged for the nearest open pair": (nearest_open_pair, NOT),
    "force negated": (negate, NOT),
    "force zero": (no_force, NOT),
    "stable sphere called rattler": (called_rattler, NOT),
    "rattler called stable": (called_stable, NOT),
    "rattler overlaps": (rattler_into_neighbour, NOT),
    "sphere added into others": (new_large_sphere, NOT),
    "two centres exchanged": (swap_two, NOT),
    "two sizes exchanged": (swap_sizes, NOT),
    "all forces equal": (all_forces_equal, NOT),
    "diameters of four digits": (round_diameters, NOT),
    "cell wider by 1e-2": (wide_cell(Fraction(1, 100)), NOT),
    "centre off by 1e-3": (moved(Fraction(1, 10**3)), NOT),
    "centre off by 1e-2": (moved(Fraction(1, 10**2)), NOT),
    "diameter larger by 1e-2": (resized(Fraction(1, 100)), NOT),
    "diameter larger by 1e-1": (resized(Fraction(1, 10)), NOT),
    "gamma larger by 1e-1": (lambda f, r: f.scale(f.gamma, 1, Fraction(11, 10)), NOT),
    "centre off by 1e-30": (moved(Fraction(1, 10**30)), 1e-30),
    "centre off by 1e-20": (moved(Fraction(1, 10**20)), 1e-20),
    "centre off by 1e-12": (moved(Fraction(1, 10**12)), 1e-12),
    "centre off by 1e-9": (moved(Fraction(1, 10**9)), 1e-9),
    "diameter larger by 1e-13": (resized(Fraction(1, 10**13)), 1e-16),
    "gamma larger by 1e-20": (lambda f, r: f.scale(f.gamma, 1, 1 + Fraction(1, 10**20)), 1e-25),
    "force larger by 1e-4": (one_force_larger, 0.0),
    "cell wider by 1e-15": (wide_cell(Fraction(1, 10**15)), 1e-18),
}


def try_changes(case, text, kinds, generator):
    """Each kind changes a file of its own: no proof, or one whose radius covers the change."""
    for name, (change, away) in kinds.items():
        with case.subTest(kind=name):
            file = File(text)
            change(file, generator)
            found = verdict(file.text())
            if away is None:
                case.assertNotIsInstance(found, dict, f"{name}: {found}")
            elif isinstance(found, dict):
                case.assertGreaterEqual(found["radius"], 0.5 * away)


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
        """Every kind of change on a hundred files."""
        self.assertGreaterEqual(len(KINDS), 30)
        generator, texts, seed = random.Random(1), [], 0
        while len(texts) < 100:
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

    def test_damage_is_refused_or_harmless(self):
        text, generator = self.files[0][0], random.Random(2)
        for _ in range(60):
            at = generator.randrange(len(text))
            found = verdict(text[:at] + generator.choice("0123456789p-., x") + text[at + 1 :])
            self.assertTrue(isinstance(found, (dict, str)))
        self.assertNotIsInstance(verdict(text[: len(text) // 2]), dict)
        self.assertEqual(verdict("something else\n"), "unreadable")

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

    def test_what_says_nothing_sensible_cannot_be_read(self):
        """Exit status 2 and one sentence, not a proof and not a traceback."""
        text = self.files[0][0]
        self.assertEqual(File(text).lines[1], ["dim", "2"])

        def header(name, *words):
            return lambda f: next(line for line in f.lines if line[0] == name).__setitem__(slice(1, None), words)

        def without(*names):
            return lambda f: f.lines.__setitem__(slice(None), [line for line in f.lines if line[0] not in names])

        def again(name):
            return lambda f: f.lines.append(list(next(line for line in f.lines if line[0] == name)))

        def contact(at, to):
            return lambda f: f.contacts[0].__setitem__(at, to)

        def no_stable(f):
            for sphere in f.spheres:
                sphere[1] = "0"

        changes = {
            "is not positive": [header("unit", "-1p0"), header("unit", "0p0"), header("gamma", "0p0"), header("gamma", "-1p-4")],
            "must be above -1 and at most 1": [header("non_additivity", x) for x in ("-2p0", "-3p0", "-1p0", "1p0,1p-60", "2p0")],
            "times, not once": [again(x) for x in ("dim", "unit", "cell", "non_additivity", "gamma")]
            + [without(x) for x in ("dim", "unit", "cell", "non_additivity", "gamma")],
            "has not as many numbers as": [header("dim", "3"), header("dim", "1"), header("gamma", "1p-4", "1p-5"), header("unit")]
            + [lambda f: f.spheres[0].pop(), lambda f: f.spheres[0].append("1p0"), lambda f: f.contacts[0].pop(), lambda f: f.spheres[0].__delitem__(slice(2, None))],
            "dim is not 1 or more": [header("dim", "0"), header("dim", "-2")],
            "lists no contact": [without("contact")],
            "no sphere is stable": [no_stable, without("sphere", "contact")],
            "names a sphere that is not there": [contact(1, "999"), contact(2, "-1")],
            "names a contact that is not there": [lambda f: f.lines.append(["implied", "9999", "0", "1"]), lambda f: f.lines.append(["tile", "0", "1", "-1"])],
            "the first line is not": [lambda f: f.lines.clear(), lambda f: f.lines.pop(0)],
        }
        def run(change):
            f = File(text)
            change(f)
            with tempfile.TemporaryDirectory() as folder:
                path = folder + "/a.jamproof"
                pathlib.Path(path).write_text(f.text(), encoding="ascii")
                return subprocess.run([sys.executable, "-I", "-B", str(CHECKER), path], capture_output=True, text=True, check=False)

        for words, kinds in changes.items():
            for k, change in enumerate(kinds):
                with self.subTest(words=words, kind=k):
                    done = run(change)
                    self.assertEqual((done.returncode, done.stderr), (2, ""), done.stdout)
                    self.assertIn(words, done.stdout)
                    self.assertEqual(done.stdout.count("\n"), 1)
        for change in (header("non_additivity", "1p0"), header("unit", "1p-3")):  # the ends of what may be
            done = run(change)
            self.assertIn(done.returncode, (0, 1), done.stdout + done.stderr)

    def test_printed_bounds_are_rounded_outward(self):
        found = {"radius": 1.2341e-30, "inner": 1.0000001e-9, "gamma_error": 9.999e-32, "outer": 1.2399e-5, "least_gap": 0.0, "least_force": 9.999e-3}
        words = "radius 1.24e-30, inner 1.01e-9, gamma_error 1.00e-31, outer 0.0000123, least_gap 0, least_force 0.00999"
        self.assertEqual([float(w.split()[1]) for w in jamproof.shown(found).split(", ")], [float(w.split()[1]) for w in words.split(", ")])
        third = {"radius": Fraction(1, 3), "outer": Fraction(1, 3), "inner": Fraction(0), "least_force": Fraction(2, 3)}
        self.assertEqual(jamproof.shown(third), "radius 0.334, outer 0.333, inner 0, least_force 0.666")
        least = jamproof.shown({"radius": Fraction(1, 1 << 4000), "least_gap": Fraction(1, 1 << 4000)})
        self.assertRegex(least, r"^radius 1e-30\d, least_gap 0$")

    def test_what_is_not_jammed_is_not_proved(self):
        square = np.stack(np.meshgrid(np.arange(4), np.arange(4), indexing="ij"), -1).reshape(-1, 2) / 4.0
        system = jam.System.from_arrays(square, 0.25)
        system.contacts_from_geometry()
        proof = system.prove()
        self.assertEqual(proof.theorem, jam.Theorem.NONE)

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
        # A third of a side is no binary fraction: trapped, but not exactly closed.
        system = jam.System.from_arrays(fcc(3), 0.5**0.5 / 3.0 * (1 - 1e-15))
        system.contacts_from_geometry()
        proof = system.prove()
        self.assertEqual((proof.theorem, proof.cause), (jam.Theorem.TRAPPED, jam.ProofCause.EXCESS))
