"""Files and the command line: what is written can be read back by other means."""
import csv
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np

import jam

PACK = os.environ.get("JAM_PACK")  # the program in C


def crunched(dim=2):
    s = jam.System.random(
        n=60 if dim == 2 else 80, dim=dim, seed=3, diameters=[1.0, 1.4] * (30 if dim == 2 else 40), box=2.0
    )
    s.crunch()
    return s


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = Path(cls.folder.name)
        cls.s = crunched()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_plain_and_xyz_give_the_same_bits(self):
        for name in ("a.dat", "a.xyz"):
            self.s.write(self.path / name)
            back = jam.System.read(self.path / name)
            np.testing.assert_array_equal(back.positions, self.s.positions)
            np.testing.assert_array_equal(back.diameters, self.s.diameters)
            self.assertEqual(back.box, 2.0)

    def arrays(self, path):
        head, binary = Path(path).read_bytes().split(b'<AppendedData encoding="raw">\n_')
        piece = ElementTree.fromstring(head + b"</VTKFile>").find("PolyData/Piece")
        found = {}
        for a in piece.iter("DataArray"):
            start = int(a.get("offset"))
            size = int(np.frombuffer(binary, "<u8", 1, start)[0])
            kind = {"Float64": "<f8", "Int64": "<i8"}[a.get("type")]
            values = np.frombuffer(binary[start + 8 : start + 8 + size], kind)
            found[a.get("Name")] = values.reshape(-1, int(a.get("NumberOfComponents")))
        return piece, found

    def test_densities_of_lammps_atoms_are_noted(self):
        """libjam has equal masses, or masses as the volumes: densities that differ are lost, and the note says so."""
        self.s.write(self.path / "a.data")
        self.assertNotIn("densities", jam.System.read(self.path / "a.data").notes)
        text = (self.path / "a.data").read_text()
        head, rows = text.split("Atoms # sphere\n\n")
        first, rest = rows.split("\n", 1)
        words = first.split()
        words[3] = "2.5"
        (self.path / "a.data").write_text(head + "Atoms # sphere\n\n" + " ".join(words) + "\n" + rest)
        self.assertIn("the densities of the atoms were not read: masses are equal", jam.System.read(self.path / "a.data").notes)

    def test_vtk_spheres(self):
        for s in (self.s, crunched(3)):
            jam.files.write_vtk(s, self.path / "s.vtp")
            piece, a = self.arrays(self.path / "s.vtp")
            self.assertEqual(int(piece.get("NumberOfPoints")), s.n)
            np.testing.assert_array_equal(a["Points"][:, : s.dim], s.positions)
            np.testing.assert_array_equal(a["diameter"][:, 0], s.diameters)
            np.testing.assert_array_equal(a["contacts"][:, 0], s.coordination)
            self.assertEqual((a["kind"] == 0).sum(), s.report.rattlers)
            np.testing.assert_array_equal(a["offsets"][:, 0], np.arange(1, s.n + 1))

    def test_vtk_network(self):
        jam.files.write_vtk_network(self.s, self.path / "n.vtp")
        piece, a = self.arrays(self.path / "n.vtp")
        m = self.s.report.contacts
        self.assertEqual(int(piece.get("NumberOfLines")), 2 * m)
        self.assertEqual(len(a["Points"]), 4 * m)
        self.assertAlmostEqual(a["gap"].max(), self.s.contacts.gaps.max())
        length = np.linalg.norm(a["Points"][0::2] - a["Points"][1::2], axis=1)
        s, c = self.s.diameters, self.s.contacts
        np.testing.assert_allclose(2 * length[:m], 0.5 * (s[c.pairs[:, 0]] + s[c.pairs[:, 1]]), rtol=1e-9)

    def test_csv(self):
        jam.files.write_csv(self.s, self.path / "s.csv")
        jam.files.write_contacts_csv(self.s, self.path / "c.csv")
        rows = list(csv.DictReader((self.path / "s.csv").read_text().splitlines()))
        self.assertEqual([float(r["x"]) for r in rows], list(self.s.positions[:, 0]))
        rows = list(csv.DictReader((self.path / "c.csv").read_text().splitlines()))
        self.assertEqual(list(rows[0]), ["i", "j", "n1", "n2", "gap", "force"])
        self.assertEqual([float(r["force"]) for r in rows], list(self.s.forces))

    def test_nothing_is_left_when_writing_fails(self):
        before = sorted(os.listdir(self.path))
        with self.assertRaises(jam.errors.StateError):
            jam.files.write_contacts_csv(jam.System.random(n=10), self.path / "never.csv")
        with self.assertRaises(jam.errors.UnsupportedError):
            jam.files.write_vtk(jam.System.random(n=10, dim=4, packing_fraction=0.05), self.path / "never.vtp")
        for name in ("/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"):  # the shell may append to what it has opened
            with self.assertRaisesRegex(OSError, "open descriptor"):
                jam.files.write_csv(self.s, name)
        self.assertEqual(sorted(os.listdir(self.path)), before)


