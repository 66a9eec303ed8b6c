"""Files and the command line: what is written can be read back by other means."""
import csv
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import jam
from packings import InFolder

PACK = os.environ.get("JAM_PACK")  # the program in C


def crunched():
    s = jam.System.random(n=60, dim=2, seed=3, diameters=[1.0, 1.4] * 30, box=2.0)
    s.crunch()
    return s


class Files(InFolder):
    def setUp(self):
        super().setUp()
        self.s = crunched()

    def test_csv(self):
        jam.files.write_csv(self.s, self.folder / "s.csv")
        jam.files.write_contacts_csv(self.s, self.folder / "c.csv")
        rows = list(csv.DictReader((self.folder / "s.csv").read_text().splitlines()))
        self.assertEqual([float(r["x"]) for r in rows], list(self.s.positions[:, 0]))
        rows = list(csv.DictReader((self.folder / "c.csv").read_text().splitlines()))
        self.assertEqual(list(rows[0]), ["i", "j", "n1", "n2", "gap", "force"])
        for name in rows[0]:
            self.assertEqual([float(r[name]) for r in rows], list(self.s.contacts.table()[name]), name)

    def test_tables_have_the_numbers_of_the_calls(self):
        """Those of --gaps, --structure and --spectrum too, whose code this is."""
        modes, made = self.s.modes(which="all"), {}
        for name, write, what in (
            ("gaps", jam.files.write_gaps_csv, self.s), ("structure", jam.files.write_structure_csv, self.s), ("spectrum", jam.files.write_spectrum_csv, modes),
        ):
            write(what, self.folder / "t.csv")
            made[name] = np.genfromtxt(self.folder / "t.csv", delimiter=",", names=True, dtype=None, encoding="ascii")
        gaps, alone = self.s.gaps(1.0, False), self.s.coordination == 0
        np.testing.assert_array_equal(made["gaps"]["gap"], gaps.gap)
        np.testing.assert_array_equal(np.column_stack([made["gaps"]["i"], made["gaps"]["j"]]), gaps.pair)
        np.testing.assert_array_equal(made["gaps"]["stable"] == 0, alone[gaps.pair].any(1))
        self.assertTrue(alone.any())
        sums, contacts = np.zeros((60, 2)), self.s.contacts
        for k, sign in ((0, 1), (1, -1)):
            np.add.at(sums, contacts.pairs[:, k], sign * contacts.vectors)
        table = made["structure"]
        np.testing.assert_allclose(np.column_stack([table["c1"], table["c2"]]), sums, atol=1e-12)
        np.testing.assert_allclose(table["s"], 0.5 * ((sums**2).sum(1) - table["z"]), atol=1e-12)
        np.testing.assert_array_equal(table["z"], self.s.coordination)
        np.testing.assert_array_equal(table["class"] == "rattler", self.s.rattlers)
        np.testing.assert_array_equal(table["class"] == "buckler", self.s.bucklers)
        np.testing.assert_array_equal(made["spectrum"]["lambda"], modes.values)
        np.testing.assert_allclose(made["spectrum"]["omega"] ** 2, modes.values, atol=1e-12)
        self.assertAlmostEqual(modes.values.sum(), 2 * len(contacts), 8)  # each contact adds 1 to each of its spheres

    def test_pages_refuse_complex_modes(self):
        with self.assertRaisesRegex(TypeError, "modes: .*complex"):
            self.s.page(self.folder / "p.html", modes=self.s.bloch_modes((0.25, 0)))
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_halves_of_bonds_meet(self):
        """Where the two spheres touch: in the middle for equal ones, also of a mixture that is not additive."""
        mixture = jam.System.random(n=64, dim=2, diameters=[1.0, 1.4] * 32, seed=1, non_additivity=0.2)
        mixture.compress(growth_rate=0.1, pressure=1e3)
        mixture.crunch()
        for s in (self.s, mixture):
            ends, index = jam.files.half_bonds(s)
            first, second = ends.reshape(2, -1, 2, 2)
            apart = (first[:, 1] - second[:, 1]) / s.box
            self.assertLess(np.abs(apart - np.round(apart)).max(), 1e-9)
            np.testing.assert_array_equal(index, np.tile(np.arange(len(s.contacts)), 2))

    def test_densities_that_are_lost_are_noted(self):
        """libjam has equal masses, or masses as the volumes."""
        path = self.folder / "a.data"
        self.s.write(path)
        self.assertNotIn("densities", jam.System.read(path).notes)
        head, rows = path.read_text().split("Atoms # sphere\n\n")
        words = rows.split(" ", 4)
        path.write_text(f"{head}Atoms # sphere\n\n{' '.join([*words[:3], '2.5', words[4]])}")
        self.assertIn("the densities of the atoms were not read: masses are equal", jam.System.read(path).notes)

    def test_nothing_is_left_when_writing_fails(self):
        before = sorted(os.listdir(self.folder))
        with self.assertRaises(jam.errors.StateError):
            jam.files.write_contacts_csv(jam.System.random(n=10), self.folder / "never.csv")
        with self.assertRaises(jam.errors.UnsupportedError):
            jam.files.write_vtk(jam.System.random(n=10, dim=4, packing_fraction=0.05), self.folder / "never.vtp")
        for name in ("/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"):  # the shell may append to what it has opened
            with self.assertRaisesRegex(OSError, "open descriptor"):
                jam.files.write_csv(self.s, name)
        self.assertEqual(sorted(os.listdir(self.folder)), before)


