"""Long calls from Python: results, progress, exceptions, Ctrl-C, threads, cancel."""
import os
import signal
import threading
import traceback
import unittest

import numpy as np

import jam


def start(n=600, seed=1):
    """A system whose crunch lasts far longer than the test waits."""
    return jam.System.random(n=n, dim=3, seed=seed, packing_fraction=0.3)


def overlap(s):
    """Largest -h over all pairs, by numpy alone."""
    x, sigma, worst = s.positions / s.box, s.diameters / s.box, 0.0
    for i in range(len(x) - 1):
        r = x[i + 1 :] - x[i]
        r -= np.round(r)
        h = np.sqrt((r * r).sum(1)) / (0.5 * (sigma[i + 1 :] + sigma[i])) - 1
        worst = max(worst, -h.min())
    return worst


class Crunch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.s = jam.System.random(n=60, dim=2, seed=3, diameters=[1.0, 1.4] * 30)
        cls.report = cls.s.crunch()

    def test_report(self):
        r = self.report
        self.assertEqual(r.status, jam.StatusCode.OK)
        self.assertEqual(r.jammed, 1)
        self.assertIs(r.stop_reason, jam.StopReason.CONVERGED)
        self.assertEqual(r, self.s.report)
        text = repr(r)
        for word in ("packing_fraction", "converged", "excess_contacts"):
            self.assertIn(word, text)
        with self.assertRaises(Exception):
            r.contacts = 3

    def test_contacts_and_forces(self):
        s, r, c = self.s, self.report, self.s.contacts
        self.assertEqual(len(c), r.contacts)
        self.assertEqual(c.pairs.dtype, np.int32)
        self.assertEqual(c.vectors.shape, (r.contacts, 2))
        np.testing.assert_allclose((c.vectors**2).sum(1), 1, atol=1e-12)
        self.assertAlmostEqual(s.forces.mean(), 1, 12)
        net = np.zeros((s.n, 2))
        np.add.at(net, c.pairs[:, 0], c.vectors * c.forces[:, None])
        np.add.at(net, c.pairs[:, 1], -c.vectors * c.forces[:, None])
        self.assertLess(np.abs(net).max(), 1e-8)
        np.testing.assert_array_equal(s.coordination, np.bincount(c.pairs.reshape(-1), minlength=s.n))
        self.assertEqual(s.rattlers.sum(), r.rattlers)
        self.assertEqual(s.bucklers.sum(), r.bucklers)
        t = c.table()
        np.testing.assert_array_equal(t["force"], c.forces)
        np.testing.assert_array_equal(np.column_stack([t["n1"], t["n2"]]), c.vectors)
        self.assertLess(overlap(s), 1e-10)


