"""Proof files as tests change them: their lines, what the checker says of them, and changes that must lose the proof."""
import pathlib
import sys
import tempfile
from fractions import Fraction

import jam

ROOT = pathlib.Path(__file__).resolve().parents[2]
CHECKER = ROOT / "bindings/proof/jamproof.py"
sys.path.insert(0, str(CHECKER.parent))
import jamproof  # noqa: E402


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


def word(value, exponent=-140):
    """A number of a proof file: value rounded to 2^exponent."""
    return f"{round(Fraction(value) / Fraction(2) ** exponent)}p{exponent}"


def value(text):
    return jamproof.number(text)


class File:
    """The lines of a proof file, to be changed."""

    def __init__(self, text):
        self.lines = [line.split() for line in text.splitlines()]
        self.spheres, self.contacts, self.at_walls = map(self.of, ("sphere", "contact", "wall"))
        self.stable = [line for line in self.spheres if line[1] == "1"]
        self.gamma = next(line for line in self.lines if line[0] in ("gamma", "growth"))

    def of(self, name):
        return [line for line in self.lines if line[0] == name]

    def header(self, name):
        return self.of(name)[0]

    def text(self):
        return "\n".join(" ".join(line) for line in self.lines) + "\n"

    def scale(self, line, at, factor):
        line[at] = word(value(line[at]) * Fraction(factor))

    def shift(self, line, at, by):
        line[at] = word(value(line[at]) + Fraction(by))


def apart(text):
    """The file with a larger distance of unlike spheres, of which libjam makes none within walls."""
    f = File(text)
    f.header("non_additivity")[1] = "3p-3"
    return f.text()


# Each is a change(file, random).
def dropped(name):
    return lambda f, r: f.lines.remove(r.choice(f.of(name)))


def doubled(name):
    return lambda f, r: f.lines.append(list(r.choice(f.of(name))))


def force_times(factor, name):
    return lambda f, r: f.scale(r.choice(f.of(name)), -1, factor)


def moved(by):
    return lambda f, r: f.shift(r.choice(f.stable), 3 + r.randrange(len(f.spheres[0]) - 3), by)


def resized(by):
    return lambda f, r: f.scale(r.choice(f.stable), 2, 1 + by)


def wide_cell(by):
    return lambda f, r: f.scale(f.header("cell"), 1, 1 + by)


def centres_exchanged(f, r):
    a, b = r.sample(f.stable, 2)
    a[3:], b[3:] = b[3:], a[3:]


def rattler_into_neighbour(f, r):
    """A rattler put where it overlaps, or a new sphere where there is none."""
    stable = r.choice(f.stable)
    rattlers = [s for s in f.spheres if s[1] == "0"]
    if rattlers:
        r.choice(rattlers)[3:] = stable[3:]
    else:
        f.lines.append(["sphere", "0", stable[2], *stable[3:]])


def other_image(f, r):
    line = r.choice(f.contacts)
    line[3] = str(int(line[3]) + r.choice((-1, 1)))


def another_wall(f, r):
    line = r.choice(f.at_walls)
    line[2] = r.choice([str(c) for c in range(len(f.spheres[0]) - 3) if str(c) != line[2]])


def other_side(f, r):
    line = r.choice(f.at_walls)
    line[3] = str(1 - int(line[3]))


def other_sphere(f, r):
    line = r.choice(f.at_walls)
    line[1] = r.choice([str(k) for k in range(len(f.spheres)) if [str(k), *line[2:4]] not in [c[1:4] for c in f.at_walls]])


