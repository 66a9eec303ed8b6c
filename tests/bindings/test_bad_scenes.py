"""Scenes that cannot be made: each is refused before any work, by a sentence that names its fault, from Python and from the program.

Both pass the scene to the C library: tests/capi/walls.c and tests/capi/sizes.c try all faults, this test one of each way in.
"""
import os
import subprocess

import jam
import numpy as np
from packings import InFolder

PACK = os.environ["JAM_PACK"]
# System.random, jam-pack or None, the fault in the words of both or of each
SCENES = (
    ({"walls": "w"}, "--walls w", ("name axes of 'xyz'", "--walls is 'w'")),
    ({"container": "torus"}, "--container torus", ("'brick', 'cylinder', 'ball'", "brick cylinder ball")),
    ({"container": "ball", "cell": [1, 1, 2]}, "--container ball --cell 1,1,2", "x has 1, z has 2"),
    ({"walls": "z", "cell": [1, 1, 0]}, "--walls z --cell 1,1,0", "determinant 0"),
    ({"walls": "z", "cell": [1, 1, 0.2], "packing_fraction": 0.5}, None, "does not fit between walls 0.2 apart"),  # the program grows as far as it goes
    ({"porosity": 0}, "--porosity 0", ("above 0 and below 1", "--porosity is '0'")),
)
# jam.sizes, the text of --sizes or the rows of a curve in a file, the fault
LAWS = (
    (("sieve", {"curve": [(1, 0), (2, 0.5), (3, 0.4), (4, 1)]}), "1,0\n2,0.5\n3,0.4\n4,1", "row 2 .*the sieve curve falls"),
    (("list", {"curve": [(1, 0), (2, 0)]}), "list:1=0,2=0", "a share must be above 0"),
    (("lognormal", {"deviation": -1}), "lognormal:deviation=-1", "deviation is -1"),
)


class BadScenes(InFolder):
    def refused_by_the_program(self, arguments, words):
        out = self.folder / "out.xyz"
        done = subprocess.run(
            [PACK, "--n", "10", "--no-crunch", "--output", str(out), *arguments], capture_output=True, text=True, timeout=60, check=False
        )
        self.assertIn(done.returncode, (2, 3), (arguments, done))
        self.assertRegex(done.stderr, words)
        self.assertFalse(out.exists(), arguments)

    def test_scenes(self):
        for scene, arguments, words in SCENES:
            ours, theirs = words if isinstance(words, tuple) else (words, words)
            with self.subTest(scene):
                with self.assertRaisesRegex((jam.JamError, ValueError), ours):
                    jam.System.random(n=10, **scene)
                if arguments:
                    self.refused_by_the_program(arguments.split(), theirs)

    def test_laws_of_sizes(self):
        for (law, named), text, words in LAWS:
            with self.subTest(law, **named):
                with self.assertRaisesRegex(jam.JamError, words):
                    jam.sizes(law, 10, **named)
                if "\n" in text:
                    (self.folder / "curve.csv").write_text("size,passing\n" + text + "\n")
                    text = f"sieve:{self.folder}/curve.csv"
                self.refused_by_the_program(["--sizes", text], words)

    def test_calls_without_formulae_for_a_cone_name_themselves(self):
        s = jam.System.random(n=8, packing_fraction=0.1, container="cone", walls="z", seed=1)
        for call in (s.prove, lambda: s.crunch(prove=True), lambda: s.check(prove=True)):
            with self.assertRaisesRegex(jam.errors.UnsupportedError, "a proof has no formulae for a cone"):
                call()
        with self.assertRaisesRegex(jam.errors.UnsupportedError, r"maximise_radii\(\) has no formulae for a cone"):
            s.maximise_radii()

    def test_free_cells_are_refused_by_name_where_walls_close_too_many_axes(self):
        for scene, open_axes in (({"walls": "yz"}, 1), ({"container": "ball"}, 0)):
            s = jam.System.random(n=20, packing_fraction=0.1, **scene)
            for call in (lambda: s.crunch(strain="free"), lambda: s.strain(0.01 * np.eye(3)), lambda: s.call("set_cell", s.cell)):
                with self.assertRaisesRegex(jam.errors.UnsupportedError, "walls"):
                    call()
            soft = jam.System.random(n=20, packing_fraction=0.5, overlap="allow", **scene)
            with self.assertRaisesRegex(jam.errors.UnsupportedError, f"ax[ie]s without walls, this scene has {open_axes}"):
                soft.relax(strain="free" if open_axes else "all", **({} if open_axes else {"pressure": 1e-3}))
