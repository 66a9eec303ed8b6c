"""Results belong to the packing: moves clear them, copies, pickles and files keep them, and statuses say why."""
import ast
import os
import pickle
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import jam
from packings import disks

ROOT = Path(__file__).parents[2]


def loaded(s):
    """The system, its pickle, and the same from an HDF5 file and a checkpoint."""
    with tempfile.TemporaryDirectory() as folder:
        s.save(folder + "/a.h5")
        s.write_checkpoint(folder + "/a.state")
        return [
            pickle.loads(pickle.dumps(s)),
            jam.load(folder + "/a.h5"),
            jam.System.from_checkpoint(folder + "/a.state"),
            s.copy(),
        ]


def stopper(after):
    def stop(p, seen=[0]):
        seen[0] += 1
        if seen[0] > after:
            raise KeyboardInterrupt

    return stop


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.s = disks()
        cls.s.crunch(keep_steps=5)

    def test_a_loaded_packing_has_its_network(self):
        s = self.s
        s.modes(3)
        with tempfile.TemporaryDirectory() as folder:
            s.page(folder + "/a.html")
            s.write(folder + "/a.xyz")
            s.write_contacts(folder + "/a.csv")
            want = [Path(folder, "a" + end).read_bytes() for end in (".html", ".xyz", ".csv")]
            for t in loaded(s):
                self.assertEqual(repr(t.report), repr(s.report))
                np.testing.assert_array_equal(t.contacts.table(), s.contacts.table())
                np.testing.assert_array_equal(t.history["gain"], s.history["gain"])
                np.testing.assert_array_equal(t.modes(3).values, s.modes(3).values)
                np.testing.assert_array_equal(t.gaps(0.1, 1).gap, s.gaps(0.1, 1).gap)
                both = t.compare(s).comparison
                self.assertEqual((both.overlap, both.contacts_a), (1.0, s.report.contacts))
                t.page(folder + "/b.html"), t.write(folder + "/b.xyz"), t.write_contacts(folder + "/b.csv")
                got = [Path(folder, "b" + end).read_bytes() for end in (".html", ".xyz", ".csv")]
                self.assertEqual(got, want)
                t.contacts_from_geometry()
                self.assertEqual(len(t.history), len(s.history))  # of the crunch that led here

    def test_soft_packings_too(self):
        s = jam.System.random(50, 2, 1, packing_fraction=0.95, overlap="allow")
        s.decompress(crunch=0)
        for t in loaded(s):
            np.testing.assert_array_equal(t.soft_history["energy"], s.soft_history["energy"])
            a, b = t.hessian("soft", prestress=1), s.hessian("soft", prestress=1)
            self.assertEqual(abs(a - b).max(), 0)

    def test_moves_that_are_interrupted_leave_no_old_results(self):
        moves = {
            "monte_carlo": lambda t: t.monte_carlo(
                alpha=2.0, energy_scale=100.0, temperature=0.1, sweeps=10**8, progress=stopper(3)
            ),
            "run": lambda t: t.run(1e9, progress=stopper(1)),
            "call": lambda t: t.call("run", collisions_per_particle=1e9, progress=stopper(1)),
            "strain": lambda t: (t.scale_diameters(0.9), t.call("strain", np.zeros(4))),
        }
        for t0 in loaded(self.s):
            for name, move in moves.items():
                t = t0.copy()
                try:
                    move(t)
                except KeyboardInterrupt:
                    pass
                for what in ("report", "contacts", "history", "forces", "coordination"):
                    with self.assertRaises(jam.errors.StateError, msg=f"{what} after {name}"):
                        getattr(t, what)

    def test_a_crunch_by_call_gives_its_own_results(self):
        s = disks()
        s.crunch(duality_gap=1e-2)
        for t in loaded(s):
            t.call("crunch")
            c = t.contacts
            r = t.positions[c.pairs[:, 0]] - t.positions[c.pairs[:, 1]]
            r -= np.rint(r)
            gaps = np.linalg.norm(r, axis=1) / (0.5 * t.diameters[c.pairs].sum(1)) - 1
            self.assertLess(abs(gaps).max(), 1e-9)


