#!/usr/bin/env python3
"""jam_pack.py PROGRAM: the installed jam-pack as its users meet it, right and wrong."""
import json
import math
import os
import pathlib
import pty
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

program = sys.argv.pop(1)
KEYS = """n dim seed packing_fraction diameter_mean pressure collisions collisions_per_second lp_solves factorisations decompressions contacts
rattlers bucklers isostatic_contacts excess_contacts strictly_jammed max_overlap force_residual gamma_residual min_force min_gap stop_reason seconds_md
seconds_crunch version""".split()


def run(*args, seconds=120):
    return subprocess.run([program, *map(str, args)], capture_output=True, text=True, timeout=seconds, check=False)


def positions(path):
    return [[float(word) for word in line.split()] for line in path.read_text().splitlines()[2:]]


class JamPack(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.dir = pathlib.Path(self.folder.name)

    def tearDown(self):
        left = [p.name for p in self.dir.iterdir() if ".part-" in p.name]
        self.folder.cleanup()
        self.assertEqual(left, [], "temporary files are left")

    def refuse(self, status, text, *args):
        done = run(*args, seconds=20)
        self.assertEqual(done.returncode, status, f"{args}: {done.stderr}")
        self.assertIn(text, done.stderr, str(args))
        self.assertEqual(done.stdout, "", str(args))

    def report(self, *args, status=0):
        done = run(*args, "--report", "-")
        if status is not None:
            self.assertEqual(done.returncode, status, f"{args}: {done.stderr}")
        return json.loads(done.stdout)

    def refused(self, status, *args):
        done = run(*args)
        self.assertEqual(done.returncode, status, f"{args}: {done.stderr}")
        return done.stderr

    def test_copies_of_a_packing(self):
        """Disks with one state of self-stress are jammed in one cell, and not in four."""
        one, four = self.dir / "one.xyz", self.dir / "four.xyz"
        self.report("--n", 12, "--dim", 2, "--seed", 1, "--diameters-ratio", 1.4, "--output", one)
        self.assertEqual([run("check", one, *more).returncode for more in ([], ["--tile", "2,2"], ["--strict"])], [0, 1, 1])
        self.assertEqual((run("export", one, four, "--tile", "2,2").returncode, json.loads(run("info", four, "--json").stdout)["n"]), (0, 48))
        for wrong, why in (("0,2", "whole numbers above 0"), ("2,2,2", "--tile: count has 3 numbers, it must have dim = 2")):
            self.refuse(2, why, "check", one, "--tile", wrong)

    def test_help_and_version(self):
        done = run("--help")
        self.assertEqual(done.returncode, 0)
        self.assertIn("Example: jam-pack", done.stdout)
        self.assertIn("Exit status", done.stdout)
        self.assertTrue(all(len(line) <= 100 for line in done.stdout.splitlines()))
        self.assertRegex(run("--version").stdout, r"^jam-pack \d+\.\d+\.\d+, commit \w+\n$")

    def test_wrong_command_line(self):
        for args, text in [
            (["--colour", "red"], "unknown option '--colour'\n"),
            (["--seeds", "3"], "unknown option '--seeds'; did you mean --seed?"),
            (["--n"], "'--n' lacks its value"),
            (["packing.dat"], "unexpected argument 'packing.dat'"),
            (["--n", "0"], "--n is '0', it must be an integer in 1..2147483647"),
            (["--n", "1e3"], "--n is '1e3'"),
            (["--n="], "--n is ''"),
            (["--dim", "1"], "integer in 2..8"),
            (["--dim", "9"], "integer in 2..8"),
            (["--phi0", "0"], "--phi0"),
            (["--phi0", "0.2x"], "--phi0 is '0.2x'"),
            (["--growth", "0"], "--growth is '0'"),
            (["--growth", "-1e-3"], "--growth"),
            (["--growth", "inf"], "--growth"),
            (["--growth", "1e-2:"], "pressure of --growth"),
            (["--growth", "1e-2:0.5"], "larger than 1"),
            (["--pressure", "1"], "larger than 1"),
            (["--lp", "highs"], "one of: ipm clp"),
            (["--method", "fire"], "must be one of: barrier sequential-lp"),
            (["--quiet=1"], "'--quiet' takes no value"),
            (["--contacts", "x.json"], "use .csv, .dump or .vtp"),
            (["--seed", "99999999999999999999"], "--seed"),
            (["--wall-time", "0"], "--wall-time"),
            (["--diameters-ratio", "0"], "--diameters-ratio"),
            (["--no-md", "--growth", "1e-2"], "--no-md contradicts --growth"),
            (["--no-md", "--nve", "5"], "contradicts --nve"),
            (["--no-crunch", "--contacts", "c.csv"], "--contacts needs the crunch"),
            (["--output", "a", "--report", "a"], "must be different"),
            (["--output", "q.gsd"], "no format is known by this ending"),
            (["--output", "q.xyz.zip"], "use .xyz, .extxyz, .data, .lmp, .vtp, .dat, .txt or none"),
            (["--input", "a", "--report", "a"], "overwrite the input"),
            (["--gaps", "a", "--structure", "a"], "--gaps and --structure must be different"),
            (["--input", "a", "--spectrum", "a"], "--spectrum would overwrite"),
            (["--modes", "5"], "--modes has no effect without --spectrum"),
            (["--no-crunch", "--gaps", "a"], "--gaps needs the crunch"),
            (["--no-crunch", "--spectrum", "a"], "--spectrum needs"),
        ]:
            self.refuse(2, text, *args)

    def test_options_without_effect(self):
        for args, text in [
            (["--input", "a", "--n", "77"], "--n has no effect beside --input"),
            (["--input", "a", "--dim", "2"], "--dim has no effect beside --input"),
            (["--input", "a", "--phi0", "0.3"], "--phi0 has no effect beside --input"),
            (["--input", "a", "--plant", "0.3"], "--plant has no effect beside --input"),
            (["--input", "a", "--sizes", "list:1=0.5,1.4=0.5"], "--sizes has no effect beside --input"),
            (["--input", "a", "--diameters-ratio=1"], "--diameters-ratio has no effect beside --input"),
            (["--input", "a", "--pressure", "1e5"], "--pressure has no effect: no stage of growth runs up to it"),
            (["--growth", "1e-2:500", "--pressure", "1e5"], "--pressure has no effect"),
            (["--no-md", "--pressure", "1e5"], "--pressure has no effect"),
            (["--sizes", "lognormal:deviation=0.3", "--diameters-ratio", "2"], "no effect beside --sizes"),
            (["--plant", "0.3", "--phi0", "0.3"], "--phi0 has no effect beside --plant"),
            (["--model", "euclid", "--zeta", "1"], "--model euclid contradicts --zeta"),
            (["--model", "euclid", "--plant", "0.1"], "--model euclid contradicts --plant"),
            (["--non-additivity", "0.1"], "--non-additivity has no effect without --sizes"),
            (["--shrink"], "--shrink has no effect without --input"),
            (["--frame", "0"], "--frame has no effect without --input"),
            (["--input", "a", "--shrink-min", "0"], "--shrink-min has no effect without --shrink"),
            (["--checkpoint-every", "9"], "--checkpoint-every has no effect without --checkpoint"),
            (["--no-md", "--no-crunch", "--checkpoint", "a"], "--checkpoint has no effect"),
            (["--page-steps", "9"], "--page-steps has no effect without --page"),
            (["--no-crunch", "--threads", "2"], "--threads has no effect beside --no-crunch"),
            (["--no-crunch", "--method", "barrier"], "--method has no effect beside --no-crunch"),
            (["--no-crunch", "--strain", "free"], "--strain has no effect beside --no-crunch"),
            (["--no-crunch", "--lp", "clp"], "--lp has no effect beside --no-crunch"),
            (["--no-crunch", "--duality-gap", "1e-7"], "--duality-gap has no effect beside --no-crunch"),
            (["--output", ""], "--output is '', it must be the name of a file"),
            (["--report="], "--report is '', it must be the name of a file"),
            (["--input", ""], "--input is ''"),
            (["--sizes", ""], "--sizes is ''"),
            (["--output", "./a.xyz", "--page", "a.xyz"], "--output and --page must be different files"),
            (["--resume", "a", "--output", "./a"], "--output would overwrite the input"),
            (["--sizes", "a", "--output", "./a"], "--output would overwrite the input"),
        ]:
            self.refuse(2, text, *args)
        (self.dir / "a.xyz").symlink_to(self.dir / "b.xyz")
        self.refuse(2, "must be different", "--output", self.dir / "b.xyz", "--report", self.dir / "a.xyz")  # no file yet
        (self.dir / "b.xyz").touch()
        self.refuse(2, "must be different", "--output", self.dir / "a.xyz", "--page", self.dir / "b.xyz")

    def test_what_the_file_answers(self):
        file = self.dir / "a.xyz"
        file.write_text('1\nLattice="1 0 0 0 1 0 0 0 1" Properties=pos:R:3:radius:R:1\n.1 .2 .3 .1\n' * 2)
        self.refuse(2, "the option box is 5, but the file has 1", "--input", file, "--box", 5)
        self.refuse(2, "frame is 2, the file has 2", "--input", file, "--frame", 2)
        self.assertEqual(self.report("--input", file, "--frame", 0, "--no-crunch")["notes"], [])
        said = run("--input", file, "--no-crunch").stdout
        self.assertIn("  start     the last of 2 frames was read; frame=0 to 1 read others\n", said)
        run("--n", 8, "--dim", 2, "--no-md", "--no-crunch", "--output", self.dir / "state.xyz")
        kept = self.dir / "state"
        run("--n", 64, "--growth", "1e-2:1e5", "--wall-time", 0.02, "--checkpoint", kept)
        for option, value in (("--n", 65), ("--dim", 2), ("--seed", 2)):
            self.refuse(2, f"{option} is {value}", "--resume", kept, option, value)

    def test_formats_that_cannot_hold_the_packing(self):
        four = self.dir / "four.dat"
        four.write_text("4\n2\n0.2\n0.1 0.2 0.3 0.4\n0.6 0.7 0.8 0.9\n")
        for output in ("a.data", "a.vtp"):
            self.refuse(2, "this packing has d = 4", "--input", four, "--output", self.dir / output)
            self.refuse(2, "this packing has d = 4", "--n", 8, "--dim", 4, "--output", self.dir / output)
        self.refuse(2, "this packing has d = 4", "--input", four, "--contacts", self.dir / "a.dump")
        tilted = self.dir / "t.xyz"
        tilted.write_text('2\nLattice="1 0 0 .3 1 0 0 0 1" Properties=pos:R:3:radius:R:1\n.1 .2 .3 .1\n.6 .7 .8 .1\n')
        self.refuse(2, "plain", "--input", tilted, "--output", self.dir / "a.dat")

    def test_shrinking_is_told(self):
        near, log = self.dir / "near.dat", self.dir / "log"
        near.write_text("2\n2\n0.4\n0.1 0.5\n0.4 0.5\n")
        done = run("--input", near, "--shrink", "--no-crunch", "--log", log)
        self.assertRegex(done.stderr, r"^jam-pack: warning: all diameters were multiplied by 0\.7[45]\d+: spheres 0 and 1 ")
        self.assertIn("  start     warning: all diameters", done.stdout)
        self.assertRegex(log.read_text(), r"^ +0\.\d+ warning all diameters were multiplied by 0\.7")
        near.write_text("2\n2\n0.4\n0.1 0.5\n0.10000001 0.5\n")
        self.refuse(3, "less than shrink_min 0.001", "--input", near, "--shrink", "--no-crunch")
        done = run("--input", near, "--shrink", "--shrink-min", 0, "--no-crunch", "--quiet")
        self.assertEqual((done.returncode, done.stdout), (0, ""))
        self.assertIn("warning: all diameters", done.stderr)

    def test_refused_requests(self):
        self.refuse(3, "ends near 0.384", "--n", 50, "--phi0", 0.9)
        self.refuse(3, "No such file", "--input", self.dir / "none.dat")
        one = ["--n", 1, "--container", "ball"]
        self.refuse(2, "one sphere between walls needs no crunch: leave it out by --no-crunch", *one)
        self.assertEqual(run(*one, "--no-crunch").returncode, 0)  # as advised
        bad = self.dir / "bad.dat"
        bad.write_text("3\n4\n0.1\n0.1 0.2 0.3\n")
        self.refuse(3, "line 5: the file ends after 1 of 4 spheres", "--input", bad)
        bad.write_text("2\n2\n0.4\n0.1 0.5\n0.4 0.5\n")
        self.refuse(3, "spheres 0 and 1 overlap by 0.25 of their contact distance; --shrink multiplies", "--input", bad)
        done = run("--input", bad, "--shrink", "--no-crunch", "--report", "-")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(json.loads(done.stdout)["diameter_mean"], 0.3, 12)

    def test_outputs_are_checked_before_the_work(self):
        large = ["--n", 200000]
        for option in ("--output", "--contacts", "--report", "--spectrum", "--gaps", "--structure", "--page"):
            self.refuse(4, "cannot write", *large, option, self.dir / "no" / "such" / "folder")
            self.refuse(4, "Is a directory", *large, option, self.dir)
        if os.path.exists("/dev/full"):
            for option in ("--output", "--report"):
                done = run("--n", 8, "--no-md", "--no-crunch", option, "/dev/full")
                self.assertEqual(done.returncode, 4)
                self.assertIn("No space left", done.stderr)

    def check_network(self, xyz, csv, report):
        """The files agree with each other: contacts, coordination, distances, forces."""
        rows = positions(xyz)
        dim, box = report["dim"], float(re.search(r'Lattice="(\S+)', xyz.read_text()).group(1))
        lines = csv.read_text().splitlines()
        self.assertEqual(lines[0], "i,j," + ",".join(f"n{c + 1}" for c in range(dim)) + ",gap,force")
        self.assertEqual(len(lines) - 1, report["contacts"])
        self.assertEqual(sum(int(row[-1]) for row in rows), 2 * report["contacts"])
        self.assertEqual(sum(row[-1] == 0 for row in rows), report["rattlers"])
        forces, sums = [], [[0.0] * dim for _ in rows]
        for line in lines[1:]:
            i, j, *rest = line.split(",")
            i, j, normal, gap, force = int(i), int(j), [float(x) for x in rest[:dim]], float(rest[-2]), float(rest[-1])
            sigma = rows[i][-2] + rows[j][-2]
            for c in range(dim):
                off = (rows[i][1 + c] - rows[j][1 + c] - sigma * (1.0 + gap) * normal[c]) / box
                self.assertAlmostEqual(off, round(off), 10)
                sums[i][c] += force * normal[c]
                sums[j][c] -= force * normal[c]
            forces.append(force)
            self.assertGreater(force, 0.0)
        self.assertAlmostEqual(sum(forces) / len(forces), 1.0, 10)
        self.assertLess(max(abs(x) for row in sums for x in row), 1e-8)

    def job(self, *args):
        xyz, csv = self.dir / "p.xyz", self.dir / "c.csv"
        report = self.report(*args, "--output", xyz, "--contacts", csv)
        self.assertEqual([key for key in KEYS if key not in report], [])
        self.assertTrue(report["jammed"], report)
        self.assertEqual(report["stop_reason"], "converged")
        self.assertEqual(report["isostatic_contacts"], report["dim"] * (report["n"] - report["rattlers"] - 1) + 1)
        self.assertEqual(report["excess_contacts"], report["contacts"] - report["isostatic_contacts"])
        self.assertLess(report["force_residual"], 1e-8)
        self.assertLess(report["max_overlap"], 1e-12)
        self.check_network(xyz, csv, report)
        return report, xyz

    def test_from_nothing(self):
        # a spread of sizes, since so few equal spheres like to order
        report, xyz = self.job("--n", 128, "--diameters-ratio", 1.2, "--seed", 1)
        self.assertEqual((report["n"], report["dim"], report["seed"]), (128, 3, 1))
        self.assertTrue(0.60 < report["packing_fraction"] < 0.67, report["packing_fraction"])
        self.assertGreater(report["pressure"], 9e5)
        self.assertGreater(report["collisions"], 0)
        first = xyz.read_bytes()
        self.job("--n", 128, "--diameters-ratio", 1.2, "--seed", 1)
        self.assertEqual(first, xyz.read_bytes(), "the same seed gives other bits")
        again = self.report("--input", xyz)  # a jammed packing crunched again stays
        self.assertEqual(again["collisions"], 0)
        self.assertIsNone(again["pressure"])
        self.assertTrue(again["jammed"])
        self.assertAlmostEqual(again["packing_fraction"], report["packing_fraction"], 10)

    def table(self, path):
        head, *lines = path.read_text().splitlines()
        return [dict(zip(head.split(","), line.split(","))) for line in lines]

    def test_tables_of_the_network(self):
        xyz, gaps, spheres, low, full = (self.dir / name for name in ("p.xyz", "g.csv", "s.csv", "low.csv", "all.csv"))
        contacts = self.dir / "c.csv"
        start = "--n 100 --dim 2 --diameters-ratio 1.4".split()
        tables = ("--contacts", contacts, "--gaps", gaps, "--structure", spheres, "--spectrum", low, "--modes", 7)
        report = self.report(*start, "--output", xyz, *tables)
        rows, rattlers, network = positions(xyz), report["rattlers"], self.table(contacts)
        sums = [[0.0, 0.0] for _ in rows]
        for line in network:
            for end, sign in ((int(line["i"]), 1), (int(line["j"]), -1)):
                for c in range(2):
                    sums[end][c] += sign * float(line[f"n{c + 1}"])
        lines = self.table(spheres)
        self.assertEqual([int(line["z"]) for line in lines], [int(row[-1]) for row in rows])
        self.assertEqual([line["class"] for line in lines].count("rattler"), rattlers)
        self.assertEqual([line["class"] for line in lines].count("buckler"), report["bucklers"])
        for line, total in zip(lines, sums):
            self.assertAlmostEqual(float(line["c1"]), total[0], 10)
            self.assertAlmostEqual(float(line["c2"]), total[1], 10)
            self.assertAlmostEqual(float(line["s"]), 0.5 * (total[0] ** 2 + total[1] ** 2 - int(line["z"])), 10)
            self.assertEqual(line["phi"], "")  # Voronoi cells are there in d = 3 only
        values = self.table(gaps)
        self.assertEqual([float(v["gap"]) for v in values], sorted(float(v["gap"]) for v in values))
        stable = [float(v["gap"]) for v in values if v["stable"] == "1"]
        self.assertAlmostEqual(stable[0], report["min_gap"], 12)
        self.assertEqual(len(stable) == len(values), rattlers == 0)
        self.assertLessEqual(float(values[-1]["gap"]), 1.0)
        for v in values[:20]:
            (i, j) = (rows[int(v["i"])], rows[int(v["j"])])
            off = [(i[1 + c] - j[1 + c] + 0.5) % 1.0 - 0.5 for c in range(2)]
            self.assertAlmostEqual((off[0] ** 2 + off[1] ** 2) ** 0.5 / (i[-2] + j[-2]) - 1.0, float(v["gap"]), 10)
        self.report("--input", xyz, "--spectrum", full, "--modes=0")
        few, every = ([float(v["lambda"]) for v in self.table(path)] for path in (low, full))
        self.assertEqual((len(few), len(every)), (7, 2 * (100 - rattlers)))
        self.assertAlmostEqual(sum(every), 2.0 * report["contacts"], 8)  # each contact adds 1 to each of its spheres
        for x, y in zip(few, every[2:]):  # two translations first
            self.assertAlmostEqual(x, y, 10)
        for v in self.table(low):
            self.assertAlmostEqual(float(v["omega"]) ** 2, float(v["lambda"]), 12)
            self.assertTrue(1.0 / (100 - rattlers) <= float(v["participation"]) <= 1.0)

    def test_local_fractions_in_three_dimensions(self):
        spheres = self.dir / "s.csv"
        self.report("--n", 80, "--diameters-ratio", 1.2, "--structure", spheres)
        filled = [line["phi"] for line in self.table(spheres)]
        if any(filled):  # built with voro++
            self.assertTrue(all(0.3 < float(x) < 1.0 for x in filled))

    def test_two_dimensions_two_sizes(self):
        report, _ = self.job(*"--n 128 --dim 2 --diameters-ratio 1.4 --growth 1e-2:500 --growth 3e-3 --pressure 1e6".split())
        self.assertTrue(0.81 < report["packing_fraction"] < 0.86, report["packing_fraction"])

    def test_simplex_gives_the_same_packing(self):
        start = self.dir / "start.dat"
        self.report("--n", 80, "--diameters-ratio", 1.4, "--no-crunch", "--output", start)  # equal spheres so few order
        ipm = self.report("--input", start)
        clp = self.report("--input", start, "--lp", "clp")
        self.assertAlmostEqual(ipm["packing_fraction"], clp["packing_fraction"], 9)
        self.assertEqual(ipm["contacts"], clp["contacts"])

    def test_dynamics_only(self):
        report = self.report("--n", 200, "--nve", 20, "--growth", "1e-2:100", "--no-crunch")
        self.assertIsNone(report["contacts"])
        self.assertIsNone(report["jammed"])
        self.assertEqual(report["stop_reason"], "pressure")
        self.assertGreater(report["collisions"], 20 * 200 / 2)
        self.assertGreaterEqual(report["pressure"], 100)

    def test_a_stage_that_falls_short_is_seen(self):
        start, out = self.dir / "start.dat", self.dir / "out.dat"
        start.write_text("3\n2\ndiameters\n0.0 0.0 0.0 1.0\n0.5 0.5 0.5 0.01\n")
        stages = ("--growth", "1e-2:50", "--growth", "1e-3:500", "--no-crunch", "--quiet", "--output", out)
        done = run("--input", start, *stages, "--report", "-")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(done.stderr.count("warning: growth"), 2, done.stderr)
        self.assertIn("sphere 0 touches its own image, nothing can grow here", done.stderr)
        report = json.loads(done.stdout)
        self.assertEqual([s["stop_reason"] for s in report["protocol"]], ["stalled", "stalled"])
        self.assertTrue(out.exists())

    def test_mari_kurchan(self):
        report = self.report("--n", 200, "--plant", 1.5, "--growth", "1e-2:1e5")
        self.assertTrue(report["jammed"])
        self.assertEqual(report["contacts"], report["isostatic_contacts"])
        self.assertTrue(1.8 < report["packing_fraction"] < 3.5, report["packing_fraction"])
        one = self.report(
            "--n", 100, "--model", "mk", "--zeta", 0, "--no-md", "--no-crunch", "--output", self.dir / "a.dat"
        )
        two = self.report("--n", 100, "--no-md", "--no-crunch", "--output", self.dir / "b.dat")
        self.assertEqual(one["packing_fraction"], two["packing_fraction"])
        self.assertEqual(
            (self.dir / "a.dat").read_bytes(), (self.dir / "b.dat").read_bytes()
        )  # no shift: the same start
        self.refused(2, "--model", "potts")
        self.refused(2, "--plant", "x")

    def test_diameters(self):
        job = ["--no-md", "--no-crunch", "--output", self.dir / "p.xyz"]
        self.report("--n", 3000, "--sizes", "lognormal:deviation=0.3", "--phi0", 0.05, *job)
        d = [2 * float(line.split()[4]) for line in (self.dir / "p.xyz").read_text().splitlines()[2:]]
        mean = sum(d) / len(d)
        width = (sum((x - mean) ** 2 for x in d) / len(d)) ** 0.5 / mean
        self.assertAlmostEqual(width, 0.3, delta=0.02)  # its standard error is 0.006
        self.report("--n", 100, "--sizes", "list:1=0.5,1.4=0.5", *job)
        d = sorted(float(line.split()[4]) for line in (self.dir / "p.xyz").read_text().splitlines()[2:])
        self.assertAlmostEqual(d[99] / d[0], 1.4, 12)
        self.assertEqual(sum(x > d[0] * 1.1 for x in d), 50)
        sizes = self.dir / "sizes.txt"
        sizes.write_text("# mine\n1\n2\n3.5\n1\n")
        self.assertEqual(self.report("--sizes", sizes, *job)["n"], 4)
        d = [float(line.split()[4]) for line in (self.dir / "p.xyz").read_text().splitlines()[2:]]
        self.assertAlmostEqual(d[2] / d[0], 3.5, 12)
        self.refused(3, "--n", 5, "--sizes", sizes, *job)
        sizes.write_text("1\n2\n-3\n")
        self.assertIn("line 3", self.refused(3, "--sizes", sizes, *job))
        self.refused(2, "--sizes", "lognormal:-1")
        self.refused(3, "--sizes", self.dir / "none.txt")

    def test_a_given_density_is_exact_and_the_number_follows(self):
        curve = self.dir / "curve.csv"
        curve.write_text("size passing\n1 0\n2 60\n4 100\n")
        job = ["--sizes", f"sieve:{curve}", "--porosity", 0.45, "--cell", "10,10,20", "--output", self.dir / "p.xyz"]
        made = self.report(*job)
        self.assertLess(abs(made["packing_fraction"] - 0.55), 1e-12)
        self.assertEqual(made["protocol"][-1]["stop_reason"], "packing_fraction")
        d = [2 * float(line.split()[4]) for line in (self.dir / "p.xyz").read_text().splitlines()[2:]]
        self.assertEqual(len(d), made["n"])
        self.assertLess(abs(math.pi / 6 * sum(x**3 for x in d) / 2000 - 0.55), 1e-12)
        self.assertTrue(1 - 1e-9 < min(d) and max(d) < 4 + 1e-9)
        self.assertIn("Lattice=\"10 0 0 0 10 0 0 0 20\"", (self.dir / "p.xyz").read_text())
        self.assertLess(abs(self.report("--n", 100, "--packing-fraction", 0.5)["packing_fraction"] - 0.5), 1e-12)
        self.assertLess(abs(self.report("--n", 50, "--packing-fraction", 0.1)["packing_fraction"] - 0.1), 1e-12)
        short = self.refused(1, "--n", 100, "--packing-fraction", 0.63, "--pressure", 20, "--quiet")
        self.assertIn("before the packing fraction 0.63", short)
        above = self.refused(1, "--input", self.dir / "p.xyz", "--porosity", 0.5, "--quiet")
        self.assertIn("the packing fraction is 0.55, above the 0.5 to grow to: nothing was done", above)
        self.refuse(3, "jam near 0.643", "--n", 1000, "--packing-fraction", 0.7)
        self.refuse(3, "jam near", *job[:3], 0.2, *job[4:6])
        curve.write_text("1 0\n2 60\n3 50\n4 100\n")
        self.refuse(3, "row 2 (3, 50): the sieve curve falls", *job[:6])
        curve.write_text("1 0\n2 x\n")
        self.refuse(3, "line 2", *job[:6])
        for args, text in (
            (["--porosity", "1.2"], "above 0 and below 1"),
            (["--porosity", "0.4", "--packing-fraction", "0.6"], "no effect beside"),
            (["--porosity", "0.4", "--lp", "clp"], "--lp has no effect beside --porosity"),
            (["--porosity", "0.4", "--contacts", "a"], "the crunch, which --porosity omits"),
            (["--porosity", "0.4", "--no-md"], "beside --no-md"),
            (["--porosity", "0.8", "--phi0", "0.3"], "lies above"),
            (["--cell", "1,2"], "--cell has 2 numbers"),
            (["--cell", "1,x"], "--cell is '1,x'"),
            (["--cell", "1,2,3", "--box", "2"], "no effect beside --box"),
            (["--sizes", "gauss:mean=1"], "no law of sizes"),
        ):
            self.refuse(2, text, *args)

    def test_checkpoint_and_resume(self):
        job = ["--n", 1000, "--growth", "1e-2:500", "--growth", "3e-3:1e5", "--no-crunch"]
        self.report(*job, "--output", self.dir / "whole.dat")
        kept = self.dir / "state.bin"
        job += ["--checkpoint", kept, "--output", self.dir / "part.dat"]
        first = self.report(*job, "--wall-time", 0.25, status=1)
        self.assertEqual(first["stop_reason"], "wall_time")
        rounds = 0
        while True:
            report = self.report(*job, "--resume", kept, "--wall-time", 0.6, status=None)
            rounds += 1
            if report["stop_reason"] == "pressure" and report["pressure"] > 9e4 or rounds > 100:
                break
        self.assertGreater(rounds, 1)
        self.assertEqual((self.dir / "whole.dat").read_bytes(), (self.dir / "part.dat").read_bytes())
        self.refused(3, "--resume", self.dir / "none.bin")
        self.refused(2, "--resume", kept, "--input", self.dir / "part.dat")

    def test_start_only(self):
        report = self.report("--n", 50, "--phi0", 0.1, "--no-md", "--no-crunch", "--output", self.dir / "p.dat")
        self.assertAlmostEqual(report["packing_fraction"], 0.1, 12)
        self.assertEqual((self.dir / "p.dat").read_text().splitlines()[:2], ["3", "50"])

    def test_wall_time(self):
        report = self.report(
            "--n", 4000, "--growth", "1e-5", "--wall-time", 1, "--output", self.dir / "p.dat", status=1
        )
        self.assertEqual(report["stop_reason"], "wall_time")
        self.report("--input", self.dir / "p.dat", "--no-crunch")
        report = self.report("--n", 1024, "--no-md", "--wall-time", 0.5, status=1)
        self.assertEqual(report["stop_reason"], "wall_time")

    def test_checkpoints_without_a_pause_between_do_not_stop_dynamics(self):
        kept, rare = self.dir / "state.bin", self.report("--n", "8", "--quiet")
        often = self.report("--n", "8", "--quiet", "--checkpoint", kept, "--checkpoint-every", "1e-9")
        self.assertEqual(often["packing_fraction"], rare["packing_fraction"])

    def test_a_killed_crunch_goes_on(self):
        """Killed at random moments: the checkpoint is whole each time, and what follows it ends jammed."""
        kept, job = self.dir / "state.bin", ["--n", "500", "--growth", "1e-2:500", "--quiet"]
        self.report(*job, "--no-crunch", "--checkpoint", kept)
        start, moments, changed = kept.read_bytes(), random.Random(1), 0
        whole = self.report(*job, "--resume", kept)
        for _ in range(12):
            before = kept.read_bytes()
            often = ["--resume", kept, "--checkpoint", kept, "--checkpoint-every", "0.01"]
            with subprocess.Popen([program, *job, *map(str, often)]) as process:
                time.sleep(moments.uniform(0.05, 1.0))
                process.kill()
            self.assertEqual(self.report("--resume", kept, "--no-crunch", "--no-md")["n"], 500)
            changed += kept.read_bytes() != before
        self.assertGreater(changed, 0)
        self.assertNotEqual(kept.read_bytes(), start)
        last = self.report(*job, "--resume", kept)
        self.assertTrue(last["jammed"])
        self.assertLess(last["force_residual"], 1e-10)
        self.assertEqual(last["collisions"], 0)  # dynamics are not made again
        self.assertGreater(last["packing_fraction"], 0.99 * whole["packing_fraction"])
        for part in self.dir.glob("*.part-*"):  # of a kill amid a write, which left the checkpoint as it was
            part.unlink()

    def test_ctrl_c_keeps_the_state(self):
        out = self.dir / "p.xyz"
        with subprocess.Popen(
            [program, "--n", "4000", "--growth", "1e-5", "--output", str(out), "--report", "-"],
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        ) as process:
            time.sleep(1.5)
            process.send_signal(signal.SIGINT)
            stdout, stderr = process.communicate(timeout=30)
        self.assertEqual(process.returncode, 1, stderr)
        self.assertIn("interrupted", stderr)
        self.assertEqual(json.loads(stdout)["stop_reason"], "cancelled")
        self.assertEqual(self.report("--input", out, "--no-crunch")["n"], 4000)

    def test_progress_is_redrawn_on_terminals_alone(self):
        args = ["--n", "256", "--no-crunch", "--growth", "1e-3:1000"]
        self.assertNotRegex(run(*args).stderr, r"[\r\x1b]")  # whole lines, each ten seconds: none on a fast machine
        pid, terminal = pty.fork()
        if pid == 0:
            os.execv(program, [program, *args])
        shown = b""
        while True:
            try:
                part = os.read(terminal, 4096)
            except OSError:
                break
            if not part:
                break
            shown += part
        os.waitpid(pid, 0)
        os.close(terminal)
        self.assertIn(b"\r\x1b[Kgrowth 0.001  p ", shown)
        self.assertIn(b"256 spheres in d = 3", shown)

    def test_quiet(self):
        done = run("--n", 64, "--quiet")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))


unittest.main()
