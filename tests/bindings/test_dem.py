"""The input of LAMMPS on the guide's page "From a bed to CFD or DEM" runs the bed that libjam wrote."""
import contextlib
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import jam
import numpy as np

PAGE = Path(__file__).resolve().parents[2] / "bindings/docs/dem_cfd.md"


class Lammps(unittest.TestCase):
    @unittest.skipUnless(shutil.which("lmp"), "LAMMPS (Debian: lammps) is not installed")
    def test_the_bed_settles(self):
        page = PAGE.read_text()
        make, given = re.findall(r"^```python\n(.*?)^```$", page, flags=re.M | re.S)[0], re.findall(r"^```text\n(.*?)^```$", page, flags=re.M | re.S)[0]
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            exec(make.replace('bed.save("bed.h5")', ""), {})  # h5py is another test's
            bed = jam.System.read("bed.data", overlap="allow")
            Path("in.bed").write_text(given)
            done = subprocess.run(["lmp", "-in", "in.bed"], capture_output=True, text=True, timeout=300)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            settled = jam.System.read("settled.data", container="cylinder", walls="z", overlap="allow")
            masses = [line.split() for line in Path("settled.data").read_text().splitlines() if re.match(r"\d+ 1 \S+ \S+ \S+ \S+ \S+ ", line)]
        self.assertEqual((settled.n, settled.info.container.name), (200, "CYLINDER"))
        np.testing.assert_allclose(settled.diameters, bed.diameters, rtol=1e-12)
        np.testing.assert_allclose(settled.cell, bed.cell, rtol=1e-12)
        self.assertEqual({float(row[3]) for row in masses}, {2500.0})
        # gravity points to z = 0: 0.02 s of free fall would be 2 mm
        fall = (bed.positions - settled.positions)[:, 2].mean()
        self.assertTrue(0 < fall < 2.0e-3, fall)
        off = np.hypot(*(settled.positions[:, :2] - 0.5 * settled.cell[0, 0]).T)
        self.assertTrue((off + settled.radii < 0.5 * settled.cell[0, 0] * 1.01).all())  # overlaps of soft grains
        self.assertLess(settled.solid_profile(0, 1).solid[0], settled.packing_fraction)


if __name__ == "__main__":
    unittest.main()
