"""Studies on ensembles, on a few small packings: scripts run, keep what they made, and their rows hold what jamming demands."""
import importlib
import json
import random
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from packings import InFolder

HERE = Path(__file__).resolve().parents[2] / "examples" / "studies" / "ensembles"


def run(script, out, *options):
    folder = str(Path(out) / "packings")
    call = [sys.executable, "-B", str(HERE / (script + ".py")), "--folder", folder, "--out", str(out), *options]
    made = subprocess.run(call, capture_output=True, text=True, check=False)
    if made.returncode:
        raise AssertionError(made.stdout + made.stderr)
    found = json.loads((Path(out) / "results.json").read_text(encoding="utf-8"))[script]
    rows = [{"quantity": row[1], "published": row[2], "ours": row[3]} for row in found["rows"]]
    return found, {row["quantity"]: row for row in rows}, made.stdout


class Studies(InFolder):
    def test_disks(self):
        options = ("--sizes", "32", "64", "--particles", "640", "--workers", "2")
        found, rows, _ = run("disks", self.folder, *options)
        mean_z = next(row for name, row in rows.items() if "mean z" in name)
        # one state of self-stress in each packing; both sides are means, over packings or over spheres
        self.assertAlmostEqual(mean_z["ours"], float(mean_z["published"].removeprefix("exact: ")), delta=0.01)
        self.assertEqual(found["command"], "disks.py --sizes 32 64 --particles 640")
        _, again, _ = run("disks", self.folder, *options, "--only-read")
        self.assertEqual(again, rows)

    def test_sketches(self):
        _, rows, _ = run("sketches", self.folder, "--disks", "64", "--spheres", "64")
        # A linear constraint is sufficient for the exact one; the root of the collision is a contact.
        self.assertEqual(rows["points that the linear constraints allow and the exact ones do not"]["ours"], 0)
        self.assertGreaterEqual(rows["least distance over the diameter after one LP"]["ours"], 1 - 1e-12)
        self.assertLess(abs(rows["distance less the sum of radii at the collision"]["ours"]), 1e-14)
        self.assertEqual(rows["contacts above isostatic"]["ours"], 0)

    def test_both_sides_of_jamming(self):
        options = ("--sizes", "96", "--particles", "576")
        _, rows, _ = run("both_sides", self.folder, *options)
        # A crunch from just below the soft packing ends with its contacts and nearly its forces.
        self.assertGreater(rows["share whose crunch finds the same contacts, N = 96"]["ours"], 0.7)
        self.assertLess(rows["median over packings of the largest |f_soft - f_crunch| / mean, N = 96"]["ours"], 0.2)
        for side in ("below", "above"):
            self.assertAlmostEqual(rows[f"phi_J from {side}, N = 96"]["ours"], 0.64, delta=0.04)

    def test_limit_of_the_structure_factor(self):
        # Percus and Yevick: 1/S(0) = (1 + 2 phi)^2 / (1 - phi)^4 (Wertheim 1963); the fit towards q = 0 must find it within its error
        study = self.imported("liquid_structure")
        for phi in (0.2, 0.45):
            exact = (1 + 2 * phi) ** 2 / (1 - phi) ** 4
            self.assertAlmostEqual(1 - study.percus_yevick(np.array([1e-6]), phi)[0], exact, delta=1e-8 * exact)
            n = np.arange(1, 80)
            n = n[study.multiplicity(np.sqrt(n), 3) > 0]
            q, m = 0.55 * np.sqrt(n), study.multiplicity(np.sqrt(n), 3)
            noise = np.sqrt(0.03 / m)
            s = (1 + noise * np.random.default_rng(3).normal(size=len(q))) / (1 - study.percus_yevick(q, phi))
            value, error = study.limit(q, s, noise)
            self.assertLess(abs(value - exact), 4 * error)
            self.assertLess(error, 0.1 * exact)

    def test_linear_programs_of_another_solver(self):
        # HiGHS and the library end in the same packing from the same glass.
        study = self.imported("lp_tolerance")
        with study.jam.System.random(40, seed=3) as glass:
            glass.compress([(1e-2, 500.0), (3e-3, 1e7)])
            found = study.by_library(glass)
            pairs, _, phi, _ = study.by_lps(glass, 1e-9)
        self.assertIsNotNone(found)
        self.assertEqual(set(map(tuple, np.sort(pairs, axis=1).tolist())), set(map(tuple, np.sort(found[0], axis=1).tolist())))
        self.assertAlmostEqual(phi, found[2], delta=1e-8)

    def test_error_of_a_fit_of_the_glass_branch(self):
        # The error of phi_J is its scatter over draws of the noise; without the covariance it is larger by orders of magnitude.
        study, rng, p = self.imported("fit_error"), np.random.default_rng(5), 10 ** np.arange(5, 9, 0.25)
        found = np.array([study.fit(0.64 * (1 - 3 / p), p * (1 + 1e-2 * rng.normal(size=len(p)))) for _ in range(400)])
        phi_j, error, naive, d, r2 = found.T
        far = np.abs(phi_j - 0.64) / error
        self.assertAlmostEqual(np.mean(d), 1, delta=0.01)
        self.assertGreater(np.mean(r2), 0.99)
        # 1/p has errors in proportion to it, so the first points scatter most and the weights are not the best ones: within a factor of two
        self.assertTrue(0.25 < np.median(far) < 1.4, np.median(far))
        self.assertGreater(np.median(naive / error), 1e3)

    def test_coexistence_of_crystal_and_liquid(self):
        # Simulations give 0.4917 and 0.5433 (Frenkel and Smit); Hall's and Carnahan and Starling's equations are off by a few parts in a thousand.
        study = self.imported("thermodynamics")
        liquid, solid = study.densities()
        self.assertAlmostEqual(liquid, 0.492, delta=0.003)
        self.assertAlmostEqual(solid, 0.544, delta=0.003)
        self.assertAlmostEqual(liquid * study.carnahan_starling(liquid), solid * study.hall(solid), delta=1e-9)

    def test_final_network_is_that_of_the_weakest_contact(self):
        study = self.imported("final_network")
        found = study.grown("euclid", 64, 5)
        self.assertTrue(found["good"] and found["proved"])
        p = 10 ** study.threshold(found)
        with study.jam.System.random(64, seed=5) as packing:
            packing.compress([(1e-2, 500.0), (3e-3, 1e5), (1e-3, 30 * p)])
            packing.crunch()
            pairs = set(map(tuple, packing.contacts.pairs.tolist()))
            packing.compress([(1e-3, 300 * p)])
            packing.crunch()
            self.assertEqual(set(map(tuple, packing.contacts.pairs.tolist())), pairs)

    def test_commands_of_figures_at_random(self):
        # As printed but for one size less, from another folder: each writes a picture or a result there, and nothing into the checkout.
        studies = HERE.parent
        thesis = self.imported("thesis", studies)
        entries = json.loads((studies / "thesis.json").read_text(encoding="utf-8"))
        of_seconds = sorted({small for e in entries for small in thesis.commands(e).values() if small.split()[0] in thesis.SECONDS})
        self.assertGreater(len(of_seconds), 6)
        of_seconds = [small for small in of_seconds if not small.startswith("complexity.py")]  # test_complexity runs it
        before = {path: path.stat().st_mtime_ns for path in studies.rglob("*")}
        for small in random.Random(13).sample(of_seconds, 3):
            with self.subTest(command=small), tempfile.TemporaryDirectory() as here:
                _, script, *options = shlex.split(thesis.runnable(small).replace(" 64 128", " 128"))
                call = [sys.executable, "-B", str(studies.parents[1] / script), *options]
                made = subprocess.run([w.replace("PICTURE", "picture") for w in call], cwd=here, capture_output=True, text=True, check=False)
                self.assertEqual(made.returncode, 0, made.stdout + made.stderr)
                self.assertTrue([path for path in Path(here).rglob("*") if path.suffix in (".png", ".json")])
        self.assertEqual({path: path.stat().st_mtime_ns for path in studies.rglob("*")}, before)
        self.assertEqual([path.name for path in HERE.glob("*.py") if "out=HERE" in path.read_text(encoding="utf-8")], [])

    def test_commands_of_results_have_the_words_of_a_usage(self):
        # Words of a usage before its options: files, folders, or an option that has to be there.
        for folder in (HERE.parent, HERE):
            results = json.loads((folder / "results.json").read_text(encoding="utf-8"))
            for script, *given in (r["command"].split() for r in results.values() if ".py" in r["command"]):
                text = (folder / script).read_text(encoding="utf-8")
                usages = [u.split() for u in re.findall(rf"^(?:usage:|      ) {script}((?: [^\s\[]+)*)", text, re.MULTILINE)]
                fits = [len(u) <= len(given) and all(a[0] == b[0] for a, b in zip(u, given) if "-" in (a[0], b[0])) for u in usages]
                self.assertTrue(any(fits), (script, given, usages))

    def imported(self, name, folder=HERE):
        sys.path.insert(0, str(folder))
        self.addCleanup(sys.path.remove, str(folder))
        return importlib.import_module(name)

    def test_complexity(self):
        options = ("--sizes", "32", "64", "128", "--seeds", "2")
        _, rows, _ = run("complexity", self.folder, *options)
        work = rows["power of N of factorisations, kappa fixed, N = 32 to 128"]["ours"]
        self.assertTrue(0.0 < work < 2.0, work)
        _, again, said = run("complexity", self.folder, *options)
        self.assertEqual(again, rows)  # times too: nothing was made again
        self.assertNotIn("complexity: n", said)
