"""Making, copying, viewing and closing systems from Python; what arrays are taken."""
import copy
import gc
import os
import pickle
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

import jam


class Making(unittest.TestCase):
    def test_random_has_what_was_asked(self):
        s = jam.System.random(n=100, dim=2, seed=5, packing_fraction=0.3, box=2.0)
        self.assertEqual((s.n, s.dim, s.seed, s.box, len(s)), (100, 2, 5, 2.0, 100))
        self.assertAlmostEqual(s.packing_fraction, 0.3, 12)
        self.assertEqual(s.positions.shape, (100, 2))
        self.assertEqual(s.diameters.shape, (100,))
        self.assertTrue((s.positions >= 0).all() and (s.positions < 2).all())

    def test_other_dtypes_orders_and_strides_are_copied_once(self):
        x = np.random.default_rng(1).random((20, 3))
        want = jam.System.from_arrays(x, 1e-3).positions
        wide = np.zeros((20, 6))
        wide[:, ::2] = x
        for given in (np.asfortranarray(x), wide[:, ::2], x.tolist(), x[::-1][::-1]):
            np.testing.assert_array_equal(jam.System.from_arrays(given, 1e-3).positions, want)
        single = jam.System.from_arrays(x.astype(np.float32), 1e-3).positions
        np.testing.assert_array_equal(single, x.astype(np.float32).astype(float))
        whole = jam.System.from_arrays(np.arange(6).reshape(2, 3), 0.1, box=8)
        np.testing.assert_array_equal(whole.positions, [[0, 1, 2], [3, 4, 5]])

    def test_wrong_shapes_and_kinds_are_refused(self):
        for bad in (np.zeros(6), np.zeros((2, 3, 1)), 1.0):
            with self.assertRaises(ValueError):
                jam.System.from_arrays(bad, 0.1)
        with self.assertRaises(ValueError):
            jam.System.from_arrays(np.zeros((2, 3)), [0.1, 0.1, 0.1])
        with self.assertRaises(TypeError):
            jam.System.from_arrays(np.zeros((2, 3), complex), 0.1)
        s = jam.System.random(n=10)
        with self.assertRaises(ValueError):
            s.positions = s.positions.T
        with self.assertRaises(ValueError):
            s.velocities = np.zeros((9, 3))
        for given in (np.zeros(60, np.float32), np.zeros(30, int), np.zeros(60)[::2], "text", 3):  # C would read other numbers
            with self.assertRaises((TypeError, BufferError, ValueError)):
                jam.raw.jam_set_velocities(s.handle, given)
        with self.assertRaises(BufferError):  # nor may C write here
            jam.raw.jam_coordination(s.handle, b"read-only")

    def test_texts_reach_c_as_they_are(self):
        """Names that are not UTF-8 come from the system with lone surrogates."""
        s = jam.System.random(8, 2)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "p\udcff.html")
            shown = {"é \u2200 \U0001f600": "é \u2200 \U0001f600", "a\udcff": "a\\\\xff", "a\ud800": "a\\\\ud800", b"a\xc3\xa9": "aé"}
            for title, text in shown.items():
                s.page(path, title)
                with open(path, "rb") as file:
                    self.assertIn(('{"title": "%s"' % text).encode(), file.read())
            s.page(path, values={"a\udcff": range(8)})
            for title, kind in (("a\0b", ValueError), (1, TypeError), (Path("a"), TypeError)):
                with self.assertRaises(kind):
                    s.page(path, title)

    def test_errors_are_classes_with_text(self):
        with self.assertRaises(jam.errors.DimensionError) as caught:
            jam.System.random(dim=9)
        self.assertIn("9", str(caught.exception))
        self.assertEqual(caught.exception.status, jam.StatusCode.E_DIMENSION)
        self.assertIsInstance(caught.exception, (jam.JamError, ValueError))
        with self.assertRaises(OSError):
            jam.System.read("/does/not/exist")
        with self.assertRaises(jam.errors.StateError):
            jam.System.random(n=10).report
        with self.assertRaisesRegex(TypeError, "packing_fraction"):
            jam.System.random(fraction=0.2)
        with self.assertRaisesRegex(ValueError, "euclid"):
            jam.System.random(model="hard")
        for code in jam.StatusCode:
            if code < 0:
                self.assertTrue(issubclass(jam._api.exceptions.BY_STATUS[code], jam.JamError))


class Views(unittest.TestCase):
    def test_no_copy_and_read_only(self):
        s = jam.System.random(n=10)
        a, b = s.positions, s.positions
        self.assertEqual(a.ctypes.data, b.ctypes.data)
        self.assertEqual(a.ctypes.data, jam.raw.jam_view(s.handle, jam.raw.JAM_VIEW_POSITIONS)[1][0])
        with self.assertRaises(ValueError):
            a[0, 0] = 1
        with self.assertRaises(ValueError):
            a.flags.writeable = True

    def test_view_follows_the_system(self):
        s = jam.System.random(n=10)
        view, moved = s.positions, (s.positions + 0.25) % 1.0
        s.positions = moved
        np.testing.assert_array_equal(view, moved)

    def test_view_has_the_byte_order_of_this_machine(self):
        s = jam.System.random(8, 2)
        self.assertTrue(s.positions.dtype.isnative)
        other = s.positions.astype(np.dtype("f8").newbyteorder())
        with self.assertRaisesRegex(TypeError, "format"):
            jam.raw.jam_set_positions(s.handle, other.reshape(-1))

    def test_view_keeps_the_memory_alive(self):
        view = jam.System.random(n=5000, seed=9).positions
        want = jam.System.random(n=5000, seed=9).positions.copy()
        gc.collect()
        hold = [np.full(15000, k, float) for k in range(20)]  # would take the freed memory
        np.testing.assert_array_equal(view, want)
        del hold

    def test_closed(self):
        s = jam.System.random(n=10)
        view, copied = s.positions, s.positions.copy()
        with s:
            pass
        for use in (
            lambda: s.n,
            lambda: s.positions,
            lambda: s.crunch(),
            lambda: s.copy(),
            lambda: s.report,
            lambda: s.cancel(),
        ):
            with self.assertRaises(jam.errors.ClosedError):
                use()
        self.assertEqual(repr(s), "System(closed)")
        np.testing.assert_array_equal(view, copied)
        s.close()


