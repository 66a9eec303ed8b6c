"""Pictures: every function draws on given axes or on its own, without a display and without state."""
import subprocess
import sys
import unittest

import numpy as np

import jam


def ink(figure, darker_than=250):
    """Share of pixels with a channel below this; of 255 white."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return float((np.asarray(canvas.buffer_rgba())[..., :3] < darker_than).any(-1).mean())


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.flat = jam.System.random(n=60, dim=2, seed=3, diameters=[1.0, 1.4] * 30)
        cls.flat.crunch()
        cls.deep = jam.System.random(n=64, dim=3, seed=2)
        cls.deep.crunch()

    def test_packing_and_network(self):
        for s in (self.flat, self.deep):
            self.assertGreater(ink(jam.plot.packing(s).figure), 0.15)
            self.assertGreater(ink(jam.plot.network(s).figure), 0.03)
            self.assertGreater(ink(jam.plot.summary(s)), 0.05)
        dark = [ink(jam.plot.packing(self.flat, forces=f, legend=False).figure, 40) for f in (False, True)]
        self.assertGreater(dark[1], dark[0] + 0.01)
        ax = jam.plot.packing(self.flat)
        self.assertEqual(
            sum(len(c.get_offsets()) >= 60 for c in ax.collections[:1]), 0
        )  # one collection for each image of the box
        self.assertGreaterEqual(sum(len(c.get_offsets()) for c in ax.collections), 60)
        self.assertTrue(all(len(c.get_offsets()) for c in ax.collections))  # an empty one would draw a stray circle

    def test_spheres_in_three_dimensions_are_one_collection_from_far_to_near(self):
        ax = jam.plot.packing(self.deep, view=(0, 0), legend=False)
        (balls,) = ax.collections  # one for each sphere took 6 ms a sphere
        centres, colours = balls.get_offsets(), balls.get_facecolors()
        order = np.argsort(-self.deep.positions[:, 1])  # the view is along the second axis
        expected = self.deep.positions[order][:, [0, 2]] - 0.5 * self.deep.box
        self.assertLess(abs(centres[::2] - expected).max(), 1e-12)
        self.assertLess(abs(np.linalg.norm(centres[1::2] - centres[::2], axis=1) / self.deep.diameters[order] - 0.21).max(), 0.01)
        self.assertTrue((colours[1::2, :3] >= colours[::2, :3]).all())  # highlights are lighter

    def test_summary_of_soft_spheres(self):
        s = jam.System.random(64, 3, packing_fraction=0.7, overlap="allow", seed=1)
        s.relax()
        for wanted in ("overlap / contact distance", "distance from jamming"):
            figure = jam.plot.summary(s)
            for ax in figure.axes[2:]:
                self.assertTrue(all(len(line.get_xdata()) > 4 for line in ax.lines) and ax.lines)
            self.assertEqual([line.get_label() for line in figure.axes[2].lines], ["forces"])  # no slopes of jamming
            self.assertIn(wanted, figure.axes[3].get_xlabel())
            s.decompress(crunch=0)

    def test_values_colour_the_spheres(self):
        for s in (self.flat, self.deep):
            values = s.coordination.astype(float)
            values[s.rattlers] = np.nan
            figure = jam.plot.packing(s, values=values, label="contacts").figure
            self.assertEqual(figure.axes[1].get_ylabel(), "contacts")
            self.assertEqual(figure.axes[1].get_ylim(), (np.nanmin(values), np.nanmax(values)))
            self.assertEqual(len(jam.plot.packing(s, values=values, legend=False).figure.axes), 1)
        most = [c.get_facecolors() for c in jam.plot.packing(self.flat, values=np.arange(60)).collections]
        self.assertGreaterEqual(len(np.unique(np.concatenate(most), axis=0)), 60)  # each its own
        for values in (np.zeros(3), np.full(60, np.nan)):
            with self.assertRaisesRegex(ValueError, "values"):
                jam.plot.packing(self.flat, values=values)

    def test_arrows_point_along_the_mode(self):
        from matplotlib.quiver import Quiver

        for s in (self.flat, self.deep):
            modes = s.modes(3)
            ax = jam.plot.mode(s, modes, 1)
            (arrows,) = [c for c in ax.collections if isinstance(c, Quiver)]
            self.assertEqual(len(arrows.U), s.report.stable)
            self.assertIn(f"{modes.frequencies[1]:.4g}", ax.get_title())
            if s.dim == 2:
                drawn, u = np.stack([arrows.U, arrows.V], 1), modes.vectors[1]
                factor = 0.8 * s.diameters.mean() / np.linalg.norm(u, axis=1).max()
                np.testing.assert_allclose(drawn, factor * u, atol=1e-12)
                np.testing.assert_allclose(arrows.XY, s.positions[modes.spheres], atol=1e-12)
            self.assertGreater(ink(ax.figure), 0.1)
        with self.assertRaisesRegex(ValueError, "shape"):
            jam.plot.displacements(self.flat, np.zeros((3, 2)))
        self.assertEqual(len(jam.plot.displacements(self.flat, np.zeros((60, 2))).texts), 0)  # nothing moves

    def test_contacts_without_forces(self):
        for dim in (2, 3):
            s = jam.System.random(n=100, dim=dim, seed=3, packing_fraction=0.3)
            s.compress(packing_fraction=0.55)
            s.contacts_by_distance(0.1)
            ax = jam.plot.network(s)
            self.assertIn("gaps below 0.1", ax.get_title())
            widths = [w for c in ax.collections for w in c.get_linewidths()]
            self.assertTrue(np.isfinite(widths).all())
            self.assertGreater(ink(ax.figure), 0.01)
            figure = jam.plot.summary(s)
            gaps, spheres = (sum(bar.get_height() for bar in a.patches) for a in figure.axes[2:])
            self.assertEqual((gaps, spheres), (len(s.contacts), 100))

    def test_before_crunch_and_wrong_dimension(self):
        self.assertGreater(ink(jam.plot.packing(jam.System.random(n=20, dim=2)).figure), 0.05)
        with self.assertRaises(jam.errors.StateError):
            jam.plot.network(jam.System.random(n=20, dim=2))
        with self.assertRaises(ValueError):
            jam.plot.packing(jam.System.random(n=10, dim=4, packing_fraction=0.05))

    def test_curves(self):
        ax = jam.plot.cdf(self.flat.forces, slopes=[1.2], label="forces")
        self.assertEqual(len(ax.lines), 2)
        x, c = ax.lines[0].get_data()
        self.assertTrue((np.diff(x) >= 0).all() and c[-1] == 1.0)
        t, y = ax.lines[1].get_data()
        self.assertAlmostEqual(np.log(y[1] / y[0]) / np.log(t[1] / t[0]), 1.2, 9)
        with self.assertRaises(ValueError):
            jam.plot.cdf([-1.0, 0.0])
        modes = self.flat.modes(which="all")
        states = self.deep.density_of_states()
        line = jam.plot.density_of_states(states).lines[0]
        np.testing.assert_array_equal(line.get_xydata(), np.c_[states.omega, states.density])
        with self.assertRaisesRegex(ValueError, "frequencies"):
            jam.plot.density_of_states(np.ones((3, 4)))
        ax = jam.plot.density_of_states(modes)
        edges, values = ax.patches[0].get_data().edges, ax.patches[0].get_data().values
        self.assertAlmostEqual((values * np.diff(edges)).sum(), 1 - 2 / len(modes), 6)  # all but the translations
        ax, h = jam.plot.convergence(self.flat), self.flat.history
        self.assertEqual(
            [len(line.get_xdata()) for line in ax.lines], [(h["gain"] > 0).sum(), (h["step_max"] > 0).sum()]
        )
        self.assertEqual(list(ax.lines[0].get_xdata()), list(np.cumsum(h["factorisations"])[h["gain"] > 0]))
        self.assertGreater(len(jam.plot.convergence(self.flat.trace).lines), 0)
        record = lambda phi, p: jam.Progress(2, phi, p, 0.0, 0.0, 0.0, 0.0, 10, 0, 0, 0, 0.0, 0.0)  # noqa: E731
        ax = jam.plot.trace([record(0.3, 5.0), record(0.5, 20.0), record(0.5, float("nan"))])
        self.assertEqual(list(ax.lines[0].get_ydata()), [5.0, 20.0])

    def test_axes_are_taken_and_no_pyplot_is_needed(self):
        from matplotlib.figure import Figure

        axes = Figure().subplots(1, 2)
        self.assertIs(jam.plot.packing(self.flat, axes[0]), axes[0])
        self.assertIs(jam.plot.cdf(self.flat.forces, axes[1]), axes[1])
        code = (
            "import jam, sys; s = jam.System.random(n=20, dim=2); jam.plot.packing(s).figure.savefig('/dev/null', format='png');"
            "sys.exit('matplotlib.pyplot' in sys.modules)"
        )
        self.assertEqual(
            subprocess.run([sys.executable, "-c", code], env={**__import__("os").environ, "DISPLAY": ""}).returncode, 0
        )
