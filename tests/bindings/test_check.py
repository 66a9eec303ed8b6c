"""The verdict on a packing as it is, and what a crunch did to the packing that it was given.

Verdicts are judged by jamming_oracle.py, which shares no code with the library.
"""
import itertools
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import jam
from jam import CheckReason, Verdict
from jamming_oracle import contacts, judge

PACK = os.environ.get("JAM_PACK")


def fluid(n=64, dim=3, seed=1, fraction=0.55):
    s = jam.System.random(n, dim, seed)
    s.compress(growth_rate=1e-2, packing_fraction=fraction)
    return s


def packing(n=64, dim=3, seed=1, **more):
    s = jam.System.random(n, dim, seed, **more)
    s.compress(growth_rate=3e-2, pressure=500.0)
    report = s.crunch()
    assert report.jammed, (n, dim, seed)
    return s


def state(s):
    return np.array(s.positions), np.array(s.diameters), np.array(s.cell)


def lattice(basis, vectors, sizes):
    """Spheres of diameter 1 on basis + integer combinations of the vectors."""
    vectors = np.array(vectors, float)
    cells = np.array(list(itertools.product(*map(range, sizes)))) @ vectors
    x = (cells[:, None, :] + np.array(basis, float)[None]).reshape(-1, len(vectors))
    return x, np.diag(sizes) @ vectors


def cubic(m, dim=3):
    return lattice([[0] * dim], np.eye(dim), [m] * dim)


def fcc(m):
    basis = np.array([[0, 0, 0], [0, 1, 1], [1, 0, 1], [1, 1, 0]]) / np.sqrt(2)
    return lattice(basis, np.sqrt(2) * np.eye(3), [m] * 3)


def triangular(m):
    return lattice([[0, 0]], [[1, 0], [0.5, np.sqrt(3) / 2]], [m, m])


def made(x, cell, drop=(), **more):
    keep = np.delete(np.arange(len(x)), list(drop))
    return jam.System.from_arrays(x[keep], 1.0, cell=cell, overlap="shrink", **more)