class MolecularDynamics(unittest.TestCase):
    def test_every_step_is_shown(self):
        s, steps = jam.System.random(60, 2, 3), []
        before = s.positions.copy()
        r = s.crunch(on_step=steps.append)
        self.assertEqual((r.status, len(steps)), (0, len(s.history)))
        self.assertEqual(sum(len(t.duals) > 0 for t in steps), r.lp_solves)
        self.assertEqual((s.history["phase"] == jam.StepPhase.LP).sum(), r.lp_solves)
        moved = sum(t.displacements for t in steps) + before - s.positions
        self.assertLess(abs(moved - np.round(moved)).max(), 1e-12)
        last = [t for t in steps if len(t.duals)][-1]
        net = np.zeros((s.n, 2))
        np.add.at(net, last.pairs[:, 0], last.duals[:, None] * last.vectors)
        np.add.at(net, last.pairs[:, 1], -last.duals[:, None] * last.vectors)
        # LPs are accepted with forces balanced to 1e-5 of the mean; the rest is left to the polish
        self.assertLess(abs(net).max(), 1e-5 * (last.duals[:, None] * abs(last.vectors)).max())
        self.assertEqual(jam.System.random(60, 2, 3).crunch(on_step=lambda t: True).status, jam.StatusCode.CANCELLED)
        with self.assertRaises(ZeroDivisionError):
            jam.System.random(60, 2, 3).crunch(on_step=lambda t: 1 / 0)
        s.scale_diameters(0.9)
        self.assertRaises(jam.errors.StateError, lambda: s.history)

    def test_observing(self):
        s = jam.System.random(n=108, dim=3, seed=1, packing_fraction=0.3)
        s.run(10)
        before = s.positions.copy()
        with s.observing(sample_every=5, collisions=1, gap_bins=20, r_bins=30) as seen:
            r = s.run(40)
        s.run(10)  # no longer recorded
        rows = seen.series
        self.assertTrue((np.diff(rows["time"]) > 0).all() and len(rows) >= 7)
        self.assertEqual(seen.spheres.collisions.sum(), 2 * r.collisions)
        self.assertEqual(seen.pairs.collisions.sum(), r.collisions)
        self.assertEqual(
            (len(seen.gaps.low), len(seen.correlation.g), seen.spheres.displacement.shape), (20, 30, before.shape)
        )
        msd = (seen.spheres.displacement**2).sum(1).mean()
        self.assertGreater(msd, 0)
        with self.assertRaises(jam.errors.StateError):
            jam.System.random(n=10).call("observed_series")

    def test_growth_from_touching_spheres_names_the_mend(self):
        """Soft spheres relaxed until they touch collide without time to move: the pressure is not that of the density."""
        s = jam.System.random(300, 2, packing_fraction=0.81, overlap="allow", seed=3)
        self.assertEqual(s.relax(minimiser="fire").stop_reason.name, "UNJAMMED")  # comes to rest where the last pairs part
        alone = jam.System.from_arrays(s.positions, s.diameters)
        for found in (s.compress(packing_fraction=0.82), alone.compress(growth_rate=1e-3, pressure=1e3)):  # reached at once, without growth
            self.assertNotEqual(found.status.name, "OK")
            self.assertRegex(found.status_text, r"spheres touch at the start: .* scale_diameters\(0.99\)")
        s.scale_diameters(0.99)
        r = s.compress(packing_fraction=0.82)
        self.assertEqual((r.status.name, r.stop_reason.name), ("OK", "PACKING_FRACTION"))
        self.assertAlmostEqual(s.packing_fraction, 0.82, 9)

    def test_stages(self):
        s = jam.System.random(n=108, dim=3, seed=1)
        seen = []
        r = s.compress(
            stages=[(0.1, 50), {"growth_rate": 0.05, "packing_fraction": 0.6, "pressure": 300}],
            progress=lambda p: seen.append(p.phase),
        )
        self.assertEqual(r.status, 0)
        self.assertIn(r.stop_reason, (jam.StopReason.PRESSURE, jam.StopReason.PACKING_FRACTION))
        self.assertEqual(set(seen), {jam.Phase.COMPRESS})
        with self.assertRaises(ValueError):
            s.compress(stages=[])


