#!/usr/bin/env python3
"""jam_pack.py PROGRAM: the installed jam-pack as its users meet it, right and wrong."""
import json
import math
import os
import pty
import signal
import subprocess
import time
import unittest

from jam_pack_case import InFolder, program, run

KEYS = """n dim seed packing_fraction diameter_mean pressure collisions collisions_per_second lp_solves factorisations decompressions contacts
rattlers bucklers isostatic_contacts excess_contacts strictly_jammed max_overlap force_residual gamma_residual min_force min_gap stop_reason seconds_md
seconds_crunch version""".split()


class JamPack(InFolder):
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
            (["--growth", "0"], "--growth is '0'"),
            (["--growth", "1e-2:"], "pressure of --growth"),
            (["--growth", "1e-2:0.5"], "larger than 1"),
            (["--lp", "highs"], "one of: ipm clp"),
            (["--quiet=1"], "'--quiet' takes no value"),
            (["--contacts", "x.json"], "use .csv, .dump or .vtp"),
            (["--no-md", "--growth", "1e-2"], "--no-md contradicts --growth"),
            (["--no-md", "--nve", "5"], "contradicts --nve"),
            (["--no-crunch", "--contacts", "c.csv"], "--contacts needs the crunch"),
            (["--output", "a", "--report", "a"], "must be different"),
            (["--output", "q.gsd"], "no format is known by this ending"),
            (["--output", "q.xyz.zip"], "use .xyz, .extxyz, .data, .lmp, .vtp, .dat, .txt or none"),
            (["--input", "a", "--report", "a"], "overwrite the input"),
            (["--gaps", "a", "--structure", "a"], "--gaps and --structure must be different"),
            (["--input", "a", "--spectrum", "a"], "--spectrum would overwrite"),
            (["--no-crunch", "--gaps", "a"], "--gaps needs the crunch"),
            (["--no-crunch", "--spectrum", "a"], "--spectrum needs"),
        ]:
            self.refuse(2, text, *args)

    def test_options_without_effect(self):
        """What no table says: test_command_line tries each option beside those that the table of options names."""
        for args, text in [
            (["--input", "a", "--pressure", "1e5"], "--pressure has no effect: no stage of growth runs up to it"),
            (["--growth", "1e-2:500", "--pressure", "1e5"], "--pressure has no effect"),
            (["--no-md", "--pressure", "1e5"], "--pressure has no effect"),
            (["--model", "euclid", "--zeta", "1"], "--model euclid contradicts --zeta"),
            (["--model", "euclid", "--plant", "0.1"], "--model euclid contradicts --plant"),
            (["--no-md", "--no-crunch", "--checkpoint", "a"], "--checkpoint has no effect"),
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
        self.refuse(2, "plain text stores no walls", "--n", 200000, "--walls", "z", "--output", self.dir / "a.dat")

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
        self.refuse(4, "cannot write", *large, "--spectrum", self.dir / "no" / "such" / "folder")
        self.refuse(4, "Is a directory", *large, "--output", self.dir)
        if os.path.exists("/dev/full"):
            for option in ("--output", "--report"):
                done = run("--n", 8, "--no-md", "--no-crunch", option, "/dev/full")
                self.assertEqual(done.returncode, 4)
                self.assertIn("No space left", done.stderr)

    def test_from_nothing(self):
        # a spread of sizes, since so few equal spheres like to order
        xyz = self.dir / "p.xyz"
        job = ("--n", 128, "--diameters-ratio", 1.2, "--seed", 1, "--output", xyz)
        report = self.report(*job)
        self.assertEqual([key for key in KEYS if key not in report], [])
        self.assertEqual((report["jammed"], report["stop_reason"]), (True, "converged"))
        self.assertEqual(report["isostatic_contacts"], report["dim"] * (report["n"] - report["rattlers"] - 1) + 1)
        self.assertEqual(report["excess_contacts"], report["contacts"] - report["isostatic_contacts"])
        self.assertLess(report["force_residual"], 1e-8)
        self.assertLess(report["max_overlap"], 1e-12)
        self.assertEqual((report["n"], report["dim"], report["seed"]), (128, 3, 1))
        self.assertTrue(0.60 < report["packing_fraction"] < 0.67, report["packing_fraction"])
        self.assertGreater(report["pressure"], 9e5)
        self.assertGreater(report["collisions"], 0)
        first = xyz.read_bytes()
        self.report(*job)
        self.assertEqual(first, xyz.read_bytes(), "the same seed gives other bits")
        again = self.report("--input", xyz)  # a jammed packing crunched again stays
        self.assertEqual(again["collisions"], 0)
        self.assertIsNone(again["pressure"])
        self.assertTrue(again["jammed"])
        self.assertAlmostEqual(again["packing_fraction"], report["packing_fraction"], 10)

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
        self.refuse(2, "--model", "--model", "potts")
        starts = []
        for words in ((), ("--model", "mk", "--zeta", 0), ("--model", "mk", "--zeta", 1)):
            self.report("--n", 20, "--no-md", "--no-crunch", "--output", self.dir / "start.dat", *words)
            starts.append((self.dir / "start.dat").read_bytes())
        self.assertEqual([start == starts[0] for start in starts[1:]], [True, False])  # shifts of size 0 are none

    def test_dynamics_at_constant_volume(self):
        start = self.dir / "start.dat"
        before = self.report("--n", 64, "--phi0", 0.3, "--no-md", "--no-crunch", "--output", start)
        after = self.report("--input", start, "--nve", 20, "--no-crunch")
        self.assertEqual((after["packing_fraction"], after["jammed"]), (before["packing_fraction"], None))
        self.assertEqual(after["protocol"], [{"stage": "nve", "collisions_per_particle": 20}])
        self.assertAlmostEqual(after["collisions"], 20 * 64 / 2, delta=1)

    def test_the_simplex_gives_the_same_packing(self):
        start = self.dir / "start.dat"
        self.report("--n", 40, "--diameters-ratio", 1.4, "--no-crunch", "--output", start)
        ipm = self.report("--input", start)
        told = run("--input", start, "--lp", "clp", "--report", "-")
        if "Clp" in told.stderr:
            self.skipTest("built without Clp")
        clp = json.loads(told.stdout)
        self.assertEqual((ipm["lp_solver"], clp["lp_solver"]), ("ipm", "clp"))
        self.assertAlmostEqual(ipm["packing_fraction"], clp["packing_fraction"], 9)
        self.assertEqual(ipm["contacts"], clp["contacts"])

    def test_diameters(self):
        job = ["--no-md", "--no-crunch", "--output", self.dir / "p.xyz"]
        sizes = self.dir / "sizes.txt"
        sizes.write_text("# mine\n1\n2\n3.5\n1\n")
        self.assertEqual(self.report("--sizes", sizes, *job)["n"], 4)
        d = [float(line.split()[4]) for line in (self.dir / "p.xyz").read_text().splitlines()[2:]]
        self.assertAlmostEqual(d[2] / d[0], 3.5, 12)
        self.refused(3, "--n", 5, "--sizes", sizes, *job)
        sizes.write_text("1\n2\n-3\n")
        self.refuse(3, "line 3", "--sizes", sizes, *job)
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
        whole = self.report("--sizes", "equal:mean=1.4", "--packing-fraction", 0.3, "--cell", "5,4,4", "--walls", "xyz")
        self.assertEqual((whole["n"], whole["diameter_mean"]), (17, whole["diameter_mean_given"]))
        self.assertAlmostEqual(whole["packing_fraction"], 17 * math.pi / 6 * 1.4**3 / 80, 12)
        self.assertIn("17 whole spheres of --sizes have the packing fraction 0.305310446, nearest to the requested 0.3", whole["notes"][0])
        short = self.refused(1, "--n", 100, "--packing-fraction", 0.63, "--pressure", 20, "--quiet")
        self.assertIn("before the packing fraction 0.63", short)
        above = self.refused(1, "--input", self.dir / "p.xyz", "--porosity", 0.5, "--quiet")
        self.assertIn("the packing fraction is 0.55, above the 0.5 to grow to: nothing was done", above)
        self.refuse(3, "jam near 0.643", "--n", 1000, "--packing-fraction", 0.7)
        self.refuse(3, "jam near", *job[:3], 0.2, *job[4:6])
        curve.write_text("1 0\n2 x\n")
        self.refuse(3, "line 2", *job[:6])
        for args, text in (
            (["--porosity", "0.4", "--contacts", "a"], "the crunch, which --porosity omits"),
            (["--porosity", "0.4", "--no-md"], "beside --no-md"),
            (["--porosity", "0.8", "--phi0", "0.3"], "lies above"),
            (["--cell", "1,2"], "--cell has 2 numbers"),
        ):
            self.refuse(2, text, *args)

    def test_checkpoint_and_resume(self):
        job = ["--n", 1000, "--growth", "1e-2:500", "--growth", "3e-3:1e5", "--no-crunch"]
        self.report(*job, "--output", self.dir / "whole.dat")
        kept = self.dir / "state.bin"
        job += ["--checkpoint", kept, "--output", self.dir / "part.dat"]
        first = self.report(*job, "--wall-time", 0.05, status=1)
        self.assertEqual(first["stop_reason"], "wall_time")
        rounds = 0
        while True:
            report = self.report(*job, "--resume", kept, "--wall-time", 0.05 * 1.2**rounds, status=None)
            rounds += 1
            if report["stop_reason"] == "pressure" and report["pressure"] > 9e4 or rounds > 40:
                break
        self.assertGreater(rounds, 1)
        self.assertEqual((self.dir / "whole.dat").read_bytes(), (self.dir / "part.dat").read_bytes())
        self.refused(3, "--resume", self.dir / "none.bin")
        self.refused(2, "--resume", kept, "--input", self.dir / "part.dat")

    def test_checkpoints_without_a_pause_between_do_not_stop_dynamics(self):
        kept, rare = self.dir / "state.bin", self.report("--n", "8", "--quiet")
        often = self.report("--n", "8", "--quiet", "--checkpoint", kept, "--checkpoint-every", "1e-9")
        self.assertEqual(often["packing_fraction"], rare["packing_fraction"])

    def test_a_stopped_crunch_goes_on(self):
        """What a kill leaves of a checkpoint: tests/capi/io_faults.c."""
        kept, job = self.dir / "state.bin", ["--n", "1000", "--growth", "1e-2:500", "--quiet"]
        self.report(*job, "--no-crunch", "--checkpoint", kept)
        often = ["--resume", kept, "--checkpoint", kept, "--checkpoint-every", "0.01"]
        self.assertEqual(self.report(*job, *often, "--wall-time", 0.05, status=1)["stop_reason"], "wall_time")
        last = self.report(*job, "--resume", kept)
        self.assertEqual((last["jammed"], last["collisions"]), (True, 0))  # dynamics are not made again

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
