"""Trapping by the checker: crystals and other packings with more contacts than unknowns, and what it must refuse."""
import base64
import random
import tempfile
import unittest
import zlib
from fractions import Fraction
from pathlib import Path

import numpy as np

import jam
from proof_files import File, dropped, file_of, jamproof, rattler_into_neighbour, scene_of, value, word
from test_proof_bounds import checker, fcc, square_lattice


def disks(n, seed):
    system = jam.System.random(n, 2, seed)
    system.compress([(1e-2, 500.0), (3e-3, 1e7)])
    system.crunch()
    return system


def disks_of(name):
    """300 equal disks in a square of side 1, near a packing that is hard to test."""
    scenes = np.load(Path(__file__).with_name("disks.npz"))
    return jam.System.from_arrays(scenes[name], np.full(300, scenes[name + "_diameter"]), 1.0)


def imbalance(system):
    """The largest sum of forces on a disk over their mean, with directions from positions."""
    sums, x = np.zeros((system.n, 2)), system.positions
    for (i, j), force in zip(system.contacts.pairs, system.forces):
        r = x[i] - x[j]
        r -= system.box * np.round(r / system.box)
        sums[i] += force * r / np.hypot(*r)
        sums[j] -= force * r / np.hypot(*r)
    return abs(sums).max() / system.forces.mean()


def trapped(text, program=jamproof):
    """What the checker finds of a text, or the first word of its refusal."""
    return density(text, program)[1]


def density(text, program=jamproof):
    """Gamma at which no pair of the file overlaps, and what the checker finds."""
    scene = scene_of(text, program)
    try:
        found = program.beside("jamproof_trapped", "trapped", scene)
    except program.Refused as why:
        found = str(why).split(":")[0]
    return scene.gamma, found


def moved(text, by, generator):
    f = File(text)
    f.shift(generator.choice(f.stable), 3, by)
    return f.text()


