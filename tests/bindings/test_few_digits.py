"""Verdicts on packings whose coordinates have few digits."""
import tempfile
import unittest

import numpy as np

import jam
from jam import CheckReason, Verdict
from packings import fluid, packing, state


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

    def test_small_spheres_hide_no_digits_of_large_ones(self):
        """Rattlers far smaller than the rest, two that overlap and one beside rounded centres, say nothing of the rest."""
        s = packing(60, 3, 2)
        x, diameters, cell = state(s)
        points = np.random.default_rng(1).random((20000, 3)) @ cell
        r = points[:, None, :] - x
        hole = points[np.linalg.norm(r - np.round(r @ np.linalg.inv(cell)) @ cell, axis=2).min(axis=1).argmax()]
        small = diameters[0] / 25
        for part in (1e-6, 1e-3, 1e-2):
            two = [hole, hole + [small * (1 - part), 0, 0]]
            t = jam.System.from_arrays(np.vstack([x, two]), [*diameters, small, small], cell=cell, overlap="allow")
            r = t.check(crunch=False)
            self.assertEqual((r.jammed, r.reason), (Verdict.UNDECIDED, CheckReason.OVERLAP), r)
            self.assertEqual(t.rigidity().jammed, Verdict.UNDECIDED)
        for part in (1e-2, 1e-3, 1e-4):
            y = np.vstack([np.round(x, 4), hole])
            t = jam.System.from_arrays(y, [*diameters, diameters[0] * part], cell=cell, overlap="allow")
            self.assertEqual(t.check(crunch=False).jammed, Verdict.UNDECIDED)

    def test_overlaps_of_unequal_spheres(self):
        """All diameters shrink by the largest overlap, which opens pairs of large spheres by more than it is long."""
        for ratio in (5, 20):
            s = jam.System.random(dim=2, diameters=[ratio] * 40 + [1.0] * 60, seed=1, packing_fraction=0.95, overlap="allow")
            self.assertGreater(s.relax().contacts, 0)
            r = s.check(crunch=False)
            self.assertEqual((r.jammed, r.reason), (Verdict.UNDECIDED, CheckReason.OVERLAP), r)

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

    def test_step_is_that_of_the_file(self):
        """Decimals of a length in any box; a part of their multiples are multiples of a coarser step along the cell."""
        x, diameters, cell = state(packing(60, 3, 4))
        for box in (7.0, 0.15, 3.0, 2.0, 12.5, 0.3, 30.0, 1.25):
            scale = box / cell[0, 0]
            for step in (1e-4, 1e-5):
                y = np.round(x * scale / step) * step
                t = jam.System.from_arrays(y, diameters * scale, box=box, overlap="shrink")
                self.assertIn(f"multiples of {step:.3g})", str(t.check(crunch=False)), (box, step))

    def test_liquid_stays_no(self):
        s = fluid(100, 3, 1, 0.6)
        for digits in (6, 7, 8, "single"):
            r = self.rounded(s, digits).check()
            self.assertEqual((r.jammed, r.reason), (Verdict.NO, CheckReason.APART), r)

    def test_own_images_that_balance_hold_their_sphere(self):
        """In the fixed cell, in which it has no motion; in all strains, those of some lattices."""
        h = 3**0.5 / 2
        body = np.array([[1, 1, -1], [-1, 1, 1], [1, -1, 1]]) / 3**0.5
        face = np.array([[1, 1, 0], [0, 1, 1], [1, 0, 1]]) / 2**0.5
        lattices = [(np.eye(2), False), (np.eye(3), False), (body, False), (face, True), ([[1, 0], [0.5, h]], True)]
        for cell, strictly in lattices:
            cell = np.array(cell, float)
            s = jam.System.from_arrays(np.zeros((1, len(cell))), 1.0, cell=cell, overlap="shrink")
            r = s.check()
            self.assertEqual((r.jammed, r.reason), (Verdict.YES, CheckReason.PROOF), r)
            self.assertEqual(r.strictly_jammed, Verdict.YES if strictly else Verdict.NO, r)
            self.assertEqual(s.rigidity("collective").jammed, r.jammed)
            self.assertEqual(s.bloch_rigidity([1] * len(cell)).flexes.sum(), 0)
            self.assertEqual(s.rigidity("strict").jammed, r.strictly_jammed)

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
