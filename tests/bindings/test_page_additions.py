"""What the page of a packing adds to its spheres, in a real browser: forces, gaps, modes, walls, files, thinning."""
import base64
import sys
import unittest
from xml.etree import ElementTree

import numpy as np
from PIL import Image

import browser
import jam
from jam._api.given import closed_axes
from test_page import PageTest, disks, pixels


class Additions(PageTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.disks = disks()

    def test_forces_colour_the_contacts_and_the_legend_says_so(self):
        self.show(self.disks)
        self.page.run("document.getElementById('legend').style.display = ''; state.box = false; rebuild()")
        tints = self.page.run("Array.from(scene.stick.tint)")
        shown = np.array(tints).reshape(-1, 4)[::2, :3]  # two half lines a contact
        light = shown @ np.array([0.299, 0.587, 0.114])
        order = np.argsort(self.disks.forces)
        self.assertTrue((np.diff(light[order]) <= 0.5).all())  # darker with the force, so that grey shows it too
        self.assertIn("3 and more", self.page.run("document.getElementById('legend').innerText"))
        self.page.run("parts.forceColours.click()")
        tints = self.page.run("Array.from(scene.stick.tint)")
        self.assertEqual(len({tuple(tints[k : k + 3]) for k in range(0, len(tints), 4)}), 1)

    def test_slider_shows_the_pairs_with_small_gaps(self):
        sheared = jam.System.random(n=60, dim=2, seed=3, cell=[[1, 0], [0.45, 1]], packing_fraction=0.3)
        salt, mixed = jam.System.random(n=300, dim=3, seed=2), jam.System.random(
            n=40, dim=2, seed=1, diameters=[1.0, 1.4] * 20, non_additivity=0.2
        )
        salt.compress(pressure=100)
        for s in (self.disks, salt, sheared, mixed):
            self.show(s)
            want = s.gaps(0.2, False)
            found = np.array(self.page.run("nearPairs().gap"))
            np.testing.assert_allclose(found, want.gap, rtol=1e-9, atol=1e-12)
            pairs = np.array(self.page.run("nearPairs().pair")).reshape(-1, 2)
            self.assertEqual(set(map(tuple, pairs)), set(map(tuple, np.sort(want.pair, axis=1))))
        self.show(self.disks)
        self.page.run("canvas.focus(); state.forces = 0; state.box = false")
        self.page.key("g")
        self.assertEqual(self.page.run("scene.sticks"), 2 * len(self.disks.gaps(0.05, False).gap))

    def places(self):
        """Where the centres stand on the screen, the second axis upwards."""
        found = "Array.from({length: n}, (_, i) => onCanvas(scene.owner.indexOf(i), viewNow())).map(o => [o.u, -o.v])"
        return np.array(self.page.run(found))

    def test_modes_swing_about_the_packing(self):
        modes = self.disks.modes(2)
        push = np.random.default_rng(1).normal(size=(self.disks.n, 2))
        self.show(self.disks, modes=modes, values={"push": push})
        self.assertEqual(self.page.run("motions.length"), 3)
        whole = np.zeros((self.disks.n, 2))
        whole[modes.spheres] = modes.vectors[1]
        for name, vectors in (("push", push), (f"mode 1, omega {modes.frequencies[1]:.4g}", whole)):
            k = self.page.run("motions.findIndex(m => m.name === '" + name + "')")
            self.page.run(f"state.motion = {k}; oscillation.amplitude = 0.5; rebuild(); play(false); setPhase(1)")
            self.page.settle()
            moved = self.places()
            self.page.run("phase = oscillation.phase; oscillation.phase = 0")
            still = self.places()
            self.page.run("oscillation.phase = phase")
            scale = self.page.run("viewNow().scale")
            want = 0.5 * self.disks.diameters.mean() * vectors / np.linalg.norm(vectors, axis=1).max()
            np.testing.assert_allclose((moved - still) / scale, want, atol=2e-5)
            image = pixels(self.page, self.path / "a.png")
            self.page.run("setPhase(0)")
            self.page.settle()
            self.assertGreater(np.abs(image - pixels(self.page, self.path / "a.png")).max(), 100)  # drawn elsewhere
        self.page.run("canvas.focus(); parts.motion.value = 0; parts.motion.dispatchEvent(new Event('change'))")
        self.page.key("m")
        self.assertEqual(self.page.run("[state.motion, oscillation.running]"), [0, True])
        self.page.key(" ")
        self.assertFalse(self.page.run("oscillation.running"))
        with self.assertRaisesRegex(ValueError, "shape"):
            self.disks.page(self.path / "x.html", values={"push": push[:, :1].repeat(3, axis=1)})

    def test_saved_pictures_have_a_caption_with_the_numbers(self):
        self.show(self.disks)
        svg = ElementTree.fromstring(self.page.run("pictureSvg()"))
        name = "{http://www.w3.org/2000/svg}"
        self.assertEqual(len(svg.findall(f".//{name}circle")), self.disks.n)
        self.assertEqual(len(svg.findall(f".//{name}path")), 2 * len(self.disks.forces) + 4)
        text = " ".join(t.text for t in svg.findall(f".//{name}text"))
        fraction = f"{self.disks.packing_fraction:.12g}"[:12]
        for word in (f"N = {self.disks.n}", fraction, f"{len(self.disks.forces)} contacts"):
            self.assertIn(word, text)
        self.assertIn("packing fraction", svg.find(f"{name}desc").text)
        size, png = self.page.run("[canvas.width, canvas.height]"), self.path / "saved.png"
        png.write_bytes(base64.b64decode(self.page.run("picturePng()").split(",")[1]))
        image = np.asarray(Image.open(png).convert("L"))
        self.assertEqual(image.shape[1], size[0])
        self.assertGreater((image[size[1] :] < 100).sum(), 200)  # the caption below it

    def test_containers_are_drawn_and_nothing_repeats_across_a_wall(self):
        for options in (
            dict(n=80, container="cylinder", cell=[1, 1, 2]),
            dict(n=80, container="ball"),
            dict(n=80, dim=2, container="ball", packing_fraction=0.3),
            dict(n=80, cell=[1, 1, 2], walls="z"),
        ):
            s = jam.System.random(seed=1, **options)
            self.show(s)
            kind = options.get("container", "brick")
            walled = closed_axes(s.info)
            self.assertEqual(self.page.run("[data.container, ...closed]"), [kind, *walled])
            ends = np.array(self.page.run("Array.from(scene.stick.start)")).reshape(-1, 4)[:, : s.dim]
            axes = s.dim if kind == "ball" else 2
            if kind != "brick":
                off = np.linalg.norm((ends - np.diag(s.cell) / 2)[:, :axes], axis=1) - s.cell[0, 0] / 2
                self.assertLess(np.abs(off).max(), 1e-6)
            else:
                self.assertEqual(len(ends), 12)
            self.page.run("state.images = true; rebuild()")
            x = np.array(self.page.run("Array.from(scene.sphere)")).reshape(-1, 4)
            for c, ended in enumerate(walled):
                if ended:
                    self.assertTrue((x[:, c] >= 0).all() and (x[:, c] <= s.cell[c, c]).all())

    def test_forces_of_walls_end_at_the_walls(self):
        for options in (
            dict(n=60, dim=2, container="ball"),
            dict(n=60, container="cylinder", cell=[1, 1, 2], walls="z"),
            dict(n=60, walls="xyz"),
            dict(n=48, dim=4, walls=(True, False, False, True)),
        ):
            s = jam.System.random(seed=2, packing_fraction=0.1, **options)
            s.crunch()
            pairs, walls = s.contacts.pairs, s.walls()
            wall = np.flatnonzero(pairs[:, 1] < 0)
            self.assertGreater(len(wall), 0)
            self.show(s, modes=s.modes(1) if s.dim < 4 else None)
            if s.dim > 3:
                self.page.run("state.whole = true")
            self.page.run("state.forces = 1; state.box = false; rebuild()")
            self.assertEqual(self.page.run("scene.sticks"), 2 * len(pairs) - len(wall))  # one line at a wall
            lines = self.page.run("[Array.from(scene.stick.start), Array.from(scene.stick.stop)]")
            start, stop = np.array(lines).reshape(2, -1, 4)[:, :, : min(s.dim, 3)]
            first = 2 * np.arange(len(pairs)) - np.concatenate([[0], np.cumsum(pairs[:-1, 1] < 0)])
            for k in wall:
                w, end, begin = -1 - pairs[k, 1], stop[first[k]], start[first[k]]
                np.testing.assert_allclose(begin, s.positions[pairs[k, 0], : len(begin)], atol=1e-6)
                axis = int(walls.axis[w])
                if axis == s.dim:  # the round wall
                    axes = 2 if options["container"] == "cylinder" else s.dim
                    r = s.cell[0, 0] / 2
                    self.assertAlmostEqual(np.linalg.norm(end[:axes] - r), r, delta=1e-5)
                elif axis < 3:
                    self.assertAlmostEqual(end[axis], walls.side[w] * s.cell[axis, axis], delta=1e-5)
                else:  # across the screen
                    np.testing.assert_allclose(end, begin, atol=1e-6)
            i = int(pairs[wall[0], 0])
            self.page.run(f"choose({i})")
            touched = self.page.run("document.getElementById('chosen').innerText")
            self.assertIn(f"wall {-1 - pairs[wall[0], 1]}", touched)
            self.assertEqual(self.page.run(f"coordination[{i}]"), s.coordination[i])
            if s.dim < 4:
                near = s.gaps(0.2, False)
                want = {tuple(sorted(p)) for p in near.pair if p[1] >= 0}
                found = np.array(self.page.run("nearPairs().pair")).reshape(-1, 2)
                self.assertEqual(set(map(tuple, found)), want)

    def test_a_large_packing_is_thinned_out_while_it_moves_and_says_so(self):
        s = jam.System.random(n=100000, dim=3, seed=1, packing_fraction=0.3)
        self.show(s)
        self.assertTrue(self.page.run("document.getElementById('thinned').hidden"))
        told = self.page.run(
            "(async () => { for (let k = 0; k < 12; ++k) {"
            " rotate(0.02, 0); await new Promise(r => requestAnimationFrame(r)); }"
            " return [document.getElementById('thinned').textContent, thin.share, thin.coarse, canvas.width / canvas.clientWidth,"
            " scene.frame]; })()"
        )
        if told[1] < 1:  # a fast machine draws all
            self.assertRegex(told[0], r"while it moves: \d+ of 100000 spheres, the outer ones")
        self.assertEqual("at 0.5 of the resolution" in told[0], told[2])
        self.assertAlmostEqual(told[3], 0.5 if told[2] else 1.0, 2)
        self.assertEqual(told[4], 12)  # the edges of the cell, which are always drawn
        self.page.run("new Promise(r => setTimeout(r, 400))")
        self.page.settle()
        self.assertFalse(self.page.run("thin.moving"))
        self.assertEqual(self.page.run("canvas.width"), self.page.run("canvas.clientWidth"))
        self.assertTrue(self.page.run("document.getElementById('thinned').hidden"))
        self.assertEqual(self.page.run("scene.count"), s.n)
        # the first picture that moves is no slower than the others: its share follows from the one at rest
        first = "(() => { thin.whole = 100 * FRAME; beginMoving(); return thin.share; })()"  # no drawing adapts it meanwhile
        self.assertAlmostEqual(self.page.run(first), 0.02, 12)
        self.page.run("rotate(0.02, 0)")
        self.page.run("new Promise(r => setTimeout(r, 400))")
        self.page.settle()
        outer = np.array(self.page.run("Array.from(scene.sphere.slice(0, 4 * 20000))")).reshape(-1, 4)[:, :3]
        inner = np.array(self.page.run("Array.from(scene.sphere.slice(-4 * 20000))")).reshape(-1, 4)[:, :3]
        depth = lambda x: np.minimum(x, 1 - x).min(1)  # noqa: E731
        self.assertLess(depth(outer).max(), depth(inner).min())


if __name__ == "__main__":
    if browser.find() is None:
        print("Chromium is not installed (Debian: chromium): the page was not looked at")
        sys.exit(77)
    unittest.main()
