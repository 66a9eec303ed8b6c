"""Radii as unknowns: weights, bounds, bad input, stops, search, proof. Maxima are tested in test_radii_maxima.py."""
import tempfile
import unittest
from pathlib import Path

import numpy as np

import jam
import jam.radii
from radii_oracle import least_exact_gap


def box(n, dim=2, seed=1, **more):
    return jam.System.random(n=n, dim=dim, walls="xyz"[:dim], seed=seed, **more)


class Maximum(unittest.TestCase):
    def test_images_along_several_vectors_are_exact(self):
        """Sums of cell vectors are rounded in doubles: seed 6 had two spheres that overlapped by 1e-17."""
        for seed in (3, 5, 6):
            s = jam.System.random(n=7, dim=3, seed=seed, cell=[[1.0, 0.0, 0.0], [0.37, 0.81, 0.0], [-0.21, 0.333, 1.1]])
            self.assertTrue(s.maximise_radii().maximum)
            self.assertGreaterEqual(least_exact_gap(s), 0)

    def test_forces_on_a_sphere_add_up_to_its_weight(self):
        weights = np.linspace(0.5, 2.0, 12)
        s = box(12, seed=5)
        report = s.maximise_radii(weights)
        self.assertEqual(s.calls[-1]["options"]["weights"], weights.tolist())
        self.assertTrue(report.maximum)
        self.assertLess(abs(report.value - weights @ s.diameters / 2), 1e-14)
        sums = np.zeros(12)
        for (i, j), f in zip(s.contacts.pairs, s.forces):
            sums[i] += f
            if j >= 0:
                sums[j] += f
        scale = weights / sums
        self.assertLess(np.ptp(scale) / scale.mean(), 1e-11)

    def test_bounds_hold_and_are_reported(self):
        free = box(10, seed=2)
        free.maximise_radii()
        low, high = 0.8 * free.diameters.mean() / 2, 1.1 * free.diameters.mean() / 2
        start = jam.System.from_arrays(free.positions, radii=1.05 * low, box=1.0, walls="xy", overlap="shrink")
        low = min(low, 0.95 * start.diameters[0] / 2)
        report = start.maximise_radii(radius_min=low, radius_max=high)
        self.assertTrue(report.maximum)
        self.assertGreater(report.at_bounds, 0)
        self.assertGreaterEqual(start.diameters.min() / 2, low * (1 - 1e-15))
        self.assertLessEqual(start.diameters.max() / 2, high)
        self.assertGreaterEqual(least_exact_gap(start), 0)
        self.assertEqual(int(np.sum(abs(start.diameters / 2 - high) < 1e-14) + np.sum(abs(start.diameters / 2 - low) < 1e-14)), report.at_bounds)

    def test_bounds_that_hold_many_radii(self):
        for seed in (35, 378):  # the polish left overlaps of other pairs
            rng = np.random.default_rng(seed)
            weights, most = 10.0 ** rng.uniform(-1, 1, 12), 12**-0.5 * rng.uniform(0.3, 0.6)
            s = jam.System.random(n=12, dim=2, seed=seed)
            self.assertTrue(s.maximise_radii(weights, radius_max=most).maximum)
            self.assertLessEqual(s.diameters.max() / 2, most * (1 + 1e-15))
            self.assertGreaterEqual(least_exact_gap(s), 0)
        s = box(30, seed=46)
        s.maximise_radii(radius_max=0.088)
        report = s.maximise_radii(radius_max=0.088, room=1e-5)
        self.assertTrue(report.maximum)
        self.assertEqual((report.contacts, report.at_bounds, report.rattlers), (0, 30, 30))

    def test_a_sphere_with_room_is_no_maximum(self):
        """A weight may be so small that its sphere has not grown; then no maximum is claimed."""
        for small in (1e-9, 3e-11, 1e-20):
            s, weights = box(8), np.ones(8)
            weights[3] = small
            report = s.maximise_radii(weights)
            if report.maximum:
                self.assertEqual(report.rattlers, 0)

    def test_the_least_other_gap_is_that_of_a_pair(self):
        s = box(6)
        report = s.maximise_radii()
        x, radius = s.positions, s.diameters / 2
        gaps = [np.linalg.norm(x[i] - x[j]) - radius[i] - radius[j] for i in range(6) for j in range(i)]
        gaps += [g for i in range(6) for c in range(2) for g in (x[i, c] - radius[i], 1 - x[i, c] - radius[i])]
        self.assertAlmostEqual(report.min_gap, sorted(gaps)[report.contacts], delta=1e-14)

    def test_little_room_ends_near_the_start(self):
        s = box(15, seed=4)
        value = s.maximise_radii().value
        again = s.copy()
        self.assertLess(abs(again.maximise_radii(room=1e-6).value - value), 1e-14)
        self.assertLess(abs(again.positions - s.positions).max(), 1e-12)


