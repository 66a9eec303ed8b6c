"""Meshes of spheres that overlap or nearly touch, walls as meshes, and contacts by distance."""
import itertools
import json
import math
import os
import subprocess
import unittest
from pathlib import Path

import jam
from packings import InFolder
import numpy as np
from test_overlapping_solid import soft
from test_pore_space import open_edges, triangles, volume

PACK = os.environ.get("JAM_PACK")


def turned(n, seed):
    """Unit vectors."""
    v = np.random.default_rng(seed).normal(size=(n, 3))
    return v / np.linalg.norm(v, axis=1)[:, None]


class Folder(InFolder):
    def mesh(self, s, **options):
        path = self.folder / "m.stl"
        report = s.write_stl(str(path), **options)
        corners = triangles(path)
        self.assertEqual(open_edges(corners), 0)
        about = s.write_stl(None, **options)
        self.assertEqual(report.triangles, len(corners))
        # points that give way to two circles at once count twice in the estimate
        self.assertLess(abs(about.triangles / report.triangles - 1), 0.35)
        return report, corners


class Overlaps(Folder):
    def test_two_spheres_enclose_their_union(self):
        for r, q, d in ((0.25, 0.25, 0.2 * 2), (0.25, 0.25, 0.3), (0.25, 0.15, 0.3), (0.25, 0.25, 0.4999), (0.2, 0.2, 0.4 - 1e-7)):
            for n in turned(3, 1):
                s = soft([[0.5, 0.5, 0.5] - 0.5 * d * n, [0.5, 0.5, 0.5] + 0.5 * d * n], [r, q])
                exact = s.solid_profile(0, 1).solid[0]
                lost = []
                for edge in (0.4, 0.2, 0.1):
                    report, corners = self.mesh(s, edge=edge)
                    self.assertAlmostEqual(report.solid, exact, 12)
                    self.assertAlmostEqual(report.volume, volume(corners), 6)
                    lost.append(1 - report.volume / exact)
                self.assertTrue(lost[0] > lost[1] > lost[2] > 0, lost)
                self.assertLess(lost[2], 0.3 * 0.1**2)

    def test_soft_packings(self):
        """Chains of overlapping pairs and cut images; slightly soft packings in full."""
        for seed in (1, 2):
            s = jam.System.random(n=40, seed=seed, packing_fraction=0.66, overlap="allow")
            s.relax()
            report, _ = self.mesh(s, edge=0.15)
            self.assertAlmostEqual(report.solid, s.solid_profile(2, 1).solid[0], 11)
            self.assertTrue(0 < 1 - report.volume / report.solid < 0.012)

    def test_shrinking_parts_or_keeps_overlaps(self):
        s = soft([[0.3, 0.5, 0.5], [0.7, 0.5, 0.5]], [0.25, 0.25])
        for factor in (0.9, 0.7):
            report, _ = self.mesh(s, contacts="shrunk", factor=factor)
            shrunk = soft(s.positions, [0.25 * factor] * 2)
            self.assertAlmostEqual(report.solid, shrunk.solid_profile(0, 1).solid[0], 12)

    def test_non_additive_contacts(self):
        s = jam.System.random(n=24, seed=1, diameters=[1.0, 1.3] * 12, non_additivity=0.1)
        s.compress(growth_rate=1e-2, pressure=1e4)
        s.crunch()
        self.assertAlmostEqual(self.mesh(s)[0].solid, s.solid_profile(0, 1).solid[0], 11)

    def test_what_would_cut_itself_is_refused(self):
        three = [[0.5 + 0.15 * math.cos(t), 0.5 + 0.15 * math.sin(t), 0.5] for t in (0, 2.1, 4.2)]
        for x, r, text in (
            (three, [0.2] * 3, "spheres 0, 1 and 2 overlap at one place"),
            ([[0.5, 0.5, 0.5], [0.55, 0.5, 0.5]], [0.3, 0.1], "sphere 1 inside sphere 0"),
            ([[0.5, 0.5, 0.5], [0.78, 0.5, 0.5]], [0.3, 0.1], "spheres 0 and 1 overlap so far"),
        ):
            with self.assertRaisesRegex(jam.errors.UnsupportedError, text):
                soft(x, r).write_stl(str(self.folder / "none.stl"))
            self.assertFalse((self.folder / "none.stl").exists())


