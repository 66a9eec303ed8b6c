"""The table of options and all that is made from it: help, manual page, completion, the guide's page; log and progress."""
import gzip
import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import jam

PACK = os.environ.get("JAM_PACK")
ROOT = Path(__file__).resolve().parents[2]
COMPLETION = Path(PACK or ".").parent / "bindings/cli/options/cli"


def names(text):
    return set(re.findall(r"(?<![\w-])--[a-z][\w-]*", text))


@unittest.skipUnless(PACK, "jam-pack is not built")
class Options(unittest.TestCase):
    def pack(self, *arguments, **more):
        return subprocess.run([PACK, *arguments], capture_output=True, text=True, timeout=120, **more)

    def test_every_text_has_every_option(self):
        mine = names(self.pack("--help").stdout)
        self.assertIn("--method", mine)
        manual = gzip.decompress((Path(PACK).parent / "bindings/cli/jam-pack.1.gz").read_bytes()).decode()
        self.assertEqual(names(manual.replace("\\-", "-")), mine)
        self.assertEqual(names((COMPLETION / "_jam-pack").read_text()), mine)
        self.assertEqual(names((COMPLETION / "jam-pack.bash").read_text()), mine)
        page = (ROOT / "bindings/docs/command_line.md").read_text()
        self.assertEqual({"--" + n for n in re.findall(r"^- `--([\w-]+)", page, re.M)}, mine | {"--plot"})

    def complete(self, *words):
        script = (
            f". {COMPLETION}/jam-pack.bash; COMP_WORDS=(jam-pack {' '.join(words)}); "
            f'COMP_CWORD={len(words)}; _jam_pack; echo "${{COMPREPLY[@]}}"'
        )
        return subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True).stdout.split()

    def test_bash_completes(self):
        self.assertEqual(self.complete("--str"), ["--strain", "--stress", "--structure", "--strict-proof", "--strict"])
        self.assertEqual(self.complete("--method", "s"), ["sequential-lp"])
        self.assertEqual(self.complete("--strain", "t"), ["tilts"])
        self.assertEqual(self.complete("--input", str(ROOT / "CHANGE")), [str(ROOT / "CHANGELOG.md")])
        self.assertEqual(self.complete("--seed", "1"), [])
        self.assertEqual(self.complete("cr"), ["crunch"])
        self.assertEqual(self.complete("check", "--pro"), ["--prove", "--proof"])
        self.assertEqual(self.complete("check", "--gro"), [])

    def test_the_published_quench_and_its_report(self):
        said = self.pack(*"--n 64 --no-md --seed 3 --method sequential-lp --report -".split())
        report = json.loads(said.stdout)
        self.assertEqual(report["method"], "sequential_lp")
        self.assertEqual(report["lp_solver"], "ipm")
        self.assertEqual(report["options"][-4:], ["--method", "sequential-lp", "--report", "-"])
        self.assertEqual(report["protocol"], [{"stage": "crunch", "method": "sequential_lp", "strain": "none"}])
        s = jam.System.random(64, 3, 3)
        s.crunch(method="sequential_lp")
        self.assertEqual(report["packing_fraction"], s.packing_fraction)

    def test_a_strained_packing(self):
        with tempfile.TemporaryDirectory() as folder:
            out = f"{folder}/s.data"
            self.pack(*f"--n 64 --dim 2 --diameters-ratio 1.4 --no-md --strain free --quiet --output {out}".split())
            s = jam.System.read(out)
            s.contacts_from_geometry()
            self.assertEqual(s.rigidity("strict").jammed, jam.Verdict.YES)
            again = self.pack("crunch", out, "--strain", "free", "--json")
            report = json.loads(again.stdout)
            self.assertEqual((report["jammed"], report["strictly_jammed"]), (True, True))
            self.assertIsNone(report["seed"])  # nothing was random
            shown = self.pack("crunch", out, "--strain", "free").stdout
            self.assertIn("crunch    strictly jammed (converged)", shown)
            self.assertNotIn("seed", shown)
            self.assertIsNone(json.loads(self.pack("crunch", out, "--json").stdout)["strictly_jammed"])
            refused = self.pack("--strain", "free", "--output", f"{folder}/s.dat")
            self.assertEqual((refused.returncode, "no cells but cubes" in refused.stderr), (2, True))

    def test_log(self):
        with tempfile.TemporaryDirectory() as folder:
            log = Path(folder, "log")
            self.pack("--n", "64", "--no-md", "--quiet", "--log", str(log))
            lines = log.read_text().splitlines()
        self.assertTrue(all(re.match(r" *\d+\.\d{3} (info|warning) \S", line) for line in lines), lines)
        self.assertTrue(any("LP 1: gain" in line for line in lines))

    def test_a_line_now_and_then_in_a_pipe(self):
        said = self.pack(*"--n 4000 --growth 1e-5:1e9 --no-crunch --wall-time 13".split())
        self.assertRegex(said.stderr, r"^4000 spheres in d = 3\ngrowth 1e-05  p [\d.]+  phi 0\.\d+ .* 1\d\.\d s  \d+ %, .* s left \(.*\)\n")
        self.assertNotIn("\r", said.stderr)
