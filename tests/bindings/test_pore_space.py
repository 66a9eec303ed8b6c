"""The pore space: mesh, image, profiles, coordination and pore sizes, each against another way to compute it."""
import itertools
import math
import os
import struct
import subprocess
import tempfile
import unittest
from collections import Counter
from pathlib import Path

import jam
import numpy as np
from packings import InFolder

PACK = os.environ.get("JAM_PACK")


def triangles(path):
    """(count, 3, 3) corners of a binary STL file, as float32."""
    data = Path(path).read_bytes()
    (count,) = struct.unpack_from("<I", data, 80)
    assert len(data) == 84 + 50 * count
    records = np.frombuffer(data, np.dtype([("normal", "<f4", 3), ("corner", "<f4", (3, 3)), ("unused", "<u2")]), count, 84)
    return records["corner"]


def volume(corners):
    a, b, c = (corners.astype(float) - corners.astype(float).mean((0, 1))).transpose(1, 0, 2)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def open_edges(corners):
    """Directed edges that do not occur as often each way."""
    _, index = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    t = index.reshape(-1, 3)
    ways = Counter()
    for k in range(3):
        for a, b in zip(t[:, k].tolist(), t[:, (k + 1) % 3].tolist()):
            ways[min(a, b), max(a, b)] += 1 if a < b else -1
    return sum(abs(n) for n in ways.values())


def jammed(n=60, **options):
    s = jam.System.random(n, 3, 5, **options)
    s.compress(growth_rate=3e-2, pressure=1e5)
    s.crunch()
    return s


TILTED = [[1, 0, 0], [0.3, 1.1, 0], [0.2, -0.4, 0.9]]


