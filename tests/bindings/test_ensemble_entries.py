"""Entries of an ensemble are used as systems are; its tables have words and options."""
import unittest

import numpy as np

import jam
from jam.ensemble import Ensemble
from packings import SMALL, InFolder


class Entries(InFolder):
    def setUp(self):
        super().setUp()
        self.ensemble = Ensemble(self.folder, SMALL)
        self.ensemble.run([1, 2, 3], progress=False, workers=1)
        self.entry = next(iter(self.ensemble))
        self.system = self.entry.system()

    def test_attributes_are_those_of_the_system(self):
        for name in ("positions", "diameters", "forces", "coordination", "rattlers", "bucklers", "velocities", "cell"):
            np.testing.assert_array_equal(getattr(self.entry, name), getattr(self.system, name), name)
        self.assertEqual(self.entry.history.tobytes(), self.system.history.tobytes())  # it has nan
        for name in ("n", "dim", "packing_fraction", "seed", "box"):
            self.assertEqual(getattr(self.entry, name), getattr(self.system, name), name)
        self.assertEqual(self.entry.report, self.system.report)
        ours, theirs = self.entry.contacts, self.system.contacts
        for name in ("pairs", "vectors", "gaps", "forces"):
            np.testing.assert_array_equal(getattr(ours, name), getattr(theirs, name))
        self.assertEqual(ours.table().dtype, theirs.table().dtype)

    def test_calls_are_those_of_the_system_and_change_nothing(self):
        np.testing.assert_array_equal(self.entry.modes(3).values, self.system.modes(3).values)
        self.assertEqual(self.entry.rigidity().jammed, self.system.rigidity().jammed)
        self.assertEqual(len(self.entry.to_pandas("contacts")), self.system.report.contacts)
        before = self.entry.positions
        self.entry.run(5)  # on a system of its own
        np.testing.assert_array_equal(self.entry.positions, before)
        with self.assertRaises(AttributeError):
            self.entry.positions = before
        with self.assertRaisesRegex(AttributeError, "no_such"):
            self.entry.no_such
        self.assertTrue({"modes", "forces", "gap_pairs", "jammed"} <= set(dir(self.entry)))
        ax = jam.plot.packing(self.entry.system())
        self.assertTrue(ax.collections)

    def test_stored_gaps_have_their_pairs_by_name(self):
        whole = self.system.gaps(0.1, True)
        np.testing.assert_array_equal(self.entry.gaps, whole.gap)
        np.testing.assert_array_equal(self.entry.gap_pairs, whole.pair)
        for gaps, pairs in self.ensemble.each("gaps", "gap_pairs"):
            self.assertEqual(pairs.shape, (len(gaps), 2))
        bare = Ensemble(self.folder, dict(SMALL, analysis={}))
        bare.run([1], progress=False, workers=1)
        with self.assertRaisesRegex(KeyError, "gap_pairs"):
            next(iter(bare)).gap_pairs

    def test_results_of_many_parts_are_stored(self):
        more = {"modes": {"k": 3}, "hessian": {}, "isoconf": {"instants": [1.0], "runs": 2, "density_ratio": 0.9}}
        made = Ensemble(self.folder, dict(n=20, dim=2, stages=[(1e-2, 1e4)], analysis=more))
        made.run([1], progress=False, workers=1)
        (entry,) = made
        stored = {path: entry.read(path)[0] for path in ("modes/values", "hessian/data", "hessian/indices", "isoconf/square")}
        system = entry.system()
        np.testing.assert_array_equal(stored["modes/values"], system.modes(3).values)
        hessian = system.hessian()
        np.testing.assert_array_equal(stored["hessian/data"], hessian.data)
        np.testing.assert_array_equal(stored["hessian/indices"], hessian.indices)
        self.assertEqual(stored["isoconf/square"].shape[1:], (1, 20, 2))
        for name in ("copy", "tile"):
            with self.assertRaisesRegex(ValueError, "no method"):
                jam.ensemble.complete({"analysis": {name: {}}})

    def test_without_a_network_the_system_says_what_is_missing(self):
        loose = Ensemble(self.folder, dict(n=20, dim=2, stages=[], crunch=None, analysis={}))
        loose.run([1], progress=False, workers=1)
        with self.assertRaisesRegex(jam.errors.StateError, "crunch"):
            next(iter(loose)).forces


class Tables(InFolder):
    def setUp(self):
        super().setUp()
        self.folder /= "e"

    def test_enums_are_words_in_a_data_frame(self):
        e = Ensemble(self.folder, SMALL)
        e.run([1, 2], progress=False, workers=1)
        numbers, words = e.table(), e.table(pandas=True)
        for name, enum in (("stop_reason", jam.StopReason), ("strictly_jammed", jam.Verdict), ("status", jam.StatusCode)):
            self.assertEqual(list(words[name]), [enum(k).name.lower() for k in numbers[name]], name)
        self.assertEqual(list(words["stop_reason"]), ["converged", "converged"])
