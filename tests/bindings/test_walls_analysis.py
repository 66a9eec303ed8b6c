"""Strict jamming, elastic moduli, slides and files of scenes with walls, against numpy and scipy."""
import importlib.util
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import jam
import numpy as np
from scipy.optimize import linprog
from wall_scenes import SCENES, contact_rows, start


def strict_rows(s):
    """Rows n . (u_i - u_j + eps r_ij) of the contacts, with the traceless strains of x and y."""
    rows, length = contact_rows(s)
    a, b = s.contacts.vectors.T[:2]
    return np.column_stack([rows, length * (a * a - b * b), length * 2 * a * b])


class Strict(unittest.TestCase):
    def test_with_fewer_than_two_open_axes_it_is_the_collective_test(self):
        for name in ("lines", "box", "circle", "tube", "can", "ball"):
            s = start(name, 20, 1, unequal=True)
            self.assertTrue(s.crunch().jammed)
            collective, strict = s.rigidity(), s.rigidity("strict")
            self.assertEqual((strict.jammed, strict.contacts_needed), (1, collective.contacts_needed), name)
            self.assertEqual(s.check().strictly_jammed, strict.jammed, name)  # one answer

    def test_slits_agree_with_a_linear_program(self):
        # Jammed: no motion keeps all contacts closed or open, and opens one. The strain of the plane of the slit is traceless.
        answers = set()
        for seed in range(1, 9):
            s = jam.System.random(n=14, seed=seed, packing_fraction=0.2, cell=[1, 1, 0.8], walls="z", diameters=1 + 0.4 * (0.618 * np.arange(14) % 1))
            if not s.crunch().jammed:
                continue
            strict = s.rigidity("strict")
            rows = strict_rows(s)
            if strict.stable:
                self.assertEqual(strict.contacts_needed, 3 * strict.stable - 2 + 2 + 1)
            total = linprog(-rows.sum(0), A_ub=-rows, b_ub=np.zeros(len(rows)), bounds=(-1, 1)).fun
            stable = s.coordination > 0
            columns = np.concatenate([np.repeat(stable, 3), [True, True]])
            free = columns.sum() - np.linalg.matrix_rank(rows[:, columns], tol=1e-8) - 2
            expected = total > -1e-7 and free == 0
            answers.add(expected)
            self.assertEqual(strict.jammed, int(expected), seed)
            self.assertEqual(s.check().strictly_jammed, int(expected))
            if not expected:
                motion, strain = s.flex("strict")
                self.assertAlmostEqual(np.trace(strain), 0, 12)
                np.testing.assert_array_equal(strain[2], 0)
                np.testing.assert_array_equal(strain[:, 2], 0)
                opened = rows @ np.concatenate([motion.ravel(), [(strain[0, 0] - strain[1, 1]) / 2, strain[0, 1]]])
                self.assertGreater(opened.min(), -1e-8)
        self.assertIn(False, answers)  # a fixed cell supports no shear of its plane


class Elasticity(unittest.TestCase):
    def test_tensor_of_open_axes_is_the_curvature_of_the_relaxed_energy(self):
        for scene in ({"walls": "z", "cell": [1, 1, 0.9]}, {"container": "cylinder", "cell": [1, 1, 2]}):
            s = jam.System.random(n=60, seed=3, packing_fraction=0.2, diameters=1 + 0.4 * (0.618 * np.arange(60) % 1), **scene)
            self.assertTrue(s.crunch().jammed)
            tensor = s.elastic_tensor().relaxed
            c, axes = s.contacts, [k for k in range(3) if k not in ((2,) if "walls" in scene else (0, 1))]
            rows, length = contact_rows(s)
            rows = rows[:, (3 * s.hessian_map()[:, None] + np.arange(3)).ravel()]
            np.testing.assert_allclose(rows.T @ rows, s.hessian().toarray(), atol=1e-12)
            for a in range(3):
                for b in range(3):
                    if a not in axes or b not in axes:
                        self.assertTrue(np.isnan(tensor[a, b]).all() and np.isnan(tensor[:, :, a, b]).all())
                        continue
                    stretch = length * c.vectors[:, a] * c.vectors[:, b]
                    left = stretch - rows @ np.linalg.lstsq(rows, stretch, rcond=1e-9)[0]
                    self.assertAlmostEqual(left @ left / s.info.volume / tensor[a, b, a, b], 1, 6)
            if len(axes) == 2:
                m = s.moduli()
                self.assertTrue(np.isnan(m.bulk))
                self.assertAlmostEqual(m.shear / tensor[0, 1, 0, 1], 1, 9)
            else:
                with self.assertRaisesRegex(jam.errors.UnsupportedError, "this scene has 1"):
                    s.moduli()


