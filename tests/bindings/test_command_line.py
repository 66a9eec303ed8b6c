"""Every option of every verb: given twice, with a wrong value, with a missing file, without effect.

By python3 -m jam in this process, which runs the code of jam-pack; tests/package tries the program. Nothing is dropped in silence, no message names a C function, and --json is answered in JSON also where a job fails.
"""
import contextlib
import io
import json
import os
import re
import sys
import tempfile
import unittest
from pathlib import Path

import jam
import numpy as np
from jam import cli
from jam.ensemble import cli as ensemble

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bindings/gen"))
from options import TABLE, VERBS, verbs_of
from packings import InFolder

USAGE, REFUSED, OUTPUT = 2, 3, 4
ALL = [o for rows in TABLE.values() for o in rows if o.kind != "help"]
# two values of each kind that the program takes
GOOD = {
    "positive": ("0.3", "0.2"),
    "not_negative": ("0.3", "0.2"),
    "pressure": ("100", "200"),
    "delta": ("0.1", "0.2"),
    "fraction": ("0.3", "0.2"),
    "sizes": ("equal", "normal:deviation=0.1"),
    "cell": ("1,2,3", "2,2,2"),
    "copies": ("1,1,2", "2,1,1"),
}
BAD = {"text": "", "input": "", "output": "", "sizes": "", "cell": "1,x", "copies": "1,x", "choice": "other"}


def good(o):
    if o.kind == "integer":
        return str(max(o.low, 2)), str(min(o.high, 3))
    return o.words[:2] if o.words else GOOD.get(o.kind) or (f"one-{o.name}", f"two-{o.name}")


def wrong(o):
    values = [BAD.get(o.kind, "x")]
    if o.kind == "integer":
        values += [str(o.low - 1), str(o.high + 1), "2.5"]
    if o.kind in ("positive", "not_negative", "fraction", "pressure", "delta"):
        values += ["nan", "-7"] + ([str(2 * o.high)] if o.high else [])
    return values


def in_process(main, words, folder):
    """What main returns, and what the process wrote meanwhile, C and Python."""
    before, saved, files = os.getcwd(), (os.dup(1), os.dup(2)), [tempfile.TemporaryFile() for _ in range(2)]
    os.chdir(folder)
    for k, file in enumerate(files, 1):
        os.dup2(file.fileno(), k)
    out, err = io.StringIO(), io.StringIO()
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            try:
                code = main(words)
            except SystemExit as stop:
                code = stop.code
    finally:
        for k, fd in enumerate(saved, 1):
            os.dup2(fd, k)
            os.close(fd)
        os.chdir(before)
    texts = [more.getvalue() for more in (out, err)]
    for k, file in enumerate(files):
        file.seek(0)
        texts[k] += file.read().decode()
        file.close()
    return code, *texts


