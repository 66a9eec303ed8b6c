#!/usr/bin/env python3
"""jam_pack_verbs.py PROGRAM: the verbs of jam-pack, the options that each takes, and their JSON."""
import json
import os
import re
import subprocess
import sys
import unittest

from jam_pack_case import InFolder, program, run


def users():
    """Arguments of subprocess.run: none, and where root runs the tests those of a user who can write into no system folder."""
    other = {"user": "nobody", "extra_groups": []}
    try:
        reached = os.getuid() == 0 and subprocess.run([program, "--version"], capture_output=True, **other).returncode == 0
    except (OSError, KeyError, ValueError):
        reached = False
    return [{}, other] if reached else [{}]


class Verbs(InFolder):
    def test_growth_of_given_sizes_and_stress_of_walls_are_told(self):
        """Grains in the unit of the cell grow with the crunch; the report has their factor and the stress of each wall."""
        made = ("--n", "60", "--sizes", "lognormal:deviation=0.3", "--cell", "10,10,15", "--walls", "xyz", "--growth", "1e-2:500")
        told = run("pack", *made, "--output", self.dir / "bed.xyz", "--report", self.dir / "bed.json")
        report = json.loads((self.dir / "bed.json").read_text())
        factor = report["diameter_mean"] / report["diameter_mean_given"]
        self.assertAlmostEqual(report["diameter_mean_given"], 1, 1)
        self.assertAlmostEqual(float(re.search(r"diameters are (\S+) times those of --sizes", told.stdout)[1]), factor, 6)
        self.assertTrue(report["jammed"])
        self.assertAlmostEqual(sum(report["stress_tensor"][::4]), 3, 12)
        self.assertEqual([(w["axis"], w["side"]) for w in report["walls"]], [(c, s) for c in range(3) for s in range(2)])
        work = sum(w["stress"] * w["area"] * (10, 10, 15)[w["axis"]] for w in report["walls"]) / 2
        self.assertAlmostEqual(work / (3 * 1500), 1, 9)  # their mean is the pressure
        open_cell = json.loads(run("pack", "--n", "20", "--quiet", "--report", "-", "--output", self.dir / "a.xyz").stdout)
        self.assertEqual((open_cell["walls"], open_cell["diameter_mean_given"]), ([], None))

    def test_packings_between_walls_are_proved(self):
        given = ("pack", "--n", "30", "--seed", "4", "--quiet", "--walls", "z", "--output", self.dir / "a.xyz")
        told = run(*given, "--prove", "--proof", self.dir / "a.jamproof", "--report", "-")
        self.assertRegex(json.loads(told.stdout)["proof"], "^(proved, radius|trapped within) ", told.stderr)
        self.assertIn("walls 2", (self.dir / "a.jamproof").read_text().splitlines())
        refused = run(*given, "--strict-proof", self.dir / "b.jamproof")
        self.assertIn("contradicts --strict-proof: walls do not strain", refused.stderr)

    def test_axes_without_walls_deform(self):
        given = ("pack", "--n", "12", "--seed", "3", "--quiet", "--strain", "free", "--report", "-", "--output", self.dir / "a.xyz")
        report = json.loads(run(*given, "--walls", "z").stdout)
        self.assertTrue(report["jammed"])
        for scene in (("--walls", "yz"), ("--container", "ball")):
            self.assertIn("two axes without walls at least", run(*given, *scene).stderr)

    def test_radii_move_to_a_maximum(self):
        """The sum, and moments, from the written radii; what is no kind is refused before any work."""
        given = ("pack", "--n", "30", "--dim", "2", "--walls", "xy", "--sizes", "uniform:low=0.6,high=1.4", "--quiet")
        radii, kind = [], "moments:1,2,3"
        for more in (("--no-md", "--no-crunch"), ("--no-md", "--radii", kind)):
            run(*given, *more, "--output", self.dir / "disks.xyz", "--report", self.dir / "disks.json")
            radii.append([float(line.split()[4]) for line in (self.dir / "disks.xyz").read_text().splitlines()[2:]])
        report = json.loads((self.dir / "disks.json").read_text())
        self.assertEqual(report["protocol"], [{"stage": "radii", "kind": kind, "strain": "none"}])
        self.assertEqual((report["jammed"], report["method"]), (True, None))
        for q in (1, 2, 3):
            self.assertAlmostEqual(sum(r**q for r in radii[1]) / sum(r**q for r in radii[0]) / report["radii_value"] ** q, 1, 12)
        one = ("pack", "--n", "1", "--dim", "2", "--no-md", "--quiet", "--radii", "sum", "--report", "-", "--output", self.dir / "one.xyz")
        report = json.loads(run(*one, "--strain", "free").stdout)
        self.assertEqual(report["protocol"], [{"stage": "radii", "kind": "sum", "strain": "free"}])
        self.assertAlmostEqual(report["radii_value"], 12**-0.25, 14)
        self.assertEqual(report["strictly_jammed"], True)
        told = run("--n", 10, "--cell", "1,1,1.2", "--container", "cone", "--walls", "z", "--no-md", "--radii", "sum")
        self.assertEqual((told.returncode, "no formulae for a cone" in told.stderr), (3, True), told.stderr)
        for wrong in ("bla", "moments:", "moments:1,2,3,4,5"):
            done = run(*given, "--radii", wrong)
            self.assertEqual((done.returncode, f"--radii is '{wrong}'" in done.stderr), (2, True))

    def overlapping(self, packing):
        """The disks of a file 1.03 times as large, as a table, and the options that read it."""
        path = self.dir / "overlapping.txt"
        spheres = [line.split()[1:] for line in packing.read_text().splitlines()[2:]]
        path.write_text("".join(f"{x} {y} {float(radius) * 1.03:.17g}\n" for x, y, _, radius, *_ in spheres))
        return path, "--columns", "x,y,radius", "--cell", "1,1"

    def test_shear_goes_on_to_the_same_bits(self):
        """A run that ends at its first event, and goes on from the state before it, against one that does not end. The physics
        is that of tests/bindings/test_shear.py."""
        start, state, rows = self.dir / "start.xyz", self.dir / "state.jam", self.dir / "rows.csv"
        run("--n", 40, "--dim", 2, "--diameters-ratio", 1.4, "--seed", 2, "--quiet", "--output", start)
        soft = (*self.overlapping(start), "--alpha", 2)
        for begin, to in (soft, ("0.06", "-0.01")), ((start,), ("0.004",)):
            alpha = begin[5:]
            path = ("--to", ",".join(to), "--step", 1e-3 if alpha else 2e-4)
            whole = run("shear", *begin, "--output", self.dir / "whole.xyz", *path, "--rows", self.dir / "whole.csv", "--json")
            self.assertEqual(whole.returncode, 0, whole.stderr)
            told = json.loads(whole.stdout)
            self.assertEqual(told["stop_reason"], "strain")
            self.assertAlmostEqual(told["strain"], float(to[-1]), 12)
            first = run("shear", *begin, *path, "--until", "event", "--rows", rows, "--checkpoint", state, "--checkpoint-every", 1e-9)
            self.assertEqual(first.returncode, 0, first.stderr)
            self.assertIn("(event)" if told["events"] else "(strain)", first.stdout)
            if not state.exists():  # the first event came before the first state
                continue
            more = run("shear", "--resume", state, "--output", self.dir / "more.xyz", *path, *alpha, "--rows", rows, "--json")
            self.assertEqual(more.returncode, 0, more.stderr)
            self.assertEqual({**json.loads(more.stdout), "file": "", "notes": []}, {**told, "file": "", "notes": []})
            self.assertEqual(rows.read_text(), (self.dir / "whole.csv").read_text())
            atoms = [(self.dir / name).read_text().splitlines()[2:] for name in ("more.xyz", "whole.xyz")]
            self.assertEqual(*atoms)
            other = run("shear", "--resume", state, "--to", 0.5, *alpha)
            self.assertEqual(other.returncode, 2)
            self.assertIn("give the same", other.stderr)
            other = run("shear", "--resume", state, *path, *(("--alpha", 3) if alpha else ("--alpha", 2)))
            self.assertIn("give the same", other.stderr)
            rows.write_text("strain\n")
            self.assertIn("has not the", run("shear", "--resume", state, *path, *alpha, "--rows", rows).stderr)
            state.unlink()
        for wrong in (("--to", "0"), ("--to", "a"), (), ("--to", 0.1, "--alpha", 2, "--shrink"), ("--to", 0.1, "--alpha", 0.5)):
            self.assertIn(run("shear", start, *wrong).returncode, (2, 3))
        self.assertEqual(run("shear", "--resume", start, "--to", 0.1).returncode, 3)
        self.assertIn("a text that is not empty", run("shear", start, "--to", 0.1, "--mode", "").stderr)

    def test_shear_that_ends_before_a_minimum(self):
        """No time is left: the text says so, and no number of a minimum that was not reached is printed."""
        start = self.dir / "start.xyz"
        run("--n", 40, "--dim", 2, "--diameters-ratio", 1.4, "--seed", 2, "--quiet", "--output", start)
        early = ("shear", start, "--to", 0.01, "--wall-time", 1e-9)
        told = run(*early)
        self.assertEqual((told.returncode, told.stdout), (1, "ended at the strain 0 (wall_time), before a minimum\n"))
        self.assertIn("wall", told.stderr)
        told = json.loads(run(*early, "--json").stdout)
        self.assertEqual([told[name] for name in ("energy", "contacts", "rattlers", "rows")], [None, None, None, 0])
        self.assertNotIn("history", told["text"])

    def test_shear_along_a_mode_at_a_stress(self):
        """The cell follows until the stress is as asked; a shear that is continued needs the same mode and stress."""
        made, state = self.dir / "made.xyz", self.dir / "state.jam"
        run("--n", 40, "--dim", 2, "--diameters-ratio", 1.4, "--seed", 2, "--quiet", "--output", made)
        soft = ("shear", *self.overlapping(made), "--alpha", 2)
        pure = json.loads(run(*soft, "--to", 2e-3, "--mode", "0.5,0,0,-0.5", "--json").stdout)
        xx, _, _, yy = pure["stress_tensor"]
        free = ("--to", 2e-3, "--step", 2e-4, "--stress", f"xx={xx:.17g},yy={yy:.17g}")
        told = json.loads(run(*soft, *free, "--json", "--output", self.dir / "whole.xyz").stdout)
        for k, wanted in ((0, xx), (3, yy)):
            self.assertAlmostEqual(told["stress_tensor"][k], wanted, delta=1e-9 * pure["pressure"])
        self.assertEqual(run(*soft, *free, "--until", "event", "--checkpoint", state, "--checkpoint-every", 1e-9).returncode, 0)
        resume = ("shear", "--resume", state, "--alpha", 2, "--output", self.dir / "more.xyz")
        more = json.loads(run(*resume, *free, "--json").stdout)
        self.assertEqual((more["stress_tensor"], more["rows"]), (told["stress_tensor"], told["rows"]))
        self.assertIn("give the same", run(*resume, *free[:4]).stderr)
        for wrong, why in ((("--mode", "1,0"), "4 numbers"), (("--mode", "0,0,1,0"), "upper-triangular"),
                           (("--stress", "xy=0"), "drives xy"), (("--stress", "yx=0"), "must be components"),
                           (("--stress", "yy=1,yy=1"), "must be components"), (("--stress", "zz=1"), "must be components"),
                           (("--stress", "yy=1,"), "must be components"), (("--stress", "yy=-1"), "no tension")):
            done = run(*soft, "--to", 1e-3, *wrong)
            self.assertIn(done.returncode, (2, 3), wrong)
            self.assertIn(why, done.stderr)
        self.assertEqual(run("shear", made, "--to", 1e-3, "--stress", "yy=1").returncode, 2)  # hard spheres

    def test_check_tells_the_stress(self):
        made = self.dir / "made.xyz"
        self.assertEqual(run("--n", 40, "--dim", 2, "--diameters-ratio", 1.4, "--seed", 2, "--quiet", "--output", made).returncode, 0)
        told = json.loads(run("check", made, "--json").stdout)
        self.assertEqual(told["notes"], [])  # it wrote the stress itself
        self.assertAlmostEqual(told["stress_tensor"][0] + told["stress_tensor"][3], 2, 9)  # in units of the pressure
        text = re.search(r"Stress over pressure: (\S+) (\S+) on the diagonal, at most (\S+) off it", run("check", made).stdout)
        for k, c in ((1, 0), (2, 3)):
            self.assertAlmostEqual(float(text[k]), told["stress_tensor"][c], 3)
        self.assertAlmostEqual(float(text[3]), abs(told["stress_tensor"][1]), delta=0.06 * abs(told["stress_tensor"][1]))
        loose = self.dir / "loose.xyz"
        run("compress", "--n", 40, "--dim", 2, "--packing-fraction", 0.5, "--quiet", "--output", loose)
        self.assertIsNone(json.loads(run("check", loose, "--json").stdout)["stress_tensor"])
        self.assertNotIn("Stress over", run("check", loose).stdout)

    def test_reports_are_written_as_other_files_are(self):
        """Into what the shell has opened, also to append; under any name; as JSON whatever the command line holds."""
        file, name = self.dir / "all.txt", "r" * 250 + ".json"
        for target, user in ((t, u) for t in ("/dev/stdout", "/dev/fd/1", "-") for u in users()):
            file.write_text("first\n")
            self.dir.chmod(0o755), file.chmod(0o666)
            command = f'"$0" --n 64 --quiet --report {target} >>{file}; echo last >>{file}'
            done = subprocess.run(["sh", "-c", command, program], capture_output=True, text=True, timeout=60, check=True, **user)
            self.assertEqual((done.stdout, done.stderr), ("", ""))
            lines = file.read_text().splitlines()
            self.assertEqual((lines[0], lines[-1]), ("first", "last"))
            self.assertEqual(json.loads("\n".join(lines[1:-1]))["n"], 64)
        (self.dir / name).write_text("old")
        (self.dir / name).chmod(0o640)
        self.assertEqual(run("--n", 64, "--quiet", "--report", self.dir / name).returncode, 0)
        self.assertEqual(json.loads((self.dir / name).read_text())["n"], 64)
        self.assertEqual((self.dir / name).stat().st_mode & 0o777, 0o640)
        odd = os.fsencode(self.dir) + b"/\xff\xc3\xa9.xyz"
        done = subprocess.run([program, "--n", "64", "--output", odd, "--report", "-"], capture_output=True, check=True)
        self.assertIn("\\xff\u00e9.xyz", " ".join(json.loads(done.stdout.decode("utf-8"))["options"]))
        self.assertEqual([p.name for p in self.dir.iterdir() if p.name.startswith(".jam")], [])

    def test_walls_of_a_file(self):
        """A sphere 0.0875 from a wall and 0.1 wide is the nearest of two; a file that says nothing is called periodic."""
        bed = self.dir / "bed.data"
        rows = "1 1 0.1 1.0 0.5 0.5 0.0875\n2 1 0.1 1.0 0.5 0.5 0.6\n"
        bounds = "".join(f"0 1 {c}lo {c}hi\n" for c in "xyz")
        bed.write_text(f"bed of another program\n\n2 atoms\n1 atom types\n\n{bounds}\nAtoms # sphere\n\n{rows}")
        info = json.loads(run("info", bed, "--walls", "z", "--json").stdout)
        self.assertAlmostEqual(info["nearest_gap"], 0.75, 12)
        self.assertIn("a sphere and its wall, with gap 0.75 ", run("info", bed, "--walls", "z").stdout)
        said = run("check", bed).stderr
        self.assertIn("note: ", said)
        self.assertIn("periodic", said)
        self.assertNotIn("periodic", run("check", bed, "--walls", "z").stderr)

    def test_what_they_do(self):
        dense, jammed, data, page, csv = (self.dir / name for name in ("d.xyz", "j.xyz", "j.data", "j.html", "c.csv"))
        whole = ("--n", 64, "--seed", 3, "--growth", "1e-2:1e4")
        done = run("compress", *whole, "--json", "--output", dense)
        self.assertEqual(done.returncode, 0, done.stderr)
        told = json.loads(done.stdout)
        self.assertEqual((told["stop_reason"], told["contacts"], told["jammed"]), ("pressure", None, None))
        self.assertGreaterEqual(told["pressure"], 1e4)
        before = dense.read_bytes()
        report = json.loads(run("crunch", dense, jammed, "--json").stdout)
        self.assertTrue(report["jammed"])
        self.assertEqual(dense.read_bytes(), before)
        old = self.dir / "old.xyz"  # the command line without verbs gives the same bits
        self.assertEqual(run(*whole, "--no-crunch", "--output", old).returncode, 0)
        self.assertEqual(old.read_bytes(), before)
        self.assertEqual(run("--input", dense, "--output", old).returncode, 0)
        self.assertEqual(old.read_bytes(), jammed.read_bytes())
        self.assertEqual(run("pack", *whole, "--output", old).returncode, 0)
        self.assertEqual(run(*whole, "--output", self.dir / "again.xyz").returncode, 0)
        self.assertEqual(old.read_bytes(), (self.dir / "again.xyz").read_bytes())

        info = json.loads(run("info", jammed, "--json").stdout)
        self.assertEqual((info["n"], info["dim"], info["cell"][1]), (64, 3, [0, 1, 0]))
        self.assertEqual(info["packing_fraction"], report["packing_fraction"])
        self.assertAlmostEqual(info["packing_fraction"] + info["porosity"], 1, 15)
        self.assertAlmostEqual(info["nearest_gap"], 0, 12)
        check = json.loads(run("check", jammed, "--json").stdout)
        self.assertEqual((check["jammed"], check["contacts"]), (True, report["contacts"]))
        done = run("check", dense, "--json")
        self.assertEqual(done.returncode, {True: 0, False: 1, None: 3}[json.loads(done.stdout)["jammed"]])
        said = run("export", jammed, data, "--contacts", csv, "--json")
        self.assertEqual(json.loads(said.stdout)["written"], [str(data), str(csv)])
        self.assertEqual(len(csv.read_text().splitlines()), report["contacts"] + 1)
        self.assertEqual(json.loads(run("info", data, "--json").stdout)["d50"], info["d50"])
        self.assertEqual(run("page", jammed, page).returncode, 0)
        self.assertIn("<html", page.read_text()[:2000])

    def test_what_they_refuse(self):
        bad = self.dir / "bad.dat"
        bad.write_text("2\n2\n0.4\n0.1 0.5\n0.4 0.5\n")
        self.assertTrue(json.loads(run("info", bad, "--json").stdout)["nearest_gap"] < -0.2)
        for status, text, *args in (
            (2, "check takes no '--n'; it takes a FILE, ", "check", bad, "--n", 4),
            (2, "crunch takes no '--growth'", "crunch", bad, "--growth", "1e-2"),
            (2, "compress takes no '--contacts'", "compress", "--contacts", "c.csv"),
            (2, "info takes no '--wall-time'", "info", bad, "--wall-time", 1),
            (2, "page takes no '--wall-time'", "page", bad, self.dir / "a.html", "--wall-time", 1),
            (2, "crunch needs a FILE", "crunch"),
            (2, "info needs a FILE", "info"),
            (2, "page needs a FILE and the OUTPUT.html", "page", bad),
            (2, "export writes nothing", "export", bad),
            (2, "unexpected argument 'c'", "export", bad, "b.xyz", "c"),
            (2, "unknown option '-q'", "crunch", bad, "-q"),
            (2, "--json has no effect beside --report", "crunch", bad, "--json", "--report", "a"),
            (3, f"{bad}: spheres 0 and 1 overlap by 0.25 of their contact distance; --shrink multiplies", "crunch", bad),
            (3, "No such file", "info", self.dir / "none.xyz"),
            (4, "cannot write", "export", bad, self.dir / "no" / "such.xyz"),
        ):
            self.refuse(status, text, *args)
        for verb in ("pack", "compress", "crunch", "check", "info", "export", "page"):
            done = run(verb, "--help")
            self.assertEqual(done.returncode, 0)
            self.assertIn(f"Usage: jam-pack {verb}", done.stdout)
            self.assertIn("  --json", done.stdout)
            self.assertEqual("  --growth" in done.stdout, verb in ("pack", "compress"))

    def test_a_second_file_is_refused(self):
        """Neither of two files for one option is dropped, whether the option or a word without dashes comes first."""
        first, second, third = (self.dir / name for name in ("f.xyz", "j.xyz", "R.xyz"))
        for start in (first, second):
            start.write_text('1\nLattice="1 0 0 0 1 0 0 0 1" Properties=pos:R:3:radius:R:1\n0.5 0.5 0.5 0.2\n')
        out = {"crunch": ("--output", third), "compress": ("--output", third), "export": ("--output", third), "page": ("--page", third)}
        for verb in ("compress", "crunch", "check", "info", "export", "page"):
            for words in ((first, "--input", second), ("--input", first, second), ("--input", first, "--input", second)):
                self.refuse(2, f"two files for --input, '{first}' and '{second}'", verb, *words, *out.get(verb, ()))
        self.refuse(2, "--resume and --input both give a start", "crunch", first, "--resume", second)
        one, two = self.dir / "a", self.dir / "b"
        for verb, option in (("crunch", "--output"), ("export", "--output"), ("page", "--page")):
            self.refuse(2, f"two files for {option}, '{one}' and '{two}'", verb, first, one, option, two)
            self.refuse(2, f"two files for {option}, '{one}' and '{two}'", verb, option, one, first, two)
        self.assertEqual(sorted(p.name for p in self.dir.iterdir()), ["f.xyz", "j.xyz"])

    def test_standard_output_takes_one_text(self):
        start = self.dir / "f.xyz"
        start.write_text('1\nLattice="1 0 0 0 1 0 0 0 1" Properties=pos:R:3:radius:R:1\n0.5 0.5 0.5 0.2\n')
        for words in (("export", start, "-"), ("export", start, "-", "--json"), ("crunch", start, "-"), ("compress", "--output", "-")):
            self.refuse(2, "--output -: it cannot go to standard output", *words)
        self.refuse(2, "--page -: it cannot go to standard output", "page", start, "-")
        self.refuse(2, "--gaps -: it cannot go to standard output", "export", start, "--gaps", "-")
        self.refuse(2, "--contacts - contradicts --json", "export", start, "--contacts", "-", "--json")
        self.refuse(2, "--log - contradicts --json", "crunch", start, "--log", "-", "--json")
        self.refuse(2, "--report - contradicts --contacts", "crunch", start, "--contacts", "-", "--report", "-")
        self.assertEqual([p.name for p in self.dir.iterdir()], ["f.xyz"])

    def test_verbs_of_the_module_without_it(self):
        """A python3 without packages comes first on the path: status 3, as for every request that is refused."""
        python = self.dir / "python3"
        python.write_text(f'#!/bin/sh\nexec {sys.executable} -I -S "$@"\n')
        python.chmod(0o755)
        env = {**os.environ, "PATH": f"{self.dir}:{os.environ['PATH']}"}
        for verb in ("ensemble", "search"):
            done = subprocess.run([program, verb, "--help"], capture_output=True, text=True, timeout=60, check=False, env=env)
            self.assertEqual((done.returncode, done.stdout), (3, ""), done.stderr)
            self.assertIn(f"{verb} needs python3 with the module jam", done.stderr)


if __name__ == "__main__":
    unittest.main()
