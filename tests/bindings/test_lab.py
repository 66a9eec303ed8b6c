"""examples/lab.html in real browsers: packings bit for bit as by jam-pack and Python, files of many kinds, proofs, stops.

Each browser is skipped where it is not installed.
"""
import gzip
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

import browser
import firefox
from lab_page import LAB, ROOT, Lab

import jam

PROOFS = ROOT / "examples/studies/reference_set"
RECIPES = [
    {"n": 64, "dim": 3, "seed": 1},
    {"n": 60, "dim": 2, "seed": 3, "law": "two", "items": "1.4"},
    {"n": 50, "dim": 3, "seed": 5, "law": "lognormal", "items": "deviation=0.2,draw=random", "walls": "z"},
    {"n": 40, "dim": 2, "seed": 6, "walls": "ball", "protocol": "fast"},
    {"n": 80, "dim": 3, "seed": 9, "density": "0.5", "law": "sieve", "curve": "0.5 0\n0.8 0.4\n1 1"},
]  # fmt: skip


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
        self.assertEqual(self.lab.page.errors, [])

    def by_the_command(self):
        """What the page's command line writes."""
        with tempfile.TemporaryDirectory() as place:
            words = shlex.split(self.lab.text("command"))
            subprocess.run([os.environ["JAM_PACK"], *words[1:], "--quiet"], cwd=place, check=True)
            return (pathlib.Path(place) / "packing.xyz").read_bytes()

    def test_packings_have_the_bits_of_the_program_and_of_python(self):
        for recipe in self.recipes:
            with self.subTest(recipe=recipe), tempfile.TemporaryDirectory() as place:
                self.lab.make(recipe)
                self.assertEqual(self.lab.text("error"), "")
                own = self.lab.saved("save-xyz", "packing.xyz")
                self.assertEqual(self.by_the_command(), own)
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

    def closed(self):
        """The page is closed in the middle and opened again."""
        self.lab.open()

    def test_stopped_and_closed_in_the_middle_it_goes_on_to_the_same_bits(self):
        self.lab.fill({"n": 150, "dim": 3, "seed": 4, "protocol": "slow"})
        self.lab.press("make-go", waits=False)
        self.lab.until("document.getElementById('left').textContent !== ''")
        self.lab.press("stop")
        self.assertIn("Stopped", self.lab.text("status"))
        rows = self.lab.saved("save-xyz", "packing.xyz").splitlines()
        self.assertEqual(int(rows[0]), 150)
        self.closed()
        self.assertIn("150 spheres", self.lab.text("status"))
        self.assertEqual(self.lab.saved("save-xyz", "packing.xyz").splitlines(), rows)
        self.lab.press("check-own")  # it moves no sphere
        self.lab.press("make-on", waits=False)
        self.lab.until("document.getElementById('bar').value > 0.2")  # of 0.5 for the growth
        self.closed()
        self.assertIn("not finished", self.lab.text("status"))
        self.lab.press("make-on")
        self.assertEqual(self.lab.text("error"), "")
        self.assertTrue(self.lab.page.run("document.getElementById('make-on').parentNode.hidden"))
        self.assertEqual(self.lab.saved("save-xyz", "packing.xyz"), self.by_the_command())

    def test_a_request_would_be_seen(self):
        """As tearDown asks for none: of the page, of a worker, and to this machine."""
        self.lab.page.run("""fetch('http://page.invalid/').catch(() => 0) && fetch('http://127.0.0.1:8080/').catch(() => 0) &&
            new Worker(URL.createObjectURL(new Blob(["fetch('http://worker.invalid/').catch(() => 0)"]))) && 0""")
        for host in ("page.invalid", "worker.invalid", "127.0.0.1:8080"):
            self.lab.until_true(lambda host=host: any(host in line for line in self.lab.page.errors), host)
        self.lab.page.run("0")  # what the console says of it has arrived
        self.lab.page.errors.clear()

    def test_a_file_is_dropped(self):
        for path in (PROOFS / "d3-n64.xyz", PROOFS / "d3-n64-mixed-01.jamproof"):
            self.lab.page.drop(path)
            self.lab.until("!document.getElementById('work').hidden || document.getElementById('status').textContent !== ''")
            self.lab.until("document.getElementById('work').hidden")
            self.assertEqual(self.lab.text("error"), "")
        self.assertRegex(self.lab.text("verdict"), "^Collectively jammed")
        self.assertRegex(self.lab.text("answer"), "^proved: ")


class InChromium(InBrowser, unittest.TestCase):
    recipes = RECIPES

    def closed(self):
        self.lab.page.new_tab()
        self.lab.page.download_to(self.lab.downloads)
        self.lab.open()

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

    def test_the_guide_lists_what_the_page_needs(self):
        guide = (ROOT / "bindings/docs/browser.md").read_text("utf-8")
        needs = re.findall(r"\['([^']+)', '([^']+)',", (ROOT / "bindings/js/lab/needs.mjs").read_text("utf-8"))
        self.assertGreater(len(needs), 3)
        for what, since in needs:
            self.assertIn(f"| {what} | {since} |", guide)

    def test_what_a_browser_lacks_is_told(self):
        no_memory = "WebAssembly.instantiate = () => Promise.reject(new RangeError('no room'));"
        lacks = {"delete window.WebAssembly": ("error", "WebAssembly"), "delete window.DecompressionStream": ("error", "Firefox 113"),
                 "WebAssembly.validate = (bytes) => bytes[9] === 5": ("error", "exceptions (Chrome 95"), "delete window.Worker": ("error", "jam-pack"),
                 f"window.Blob = class extends Blob {{ constructor(parts, o = {{}}) {{ super(o.type === 'text/javascript' ? [`{no_memory}`, ...parts] : parts, o); }} }}": ("error", "Close other pages"),
                 "Object.defineProperty(window, 'localStorage', {get() { throw new Error('refused'); }})": ("kept", "refuses storage"),
                 "HTMLCanvasElement.prototype.getContext = () => null": ("error", "WebGL2")}  # fmt: skip
        for script, (place, words) in lacks.items():
            with self.subTest(script=script):
                made = self.lab.page.ask("Page.addScriptToEvaluateOnNewDocument", source=f"if (window === top) {script}")
                self.lab.open()
                self.lab.page.ask("Page.removeScriptToEvaluateOnNewDocument", identifier=made["identifier"])
                self.assertIn(words, self.lab.text(place))
                self.assertNotIn("stays", self.lab.text("status"))
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
    recipes = RECIPES[:3]