class Bridges(Folder):
    def test_pairs_within_a_gap(self):
        """A bed of given porosity, which has no contact that balances."""
        s = jam.System.random(n=200, seed=3)
        s.compress(packing_fraction=0.55)
        for gap in (0.001, 0.01, 0.03):
            pairs = int(s.near_coordination(gap).sum()) // 2
            self.assertGreater(pairs, 0)
            report, _ = self.mesh(s, contacts="bridged", bridge=0.1, bridge_gap=gap)
            self.assertEqual(report.bridges, pairs)
            self.assertGreater(report.solid, s.packing_fraction)
            self.assertTrue(0 < 1 - report.volume / report.solid < 0.02)
        none = self.mesh(s, contacts="bridged", bridge_gap=1e-12)[0]
        self.assertEqual((none.bridges, none.status.name), (0, "NOT_JAMMED"))
        self.assertIn("within a gap of 1e-12", str(none))
        with self.assertRaisesRegex(jam.errors.ArgumentError, "bridge_gap is 2"):
            s.write_stl(None, bridge_gap=2.0)

    def test_overlapping_pairs_are_joined_by_their_circle(self):
        s = soft([[0.3, 0.5, 0.5], [0.7, 0.5, 0.5]], [0.25, 0.25])
        for bridge, count in ((0.1, 0), (0.45, 0)):  # a circle of 0.6 radii is wider than both
            report, _ = self.mesh(s, contacts="bridged", bridge=bridge, bridge_gap=0.01)
            self.assertEqual(report.bridges, count)
        slightly = soft([[0.3, 0.5, 0.5], [0.7, 0.5, 0.5]], [0.2005, 0.2005])
        report, _ = self.mesh(slightly, contacts="bridged", bridge=0.3, bridge_gap=0.01)
        self.assertEqual(report.bridges, 1)
        # both caps and the cylinder between them, by Archimedes
        r, b = 0.2005, 0.3 * 0.2005
        h = math.sqrt(r * r - b * b)
        cap = math.pi * (r - h) ** 2 * (2 * r + h) / 3
        self.assertAlmostEqual(report.solid, 2 * (4 / 3 * math.pi * r**3 - cap) + math.pi * b * b * (0.4 - 2 * h), 12)


class Walls(Folder):
    def test_walls_alone(self):
        cases = (
            ({"container": "cylinder", "walls": "z", "cell": [1, 1, 2]}, 2 * math.pi / 4, True),
            ({"container": "ball"}, math.pi / 6, True),
            ({"walls": "xyz", "cell": [1, 2, 1.5]}, 3.0, True),
            ({"container": "cylinder", "cell": [1, 1, 2]}, None, False),
            ({"walls": "z"}, None, False),
        )
        for options, exact, closed in cases:
            s = jam.System.random(30, packing_fraction=0.1, seed=1, **options)
            path = self.folder / "w.stl"
            report = s.write_stl(str(path), walls="walls")
            corners = triangles(path)
            self.assertEqual((report.triangles, report.bridges), (len(corners), 0))
            self.assertEqual(open_edges(corners) == 0, closed)
            if closed:
                self.assertAlmostEqual(report.solid, exact, 12)
                self.assertAlmostEqual(report.volume, volume(corners), 5)
                self.assertTrue(0 <= report.volume / exact - 1 < 0.01 or exact == 3.0)
            else:
                self.assertTrue(math.isnan(report.volume) and math.isnan(report.solid))
            # no centre of a sphere is nearer to a triangle's plane than its radius
            a, b, c = corners.astype(float).transpose(1, 0, 2)
            normal = np.cross(b - a, c - a)
            normal /= np.linalg.norm(normal, axis=1)[:, None]
            depth = ((a[:, None] - s.positions) * normal[:, None]).sum(-1)  # outwards: positive inside
            self.assertTrue((depth > s.radii - 1e-5).all())

    def test_with_the_spheres(self):
        s = jam.System.random(30, packing_fraction=0.1, seed=1, container="ball")
        alone, walls = self.mesh(s)[0], s.write_stl(None, walls="walls").triangles
        both, corners = self.mesh(s, walls="and_walls")
        self.assertEqual(both.triangles, alone.triangles + walls)
        self.assertEqual((both.volume, both.solid), (alone.volume, alone.solid))
        with self.assertRaisesRegex(jam.errors.ArgumentError, "no walls"):
            jam.System.random(30, packing_fraction=0.1).write_stl(None, walls="walls")