class CommandLine(InFolder):
    def setUp(self):
        super().setUp()
        self.file = self.folder / "start.xyz"
        self.file.write_text('2\nLattice="1 0 0 0 1 0 0 0 1" Properties=pos:R:3:radius:R:1\n0.5 0.5 0.5 0.2\n0.5 0.5 0.95 0.2\n')

    def run_words(self, *words):
        return in_process(cli.main, list(map(str, words)), self.folder)

    def refused(self, status, text, *words):
        """Status and text, the same in JSON; nothing else on standard output, and no file."""
        before = sorted(self.folder.iterdir())
        for more in ((),) if "--json" in words else ((), ("--json",)):
            code, out, err = self.run_words(*words, *more)
            where = f"{(*words, *more)}: {code} {out} {err}"
            self.assertEqual(code, status, where)
            self.assertIn(text, err, where)
            self.assertNotRegex(err, r"\bjam_[a-z]", where)
            self.assertEqual(sorted(self.folder.iterdir()), before, where)
            if not more and "--json" not in words:
                self.assertEqual(out, "", where)
                continue
            said = json.loads(out)
            self.assertEqual(said["status"], status, where)
            self.assertIn(text, said["text"], where)
            self.assertLessEqual({"file", "n", "dim", "packing_fraction", "version"}, set(said), where)

    def cases(self):
        """Each option of each verb."""
        return ((verb, o) for verb in VERBS for o in ALL if verb.name in verbs_of(o) and o.name != "json")

    def begin(self, verb, o):
        return [verb.name] + ([self.file] if "input" in verb.files and o.name != "input" else [])

    def whole(self, verb, o):
        """The least command line of a verb that has something to do, without its option o."""
        words = {"input": self.file} if verb.name not in ("pack", "compress") and o.name != "resume" else {}
        words |= {"export": {"output": "a.data"}, "page": {"page": "p.html"}, "shear": {"to": "0.01", "output": "a.xyz"}}.get(verb.name, {})
        return [verb.name, *(w for name, value in words.items() if name != o.name for w in (f"--{name}", value))]

    def test_nothing_is_ignored(self):
        """An option without any of those that it needs, and beside each that leaves it without effect, in one verb that takes it."""
        named = {o.name: o for o in ALL}
        for verb, o in self.cases():
            if verb.name != verbs_of(o)[0]:
                continue
            more = {"shear": ["--to", "0.01"], "export": ["--output", "a.data"] if "output" not in o.needs else ["--profile", "z.csv"]}
            words, given = self.begin(verb, o) + more.get(verb.name, []), {"input"} if "input" in verb.files else set()
            text = "needs a law of --sizes" if o.name == "least-distance" else "has no effect"
            for other in (*set(o.without) - given, *[None] * bool(o.needs and not given & set(o.needs))):
                if other is None or verb.name in verbs_of(named[other]):
                    flags = [w for x in (o.name, other) if x for w in (f"--{x}", *good(named[x])[: named[x].kind != "switch"])]
                    with self.subTest(verb=verb.name, option=o.name, beside=other):
                        self.refused(USAGE, text, *words, *flags)

    def test_given_twice(self):
        for verb, o in self.cases():
            if o.kind == "stage":
                continue
            flags = [f"--{o.name}"] * 2 if o.kind == "switch" else [w for v in good(o) for w in (f"--{o.name}", v)]
            text = f"two files for --{o.name}" if o.kind in ("text", "input", "output") else f"--{o.name} is given twice"
            with self.subTest(verb=verb.name, option=o.name):
                self.refused(USAGE, text, *self.begin(verb, o), *flags)

    def test_wrong_value(self):
        for verb, o in self.cases():
            if o.kind == "switch":
                continue
            for value in wrong(o):
                with self.subTest(verb=verb.name, option=o.name, value=value):
                    self.refused(USAGE, f"--{o.name} is '{value}'", *self.begin(verb, o), f"--{o.name}={value}")

    def test_missing_value(self):
        for verb, o in self.cases():
            if o.kind != "switch":
                with self.subTest(verb=verb.name, option=o.name):
                    self.refused(USAGE, f"option '--{o.name}' lacks its value", verb.name, f"--{o.name}", "--json")

    def test_missing_file(self):
        for verb, o in self.cases():
            if o.kind not in ("input", "output"):
                continue
            ending = next(iter(re.findall(r"FILE(\.[a-z]+)", o.metavar)), {"voxels": ".npy", "plot": ".png"}.get(o.name, ""))
            path = self.folder / "none" / ("f" + ending)
            words = [*self.whole(verb, o), f"--{o.name}", path]
            status = OUTPUT if o.kind == "output" else USAGE if verb.name == "check" else REFUSED
            with self.subTest(verb=verb.name, option=o.name):
                if o.name == "report":  # has no effect beside --json
                    self.assertEqual(self.run_words(*words)[0], status)
                else:
                    self.refused(status, str(path), *words)

    def test_values_that_the_packing_refuses(self):
        """A value out of its range is a wrong command line, also where only the packing shows it."""
        for verb, text, *words in (
            ("export", "voxels", "--voxels", "v.npy", "--voxel-size", "1e-9"),
            ("export", "--stl-edge is '7'", "--stl", "m.stl", "--stl-edge", "7"),
            ("export", "--stl-bridge is '0.9'", "--stl", "m.stl", "--stl-bridge", "0.9"),
            ("export", "--voxels v.txt: no format is known", "--voxels", "v.txt"),
            ("page", "the file has 1", "page.html", "--box", "3"),
            ("info", "the file has 1", "--box", "3"),
            ("export", "the file has 1", "a.data", "--frame", "7"),
        ):
            self.refused(USAGE, text, verb, self.file, *words)

    def test_names_that_promise_compression(self):
        for verb, o in self.cases():
            if o.kind != "output" or o.gzip or o.name == "plot":
                continue
            with self.subTest(verb=verb.name, option=o.name):
                code, _, err = self.run_words(*self.whole(verb, o), f"--{o.name}", "f.csv.gz")
                self.assertEqual((code, "leave .gz out" in err), (USAGE, True), err)

    def test_a_checkpoint_is_no_packing(self):
        s = jam.System.random(8, 3, 1)
        s.write_checkpoint(str(self.folder / "c"))
        for verb in ("info", "check", "crunch"):
            status = USAGE if verb == "check" else REFUSED
            self.refused(status, "c is a checkpoint of libjam: --resume reads it", verb, "c")
        with self.assertRaisesRegex(jam.JamError, "System.from_checkpoint reads it"):
            jam.System.read(str(self.folder / "c"))

    def test_structure_between_walls(self):
        code, _, err = self.run_words(*"--n 20 --walls z --structure s.csv".split())
        self.assertEqual((code, (self.folder / "s.csv").exists()), (0, True), err)

    def test_export_says_that_nothing_touches(self):
        s = jam.System.from_arrays([[0.25, 0.25, 0.25], [0.75, 0.75, 0.75]], 0.4, cell=[1.0, 1.0, 1.0])
        s.write(str(self.folder / "loose.xyz"))
        for verb, words in (("export", ("--contacts", "c.csv")), ("page", ("p.html",))):
            code, out, err = self.run_words(verb, "loose.xyz", *words, "--json")
            said = json.loads(out)
            self.assertEqual((code, said["status"], said["network"], said["contacts"]), (0, 0, False, 0), err)
            self.assertTrue(any("no set of contacts" in note for note in said["notes"]), said)
            code, out, err = self.run_words(verb, "loose.xyz", *words)
            self.assertIn("0 contacts: no set of contacts", out)
            self.assertNotRegex(out + err, r"\bjam_[a-z]")

    def test_what_reading_assumed_stands_beside_its_consequence(self):
        (self.folder / "pts.csv").write_text("x,y,z,r\n0,0,0,0.5\n1,0,0,0.5\n0,1,0,0.5\n")
        for verb in ("check", "crunch"):
            code, _, err = self.run_words(verb, "pts.csv")
            self.assertEqual(code, USAGE if verb == "check" else REFUSED)
            self.assertIn("note: the file names no box: its side is taken as 1", err)

    def test_info_names_the_walls(self):
        s = jam.System.random(8, 3, 1, container="cylinder", walls="z")
        s.write(str(self.folder / "w.xyz"))
        self.assertIn("walls     a cylinder about z, flat walls at both ends of z\n", self.run_words("info", "w.xyz")[1])

    def test_a_mesh_without_bridges_says_so(self):
        code, _, err = self.run_words("export", "start.xyz", "--stl", "m.stl", "--stl-bridge", "0.2")
        self.assertEqual((code, "m.stl has no bridge" in err), (0, True), err)

    def test_a_mesh_of_loose_grains_needs_no_network(self):
        code, out, err = self.run_words("export", "start.xyz", "--stl", "m.stl")
        self.assertEqual((code, "network   none: the mesh joins no spheres" in out), (0, True), out)
        self.assertRegex(err, r"^[^:]+: the mesh has about \S+ triangles, \S+ [kM]B\n$")

    def test_a_table_is_no_list_of_diameters(self):
        """Every number of it would be a diameter."""
        sizes = self.folder / "sizes.txt"
        words = "pack --sizes sizes.txt --no-md --no-crunch --output o.xyz --quiet".split()
        for text, said in (
            ("1.5 0.3\n2 0.5\n", "has 2 columns"), ("0.5,0\n1,100\n", "has 2 columns"), ("0 0 0 1\n2 2 2 1\n", "has 4 columns"),
            ("size,share\n1,0.5\n2,0.5\n", "has 2 columns"), ("1;2\n", "has 2 columns"),
            ("1\n0x1\n", "line 2"), ("1\n2\0\n", "line 2"), ("1\n\0\n", "line 2"), ("1.61,\n2.34\n", "decimal point"),
            ('"1.5"\n2\n', "line 1"), ("-\n2\n", "line 1"),  # no heading, and no number
        ):
            sizes.write_text(text)
            code, _, err = self.run_words(*words)
            self.assertEqual((code, said in err), (REFUSED, True), repr(text) + err)
            for part in ("--sizes list:", "--sizes sieve:", "--input") if "columns" in said else ():
                self.assertIn(part, err)
        for text, ratio in (("radius\n1\n2\n", 2.0), ("\ufeffdiameter\r\n2\r\n3\r\n", 1.5), ("1\n\n# a\n3 # b", 3.0)):
            sizes.write_text(text, newline="")
            code, _, err = self.run_words(*words)
            self.assertEqual(code, 0, err)
            d = jam.System.read(self.folder / "o.xyz").diameters
            self.assertAlmostEqual(d.max() / d.min(), ratio, 12)
        sizes.write_text("1.5mm 0.3\n2 0.5\n")
        code, _, err = self.run_words("pack", "--n", "8", "--dim", "2", "--sizes", "list:sizes.txt", *words[3:])
        self.assertEqual((code, "line 1" in err), (REFUSED, True), err)
        code, _, err = self.run_words("compress", "--sizes", "list:1:0.5,1.4:0.5", "--output", "o.xyz")
        self.assertEqual((code, "joined by =" in err), (USAGE, True), err)

    def test_what_a_table_does_not_say(self):
        (self.folder / "t.txt").write_text("-1 -1 -3 7 .5\n1 1 3 7 .5\n")
        words = "export t.txt o.data --cell 4,4,8 --origin -2,-2,-4 --columns x,y,z,kind,radius"
        code, _, err = self.run_words(*words.split(), "--scale", "0.5", "--density", "2500")
        self.assertEqual(code, 0, err)
        made = (self.folder / "o.data").read_text()
        self.assertIn("0 4 zlo zhi", made)
        self.assertIn("2 1 0.5 2500 1.5 1.5 3.5", made)
        code, _, err = self.run_words(*words.replace("o.data", "o.xyz").split(), "--density", "2500")
        self.assertEqual((code, "extended XYZ has no place for a density" in err), (USAGE, True), err)
        code, _, err = self.run_words(*"info t.txt --cell 4,4,8".split())
        self.assertEqual((code, "option columns" in err), (REFUSED, True), err)
        code, _, err = self.run_words(*"info o.data --cell 4,4,8".split())
        self.assertEqual((code, "gives its cell" in err), (USAGE, True), err)

    def test_files_that_are_not_written_are_not_listed(self):
        s = jam.System.random(200, 3, 1)
        s.crunch()
        s.write(str(self.folder / "j.xyz"))
        code, _, err = self.run_words(*"export j.xyz --spectrum m.csv --modes 100000".split())
        rows = len((self.folder / "m.csv").read_text().splitlines()) - 1
        self.assertEqual((code, f"m.csv has {rows} modes: there are no more" in err), (0, True), err)
        found = set()
        for k in range(12):  # one of these limits lies between the network and the end of the spectrum
            for name in ("g.csv", "m.csv"):
                (self.folder / name).unlink(missing_ok=True)
            words = f"export j.xyz --gaps g.csv --spectrum m.csv --modes 0 --wall-time {1e-3 * 2**k}".split()
            for more in ([], ["--json"]):
                code, out, err = self.run_words(*words, *more)
                there = [name for name in ("m.csv", "g.csv") if (self.folder / name).exists()]
                self.assertEqual(json.loads(out)["written"] if more else re.findall("^  written +(.*)", out, re.M), there, err)
                self.assertEqual(code, 0 if len(there) == 2 else 1, err)
                found.add((*there, *more))
                for name in there:
                    (self.folder / name).unlink()
        self.assertLessEqual({("g.csv",), ("g.csv", "--json")}, found)

    def test_what_was_written_before_a_refusal_is_listed(self):
        """Pore sizes are refused where spheres leave no void, after the profile and before nothing."""
        x = [[0.25 + 0.5 * (k >> c & 1) for c in range(3)] for k in range(8)]
        s = jam.System.from_arrays(x, 0.9, cell=[1.0, 1.0, 1.0], overlap="allow")
        s.write(str(self.folder / "full.xyz"))
        words = "export full.xyz --profile z.csv --pores p.csv --output full.data".split()
        code, out, err = self.run_words(*words)
        self.assertEqual((code, "no void" in err), (REFUSED, True), err)
        self.assertEqual(sorted(re.findall("written +(.*)", out)), ["full.data", "z.csv"])
        self.assertEqual([(self.folder / name).exists() for name in ("full.data", "z.csv", "p.csv")], [True, True, False])
        code, out, err = self.run_words(*words, "--json")
        said = json.loads(out)
        self.assertEqual((code, said["status"], sorted(said["written"])), (REFUSED, REFUSED, ["full.data", "z.csv"]), err)
        self.assertIn("no void", said["text"])

    def test_narrow_starts(self):
        """A start by default may be lower, as may one at the density to grow to; a density that is given is met, or named."""
        ball = "--n 2 --seed 2 --cell 1,1,1 --container ball --quiet --output t.xyz --report t.json".split()  # the first blocks all
        for words in ((), ("--packing-fraction", "0.199"), ("--phi0", "0.1")):
            code, _, err = self.run_words("compress", *ball, *words)
            self.assertEqual(code, 0, err)
            notes = json.loads((self.folder / "t.json").read_text())["notes"]
            self.assertEqual(len(notes), int("--phi0" not in words), notes)
            self.assertIn("random start", "".join(notes) or "random start")
        code, _, err = self.run_words("compress", *ball, "--phi0", "0.2")
        self.assertEqual((code, "--phi0" in err), (REFUSED, True), err)

    def test_a_least_distance(self):
        """Surfaces of any two spheres are that far apart, half of it from walls; sizes and density are those asked for."""
        for words, free in (("--sizes equal:mean=1.4 --walls z", (0, 1)), ("--sizes lognormal:deviation=0.2 --container cylinder", (2,))):
            code, _, err = self.run_words(
                *f"compress --cell 7,7,8 {words} --porosity 0.65 --least-distance 0.125 --output l.xyz --report l.json --quiet".split()
            )
            self.assertEqual(code, 0, err)
            s = jam.System.read(str(self.folder / "l.xyz"))
            report = json.loads((self.folder / "l.json").read_text())
            self.assertAlmostEqual(report["diameter_mean"], report["diameter_mean_given"], 11)
            self.assertLess(abs(s.packing_fraction - 0.35) * s.info.volume, 3.1416 / 6 * s.diameters.max() ** 3)
            self.assertIn("shells of 0.0625", report["notes"][0])
            if "equal" in words:
                self.assertIn(f"the packing fraction is {s.packing_fraction:.9g}, requested was 0.35", report["notes"][1])
                self.assertLess(abs(s.diameters - 1.4).max(), 1e-11)
            else:
                self.assertAlmostEqual(s.packing_fraction, 0.35, 11)
            apart = s.positions[:, None] - s.positions
            for axis in free:
                apart[..., axis] -= s.cell[axis, axis] * np.rint(apart[..., axis] / s.cell[axis, axis])
            far = np.sqrt((apart**2).sum(-1)) - s.radii[:, None] - s.radii
            self.assertGreater(far[np.triu_indices(s.n, 1)].min(), 0.125 - 1e-11)
            height, x, y = s.positions[:, 2], *(s.positions[:, :2] - 3.5).T
            wall = np.minimum(height, 8 - height) if "walls" in words else 3.5 - np.hypot(x, y)
            self.assertGreater((wall - s.radii).min(), 0.0625 - 1e-11)
        for words, text in (
            ("compress --sizes equal:mean=1.4 --least-distance 0.3", "needs a law of --sizes"),
            ("compress --sizes equal:mean=1.4 --porosity 0.4 --cell 9,9,9 --least-distance 0.5", "in their shells"),
            ("compress --sizes equal --porosity 0.6 --box 9 --least-distance 0.1 --checkpoint c", "no effect beside --checkpoint"),
        ):
            code, _, err = self.run_words(*words.split(), "--output", "l.xyz")
            self.assertEqual((code in (2, 3), text in err), (True, True), err)

    def test_json_of_a_job_has_its_end(self):
        code, out, err = self.run_words(*"--n 20 --no-md --json --wall-time 1e-9".split())
        said = json.loads(out)
        self.assertEqual((code, said["status"]), (1, 1))
        self.assertEqual(said["text"].splitlines(), [re.sub(r"^[^:]*: ", "", line) for line in err.splitlines()])
        self.assertEqual((said["n"], said["dim"]), (20, 3))

    @unittest.skipUnless(os.path.exists("/proc/self/status"), "the system does not tell which signals are ignored")
    def test_signals_of_the_process_stay_its_own(self):
        """Python ignores SIGPIPE and SIGXFSZ; a report to a pipe, or to a file, leaves that."""

        def ignored():
            return re.search(r"SigIgn:\s*(\w+)", Path("/proc/self/status").read_text())[1]

        before, pipe = ignored(), self.folder / "pipe"
        os.mkfifo(pipe)
        reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
        for place in (pipe, self.folder / "r.json"):
            self.assertEqual(self.run_words("--n", 8, "--no-md", "--no-crunch", "--quiet", "--report", place)[0], 0)
            self.assertEqual(ignored(), before)
        os.close(reader)

    def test_what_python_draws_is_known_before_the_work(self):
        self.refused(USAGE, "--plot p.foo: no picture is drawn by this ending", "--n", "20", "--plot", "p.foo")

    def test_ensemble(self):
        for words in (
            "status D --n 4 --n 5",
            "run D --seeds 1-2 --seeds 3",
            "run D --seeds 1-2 --quiet --quiet",
            "run D --seeds 1 --workers 1 --workers 2",
            "export D E --shard 1 --shard 2",
        ):
            code, _, err = in_process(ensemble.main, words.split(), self.folder)
            self.assertEqual((code, "is given twice: leave one out" in err), (USAGE, True), err)
        for words in ("run D --seed 1-2", "export D E --shard 0"):
            self.assertEqual(in_process(ensemble.main, words.split(), self.folder)[0], USAGE)
        for status, words in ((REFUSED, "status D --json"), (USAGE, "status D --json --n x")):
            code, out, _ = in_process(ensemble.main, words.split(), self.folder)
            said = json.loads(out)
            self.assertEqual((code, said["status"]), (status, status))
            self.assertTrue(said["text"])
