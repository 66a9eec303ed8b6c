"""Strict proofs: the cell deforms too. By numpy, by fractions, and by the checker, which knows neither.
"""
import os
import pathlib
import random
import subprocess
import tempfile
import unittest
from fractions import Fraction

import numpy as np

import jam
from proof_files import File, agree, dropped, file_of, force_times, moved, other_image, try_changes, value, verdict, wide_cell, word
from test_proof import fcc
from test_proof_bounds import FAR, checker, crystal, square_lattice
from test_proof_trapped import trapped


def packed(n, dim, seed, strain="free", every=2):
    diameters = np.where(np.arange(n) % every == every - 1, 1.4, 1.0) if dim == 2 else np.ones(n)
    system = jam.System.random(n=n, dim=dim, seed=seed, diameters=diameters, packing_fraction={2: 0.3, 3: 0.2}[dim])
    system.compress(growth_rate=1e-2, pressure=1e4)
    system.crunch(strain=strain)
    return system


class Strict(unittest.TestCase):

    def test_a_packing_of_a_fixed_cell_is_not_strict(self):
        for dim, seed in ((2, 1), (3, 1)):
            system = packed(32, dim, seed, "none")
            report = system.prove(strict=True)
            self.assertEqual((report.theorem, report.cause), (jam.Theorem.NONE, jam.ProofCause.EXCESS))
            needed = dim * (report.stable - 1) + dim * (dim + 1) // 2
            self.assertEqual((report.cause_value, report.cause_bound), (report.contacts, needed))
            self.assertLess(report.contacts, needed)
            text = file_of(system, strict=True)
            self.assertIn("\nstrict\n", text)
            self.assertNotIsInstance(verdict(text), dict)

    @unittest.skipUnless(os.environ.get("JAM_PACK"), "jam-pack is not built")
    def test_the_program_writes_strict_files(self):
        with tempfile.TemporaryDirectory() as folder:
            made, read, packing = (str(pathlib.Path(folder, name)) for name in ("a.jamproof", "b.jamproof", "a.xyz"))
            scene = ["--n", "32", "--dim", "2", "--diameters-ratio", "1.4", "--seed", "3", "--strain", "free", "--quiet"]
            for words in (scene + ["--output", packing, "--strict-proof", made], ["check", packing, "--strict-proof", read]):
                subprocess.run([os.environ["JAM_PACK"], *words], check=True, capture_output=True)
            told = subprocess.run([os.environ["JAM_PACK"], *scene[:-1], "--strict-proof", made, "--prove"], check=True, capture_output=True, text=True)
            self.assertRegex(told.stdout, "proof     strict jamming: proved, radius .*e-3")
            self.assertRegex(told.stdout, r"contacts \(isostatic \+0 for a cell that deforms\)")
            for path in (made, read):
                self.assertLess(verdict(pathlib.Path(path).read_text(encoding="ascii"))["radius"], 1e-30)


def edge_off(by):
    """One entry of the cell off by a number."""
    return lambda f, r: f.shift(f.header("cell"), 1 + r.randrange(3), by)


