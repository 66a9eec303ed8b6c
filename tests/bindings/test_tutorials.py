"""Every block of the guide's tutorials, and of its pages on sizes, walls and Fortran, runs.      usage: test_tutorials.py ROOT BUILD"""
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT, BUILD = (Path(x).resolve() for x in (sys.argv.pop(1), sys.argv.pop(1)))
PAGE = ROOT / "bindings" / "docs" / "tutorials.md"
FILES = {"c": "program.c", "fortran": "program.f90"}
# As of an installed library: what pkg-config would say of the build tree.
PKG_CONFIG = f"""#!/bin/sh
[ "$3" = jam ] || fortran=-ljam_fortran
echo -I{ROOT}/include -I{BUILD}/fortran -L{BUILD} -L{BUILD}/bindings -Wl,-rpath,{BUILD} $fortran -ljam
"""


def sections():
    for part in re.split(r"^## ", PAGE.read_text(encoding="utf-8"), flags=re.M)[1:]:
        yield part.splitlines()[0], re.findall(r"^```(\w+)\n(.*?)^```$", part, flags=re.M | re.S)


def blocks_of(page, kind):
    text = (PAGE.parent / page).read_text(encoding="utf-8")
    return re.findall(rf"^```({kind})\n(.*?)^```$", text, flags=re.M | re.S)


class Tutorials(unittest.TestCase):
    def test_all_kinds_of_users_are_there(self):
        self.assertEqual(len(list(sections())), 7)
        self.assertEqual({kind for _, blocks in sections() for kind, _ in blocks}, {"python", "c", "fortran", "sh"})

    def test_blocks_run(self):
        for title, blocks in sections():
            with self.subTest(title), tempfile.TemporaryDirectory() as folder:
                if "fortran" in dict(blocks) and not (BUILD / "fortran" / "jam.mod").exists():
                    self.skipTest("built without Fortran")
                for kind, text in blocks:
                    self.run_block(kind, text, Path(folder))

    def test_the_page_on_sizes_runs_from_its_curve_to_its_picture(self):
        text = (PAGE.parent / "sizes.md").read_text(encoding="utf-8")
        for word in ("porosity", "sieve", "millimetre", "void fraction"):
            self.assertIn(word, text)
        with tempfile.TemporaryDirectory() as folder:
            for kind, block in re.findall(r"^```(\w+)\n(.*?)^```$", text, flags=re.M | re.S):
                self.run_block(kind, block, Path(folder))
            self.assertGreater((Path(folder) / "sieve.png").stat().st_size, 10000)

    def test_the_page_on_walls_runs(self):
        with tempfile.TemporaryDirectory() as folder:
            for _, block in blocks_of("walls.md", "python"):
                self.run_block("python", block, Path(folder))

    @unittest.skipUnless((BUILD / "fortran" / "jam.mod").exists(), "built without Fortran")
    def test_programs_of_the_page_on_fortran_run(self):
        programs = [text for _, text in blocks_of("fortran.md", "fortran") if "end program" in text]
        self.assertEqual(len(programs), 2)
        for text in programs:
            with tempfile.TemporaryDirectory() as folder:
                self.run_block("fortran", text, Path(folder))
                build = "gfortran program.f90 $(pkg-config --cflags --libs jam-fortran) -o program && ./program"
                self.run_block("sh", build, Path(folder))

    def run_block(self, kind, text, folder):
        (folder / "bin").mkdir(exist_ok=True)
        stand_in = folder / "bin" / "pkg-config"
        stand_in.write_text(PKG_CONFIG)
        stand_in.chmod(0o755)
        if kind in FILES:
            (folder / FILES[kind]).write_text(text)
            return
        environment = dict(os.environ, PATH=f"{folder}/bin:{BUILD}:{os.environ['PATH']}")
        command = [sys.executable, "-c", text] if kind == "python" else ["sh", "-eu", "-c", text]
        done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, text + done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
