#!/usr/bin/env python3
"""Small version of the exponents of examples/studies: the fit finds known exponents within its own errors, errors that are neither
empty nor vast, and packings made here agree with the published values. usage: network_exponents.py FOLDER_OF_STUDIES"""
import sys
import unittest

import numpy as np

sys.path.insert(0, sys.argv.pop())
import tail_exponents as tail  # noqa: E402

import jam  # noqa: E402
from jam import scaling  # noqa: E402

LOCALISED = 1  # flag JAM_CONTACT_LOCALISED


def fits(law, kind, repeats=12, **powers):
    for k in range(repeats):
        rng = np.random.default_rng(k)
        yield scaling.tail_exponent([law.draw(rng) for _ in range(20)], 1024, kind, **powers)


class KnownLaws(unittest.TestCase):
    def covered(self, family, kind, largest):
        law = dict(tail.families())[family]
        found = list(fits(law, kind))
        off = np.array([f.value - law.a for f in found])
        error = np.array([f.error for f in found])
        # 95 % lie within two errors; fewer than 9 of 12 would be one case in 500, less than 0.2 % of such runs
        self.assertGreaterEqual(np.sum(abs(off) < 2 * error), 9, f"{family}: {off / error}")
        self.assertLess(np.median(error), largest)  # or anything would be covered
        self.assertLess(error.max(), 5 * off.std() + largest)
        return law

    def test_extended(self):
        law = self.covered("extended gamma", "forces", 0.15)
        for f in fits(law, "forces", 3, powers=()):  # without corrections to the law it is seen to be wrong
            self.assertLess(f.value, law.a - 2 * f.error)

    def test_localised(self):
        self.covered("localised weibull", "forces", 0.17)

    def test_gaps(self):
        self.covered("gaps constant background, flat", "gaps", 0.04)

    def test_frequencies(self):
        self.covered("frequencies falling", "forces", 0.07)

    def test_range_starts_where_finite_size_ends(self):
        x = [np.random.default_rng(k).random(10000) for k in range(5)]
        self.assertAlmostEqual(scaling.tail_exponent(x, 1000, "gaps").low, 0.01, delta=0.002)  # N c(x) = 10

    def test_no_range(self):
        with self.assertRaises(ValueError):  # ten spheres: finite size up to the crossover
            scaling.tail_exponent([np.random.default_rng(k).random(30) for k in range(5)], 10)


class OddInput(unittest.TestCase):
    def test_is_refused_by_name(self):
        good = [np.random.default_rng(k).random(3000) for k in range(3)]
        for samples, n, options, words in (
            (good[:1], 1024, {}, "at least 2"),
            ([good[0], np.append(good[1], np.inf)], 1024, {}, "not finite"),
            ([good[0], np.append(good[1], np.nan)], 1024, {}, "not finite"),
            (good, 0, {}, "number of spheres"),
            (good, float("nan"), {}, "number of spheres"),
            (good, 1024, {"kind": "force"}, "'forces' or 'gaps'"),
            (good, 1024, {"powers": [0.0]}, "above 0"),
            (good, 1024, {"powers": [float("nan")]}, "above 0"),
        ):
            with self.assertRaisesRegex(ValueError, words):
                scaling.tail_exponent(samples, n, **options)
        one, other = scaling.tail_exponent(good, 1024), scaling.tail_exponent(iter(good), 1024)
        self.assertEqual(one, other)


class Packings(unittest.TestCase):
    def test_published_values(self):
        values = {"extended": [], "localised": [], "gaps": []}
        for seed in (2, 3):
            with jam.System.random(n=1024, seed=seed) as packing:
                packing.compress()
                self.assertEqual(packing.crunch().excess_contacts, 0)
                force, local = packing.forces, (packing.contact_classes() & LOCALISED) != 0
                values["extended"].append(force[~local] / force[~local].mean())
                values["localised"].append(force[local] / force[local].mean())
                values["gaps"].append(packing.gaps(h_max=1.0, stable_only=1).gap)
        for name, expected in (("extended", 0.42311), ("localised", 0.17462), ("gaps", -0.41269)):
            gaps = name == "gaps"
            f = scaling.tail_exponent(values[name], 1024, "gaps" if gaps else "forces")
            print(
                f"{name}: {f.value:.3f} +- {f.error:.3f} from {f.low:.2g} to {f.high:.2g}, published {expected:.3f}"
            )
            self.assertLess(
                abs(f.value - expected), 4 * f.error
            )  # one sample, and another one in every version
            self.assertLess(f.error, 0.2 if gaps else 0.6)  # two packings say no more


if __name__ == "__main__":
    unittest.main()