class Mesh(InFolder):
    def setUp(self):
        super().setUp()
        self.path = self.folder / "p.stl"

    def mesh(self, s, **options):
        report = s.write_stl(str(self.path), **options)
        corners = triangles(self.path)
        self.assertEqual((report.triangles, report.bytes), (len(corners), self.path.stat().st_size))
        self.assertEqual(open_edges(corners), 0)
        self.assertAlmostEqual(volume(corners), report.volume, 9)
        sides = np.diag(s.cell)  # of the brick
        self.assertTrue((corners >= 0).all() and (corners <= sides.astype(np.float32)).all())
        return report

    def test_is_closed_and_its_volume_converges(self):
        s = jammed()
        for options, solid in (({}, s.packing_fraction), ({"contacts": "shrunk", "factor": 0.9}, 0.729 * s.packing_fraction)):
            lost = []
            for edge in (0.4, 0.2, 0.1):
                report = self.mesh(s, edge=edge, **options)
                self.assertAlmostEqual(report.solid, solid, 12)
                lost.append(1 - report.volume / report.solid)
            # corners lie on the spheres: less volume, by the square of the edge
            self.assertTrue(lost[0] > lost[1] > lost[2] > 0)
            self.assertLess(lost[2], lost[0] / 8)
            self.assertLess(lost[2], 0.3 * 0.1**2)

    def test_estimates_the_file_before(self):
        s = jammed()
        for options in ({}, {"edge": 0.1}, {"edge": 0.5}, {"contacts": "shrunk", "factor": 0.9}, {"contacts": "bridged"}):
            about, made = s.write_stl(None, **options), s.write_stl(str(self.path), **options)
            self.assertTrue(np.isnan([about.volume, about.solid]).all())
            self.assertEqual(about.bytes, 84 + 50 * about.triangles)
            # in a small cell most spheres are cut, and have up to twice the triangles of a whole one
            self.assertTrue(0.9 < about.triangles / made.triangles < 1.1, (options, about, made))

    def test_triangles_below_the_step_of_the_file_are_refused(self):
        with self.assertRaisesRegex(jam.JamError, "floats of an STL file"):
            jammed().write_stl(str(self.path), contacts="shrunk", factor=1e-5)

    def test_bridges(self):
        s = jammed()
        for bridge in (0.05, 0.2, 0.4):
            report = self.mesh(s, contacts="bridged", bridge=bridge, edge=0.15)
            self.assertEqual(report.bridges, len(s.contacts))
            self.assertLess(abs(report.volume / report.solid - 1), 0.012)

    def test_tilted_cells_and_sizes(self):
        s = jammed(40, cell=TILTED, diameters=jam.sizes("list", 40, curve=[(1, 0.5), (1.6, 0.5)]))
        for options in ({}, {"contacts": "bridged", "bridge": 0.15}, {"contacts": "shrunk"}):
            report = self.mesh(s, **options)
            self.assertLess(abs(report.volume / report.solid - 1), 0.03)

    def test_spheres_on_the_planes_of_the_cell(self):
        half = 0.5 - 1e-9
        s = jam.System.from_arrays([[0, 0, 0], [0, 0.5, 0.5], [0.5, 0, 0.5], [0.5, 0.5, 0]], np.sqrt(0.5) * (1 - 1e-15))
        self.mesh(s)
        s = jam.System.from_arrays([[half, 0, 0.25]], 0.9)
        self.mesh(s)

    def test_refusals(self):
        s = jam.System.random(20, packing_fraction=0.1)
        with self.assertRaises(jam.errors.StateError):
            s.write_stl(str(self.path), contacts="bridged")
        for options, text in (({"edge": 0.01}, "edge is 0.01"), ({"bridge": 0.5}, "bridge is 0.5"), ({"factor": 1.0}, "factor is 1")):
            with self.assertRaisesRegex(jam.errors.ArgumentError, text):
                s.write_stl(str(self.path), **options)
        with self.assertRaisesRegex(jam.errors.UnsupportedError, "d = 2"):
            jam.System.random(20, 2, packing_fraction=0.1).write_stl(str(self.path))
        self.assertFalse(self.path.exists())
        # a small sphere in the wedge of two large ones stands where their cylinder would be
        x = [[0.3, 0.5, 0.5], [0.7, 0.5, 0.5], [0.5, 0.5 + math.sqrt(0.22**2 - 0.2**2), 0.5]]
        s = jam.System.from_arrays(x, np.array([0.4, 0.4, 0.04]) * (1 - 1e-14))
        s.contacts_from_geometry()
        if len(s.contacts):
            with self.assertRaisesRegex(jam.errors.ArgumentError, "would meet"):
                s.write_stl(str(self.path), contacts="bridged", bridge=0.4)


