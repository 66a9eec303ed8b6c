"""Files of other programs: each number comes from where the file names it, or the file is refused with a way out."""
import importlib.util
import json
import os
import pickle
import subprocess
import sys
import unittest
import unittest.mock
import warnings
from types import SimpleNamespace

import numpy as np

import jam
from packings import InFolder

warnings.simplefilter("ignore")


def available(name):
    return importlib.util.find_spec(name) is not None


class Folder(InFolder):
    def setUp(self):
        super().setUp()
        self.path = str(self.folder / "f.gsd")

    def refused(self, words, call, *args, kind=ValueError, **named):
        with self.assertRaises(kind) as told:
            call(*args, **named)
        for word in words:
            self.assertIn(word, str(told.exception))


@unittest.skipUnless(available("gsd"), "python3-gsd is not installed")
class Gsd(Folder):
    """Two types of spheres on a cubic lattice of spacing 2."""

    def frame(self, dim=3):
        import gsd.hoomd

        g = np.arange(4) * 2.0 - 3.0
        x = np.stack(np.meshgrid(*[g] * dim, indexing="ij"), -1).reshape(-1, dim)
        f = gsd.hoomd.Snapshot()
        f.configuration.dimensions = dim
        f.configuration.box = [8, 8, 8 if dim == 3 else 1, 0, 0, 0]
        f.particles.N = len(x)
        f.particles.position = np.pad(x, ((0, 0), (0, 3 - dim)))
        f.particles.types = ["A", "B"]
        f.particles.typeid = np.arange(len(x)) % 2
        return f

    def write(self, *frames):
        import gsd.hoomd

        with gsd.hoomd.open(self.path, "wb") as file:
            file.extend(frames)

    def want(self, n=64):
        return np.where(np.arange(n) % 2, 0.9, 0.6)

    def test_diameters_by_type(self):
        for dim, shape, measure in ((3, "Sphere", np.pi / 6), (2, "Disk", np.pi / 4)):
            f = self.frame(dim)
            f.particles.type_shapes = [{"type": shape, "diameter": 0.6}, {"type": shape, "diameter": 0.9}]
            self.write(f)
            s = jam.System.read(self.path)
            np.testing.assert_array_equal(s.diameters, self.want(4**dim))
            self.assertAlmostEqual(s.packing_fraction, measure * (0.6**dim + 0.9**dim) * 4**dim / 2 / 8**dim, 14)

    def test_radii_of_the_state(self):
        f = self.frame()
        f.state = {"hpmc/sphere/radius": np.array([0.3, 0.45], "f4")}
        later = self.frame()  # the state stands in frame 0 alone
        later.configuration.step = 10
        self.write(f, later)
        for k in (0, 1):
            np.testing.assert_allclose(jam.System.read(self.path, frame=k).diameters, self.want(), rtol=1e-7)

    def test_two_places_that_disagree(self):
        f = self.frame()
        f.particles.type_shapes = [{"type": "Sphere", "diameter": 0.6}, {"type": "Sphere", "diameter": 0.9}]
        f.particles.diameter = np.full(64, 0.6)
        self.write(f)
        self.refused(["sphere 1", "type_shapes", "give diameters="], jam.System.read, self.path)
        np.testing.assert_array_equal(jam.System.read(self.path, diameters=0.6).diameters, 0.6)

    def test_frames_that_are_refused(self):
        ellipsoids, unit, empty = (self.frame() for _ in range(3))
        ellipsoids.particles.type_shapes = [{"type": "Ellipsoid", "a": 0.6, "b": 0.3, "c": 0.3}] * 2
        unit.particles.diameter = np.full(64, 0.5)
        unit.configuration.box = [1, 1, 1, 0, 0, 0]  # the default of the schema, which GSD leaves out
        empty.particles.N, empty.particles.position, empty.particles.typeid = 0, np.zeros((0, 3)), np.zeros(0)
        for f, words in ((ellipsoids, ["Ellipsoid", "give diameters="]), (unit, ["configuration/box"]), (empty, ["no sphere"])):
            self.write(f)
            self.refused(words, jam.System.read, self.path)
        with open(self.path, "w") as file:
            file.write("no gsd\n" * 100)
        self.refused(["f.gsd", "GSD"], jam.System.read, self.path)

    def test_without_diameters(self):
        self.write(self.frame())
        self.refused(["f.gsd", "no diameters", "give diameters="], jam.System.read, self.path)
        np.testing.assert_array_equal(jam.System.read(self.path, diameters=1.0).diameters, 1.0)
        np.testing.assert_array_equal(jam.System.read(self.path, radii=self.want() / 2).diameters, self.want())
        self.refused(["shape (64,)"], jam.System.read, self.path, diameters=[1.0, 2.0])
        self.refused(["either"], jam.System.read, self.path, diameters=1.0, radii=0.5, kind=TypeError)

    def test_a_plane_must_be_flat(self):
        f = self.frame(2)
        f.particles.diameter = np.full(16, 0.5)
        f.particles.position[3, 2] = 0.4
        self.write(f)
        self.refused(["spheres 0 and 3", "0.4", "plane"], jam.System.read, self.path)
        f.particles.position[:, 2] = 0.4
        self.write(f)
        disks = jam.System.read(self.path)
        self.assertEqual(disks.dim, 2)
        self.assertIn("the third coordinate, 0.4 of every disk, was omitted", disks.notes)

    def test_frames(self):
        frames = [self.frame() for _ in range(3)]
        for k, f in enumerate(frames):
            f.particles.diameter = np.full(64, 0.5 + 0.125 * k)
        self.write(*frames)
        for k, size in ((0, 0.5), (2, 0.75), (-1, 0.75), (-3, 0.5)):
            self.assertEqual(jam.System.read(self.path, frame=k).diameters[0], size)
        for k in (3, -4):
            self.refused([f"frame {k}", "has 3"], jam.System.read, self.path, frame=k, kind=IndexError)

    def test_no_doubles_of_another_frame(self):
        """GSD hands out frame 0's log for every later frame."""
        import gsd.hoomd

        s = jam.System.random(n=64, seed=3, packing_fraction=0.3)
        s.write(self.path)
        f = self.frame()
        f.particles.diameter = np.full(64, 0.5)
        with gsd.hoomd.open(self.path, "rb+") as file:
            file.append(f)
        last = jam.System.read(self.path)
        self.assertEqual((last.box, last.diameters[0]), (8.0, 0.5))
        self.assertEqual(last.positions[0, 0], 1.0)
        np.testing.assert_array_equal(jam.System.read(self.path, frame=0).positions, s.positions)

    def test_a_frame_that_was_changed_beside_its_doubles(self):
        import gsd.hoomd

        s = jam.System.random(n=64, seed=3, packing_fraction=0.1)
        s.write(self.path)
        for change in ("position", "diameter", "box"):
            with gsd.hoomd.open(self.path, "rb") as file:
                f = file[0]
            if change == "position":
                f.particles.position = f.particles.position[::-1].copy()
            elif change == "diameter":
                f.particles.diameter = f.particles.diameter * np.float32(0.5)
            else:
                f.configuration.box = f.configuration.box * np.float32(2)
            with gsd.hoomd.open(self.path + change + ".gsd", "wb") as file:
                file.append(f)
            self.refused([change, "log/jam", "doubles=False"], jam.System.read, self.path + change + ".gsd")
            found = jam.System.read(self.path + change + ".gsd", doubles=False)
            self.assertEqual(found.diameters[0], f.particles.diameter[0])

    def test_doubles_agree_to_the_rounding_of_other_processors(self):
        """The floats of another one have other last digits, and lie on the other side of the cell where they were near it."""
        import gsd.hoomd

        cell = np.array([[1.1, 0.0, 0.0], [-0.4, 0.9, 0.0], [0.3, 0.2, 1.3]])
        x = np.random.default_rng(1).random((50, 3)) @ cell
        for dim in (2, 3):
            s = jam.System.from_arrays(x[:, :dim], diameters=1e-4, cell=cell[:dim, :dim], dim=dim)
            s.write(self.path)
            with gsd.hoomd.open(self.path, "rb") as file:
                f = file[0]
            there, sides = f.particles.position.copy(), np.pad(cell[:dim, :dim], ((0, 0), (0, 3 - dim))).astype("f4")
            f.particles.position = np.nextafter(there, np.float32(1), where=there != 0, out=there.copy())
            f.particles.position[:dim] += sides
            self.write(f)
            np.testing.assert_array_equal(jam.System.read(self.path).positions, s.positions)
            for axis in range(3):
                f.particles.position = there.copy()
                f.particles.position[7, axis] += 1e-5
                self.write(f)
                self.refused(["particles/position", "log/jam"], jam.System.read, self.path)

    def test_names_are_those_of_either_release_of_the_package(self):
        """gsd 3 has Frame and the modes r and w alone, those before 2.8 Snapshot, rb and wb."""
        import gsd.hoomd

        opened, s = gsd.hoomd.open, jam.System.random(n=64, seed=3, packing_fraction=0.1)

        def open_as_3(name, mode):
            self.assertIn(mode, ("r", "w"))
            return opened(name, mode + "b")

        with unittest.mock.patch.object(gsd, "hoomd", SimpleNamespace(Frame=gsd.hoomd.Snapshot, open=open_as_3)):
            s.write(self.path)
            np.testing.assert_array_equal(jam.System.read(self.path).positions, s.positions)

    def test_endings_are_read_and_written_in_either_case(self):
        s = jam.System.random(n=64, seed=3, packing_fraction=0.1)
        s.write(path := str(self.folder / "f.GSD"))
        np.testing.assert_array_equal(jam.System.read(path).positions, s.positions)
        with self.assertRaisesRegex(ValueError, "without scale and density"):
            s.write(path, scale=2.0)

    def test_what_the_file_holds_is_not_taken_twice(self):
        f = self.frame()
        f.particles.diameter = np.full(64, 0.5)
        self.write(f)
        for name in ("box", "dim"):
            self.refused([name, "f.gsd"], jam.System.read, self.path, kind=TypeError, **{name: 3})

    def test_notes_of_what_was_changed_or_assumed(self):
        f = self.frame()
        f.particles.type_shapes = [{"type": "Sphere", "diameter": 0.6}, {"type": "Sphere", "diameter": 0.9}]
        self.write(f)
        single = "positions of the file have single precision, about 7 digits"
        corner = "the corner of the cell is at -4 -4 -4 in the file: positions are measured from there"
        self.assertEqual(jam.System.read(self.path).notes, "\n".join([single, corner]))
        f.particles.diameter = np.where(f.particles.typeid, 0.9, 0.6)
        f.particles.velocity = np.ones((64, 3))
        f.particles.position[0, 0] += 8.0
        f.particles.image = np.tile([1, 0, 0], (64, 1))
        f.configuration.step = 7
        f.log["some/energy"] = np.ones(1)
        self.write(f, f)
        notes = jam.System.read(self.path).notes.splitlines()
        self.assertEqual(notes[0], "the last of 2 frames was read; frame=0 to 1 read others")
        self.assertIn(
            "chunks of the file that were not read: log/some/energy, particles/image, particles/velocity", notes
        )
        self.assertIn("1 of 64 spheres lay outside the cell and were wrapped into it", notes)
        notes = jam.System.read(self.path, frame=1, diameters=0.5).notes
        self.assertIn("particles/diameter, particles/image, particles/type_shapes, particles/typeid", notes)
        self.assertNotIn("frames", notes)

    def test_notes_are_of_what_is_new(self):
        """A file of libjam comes back to the bit; copies, pickles and files keep the notes of others."""
        s = jam.System.random(n=64, seed=3, packing_fraction=0.1)
        s.write(self.path)
        self.assertEqual(jam.System.read(self.path).notes, "")
        later = jam.System.read(self.path, doubles=False)
        self.assertIn("log/jam/position", later.notes)
        self.assertEqual(pickle.loads(pickle.dumps(later)).notes, later.notes)

    def test_the_command_line_takes_them(self):
        f = self.frame()
        f.particles.diameter = np.full(64, 0.5)
        self.write(f)
        out = os.path.join(self.folder, "out.xyz")
        report = os.path.join(self.folder, "out.json")
        command = [sys.executable, "-m", "jam", "--input", self.path, "--no-md", "--no-crunch", "--quiet", "--output", out]
        done = subprocess.run([*command, "--report", report], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(jam.System.read(out).box, 8.0)
        with open(report, encoding="utf-8") as file:
            self.assertIn("the corner of the cell is at -4", " ".join(json.load(file)["notes"]))
        again = os.path.join(self.folder, "again.gsd")
        for words, code in (
            (["--input", out, "--no-crunch", "--output", again], 0),
            (["--input", os.path.join(self.folder, "none.gsd")], 3),
            (["--n", "20", "--dim", "4", "--no-md", "--no-crunch", "--output", again], 2),  # d = 2 and 3 alone
            (["--n", "20", "--no-md", "--no-crunch", "--output", str(self.folder / "UPPER.GSD")], 0),
            (["--n", "20", "--no-crunch", "--output", again + ".gz"], 2),  # before the work
            (["--input", self.path, "--no-md", "--no-crunch", "--box", "8"], 0),
            (["--input", self.path, "--no-md", "--no-crunch", "--box", "9"], 3),
        ):
            done = subprocess.run([sys.executable, "-m", "jam", "--quiet", *words], capture_output=True, text=True)
            self.assertEqual((done.returncode, bool(done.stderr)), (code, code > 0), done.stderr)
        np.testing.assert_array_equal(jam.System.read(again).positions, jam.System.read(out).positions)


@unittest.skipUnless(available("ase"), "python3-ase is not installed")
class Ase(Folder):
    DUMP = (
        "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
        "ITEM: ATOMS id type radius x y z\n"
    )
    ROWS = ("1 1 0.1 0.1 0.2 0.3\n", "2 1 0.1 0.6 0.7 0.8\n", "3 1 0.15 0.35 0.9 0.15\n")

    def file(self, name, **given):
        import ase

        path = os.path.join(self.folder, name)
        arrays = given.pop("arrays", {"radius": np.array([0.1, 0.1])})
        frames = []
        for x in given.pop("frames"):
            atoms = ase.Atoms("Ar2", positions=x, pbc=given.get("pbc", True), cell=given["cell"])
            for key, value in arrays.items():
                atoms.arrays[key] = value
            frames.append(atoms)
        import ase.io

        ase.io.write(path, frames, format="extxyz")
        return path

    def test_planes(self):
        flat = [[0.1, 0.2, 0.5], [0.6, 0.7, 0.5]]
        cell = np.diag([1.0, 1.0, 5.0])
        s = jam.files.read_ase(self.file("a.xyz", frames=[flat], cell=cell), dim=2)
        np.testing.assert_allclose(s.positions, np.array(flat)[:, :2], rtol=1e-12)
        uneven = self.file("b.xyz", frames=[[[0.0, 0.1, 0.2], [0.0, 0.6, 0.7]]], cell=np.diag([5.0, 1.0, 1.0]))
        self.refused(["b.xyz", "z = 0.2 and 0.7", "plane"], jam.files.read_ase, uneven, dim=2)
        for k in (0, 1):
            tilted = cell.copy()
            tilted[k, 2] = 0.3
            path = self.file("c.xyz", frames=[flat], cell=tilted)
            self.refused([f"cell vector {k}", "leaves the plane"], jam.files.read_ase, path, dim=2)
        self.refused(["dim"], jam.files.read_ase, path, dim=4)

    def test_open_directions(self):
        flat = [[0.1, 0.2, 0.0], [0.6, 0.7, 0.0]]
        path = self.file("a.xyz", frames=[flat], cell=np.diag([1.0, 1.0, 5.0]), pbc=[True, True, False])
        self.refused(["periodic", "dim=2"], jam.files.read_ase, path)
        self.assertEqual(jam.files.read_ase(path, dim=2).dim, 2)
        path = self.file("a.xyz", frames=[flat], cell=np.diag([1.0, 1.0, 5.0]), pbc=[True, False, True])
        self.refused(["periodic"], jam.files.read_ase, path, dim=2)

    def test_walls_are_named_by_the_caller(self):
        import ase

        atoms = ase.Atoms("H2", [[0.3, 0.3, 0.3], [0.7, 0.7, 0.6]], cell=[1, 1, 1], pbc=[True, True, False])
        path = os.path.join(self.folder, "slit.xyz")
        atoms.write(path)
        for made in (jam.System.from_ase(atoms, 0.1, walls="z"), jam.files.read_ase(path, 0.1, walls=(False, False, True))):
            self.assertEqual(made.info.walls, 4)
        self.refused(["walls= and container= name the walls"], jam.System.from_ase, atoms, 0.1)
        self.refused(["close the axes [True, False, False]"], jam.System.from_ase, atoms, 0.1, walls="x")
        again = made.to_ase()
        self.assertEqual(jam.System.from_ase(again).info.walls, 4)
        self.refused(["other walls than info"], jam.System.from_ase, again, walls="x")

    def test_names_of_sizes(self):
        x = [[[0.1, 0.2, 0.3], [0.6, 0.7, 0.8]]]
        for name, factor in (("radius", 2), ("Radius", 2), ("diameter", 1), ("Diameters", 1)):
            path = self.file("a.xyz", frames=x, cell=np.eye(3), arrays={name: np.array([0.1, 0.2])})
            np.testing.assert_allclose(jam.files.read_ase(path).diameters, np.array([0.1, 0.2]) * factor, rtol=1e-12)
        both = {"radius": np.array([0.1, 0.2]), "diameter": np.array([0.1, 0.2])}
        path = self.file("a.xyz", frames=x, cell=np.eye(3), arrays=both)
        self.refused(["`radius`", "`diameter`", "diameters="], jam.files.read_ase, path)
        np.testing.assert_array_equal(jam.files.read_ase(path, radii=[0.1, 0.2]).diameters, [0.2, 0.4])

    def test_notes(self):
        x = [[[0.1, 0.2, 0.5], [1.6, 0.7, 0.5]]]
        path = self.file("a.xyz", frames=[[[0.3, 0.2, 0.5], [1.6, 0.7, 0.5]], *x], cell=np.diag([1.0, 1.0, 5.0]))
        for frame, place in ((0, 0.3), (1, 0.1), (-2, 0.3)):
            self.assertAlmostEqual(jam.files.read_ase(path, dim=2, frame=frame).positions[0, 0], place, 12)
        notes = jam.files.read_ase(path, dim=2).notes.splitlines()
        self.assertEqual(
            notes,
            [
                "the last of 2 frames was read; frame=0 to 1 read others",
                "columns of the file that were not read: numbers",
                "the third coordinate, 0.5 of every disk, was omitted",
                "1 of 2 spheres lay outside the cell and were wrapped into it",
            ],
        )
        path = self.dump(self.ROWS)
        with open(path) as file:
            text = file.read().replace("0 1\n0 1\n0 1\n", "-0.5 0.5\n0 1\n0 1\n")
        with open(path, "w") as file:
            file.write(text)
        s = jam.files.read_ase(path, 0.1)
        self.assertIn("the corner of the cell is at -0.5 0 0 in the file", s.notes)
        self.assertAlmostEqual(s.positions[0, 0], 0.6, 12)
        path = os.path.join(self.folder, "b.xyz")
        with open(path, "w") as file:
            file.write('1\nLattice="0 2 0 -2 0 0 0 0 2" Properties=species:S:1:pos:R:3 energy=1 Origin="1 0 0"\nH .1 .2 .3\n')
        notes = jam.files.read_ase(path, 0.1).notes
        self.assertIn("rotated with the cell", notes)
        self.assertIn("keys of the file that were not read: energy, Origin", notes)

    def test_no_pipe(self):
        """A pipe without a writer would wait for ever."""
        for name, read in (("a.cif", lambda path: jam.files.read_ase(path, 0.1)), ("a.gsd", jam.System.read)):
            path = os.path.join(self.folder, name)
            os.mkfifo(path)
            self.refused([name, "no regular file"], read, path, kind=OSError)

    def dump(self, rows, name="a.dump"):
        path = os.path.join(self.folder, name)
        with open(path, "w") as file:
            file.write(self.DUMP + "".join(rows))
        return path

    def test_diameters_of_a_sorted_file(self):
        """ASE sorts the atoms of a dump by id; diameters in the order of its lines would go to others."""
        path = self.dump([self.ROWS[2], *self.ROWS[:2]])
        self.refused(["a.dump", "sorts", "by id"], jam.files.read_ase, path, [0.3, 0.2, 0.2])
        self.assertEqual(jam.files.read_ase(path, 0.1).n, 3)
        s = jam.files.read_ase(self.dump(self.ROWS), [0.2, 0.2, 0.3])
        self.assertEqual(s.diameters[np.argmin(np.abs(s.positions[:, 0] - 0.35))], 0.3)


class NoReader(Folder):
    def test_sizes_for_files_that_hold_them(self):
        path = os.path.join(self.folder, "a.dat")
        jam.System.random(n=10, dim=2).write(path)
        self.refused(["cell has 1 numbers, in d = 2 it needs 2"], jam.System.read, path, cell=0.1)
        for name in ("diameters", "radii"):
            self.refused([name, "from_arrays"], jam.System.read, path, kind=TypeError, **{name: 0.1})
        self.refused(["packing_fraction"], jam.System.read, path, packing_fraction=0.3)
