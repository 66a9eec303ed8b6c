"""The page in a real browser: it draws what the packing holds, without a word on the console. Skipped without Chromium.

`test_page.py --store` draws the picture page.png anew, which one test compares with. Look at it before you keep it.
"""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from PIL import Image

import browser
import jam

BACKGROUND = (246, 247, 249)
STORED = Path(__file__).with_name("page.png")
WIDTH, HEIGHT, BLOCK = 300, 200, 10  # of the stored picture and of the squares whose mean colours are compared, pixels
# Root mean square difference of the squares' colours, of 255. Renderers differ at edges: 3.4 without antialiasing, 3.1
# half a pixel aside. Wrong scenes: 4.7 with radii 5 % too large, 8.8 turned by 0.05 radians, 18 without lights.
TOLERANCE = 4.0


def pixels(page, path, area=None):
    page.picture(path)
    image = np.asarray(Image.open(path).convert("RGB")).astype(int)
    if area:
        u, v, w, h = (round(x) for x in area)
        image = image[v : v + h, u : u + w]
    return image


def disks(n=120):
    s = jam.System.random(n=n, dim=2, seed=1, diameters=[1.0] * (n // 2) + [1.4] * (n // 2))
    s.compress(growth_rate=3e-2, pressure=1e4)
    s.crunch()
    return s


def rock_salt():
    """Seven spheres of two sizes, one of the cell's corner missing. Their contacts follow from geometry: no quench decides."""
    large = np.array([[0, 0, 0], [0, 1, 1], [1, 0, 1], [1, 1, 0]]) / 2
    small, size = (large + [0.5, 0, 0]) % 1, 1 / np.sqrt(2)
    x = np.concatenate([large[:3], small]) + 0.25
    s = jam.System.from_arrays(x % 1, np.repeat([size, 1 - size], [3, 4]) * (1 - 1e-13))
    s.contacts_from_geometry()
    return s


def fixed_scene(page, folder):
    """The picture of rock salt with forces, WIDTH by HEIGHT, on a part of the page without text."""
    s = rock_salt()
    s.page(folder / "salt.html", values={"height": s.positions[:, 2]})
    page.open(folder / "salt.html")
    page.run(
        "Object.assign(document.getElementById('scene').style, {position: 'fixed', inset: '0 auto auto 0',"
        f" width: '{WIDTH}px', height: '{HEIGHT}px'}}); document.getElementById('legend').style.display = 'none';"
        "state.forces = 1; state.size = 0.6; state.width = 1.5; state.colour = quantities.length - 1;"
        "camera.zoom = 1.5; rebuild()"
    )
    page.settle()
    return pixels(page, folder / "salt.png", (0, 0, WIDTH, HEIGHT))


def squares(image):
    return image.reshape(HEIGHT // BLOCK, BLOCK, WIDTH // BLOCK, BLOCK, 3).mean((1, 3))


def store():
    page = browser.Browser(600, 400)
    with tempfile.TemporaryDirectory() as folder:
        image = fixed_scene(page, Path(folder))
    page.close()
    Image.fromarray(image.astype(np.uint8)).quantize(64).save(STORED, optimize=True)
    print(f"{STORED}: {STORED.stat().st_size} bytes. Look at it.")


class PageTest(unittest.TestCase):
    """A browser, and the page of a packing in it without a word on the console."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = Path(cls.folder.name)
        cls.page = browser.Browser(1200, 800)

    @classmethod
    def tearDownClass(cls):
        cls.page.close()
        cls.folder.cleanup()

    def tearDown(self):
        self.assertEqual(self.page.errors, [])
        self.page.errors.clear()

    def show(self, system, **more):
        system.page(self.path / "page.html", **more)
        self.page.open(self.path / "page.html")
        self.page.run("document.getElementById('legend').style.display = 'none'")  # it lies on some spheres

    def spot(self, i):
        """Where sphere i stands on the screen, and its radius in pixels."""
        found = self.page.run(
            f"(() => {{ const o = onCanvas(scene.owner.indexOf({i}), viewNow());" " return [o.u, o.v, o.pixels]; })()"
        )
        return found


class Page(PageTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.disks = disks()

    def covered(self):
        """The share of the cell's picture that is not background."""
        cell = self.page.run(
            "(() => { const v = viewNow(), a = cell[0][0]; const u = x => 0.5 * canvas.width + (x + v.shift[0]) * v.scale,"
            " w = y => 0.5 * canvas.height - (y + v.shift[1]) * v.scale; return [u(0), w(a), a * v.scale, a * v.scale]; })()"
        )
        image = pixels(self.page, self.path / "a.png", cell)
        return (np.abs(image - BACKGROUND).max(2) > 8).mean()

    def test_disks_cover_what_the_packing_fraction_says(self):
        self.show(self.disks)
        self.page.run("state.forces = 0; state.images = true; state.box = false; rebuild()")
        self.page.settle()
        self.assertAlmostEqual(self.covered(), self.disks.packing_fraction, delta=0.01)

    def test_every_disk_has_the_colour_of_its_class(self):
        self.show(self.disks)
        self.page.run("state.forces = 0; rebuild()")
        self.page.settle()
        image = pixels(self.page, self.path / "a.png")
        want = np.where(self.disks.rattlers, 2, np.where(self.disks.bucklers, 1, 0))
        colours = np.array([(0, 114, 178), (230, 159, 0), (190, 190, 190)])
        for i in range(self.disks.n):
            u, v, _ = self.spot(i)
            found = np.abs(colours - image[int(v), int(u)]).sum(1).argmin()
            self.assertEqual(found, want[i], f"sphere {i}")

    def test_picture_is_the_stored_one(self):
        stored = np.asarray(Image.open(STORED).convert("RGB")).astype(int)
        image = fixed_scene(self.page, self.path)
        off = np.sqrt(((squares(image) - squares(stored)) ** 2).mean())
        self.assertLess(off, TOLERANCE)

    def test_spheres_in_front_hide_those_behind(self):
        s = jam.System.random(n=200, dim=3, seed=2, packing_fraction=0.3)
        height = np.arange(200.0)
        self.show(s, values={"number": height})
        self.page.run("state.colour = quantities.findIndex(q => q.name === 'number'); rebuild()")
        self.page.settle()
        image = pixels(self.page, self.path / "a.png")
        front = self.page.run(
            "Array.from({length: n}, (_, i) => { const o = onCanvas(i, viewNow());"
            " return [Math.round(o.u), Math.round(o.v), instanceAt(Math.round(o.u) + .5, Math.round(o.v) + .5, viewNow())]; })"
        )
        tones = np.array(self.page.run("Array.from({length: n}, (_, i) => viridis(i / (n - 1)))"))
        right = 0
        for u, v, i in front:  # the hue tells the sphere, light and shade aside
            a, b = image[v, u] / np.linalg.norm(image[v, u]), tones[i] / np.linalg.norm(tones[i])
            right += np.abs(a - b).max() < 0.06
        self.assertGreaterEqual(right, 196)  # at an edge the middle of a pixel may lie on the next sphere

    def test_numbers_of_a_sphere(self):
        self.show(self.disks)
        u, v, _ = self.spot(5)
        self.page.mouse("mouseMoved", u, v)
        self.assertIn("sphere 5, ", self.page.run("tip.textContent"))
        self.assertFalse(self.page.run("tip.hidden"))
        for kind in ("mousePressed", "mouseReleased"):
            self.page.mouse(kind, u, v)
        shown = self.page.run("document.getElementById('chosen').innerText")
        self.assertIn(f"{self.disks.positions[5, 0]:.11f}"[:12], shown)
        forces = self.page.run("contacts(5).map(c => c.force)")
        mine = self.disks.forces[(self.disks.contacts.pairs == 5).any(1)]
        np.testing.assert_allclose(sorted(forces), sorted(mine), rtol=1e-6)

    def test_keys(self):
        self.show(self.disks)
        self.page.run("canvas.focus()")
        for key, script in (("f", "state.forces"), ("l", "state.names"), ("i", "state.images")):
            before = self.page.run("!!" + script)
            self.page.key(key)
            self.assertEqual(self.page.run("!!" + script), not before, key)
        self.page.key("n")
        self.page.key("n")
        self.assertEqual(self.page.run("state.chosen"), 1)
        self.assertIn("sphere 1", self.page.run("document.querySelector('[aria-live]').innerText"))
        self.page.key("c")
        self.assertIn("coordination", self.page.run("document.getElementById('legend').innerText"))
        zoom = self.page.run("camera.zoom")
        self.page.key("+")
        self.assertGreater(self.page.run("camera.zoom"), zoom)
        self.page.key("r")
        self.assertEqual(self.page.run("camera.zoom"), 1)

    def test_threshold_and_classes(self):
        self.show(self.disks)
        cell_edges = 4
        count = "(state.box = true, rebuild(), scene.sticks)"
        self.assertEqual(self.page.run(count), 2 * len(self.disks.forces) + cell_edges)
        self.page.run("state.threshold = 1")
        self.assertEqual(self.page.run(count), 2 * int((self.disks.forces >= 1).sum()) + cell_edges)
        self.page.run("state.hide.add(2); rebuild()")
        self.assertEqual(self.page.run("scene.count"), int((~self.disks.rattlers).sum()))

    def test_four_dimensions_are_cut(self):
        s = jam.System.random(n=300, dim=4, seed=1)
        self.show(s)
        x, r = s.positions[:, 3] - 0.5, 0.5 * s.diameters
        x = x - np.round(x)
        self.assertEqual(self.page.run("scene.count"), int((np.abs(x) < r).sum()))
        cut = self.page.run("Array.from({length: scene.count}, (_, k) => [scene.owner[k], scene.sphere[4 * k + 3]])")
        for i, radius in cut:
            self.assertAlmostEqual(radius, np.sqrt(r[i] ** 2 - x[i] ** 2), delta=1e-6)

    def test_before_a_crunch_and_small_and_markup(self):
        s = jam.System.random(n=50, dim=3, seed=1)
        self.show(s, title="<b>&</b>", small=True)
        self.assertEqual(self.page.run("document.title"), "<b>&</b>")
        self.assertTrue(self.page.run("document.body.classList.contains('small')"))
        text = s._repr_html_()
        (self.path / "notebook.html").write_text(f"<!DOCTYPE html><meta charset=utf-8>{text}", encoding="utf-8")
        self.page.open(self.path / "notebook.html")
        self.assertEqual(self.page.run("document.querySelector('iframe').contentWindow.eval('scene.count')"), 50)

    def test_sheared_cell(self):
        s = jam.System.random(n=60, dim=2, seed=3, cell=[[1, 0], [0.45, 1]], packing_fraction=0.3)
        self.show(s)
        a = np.array(s.cell)
        where = np.array(self.page.run("Array.from({length: n}, (_, i) => placed(i).slice(0, 2))"))
        inside = np.linalg.solve(a.T, where.T).T
        self.assertTrue((inside > -1e-12).all() and (inside < 1 + 1e-12).all())
        moved = np.linalg.solve(a.T, (where - s.positions).T).T
        np.testing.assert_allclose(moved, np.round(moved), atol=1e-12)

    def test_slider_shows_the_steps_of_the_crunch(self):
        s = jam.System.random(n=80, dim=2, seed=5, diameters=[1.0] * 40 + [1.4] * 40, packing_fraction=0.5)
        moved = [np.zeros_like(s.positions)]
        start, small = s.positions.copy(), s.diameters[0]
        s.crunch(keep_steps=5, on_step=lambda step: moved.append(moved[-1] + step.displacements))
        phi, gain = s.history["phi"], s.history["gain"]
        self.show(s)
        numbers = self.page.run("data.steps.map(s => s.number)")
        self.assertEqual((numbers[0], numbers[-1]), (0, len(phi)))
        self.assertTrue(3 <= len(numbers) <= 6 and len(set(np.diff(numbers[:-1]))) == 1, numbers)
        self.assertTrue(self.page.run("atEnd()"))
        self.page.run("parts.step.focus()")
        for at in range(len(numbers) - 2, -1, -1):
            self.page.key("ArrowLeft")
            self.assertEqual(self.page.run("state.step"), at)
            where = np.array(
                self.page.run(
                    "Array.from({length: n}, (_, i) => scene.sphere.slice(4 * i, 4 * i + 2))" ".map(a => Array.from(a))"
                )
            )
            off = where - start - moved[numbers[at]]
            self.assertLess(np.abs(off - np.round(off)).max(), 1e-6, f"step {numbers[at]}")  # floats in a unit box
            self.assertTrue((where >= 0).all() and (where <= 1).all())
            size = small * np.prod(1 + gain[: numbers[at]])
            self.assertAlmostEqual(self.page.run("2 * scene.sphere[3]") / size, 1, delta=1e-6)
            shown = self.page.run("document.getElementById('step').innerText")
            told = 0.5 if at == 0 else phi[numbers[at] - 1]
            self.assertIn(f"{told:.9f}"[:10], shown)
            self.assertIn(f"{numbers[at]} of {len(phi)}", self.page.run("parts.stepShown.value"))
            self.assertIn(f"step {numbers[at]} of {len(phi)}, ", self.page.run("parts.step.ariaValueText"))
        # the picture follows: at the start the disks cover what they covered then
        self.page.run("state.images = true; state.box = false; rebuild()")
        self.page.settle()
        self.assertAlmostEqual(self.covered(), 0.5, delta=0.01)
        self.assertEqual(self.page.run("scene.sticks"), 0)  # forces belong to the end
        self.page.run("canvas.focus()")
        for _ in numbers:
            self.page.key(".")
        self.assertTrue(self.page.run("atEnd()"))
        self.assertAlmostEqual(self.page.run("Math.max(...distance)"), 0, delta=1e-15)
        self.assertGreaterEqual(self.page.run("scene.sticks"), 2 * len(s.forces))
        self.page.key(",")
        self.assertEqual(self.page.run("state.step"), len(numbers) - 2)
        self.page.resize(400, 700)  # a telephone: nothing is wider than the screen
        wide = self.page.run("document.documentElement.scrollWidth - document.documentElement.clientWidth")
        self.page.resize(1200, 800)
        self.assertEqual(wide, 0)

    def test_no_frame_shows_a_squeezed_picture(self):
        """The first frame after a change of size has a picture of that size: a frame is done when a task after it runs."""
        self.show(self.disks)
        ratios = self.page.run("""new Promise((done) => {
          document.body.style.width = "70%";
          requestAnimationFrame(() => setTimeout(() => done([canvas.width / canvas.height, canvas.clientWidth / canvas.clientHeight])));
        })""")
        self.assertAlmostEqual(*ratios, delta=0.01)

    def test_slider_follows_a_free_cell(self):
        s = jam.System.random(n=40, dim=2, seed=2, diameters=[1.0] * 20 + [1.4] * 20, packing_fraction=0.6)
        s.crunch(strain="free", keep_steps=50)
        self.show(s)
        last = self.page.run("lastStep")
        cells = np.array(self.page.run("data.steps.map((_, k) => (takeStep(k), cell))"))
        np.testing.assert_array_equal(cells[0], np.eye(2))
        np.testing.assert_array_equal(cells[last], s.cell)
        self.assertGreater(np.abs(cells[last] - cells[0]).max(), 1e-4)
        np.testing.assert_allclose(np.linalg.det(cells), 1, rtol=1e-12)
        self.page.run("takeStep(lastStep - 1)")
        inside = np.linalg.solve(
            cells[last - 1].T, np.array(self.page.run("Array.from({length: n}, (_, i) => placed(i).slice(0, 2))")).T
        )
        self.assertTrue((inside > -1e-6).all() and (inside < 1 + 1e-6).all())

    @unittest.skipUnless(os.environ.get("JAM_PACK"), "jam-pack is not built")
    def test_jam_pack_writes_it(self):
        page = self.path / "pack.html"
        words = f"--n 64 --dim 2 --diameters-ratio 1.4 --quiet --page {page} --page-steps 5".split()
        self.assertIn(subprocess.run([os.environ["JAM_PACK"], *words]).returncode, (0, 1))
        self.page.open(page)
        self.assertEqual(self.page.run("scene.count"), 64)
        self.assertIn("Collectively jammed", self.page.run("document.querySelector('#certificate .verdict').innerText"))
        self.assertTrue(2 <= self.page.run("data.steps.length") <= 6)


if __name__ == "__main__":
    if browser.find() is None:
        print("Chromium is not installed (Debian: chromium): the page was not looked at")
        sys.exit(77)
    if "--store" in sys.argv:
        store()
    else:
        unittest.main()