class CommandLine(unittest.TestCase):
    def run_jam(self, *arguments):
        return subprocess.run([sys.executable, "-m", "jam", *arguments], capture_output=True, text=True, timeout=120)

    def test_from_a_file_to_everything(self):
        with tempfile.TemporaryDirectory() as folder:
            f = lambda name: str(Path(folder) / name)  # noqa: E731
            crunched().write(f("in.xyz"))
            written = ("--contacts", f("c.csv"), "--gaps", f("g.csv"), "--output", f("out.dat"), "--plot", f("p.png"), "--vtk", f("v"))
            done = self.run_jam("--input", f("in.xyz"), "--report", "-", *written, "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
            report = json.loads(done.stdout)
            self.assertTrue(report["jammed"])
            self.assertEqual(report["excess_contacts"], 0)
            s = jam.System.read(f("in.xyz"))
            s.crunch()
            for name, write in (("c.csv", jam.files.write_contacts_csv), ("g.csv", jam.files.write_gaps_csv)):
                write(s, f("mine.csv"))
                self.assertEqual(Path(f(name)).read_text(), Path(f("mine.csv")).read_text())
            self.assertGreater(os.path.getsize(f("p.png")), 10000)
            self.assertTrue(os.path.exists(f("v.vtp")) and os.path.exists(f("v-forces.vtp")))
            self.assertAlmostEqual(jam.System.read(f("out.dat")).packing_fraction, report["packing_fraction"], 14)
            for verb, made in (("page", "a.html"), ("export", "a.data")):
                done = self.run_jam(verb, f("out.dat"), f(made), "--plot", f(f"{verb}.svg"))
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertGreater(os.path.getsize(f(f"{verb}.svg")), 10000)

    @unittest.skipUnless(PACK, "jam-pack is not built")
    def test_same_options_and_same_files_as_jam_pack(self):
        said = subprocess.run([PACK, "--help"], capture_output=True, text=True, check=True).stdout
        theirs, ours = (set(re.findall(r"(?<![\w-])--[a-z][\w-]*", text)) for text in (said, self.run_jam("--help").stdout))
        self.assertEqual(theirs, ours - {"--plot"})
        refused = subprocess.run([PACK, "--plot", "p.png"], capture_output=True, text=True)
        self.assertEqual((refused.returncode, "is one of python3 -m jam" in refused.stderr), (2, True))
        tables = ("contacts.csv", "gaps", "structure", "spectrum", "output.xyz")
        for arguments in (
            "--n 80 --dim 2 --diameters-ratio 1.4 --growth 0.1:50 --nve 2",
            "--n 64 --no-md --modes 0 --seed 5",
            "--n 64 --dim 2 --diameters-ratio 1.4 --no-md --method sequential-lp --strain free",
        ):
            with tempfile.TemporaryDirectory() as folder:
                for name, program in (("a", [PACK]), ("b", [sys.executable, "-m", "jam"])):
                    asked = [x for t in tables for x in ("--" + t.split(".")[0], f"{folder}/{name}.{t}")]
                    words = [*arguments.split(), *asked, "--report", f"{folder}/{name}.json", "--quiet"]
                    done = subprocess.run([*program, *words], capture_output=True, text=True, timeout=120)
                    self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
                a, b = (json.loads(Path(folder, name + ".json").read_text()) for name in "ab")
                self.assertEqual(list(a), list(b))
                for key in set(a) - {"seconds_md", "seconds_crunch", "collisions_per_second", "options"}:
                    self.assertEqual(a[key], b[key], key)
                for t in tables:
                    self.assertEqual(Path(folder, "a." + t).read_text(), Path(folder, "b." + t).read_text(), t)

    def test_exit_status(self):
        """Those of jam-pack, whose code runs: jam_pack.py tries each reason."""
        for status, words in (
            (0, "--n 10 --no-md --no-crunch"),
            (2, "--growth 0.1:"),
            (3, "--input /does/not/exist"),
            (4, "--n 10 --output /does/not/exist/p.xyz"),
        ):
            done = self.run_jam(*words.split())
            self.assertEqual((done.returncode, bool(done.stdout), bool(done.stderr)), (status, status == 0, status > 0))
        self.assertEqual(self.run_jam("--output", "x", "--plot", "x").returncode, 2)  # which is Python's own


class TiltedDump(unittest.TestCase):
    def test_bounds_hold_the_cell(self):
        """LAMMPS names the smallest brick around a tilted cell, and behind its bounds xy, xz and yz."""
        cell = np.array([[1.0, 0, 0], [-0.2, 0.9, 0], [-0.3, 0.1, 1.1]])
        s = jam.System.random(40, 3, 1, packing_fraction=0.2, cell=cell)
        s.crunch()
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "f.dump"
            s.write_contacts(path)
            lines = path.read_text().splitlines()
        self.assertEqual(lines[4], "ITEM: BOX BOUNDS xy xz yz pp pp pp")
        rows = np.array([[float(x) for x in line.split()] for line in lines[5:8]])
        a, b, c = s.cell
        corners = np.array([i * a + j * b + k * c for i in (0, 1) for j in (0, 1) for k in (0, 1)])
        np.testing.assert_allclose(rows[:, 0], corners.min(axis=0), atol=1e-15)
        np.testing.assert_allclose(rows[:, 1], corners.max(axis=0), atol=1e-15)
        np.testing.assert_array_equal(rows[:, 2], [b[0], c[0], c[1]])