class Refused(unittest.TestCase):
    def refused(self, system, error, text, *given, **options):
        before = system.positions.copy(), system.diameters.copy(), system.cell.copy()
        with self.assertRaisesRegex(error, text):
            system.maximise_radii(*given, **options)
        for was, now in zip(before, (system.positions, system.diameters, system.cell)):
            np.testing.assert_array_equal(was, now)

    def said(self, system, **options):
        try:
            return system.copy().maximise_radii(max_steps=1, **options).status_text
        except jam.errors.ArgumentError as why:
            return str(why)

    def test_bad_input_moves_nothing(self):
        s, wrong = box(5), jam.errors.ArgumentError
        self.refused(s, wrong, "radius_max is 0.1 and radius_min 0.2", radius_min=0.2, radius_max=0.1)
        self.refused(s, wrong, "no room between", radius_min=0.1, radius_max=0.1)
        self.refused(s, wrong, "radius_min is -1", radius_min=-1.0)
        self.refused(s, wrong, "radius_min is 0.4, which spheres", radius_min=0.4)
        self.refused(s, wrong, "room is 0,", room=0.0)
        self.refused(s, wrong, "max_steps is 0", max_steps=0)
        self.refused(s, wrong, "wall_time is 0", wall_time=0.0)
        self.refused(s, wrong, r"weights\[2\] is 0", [1, 1, 0, 1, 1])
        self.refused(s, wrong, r"weights\[4\] is -1", [1, 1, 1, 1, -1])
        self.refused(s, wrong, r"weights\[1\] is 1e\+308, it must be positive and at most 1e\+100", [1, 1e308, 1, 1, 1])
        self.refused(s, wrong, r"weights\[1\] is 1e-300 and the mean weight 8e\+99", [1e100, 1e-300, 1e100, 1e100, 1e100])
        self.refused(s, wrong, r"weights\[0\] is 4\.9.*e-324 and the mean weight 0", np.full(5, 5e-324))
        self.refused(s, wrong, "weights_len is 3", [1, 1, 1])
        self.refused(s, jam.errors.NonfiniteError, r"weights\[0\]", [np.nan, 1, 1, 1, 1])
        far = jam.errors.UnsupportedError
        self.refused(jam.System.random(n=5, dim=2, model="mk"), far, "Mari-Kurchan")
        mixture = jam.System.random(n=4, dim=2, diameters=[1, 1, 1.4, 1.4], non_additivity=0.1)
        self.refused(mixture, far, "non_additivity")
        soft = jam.System.random(n=20, dim=2, packing_fraction=0.9, overlap="allow")
        self.refused(soft, jam.errors.OverlapError, "overlap")

    def test_moments_that_cannot_be_kept_move_nothing(self):
        six = jam.System.random(n=6, dim=2, walls="xy", seed=1, diameters=np.random.default_rng(1).uniform(0.6, 1.4, 6))
        two = jam.System.random(n=6, dim=2, walls="xy", seed=1, diameters=[1, 1, 1, 1.4, 1.4, 1.4])
        for text, system, given, options in (
            ("exponent_1 is 2 and exponent_3 2: nearer than 0.01 they count as one moment twice", six, (), dict(moments=(2, 1, 2))),
            ("exponent_2 is 0, .* the number of spheres", six, (), dict(moments=(1, 0))),
            ("exponent_1 is 0.02 and exponent_2 0.025: nearer than 0.01", six, (), dict(moments=(0.02, 0.025))),
            ("exponent_1 is 9, its size must be 0.01 to 8", six, (), dict(moments=[9])),
            ("weights and moments", six, (np.ones(6),), dict(moments=(1, 2))),
            ("radius_min 0.5 and radius_max inf", six, (), dict(moments=(1, 2), radius_min=0.5)),
            ("not between radius_min", six, (), dict(moments=(1, 2), radius_max=1e-3)),
            ("too alike for 2 moments", box(6), (), dict(moments=(1, 2))),
            ("too alike for 3 moments.* at least 3 values", two, (), dict(moments=(1, 2, 3))),
        ):
            self.refused(system, jam.errors.ArgumentError, text, *given, **options)
        for low in range(1, 99):  # hundredths as doubles, whose differences are not all 0.01 or above
            self.assertNotIn("nearer", self.said(six, moments=(low / 100, (low + 1) / 100)))
        self.refused(six, ValueError, "moments has 5 exponents, one to four are possible", moments=(1, 2, 3, 4, 5))
        self.refused(six, TypeError, "exponent_2", moments=(1, 2), exponent_2=3.0)  # was not heard

    def test_cells_that_cannot_deform_move_nothing(self):
        few = "a maximum of radii that changes the cell at fixed volume needs at least 2 axes without walls, this scene has {}"
        for scene, strain, axes in (({"walls": "yz"}, "free", 1), ({"dim": 2, "walls": "xy"}, "tilts", 0), ({"container": "cylinder"}, "edges", 1)):
            self.refused(jam.System.random(n=5, seed=1, **scene), jam.errors.UnsupportedError, few.format(axes), strain=strain)
        all_ = "strain is 7, which frees the volume.* a maximum of radii takes none, edges"
        self.refused(jam.System.random(n=5, dim=2), jam.errors.ArgumentError, all_, strain="all")


