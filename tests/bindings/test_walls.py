"""Walls and containers from Python: arguments, the table of walls, files, what refuses."""
import pickle
import re
import tempfile
import unittest
from pathlib import Path

import jam
import numpy as np


class Arguments(unittest.TestCase):
    def test_letters_and_truth_values_say_the_same(self):
        for letters, truths in (("z", (False, False, True)), ("xz", (True, False, True)), ("", (0, 0, 0))):
            made = [jam.System.random(n=20, packing_fraction=0.1, walls=walls) for walls in (letters, truths, np.array(truths))]
            self.assertEqual({s.info.walls for s in made}, {sum(1 << c for c in range(3) if truths[c])})
            self.assertTrue(all((s.positions == made[0].positions).all() for s in made))
            with tempfile.TemporaryDirectory() as folder:
                name = Path(folder, "slit.data")
                made[0].write(name)
                name.write_text("of another program\n" + name.read_text().split("\n", 1)[1])
                for walls in (letters, truths):
                    self.assertEqual(jam.System.read(name, walls=walls).info.walls, made[0].info.walls)

    def test_mistakes_are_named(self):
        for walls in ("q", "xx", (True,), (True, False, 2), 3, [True] * 4):
            with self.assertRaisesRegex(ValueError, "walls must"):
                jam.System.random(n=10, walls=walls)
        with self.assertRaisesRegex(ValueError, "container must be one of"):
            jam.System.random(n=10, container="torus")

    def test_sizes_count_for_the_container(self):
        for container, dim, share in (("ball", 3, np.pi / 6), ("ball", 2, np.pi / 4), ("cylinder", 3, np.pi / 4), (None, 3, 1)):
            given = dict(porosity=0.6, cell=np.eye(dim) * 10, dim=dim)
            law = "uniform:low=1,high=1.5"
            sigma = jam.sizes(law, container=container, **given)
            volume = (np.pi / 6 * sigma**3 if dim == 3 else np.pi / 4 * sigma**2).sum()
            self.assertAlmostEqual(volume / (share * 10**dim), 0.4, 12)
        with self.assertRaisesRegex(ValueError, "container must be"):
            jam.sizes("equal", container="torus", porosity=0.5, box=3)
        with self.assertRaisesRegex(TypeError, "give walls= to System.random"):
            jam.sizes("equal", 10, walls="z")


class Scenes(unittest.TestCase):
    def test_walls_are_a_table(self):
        w = jam.System.random(n=60, packing_fraction=0.2, walls="z").walls()
        self.assertTrue(np.isnan(w.pressure).all())
        self.assertEqual((w.axis.tolist(), w.side.tolist(), w.area.tolist()), ([2, 2], [0, 1], [1, 1]))
        self.assertEqual(len(jam.System.random(n=10).walls().gap), 0)
        rows = str(w).splitlines()  # a table of few rows prints as such
        self.assertEqual((rows[1].split(), len(rows)), (["axis", "side", "area", "pressure", "gap", "stress"], 4))

    def test_pickles_keep_the_container(self):
        s = jam.System.random(n=30, packing_fraction=0.2, container="cylinder", walls="z")
        s.compress(pressure=100)
        t = pickle.loads(pickle.dumps(s))
        self.assertEqual((t.info.container, t.info.walls, t.info.volume), (1, 4, s.info.volume))
        self.assertTrue((t.walls().pressure == s.walls().pressure).all())

    def test_walls_in_titles_and_of_ase(self):
        """Walls without a container are those of a brick; wrong words are refused by their line; ASE writes lists as _JSON."""
        s = jam.System.random(n=20, packing_fraction=0.1, walls="z")
        with tempfile.TemporaryDirectory() as folder:
            name = Path(folder, "slit.data")
            s.write(name)
            text = name.read_text()
            for new, why in (
                (text.replace("F F T", "F F X"), "line 1: walls='F F X': a word for each axis must be T or F"),
                (text.replace("F F T", "F F"), "line 1: walls has 2 words, 3 are needed"),
                (text.replace("F F T", "F" + 40 * " T"), "line 1: walls has 41 words, it must have one for each axis, at most 8"),
            ):
                name.write_text(new)
                with self.assertRaisesRegex(jam.errors.FormatError, why):
                    jam.System.read(name)
            name.write_text(text.replace("container=brick ", ""))
            self.assertEqual(jam.System.read(name).info.walls, 4)
            name = Path(folder, "slit.xyz")
            s.write(name)
            text = name.read_text()
            for words in ("_JSON [false, false, true]", "_JSON [false,false,true]", "F F T"):
                name.write_text(text.replace("F F T", words, 1) if words[0] == "F" else text.replace('walls="F F T"', f'walls="{words}"'))
                self.assertEqual(jam.System.read(name).info.walls, 4)
            alone = re.sub(r' pbc="[^"]*"', "", text.replace(" container=brick", ""))  # walls without pbc and container: a brick
            name.write_text(alone)
            self.assertEqual((jam.System.read(name).info.walls, jam.System.read(name).notes), (4, ""))
            with self.assertRaisesRegex(jam.errors.ArgumentError, "close other axes than the file"):
                jam.System.read(name, walls="x")
            name.write_text(text.replace('walls="F F T"', 'walls="_JSON [false, 2, true]"'))
            with self.assertRaisesRegex(jam.errors.FormatError, "must be T or F"):
                jam.System.read(name)

    def test_keys_with_blanks_around_their_sign(self):
        """As ASE reads them. A key without a value takes none from the next one; walls without words are refused."""
        s = jam.System.random(n=20, packing_fraction=0.1, walls="z")
        with tempfile.TemporaryDirectory() as folder:
            name = Path(folder, "slit.xyz")
            s.write(name)
            count, keys, *rows = name.read_text().splitlines(keepends=True)

            def read(line):
                name.write_text(count + line.rstrip() + "\n" + "".join(rows))
                return jam.System.read(name)

            for sign in (" = ", "= ", " =", "\t=  "):
                t = read(keys.replace("=", sign))
                self.assertEqual((t.info.walls, t.notes), (4, ""))
                self.assertTrue((t.positions == s.positions).all())
            bare = re.sub(r' pbc="[^"]*"| container=brick', "", keys)
            for more in ("energy = -3.5", "energy= ", "energy= -3.5 "):
                self.assertEqual(read(more + " " + bare).notes, "keys of the file that were not read: energy")
            self.assertIn("not read: comment, what", read(bare.replace("walls", "comment= what")).notes)
            for note in ('note="a \\" walls={T T T} \\" b"', "list=[a walls={T T T} [b] pbc=F]", "note='it\\'s walls=F'"):
                self.assertEqual(read(note + " " + bare).info.walls, 4)
            self.assertEqual(read(bare.replace('"F F T"', "[F, F,T]")).info.walls, 4)
            for empty in ('walls=""', "walls=", "walls = ", "walls= energy=3"):
                with self.assertRaisesRegex(jam.errors.FormatError, "line 2: walls has 0 words"):
                    read(bare.replace('walls="F F T"', empty))