class Image(unittest.TestCase):
    def test_porosity_is_exact_to_its_resolution(self):
        s = jammed()
        exact = 1 - s.packing_fraction
        shares = s.image(shape=(48, 48, 48), lines=8)
        self.assertLess(abs(1 - shares.mean(dtype=float) - exact), 2e-5)
        self.assertTrue(((shares >= 0) & (shares <= 1)).all())
        whole = s.image(shape=(48, 48, 48))
        self.assertEqual((whole.shape, whole.dtype), ((48, 48, 48), np.uint8))
        self.assertTrue((whole[shares == 1] == 1).all() and (whole[shares == 0] == 0).all())

    def test_centres_decide(self):
        s = jam.System.random(40, packing_fraction=0.3, cell=TILTED)
        image = s.image(size=0.05)
        sides = np.diag(s.cell)
        points = np.stack(np.meshgrid(*((np.arange(k) + 0.5) * side / k for k, side in zip(image.shape, sides)), indexing="ij"), -1)
        inside = np.zeros(image.shape, bool)
        shifts = np.array([[i, j, k] for i in (-2, -1, 0, 1, 2) for j in (-2, -1, 0, 1, 2) for k in (-1, 0, 1)]) @ s.cell
        for x, r in zip(s.positions, s.diameters / 2):
            for shift in shifts:
                inside |= ((points - x - shift) ** 2).sum(-1) < r * r
        np.testing.assert_array_equal(image == 1, inside)

    def test_files_say_the_same(self):
        s = jam.System.random(30, packing_fraction=0.3, cell=[1, 1.5, 2])
        image = s.image(size=0.1)
        self.assertEqual(image.shape, (10, 15, 20))
        with tempfile.TemporaryDirectory() as folder:
            npy, mha, vti, shares = (str(Path(folder, name)) for name in ("a.npy", "a.mha", "a.vti", "s.vti"))
            for path in (npy, mha, vti):
                report = s.write_voxels(path, size=0.1)
            s.write_voxels(shares, size=0.1, lines=2)
            self.assertEqual((report.nx, report.ny, report.nz, report.bytes), (10, 15, 20, 3000))
            self.assertAlmostEqual(report.porosity, 1 - image.mean(), 12)
            np.testing.assert_array_equal(np.load(npy), image)
            head, data = Path(mha).read_bytes().split(b"ElementDataFile = LOCAL\n")
            self.assertIn(b"DimSize = 10 15 20\n", head)
            np.testing.assert_array_equal(np.frombuffer(data, np.uint8).reshape(20, 15, 10).T, image)
            for path, kind, values in ((vti, b"UInt8", image), (shares, b"Float32", s.image(size=0.1, lines=2))):
                head, data = Path(path).read_bytes().split(b'<AppendedData encoding="raw">\n_')
                self.assertIn(b'WholeExtent="0 10 0 15 0 20" Origin="0 0 0" Spacing="0.1', head)
                self.assertIn(b'type="' + kind + b'" Name="solid" format="appended" offset="0"', head)
                data = data[: 8 + values.nbytes]
                self.assertEqual(data, values.nbytes.to_bytes(8, "little") + values.T.tobytes())

    def test_refusals(self):
        s = jam.System.random(20, packing_fraction=0.1)
        with self.assertRaisesRegex(ValueError, "shape must have 3"):
            s.image(shape=(3, 3))
        for none in (0, -3):
            with self.assertRaisesRegex(ValueError, "at least 1"):
                s.image(shape=(3, none, 3))
        with self.assertRaisesRegex(jam.errors.ArgumentError, "voxels"):
            s.image(size=1e-9)
        with self.assertRaisesRegex(jam.errors.UnsupportedError, r"\.npy.*\.mha.*\.vti"):
            s.write_voxels("/tmp/image.tif")


class Profiles(unittest.TestCase):

    def test_refusals(self):
        s = jam.System.random(20, packing_fraction=0.1)
        for axis, bins, error in ((3, 5, jam.errors.UnsupportedError), (4, 5, jam.errors.ArgumentError), (0, 0, jam.errors.ArgumentError)):
            with self.assertRaises(error):
                s.solid_profile(axis, bins)