class Stops(unittest.TestCase):
    def test_moments_and_volume_are_kept_and_walls_not_crossed(self):
        sizes = np.random.default_rng(2).uniform(0.6, 1.4, 30)
        for scene, options in (
            ({"diameters": sizes}, {"moments": (1, 2, 3), "max_steps": 7}), ({"n": 12}, {"strain": "free", "max_steps": 12}),
            ({"n": 9, "container": "ball"}, {"max_steps": 4}), ({"n": 20, "walls": "xy"}, {"wall_time": 1e-9}),
        ):
            s = jam.System.random(dim=2, seed=2, **scene)
            before, report = s.diameters / 2, s.maximise_radii(**options)
            self.assertEqual((report.maximum, report.contacts, s.calls[-1]["status"]), (False, -1, "limit"))
            self.assertEqual(report.stop_reason.name, "WALL_TIME" if "wall_time" in options else "STEPS")
            self.assertGreater(least_exact_gap(s), 0)
            for q in options.get("moments", ()):
                self.assertLess(abs(((s.diameters / 2) ** q).sum() / (before**q).sum() / report.value**q - 1), 1e-14)
            self.assertLess(abs(np.linalg.det(s.cell) - 1), 1e-14)
            self.assertEqual("strain" in options, abs(s.cell - np.eye(2)).max() > 1e-6)


