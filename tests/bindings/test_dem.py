"""The inputs on the guide's page "From a bed to CFD or DEM" let LAMMPS and LIGGGHTS settle the bed that libjam wrote; the
factors of the page "Units" give pascals."""
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
GRAVITY = 9.81


def rows_of(path, section):
    """The numbers of a section of a data file, sorted by the number of the atom."""
    text = Path(path).read_text()
    rows = re.search(rf"^{section}.*\n\n((?:.+\n)+)", text, flags=re.M)[1]
    table = np.array([line.split() for line in rows.splitlines()], dtype=float)
    return table[table[:, 0].argsort()]


class Settling(unittest.TestCase):
    def settle(self, program, output):
        blocks = re.findall(r"^```(python|sh)\n(.*?)^```$", PAGE.read_text(), flags=re.M | re.S)
        (lines,) = (block for kind, block in blocks if kind == "sh" and f"{program} -in" in block)
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            exec(blocks[0][1].replace('bed.save("bed.h5")', ""), {})  # h5py is another test's
            bed = jam.System.read("bed.data")
            done = subprocess.run(["sh", "-eu", "-c", lines], capture_output=True, text=True, timeout=250)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            settled = jam.System.read(output, container="cylinder", walls="z", overlap="allow")
            atoms, motion = rows_of(output, "Atoms"), rows_of(output, "Velocities")
        self.assertEqual((settled.n, bed.info.container.name, settled.info.container.name), (200, "CYLINDER", "CYLINDER"))
        np.testing.assert_allclose(settled.diameters, bed.diameters, rtol=1e-12)
        np.testing.assert_allclose(settled.cell, bed.cell, rtol=1e-12)
        self.assertEqual(set(atoms[:, 3]), {2500.0})
        # Grains fell to z = 0 and rest there: of the energy that gravity set free next to nothing is left as motion.
        mass = 2500.0 * np.pi / 6 * bed.diameters**3
        free = GRAVITY * (mass * (bed.positions - settled.positions)[:, 2]).sum()
        self.assertGreater(free, 0)
        self.assertLess((0.5 * mass * (motion[:, 1:4] ** 2).sum(1)).sum(), 1e-4 * free)
        # A grain at rest touches something; soft grains overlap by less than 1 per cent of their diameter.
        settled.contacts_by_distance(1e-9)
        self.assertGreaterEqual(settled.coordination.min(), 1)
        wall = settled.contacts.pairs[:, 1] < 0  # gaps there are in radii
        self.assertGreater((settled.contacts.gaps / np.where(wall, 2, 1)).min(), -0.01)
        self.assertLess(settled.solid_profile(0, 1).solid[0], settled.packing_fraction)

    @unittest.skipUnless(shutil.which("lmp"), "LAMMPS (Debian: lammps) is not installed")
    def test_by_lammps(self):
        self.settle("lmp", "settled.data")

    @unittest.skipUnless(shutil.which("liggghts"), "LIGGGHTS (Debian: liggghts) is not installed")
    def test_by_liggghts(self):
        self.settle("liggghts", "settled.liggghts")


class Units(unittest.TestCase):
    def test_springs_give_pascals(self):
        """P = sum of f r / (d V), with forces in newton and lengths in metre."""
        stiffness, grain = 1e3, 1e-3
        for dim, density in ((3, 0.7), (2, 0.9)):
            soft = jam.System.random(128, dim, seed=1, packing_fraction=density, overlap="allow")
            report = soft.relax(scale="absolute")
            unit = grain / soft.diameters.mean()
            d = unit * (soft.positions[:, None] - soft.positions)
            d -= unit * np.rint(d / unit)
            r = np.sqrt((d**2).sum(-1))[np.triu_indices(128, 1)]
            expected = (stiffness * np.maximum(0, grain - r) * r).sum() / (dim * unit**dim)
            self.assertGreater(expected, 0)
            self.assertAlmostEqual(report.pressure * stiffness / unit ** (dim - 2) / expected, 1, 12)