class ByDistance(Folder):
    """A bed at rest: overlaps and gaps as friction and weight leave them, so that no forces along normals balance."""

    def bed(self, dim=3, side=1.2, **options):
        """Spheres of one size, or of two in a plane or within a round wall."""
        if dim == 2 or "container" in options:
            options["diameters"] = [1.0, 1.3] * 40
        s = jam.System.random(80, dim, 5, packing_fraction=0.2, cell=[1, 1, side][:dim], **options)
        s.compress(packing_fraction=0.5 if "diameters" in options else 0.6)
        x = s.positions + np.random.default_rng(1).normal(scale=2e-3, size=s.positions.shape)
        options.pop("diameters", None)
        return jam.System.from_arrays(np.clip(x, 0.02, np.diag(s.cell) - 0.02), s.diameters, cell=s.cell, overlap="allow", **options)

    def expected(self, s, gap, flat, round_axes):
        x, found = s.positions, []
        steps = [(0,) if axis in flat or c < round_axes else (-1, 0, 1) for c, axis in enumerate("xyz"[: s.dim])]
        for shift in np.array(list(itertools.product(*steps))) @ s.cell:
            h = np.linalg.norm(x[:, None] - x - shift, axis=-1) / (s.radii[:, None] + s.radii) - 1
            found += [(a, b) for a, b in np.argwhere(h < gap).tolist() if a < b]
        away = [far for c, axis in enumerate("xyz") if axis in flat for far in (x[:, c], s.cell[c, c] - x[:, c])]
        if round_axes:
            away.append(0.5 - np.linalg.norm(x[:, :round_axes] - 0.5, axis=1))
        return sorted(found + [(a, -1 - w) for w, far in enumerate(away) for a in np.flatnonzero(far / s.radii - 1 < gap).tolist()])

    def test_all_pairs_and_walls_within_the_gap(self):
        round_wall = {"container": "cylinder"}
        for dim, options, flat, round_axes in (
            (3, {}, "", 0), (3, {"walls": "z"}, "z", 0), (3, {"walls": "xyz"}, "xyz", 0), (2, {}, "", 0), (3, round_wall, "", 2),
            (3, {**round_wall, "walls": "z"}, "z", 2), (3, {"container": "ball", "side": 1}, "", 3), (2, {"container": "ball"}, "", 2),
        ):
            s = self.bed(dim, **options)
            for gap in (1e-9, 0.01, 0.05):
                s.contacts_by_distance(gap)
                c = s.contacts
                self.assertEqual(sorted(map(tuple, c.pairs.tolist())), self.expected(s, gap, flat, round_axes), (dim, options))
                self.assertEqual(s.info.contact_gap, gap)
                self.assertTrue(np.isnan(c.forces).all() and (c.gaps < gap).all())
                np.testing.assert_array_equal(s.coordination, np.bincount(c.pairs[c.pairs >= 0], minlength=80))
            np.testing.assert_allclose(s.fabric_tensor(), c.vectors.T @ c.vectors / len(c), atol=1e-14)
        alone = jam.System.from_arrays([[0.5, 0.5]], 0.95, cell=[1, 3])  # touches its own image along the short side
        alone.contacts_by_distance(0.1)
        self.assertEqual(alone.contacts.pairs.tolist(), [[0, 0]])

    def test_no_balance_is_claimed(self):
        s = self.bed(walls="z")
        s.contacts_by_distance(0.01)
        with self.assertRaisesRegex(jam.errors.StateError, "no report|within a gap of 0.01"):
            s.report
        for call in (lambda: s.hessian(), lambda: s.stress_states(), lambda: s.modes(3)):
            with self.assertRaisesRegex(jam.errors.StateError, "within a gap of 0.01"):
                call()
        before = s.rigidity().jammed
        s.contacts_from_geometry()
        self.assertTrue(math.isnan(s.info.contact_gap))
        self.assertEqual(s.rigidity().jammed, before)
        for gap in (0.0, 1.5, math.nan):
            with self.assertRaisesRegex(jam.errors.ArgumentError, "gap is"):
                s.contacts_by_distance(gap)

    def test_the_advice_helps(self):
        s = self.bed()
        found = s.contacts_from_geometry()
        self.assertEqual(found.contacts, 0)
        self.assertIn("contacts_by_distance", str(found))
        self.assertGreater(s.contacts_from_geometry(tolerance=0.02).pairs_within, 0)  # the user's own choice
        s.contacts_by_distance(0.02)
        self.assertGreater(len(s.contacts), 0)

    def test_files_say_so(self):
        s = self.bed(walls="z")
        s.contacts_by_distance(0.02)
        csv, dump, vtp, page = (str(self.folder / n) for n in ("c.csv", "c.dump", "c.vtp", "p.html"))
        for path in (csv, dump, vtp):
            s.write_contacts(path)
        self.assertEqual(Path(csv).read_text().splitlines()[0], "i,j,n1,n2,n3,gap")
        self.assertEqual(len(Path(csv).read_text().splitlines()), 1 + len(s.contacts))
        self.assertIn("ITEM: ENTRIES i j nx ny nz gap\n", Path(dump).read_text())
        self.assertNotIn(b'"force"', Path(vtp).read_bytes())
        s.page(page)
        text = Path(page).read_text()
        self.assertIn("Contacts by distance: all pairs with gaps below 0.02", text)
        self.assertNotIn('"report": {', text)

    def test_copies_and_files_keep_them(self):
        s = self.bed(walls="z")
        for gap in (0.02, 1e-12):
            s.contacts_by_distance(gap)
            path = str(self.folder / "b.h5")
            s.write_checkpoint(str(self.folder / "b.chk"))
            made = [s.copy(), jam.System.from_checkpoint(str(self.folder / "b.chk"))]
            try:
                s.save(path)
                made.append(jam.load(path))
            except ImportError:
                pass
            for other in made:
                self.assertEqual(other.info.contact_gap, gap)
                np.testing.assert_array_equal(other.contacts.pairs, s.contacts.pairs)

    def test_a_page_without_contacts_shows_no_report(self):
        s = self.bed()
        s.contacts_from_geometry()
        s.page(str(self.folder / "p.html"))
        text = (self.folder / "p.html").read_text()
        self.assertIn("No contacts found", text)
        self.assertNotIn('"report": {', text)
        self.assertNotIn('"contacts": {', text)

    @unittest.skipUnless(PACK, "jam-pack is not built")
    def test_the_program(self):
        s = self.bed(walls="z")
        xyz, csv, stl, walls, page, table = (str(self.folder / n) for n in ("b.xyz", "c.csv", "b.stl", "w.stl", "p.html", "s.csv"))
        s.write(xyz)

        def run(*words):
            done = subprocess.run([PACK, *words], capture_output=True, text=True, timeout=120)
            self.assertEqual(done.returncode, 0, done.stderr)
            return done

        done = run("export", xyz, "--contacts", csv, "--structure", table, "--contact-gap", "0.02", "--stl-walls", walls, "--json")
        s.contacts_by_distance(0.02)
        answer = json.loads(done.stdout)
        self.assertEqual((answer["contacts"], answer["contact_gap"]), (len(s.contacts), 0.02))
        self.assertEqual(len(Path(csv).read_text().splitlines()), 1 + len(s.contacts))
        self.assertEqual(Path(table).read_text().splitlines()[1].split(",")[2], "")
        self.assertEqual(len(triangles(walls)), 4)
        self.assertIn("--contact-gap", run("page", xyz, page).stderr)
        open_bed = str(self.folder / "open.xyz")
        hard = jam.System.random(n=200, seed=3)
        hard.compress(packing_fraction=0.55)
        hard.write(open_bed)
        run("export", open_bed, "--stl", stl, "--stl-bridge", "0.1", "--stl-bridge-gap", "0.01")
