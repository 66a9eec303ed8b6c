"""Memory after hundreds of cycles of making, viewing, calling and destroying; and of failing."""
import gc
import resource
import unittest

import numpy as np

import jam


def resident():
    """Kilobytes in use now."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize() // 1024


def grown(cycle, count=1000):
    for _ in range(count // 5):
        cycle()
    gc.collect()
    before = resident()
    for _ in range(count):
        cycle()
    gc.collect()
    return resident() - before


class Leaks(unittest.TestCase):
    def test_create_view_destroy(self):
        x = np.random.default_rng(1).random((2000, 3))  # 48 kB in, so 300 leaks are 14 MB or more

        def cycle():
            s = jam.System.from_arrays(x + 0.0, 1e-4)  # new arrays: one that is never released shows
            s.velocities = x + 0.0
            s.positions[0], s.copy().diameters[0], s.info

        self.assertLess(grown(cycle, 300), 4000)

    def test_failures_and_callbacks(self):
        small = jam.System.random(n=12, dim=2, seed=1)
        x = np.random.default_rng(1).random((2000, 3))
        x[7] = x[3]  # refused

        def cycle():
            for call in (
                lambda: jam.System.from_arrays(x, 1e-4),
                lambda: jam.System.random(dim=9),
                lambda: jam.raw.jam_set_positions(small.handle, x.astype(np.float32)),
            ):
                try:
                    call()
                    self.fail("not refused")
                except (jam.JamError, TypeError):
                    pass

        self.assertLess(grown(cycle, 300), 4000)

    def test_crunch_results(self):
        s = jam.System.random(n=30, dim=2, seed=3, diameters=[1.0, 1.4] * 15)
        s.crunch()

        def cycle():
            c = s.copy()
            c.report, c.contacts, c.forces, c.coordination
            try:
                c.crunch(progress=lambda p: 1 / 0)
            except ZeroDivisionError:
                pass

        self.assertLess(grown(cycle), 4000)
