"""Calls that are cancelled: results that were never made are exceptions, and stages of growth go on."""
import tempfile
import unittest
from pathlib import Path

import numpy as np

import jam


class Cancelled(unittest.TestCase):
    """A result that was never made is an exception: neither zeros nor memory."""

    def test_analysis_that_is_cancelled_returns_nothing(self):
        s = jam.System.random(n=300, dim=3, seed=1)
        s.compress(growth_rate=0.1, pressure=1e4)
        s.crunch()

        def stop(progress):
            return True

        for call in (
            lambda: s.modes(10, progress=stop),
            lambda: s.flex("strict", progress=stop),
            lambda: s.moduli(progress=stop),
            lambda: s.check(progress=stop),
            lambda: s.stress_states(progress=stop),
            lambda: s.call("rigidity", "strict", progress=stop),
        ):
            with self.assertRaisesRegex(jam.errors.StoppedError, "stopped the call"):
                call()
        self.assertEqual(s.rigidity("collective").jammed, jam.Verdict.YES)

    def test_contacts_of_a_crunch_that_stopped_before_them_are_unknown(self):
        s = jam.System.random(n=300, dim=3, seed=2)
        s.compress(growth_rate=0.1, pressure=1e4)
        r = s.crunch(wall_time=1e-6)
        self.assertEqual((r.status, r.rattlers, r.contacts, r.bucklers), (jam.StatusCode.LIMIT, -1, -1, -1))
        self.assertTrue(np.isnan([r.force_residual, r.min_force, r.max_contact_gap]).all())
        with tempfile.TemporaryDirectory() as folder:
            s.save(folder + "/s.h5")
            s.write_checkpoint(folder + "/state")
            kept = [s, s.copy(), jam.load(folder + "/s.h5"), jam.System.from_checkpoint(folder + "/state")]
            for t in kept:
                self.assertEqual(t.report.rattlers, -1)
                for ask in (
                    lambda: t.contacts,
                    lambda: t.forces,
                    lambda: t.rattlers,
                    lambda: t.coordination,
                    lambda: t.modes(3),
                    lambda: t.moduli(),
                    lambda: t.prove(),
                    lambda: t.gaps(1.0, True),
                    lambda: t.write_contacts(folder + "/c.csv"),
                ):
                    with self.assertRaisesRegex(jam.errors.StateError, "before its contacts were known"):
                        ask()
                t.write(folder + "/p.xyz")
                self.assertNotIn("contacts", Path(folder, "p.xyz").read_text())
                t.page(folder + "/p.html")
                self.assertIn('"rattlers": null', Path(folder, "p.html").read_text())
        s.contacts_from_geometry()
        self.assertEqual(s.coordination.sum(), 2 * len(s.contacts))

    def test_a_call_that_ends_before_its_dynamics_measured_nothing(self):
        s = jam.System.random(n=3000, dim=3, seed=1)
        r = s.compress(wall_time=1e-9)
        self.assertEqual((r.collisions, r.packing_fraction), (0, s.packing_fraction))
        self.assertTrue(np.isnan(r.pressure), repr(r))
        m = s.monte_carlo(sweeps=10**7, wall_time=1e-9)
        self.assertEqual((m.status, m.sweeps), (jam.StatusCode.LIMIT, 0))
        self.assertTrue(np.isnan([m.acceptance, m.pressure, m.energy, m.step]).all(), repr(m))

    def test_what_a_call_does_not_write_is_unknown(self):
        s = jam.System.random(n=20, dim=2, seed=1)
        s.contacts_from_geometry()
        self.assertEqual(s.status, jam.StatusCode.NOT_JAMMED)
        refined = s.refined_positions()
        self.assertEqual(s.status, jam.StatusCode.AMBIGUOUS)
        self.assertTrue(np.isnan(refined.high).all() and np.isnan(refined.low).all())


class Protocol(unittest.TestCase):
    def test_options_that_every_stage_overrides_are_refused(self):
        s = jam.System.random(n=60, seed=1)
        for extra in ({"growth_rate": 1.0}, {"pressure": 10.0}, {"growth_rate": 1e-3, "wall_time": 1e6}):
            with self.assertRaisesRegex(ValueError, next(iter(extra)) + ".* no effect"):
                s.compress(stages=[(0.1, 1e3), {"growth_rate": 0.1, "pressure": 1e4}], **extra)
        s.compress(stages=[{"growth_rate": 0.1}, (0.1, 100.0)], pressure=50.0)
        self.assertGreater(s.pressure, 90.0)

    def test_ensembles_take_pairs(self):
        from jam.ensemble import ProtocolError, complete

        pairs, dicts = ([(1e-2, 1e5)], [{"growth_rate": 1e-2, "pressure": 1e5}])
        self.assertEqual(complete(dict(n=8, dim=2, stages=pairs)), complete(dict(n=8, dim=2, stages=dicts)))
        for wrong in ([(1e-2,)], [3.0], ["fast"]):
            with self.assertRaisesRegex(ProtocolError, r"stages\[0\].*pair"):
                complete(dict(n=8, dim=2, stages=wrong))
