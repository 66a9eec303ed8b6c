"""examples/lab.html in real browsers: packings bit for bit as by jam-pack and Python, files of many kinds, proofs, stops.

JAM_LAB names another lab.html, JAM_LAB_ALL=1 runs ten seeds. Each browser is skipped where it is not installed.
"""
import gzip
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile
import time
import unittest

import browser
import firefox

import jam

ROOT = pathlib.Path(__file__).resolve().parents[2]
LAB = pathlib.Path(os.environ.get("JAM_LAB", ROOT / "examples/lab.html"))
PROOFS = ROOT / "examples/studies/reference_set"
LIMIT = 240  # seconds for one piece of work, under any load
RECIPES = [
    {"n": 64, "dim": 3, "seed": 7},
    {"n": 60, "dim": 2, "seed": 3, "law": "two", "items": "1.4"},
    {"n": 50, "dim": 3, "seed": 5, "law": "lognormal", "items": "deviation=0.2,draw=random", "walls": "z"},
    {"n": 40, "dim": 2, "seed": 6, "walls": "ball", "protocol": "fast"},
    {"n": 80, "dim": 3, "seed": 9, "density": "0.5", "law": "sieve", "curve": "0.5 0\n0.8 0.4\n1 1"},
]  # fmt: skip
SEEDS = [{"n": 256, "dim": 3, "seed": seed} for seed in (range(1, 11) if os.environ.get("JAM_LAB_ALL") else [1])]


class Lab:
    """The page in one browser, by what a reader can see and press."""

    def __init__(self, kind, folder):
        self.downloads = folder / "downloads"
        self.downloads.mkdir(exist_ok=True)
        if kind is firefox:
            self.page = firefox.Firefox(downloads=self.downloads)
        else:
            self.page = browser.Browser()
            self.page.download_to(self.downloads)
        self.open()

    def open(self):
        self.page.open(LAB)
        self.until("document.documentElement.dataset.ready === 'yes'")

    def until(self, condition):
        end = time.monotonic() + LIMIT
        while not self.page.run(condition):
            if time.monotonic() > end:
                raise AssertionError(f"not within {LIMIT} s: {condition}; {self.text('status')} {self.text('error')}")
            time.sleep(0.05)

    def text(self, name):
        return self.page.run(f"document.getElementById('{name}')?.textContent ?? ''")

    def press(self, name, waits=True):
        self.page.run(f"document.getElementById('{name}').click()")
        if waits:
            self.until("document.getElementById('work').hidden")

    def fill(self, recipe):
        for name in ("n", "dim", "seed", "law", "items", "curve", "walls", "density", "porosity", "protocol"):
            value = str(recipe.get(name, {"law": "equal", "walls": "none", "protocol": "usual"}.get(name, "")))
            self.page.run(f"((box) => {{ box.value = {value!r}; if (box.id === 'make-law') box.dispatchEvent(new Event('change')); }})"
                          f"(document.getElementById('make-{name}'))")  # fmt: skip

    def make(self, recipe):
        self.fill(recipe)
        self.press("make-go")

    def give(self, name, path):
        self.page.give("#" + name, path)
        self.until("document.getElementById('work').hidden")

    def saved(self, button, name):
        """The bytes of a file that the page gives."""
        path = self.downloads / name
        path.unlink(missing_ok=True)
        self.press(button)
        end = time.monotonic() + LIMIT
        while not path.exists() or not path.stat().st_size or list(self.downloads.glob("*.part")) or list(self.downloads.glob("*.crdownload")):
            if time.monotonic() > end:
                raise AssertionError(f"{name} was not saved: {self.text('error')}")
            time.sleep(0.05)
        return path.read_bytes()