class Slides(unittest.TestCase):
    def test_disks_around_a_disk_in_the_middle_slide(self):
        # Radius of the circle = 3 a: one disk in the middle, five between it and the wall.
        found = False
        for seed in range(1, 13):
            s = jam.System.random(n=6, dim=2, seed=seed, packing_fraction=0.15, container="ball")
            r = s.crunch()
            if r.jammed or abs(s.cell[0, 0] / s.diameters[0] - 3) > 1e-9:
                continue
            found = True
            self.assertEqual((r.stationary, r.stop_reason), (1, jam.StopReason.SADDLE))
            self.assertIn("slide past each other", jam.raw.jam_last_error())
            self.assertEqual((s.rigidity().jammed, s.check().jammed, s.check().reason), (0, 0, jam.CheckReason.SLIDE))
        self.assertTrue(found)

    def test_a_sphere_leaves_its_ring_along_the_tube(self):
        """Five spheres at the wall surround a sixth. Walls bend inward, but no motion along the tube meets them."""
        for angles in (2 * np.pi / 5 * np.arange(5), np.array([0, 1.25, 2.5, 3.75, 5.0])):
            ring = np.column_stack([1.5 + np.cos(angles), 1.5 + np.sin(angles), np.full(5, 1.0)])
            s = jam.System.from_arrays(np.vstack([ring, [1.5, 1.5, 1.0]]), 1.0, cell=[3, 3, 2], container="cylinder", dim=3)
            c = s.check(crunch=False)
            self.assertEqual((c.jammed, c.stationary, c.reason), (0, 1, jam.CheckReason.FLEX))
            s.contacts_from_geometry()
            motion = s.flex()[0]
            for t in (1e-3, 1e-2, 0.1):  # a finite motion keeps or opens every distance
                y = s.positions + t * motion
                between = np.linalg.norm(y[:, None] - y[None], axis=2)[np.triu_indices(6, 1)]
                self.assertGreater(between.min(), 1 - 1e-9)
                self.assertLess(np.linalg.norm(y[:, :2] - 1.5, axis=1).max(), 1 + 1e-9)
                self.assertGreater(np.sort(between)[:10].max(), 1 + 1e-8)
            self.assertTrue(s.crunch().jammed)
            self.assertGreater(s.packing_fraction, 0.25)

    def test_spheres_that_fill_a_slit_slide(self):
        """Each touches both walls and no other sphere: no motion lets the diameters grow. Along an axis with walls, which they
        do not touch, all three move on their own; along another one the motion of all together is none."""
        disks, spheres = [[0.5, 0.7], [0.5, 2.0], [0.5, 3.1]], [[0.7, 0.6, 0.5], [2.0, 1.7, 0.5], [1.2, 2.9, 0.5]]
        for x, cell, walls, slides in (
            (disks, [1, 4], "xy", 3),
            (spheres, [3, 4, 1], "z", 4),
            (spheres, [3, 4, 1], "xz", 5),
        ):
            s = jam.System.from_arrays(x, 1.0, cell=cell, walls=walls, dim=len(cell))
            c = s.check(crunch=False)
            self.assertEqual((c.jammed, c.stationary, c.reason, c.flexes), (0, 1, jam.CheckReason.SLIDE, slides))
            self.assertIn(f"slide past each other in {slides} ways", str(c))
            before = s.positions.copy()
            r = s.crunch()
            self.assertEqual((r.jammed, r.stop_reason, r.contacts), (0, jam.StopReason.SADDLE, 2 * s.n))
            self.assertEqual(r.decompressions, 0)
            self.assertLess(abs(s.positions - before).max(), 0.02)
            self.assertIn("slide past each other", jam.raw.jam_last_error())
            self.assertGreater(np.ptp(s.flex()[0], axis=0).max(), 0.1)

    def test_a_column_across_a_slit_opens(self):
        """Two disks, one on the other, bulge sideways, and the diameters grow: no slide."""
        s = jam.System.from_arrays([[0.25, 1.0], [0.75, 1.0]], 0.5, cell=[1, 2], walls="x", dim=2)
        self.assertEqual(s.check(crunch=False).reason, jam.CheckReason.FLEX)
        # with a disk that fills the slit its slide is one flex, the bulge another
        s = jam.System.from_arrays([[0.25, 1.0], [0.75, 1.0], [0.5, 3]], [0.5, 0.5, 1.0], cell=[1, 4], walls="x", dim=2)
        c = s.check(crunch=False)
        self.assertEqual((c.reason, c.flexes), (jam.CheckReason.FLEX, 2))


