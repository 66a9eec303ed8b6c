#!/usr/bin/env python3
"""jam_pack_stops.py PROGRAM: what jam-pack says and leaves out when it is stopped, and what it refuses before the work."""
import json
import os
import re
import signal
import subprocess
import time
import unittest

from jam_pack_case import InFolder, program, run


class Stops(InFolder):
    def test_contacts_that_are_not_known_are_not_written(self):
        files = [self.dir / name for name in ("c.csv", "s.csv", "g.csv", "m.csv")]
        tables = [x for pair in zip(("--contacts", "--structure", "--gaps", "--spectrum"), files) for x in pair]
        out = self.dir / "p.xyz"
        done = run("--n", 3000, "--no-md", "--wall-time", 0.3, "--output", out, "--report", "-", *tables)
        self.assertEqual(done.returncode, 1, done.stderr)
        report = json.loads(done.stdout)
        for name in ("contacts", "rattlers", "bucklers", "excess_contacts"):
            self.assertIsNone(report[name], name)
        self.assertIn("before its contacts were known", done.stderr)
        self.assertEqual([f.name for f in files if f.exists()], [])
        self.assertNotIn("contacts", out.read_text().splitlines()[1])

    def test_ctrl_c_ends_a_check_with_a_word(self):
        packing = self.dir / "p.xyz"
        self.report("--n", 600, "--growth", "1e-1:1e4", "--output", packing)
        lines = packing.read_text().splitlines()
        few = [" ".join([row.split()[0], *(f"{float(x):.6f}" for x in row.split()[1:4]), *row.split()[4:]]) for row in lines[2:]]
        packing.write_text("\n".join(lines[:2] + few) + "\n")  # undecided, so that a copy is crunched
        command = [program, "check", str(packing)]
        with subprocess.Popen(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            time.sleep(0.15)
            process.send_signal(signal.SIGINT)
            stdout, stderr = process.communicate(timeout=60)
        if process.returncode == -signal.SIGINT:
            self.fail("the signal ended the program without a word")
        if not stdout:  # else it was done before
            self.assertEqual((process.returncode, "interrupted" in stderr), (3, True), stderr)

    def test_the_file_of_a_check_stands_anywhere(self):
        packing = self.dir / "p.xyz"
        self.report("--n", 64, "--growth", "1e-1:1e4", "--output", packing)
        right = run("check", packing)
        self.assertIn(right.returncode, (0, 1, 3))
        for words in (("--frame", -1, packing), (packing, "--frame", -1), ("--frame=-1", packing), ("--quiet", packing)):
            done = run("check", *words)
            self.assertEqual(done.returncode, right.returncode, f"{words}: {done.stderr}")
            self.assertEqual(done.stdout, "" if "--quiet" in words else right.stdout)

    def test_what_a_crunch_would_refuse_is_refused_at_once(self):
        out = self.dir / "p.xyz"
        for words in (
            ("--duality-gap", "1e-6", "--strain", "free"),
            ("--duality-gap", "1e-6", "--method", "sequential-lp"),
            ("--duality-gap", "1e-20"),
            ("--duality-gap", "1"),
        ):
            self.refuse(2, "--duality-gap", "--n", 300, *words, "--output", out)
            self.assertFalse(out.exists())
        self.refuse(2, "one sphere needs --strain", "--n", 1, "--output", out)

    def test_a_stop_names_the_option_that_continues(self):
        state = self.dir / "state.bin"
        for job, part in (("compress", "dynamics"), ("pack", "the crunch")):
            words = [job, "--n", 3000, "--wall-time", 0.3, "--quiet", *(["--no-md"] if job == "pack" else [])]
            for keep, end in (((), ""), (("--checkpoint", state), f"; --resume {state} continues")):
                done = run(*words, *keep)
                self.assertEqual(done.returncode, 1, done.stderr)
                said = f"jam-pack: stopped early: --wall-time came before the end of {part}, at packing fraction [0-9.]+{end}\n"
                self.assertRegex(done.stderr, f"^{said}$")
            self.assertEqual(run("--resume", state, "--no-md", "--no-crunch", "--quiet").returncode, 0)

    def test_what_cannot_be_printed_is_told(self):
        """Of each verb, into a full device and a closed descriptor, also where each line is written by itself."""
        packing = self.dir / "p.xyz"
        run("--n", 20, "--no-md", "--no-crunch", "--quiet", "--output", packing)
        for words in ("--help", "--version", "info p.xyz", "check p.xyz", "export p.xyz q.xyz", "--n 8 --no-md --no-crunch"):
            for before in ("", "stdbuf -o0 "):
                for place in (">/dev/full", ">&-"):
                    command = f"{before}{program} {words} {place}"
                    done = subprocess.run(["sh", "-c", command], cwd=self.dir, capture_output=True, text=True, timeout=60, check=False)
                    self.assertEqual(done.returncode, 4, command)
                    self.assertIn("jam-pack: cannot write standard output", done.stderr, command)

    @unittest.skipUnless(hasattr(os, "mkfifo"), "no pipes with names")
    def test_a_pipe_that_loses_its_reader_is_an_error(self):
        """More than a pipe holds: 60000 bins. No signal ends the program."""
        packing, pipe = self.dir / "p.xyz", self.dir / "pipe"
        run("--n", 20, "--no-md", "--no-crunch", "--quiet", "--output", packing)
        os.mkfifo(pipe)
        words = [program, *f"export {packing} --profile {pipe} --profile-bins 60000 --quiet".split()]
        with subprocess.Popen(words, stderr=subprocess.PIPE, text=True) as process:
            with open(pipe, "rb") as reader:
                reader.read(1)
            err = process.communicate(timeout=60)[1]
        self.assertEqual((process.returncode, "Broken pipe" in err), (4, True), err)

    def test_no_file_takes_the_place_of_a_closed_descriptor(self):
        """The log would be the first file that is opened, and have messages and summary in it."""
        for closed in (">&-", "2>&-", ">&- 2>&-", "<&- >&- 2>&-"):
            command = f"{program} --n 500 --growth 1e-1:1e3 --no-crunch --log l.txt --checkpoint /dev/full --checkpoint-every 0.05 {closed}"
            subprocess.run(["sh", "-c", command], cwd=self.dir, timeout=60, check=False)
            lines = (self.dir / "l.txt").read_text().splitlines()
            self.assertEqual([line for line in lines if not re.match(r" *[0-9.]+ (info|warning) ", line)], [], closed)

    def test_ctrl_c_while_a_page_gets_its_network_is_an_early_end(self):
        packing = self.dir / "p.xyz"
        run("--n", 3000, "--growth", "1:20", "--no-crunch", "--quiet", "--output", packing)
        for tenths in range(1, 60):
            done = subprocess.run(
                ["timeout", "--preserve-status", "-s", "INT", str(0.05 * tenths), program, "page", packing, self.dir / "p.html"],
                capture_output=True, text=True, timeout=60, check=False,
            )  # fmt: skip
            if "no contact network: Ctrl-C" in done.stderr:
                self.assertEqual(done.returncode, 1)
                return
        self.fail("no signal came between the file and the page")

    def test_a_resumed_job_grows_to_the_density_of_the_law(self):
        """One whole sphere of the law has another density than was asked for, in the job and in that which goes on."""
        kept, first, more = (self.dir / name for name in ("k", "a.xyz", "b.xyz"))
        job = "--sizes list:0.1=1 --dim 2 --packing-fraction 0.606 --cell 1,1".split()
        whole = self.report(*job, "--checkpoint", kept, "--output", first)
        again = self.report(*job, "--resume", kept, "--output", more)
        self.assertEqual([again[k] for k in ("packing_fraction", "diameter_mean", "notes")], [whole[k] for k in ("packing_fraction", "diameter_mean", "notes")])
        self.assertAlmostEqual(whole["diameter_mean"], 0.1, 12)
        self.assertNotIn("times those", run(*job, "--resume", kept).stdout)
        self.assertEqual(first.read_text().splitlines()[2:], more.read_text().splitlines()[2:])

    def test_the_options_of_the_killed_job_are_given_again(self):
        """The same ones are accepted. Another one of those that the checkpoint holds is named."""
        kept = self.dir / "k"
        for scene, others in (
            ("--cell 4,5,6 --walls z --diameters-ratio 1.4", ("--cell 4,5,7", "--cell 4,5", "--walls x", "--box 3", "--diameters-ratio 3", "--container cylinder")),
            ("--box 3 --container cylinder --walls z", ("--box 2", "--container ball", "--walls none", "--sizes uniform:least=1,most=2")),
            ("--cell 4,0,0,1,4,0,0,1,4 --sizes list:1=0.5,2=0.5", ("--cell 4,4,4", "--sizes list:1=0.5,3=0.5", "--model mk", "--non-additivity 0.1", "--zeta 1")),
            ("--model mk --zeta 1", ("--model euclid",)),
            ("--diameters-ratio 1.4 --non-additivity 0.1", ("--non-additivity 0.2",)),
        ):
            job = ["compress", "--n", 60, "--growth", "1e-1:20", *scene.split(), "--quiet"]
            self.assertEqual(run(*job, "--checkpoint", kept).returncode, 0)
            done = run(*job, "--resume", kept)
            self.assertEqual(done.returncode, 0, (scene, done.stderr))
            for other in others:
                self.refuse(2, other.split()[0], "compress", "--growth", "1e-1:20", "--resume", kept, *other.split())
        bed = self.dir / "bed.csv"
        bed.write_text("x,y,z,radius\n0,0,0,1\n0,0,2.5,1\n")
        tiled = ["--columns", "x,y,z,radius", "--cell", "5,5,5", "--origin", "-1,-1,-1", "--tile", "2,1,1"]
        job = [*tiled, "--growth", "1e-1:20", "--no-crunch", "--quiet"]
        self.assertEqual(run("--input", bed, *job, "--checkpoint", kept).returncode, 0)
        self.assertEqual(run("--resume", kept, *job).returncode, 0)
        self.refuse(2, "--cell", "--resume", kept, *job[:2], "--cell", "5,5,5")

    def test_blanks_behind_commas_are_none(self):
        bed = self.dir / "bed.csv"
        bed.write_text("1,1,1,0.3\n1,1,2.5,0.3\n")
        told = [run("info", bed, "--json", "--columns", c, "--cell", cell, "--origin", origin)
                for c, cell, origin in (("x,y,z,radius", "4,4,5", "-1,-1,0"), ("x, y, z, radius", "4, 4, 5", " -1, -1, 0"))]  # fmt: skip
        self.assertEqual([t.returncode for t in told], [0, 0], told)
        self.assertEqual(told[0].stdout, told[1].stdout)

    def test_long_facts_of_a_file_are_whole(self):
        """Some 2100 characters, of which the last one counts."""
        bed = self.dir / "bed.csv"
        bed.write_text("1,1,1,0.3\n1,1,2.5,0.3\n")
        cell = ",".join(f"{side:0700d}" for side in (4, 4, 5))
        self.assertEqual(json.loads(run("info", bed, "--json", "--columns", "x,y,z,radius", "--cell", cell).stdout)["cell"][2], [0, 0, 5])

    def soft(self):
        """A packing of soft disks below its jammed state, and the words that shear it."""
        start = self.dir / "start.xyz"
        run("--n", 40, "--dim", 2, "--diameters-ratio", 1.4, "--seed", 2, "--quiet", "--output", start)
        return ["shear", start, "--alpha", 2]

    def test_a_path_of_shear_is_its_numbers(self):
        """Blanks and zeros of the words do not count when a shear goes on."""
        soft, state = self.soft(), self.dir / "state"
        words = ("--to", " 0.01, -0.010", "--mode", " 0,1, 0, 0", "--stress", " yy=0.010")
        same = ("--to", "1e-2,-1e-2", "--mode", "0,1,0,0", "--stress", "yy=1e-2")
        for path, other in ((words, same), (same, words)):
            done = run(*soft, *path, "--checkpoint", state, "--checkpoint-every", 1e-9, "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
            done = run("shear", "--resume", state, "--alpha", 2, *other, "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_table_that_goes_on_is_a_file(self):
        soft = [*self.soft(), "--to", 0.01]
        for place in ("-", "/dev/stdout", "/dev/null"):
            self.refuse(2, f"--rows {place} contradicts --checkpoint", *soft, "--rows", place, "--checkpoint", "k")
            self.refuse(2, f"--rows {place} contradicts --resume", "shear", "--resume", "k", "--to", 0.01, "--rows", place)

    def test_a_table_on_standard_output_stands_alone(self):
        soft = self.soft()
        rows = run(*soft, "--to", 0.01, "--rows", "-").stdout.splitlines()
        self.assertEqual({line.count(",") for line in rows}, {12})
        for command in (["crunch", soft[1]], ["export", soft[1]]):
            for place in ("-", "/dev/stdout"):
                table = run(*command, "--contacts", place).stdout.splitlines()
                self.assertEqual({line.count(",") for line in table}, {table[0].count(",")}, command)

    def test_no_input_and_no_output_is_overwritten(self):
        (self.dir / "curve.csv").write_text("1 0\n2 100\n")
        law = ("--sizes", "sieve:share=volume,curve.csv")
        self.refuse(2, "--gaps would overwrite the input", *law, "--gaps", "curve.csv")
        self.refuse(2, "--vtk would overwrite the input", "--sizes", "list:a.vtp", "--vtk", "a")
        self.refuse(2, "--output and --vtk must be different files", "--output", "a.vtp", "--vtk", "a")
        self.refuse(2, "--contacts and --vtk must be different files", "--contacts", "a-forces.vtp", "--vtk", "./a")

    @unittest.skipUnless(os.path.exists("/dev/fd"), "no names of descriptors")
    def test_sizes_come_through_a_pipe(self):
        """A pipe gives its text once."""
        job = "--n 40 --dim 2 --no-md --no-crunch --json"
        for text, words in (("1\\n2\\n", ""), ("1 0\\n2 60\\n4 100\\n", "sieve:"), ("1 1\\n2 1\\n", "list:")):
            told = []
            for source in (f"printf '{text}' >f; {program} {{}} --sizes {words}f", f"printf '{text}' | {program} {{}} --sizes {words}/dev/fd/0"):
                command = source.format(job if words else job[6:])
                done = subprocess.run(["sh", "-c", command], cwd=self.dir, capture_output=True, text=True, timeout=60, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                told.append({**json.loads(done.stdout), "options": None})
            self.assertEqual(*[{k: v for k, v in t.items() if not k.startswith("seconds")} for t in told])
            self.assertIsNotNone(told[1]["diameter_mean_given"])

    @unittest.skipUnless(hasattr(signal, "SIGXFSZ"), "no limit on the size of files")
    def test_a_limit_on_the_size_of_files_is_an_error(self):
        """Of the program's files, of the library's, and of the log; none is left in part."""
        packing = self.dir / "p.xyz"
        run("--n", 20, "--no-md", "--no-crunch", "--quiet", "--output", packing)
        bins = "--profile-bins 60000 --quiet"
        for words in (f"export p.xyz --profile q.csv {bins}", f"export p.xyz --profile /dev/stdout {bins} >q.csv",
                      f"export p.xyz --profile q.csv {bins} --json >out", "--n 400 --growth 1e-1:1e3 --quiet --log q.csv"):  # fmt: skip
            done = subprocess.run(["sh", "-c", f"ulimit -f 1; exec {program} {words}"], cwd=self.dir, capture_output=True, text=True, timeout=60, check=False)
            self.assertEqual((done.returncode, "File too large" in done.stderr), (4, True), (words, done))
            names = sorted(p.name for p in self.dir.iterdir() if p.name not in ("out", "q.csv"))
            self.assertEqual(names, ["p.xyz"], words)

    def test_a_table_follows_a_link_to_a_file_that_is_not_there(self):
        packing, link, target = self.dir / "p.xyz", self.dir / "link.csv", self.dir / "target.csv"
        run("--n", 20, "--no-md", "--no-crunch", "--quiet", "--output", packing)
        link.symlink_to("target.csv")
        self.assertEqual(run("export", packing, "--profile", link).returncode, 0)
        self.assertTrue(link.is_symlink() and target.read_text())

    def test_a_value_that_the_library_refuses_is_a_wrong_command_line(self):
        start = self.soft()[1]
        for more in (("--mode", "0,0,1,0"), ("--step", "1e-300"), ("--mode", "0,0,1,0", "--alpha", 2)):
            self.assertEqual(run("shear", start, "--to", 0.01, *more).returncode, 2, more)
        self.assertEqual(run("crunch", start, "--radii", "moments:0,0").returncode, 2)

    def test_a_limit_of_time_holds_for_check_and_export(self):
        """Neither verdict nor network; the texts name the option."""
        packing = self.dir / "p.xyz"
        run("--n", 3000, "--growth", "1:20", "--no-crunch", "--quiet", "--output", packing)
        limit = ("--wall-time", "1e-9")
        done = run("check", packing, *limit)
        self.assertEqual((done.returncode, "--wall-time" in done.stderr), (3, True), done)
        done = run("export", packing, "--contacts", self.dir / "c.csv", *limit)
        self.assertEqual((done.returncode, "--wall-time" in done.stderr), (1, True), done)
        done = run(*self.soft(), "--to", 0.01, *limit)
        self.assertNotRegex(done.stderr, r"(?<!-)wall_time")

    def test_no_proof_is_written_of_what_is_not_jammed(self):
        """Disks that are jammed in their cell, and not when the cell deforms."""
        made, proof, strict = self.dir / "one.xyz", self.dir / "a.jamproof", self.dir / "b.jamproof"
        job = ("--n", 12, "--dim", 2, "--seed", 1, "--diameters-ratio", 1.4)
        both = ("--proof", proof, "--strict-proof", strict)
        for words in ((*job, "--output", made), ("check", made), ("crunch", made)):
            done = run(*words, *both)
            self.assertEqual((done.returncode, proof.exists(), strict.exists()), (1, True, False), (words, done.stderr))
            self.assertIn("b.jamproof is not written", done.stderr)
            self.assertIn("strictly jammed", done.stderr)
            proof.unlink()
        self.assertEqual(run("check", made, "--proof", proof).returncode, 0)


if __name__ == "__main__":
    unittest.main()
