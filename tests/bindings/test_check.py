"""The verdict on a packing as it is, and what a crunch did to the packing that it was given.

Verdicts are judged by jamming_oracle.py, which shares no code with the library.
"""
import itertools
import json
import os
import pickle
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import jam
from jam import CheckReason, Verdict
from jamming_oracle import judge
from packings import cubic, fluid, packing, state

PACK = os.environ.get("JAM_PACK")


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

    def test_rows_that_slide_are_a_saddle(self):
        """Each of the d m^(d - 1) rows of a cubic lattice moves by itself; d of these motions are translations."""
        for dim, m, flexes in ((2, 6, 10), (3, 3, 24)):
            x, cell = cubic(m, dim)
            r = self.expect(jam.System.from_arrays(x, 1.0, cell=cell), Verdict.NO, Verdict.NO, reach=1)
            self.assertEqual((r.reason, r.flexes), (CheckReason.FLEX, flexes))
            self.assertIn(f"{flexes} independent motions keep all contacts closed: a saddle", str(r))

    def test_strictly_jammed_packings_are_counted_by_their_own_number(self):
        """d (N' - 1) + d (d + 1) / 2 contacts: a cell that deforms has as many more unknowns as traceless strains."""
        for dim, n in ((2, 20), (3, 12)):
            s = jam.System.random(n, dim, 3, diameters=[1.0] * (n // 2) + [1.4] * (n - n // 2))
            self.assertEqual(s.crunch(strain="free").strictly_jammed, Verdict.YES)
            r, strains = s.check(crunch=False), dim * (dim + 1) // 2 - 1
            self.assertEqual(r.strict_excess_contacts, r.contacts - (dim * (r.n - r.rattlers - 1) + 1 + strains))
            self.assertEqual(r.strict_excess_contacts, 0)
            self.assertIn(f"excess {strains} = d (d + 1) / 2 - 1: isostatic for a cell that deforms", str(r))
            self.assertIn("one of them with an isotropic stress", str(r))
            rounded = jam.System.from_arrays(np.round(s.positions, 8), s.diameters, cell=s.cell, overlap="shrink").check()
            self.assertEqual(rounded.jammed, Verdict.UNDECIDED)
            self.assertIn("strain=free", str(rounded))

    def test_overlaps_have_one_answer_by_every_call(self):
        jammed = [packing(20, dim) for dim in (2, 3)]
        for s, factor in itertools.product(jammed, (1 + 1e-9, 1 + 1e-6, 1.001, 1.05, 1.6)):
            t = jam.System.from_arrays(s.positions, factor * s.diameters, cell=s.cell, overlap="allow")
            r = t.check(crunch=False)
            self.assertEqual(r.jammed == Verdict.YES, factor < 1 + 1e-7)
            for kind, verdict in (("collective", r.jammed), ("strict", r.strictly_jammed)):
                self.assertEqual(t.rigidity(kind).jammed, verdict, (factor, kind))
            if r.jammed != Verdict.YES:
                self.assertEqual((r.jammed, r.reason), (Verdict.UNDECIDED, CheckReason.OVERLAP))
                t.bloch_rigidity([1] * t.dim)
                self.assertEqual(t.status, jam.StatusCode.AMBIGUOUS)
                t.contacts_from_geometry()
                self.assertFalse(t.report.jammed)
        soft = jam.System.from_arrays(s.positions, 2.5 * s.diameters, cell=s.cell, overlap="allow")
        for call in (soft.check, soft.rigidity, soft.flex, soft.contacts_from_geometry):
            with self.assertRaisesRegex(jam.JamError, "no packing of hard spheres"):
                call()

    def test_models(self):
        half = [1.0] * 16 + [1.4] * 16
        for more in ({"diameters": half}, {"diameters": half, "non_additivity": 0.2}, {"diameters": half, "non_additivity": -0.2}):
            s = packing(32, 2, 3, **more)
            r = self.expect(s, Verdict.YES, non_additivity=more.get("non_additivity", 0.0))
            self.assertEqual(r.contacts, s.rigidity().contacts)
            for other in (s.copy(), pickle.loads(pickle.dumps(s))):
                self.assertEqual(other.info.non_additivity, more.get("non_additivity", 0.0))
        s = packing(40, 3, 1, model="mk")
        self.assertEqual(s.check().jammed, Verdict.YES)


@unittest.skipUnless(PACK, "jam-pack is not built")
class Program(unittest.TestCase):
    def pack(self, *words):
        return subprocess.run([PACK, *map(str, words)], capture_output=True, text=True, timeout=120)

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
            end = jam.System.read(Path(folder) / "end.xyz")
            jam.System.from_arrays(np.round(end.positions, 7), end.diameters, cell=end.cell, overlap="shrink").write(path)
            done = self.pack("check", path)
            self.assertEqual(done.returncode, 3, done.stdout)
            self.assertRegex(done.stdout, r"finds \d+ contacts, jammed")

    def test_every_reason_has_a_word(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "slit.xyz"
            jam.System.from_arrays([[0.6, 0.5], [2.1, 0.5]], 1.0, cell=[3, 1], walls="y").write(str(path))
            self.assertEqual(json.loads(self.pack("check", path, "--json").stdout)["reason"], CheckReason.SLIDE.name.lower())


class Alone(unittest.TestCase):
    """One sphere. A container stops its motions; in a fixed cell without walls it has none but a translation."""

    def one(self, sigma, at=(0.5, 0.5, 0.5), **scene):
        return jam.System.from_arrays([at], sigma, **scene)

    def test_has_a_motion_against_walls_alone(self):
        for scene, axis in (({"walls": "y"}, 1), ({"walls": "xyz"}, 0), ({"container": "ball"}, 0), ({"container": "cylinder"}, 0)):
            s = self.one(0.5, **scene)
            self.assertIn("No pair touches: the smallest gap is 1.00e+00.", str(s.check()))
            for kind in ("collective", "strict"):  # no cell vector lies along a wall
                flex = s.flex(kind)
                np.testing.assert_array_equal(flex.out, [0.5 * np.eye(3)[axis]])
                self.assertFalse(flex.strain.any())
        self.one(0.5).rigidity()
        self.assertIn("no pair touches; one sphere can be crunched only in a free cell without walls", jam.raw.jam_last_error())
        with self.assertRaisesRegex(jam.errors.StateError, "no motion but a translation"):
            self.one(0.5).flex()
        self.assertLess(np.trace(self.one(0.5).flex("strict").strain), 0)

    def test_sentences(self):
        square = self.one(1.0, (0.5, 0.5))
        for s, said, unsaid in (
            (square, "Collectively jammed, but not strictly. 1 sphere in d = 2 at packing fraction 0.785398163. 2 contacts hold 1 sphere.", "excess"),
            (square, "With a cell that changes its shape there is 1 flex.", "excess"),
            (self.one(1.0, walls="xyz"), "6 contacts hold 1 sphere. Forces are not unique: 3 states of self-stress.", "excess"),
            (self.one(0.4, (0.5, 0.2), walls="y"), "1 pair touches, but no non-negative force on it balances, so a motion of the sphere or a strain of the cell opens it.", "them"),
            (self.one(1 - 5e-9, container="ball"), "Not jammed. 1 sphere in d = 3 at packing fraction 0.999999985. No pair touches: the smallest gap is 5.00e-09.", "may touch"),
        ):
            self.assertIn(said, str(s.check()))
            self.assertNotIn(unsaid, str(s.check()))

    def test_that_fills_a_round_wall_is_undecided_for_its_reason(self):
        for scene in ({"container": "ball"}, {"container": "cylinder"}):
            r = self.one(1.0, **scene).check()
            self.assertEqual((r.jammed, r.reason, r.undecided_contacts), (Verdict.UNDECIDED, CheckReason.MARGIN, 0))
            self.assertIn("a sphere is as wide as its tube or ball", str(r))
            self.one(1.0, **scene).rigidity()
            self.assertIn("rounding leaves open which of the closed pairs", jam.raw.jam_last_error())
            for wrong in ("may touch", "A crunch"):  # no pair is in doubt, and a crunch needs two spheres
                self.assertNotIn(wrong, str(r))


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
        """Two spheres of ratio 1.4 in a free cell of d = 4. Where LPs end a hair from contacts of the large one with its
        own images, the crunch decompresses and ends at contacts."""
        for seed in range(1, 31):
            s = jam.System.random(n=2, dim=4, seed=seed, diameters=[1.0, 1.4], packing_fraction=0.05)
            if seed % 2:
                s.compress(growth_rate=0.3, pressure=1e3)
            report = s.crunch(strain="free", wall_time=20.0)
            found = s.rigidity("collective")
            self.assertTrue(np.isfinite(found.rigidity_margin), (seed, found))
            self.assertTrue(report.jammed and found.jammed == Verdict.YES, (seed, report, found))
        s.scale_diameters(1.0 - 1e-8)
        self.assertNotEqual(s.check(crunch=False).jammed, Verdict.YES)
        self.assertTrue(np.isfinite(s.rigidity("collective").rigidity_margin))
