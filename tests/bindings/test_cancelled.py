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
            lambda: s.elastic_tensor(progress=stop),
            lambda: s.rigidity("strict", progress=stop),
            lambda: s.check(progress=stop),
            lambda: s.contacts_from_geometry(progress=stop),
            lambda: s.stress_states(progress=stop),
            lambda: s.floppy_modes(progress=stop),
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
        for call in (
            lambda s: s.compress(wall_time=1e-9),
            lambda s: s.run(collisions_per_particle=5, wall_time=1e-9),
            lambda s: s.compress(progress=lambda p: True),
        ):
            for n in (100, 3000):
                s = jam.System.random(n=n, dim=3, seed=1)
                r = call(s)
                if r.collisions == 0:
                    self.assertEqual(r.packing_fraction, s.packing_fraction)
                    self.assertTrue(np.isnan(r.pressure), repr(r))
        s = jam.System.random(n=3000, dim=3, seed=1)
        self.assertEqual(s.compress(wall_time=1e-9).collisions, 0)
        m = s.monte_carlo(sweeps=10**7, wall_time=1e-9)
        self.assertEqual((m.status, m.sweeps), (jam.StatusCode.LIMIT, 0))
        self.assertTrue(np.isnan([m.acceptance, m.pressure, m.energy, m.step]).all(), repr(m))
        soft = jam.System.random(n=500, dim=3, seed=1, packing_fraction=0.8, overlap="allow")
        x = soft.relax(progress=lambda p: True)
        if x.evaluations == 0:
            self.assertEqual((x.contacts, x.packing_fraction), (-1, soft.packing_fraction))

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

    def test_limits_keep_both_stages(self):
        plain = jam.System.random(n=60, seed=1)
        self.assertGreater(plain.compress().pressure, 0.9e6)
        for options in ({"wall_time": 1e6}, {"packing_fraction": 0.7}, {"time": 1e9}):
            s = jam.System.random(n=60, seed=1)
            s.compress(**options)
            np.testing.assert_array_equal(s.positions, plain.positions)

    def test_a_stopped_protocol_goes_on(self):
        s = jam.System.random(n=60, seed=1)
        r = s.compress(progress=lambda p: True)
        while r.status > 0:
            r = s.compress(resume=1)
        self.assertGreater(r.pressure, 0.9e6)

    def test_ensembles_take_pairs(self):
        from jam.ensemble import ProtocolError, complete

        pairs, dicts = ([(1e-2, 1e5)], [{"growth_rate": 1e-2, "pressure": 1e5}])
        self.assertEqual(complete(dict(n=8, dim=2, stages=pairs)), complete(dict(n=8, dim=2, stages=dicts)))
        for wrong in ([(1e-2,)], [3.0], ["fast"]):
            with self.assertRaisesRegex(ProtocolError, r"stages\[0\].*pair"):
                complete(dict(n=8, dim=2, stages=wrong))