class Trapped(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.systems = [s for s in (disks(64, seed) for seed in range(1, 5)) if s.report.jammed and s.report.excess_contacts > 0]
        cls.texts = [file_of(s) for s in cls.systems]

    def test_the_checker_agrees_with_the_library(self):
        self.assertGreaterEqual(len(self.texts), 3)
        for system, text in zip(self.systems, self.texts):
            proof, found = system.prove(), trapped(text)
            self.assertNotEqual(proof.theorem, jam.Theorem.NONE)
            self.assertIsInstance(found, dict, found)
            self.assertLess(found["inner"], 1e-18)
            self.assertGreater(found["outer"], 1e-12)
            self.assertAlmostEqual(min(proof.least_gap, 1e-3), min(found["least_gap"], 1e-3), delta=1e-9)

    def test_status_and_words(self):
        with tempfile.TemporaryDirectory() as folder:
            path, other = folder + "/a.jamproof", folder + "/b.jamproof"
            for text in self.texts[:2]:
                Path(path).write_text(text, encoding="ascii")
                status, words = jamproof.conclusion(jamproof.Scene(path))
                self.assertIn((status, words.split(":")[0]), ((0, "proved"), (3, "trapped")))
                self.assertEqual(jamproof.main(path, other), status)
                self.assertEqual(jamproof.conclusion(jamproof.Scene(other)), (status, words))

    def test_a_packing_out_of_place_widens_the_trap(self):
        """The denser packing that was moved away from lies within inner, or nothing is claimed."""
        generator = random.Random(1)
        for text in self.texts:
            gamma, found = density(text)
            self.assertLess(found["gamma_error"], 1e-28)
            for power in (30, 20, 15, 12, 9, 6, 3):
                away = moved(text, Fraction(1, 10**power), generator)
                lower, found = density(away)
                if isinstance(found, dict):
                    self.assertGreater(found["inner"], 0.4 * 10.0**-power)
                    self.assertLess(lower, gamma * (1 + Fraction(1, 10**28)))
                    room = Fraction(found["gamma_error"]) * value(File(away).gamma[1])
                    self.assertLessEqual(gamma, lower + room)
                    self.assertLessEqual(abs(gamma - value(File(away).gamma[1])), room)

    def test_units_of_their_own_widen_the_trap_too(self):
        """Where loosely held spheres have longer units, the packing that was moved away from lies within inner as well."""
        both = "for grown in [[1] * s.unknowns] + ([] if s.strict else [loosely_held(s, inverse, stress)]):"
        program, generator = checker((both, "for grown in [loosely_held(s, inverse, stress)]:")), random.Random(5)
        for text in self.texts:
            self.assertLess(trapped(text, program)["inner"], 1e-18)
            for power in (20, 12, 9, 6):
                found = trapped(moved(text, Fraction(1, 10**power), generator), program)
                if isinstance(found, dict):
                    self.assertGreater(found["inner"], 0.4 * 10.0**-power)
                    self.assertLess(found["inner"], found.get("outer", 1.0))

    def test_the_gamma_of_the_file_counts(self):
        """What is printed is true of the file's gamma: of spheres of that size, and of the distance to the own one."""
        for text in self.texts:
            own, right = density(text)
            f = File(text)
            gamma = value(f.gamma[1])
            upper = own * (1 + Fraction(right["gamma_error"]))
            for power in (20, 12, 9, 7):
                for sign in (1, -1):
                    f = File(text)
                    f.scale(f.gamma, 1, 1 + sign * Fraction(1, 10**power))
                    wrong = value(f.gamma[1])
                    found = trapped(f.text())
                    if not isinstance(found, dict):
                        self.assertLess(power, 20)
                        continue
                    self.assertGreaterEqual(Fraction(found["gamma_error"]) * wrong, abs(wrong - gamma) * (1 - Fraction(1, 10**9)))
                    if sign < 0:  # smaller spheres: every one alone is free to move by the gap
                        self.assertGreater(found["inner"], 0.49 * 10.0**-power * float(gamma) ** 0.5)
            for wrong in ("1p-4", "1p-6", "1p-8", "1p-600", "1p600", word(upper * Fraction(101, 100))):
                f = File(text)
                f.gamma[1] = wrong
                self.assertEqual(trapped(f.text()), "gamma", wrong)

    def test_an_inverse_of_zeros_traps_nothing(self):
        scene = scene_of(self.texts[0])
        data = base64.b64encode(zlib.compress(bytes(4 * len(scene.contacts) * scene.unknowns))).decode()
        self.assertEqual(trapped(self.texts[0] + f"inverse -20 {data}\n"), "singular")

    def test_what_is_not_trapped_is_refused(self):
        generator = random.Random(2)
        for text in self.texts:
            f = File(text)
            rattler_into_neighbour(f, generator)
            self.assertEqual(trapped(f.text()), "gap")
            f = File(text)
            for line in f.contacts:  # forces are hints: one step balances them, but not from the opposite of all
                f.scale(line, 5, -1)
            self.assertEqual(trapped(f.text()), "force")
        self.assertIsInstance(trapped(square_lattice()), str)
        for take in range(1, 12):  # too few contacts hold nothing
            f = File(self.texts[0])
            while len(f.contacts) > 2 * sum(s[1] == "1" for s in f.spheres) - 2 - take:
                dropped("contact")(f, generator)
                f = File(f.text())
            self.assertIsInstance(trapped(f.text()), str)

    def test_a_crystal_is_trapped_and_stays_so_when_rounded(self):
        text = "\n".join(fcc()) + "\n"
        found = trapped(text)
        self.assertIsInstance(found, dict, found)
        self.assertLess(found["inner"], 1e-30)
        f, generator = File(text), random.Random(3)
        for s in f.spheres:
            s[3:] = [word(value(x) + Fraction(generator.randrange(-9, 10), 10**17)) for x in s[3:]]
        found = trapped(f.text())
        self.assertIsInstance(found, dict, found)
        self.assertTrue(1e-17 < found["inner"] < 1e-10 < found["outer"])

    def test_listed_contacts_close_together(self):
        """Doubles do not distinguish weak forces of crystals from gaps: where the listed contacts do not all close,
        crunch and test of jamming list those that do. The integers of the checker say whether they are all and close."""
        for seed in (17, 34):
            with self.subTest(seed=seed):
                system = disks(300, seed)
                self.assertTrue(system.report.jammed)
                listed = sorted(tuple(sorted(pair)) for pair in system.contacts.pairs.tolist())
                text = file_of(system)
                found = trapped(text)
                self.assertIsInstance(found, dict, found)
                self.assertLess(found["inner"], 1e-18)
                self.assertEqual(sorted(tuple(sorted(map(int, c[1:3]))) for c in File(text).contacts), listed)
                self.assertEqual(system.report.contacts, len(listed))
                self.assertEqual(system.rigidity("collective").contacts, len(listed))
                alone = jam.System.from_arrays(system.positions, system.diameters, system.box)  # without that list
                self.assertEqual(alone.rigidity("collective").contacts, len(listed))
                self.assertGreater(min(system.forces), 0.0)
                self.assertLess(imbalance(system), 1e-13)
        self.assertLess(imbalance(disks(300, 123)), 1e-13)  # near a saddle contacts are open by more than that

    def test_contacts_that_close_together_may_carry_no_force(self):
        """All 776 contacts of this crunch close in two doubles. Where they are closed one of the forces that balance in
        doubles, 1.5e-11 of the mean, is gone: neither a proof nor the checker finds it positive."""
        system = disks_of("saddle")
        for verdict in (system.rigidity("collective"), system.check()):
            self.assertEqual(verdict.jammed, jam.Verdict.UNDECIDED)

    def test_a_disk_between_opposite_contacts_is_not_called_jammed(self):
        """Disk 296 lies between two contacts that are opposite but for 2e-7. In whole numbers it moves by 1e-7 of its
        size, and overlaps by 1e-14: doubles do not hold it. A crunch leads to contacts that hold all disks."""
        system = disks_of("opposite")
        verdict = system.rigidity("collective")
        self.assertEqual(verdict.jammed, jam.Verdict.UNDECIDED)
        self.assertIn("1 motion keeps the contacts closed", verdict.status_text)
        self.assertEqual(system.check(crunch=False).jammed, jam.Verdict.UNDECIDED)
        x = [[Fraction(v) for v in row] for row in system.positions.tolist()]
        size = Fraction(float(system.diameters[0]))

        def gaps(at):
            around = [[a - b - round(a - b) for a, b in zip(at, other)] for k, other in enumerate(x) if k != 296]
            return [(sum(a * a for a in r) / size**2 - 1, r) for r in around]

        contacts = [r for gap, r in gaps(x[296]) if abs(gap) < Fraction(1, 10**12)]
        self.assertEqual(len(contacts), 3)
        moved = [[a + t * b for a, b in zip(x[296], (-r[1], r[0]))] for r in contacts for t in (Fraction(1, 10**7), -Fraction(1, 10**7))]
        self.assertTrue(any(min(gap for gap, _ in gaps(at)) > -Fraction(5, 10**14) for at in moved))
        self.becomes_jammed(system)

    def test_a_saddle_is_not_called_jammed(self):
        """Contacts with forces of 1e-8 of the mean do not close together with all others."""
        system = disks_of("weak")
        verdict = system.rigidity("collective")
        self.assertEqual(verdict.jammed, jam.Verdict.UNDECIDED)
        self.assertIn("a saddle", verdict.status_text)
        self.assertEqual(system.check(crunch=False).jammed, jam.Verdict.UNDECIDED)
        system.contacts_from_geometry()
        proof = system.prove()
        self.assertEqual((proof.theorem, proof.cause), (jam.Theorem.NONE, jam.ProofCause.SADDLE))
        self.assertLess(max(proof.cause_value, proof.cause_bound), 1e-7)
        self.becomes_jammed(system)

    def test_slices_of_a_decompressed_crunch(self):
        """Slices make as many decompressions as one call, also through a file."""
        whole, sliced = disks_of("weak"), disks_of("weak")
        self.assertTrue(whole.crunch().jammed)
        parts = np.array([1e-4, 1e-3, 1e-2, 3e-2, 0.1])
        decompressions = lambda s: [(abs(np.asarray(s.crunch_history().gain) + part) < 1e-12).sum() for part in parts]
        self.assertGreater(whole.report.decompressions, 0)
        self.assertEqual(sum(decompressions(whole)), whole.report.decompressions)
        made = np.zeros(5, dtype=int)
        with tempfile.TemporaryDirectory() as folder:
            for k in range(100):
                report = sliced.crunch(max_lps=12)
                made += decompressions(sliced)
                if report.stop_reason != jam.StopReason.LP_LIMIT:
                    break
                sliced.save(folder + "/a.h5")
                sliced = jam.load(folder + "/a.h5")
        self.assertLess(k, 99)
        self.assertLess(made.max(), 2)
        self.assertEqual(made.sum(), report.decompressions)

    def becomes_jammed(self, system):
        """From near a saddle: a jammed packing is within some hundredths of a diameter, or a tenth after the last decompression."""
        fraction = system.packing_fraction
        report = system.crunch()
        self.assertTrue(report.jammed)
        self.assertEqual(system.rigidity("collective").jammed, jam.Verdict.YES)
        self.assertIsInstance(trapped(file_of(system, [1.0] * 300)), dict)
        # The way grows with the last decrease of the diameters: 0.1 instead of 0.03 or less after the fifth.
        longer = 0.1 / 0.03 if report.decompressions == 5 else 1.0
        self.assertLess(abs(system.packing_fraction - fraction), 1e-3 * longer)
        self.assertLess(report.displacement_rms, 0.1 * longer)

    def test_each_bound_is_needed(self):
        """With one bound taken out of the checker a false file passes."""
        far, generator = Fraction(1, 10**6), random.Random(4)
        text = moved(self.texts[0], far, generator)
        f = File(moved(self.texts[0], Fraction(1, 10**2), generator))
        f.gamma[1] = word(density(f.text(), checker(("OFF = Fraction(1, 1024)", "OFF = 10**9")))[0])
        far_off = f.text()
        f = File(self.texts[0])
        f.scale(f.gamma, 1, 1 - far)
        smaller, room = f.text(), 0.49 * float(far) * float(value(f.gamma[1])) ** 0.5
        f = File(self.texts[0])
        rattler_into_neighbour(f, generator)
        overlap = f.text()
        table = (
            ("opening", "    f, sigma2, columns = s.equations(every)", "    f, (sigma2, columns) = [TWO**-200] * len(every), s.equations(every)[1:]", text),
            ("room for second order", "if left > 0 and 4 * constant * second < left**2:", "if left > 0:", far_off),
            ("room of smaller spheres", "math.floor(min(own, gamma) *", "math.floor(own *", smaller),
            ("pairs stay apart", "refuse(have <= part,", "refuse(False,", overlap),
        )  # fmt: skip
        for name, old, new, false in table:
            with self.subTest(bound=name):
                near = {text: 0.4 * float(far), smaller: room}.get(false, 0.0)
                claims = lambda found: isinstance(found, dict) and (false is overlap or found["inner"] < near or "outer" not in found)
                self.assertFalse(claims(trapped(false)), trapped(false))
                program = checker((old, new))
                self.assertTrue(claims(trapped(false, program)), trapped(false, program))
