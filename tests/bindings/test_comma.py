"""In a locale with a decimal comma files, tables and the command line read and write the same bytes: what Python adds to
tests/capi/io_roundtrip.c."""
import contextlib
import json
import locale
import os
import shutil
import subprocess
import tempfile

import jam
import numpy as np
from jam import cli, files
from packings import InFolder, packing, state
from test_command_line import in_process


def set_comma(folder):
    """An installed locale with a comma, or one that is compiled into the folder; false where there is none."""
    for name in ("de_DE.UTF-8", "fr_FR.UTF-8", os.path.join(folder, "de_DE.UTF-8")):
        if name.startswith(folder) and shutil.which("localedef"):
            subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", name], capture_output=True)
            os.environ["LOCPATH"] = folder
        with contextlib.suppress(locale.Error):
            return locale.setlocale(locale.LC_ALL, os.path.basename(name))
    return None


class Comma(InFolder):
    def setUp(self):
        super().setUp()
        self.addCleanup(locale.setlocale, locale.LC_ALL, locale.setlocale(locale.LC_ALL))
        before = os.environ.get("LOCPATH")
        self.addCleanup(lambda: os.environ.pop("LOCPATH", None) if before is None else os.environ.update(LOCPATH=before))
        places = tempfile.TemporaryDirectory()
        self.addCleanup(places.cleanup)
        self.comma = set_comma(places.name)
        if not self.comma:
            self.skipTest("no locale with a decimal comma, nor Debian's package locales to make one")
        self.assertEqual(locale.localeconv()["decimal_point"], ",")

    def in_both(self, answer):
        """What it gives with a point, after a test that it gives the same with a comma."""
        found = []
        for name in ("C", self.comma):
            locale.setlocale(locale.LC_ALL, name)
            found.append(answer())
        self.assertEqual(locale.localeconv()["decimal_point"], ",")  # as the host has set it
        self.assertEqual(*found)
        return found[0]

    def test_files(self):
        s = packing(n=24)
        modes = s.modes(3)
        writers = {
            "p.xyz": s.write,
            "surface.stl": s.write_stl,
            "page.html": lambda path: s.page(path, modes=modes, values={"height": s.positions[:, 1]}),
            "spectrum.csv": lambda path: files.write_spectrum_csv(modes, path),
            "gaps.csv": lambda path: files.write_gaps_csv(s, path),
            "structure.csv": lambda path: files.write_structure_csv(s, path),
            "spheres.csv": lambda path: files.write_csv(s, path),
        }
        for name, write in writers.items():
            with self.subTest(name):
                path = self.folder / name
                self.in_both(lambda: (write(path), path.read_bytes()))
        self.in_both(lambda: [x.tobytes() for x in state(jam.System.read(self.folder / "p.xyz"))])

    def test_texts(self):
        s = packing(n=24)
        self.in_both(lambda: (repr(s), str(s.check()), str(jam.advise(128))))
        for wrong in (lambda: jam.System.random(n=8, box=-0.5), lambda: s.crunch(duality_gap=0.5)):
            with self.assertRaises(jam.JamError) as first:
                wrong()
            self.assertRegex(str(first.exception), r"0\.5")

    def test_command_lines(self):
        make = "--n 20 --phi0 0.1 --growth 0.1:20.5 --cell 1,1.25,1.5 --sizes normal:deviation=0.1 --seed 2 --quiet --output p.xyz --report -"
        seconds = "collisions_per_second", "seconds_md", "seconds_crunch"

        def said(words):
            code, out, err = in_process(cli.main, words.split(), self.folder)
            if not out.startswith("{"):
                return code, out, err
            return code, {k: v for k, v in json.loads(out).items() if k not in seconds}, err

        code, report, err = self.in_both(lambda: said(make))
        self.assertEqual((code, err, report["n"]), (0, "", 20))
        for words in ("info p.xyz", "info p.xyz --json", "check p.xyz", "check p.xyz --json", "--phi0 0.x",
                      "shear p.xyz --to 0.002 --quiet --json", "export p.xyz --gaps g.csv --structure s.csv --spectrum m.csv --quiet"):
            with self.subTest(words):
                self.in_both(lambda: said(words))
        rows = np.loadtxt(self.folder / "g.csv", delimiter=",", skiprows=1)
        self.assertTrue(((rows[:, 2] > 0) & (rows[:, 2] <= 1)).all())
