"""Ctrl-C ends every call that takes long: also setters, const calls, and those that make a system or read one."""
import os
import signal
import tempfile
import threading
import unittest

import jam
import numpy as np

N = 20000  # all pairs of so many Mari-Kurchan spheres take many seconds


class Interrupts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        signal.signal(signal.SIGINT, signal.default_int_handler)  # a background job starts with it ignored
        cls.folder = tempfile.TemporaryDirectory()
        cls.quenched = jam.System.random(n=N, seed=1, packing_fraction=1e-6, model="mk", mk_zeta=0.0)
        cls.file, cls.state = (os.path.join(cls.folder.name, name) for name in ("packing.dat", "state"))
        cls.quenched.write(cls.file)
        cls.quenched.write_checkpoint(cls.state)
        cls.positions = np.array(cls.quenched.positions)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def check_interrupted(self, call):
        timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            call()
            timer.join()  # the call was quicker than the timer: a failure, without a stray signal
        timer.join()

    def test_setters(self):
        s = self.quenched
        for call in (
            lambda: setattr(s, "positions", 1.0 - self.positions),
            lambda: s.strain([[0, 0.01, 0], [0, 0, 0], [0, 0, 0]]),
        ):
            self.check_interrupted(call)
            self.assertTrue(np.array_equal(s.positions, self.positions))
            self.assertTrue(np.array_equal(s.cell, np.eye(3)))

    def test_systems_in_the_making(self):
        kind = {"model": "mk", "mk_zeta": 0.0}
        cell = [[1, 0, 0], [0.25, 1, 0], [0, 0.25, 1]]
        sizes = np.array(self.quenched.diameters)
        self.check_interrupted(lambda: jam.System.read(self.file, **kind))
        self.check_interrupted(lambda: jam.System.from_checkpoint(self.state))
        self.check_interrupted(lambda: jam.System.from_arrays(self.positions, sizes, cell=cell, **kind))
        with self.assertRaises(jam.errors.StoppedError):
            jam.System.read(self.file, wall_time=0.05, **kind)

    def test_const_calls(self):
        s = jam.System.random(n=N, seed=1)
        for call in (
            lambda: s.bond_order(64, 3.0),
            lambda: s.estimate_crunch(neighbour_radius=4.0),
        ):
            self.check_interrupted(call)

    def test_cancel_of_another_thread(self):
        s = self.quenched
        threading.Timer(0.2, s.cancel).start()
        with self.assertRaises(jam.errors.StoppedError):
            s.scale_diameters(1.0 + 1e-9)