class Statuses(unittest.TestCase):
    def test_tensors_of_a_network_without_contacts_are_nan(self):
        s = disks()
        self.assertEqual(s.contacts_from_geometry().contacts, 0)
        for tensor in (s.stress, s.fabric_tensor):
            self.assertEqual((tensor().shape, np.isnan(tensor()).all()), ((2, 2), True))
            self.assertEqual(s.status, jam.StatusCode.NOT_JAMMED)

    def test_reports_carry_status_and_text(self):
        s = disks()
        fluid = s.rigidity()
        self.assertEqual(fluid.status, jam.StatusCode.NOT_JAMMED)
        self.assertIn("not collectively jammed", fluid.status_text)
        self.assertIn("flex()", fluid.status_text)  # the Python name
        self.assertIn(fluid.status_text, repr(fluid))
        found = s.contacts_from_geometry(tolerance=1e-8)
        self.assertEqual(found.status, jam.StatusCode.NOT_JAMMED)
        self.assertEqual((s.status, s.status_text), (found.status, found.status_text))
        self.assertEqual(s.report.status, found.status)
        early = s.crunch(max_lps=1, method="sequential_lp")
        self.assertIn("max_lps", early.status_text)
        self.assertEqual(s.report.status, jam.StatusCode.LIMIT)
        done = s.crunch()
        self.assertEqual((done.status, done.status_text, s.status_text), (0, "", ""))

    def test_enums_print_as_words(self):
        r = jam.System.random(20, 2, 1).crunch()
        self.assertEqual((str(r.method), f"{r.stop_reason}", f"{r.method:>13}"), ("barrier_path", "converged", " barrier_path"))
        self.assertEqual((r.method, f"{r.stop_reason:d}", int(r.method)), (0, str(int(r.stop_reason)), 0))

    def test_properties_leave_the_status(self):
        s = disks()
        s.crunch(max_lps=1, method="sequential_lp")
        s.contacts, s.history, s.forces, s.rattlers, s.report, s.info
        self.assertEqual(s.status, jam.StatusCode.LIMIT)
        with tempfile.TemporaryDirectory() as folder:
            r = disks().crunch(max_lps=1, method="sequential_lp", checkpoint=folder + "/c")
            self.assertEqual(r.status, jam.StatusCode.LIMIT)

    def test_the_log_has_the_text(self):
        s, lines = disks(), []
        s.log(lambda level, line: lines.append(line), "warning")
        s.rigidity()
        self.assertTrue(any("not collectively jammed" in line for line in lines))

    def test_a_campaign_that_stops_early_goes_on(self):
        base = jam.System.random(n=50, dim=3, seed=1)
        options = dict(runs=6, part=2, block=2, keep=[0])
        with tempfile.TemporaryDirectory() as folder:
            file = folder + "/runs.npz"
            for k in range(50):  # longer each time: a busy machine may need seconds for one block
                runs = jam.near_jamming.campaign(base, file, [20, 50], wall_time=0.01 * 1.2**k, **options)
                if runs.runs == 6:
                    break
            whole = jam.near_jamming.campaign(base, folder + "/whole.npz", [20, 50], **options)
        self.assertEqual(runs.runs, 6)
        np.testing.assert_array_equal(runs.kept[0], whole.kept[0])

    def test_sentences_of_runs_say_how_they_go_on(self):
        s = jam.System.random(n=60, dim=3, seed=1)
        first = s.isoconf([50], runs=100000, wall_time=0.3, density_ratio=0.9)
        self.assertEqual((first.status, s.status), (jam.StatusCode.LIMIT,) * 2)
        self.assertIn("resume = 1 continues", s.status_text)
        self.assertIn("starts again", s.status_text)
        again = s.isoconf([50], runs=100000, wall_time=0.3, density_ratio=0.9, resume=1)
        self.assertGreater(again.runs, first.runs)
        s.monte_carlo(sweeps=10**7, wall_time=0.2)
        self.assertIn("resume = 1 continues", s.status_text)

    def test_a_flex_of_spheres_that_touch_nothing_moves(self):
        for n, d in ((60, 3), (5, 2)):
            for kind in ("collective", "strict"):
                s = jam.System.random(n=n, dim=d, seed=1)
                out, strain = s.flex(kind)
                self.assertGreater(np.abs(out - out.mean(0)).max(), 0.1 * s.diameters.mean())
                x = s.positions + 1e-3 * out
                jam.System.from_arrays(x, s.diameters)  # refused if a pair overlaps

    def test_runs_have_the_shapes_of_the_header(self):
        s = jam.System.random(n=20, dim=3, seed=1)
        runs = s.isoconf([1, 2], runs=3, density_ratio=0.9, keep=[1])
        np.testing.assert_array_equal(s.isoconf_kept(1), runs.kept[1])
        self.assertEqual(s.isoconf_kept(1).shape, (3, 20, 3))
        sums, distances = s.isoconf_displacements(-1), s.isoconf_distances(-1)
        self.assertEqual([x.shape for x in sums + distances], [(2, 20, 3), (2, 20, 3), (2, 20), (2, 20)])
        self.assertEqual(list(s.isoconf_series(-1).runs), [3, 3])
        np.testing.assert_allclose(sums.square.sum(-1), distances.distance2, rtol=1e-14)
        np.testing.assert_array_equal(sums.displacement[1], runs.kept[1].sum(0))