class CommandLine(unittest.TestCase):
    def run_jam(self, *arguments):
        return subprocess.run([sys.executable, "-m", "jam", *arguments], capture_output=True, text=True, timeout=120)

    def test_from_a_file_to_everything(self):
        with tempfile.TemporaryDirectory() as folder:
            f = lambda name: str(Path(folder) / name)  # noqa: E731
            crunched().write(f("in.xyz"))
            written = ("--contacts", f("c.csv"), "--output", f("out.dat"), "--plot", f("p.png"), "--vtk", f("v"))
            done = self.run_jam("--input", f("in.xyz"), "--report", "-", *written, "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
            report = json.loads(done.stdout)
            self.assertTrue(report["jammed"])
            self.assertEqual(report["excess_contacts"], 0)
            self.assertEqual(len(Path(f("c.csv")).read_text().splitlines()), report["contacts"] + 1)
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
            "--n 64 --dim 2 --sizes lognormal:deviation=0.3 --growth 0.1:30",
            "--n 64 --dim 2 --diameters-ratio 1.4 --no-md --method sequential-lp --strain free",
            "--n 64 --plant 0.5 --zeta 3 --growth 0.1:30",
            "--n 128 --seed 3 --growth 1e-2:1e4 --duality-gap 1e-7",
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

    @unittest.skipUnless(PACK, "jam-pack is not built")
    def test_both_programs_grow_to_one_density(self):
        job = "--sizes lognormal:deviation=0.2,share=volume --porosity 0.5 --cell 5,5,6 --quiet"
        skew = "--sizes uniform:low=0.8,high=1.2,draw=random --porosity 0.6 --cell 5,0,0,1,6,0,1,1,5 --seed 3 --quiet"
        with tempfile.TemporaryDirectory() as folder:
            for words in (job, skew):
                for program, name in ([PACK], "a"), ([sys.executable, "-m", "jam"], "b"):
                    out = ["--output", f"{folder}/{name}.xyz"]
                    subprocess.run([*program, *words.split(), *out], check=True, timeout=120)
                self.assertEqual(*(Path(folder, name + ".xyz").read_text() for name in "ab"))

    @unittest.skipUnless(PACK, "jam-pack is not built")
    def test_either_program_resumes_what_the_other_began(self):
        programs = ([PACK], [sys.executable, "-m", "jam"])
        with tempfile.TemporaryDirectory() as folder:
            sizes = Path(folder, "sizes")
            sizes.write_text("1\n1.5\n2\n" * 20)
            common = ["--quiet", "--no-crunch", "--growth", "0.1:30", "--growth", "0.1:300"]

            def run(program, name, *more):
                files = ["--checkpoint", f"{folder}/{name}.state", "--output", f"{folder}/{name}.dat"]
                done = subprocess.run([*program, *common, *more, *files], capture_output=True, text=True, timeout=120)
                self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
                return Path(folder, name + ".dat").read_text()

            begin = ["--dim", "2", "--sizes", str(sizes), "--seed", "4"]
            whole = run(programs[0], "whole", *begin)
            for first, second in (programs, programs[::-1]):
                s = jam.System.random(60, 2, 4, diameters=[1.0, 1.5, 2.0] * 20)
                s.compress(growth_rate=0.1, pressure=30, collisions_per_particle=5)  # cut off amid the first stage
                self.assertEqual(s.info.paused, jam.Phase.COMPRESS)
                s.write_checkpoint(f"{folder}/cut.state")
                self.assertEqual(run(first, "a", "--resume", f"{folder}/cut.state"), whole)
                self.assertEqual(run(second, "b", "--resume", f"{folder}/a.state"), whole)  # nothing is left to do
            self.assertEqual(run(programs[1], "c", *begin), whole)

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