KINDS = {
    "contact missing": dropped("contact"),
    "contact with another image": other_image,
    "force negated": force_times(-1, "contact"),
    "the word strict left out": dropped("strict"),
    "cell wider by 1e-1": wide_cell(Fraction(1, 10)),
    "cell off by 1e-9": (edge_off(Fraction(1, 10**9)), 1e-9),
    "cell off by 1e-20": (edge_off(Fraction(1, 10**20)), 1e-20),
    "centre off by 1e-9": (moved(Fraction(1, 10**9)), 1e-9),
}


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.systems = [packed(n, dim, seed) for n, dim in ((16, 2), (24, 2), (14, 3)) for seed in range(1, 6)]
        cls.exact = [s for s in cls.systems if s.report.jammed and s.prove(strict=True).theorem == jam.Theorem.EXACT]
        cls.texts = [file_of(s, strict=True) for s in cls.exact]

    def test_the_checker_agrees_with_the_library(self):
        self.assertGreaterEqual(len(self.exact), 6)
        for system, text in zip(self.exact, self.texts):
            agree(self, system.prove(strict=True), verdict(text))

    def test_contacts_close_and_press_alike_on_all_axes(self):
        """In fractions of the file: one Gamma to 30 digits in the cell of two doubles, and an isotropic stress."""
        for text in self.texts:
            f = File(text)
            dim, entries = int(f.header("dim")[1]), [value(x) for x in f.header("cell")[1:]]
            cell = [[entries[q * (q + 1) // 2 + k] if k <= q else Fraction(0) for k in range(dim)] for q in range(dim)]
            x = [[value(v) for v in s[3:]] for s in f.spheres]
            gamma, stress = value(f.gamma[1]), np.zeros((dim, dim))
            for line in f.contacts:
                i, j, n, force = int(line[1]), int(line[2]), list(map(int, line[3 : 3 + dim])), float(value(line[-1]))
                r = [x[i][k] - x[j][k] + sum(n[q] * cell[q][k] for q in range(dim)) for k in range(dim)]
                sigma = (value(f.spheres[i][2]) + value(f.spheres[j][2])) / 2
                self.assertLess(abs(sum(v * v for v in r) / (gamma * sigma**2) - 1), Fraction(1, 10**29))
                self.assertGreater(force, 0.0)
                stress += force * np.outer(*2 * (list(map(float, r)),))
            self.assertLess(np.abs(stress / stress[0, 0] - np.eye(dim)).max(), 1e-9)

    def test_changed_files_are_not_proved(self):
        generator = random.Random(5)
        for text in self.texts:
            try_changes(self, text, KINDS, generator)

    def test_more_contacts_than_unknowns_are_trapped(self):
        """A crystal that rounding moves; without the word strict it is a packing of a fixed cell, trapped as well."""
        system = jam.System.from_arrays(fcc(3), 0.5**0.5 / 3.0 * (1 - 1e-15))
        system.contacts_from_geometry()
        self.assertEqual(system.prove(strict=True).theorem, jam.Theorem.TRAPPED)
        text = file_of(system, strict=True)
        found = trapped(text)
        self.assertIsInstance(found, dict, found)
        self.assertLess(found["inner"], 1e-12)
        f = File(text)
        edge_off(Fraction(1, 10**8))(f, random.Random(1))
        wider = trapped(f.text())
        self.assertTrue(isinstance(wider, str) or wider["inner"] > 1e-10, wider)
        self.assertEqual(verdict(square_lattice().replace("dim", "strict\ndim", 1)), "singular")  # rows shear


def crystal_with_one_axis_pressed():
    """Forces of the contacts across one axis doubled: they balance on every sphere, and not on the cell."""
    lines = crystal([tuple(row) for row in fcc(2).tolist()], Fraction(1, 8), 1)
    rows = [[value(x) for x in line.split()[3:]] for line in lines if line.startswith("sphere")]
    for k, line in enumerate(lines):
        if line.startswith("contact"):
            i, j, *n = map(int, line.split()[1:6])
            if rows[i][2] - rows[j][2] + n[2] != 0:
                lines[k] = line[: line.rindex(" ")] + " 2p0"
    return "\n".join([lines[0], "strict"] + lines[1:]) + "\n"


def grain_across_the_boundary(text):
    """Open by 1.5 radii of a sphere in the next cell, while sphere and cell vector may each come nearer by one."""
    intact = checker()
    f = File(text)
    edge_off(FAR)(f, random.Random(1))
    unit = value(f.header("unit")[1])
    radius, grain = Fraction(verdict(f.text(), intact)["radius"]) / unit, Fraction(1, 1000)
    edge = value(f.header("cell")[1])
    for stable in f.spheres:
        sigma = Fraction(float(value(f.gamma[1])) ** 0.5) * (value(stable[2]) + grain) / 2
        for gap, sign in ((10 * radius, 1), (Fraction(3, 2) * radius, 1)):
            x = value(stable[3]) + sigma + gap - edge
            there = f.text() + " ".join(["sphere", "0", word(grain), word(x), *stable[4:]]) + "\n"
            if not isinstance(verdict(there, intact), dict):
                break
        if gap < 10 * radius:
            return there
    raise AssertionError("no place for a grain")


def flower(system):
    """Lines of a file for a disk with six of its size around it, which touch in a ring: five triangles imply the sixth contact of the ring."""
    near = {}
    for c, (i, j) in enumerate(system.contacts.pairs.tolist()):
        near.setdefault(i, {})[j] = near.setdefault(j, {})[i] = c
    for middle, spokes in near.items():
        ring = {a: [b for b in spokes if b in near[a]] for a in spokes}
        if len(ring) == 6 and all(len(beside) == 2 for beside in ring.values()) and not np.ptp(system.diameters[[middle, *ring]]):
            order = [min(ring)]
            while len(order) < 6:
                order.append(next(a for a in ring[order[-1]] if a not in order))
            spoke, edge = [spokes[a] for a in order], [near[a][b] for a, b in zip(order, order[1:] + order[:1])]
            return [f"tile {spoke[k]} {edge[k]} {spoke[k + 1]}" for k in range(5)] + [f"implied {edge[5]} {spoke[5]} {spoke[0]}"]
    return []


def angles_of_tiles_in_a_free_cell():
    """A centre is off, so that the radius is 0.42 millionths of the least diameter. Contact vectors across a side of the cell move by
    three radii or more, those of a fixed cell by two: no more than a millionth may be."""
    for seed in range(10, 30):
        system = packed(32, 2, seed, every=8)
        text = file_of(system, strict=True) + "".join(line + "\n" for line in flower(system))
        if "\nimplied " in text and isinstance(verdict(text, checker()), dict):
            break

    def off(by):
        f = File(text)
        moved(by)(f, random.Random(1))
        return f

    trial, unit = Fraction(1, 10**10), value(off(0).header("unit")[1])
    least = Fraction(float(value(off(0).gamma[1])) ** 0.5) * min(value(s[2]) for s in off(0).spheres)
    radius = Fraction(verdict(off(trial).text(), checker())["radius"]) / unit
    return off(trial * Fraction(42, 10**8) * least / radius).text()


class Bounds(unittest.TestCase):
    def test_each_bound_is_needed(self):
        exact = next(s for s in (packed(16, 2, seed) for seed in range(1, 20)) if s.prove(strict=True).theorem == jam.Theorem.EXACT)
        table = (
            ("one pressure on all axes", "or len(pressure) > 1", "", crystal_with_one_axis_pressed()),
            ("cell vectors in a gap", "* (i != j) + self.strict * sum(map(abs, n))", "* (i != j)", grain_across_the_boundary(file_of(exact, strict=True))),
            ("cell vectors in the angles of tiles", "(ways * r)", "(2 * r)", angles_of_tiles_in_a_free_cell()),
        )
        for name, old, new, false in table:
            with self.subTest(bound=name):
                self.assertNotIsInstance(verdict(false, checker()), dict)
                self.assertIsInstance(verdict(false, checker((old, new))), dict)