class Files(unittest.TestCase):
    def test_h5md_says_which_axes_repeat(self):
        import h5py

        for name, expected in (("slit", [False, False, True]), ("can", [True] * 3), ("circle", [True] * 2)):
            with tempfile.TemporaryDirectory() as folder:
                start(name, 25, 2).save(Path(folder, "a.h5"))
                with h5py.File(Path(folder, "a.h5")) as file:
                    self.assertEqual([b in ("none", b"none") for b in file["particles/spheres/box"].attrs["boundary"]], expected)
                    self.assertEqual(file["jam"].attrs["container"], SCENES[name].get("container", "brick"))

    def test_vtp_names_the_container_in_its_fields(self):
        s = start("can", 20, 3)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "a.vtp")
            s.write(path)
            text = path.read_bytes().split(b"<AppendedData")[0].decode()
        fields = text.split("<FieldData>")[1].split("</FieldData>")[0]
        words = ["".join(chr(int(n)) for n in block.split(">")[1].split("<")[0].split()[:-1]) for block in fields.split("<DataArray")[1:3]]
        self.assertEqual(words, ["cylinder", "F F T"])

    @unittest.skipUnless(importlib.util.find_spec("ase"), "needs python3-ase")
    def test_ase_keeps_walls(self):
        for name in ("slit", "tube", "circle"):
            s = start(name, 12, 3)
            atoms = s.to_ase()
            back = jam.System.from_ase(atoms, dim=s.dim)
            self.assertEqual((back.info.container, back.info.walls), (s.info.container, s.info.walls))
            np.testing.assert_array_equal(back.positions, s.positions)
            atoms.pbc = True
            with self.assertRaisesRegex(ValueError, "pbc is"):
                jam.System.from_ase(atoms, dim=s.dim)


@unittest.skipUnless("JAM_PACK" in os.environ, "needs jam-pack")
class CommandLine(unittest.TestCase):
    def test_tables_of_walled_packings(self):
        with tempfile.TemporaryDirectory() as folder:
            options = ["--n", "40", "--container", "ball", "--quiet", "--output", f"{folder}/a.data", "--structure", f"{folder}/s.csv", "--gaps", f"{folder}/g.csv"]
            made = subprocess.run([os.environ["JAM_PACK"], *options], capture_output=True, text=True, check=False)
            self.assertEqual(made.returncode, 0, made.stderr)
            s = jam.System.read(f"{folder}/a.data")
            self.assertEqual(s.info.container, 2)
            report = s.crunch()
            self.assertTrue(report.jammed)
            rows = np.genfromtxt(f"{folder}/g.csv", delimiter=",", skip_header=1)
            coordination = np.genfromtxt(f"{folder}/s.csv", delimiter=",", skip_header=1, usecols=1)
            wall = rows[:, 1] < 0
            self.assertTrue(wall.any())
            np.testing.assert_array_equal(rows[wall, 3], coordination[rows[wall, 0].astype(int)] > 0)
