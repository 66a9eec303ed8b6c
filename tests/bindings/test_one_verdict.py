"""Two answers to one question: rigidity and check of a packing, of it with and without its network, of strict and collective
jamming; motions of packings that are not jammed.
"""
import itertools
import unittest

import numpy as np

import jam
from jam import Verdict
from packings import cubic, fcc, state, triangular

EDGE = np.pi  # numbers with all digits


def disks(seed, n=40, ratio=1.4, pressure=1e3):
    s = jam.System.random(n, 2, seed, diameters=[1.0] * (n // 2) + [ratio] * (n - n // 2))
    s.compress([(1e-2, min(pressure, 500.0)), (3e-3, pressure)] if pressure > 500 else [(1e-2, pressure)])
    return s


def moved(x, cell, noise, seed, **more):
    """Spheres of size 1, or as near to it as they fit."""
    y = (x + noise * np.random.default_rng(seed).standard_normal(x.shape)) @ np.linalg.inv(cell)
    return jam.System.from_arrays(np.mod(y, 1) @ cell, more.pop("sizes", 1.0), cell=cell, overlap="shrink", **more)


def with_vacancies(make, seed, noise):
    x, cell = make
    rng = np.random.default_rng(seed)
    drop = rng.choice(len(x), rng.integers(1, len(x) // 9 + 1), replace=False)
    return moved(np.delete(x, drop, 0), cell, noise, seed)


def holes(m, gap, open_by):
    """Square lattice with a small disk in each hole: rows slide until small disks block them."""
    corners = np.array(list(itertools.product(range(m), repeat=2)), float)
    x = (np.r_[corners, corners + 0.5] + [0.1234567890123, 0.376543210987]) * EDGE / m
    sigma = np.r_[np.full(m * m, 1 - open_by), np.full(m * m, 2**0.5 - 1 - gap)] * EDGE / m * (1 - 2e-16)
    return jam.System.from_arrays(np.mod(x, EDGE), sigma, box=EDGE)


def starts_of_reports():
    for n, seed in ((3, 1), (5, 2), (64, 18), (100, 4), (100, 20)):
        s = jam.System.random(n, 2, seed)
        s.compress([(1e-2, 500.0), (3e-3, 1e7)])
        yield (n, seed), s
    for dim, n, ratio in ((2, 2, 4.0), (3, 2, 2.0), (3, 4, 2.0)):
        s = jam.System.random(n, dim, 1, diameters=[ratio] + [1.0] * (n - 1))
        s.compress([(1e-2, 500.0)])
        yield ("own image", dim, n), s
    for make, drop, noise in itertools.product((triangular(8), fcc(2), cubic(4, 2)), (1, 3, 6), (0, 1e-12, 1e-8, 1e-6)):
        x, cell = make
        x = np.delete(x, np.random.default_rng(1).choice(len(x), drop, replace=False), 0)
        yield (len(x), noise), moved(x, cell, noise, 1)


class OneVerdict(unittest.TestCase):
    def test_eight_disks_of_a_lattice_get_an_answer(self):
        """Newton's steps to exact closure are infinite in one of these, and exact sums of them have no end."""
        x, cell = triangular(2)
        x, cell = np.vstack([x, x + cell[0]]), np.array([2 * cell[0], cell[1]])
        for seed in range(300):
            s = moved(x, cell, 3e-11, seed)
            self.assertEqual(s.rigidity().jammed, s.check(crunch=False).jammed)

    def test_a_translation_is_no_flex(self):
        """Of the last flex of a fcc lattice with vacancies and its opposite, one cancelled the motion that it was added
        to; what was left was a translation."""
        found = 0
        for seed in range(1, 30):
            x, cell = fcc(2)
            rng = np.random.default_rng(seed)
            s = moved(np.delete(x, rng.choice(32, rng.integers(3, 8), replace=False), 0), cell, 0.0, seed)
            for kind in ("collective", "strict"):
                if s.rigidity(kind).jammed == Verdict.NO:
                    flex = s.flex(kind)
                    self.assertGreater(max(np.ptp(flex.out, axis=0).max(), abs(flex.strain).max()), 1e-3, (seed, kind))
                    found += 1
        self.assertGreater(found, 10)

    def same(self, s, *more):
        """Of rigidity and check, both kinds; returns them."""
        check = s.check(crunch=False)
        found = s.rigidity("collective").jammed, s.rigidity("strict").jammed
        self.assertEqual((check.jammed, check.strictly_jammed), found, (more, str(check)))
        if found[1] == Verdict.YES:
            self.assertEqual(found[0], Verdict.YES, (more, str(check)))
        if found[0] == Verdict.NO:
            self.assertEqual(found[1], Verdict.NO, (more, str(check)))
        return found

    def test_of_reports(self):
        """Of a crunch, however it ends, and of contacts from geometry: the judge of rigidity gave it. Crunches without polish
        left soft modes undecided that a proof decides; spheres that touch their own images were not stationary; a
        lattice of few digits was taken for one after it had moved."""
        for tag, s in starts_of_reports():
            for options in ({}, {"polish": False}, {"strain": "free"}, None):
                t = s.copy()
                try:
                    report = t.crunch(**options) if options is not None else t.contacts_from_geometry() and t.report
                except jam.JamError as e:
                    self.assertIn("no pair within", str(e), (tag, options))
                    continue
                found = t.rigidity()
                with self.subTest(tag=tag, options=options):
                    self.assertEqual(report.jammed, found.jammed == Verdict.YES)
                    self.assertEqual(report.stationary, found.stationary == Verdict.YES)
                    self.assertEqual((report.flexes, report.undecided_contacts), (found.flexes, found.undecided_contacts))
                    if report.jammed and options and "strain" in options:
                        self.assertEqual(report.strictly_jammed, t.rigidity("strict").jammed)

    def test_of_packings_that_are_a_little_open(self):
        decided = 0
        for seed in range(1, 7):
            s = disks(seed)
            s.crunch()
            x, sizes, cell = state(s)
            for noise in (1e-12, 1e-10, 1e-8, 1e-7):
                t = moved(x, cell, noise, seed, sizes=sizes)
                found = self.same(t, seed, noise)
                self.assertEqual(found[0] == Verdict.YES, noise < 1e-11)
                t.contacts_from_geometry()
                self.assertEqual(self.same(t, seed, noise), found)
            for smaller in (1e-11, 1e-9, 3e-8):
                fewer = sizes.copy()
                fewer[::10] *= 1 - smaller
                decided += self.same(jam.System.from_arrays(x, fewer), seed, smaller)[0] != Verdict.UNDECIDED
            for shrunk, right in ((1e-11, Verdict.YES), (1e-9, Verdict.NO), (1e-7, Verdict.NO)):
                self.assertEqual(self.same(jam.System.from_arrays(x, sizes * (1 - shrunk)), seed)[0], right)
        self.assertGreater(decided, 5)

    def test_of_crystals_with_vacancies(self):
        """What is held in every strain is held in the fixed cell, and spheres that move there move without a strain. Two of the first lattices were jammed strictly, and
        undecided or not jammed collectively: a sphere between two contacts that are open by as much as they are not
        quite opposite is no rattler."""
        for make, seeds in ((fcc(3), (0, 1, 2, 45)), (triangular(8), range(8))):
            for seed, noise in itertools.product(seeds, (0, 1e-12, 1e-11, 1e-10, 1e-8, 1e-6)):
                self.same(with_vacancies(make, seed, noise), len(make[0]), seed, noise)

    def test_a_crunch_of_a_saddle_that_cannot_grow_names_its_flexes(self):
        """A triangular lattice of disks without 2 % of them, two side by side. Straight rows of disks cross the box, so that
        diameters cannot grow; the disks at the divacancy can move (docs: 2 flexes)."""
        m = 20
        x = np.array([[i + 0.5 * (j % 2), j * 0.75**0.5] for j in range(m) for i in range(m)])
        kept = np.sort(np.random.default_rng(5).permutation(m * m)[8:])
        s = jam.System.from_arrays(x[kept], 1.0, cell=np.diag([m, m * 0.75**0.5]), overlap="shrink")
        before, found = s.rigidity(), s.copy()
        self.assertEqual((before.jammed, before.flexes), (Verdict.NO, 2))
        r = s.crunch(wall_time=300)
        self.assertEqual((r.stop_reason, r.status), (jam.StopReason.SADDLE, jam.StatusCode.NOT_CONVERGED))
        self.assertEqual((r.flexes, r.contacts, r.stable), (before.flexes, before.contacts, before.stable))
        self.assertIn("2 independent motions keep all contacts closed", r.status_text)
        np.testing.assert_array_equal(s.positions, found.positions)
        self.assertLess(abs(s.packing_fraction / found.packing_fraction - 1), 1e-12)

    def test_a_flex_without_room_shows_nothing(self):
        """A slide by t opens contacts by t^2, which must be more than they are open by rounding, or by what they lack: in a
        cell that deforms, too, and in copies of it."""
        for gap, open_by, wanted in ((1e-6, 0, "no"), (1e-7, 0, "no"), (1e-9, 0, "undecided"), (1e-3, 3e-11, "no"), (1e-7, 3e-11, "undecided")):
            with self.subTest(gap=gap, open_by=open_by):
                self.assertEqual([str(v) for v in self.same(holes(3, gap, open_by))], [wanted] * 2)
                self.assertEqual(str(holes(3, gap, open_by).check().jammed), wanted)
                one = holes(1, gap, open_by)  # its rows slide in copies alone
                self.assertEqual(one.bloch_rigidity((3, 3)).flexes.sum(), 4)
                self.assertEqual(one.status.name, "AMBIGUOUS" if wanted == "undecided" else "NOT_JAMMED")
                self.assertEqual(str(one.tile((3, 3)).rigidity().jammed), wanted)


class Flexes(unittest.TestCase):

    def test_no_pair_that_touches_overlaps_along_them(self):
        """By the squared distance along it: from its gap, a pair loses y t and gains (w t)^2 / 2. Where positions are noisy the
        motion is shorter, and much longer than the gaps of contacts need."""
        found = 0
        for make, seed, noise in itertools.product((fcc(2), triangular(8)), range(8), (0, 1e-14, 1e-12, 1e-11)):
            s = with_vacancies(make, seed, noise)
            if s.rigidity().jammed != Verdict.NO:
                continue
            v = s.flex().out / s.diameters.mean()
            found += 1
            self.assertGreater(abs(v).max(), max(1e-4, 10 * noise**0.5), (seed, noise))
            x, sizes, cell = state(s)
            shifts = np.array(list(itertools.product((-1, 0, 1), repeat=s.dim))) @ cell
            for i in range(s.n):
                r = (x[i] - x[i + 1 :, None] + shifts).reshape(-1, s.dim) / sizes[0]
                w = np.repeat(v[i] - v[i + 1 :], len(shifts), axis=0)
                length = np.linalg.norm(r, axis=1)
                touch = length - 1 < 1e-10
                gap, y = np.maximum(length[touch] - 1, 0), np.sum(w * r, 1)[touch]
                square = np.sum(w * w, 1)[touch] - y**2
                for t in (1e-8, 1e-6, 1e-4, 1e-2, 1.0):
                    self.assertGreater((gap + y * t + 0.5 * square * t**2).min(initial=0.0), -3e-14, (seed, noise, t))
        self.assertGreater(found, 16)