class Names(unittest.TestCase):
    def test_names_that_are_not_utf8(self):
        for name in (b"./no\xff\xfe.xyz", "./no\udcff.xyz"):
            with self.assertRaisesRegex(jam.errors.IoError, r"\\xff"):
                jam.System.read(name)
        with self.assertRaises(jam.errors.IoError):
            jam.System.from_checkpoint("./no\udcff")
        for n in range(150, 420):
            with self.assertRaises(jam.errors.IoError):  # the text is cut amid a letter
                jam.System.read("/nonexistent/" + "é" * n)
        with tempfile.TemporaryDirectory() as folder:
            s, path = disks(), os.fsencode(folder) + b"/a\xff.xyz"
            s.write(path)
            np.testing.assert_array_equal(jam.System.read(path).positions, s.positions)
            s.page(os.fsencode(folder) + b"/p\xff.html")

    def test_seeds_of_64_bits_on_the_page(self):
        seed = 2**53 + 1
        s = jam.System.random(n=8, dim=2, seed=seed)
        with tempfile.TemporaryDirectory() as folder:
            s.page(folder + "/p.html")
            self.assertIn(f'"seed": "{seed}"', Path(folder, "p.html").read_text())


class Package(unittest.TestCase):
    def test_metadata_name_the_python_that_the_sources_need(self):
        self.assertIn('requires-python = ">=3.10"', (ROOT / "bindings/python/pyproject.toml").read_text())
        self.assertIn("Requires-Python: >=3.10", (ROOT / "bindings/python/METADATA.in").read_text())
        for file in (ROOT / "bindings/python").rglob("*.py"):
            ast.parse(file.read_text(), feature_version=(3, 10))

    def test_without_docstrings(self):
        code = "import jam; print(int(jam.System.random(n=8, dim=2).run(1).status))"
        done = subprocess.run([sys.executable, "-OO", "-c", code], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (0, "0\n"), done.stderr)

    def test_pair_correlation_has_its_distances(self):
        r = jam.System.distances(2.0, 40)
        self.assertEqual((len(r), r[0], r[-1]), (40, 0.025, 1.975))
        g = jam.System.random(n=64, dim=3, seed=1).pair_correlation(2.0, 40)
        np.testing.assert_array_equal(g.r, r)
        for made in (np.asarray(g), g + 1.0, g == 0.0, np.sqrt(g)):  # as programs for 1.0 take it
            self.assertIs(type(made), np.ndarray)
        self.assertNotIsInstance(g.max(), np.ndarray)
