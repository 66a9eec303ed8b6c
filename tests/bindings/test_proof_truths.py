"""Proofs against what is known otherwise: algebraic numbers, lattices, contacts that others imply."""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

import h5py
import numpy as np

import jam
from proof_files import File, agree, file_of, try_changes, verdict
from test_proof import packing, refined_squares
from test_proof_bounds import crystal

KERNELS = ("Prescott", "Nehalem", "Sandybridge", "Haswell")
PROVE = """
import hashlib, json, sys, jam
system = jam.System.read(sys.argv[1])
system.contacts_from_geometry()
proof = system.prove()
centres = hashlib.sha256(b"".join(x.tobytes() for x in system.refined_positions())).hexdigest()
print(json.dumps({"kernel": jam.raw.jam_blas_kernel(), "theorem": int(proof.theorem), "radius": proof.radius, "centres": centres,
    "gamma": [proof.gamma.hex(), proof.gamma_low.hex()], "error": 2.0 / system.dim * proof.fraction_error}))
"""


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


def gamma_interval(proof, dim):
    """The enclosure of Gamma, exactly: fraction_error is relative, of Gamma^(d/2)."""
    middle = Fraction(proof.gamma) + Fraction(proof.gamma_low)
    half = middle * Fraction(proof.fraction_error) * Fraction(2, dim) * Fraction(1001, 1000)
    return middle - half, middle + half


def disks_on_torus(n, side):
    """Equal disks that a crunch jams at diameter side, from the first start that does."""
    for seed in range(1, 200):
        system = jam.System.random(n=n, dim=2, seed=seed, packing_fraction=0.2)
        system.crunch()
        if abs(float(system.diameters[0]) - side) < 1e-9 and system.report.jammed:
            return system
    raise AssertionError(f"no start of {n} disks ends at diameter {side}")


class KnownNumbers(unittest.TestCase):
    def test_three_disks_on_a_torus(self):
        """Largest diameter (sqrt(6) - sqrt(2)) / 2 (Dickinson et al., Discrete Comput. Geom. 2011): Gamma = 2 - sqrt(3)."""
        system = disks_on_torus(3, (6**0.5 - 2**0.5) / 2)
        proof = system.prove()
        self.assertEqual(proof.theorem, jam.Theorem.EXACT)
        low, high = gamma_interval(proof, 2)
        self.assertLess(high - low, Fraction(1, 10**28))
        self.assertGreater((2 - low) ** 2, 3)  # low < 2 - sqrt(3) < high
        self.assertLess((2 - high) ** 2, 3)
        self.assertIsInstance(verdict(file_of(system)), dict)

    def test_five_disks_on_a_torus(self):
        """The square lattice of the vectors (1, 2) / 5, (-2, 1) / 5: Gamma = 1 / 5, one contact more than unknowns.

        Fifths are no binary fractions, and no walk implies a contact: trapped, and Gamma is stationary there.
        """
        system = disks_on_torus(5, 0.2**0.5)
        self.assertEqual(system.report.excess_contacts, 1)
        proof = system.prove()
        self.assertEqual((proof.theorem, proof.cause), (jam.Theorem.TRAPPED, jam.ProofCause.EXCESS))
        self.assertLess(proof.inner, 1e-28)
        self.assertLess(abs(Fraction(proof.gamma) + Fraction(proof.gamma_low) - Fraction(1, 5)), Fraction(1, 10**31))
        self.assertEqual(verdict(file_of(system)), "excess")

    def test_kernels_and_threads_give_one_proof_or_enclosures_that_overlap(self):
        """The products of libjam itself: one proof, bit for bit. Those of OpenBLAS (JAM_BLAS): proofs of one packing."""
        system, _ = packing(48, 3, 2)
        with tempfile.TemporaryDirectory() as folder:
            path = folder + "/a.xyz"
            system.write(path)
            found = []
            for kernel, threads in [(k, "1") for k in KERNELS] + [("", "2")]:
                env = dict(os.environ, OPENBLAS_NUM_THREADS=threads, **({"OPENBLAS_CORETYPE": kernel} if kernel else {}))
                run = subprocess.run([sys.executable, "-c", PROVE, path], env=env, capture_output=True, text=True)
                if run.returncode < 0:  # the processor has not the instructions of this kernel
                    continue
                self.assertEqual(run.returncode, 0, run.stderr)
                found.append(json.loads(run.stdout))
        self.assertGreaterEqual(len(found), 3)
        if found[0]["kernel"] == "builtin":
            for one in found:
                self.assertEqual(one, found[0])
        else:
            self.assertGreaterEqual(len({f["kernel"] for f in found}), 3, [f["kernel"] for f in found])

        gammas = [sum(map(Fraction, map(float.fromhex, one["gamma"]))) for one in found]
        for one, gamma in zip(found, gammas):
            self.assertEqual(one["theorem"], int(jam.Theorem.EXACT))
            self.assertLessEqual(abs(gamma - gammas[0]), Fraction(one["error"] + found[0]["error"]) * gamma)


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