class Callbacks(unittest.TestCase):
    def setUp(self):
        signal.signal(signal.SIGINT, signal.default_int_handler)  # a background job starts with it ignored

    def check_valid(self, s):
        self.assertTrue(np.isfinite(s.positions).all())
        self.assertLess(overlap(s), 1e-9)
        s.cancel()  # usable, and the next call stops at once
        self.assertEqual(s.crunch().status, jam.StatusCode.CANCELLED)

    def test_true_answer_stops(self):
        s, seen = start(), []
        r = s.crunch(progress=lambda p: seen.append(p) or len(seen) > 2)
        self.assertEqual(r.status, jam.StatusCode.CANCELLED)
        self.assertEqual(len(seen), 3)
        self.assertIs(seen[0].phase, jam.Phase.CRUNCH)
        self.assertEqual(s.trace, seen)
        self.check_valid(s)

    def test_exception_reaches_the_caller(self):
        class Mine(Exception):
            pass

        def raising(progress):
            raise Mine("from the callback")

        s = start()
        try:
            s.crunch(progress=raising)
            self.fail("nothing was raised")
        except Mine as error:
            names = [frame.name for frame in traceback.extract_tb(error.__traceback__)]
        self.assertIn("raising", names)
        self.check_valid(s)

    def test_the_record_keeps_calls_that_moved_and_those_alone(self):
        def raising(progress):
            raise jam.JamError("mine")

        def writing(progress):
            s.write("no/such/folder/x.xyz")

        for progress, kind in ((raising, jam.JamError), (writing, jam.errors.IoError), (lambda p: 1 / 0, ZeroDivisionError)):
            s = jam.System.random(n=64, dim=2, seed=1)
            before = s.positions.copy()
            with self.assertRaises(kind):
                s.run(2000, progress=progress)
            self.assertGreater(np.abs(s.positions - before).max(), 0.0)
            self.assertEqual([(c["verb"], c["status"]) for c in s.calls], [("run", "cancelled")])
            self.assertIs(s.status, jam.StatusCode.CANCELLED)
        for refused in (lambda: s.run(-1), lambda: s.run(1, progress=3), lambda: s.run(1, colour=2), s.relax):
            with self.assertRaises(Exception):
                refused()
            self.assertEqual(len(s.calls), 1)

    def test_a_checkpoint_that_cannot_be_written_is_a_warning(self):
        s, twin = (jam.System.random(n=60, dim=2, seed=3, diameters=[1.0, 1.4] * 30) for _ in range(2))
        with self.assertWarnsRegex(UserWarning, "no/such/folder/c"):
            report = s.crunch(checkpoint="no/such/folder/c", checkpoint_every=0.0)
        twin.crunch()
        np.testing.assert_array_equal(s.positions, twin.positions)
        self.assertEqual((report.jammed, s.calls[-1]["status"], s.status), (True, "ok", jam.StatusCode.OK))
        with self.assertWarnsRegex(UserWarning, "no/such/folder/c"):  # the one of an early end
            self.assertEqual(start().crunch(checkpoint="no/such/folder/c", wall_time=1e-6).status, jam.StatusCode.LIMIT)

    def test_exception_in_log_reaches_the_caller(self):
        def raising(level, line):
            raise KeyError(line)

        s = jam.System.random(n=60, dim=2, seed=3)
        s.log(raising, "debug")
        with self.assertRaises(KeyError):
            s.crunch()

    def test_keyboard_interrupt(self):
        for progress in (None, lambda p: False):
            s = start()
            timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
            timer.start()
            with self.assertRaises(KeyboardInterrupt):
                s.crunch(progress=progress)
            self.check_valid(s)

    def test_the_status_is_that_of_the_call_that_raised(self):
        def raising(progress):
            raise ValueError("of the callable")

        s = jam.System.random(n=200, dim=3, seed=1)
        s.rigidity()
        self.assertEqual(s.status, jam.StatusCode.NOT_JAMMED)
        threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            s.compress(growth_rate=1e-5)
        self.assertEqual(s.status, jam.StatusCode.CANCELLED)
        self.assertIn("resume", s.status_text)
        for call, status in (
            (lambda: s.moduli(), "E_STATE"),
            (lambda: s.run(-1), "E_ARGUMENT"),
            (lambda: s.run(1, colour=2), "E_ARGUMENT"),
            (lambda: s.run(1, progress=raising), "CANCELLED"),
            (lambda: s.call("bond_order", "x", 1.2), "E_ARGUMENT"),
            (lambda: s.write("no/such/folder/x.xyz"), "E_IO"),
            (lambda: s.scale_diameters(float("nan")), "E_ARGUMENT"),
            (lambda: s.modes(3, colour=1), "E_ARGUMENT"),
        ):
            s.contacts_by_distance(0.1)
            with self.assertRaises(Exception) as caught:
                call()
            self.assertEqual(s.status.name, status, caught.exception)
            if status != "CANCELLED":
                self.assertEqual(s.status_text, str(caught.exception))
        s.scale_diameters(0.5)
        self.assertEqual((s.status, s.status_text), (jam.StatusCode.OK, ""))


class Threads(unittest.TestCase):
    def test_second_call_is_refused_and_harms_nothing(self):
        s, entered, result = start(), threading.Event(), []
        thread = threading.Thread(target=lambda: result.append(s.crunch(progress=lambda p: entered.set())))
        thread.start()
        self.assertTrue(entered.wait(30))
        for call in (s.crunch, lambda: s.scale_diameters(0.5), lambda: s.run(1)):
            with self.assertRaises(jam.errors.BusyError):
                call()
        with self.assertRaises(jam.errors.BusyError):  # reading is for the thread that runs the verb
            s.positions
        handle = s.handle
        s.close()  # the running call keeps its handle
        self.assertRaises(jam.errors.ClosedError, s.cancel)
        jam.raw.jam_cancel(handle)
        thread.join(60)
        self.assertEqual(result[0].status, jam.StatusCode.CANCELLED)

    def test_why_a_crystal_does_not_decompress_to_an_isostatic_packing(self):
        rows = np.arange(4)
        x = np.array([((i + 0.5 * (j % 2)) % 4, j * np.sqrt(0.75)) for j in rows for i in rows])
        s = jam.System.from_arrays(x, 1.01, cell=[[4, 0], [0, 4 * np.sqrt(0.75)]], overlap="allow")
        self.assertEqual(s.decompress(crunch=0).status, jam.StatusCode.PRECISION)
        self.assertRegex(jam.raw.jam_last_error(), "17 contacts more than one state of self-stress needs")
