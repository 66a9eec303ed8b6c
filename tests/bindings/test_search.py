"""The search of the largest sum of radii from the command line, and within round walls."""
import json
import subprocess
import sys
from fractions import Fraction

import jam
import jam.radii
import numpy as np
from jam import _search as search
from packings import InFolder
from test_command_line import OUTPUT, REFUSED, USAGE, in_process
from proof_files import ROOT


class Search(InFolder):
    def run_words(self, words):
        return in_process(search.main, words.split(), self.folder)

    def test_best_packings_are_written_proved_and_continued(self):
        words = "disks --n 5 --walls xy --starts {} --workers 1 --keep 2 --prove 30 --json"
        code, out, err = self.run_words(words.format(2))
        said = json.loads(out)
        self.assertEqual((said["starts"], err), (2, ""))
        best = said["best"][0]
        self.assertEqual((code, said["status"]), (0 if all("proof" in row for row in said["best"]) else 1,) * 2)
        # 16 v^2 - 24 v + 7 = 0, the polynomial of bindings/docs/radii.md
        v = Fraction(best["value"])
        self.assertLess(abs(16 * v * v - 24 * v + 7), Fraction(1, 10**27))
        self.assertLess(best["value_radius"], 1e-28)
        checker = ROOT / "bindings/proof/jamproof.py"
        done = subprocess.run([sys.executable, checker, self.folder / best["proof"]], capture_output=True, text=True, check=True)
        self.assertIn("proved", done.stdout)
        packing = jam.System.read(self.folder / best["file"])
        self.assertAlmostEqual(packing.diameters.sum() / 2, float(v), delta=1e-14)
        code, out, err = self.run_words(words.format(2).replace("--prove 30 ", ""))
        self.assertTrue((self.folder / best["proof"]).exists())  # of the packing beside it, which is the same
        for name in ("best-1.xyz", "best-2.xyz"):  # no proof stays beside a packing that it does not prove
            (self.folder / "disks" / name).write_text("")
        code, out, err = self.run_words(words.format(3).replace("--prove 30 ", ""))
        self.assertEqual(json.loads(out)["starts"], 3)
        self.assertEqual(list(self.folder.glob("disks/*.jamproof")), [])

    def test_no_file_is_of_another_rank_after_fewer_were_asked_for(self):
        words = "disks --n 9 --walls xy --workers 1 --json "
        many = json.loads(self.run_words(words + "--starts 3 --keep 5")[1])["best"]
        self.assertGreater(len(many), 1)
        fewer = json.loads(self.run_words(words + "--starts 4 --keep 1")[1])["best"]
        self.assertLessEqual({row["value"] for row in many}, {row["value"] for row in fewer})
        kept = json.loads((self.folder / "disks/search.json").read_text())["best"]
        self.assertEqual(sorted(p.name for p in self.folder.glob("disks/best*")), [f"best-{k}.xyz" for k in range(1, len(kept) + 1)])
        for rank, (value, *_) in enumerate(kept, 1):
            self.assertAlmostEqual(jam.System.read(self.folder / f"disks/best-{rank}.xyz").diameters.sum() / 2, value, 12)

    def test_files_of_another_search_are_not_written_over(self):
        (self.folder / "d").mkdir()
        mine = self.folder / "d/best-1.xyz"
        mine.write_text("mine")
        code, _, err = self.run_words("d --n 2 --walls xy --starts 1 --workers 1")
        self.assertEqual((code, mine.read_text()), (REFUSED, "mine"))
        self.assertIn("move it away", err)

    def test_a_cell_that_deforms(self):
        """Disks in the triangular lattice: n equal ones of the packing fraction pi / sqrt(12), in the area 1."""
        for n in (1, 2):
            code, out, err = self.run_words(f"d{n} --n {n} --strain free --starts 2 --workers 1 --keep 1 --json")
            self.assertEqual((code, err), (0, ""))
            best = json.loads(out)["best"][0]
            self.assertAlmostEqual(float(best["value"]), (n / 12**0.5) ** 0.5, 12)
            packing = jam.System.read(self.folder / best["file"])
            self.assertAlmostEqual(np.linalg.det(packing.cell), 1.0, 12)
            self.assertAlmostEqual(packing.diameters.sum() / 2, float(best["value"]), 14)
            code, out, err = self.run_words(f"d{n} --n {n} --strain free --starts 3 --workers 1 --keep 1 --json")
            self.assertEqual((code, json.loads(out)["starts"]), (0, 3), err)
            self.assertIn("another search", self.run_words(f"d{n} --n {n} --starts 2")[2])

    def test_a_search_that_kept_no_cells_goes_on(self):
        words = "d --n 3 --box 2 --starts 1 --workers 1 --json"
        first, record = self.run_words(words), self.folder / "d/search.json"
        kept = json.loads(record.read_text())
        self.assertEqual([x.pop() for x in kept["best"]], [[[2.0, 0.0], [0.0, 2.0]]])
        record.write_text(json.dumps(kept))
        self.assertEqual(*(json.loads(out)["best"] for _, out, _ in (first, self.run_words(words))))

    def test_wrong_lines_and_scenes_are_refused(self):
        for words, status, text in (
            ("d --n 5", USAGE, "the search has no end"),
            ("d --n 5 --starts 1 --starts 2", USAGE, "is given twice"),
            ("d --n 5 --starts 1 --prove 3", USAGE, "--prove 3: it must be 20 or more"),
            ("d --n 5 --starts 1 --prove 30 --strain free", USAGE, "--prove contradicts --strain"),
            ("d --n 5 --starts 1 --strain other", USAGE, "--strain"),
            ("d --n 5 --starts 1 --walls xy --strain free", REFUSED, "walls"),
            ("d --n 5 --starts 1 --walls w", REFUSED, "walls"),
            ("d --n 5 --starts 1 --radius-min 0.4 --walls xy", REFUSED, "radius_min"),
            ("file --n 5 --starts 1 --walls xy", OUTPUT, "file"),
        ):
            (self.folder / "file").write_text("")
            code, _, err = self.run_words(words)
            self.assertEqual(code, status, err)
            self.assertIn(text, err)
            code, out, _ = self.run_words(words + " --json")
            self.assertEqual((code, json.loads(out)["status"]), (status, status))

    def test_moves_stay_within_round_walls(self):
        """Seven equal disks in a circle of diameter 1 have the sum 7/6, and six of them can be smaller or larger."""
        found = jam.radii.best_of(7, container="ball", starts=2, workers=1)
        self.assertGreaterEqual(found.value, 7 / 6 - 1e-12)
        self.assertGreater(found.maxima, 60)
        best = found.best[0]
        self.assertLessEqual((np.linalg.norm(best.positions - 0.5, axis=1) + best.radii).max(), 0.5 + 1e-15)