class ImpliedContacts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.found = []
        for n, seed in ((64, s) for s in range(1, 120)):
            system, ratio = packing(n, 2, seed)
            if system.report.jammed and system.report.excess_contacts in (1, 2):
                cls.found.append((system, ratio))
            if len(cls.found) == 3:
                break

    def test_flowers_and_patches_are_proved(self):
        self.assertGreaterEqual(len(self.found), 2)
        for system, ratio in self.found:
            agree(self, system.prove(ratio), verdict(file_of(system, ratio)))

    def test_implied_contacts_close_to_thirty_digits(self):
        """They are no equations of Newton's steps, and yet they close: in fractions."""
        for system, ratio in self.found:
            f = File(file_of(system, ratio))
            implied = {int(line[1]) for line in f.lines if line[0] == "implied"}
            self.assertEqual(len(implied), system.report.excess_contacts)
            squares = refined_squares(system, ratio)
            kept = next(square for c, square in enumerate(squares) if c not in implied)
            for c in implied:
                self.assertLess(abs(squares[c] / kept - 1), Fraction(1, 10**28))

    def test_what_no_walk_implies_is_refused(self):
        for system, ratio in self.found:
            text = file_of(system, ratio)
            f = File(text)
            implied = f.header("implied")
            named = {line[1] for line in f.of("implied")}
            other = next(str(c) for c in range(len(system.contacts.pairs)) if str(c) not in named | set(implied))

            def without(*names):
                return lambda f, r: f.lines.__setitem__(slice(None), [line for line in f.lines if line[0] not in names])

            def replace(name, at, word):
                return lambda f, r: f.header(name).__setitem__(at, word)

            try_changes(self, text, {
                "no word of implied contacts": without("tile", "implied"),
                "no tiles": without("tile"),
                "another contact called implied": replace("implied", 1, other),
                "the walk over another contact": replace("implied", 2, other),
                "a tile with another contact": replace("tile", 1, other),
                "a tile that rests on the implied one": replace("tile", 1, implied[1]),
                "a force of a kept contact negated": replace("contact", 5, "-1p-10"),
            }, None)  # fmt: skip


PACK = os.environ.get("JAM_PACK")


@unittest.skipUnless(PACK, "jam-pack is not built")
class Program(unittest.TestCase):
    def test_what_was_proved_is_shown(self):
        """Of a packing that is made: summary, report, page, proof file. Of a file: by jam-pack and python3 -m jam alike."""
        with tempfile.TemporaryDirectory() as folder:
            xyz, report, page, proof = (Path(folder, "a." + kind) for kind in ("xyz", "json", "html", "jamproof"))

            def run(*words):
                proof.unlink(missing_ok=True)
                done = subprocess.run([*map(str, words), "--prove", "--proof", str(proof)], capture_output=True, text=True, timeout=120)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIsInstance(verdict(proof.read_text(encoding="ascii")), dict)
                return done.stdout

            made = run(PACK, "--n", 48, "--seed", 2, "--output", xyz, "--report", report, "--page", page)
            told = json.loads(report.read_text(encoding="utf-8"))
            self.assertRegex(told["proof"], r"^proved, radius \d")
            self.assertLess(told["proof_radius"], 1e-28)
            self.assertIn(f'"proof": "{told["proof"]}"', page.read_text(encoding="utf-8"))
            self.assertRegex(made, r"proof +proved, radius")
            said = run(PACK, "check", xyz)
            self.assertIn("proved, radius", said)
            self.assertEqual(run(sys.executable, "-m", "jam", "check", xyz), said)


class Files(unittest.TestCase):
    def test_a_file_holds_centres_of_two_doubles(self):
        system, _ = packing(32, 3, 1)
        with tempfile.TemporaryDirectory() as folder:
            path = folder + "/a.h5"
            system.save(path, refined=True)
            high, low = system.refined_positions()
            with h5py.File(path, "r") as file:
                self.assertTrue(np.array_equal(file["particles/spheres/refined/high"][()], high))
                self.assertTrue(np.array_equal(file["particles/spheres/refined/low"][()], low))
            again = jam.load(path)
            self.assertTrue(np.array_equal(again.positions, system.positions))
            self.assertEqual(again.prove().radius, system.prove().radius)