class AsItIs(unittest.TestCase):
    def expect(self, s, jammed, strict=None, **more):
        """The library's verdict, that nothing changed, and the oracle's verdict."""
        before = state(s)
        report = s.check()
        for was, now in zip(before, state(s)):
            np.testing.assert_array_equal(was, now)
        self.assertEqual(report.jammed, jammed, report)
        if strict is not None:
            self.assertEqual(report.strictly_jammed, strict, report)
        for kind, verdict in ((False, report.jammed), (True, report.strictly_jammed)):
            if verdict != Verdict.UNDECIDED:
                mine = judge(*before, strict=kind, **more)
                self.assertEqual(verdict == Verdict.YES, mine[0], (kind, mine, report))
        return report

    def test_liquid(self):
        for dim, fraction in ((2, 0.7), (3, 0.55), (4, 0.3)):
            r = self.expect(fluid(48, dim, 1, fraction), Verdict.NO, Verdict.NO, reach=1)
            self.assertEqual(r.reason, CheckReason.APART)
            self.assertGreater(r.nearest_gap, 0)
            self.assertIn("No two spheres touch", str(r))

    def test_jammed_and_without_a_sphere(self):
        s = packing()
        x, diameters, cell = state(s)
        r = self.expect(s, Verdict.YES, Verdict.NO)
        self.assertEqual((r.reason, r.contacts, r.excess_contacts), (CheckReason.PROOF, s.report.contacts, 0))
        self.assertEqual(r.rattlers, s.report.rattlers)
        self.assertEqual(judge(x, diameters, cell)[1], r.contacts)
        self.assertIn("Collectively jammed, but not strictly", str(r))
        self.assertIn(f"{r.contacts} contacts hold {64 - r.rattlers} spheres", str(r))
        keep = np.arange(64) != np.flatnonzero(~s.rattlers)[0]
        loose = jam.System.from_arrays(x[keep], diameters[keep], cell=cell)
        r = self.expect(loose, Verdict.NO, Verdict.NO)
        self.assertEqual((r.reason, r.stationary), (CheckReason.NO_FORCE, Verdict.NO))
        self.assertGreater(r.closed_pairs, 100)

    def test_leaves_no_network(self):
        s = fluid(32)
        s.check()
        with self.assertRaises(jam.JamError):
            s.contacts

    def test_saddles_and_lattices(self):
        r = self.expect(made(*cubic(4)), Verdict.NO, Verdict.NO, reach=1)
        self.assertEqual((r.reason, r.flexes), (CheckReason.FLEX, 45))
        self.assertIn("a saddle", str(r))
        self.assertEqual(self.expect(made(*cubic(6, 2)), Verdict.NO).flexes, 10)
        for drop in ((), (3,), (3, 20)):
            self.expect(made(*fcc(2), drop), Verdict.YES, Verdict.YES, reach=1)
        for drop in ((), (7,)):
            r = self.expect(made(*triangular(6), drop), Verdict.YES, Verdict.YES, reach=1)
            self.assertGreater(r.self_stresses, 1)
            self.assertIn("Forces are not unique", str(r))
        self.expect(made(*triangular(6), (7, 8)), Verdict.NO, Verdict.NO, reach=1)  # two neighbours: a divacancy
        x, cell = lattice([[0, 0], [1, 0], [0.5, np.sqrt(3) / 2]], [[2, 0], [1, np.sqrt(3)]], [3, 3])
        self.expect(made(x, cell), Verdict.NO, Verdict.NO, reach=1)  # kagome

    def test_strictly_jammed_and_own_images(self):
        for n, dim, seed in ((20, 2, 1), (12, 3, 2)):
            s = jam.System.random(n, dim, seed, diameters=[1.0] * (n // 2) + [1.4] * (n - n // 2))
            if s.crunch(strain="free").strictly_jammed == Verdict.YES:
                self.expect(s, Verdict.YES, Verdict.YES)
        for dim in range(2, 7):
            s = jam.System.from_arrays(np.zeros((1, dim)), 0.3, cell=np.eye(dim) + 0.3 * np.tril(np.ones((dim, dim)), -1))
            s.crunch(strain="free")
            r = s.check()
            self.assertEqual((r.jammed, r.strictly_jammed, r.rattlers), (Verdict.YES, Verdict.YES, 0), r)
            self.assertEqual(judge(*state(s), strict=True, reach=1)[:2], (True, r.contacts))

    def test_models(self):
        half = [1.0] * 16 + [1.4] * 16
        for more in ({"diameters": half}, {"diameters": half, "non_additivity": 0.2}, {"diameters": half, "non_additivity": -0.2}):
            s = packing(32, 2, 3, **more)
            r = self.expect(s, Verdict.YES, non_additivity=more.get("non_additivity", 0.0))
            self.assertEqual(r.contacts, s.rigidity().contacts)
        s = packing(40, 3, 1, model="mk")
        self.assertEqual(s.check().jammed, Verdict.YES)
        for dim, n in ((4, 24), (5, 24)):
            self.assertEqual(packing(n, dim, 1).check().jammed, Verdict.YES)


class FewDigits(unittest.TestCase):
    """Rounded coordinates never give a no to a jammed packing, nor a yes to a liquid."""

    def rounded(self, s, digits, shift=0.0):
        x, diameters, cell = state(s)
        y = np.float32(x).astype(float) if digits == "single" else np.round(x, digits)
        return jam.System.from_arrays(y + shift, diameters, cell=cell, overlap="shrink")

    def test_digits(self):
        s = packing(100, 3, 2)
        diameter = s.diameters.mean()
        for digits in (5, 6, 7, 8, "single"):
            for shift in (0.0, 0.5):
                t = self.rounded(s, digits, shift)
                r = t.check()
                self.assertEqual((r.jammed, r.reason), (Verdict.UNDECIDED, CheckReason.DIGITS), r)
                step = 2.0**-24 if digits == "single" else 10.0**-digits
                self.assertTrue(0.4 * step < r.coordinate_step < 2.1 * step, r)
                self.assertEqual((r.crunch_jammed, r.crunch_contacts), (Verdict.YES, s.report.contacts), r)
                # the softest mode answers a rounding of every contact
                soft = 1 / np.sqrt(s.report.rigidity_margin)
                self.assertLess(r.crunch_displacement_max, 10 * soft * step / diameter)
                self.assertIn(f"finds {r.crunch_contacts} contacts, jammed", str(r))
                if digits != "single":
                    self.assertEqual(r.digits, digits)
                    self.assertIn(f"seem to have {digits} digits", str(r))
                for kind in ("collective", "strict"):
                    self.assertEqual(t.rigidity(kind).jammed, Verdict.UNDECIDED)
                    self.assertGreaterEqual(t.rigidity(kind).undecided_contacts, s.report.contacts - 1)
                found = t.contacts_from_geometry()
                # gaps below 1e-7 of a network that a clear jump names are contacts
                self.assertIn(t.status, (jam.StatusCode.OK, jam.StatusCode.AMBIGUOUS), found)
                self.assertTrue(t.status == jam.StatusCode.AMBIGUOUS or found.gap_below < 1e-7, found)
                self.assertGreater(found.resolution, step)

    def test_digits_of_other_systems(self):
        half = [1.0] * 20 + [1.4] * 20
        for n, dim, more in ((40, 2, {"diameters": half}), (40, 2, {"diameters": half, "non_additivity": 0.1}), (40, 4, {})):
            s = packing(n, dim, 4, **more)
            x, diameters, cell = state(s)
            t = jam.System.from_arrays(
                np.round(x, 6), diameters, cell=cell, overlap="shrink", non_additivity=more.get("non_additivity", 0.0)
            )
            self.assertEqual(t.check(crunch=False).jammed, Verdict.UNDECIDED)
        x, cell = fcc(3)
        for drop in ((), (5,)):
            y = np.delete(np.round(x / cell[0, 0], 6), list(drop), axis=0)
            t = jam.System.from_arrays(y, 1 / cell[0, 0], overlap="shrink")
            self.assertNotEqual(t.check(crunch=False).jammed, Verdict.NO)

    def test_digits_of_radii_and_cell(self):
        """Centres with all digits beside rounded radii, a rounded cell, or some rounded centres."""
        s = packing(60, 3, 4, diameters=np.linspace(1.0, 1.3, 60))
        x, diameters, cell = state(s)
        some = x.copy()
        some[:12] = np.round(some[:12], 5)
        for digits in (5, 6):
            down = np.floor(diameters * 10**digits) / 10**digits
            near = np.round(cell, digits) + np.diag([10.0**-digits] * 3)
            for what in ((x, down, cell), (x @ np.linalg.inv(cell) @ near, diameters * (1 - 1e-7), near), (some, diameters, cell)):
                t = jam.System.from_arrays(what[0], what[1], cell=what[2], overlap="allow")
                r = t.check(crunch=False)
                self.assertEqual((r.jammed, r.reason), (Verdict.UNDECIDED, CheckReason.DIGITS), r)
        whole = jam.System.from_arrays(x, diameters, cell=cell, overlap="shrink").check(crunch=False)
        self.assertEqual(whole.jammed, Verdict.YES)

    def test_digits_of_a_lattice(self):
        """Pairs along an axis touch exactly whatever the digits are; the others do not."""
        for digits in range(3, 9):
            a = np.round(np.diag([1, 3**0.5]), digits)
            basis = ([0, 0], [0.5, a[1, 1] / 2])
            x = np.array([np.array([i, k]) @ a + p for i in range(4) for k in range(3) for p in basis])
            r = jam.System.from_arrays(x, 1.0, cell=a * [[4], [3]], overlap="shrink").check(crunch=False)
            self.assertNotEqual(r.jammed, Verdict.NO, (digits, r))

    def test_digits_before_a_shift(self):
        """Digits are those of the numbers given, not of wrapped, shifted or rotated ones; a move leaves none."""
        s = packing(60, 3, 4)
        x, diameters, cell = state(s)
        scale = 12.3456789 / cell[0, 0]
        y = np.round((x - cell[0, 0] / 2) * scale, 5)
        t = jam.System.from_arrays(y, diameters * scale * (1 - 4e-6), cell=cell * scale)
        for u in (t, t.copy()):
            self.assertEqual(u.check(crunch=False).digits, 6)
        with tempfile.TemporaryDirectory() as folder:
            t.write_checkpoint(f"{folder}/c")
            self.assertEqual(jam.System.from_checkpoint(f"{folder}/c").check(crunch=False).digits, 6)
            low, high = -cell[0, 0] * scale / 2, cell[0, 0] * scale / 2
            with open(f"{folder}/dump", "w") as f:
                f.write("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n60\nITEM: BOX BOUNDS pp pp pp\n")
                f.write(f"{low:.16e} {high:.16e}\n" * 3 + "ITEM: ATOMS id x y z diameter\n")
                for k, (r, sigma) in enumerate(zip(y, diameters * scale * (1 - 4e-6))):
                    f.write("%d %.6g %.6g %.6g %.17g\n" % (k + 1, *r, sigma))
            self.assertEqual(jam.System.read(f"{folder}/dump").check(crunch=False).jammed, Verdict.UNDECIDED)
            irrational = np.pi / cell[0, 0]
            z = np.round((x - cell[0, 0] / 2) * irrational, 5)
            u = jam.System.from_arrays(z, diameters * irrational * (1 - 2e-5), cell=cell * irrational)
            for ending in ("xyz", "data", "dat"):
                u.write(f"{folder}/u.{ending}")
                self.assertEqual(jam.System.read(f"{folder}/u.{ending}").check(crunch=False).jammed, Verdict.UNDECIDED)
        t.run(collisions_per_particle=5)
        self.assertEqual(t.check(crunch=False).digits, 0)

    def test_liquid_stays_no(self):
        s = fluid(100, 3, 1, 0.6)
        for digits in (6, 7, 8, "single"):
            r = self.rounded(s, digits).check()
            self.assertEqual((r.jammed, r.reason), (Verdict.NO, CheckReason.APART), r)

    def test_reduced_spheres_are_another_packing(self):
        """Equal spheres that overlap by more than their digits leave are not called jammed for smaller spheres."""
        s = packing(64, 3, 1)
        for factor, right in ((1 + 1e-9, Verdict.YES), (1.01, Verdict.UNDECIDED), (1.8, Verdict.UNDECIDED)):
            t = jam.System.from_arrays(s.positions, s.diameters * factor, overlap="allow")
            r = t.check(crunch=False)
            self.assertEqual(r.jammed, right, r)
            self.assertEqual(r.reason is CheckReason.OVERLAP, factor > 1.001, r)
            self.assertNotEqual(r.strictly_jammed, Verdict.YES)

    def test_own_images_that_balance_are_a_saddle(self):
        h = 3**0.5 / 2
        body = np.array([[1, 1, -1], [-1, 1, 1], [1, -1, 1]]) / 3**0.5
        face = np.array([[1, 1, 0], [0, 1, 1], [1, 0, 1]]) / 2**0.5
        lattices = [(np.eye(2), False), (np.eye(3), False), (body, False), (face, True), ([[1, 0], [0.5, h]], True)]
        for cell, jammed in lattices:
            cell = np.array(cell, float)
            s = jam.System.from_arrays(np.zeros((1, len(cell))), 1.0, cell=cell, overlap="shrink")
            r = s.check()
            self.assertEqual(r.jammed, Verdict.YES if jammed else Verdict.NO, r)
            self.assertEqual(r.reason, CheckReason.PROOF if jammed else CheckReason.FLEX, r)
            self.assertEqual(s.rigidity("collective").jammed, r.jammed)

    def test_overlaps_are_resolution(self):
        """A frame that was rotated after rounding shows no digits, but it overlaps."""
        s = packing(64, 3, 1)
        x, diameters, cell = state(s)
        first, then = (np.linalg.qr(np.random.default_rng(k).normal(size=(3, 3)))[0] for k in (1, 2))
        y = np.round(3**0.5 * x @ first, 6) @ then
        t = jam.System.from_arrays(y, 3**0.5 * diameters, cell=3**0.5 * cell @ first @ then, overlap="allow")
        r = t.check()
        self.assertEqual((r.jammed, r.reason), (Verdict.UNDECIDED, CheckReason.OVERLAP), r)
        self.assertLess(r.diameter_factor, 1)
        self.assertEqual(r.crunch_contacts, s.report.contacts)

    @unittest.skipUnless(PACK, "jam-pack is not built")
    def test_files(self):
        s = packing(100, 3, 2)
        liquid = fluid(100, 3, 1, 0.6)
        with tempfile.TemporaryDirectory() as folder:
            for ending in (".dat", ".xyz", ".data"):
                path = Path(folder) / ("p" + ending)
                for system, codes in ((s, (0, 3)), (liquid, (1, 1))):
                    system.write(str(path))
                    self.assertEqual(self.run_both(path)[0], codes[0])
                    long = path.read_text()
                    for digits in (6, 7, 8):
                        short = re.sub(r"\d\.\d{9,}(e[-+]\d+)?", lambda m: f"{float(m[0]):.{digits}f}", long)
                        path.write_text(short)
                        code, text = self.run_both(path)
                        self.assertEqual(code, codes[1], text)
                        if code == 3:
                            self.assertIn(f"finds {s.report.contacts} contacts, jammed", text)

    def run_both(self, path):
        """jam-pack check and python3 -m jam check say the same."""
        done, other = (
            subprocess.run([*program, "check", str(path)], capture_output=True, text=True, timeout=120)
            for program in ([PACK], [sys.executable, "-m", "jam"])
        )
        self.assertEqual((other.returncode, other.stdout), (done.returncode, done.stdout), done.stderr)
        return done.returncode, done.stdout


@unittest.skipUnless(PACK, "jam-pack is not built")
class Program(unittest.TestCase):
    def pack(self, *words):
        return subprocess.run([PACK, *map(str, words)], capture_output=True, text=True, timeout=120)

    def test_check_refuses(self):
        self.assertEqual(self.pack("check").returncode, 2)
        self.assertEqual(self.pack("check", "no-such-file").returncode, 2)
        self.assertEqual(self.pack("check", "no-such-file", "--growth", "1").returncode, 2)

    def test_the_verdict_of_a_crunch_is_not_that_of_the_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "liquid.xyz"
            fluid(64).write(str(path))
            done = self.pack("--input", path, "--output", Path(folder) / "end.xyz")
            self.assertRegex(done.stdout, r"moved     phi 0\.55\d+ -> 0\.6\d+, spheres by up to 0\.\d+ diameters")
            self.assertIn("the file  is not tested: 'jammed' is the end state", done.stdout)
            self.assertIn(f"jam-pack check {path}", done.stdout)
            self.assertEqual(self.pack("check", path).returncode, 1)
            self.assertEqual(self.pack("check", Path(folder) / "end.xyz").returncode, 0)


class Changes(unittest.TestCase):
    def moved(self, start, end, cell, unit):
        """Largest and rms displacement by nearest images, for moves below half a cell; mean taken out."""
        s = (end - start) @ np.linalg.inv(cell)
        x = (s - np.round(s)) @ cell
        x -= x.mean(0)
        length = np.linalg.norm(x, axis=1) / unit
        return length.max(), np.sqrt((length**2).mean())

    def test_of_a_liquid(self):
        for method in ("barrier_path", "sequential_lp"):
            s = fluid(64)
            start, before = state(s), s.packing_fraction
            r = s.crunch(method=method)
            largest, rms = self.moved(start[0], s.positions, start[2], s.diameters.mean())
            self.assertEqual(r.packing_fraction_start, before)
            self.assertAlmostEqual(r.displacement_max, largest, delta=1e-9)
            self.assertAlmostEqual(r.displacement_rms, rms, delta=1e-9)
            self.assertEqual((r.contacts_start, r.contacts_kept), (0, 0))
            self.assertIn("displacement_max", repr(r))

    def test_pairs_that_touch_before_a_crunch_are_closed(self):
        for p in (1e5, 1e7, 1e9):
            s = jam.System.random(n=100, dim=3, seed=2)
            s.compress(growth_rate=0.1, pressure=p)
            closed = s.check(crunch=False).closed_pairs
            self.assertEqual(s.crunch().contacts_start, closed)

    def test_gaps_count_the_same_whoever_lists_them(self):
        a = packing(64, 3, 1)
        yes, no = jam.Verdict.YES, jam.Verdict.NO
        for shrunk, right in ((1e-12, yes), (5e-10, no), (9e-8, no), (2e-7, no)):
            s = jam.System.from_arrays(a.positions, a.diameters * (1 - shrunk))
            verdicts = [s.rigidity().jammed, s.check(crunch=False).jammed]
            s.contacts_from_geometry()
            verdicts += [s.rigidity().jammed, s.check(crunch=False).jammed]
            self.assertEqual(verdicts, [right] * 4, shrunk)
            self.assertEqual(s.report.jammed, right is yes)

    def test_of_a_jammed_packing(self):
        s = packing(64, 2, 3, diameters=[1.0] * 32 + [1.4] * 32)
        count = s.report.contacts
        x, diameters, cell = state(s)
        for y in (x, np.round(x, 7)):
            t = jam.System.from_arrays(y, diameters, cell=cell, overlap="shrink")
            r = t.crunch()
            self.assertEqual(r.contacts_kept, count)
            self.assertGreaterEqual(r.contacts_start, count)
            self.assertLess(r.contacts_start, count + 40)
            free = jam.System.from_arrays(x[~s.rattlers], diameters[~s.rattlers], cell=cell).crunch()
            self.assertLess(free.displacement_max, 1e-7)
            self.assertLess(r.displacement_max_stable, 1e-4)

    def test_reports_of_other_calls_say_nothing(self):
        s = packing(32)
        s.contacts_from_geometry()
        self.assertTrue(np.isnan(s.report.displacement_max))
        self.assertEqual(s.report.contacts_kept, -1)


class OwnImages(unittest.TestCase):
    def test_no_margin_is_infinite(self):
        """Two spheres of ratio 1.4 in a free cell of d = 4: the large one ends a hair from its own images."""
        open_ends = 0
        for seed in range(1, 31):
            s = jam.System.random(n=2, dim=4, seed=seed, diameters=[1.0, 1.4], packing_fraction=0.05)
            if seed % 2:
                s.compress(growth_rate=0.3, pressure=1e3)
            report = s.crunch(strain="free", wall_time=20.0)
            found = s.rigidity("collective")
            self.assertTrue(np.isfinite(found.rigidity_margin), (seed, found))
            self.assertEqual(report.jammed, found.jammed == Verdict.YES, (seed, report, found))
            if found.jammed != Verdict.YES:
                open_ends += 1
                self.assertNotEqual(s.check(crunch=False).jammed, Verdict.YES)
        self.assertGreater(open_ends, 0)


if __name__ == "__main__":
    unittest.main()