class Search(unittest.TestCase):
    def test_workers_and_folders_change_nothing(self):
        whole = jam.radii.best_of(6, walls="xy", starts=6, workers=2)
        with tempfile.TemporaryDirectory() as folder:
            jam.radii.best_of(6, walls="xy", starts=2, workers=1, folder=Path(folder, "six"))
            parts = jam.radii.best_of(6, walls="xy", starts=6, workers=1, folder=Path(folder, "six"))
            with self.assertRaisesRegex(ValueError, "another search"):
                jam.radii.best_of(7, walls="xy", starts=2, workers=1, folder=Path(folder, "six"))
            Path(folder, "file").write_text("")
            with self.assertRaisesRegex(OSError, "file cannot be written: File exists") as refused:
                jam.radii.best_of(6, walls="xy", starts=2, workers=1, folder=Path(folder, "file"))
            self.assertIsInstance(refused.exception, jam.errors.StoreError)
            for text in ("", "{", "[1]", '{"asked": 1}', '{"asked": 1, "best": [1], "done": [], "maxima": 0, "seconds": 0}'):
                Path(folder, "six", "search.json").write_text(text)
                with self.assertRaisesRegex(ValueError, r"search\.json is damaged .*remove it"):
                    jam.radii.best_of(6, walls="xy", starts=6, workers=1, folder=Path(folder, "six"))
        self.assertEqual((whole.starts, whole.maxima), (parts.starts, parts.maxima))
        self.assertEqual([b.value for b in whole.best], [b.value for b in parts.best])
        np.testing.assert_array_equal(whole.best[0].positions, parts.best[0].positions)
        values = [b.value for b in whole.best]
        self.assertEqual(values, sorted(values, reverse=True))
        self.assertLessEqual(len(values), 10)

    def test_a_search_without_a_maximum_has_no_sum(self):
        self.assertTrue(np.isnan(jam.radii.Search([], 3, 0, 0.0).value))

    def test_a_search_without_an_end_is_refused(self):
        with self.assertRaisesRegex(ValueError, "starts, seconds or until"):
            jam.radii.best_of(5)
        with self.assertRaises(jam.errors.ArgumentError):  # before a worker begins
            jam.radii.best_of(5, starts=1, radius_min=0.4)

    def test_until_ends_it(self):
        found = jam.radii.best_of(2, 3, walls="xyz", until=0.63397459, workers=1)
        self.assertLess(abs(found.value - 3**0.5 / (1 + 3**0.5)), 1e-14)

    def test_periodic_cells(self):
        found = jam.radii.best_of(4, cell=[[1.0, 0.0], [0.2, 0.9]], starts=2, workers=1, keep=1)
        self.assertEqual(len(found.best), 1)


class Proof(unittest.TestCase):

    def test_what_has_no_proof_is_refused(self):
        wrong = jam.errors.StateError
        with self.assertRaisesRegex(wrong, "simple maxima"):  # two disks keep their sum along a line
            s = box(2)
            s.maximise_radii()
            jam.radii.prove(s)
        with self.assertRaisesRegex(wrong, "flat walls"):
            s = jam.System.random(n=12, dim=2, seed=1, container="ball", packing_fraction=0.3)
            s.compress()
            s.crunch()
            jam.radii.prove(s)
        with self.assertRaisesRegex(wrong, "no contact network"):
            jam.radii.prove(box(3))
        with self.assertRaisesRegex(ValueError, "digits is 10"):
            s = box(3)
            s.maximise_radii()
            jam.radii.prove(s, 10)
        s = box(3)
        s.maximise_radii()
        with self.assertRaisesRegex(wrong, "may pull"):  # no maximum of another sum
            jam.radii.prove(s, weights=[1, 1e-3, 1e-3])
        s = jam.System.random(n=5, dim=2, seed=3)
        s.maximise_radii(strain="free")
        with self.assertRaisesRegex(wrong, "a maximum of a free cell has 2 contacts more than a fixed cell has unknowns"):
            jam.radii.prove(s)
