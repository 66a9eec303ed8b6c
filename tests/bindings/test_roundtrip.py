"""What libjam writes it reads to the same bits: every scene in every format that can hold it, and an error for all others."""
import tempfile
import unittest

import numpy as np

import jam

FORMATS = [f for f in jam.files.formats() if f.content == "packings" and f.write]


def grown(**options):
    s = jam.System.random(seed=3, **options)
    s.compress(pressure=30.0)
    return s


def crunched(strain="none", **options):
    s = grown(**options)
    s.crunch(strain=strain)
    return s


def soft():
    """Overlapping spheres of random diameters, relaxed."""
    sizes = 0.35 + 0.1 * np.random.default_rng(5).random(24)
    x = np.random.default_rng(6).random((24, 2)) * [1.7, 2.1]
    s = jam.System.from_arrays(x, sizes, cell=[[1.7, 0.0], [0.3, 2.1]], overlap="allow")
    s.relax()
    return s


def own_images():
    """A sphere as wide as its period, which rounding may put beyond it."""
    s = jam.System.random(n=2, dim=2, seed=2, cell=[1.0, 5.0])
    s.crunch()
    return s


SCENES = {
    "disks": lambda: crunched(n=30, dim=2, diameters=[1.0, 1.4] * 15),
    "spheres": lambda: crunched(n=30, dim=3),
    "non-additive": lambda: grown(n=30, dim=2, diameters=[1.0, 1.3] * 15, non_additivity=-0.1),
    "tilted": lambda: crunched("free", n=30, dim=2, diameters=[1.0, 1.4] * 15),
    "tilted in space": lambda: crunched("free", n=20, dim=3),
    "walls": lambda: grown(n=30, dim=3, cell=[1.0, 2.0, 1.5], walls="xz"),
    "cylinder": lambda: grown(n=30, dim=3, cell=[1.3, 1.3, 2.0], container="cylinder", walls="z"),
    "ball": lambda: grown(n=30, dim=3, box=2.5, container="ball"),
    "soft": soft,
    "own images": own_images,
    "long brick": lambda: grown(n=30, dim=3, cell=[6.0, 1.5, 3.0]),
    **{f"d = {d}": lambda d=d: grown(n=40, dim=d) for d in (4, 8)},
}


def needs(s):
    """What a format must hold for this system, in the words of jam.files.formats."""
    info, cell = s.info, s.cell
    found = {"spheres"}
    if len(s.walls().axis):
        found.add("walls")
    if (cell != cell[0, 0] * np.eye(s.dim)).any():
        found.add("cells")
    if info.non_additivity != 0.0:
        found.add("non_additivity")
    return found


class Roundtrip(unittest.TestCase):
    def same(self, a, b):
        for name in ("positions", "diameters", "cell"):
            self.assertEqual(getattr(a, name).tobytes(), getattr(b, name).tobytes(), name)
        for name in ("walls", "container", "non_additivity", "packing_fraction"):
            self.assertEqual(getattr(a.info, name), getattr(b.info, name), name)

    def test_reading_gives_the_same_bits(self):
        written = 0
        with tempfile.TemporaryDirectory() as folder:
            for name, make in SCENES.items():
                try:
                    s = make()
                except jam.errors.DimensionError:
                    self.assertTrue(name.startswith("d ="))  # a build of fewer dimensions
                    continue
                for f in FORMATS:
                    path = folder + "/q" + f.endings[0]
                    with self.subTest(scene=name, format=f.word):
                        if f.word == "gsd":
                            continue  # test_other_files
                        if s.dim > f.dim or not needs(s) <= set(f.holds):
                            with self.assertRaises(jam.errors.UnsupportedError):
                                s.write(path, f.word)
                            continue
                        s.write(path, f.word)
                        if not f.read:
                            continue
                        policy = "allow" if name.startswith("soft") else "refuse"
                        self.same(s, jam.System.read(path, overlap=policy))
                        written += 1
        self.assertGreater(written, 25)

    def test_a_scale_that_is_a_power_of_two_keeps_the_bits(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("disks", "tilted", "cylinder", "ball"):
                s = SCENES[name]()
                with self.subTest(scene=name):
                    s.write(folder + "/q.xyz", scale=4.0)
                    back = jam.System.read(folder + "/q.xyz")
                    self.assertEqual((0.25 * back.positions).tobytes(), s.positions.tobytes())
                    self.assertEqual((0.25 * back.diameters).tobytes(), s.diameters.tobytes())
                    self.assertEqual((0.25 * back.cell).tobytes(), s.cell.tobytes())
                    self.assertEqual(back.packing_fraction, s.packing_fraction)

    def test_density_has_a_place_in_lammps_data_alone(self):
        s = SCENES["disks"]()
        with tempfile.TemporaryDirectory() as folder:
            s.write(folder + "/q.data", density=2500.0)
            with open(folder + "/q.data") as file:
                rows = [line.split() for line in file if len(line.split()) == 7]
            self.assertEqual([row[3] for row in rows], ["2500"] * s.n)
            self.same(s, jam.System.read(folder + "/q.data"))
            for word in ("xyz", "vtp", "plain"):
                with self.assertRaisesRegex(jam.errors.UnsupportedError, "density"):
                    s.write(folder + "/q", word, density=2.0)
            for bad in ({"density": 0.0}, {"density": np.inf}, {"scale": 0.0}, {"scale": np.nan}, {"scale": -1.0}):
                with self.assertRaises(jam.errors.ArgumentError):
                    s.write(folder + "/q.data", **bad)
