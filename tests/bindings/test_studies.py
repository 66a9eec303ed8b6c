"""Studies on ensembles, on a few small packings: scripts run, keep what they made, and their rows hold what jamming demands."""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parents[2] / "examples" / "studies" / "ensembles"


def run(script, out, *options):
    folder = str(Path(out) / "packings")
    call = [sys.executable, "-B", str(HERE / (script + ".py")), "--folder", folder, "--out", str(out), *options]
    made = subprocess.run(call, capture_output=True, text=True, check=False)
    if made.returncode:
        raise AssertionError(made.stdout + made.stderr)
    found = json.loads((Path(out) / "results" / (script + ".json")).read_text(encoding="utf-8"))
    return found, {row["quantity"]: row for row in found["rows"]}, made.stdout


class Studies(unittest.TestCase):
    def setUp(self):
        self.out = tempfile.TemporaryDirectory()
        self.addCleanup(self.out.cleanup)

    def test_disks(self):
        options = ("--sizes", "32", "64", "--particles", "640", "--workers", "2")
        found, rows, _ = run("disks", self.out.name, *options)
        mean_z = next(row for name, row in rows.items() if "mean z" in name)
        # one state of self-stress in each packing; both sides are means, over packings or over spheres
        self.assertAlmostEqual(mean_z["ours"], float(mean_z["published"].removeprefix("exact: ")), delta=0.01)
        self.assertEqual(found["command"], "disks.py --sizes 32 64 --particles 640")
        self.assertEqual([s["protocol"]["start"]["n"] for s in found["sets"]], [32, 64])
        _, again, _ = run("disks", self.out.name, *options, "--only-read")
        self.assertEqual(again, rows)

    def test_sketches(self):
        _, rows, _ = run("sketches", self.out.name)
        # A linear constraint is sufficient for the exact one; the root of the collision is a contact.
        self.assertEqual(rows["points that the linear constraints allow and the exact ones do not"]["ours"], 0)
        self.assertGreaterEqual(rows["least distance over the diameter after one LP"]["ours"], 1 - 1e-12)
        self.assertLess(abs(rows["distance less the sum of radii at the collision"]["ours"]), 1e-14)
        self.assertEqual(rows["contacts above isostatic"]["ours"], 0)

    def test_both_sides_of_jamming(self):
        options = ("--sizes", "96", "--particles", "576")
        _, rows, _ = run("both_sides", self.out.name, *options)
        # A crunch from just below the soft packing ends with its contacts and nearly its forces.
        self.assertGreater(rows["share whose crunch finds the same contacts, N = 96"]["ours"], 0.7)
        self.assertLess(rows["median over packings of the largest |f_soft - f_crunch| / mean, N = 96"]["ours"], 0.2)
        for side in ("below", "above"):
            self.assertAlmostEqual(rows[f"phi_J from {side}, N = 96"]["ours"], 0.64, delta=0.04)

    def test_complexity(self):
        options = ("--sizes", "32", "64", "128", "--seeds", "2")
        _, rows, _ = run("complexity", self.out.name, *options)
        work = rows["power of N of factorisations, kappa fixed, N = 32 to 128"]["ours"]
        self.assertTrue(0.0 < work < 2.0, work)
        _, again, said = run("complexity", self.out.name, *options)
        self.assertEqual(again, rows)  # times too: nothing was made again
        self.assertNotIn("complexity: n", said)


if __name__ == "__main__":
    unittest.main()