def outside(f, r):
    """A sphere reflected at the wall that it touches: F is the same."""
    line = r.choice(f.at_walls)
    sphere, axis = f.spheres[int(line[1])], int(line[2])
    edge = value(f.header("cell")[1 + (axis + 1) * (axis + 2) // 2 - 1])
    x = sum(value(part) for part in sphere[3 + axis].split(","))
    sphere[3 + axis] = word((2 * edge if line[3] == "1" else 0) - x)


def half_force(f, r):
    """A hint: what balances is computed, and lies farther away than the bound of these forces."""
    for line in f.at_walls:
        f.scale(line, -1, Fraction(1, 2))


#: Of contacts with flat and round walls
AT_WALLS = {
    "wall missing": dropped("wall"), "wall twice": doubled("wall"), "pull": force_times(-1, "wall"), "no force": force_times(0, "wall"),
    "half the force": half_force, "another sphere": other_sphere,
}  # fmt: skip


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


def rattler_outside(f, r):
    sphere = r.choice(f.spheres)
    far = [word(-2 * value(f.header("cell")[1])), *sphere[4:]]
    f.lines.append(["sphere", "0", sphere[2], *far])


def another_pin(f, r):
    """A pin in place of a contact: as many equations as unknowns again."""
    f.lines.remove(r.choice(f.contacts))
    pin = next(k for k, s in enumerate(f.spheres) if s[1] == "1" and ["pin", str(k), "0"] not in f.lines and k)
    f.lines.append(["pin", str(pin), "0"])


def pinned_rattler(f, r):
    f.lines.append(["sphere", "0", *f.spheres[0][2:]])
    f.header("pin")[1] = str(len(f.spheres))


def width(edges):
    def change(f, r):
        cell, d = f.header("cell"), len(f.spheres[0]) - 3
        for q in range(min(edges, d)):
            f.scale(cell, (q + 1) * (q + 2) // 2, Fraction(999, 1000))

    return change


def other_axes(f, r):
    line = f.header("round")
    line[1] = str(5 - int(line[1]))


def inner_side(f, r):
    r.choice([line for line in f.at_walls if line[2] == str(len(f.spheres[0]) - 3)])[3] = "0"


def rattler_at_the_rim(f, r):
    """Half of it is outside the round wall, far from all others of a file without other spheres there."""
    edge, d = value(f.header("cell")[1]), len(f.spheres[0]) - 3
    f.lines.append(["sphere", "0", word(Fraction(1, 2**20)), word(edge), *[word(edge / 2)] * (d - 1)])


def wide_rattler(f, r):
    edge, d = value(f.header("cell")[1]), len(f.spheres[0]) - 3
    f.lines.append(["sphere", "0", word(2 * edge / value(f.gamma[1].split(",")[0])), *[word(edge / 2)] * d])


def larger_g(f, r):
    f.gamma[1] = word(sum(map(value, f.gamma[1].split(","))) * Fraction(1001, 1000))


#: Of files of packings between flat walls, and within a round one
FLAT = {
    **AT_WALLS, "another wall": another_wall, "the other side": other_side, "no line walls": dropped("walls"),
    "line walls of another axis": walls_elsewhere, "line walls twice": doubled("walls"), "leaning": leaning,
    "walls closer": closer_walls, "contact through a wall": through_a_wall, "outside": outside, "rattler outside": rattler_outside,
    "centre off by 1e-3": moved(Fraction(1, 1000)),
}  # fmt: skip
ROUND = {
    **AT_WALLS, "pin missing": dropped("pin"), "pin twice": doubled("pin"), "pin in place of a contact": another_pin,
    "pin of a rattler": pinned_rattler,
    "narrower": width(3), "not round": width(1), "round about other axes": other_axes, "no line round": dropped("round"),
    "line round twice": doubled("round"), "gamma for growth": lambda f, r: f.gamma.__setitem__(0, "gamma"), "side 0": inner_side,
    "rattler at the rim": rattler_at_the_rim, "rattler wider than the wall": wide_rattler, "contact missing": dropped("contact"),
    "larger g": larger_g, "no growth": dropped("growth"), "centre off by 1e-3": moved(Fraction(1, 1000)),
}  # fmt: skip


def try_changes(case, text, kinds, generator, **scene):
    """Each kind changes a file of its own: no proof, or, of a kind (change, by how much), one whose radius covers the change."""
    for kind, change in kinds.items():
        with case.subTest(kind=kind, **scene):
            change, away = change if isinstance(change, tuple) else (change, None)
            f = File(text)
            change(f, generator)
            found = verdict(f.text())
            if away is None and f.text() != text:
                case.assertNotIsInstance(found, dict, found)
            elif isinstance(found, dict):
                case.assertGreaterEqual(found["radius"], 0.5 * (away or 0.0))
