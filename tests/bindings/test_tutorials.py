"""Every block of the guide's tutorials runs, and of its pages on theory, citing, sizes, radii, vibrations, walls, units and the pore space, and the programs of the
page on Fortran. Each picture that a page shows of itself is drawn by its blocks.

usage: test_tutorials.py ROOT BUILD            `--store` keeps the pictures in examples/pictures. Look at them.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from PIL import Image

ROOT, BUILD = (Path(x).resolve() for x in (sys.argv.pop(1), sys.argv.pop(1)))
STORE = "--store" in sys.argv and not sys.argv.remove("--store")
GUIDE, PICTURES = ROOT / "bindings" / "docs", ROOT / "examples" / "pictures"
FILES = {"c": "program.c", "fortran": "program.f90"}
KINDS = {"glass", "calippso", "c", "fortran", "granular", "referee", "packager"}
# Pages that show pictures of their own, and how many.
PAGES = {**{f"tutorial_{kind}": 1 for kind in KINDS}, "theory": 4, "cite": 1, "sizes": 1, "vibrations": 1, "walls": 1, "pore_space": 0, "dem_cfd": 1, "units": 1, "radii": 1}
# What makes a reader wait and a test too: of a page, texts of its blocks, and others for them.
SMALLER = {
    "cite": {"range(1, 41)": "range(1, 9)"},
    "dem_cfd": {"200, 200, 400": "50, 50, 100", "[:, 100, :]": "[:, 25, :]"},
    "pore_space": {"n=500": "n=100"},
    "sizes": {"10,10,12": "6,6,7", "10.0, 10.0, 12.0": "6.0, 6.0, 7.0", " 400": " 100"},
    "theory": {"range(1, 9)": "range(1, 4)", "(2, 400), (3, 100), (3, 400)": "(3, 100)"},
    "tutorial_glass": {'"lognormal", 200': '"lognormal", 100'},
    "vibrations": {"n=512": "n=128"},
    "walls": {"n=500": "n=100"},
}  # fmt: skip
LEAST_INK = 0.02  # of the pixels of a picture that is not empty
# As of an installed library: what pkg-config would say of the build tree.
PKG_CONFIG = f"""#!/bin/sh
[ "$3" = jam ] || fortran=-ljam_fortran
echo -I{ROOT}/include -I{BUILD}/fortran -L{BUILD} -L{BUILD}/bindings -Wl,-rpath,{BUILD} $fortran -ljam
"""


def blocks_of(page):
    return re.findall(r"^```(python|sh|c|fortran)\n(.*?)^```$", page, flags=re.M | re.S)


def needs_fortran(blocks):
    return "fortran" in dict(blocks) and not (BUILD / "fortran" / "jam.mod").exists()


def run_block(kind, text, folder):
    (folder / "bin").mkdir(exist_ok=True)
    stand_in = folder / "bin" / "pkg-config"
    stand_in.write_text(PKG_CONFIG)
    stand_in.chmod(0o755)
    if kind in FILES:
        (folder / FILES[kind]).write_text(text)
        return
    environment = dict(os.environ, PATH=f"{folder}/bin:{BUILD}:{os.environ['PATH']}")
    if kind == "python":  # a file, as worker processes import the program that starts them
        (folder / "block.py").write_text(text)
    command = [sys.executable, "block.py"] if kind == "python" else ["sh", "-eu", "-c", text]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=300)
    if done.returncode:
        raise AssertionError(text + done.stdout + done.stderr)


class Tutorials(unittest.TestCase):
    def setUp(self):
        work = tempfile.TemporaryDirectory()
        self.addCleanup(work.cleanup)
        self.folder = Path(work.name)
        (self.folder / "build").symlink_to(BUILD)

    def run_page(self, name):
        text = (GUIDE / f"{name}.md").read_text(encoding="utf-8")
        blocks = blocks_of(text)
        self.assertTrue(blocks, name)
        if needs_fortran(blocks):
            self.skipTest("built without Fortran")
        smaller = SMALLER.get(name, {})
        for large in smaller:
            self.assertIn(large, text)
        for kind, block in blocks:
            for large, small in smaller.items():
                block = block.replace(large, small)
            run_block(kind, block, self.folder)
        drawn = [p for p in re.findall(r"\]\(\S*examples/pictures/(\S+)\)", text) if f'"{p}"' in text or f"'{p}'" in text]
        self.assertEqual(len(drawn), PAGES[name], drawn)
        for picture in drawn:
            self.check_picture(self.folder / picture, PICTURES / picture)
        if PAGES[name]:
            shown = re.findall(r"!\[", text)
            self.assertEqual(len(shown), PAGES[name])

    def check_picture(self, made, stored):
        if STORE:
            shutil.copy(made, stored)
        if made.suffix == ".svg":
            for kind in ("<circle", "<path"):
                ours, theirs = (p.read_text().count(kind) for p in (made, stored))
                self.assertGreater(ours, 50, made)
                self.assertAlmostEqual(ours / theirs, 1, delta=0.1, msg=made)  # another packing has other contacts
            return
        ours, theirs = (Image.open(p).convert("L") for p in (made, stored))
        for a, b in zip(ours.size, theirs.size):
            self.assertAlmostEqual(a / b, 1, delta=0.1, msg=made)
        ink = sum(ours.histogram()[:250]) / (ours.size[0] * ours.size[1])
        self.assertGreater(ink, LEAST_INK, made)

    def test_all_kinds_of_users_are_there(self):
        names = {p.stem[len("tutorial_") :] for p in GUIDE.glob("tutorial_*.md")}
        self.assertEqual(names, KINDS)
        listed = (GUIDE / "tutorials.md").read_text(encoding="utf-8")
        for name, pictures in PAGES.items():
            if pictures:
                self.assertIn(f"({name}.md)", listed)

    def test_blocks_of_the_overview_run(self):
        text = (GUIDE / "tutorials.md").read_text(encoding="utf-8")
        for kind, block in blocks_of(text):
            run_block(kind, block, self.folder)

    def test_programs_of_the_page_on_fortran_run(self):
        programs = [text for kind, text in blocks_of((GUIDE / "fortran.md").read_text()) if "end program" in text]
        self.assertEqual(len(programs), 2)
        if needs_fortran([("fortran", "")]):
            self.skipTest("built without Fortran")
        within = programs[1].replace("call spheres%read_file('missing.xyz')", "print *, size(spheres%forces())")
        self.assertNotEqual(within, programs[1])
        for text in (*programs, within):  # the last: a handler that printed to the unit of the print would wait without end
            run_block("fortran", text, self.folder)
            build = "gfortran program.f90 $(pkg-config --cflags --libs jam-fortran) -o program && ./program"
            run_block("sh", build, self.folder)


for page in PAGES:
    setattr(Tutorials, f"test_the_page_{page}_runs", lambda self, page=page: self.run_page(page))


if __name__ == "__main__":
    unittest.main()