class Copies(unittest.TestCase):
    def check_same(self, a, b):
        np.testing.assert_array_equal(a.positions, b.positions)
        np.testing.assert_array_equal(a.diameters, b.diameters)
        np.testing.assert_array_equal(a.velocities, b.velocities)
        self.assertEqual((a.box, a.seed, a.dim), (b.box, b.seed, b.dim))

    def test_copy_is_deep(self):
        a = jam.System.random(n=20, seed=2, box=3.0)
        for b in (a.copy(), copy.copy(a), copy.deepcopy(a)):
            self.check_same(a, b)
            before = a.positions.copy()
            b.positions = (b.positions + 0.1) % 3.0
            np.testing.assert_array_equal(a.positions, before)

    def test_no_error_of_a_state_names_a_file(self):
        from jam.system import restore

        for have in (True, False):
            patch = mock.patch.object(os, "memfd_create", os.memfd_create if have else mock.Mock(side_effect=OSError), create=True)
            with patch, self.assertRaisesRegex(jam.errors.FormatError, "^the state of the system is no checkpoint"):
                restore(b"damaged", [], [])

    def test_pickle_without_files_in_memory_or_without_a_disk(self):
        a = jam.System.random(32, 3, 7)
        usual = pickle.dumps(a)
        with mock.patch.object(os, "memfd_create", side_effect=OSError, create=True):
            self.assertEqual(pickle.dumps(a), usual)
            self.check_same(a, pickle.loads(usual))
        if sys.platform == "linux":
            with mock.patch.object(tempfile, "tempdir", "/no/such/folder"):
                self.assertEqual(pickle.dumps(a), usual)
                self.check_same(a, pickle.loads(usual))

    def test_pickles_and_checkpoints_go_on_to_the_same_bits(self):
        for options in ({}, {"model": "mk"}, {"model": "mk", "mk_zeta": 1.0}):
            a = jam.System.random(n=64, seed=7, **options)
            a.compress(growth_rate=0.1, pressure=30)
            with tempfile.TemporaryDirectory() as folder:
                a.write_checkpoint(folder + "/c")
                b = jam.System.from_checkpoint(folder + "/c")
            c = pickle.loads(pickle.dumps(a))
            self.assertEqual((str(b.info), str(c.info)), (str(a.info), str(a.info)))  # contact_gap is NaN, which equals nothing
            for s in (a, b, c):
                s.compress(growth_rate=0.1, pressure=300)
            self.check_same(a, b)
            self.check_same(a, c)
        with self.assertRaises(jam.errors.FormatError):
            jam.System.from_checkpoint(__file__)

    def test_crunch_keeps_checkpoints(self):
        s = jam.System.random(n=100, dim=3, seed=1)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "crunch")
            s.crunch(checkpoint=file, checkpoint_every=0, on_step=lambda step: None, progress=lambda p: False)
            self.assertTrue(s.report.jammed)
            amid = jam.System.from_checkpoint(file)
            self.assertEqual(amid.info.paused, jam.Phase.CRUNCH)
            self.assertTrue(amid.crunch().jammed)
            amid = jam.System.random(n=100, dim=3, seed=1)
            amid.crunch(checkpoint=file, progress=lambda p: True)
            self.assertEqual(jam.System.from_checkpoint(file).packing_fraction, amid.packing_fraction)

    def test_a_crunch_at_a_duality_gap_goes_on_from_its_checkpoint(self):
        a = jam.System.random(n=100, dim=3, seed=2)
        a.compress(growth_rate=1e-2, pressure=1e4)
        with tempfile.TemporaryDirectory() as folder:
            report = a.crunch(duality_gap=1e-7, checkpoint=folder + "/c")
            again = jam.System.from_checkpoint(folder + "/c")
        self.assertEqual(again.info.paused, jam.raw.JAM_PHASE_CRUNCH)
        rest = again.crunch()
        self.assertEqual((report.status.name, report.stop_reason.name, report.jammed), ("OK", "DUALITY_GAP", False))
        self.assertTrue(rest.jammed)
        self.assertGreater(rest.packing_fraction, report.packing_fraction)


class Importing(unittest.TestCase):
    def test_import_loads_neither_matplotlib_nor_scipy(self):
        code = "import jam, sys; sys.exit(bool({'matplotlib', 'scipy'} & set(sys.modules)))"
        self.assertEqual(subprocess.run([sys.executable, "-c", code]).returncode, 0)

    def test_docstrings_tell_shapes(self):
        self.assertIn("(n, d)", jam.System.positions.__doc__)
        self.assertIn("n, d", jam.raw.jam_create.__doc__)
        for name in dir(jam.System):
            if not name.startswith("_"):
                self.assertTrue(getattr(jam.System, name).__doc__, name)