class InBrowser:
    kind = browser

    @classmethod
    def setUpClass(cls):
        if not cls.kind.find():
            raise unittest.SkipTest(f"{cls.kind.__name__} is not installed")
        if not LAB.exists():
            raise unittest.SkipTest(f"{LAB} is not built")
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = pathlib.Path(cls.folder.name)
        cls.lab = Lab(cls.kind, cls.path)

    @classmethod
    def tearDownClass(cls):
        cls.lab.page.close()
        cls.folder.cleanup()

    def tearDown(self):
        self.assertEqual(getattr(self.lab.page, "errors", []), [])

    def test_packings_have_the_bits_of_the_program_and_of_python(self):
        for recipe in self.recipes:
            with self.subTest(recipe=recipe), tempfile.TemporaryDirectory() as place:
                self.lab.make(recipe)
                self.assertEqual(self.lab.text("error"), "")
                own = self.lab.saved("save-xyz", "packing.xyz")
                words = shlex.split(self.lab.text("command"))
                subprocess.run([os.environ["JAM_PACK"], *words[1:], "--quiet"], cwd=place, check=True)
                self.assertEqual((pathlib.Path(place) / "packing.xyz").read_bytes(), own)
                (pathlib.Path(place) / "packing.xyz").unlink()
                subprocess.run([sys.executable, "-c", self.lab.text("python")], cwd=place, check=True)
                self.assertEqual((pathlib.Path(place) / "packing.xyz").read_bytes(), own)

    def test_a_proof_is_made_saved_and_checked(self):
        self.lab.make({"n": 32, "dim": 3, "seed": 2})
        self.lab.press("prove-go")
        self.assertIn("proved", self.lab.text("proof"))
        proof = self.path / "own.jamproof"
        proof.write_bytes(self.lab.saved("prove-save", "packing.jamproof"))
        self.lab.give("proof-file", proof)
        self.assertRegex(self.lab.text("answer"), "^(proved|trapped): ")
        damaged = self.path / "damaged.jamproof"
        text = proof.read_text("ascii").replace("\ngamma ", "\ngamma 1")
        damaged.write_text(text, "ascii")
        self.lab.give("proof-file", damaged)
        self.assertRegex(self.lab.text("answer"), "^not proved: ")

    def test_a_stop_keeps_what_was_reached_and_a_reload_too(self):
        self.lab.fill({"n": 2000, "dim": 3, "seed": 1, "protocol": "slow"})
        self.lab.press("make-go", waits=False)
        self.lab.until("document.getElementById('left').textContent !== ''")
        self.lab.press("stop")
        self.assertIn("Stopped", self.lab.text("status"))
        self.assertEqual(self.lab.text("error"), "")
        rows = self.lab.saved("save-xyz", "packing.xyz").splitlines()
        self.assertEqual(int(rows[0]), 2000)
        self.lab.open()
        self.assertIn("2000", self.lab.text("status"))
        self.assertEqual(self.lab.saved("save-xyz", "packing.xyz").splitlines(), rows)