class Pores(unittest.TestCase):
    def test_coordination_within_a_gap(self):
        s = jam.System.random(60, packing_fraction=0.35)
        x, sigma = s.positions, s.diameters
        d = x[:, None] - x
        d -= np.rint(d)
        gap = np.sqrt((d * d).sum(-1)) / (0.5 * (sigma[:, None] + sigma)) - 1
        np.fill_diagonal(gap, 9)
        np.testing.assert_array_equal(s.near_coordination(0.3), (gap < 0.3).sum(1))
        packed = jammed(40)
        stable = packed.coordination > 0
        np.testing.assert_array_equal(packed.near_coordination(1e-9)[stable], packed.coordination[stable])
        with self.assertRaises(jam.errors.ArgumentError):
            s.near_coordination(0.0)

    def test_one_sphere_in_a_cube(self):
        """The largest pore is about the middle, whatever the radius; a small sphere takes no memory for its size."""
        for dim, radius in itertools.product((2, 3), (1e-8, 1e-3, 0.02, 0.1, 0.2, 0.25, 0.3, 0.4, 0.5 - 1e-12)):
            s = jam.System.from_arrays([[0.0] * dim], radii=radius, box=1.0)
            p, widest = s.pore_sizes(3000 if radius > 0.4 else 50, 1), math.sqrt(dim) / 2 - radius
            x = np.stack([p.x, p.y] + [p.z] * (dim == 3), 1) - 0.5
            held = np.sqrt((x**2).sum(1)) < widest - 1e-9
            self.assertTrue(held.any())
            np.testing.assert_allclose(p.radius[held], widest, atol=1e-9)
            self.assertTrue((p.radius[~held] < widest + 1e-9).all() and (p.radius >= p.distance).all())

    def test_one_sphere_in_a_tube(self):
        """Spheres as wide as the tube fit above and below; a point between is in one of them or has a smaller radius."""
        for closed in ("", "z"):
            for a in (0.05, 0.2, 0.4):
                s = jam.System.from_arrays([[0.5, 0.5, 1.0]], 2 * a, cell=[1, 1, 4], container="cylinder", walls=closed)
                p = s.pore_sizes(200, 1)
                low, high = (0.5, 1.0 - a - 0.5) if closed else (1.0 + a + 0.5 - 4, 1.0 - a - 0.5)
                held = np.zeros(200, bool)
                for first, last in ((low, high), (1.0 + a + 0.5, 3.5 if closed else 5 - a - 0.5)):
                    if last < first:
                        continue
                    z = np.clip(p.z, first, last)
                    held |= (p.x - 0.5) ** 2 + (p.y - 0.5) ** 2 + (p.z - z) ** 2 < 0.25 - 1e-9
                self.assertTrue(held.any())
                np.testing.assert_allclose(p.radius[held], 0.5, atol=1e-9)
                self.assertTrue((p.radius[~held] < 0.5 + 1e-9).all())

    def test_a_solid_without_void_is_named(self):
        x = np.array(list(itertools.product((0.25, 0.75), repeat=3)))
        s = jam.System.from_arrays(x, 0.9, cell=np.eye(3), dim=3, overlap="allow")
        with self.assertRaisesRegex(jam.errors.StateError, "no void"):
            s.pore_sizes(5, 1)

    def test_seeds_and_refusals(self):
        s = jam.System.random(20, packing_fraction=0.3)
        a, b, c = (s.pore_sizes(50, seed) for seed in (1, 1, 2))
        self.assertTrue((a.x == b.x).all() and (a.x != c.x).all())
        with self.assertRaises(jam.errors.ArgumentError):
            s.pore_sizes(0, 1)


@unittest.skipUnless(PACK, "jam-pack is not built")
class Program(unittest.TestCase):
    def test_export(self):
        s = jammed(40)
        with tempfile.TemporaryDirectory() as folder:
            names = ("p.xyz", "p.stl", "p.npy", "profile.csv", "pores.csv", "z.csv")
            xyz, stl, npy, profile, pores, z = (str(Path(folder, name)) for name in names)
            s.write(xyz)
            words = f"export {xyz} --stl {stl} --stl-bridge 0.2 --voxels {npy} --voxel-size 0.02 --profile {profile} --profile-bins 5 "
            words += f"--pores {pores} --pore-points 50 --near-coordination {z} --near-gap 1e-6"
            done = subprocess.run([PACK, *words.split()], capture_output=True, text=True, timeout=120)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("50 x 50 x 50 voxels, 125 kB", done.stderr)
            self.assertEqual(open_edges(triangles(stl)), 0)
            np.testing.assert_array_equal(np.load(npy), s.image(size=0.02))
            rows = np.genfromtxt(profile, delimiter=",", names=True, dtype=None, encoding="ascii")
            self.assertEqual("".join(rows["axis"]), "x" * 5 + "y" * 5 + "z" * 5)
            np.testing.assert_array_equal(rows["solid"][5:10], s.solid_profile(1, 5).solid)
            np.testing.assert_array_equal(np.genfromtxt(pores, delimiter=",", names=True)["radius"], s.pore_sizes(50, 1).radius)
            np.testing.assert_array_equal(np.genfromtxt(z, delimiter=",", names=True)["z"], s.near_coordination(1e-6))