class InChromium(InBrowser, unittest.TestCase):
    recipes = [*SEEDS, *RECIPES]

    def files(self):
        """Eight kinds of one jammed packing."""
        s = jam.System.random(n=64, dim=3, seed=1)
        s.compress()
        s.crunch()
        names = ["a.xyz", "b.data", "d.dat", "e.xyz.gz"]
        for name in names:
            s.write(self.path / name)
        rows = [" ".join(map(repr, map(float, (*x, d / 2)))) for x, d in zip(s.positions, s.diameters)]
        (self.path / "f.txt").write_text("# box 1\nx y z radius\n" + "\n".join(rows) + "\n")
        atoms = "\n".join(f"{k} " + " ".join(map(repr, map(float, (*x, d / 2)))) for k, (x, d) in enumerate(zip(s.positions, s.diameters), 1))
        head = f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{s.n}\nITEM: BOX BOUNDS pp pp pp\n" + "0 1\n" * 3
        (self.path / "c.dump").write_text(f"{head}ITEM: ATOMS id x y z radius\n{atoms}\n")
        (self.path / "g.xyz").write_bytes(b"\xef\xbb\xbf" + (self.path / "a.xyz").read_bytes())
        (self.path / "h.lmp").write_bytes((self.path / "b.data").read_bytes())
        return [self.path / name for name in [*names, "c.dump", "g.xyz", "h.lmp"]], self.path / "f.txt"

    def test_files_are_checked(self):
        kinds, table = self.files()
        for path in kinds:
            with self.subTest(path=path.name):
                self.lab.give("file", path)
                self.assertEqual(self.lab.text("error"), "")
                self.assertRegex(self.lab.text("verdict"), "(?i)jammed")
                self.assertNotEqual(self.lab.text("notes"), "")
        self.lab.give("file", table)  # a table does not say its cell, or it is refused by a sentence that says how
        self.assertNotEqual(self.lab.text("error") + self.lab.text("verdict"), "")

    def test_damage_is_told_in_sentences(self):
        whole = "".join((PROOFS / "d3-n64.xyz").read_text().splitlines(keepends=True)[:66])
        damaged = {"short.xyz": whole[: len(whole) // 2], "empty.xyz": "", "words.xyz": whole.replace("0.1", "x.1"), "noise.bin": "\x00\x01\x02" * 99}
        for name, text in damaged.items():
            with self.subTest(name=name):
                (self.path / name).write_text(text)
                self.lab.give("file", self.path / name)
                self.assertRegex(self.lab.text("error"), "[a-z ]{9}")
        with open(self.path / "torn.xyz.gz", "wb") as file:
            file.write(gzip.compress(whole.encode())[:999])
        self.lab.give("file", self.path / "torn.xyz.gz")
        self.assertIn("gzip", self.lab.text("error"))
        with open(self.path / "large.xyz", "wb") as file:
            file.truncate(200 * 10**6)
        self.lab.give("file", self.path / "large.xyz")
        self.assertIn("jam-pack check", self.lab.text("error"))

    def test_a_motion_is_shown_where_nothing_holds_it(self):
        square = [f"X {x + 0.5} {y + 0.5} 0 0.5" for x in range(4) for y in range(4)]
        head = 'Lattice="4 0 0 0 4 0 0 0 1" Properties=species:S:1:pos:R:3:radius:R:1 dim=2 pbc="T T F"'
        (self.path / "square.xyz").write_text("\n".join(["16", head, *square]) + "\n")
        self.lab.give("file", self.path / "square.xyz")
        self.assertRegex(self.lab.text("verdict"), "^Not jammed")
        self.assertTrue(self.lab.page.run("document.getElementById('view').contentWindow.eval('oscillation.running')"))

    def test_a_packing_grows_on_the_screen(self):
        self.lab.fill({"n": 1000, "dim": 3, "seed": 1})
        self.lab.press("make-go", waits=False)
        self.lab.until("document.getElementById('view').contentWindow.eval('typeof growth === \"number\" && growth > 1.2')")
        self.lab.press("stop")

    def test_what_a_browser_lacks_is_told(self):
        lacks = {"delete window.WebAssembly": ("error", "WebAssembly"), "delete window.DecompressionStream": ("error", "unpack"),
                 "Object.defineProperty(window, 'localStorage', {get() { throw new Error('refused'); }})": ("kept", "refuses storage"),
                 "HTMLCanvasElement.prototype.getContext = () => null": ("error", "WebGL2")}  # fmt: skip
        for script, (place, words) in lacks.items():
            with self.subTest(script=script):
                made = self.lab.page.ask("Page.addScriptToEvaluateOnNewDocument", source=f"if (window === top) {script}")
                self.lab.open()
                self.assertIn(words, self.lab.text(place))
                self.lab.page.ask("Page.removeScriptToEvaluateOnNewDocument", identifier=made["identifier"])
        self.lab.open()

    def test_ten_thousand_spheres_stay_usable(self):
        self.lab.fill({"n": 10000, "dim": 3, "seed": 1, "density": "0.3"})
        self.lab.press("make-go", waits=False)
        longest = self.lab.page.run("""new Promise((resolve) => {
            let last = performance.now(), longest = 0;
            const end = last + 5000;
            const tick = () => {
                const now = performance.now();
                [longest, last] = [Math.max(longest, now - last), now];
                if (now < end) setTimeout(tick, 10); else resolve(longest);
            };
            tick();
        })""")
        self.lab.until("document.getElementById('work').hidden")
        self.assertLess(longest, 5000)  # ms: it answers while it computes; a page that computes itself never would
        self.assertIn("0.3", self.lab.text("status"))

    def test_it_fits_a_telephone(self):
        self.lab.page.resize(390, 844)
        for tab in ("learn", "make", "check", "prove", "look", "save"):
            self.lab.press(f"tab-{tab}")
            self.assertLessEqual(self.lab.page.run("document.documentElement.scrollWidth"), 390, tab)
        self.lab.page.resize(1400, 860)


class InFirefox(InBrowser, unittest.TestCase):
    kind = firefox
    recipes = [*SEEDS[:1], *RECIPES[1:3]]


if __name__ == "__main__":
    unittest.main()
