"""Named laws of diameters: quantiles and moments against scipy, sieve curves, densities, errors."""
import tempfile
import unittest
from pathlib import Path

import jam
import numpy as np
from scipy import integrate, stats

CURVE = [(0.5, 0), (1, 10), (2, 50), (4, 100)]


def cut(law, low, high):
    """Quantiles of a law of scipy between low and high."""
    a, b = law.cdf(low), law.cdf(high)
    return lambda u: law.ppf(a + u * (b - a))


def lognormal(mean, deviation):
    w = np.sqrt(np.log1p((deviation / mean) ** 2))
    return stats.lognorm(w, scale=mean * np.exp(-w * w / 2))


class Laws(unittest.TestCase):
    N = 1000

    def u(self):
        return (np.arange(self.N) + 0.5) / self.N

    def test_quantiles_by_number(self):
        laws = {
            "normal:mean=2,deviation=0.3": stats.truncnorm(-2 / 0.3, np.inf, 2, 0.3).ppf,
            "normal:mean=2,deviation=0.3,low=1.5,high=2.2": cut(stats.norm(2, 0.3), 1.5, 2.2),
            "lognormal:mean=2,deviation=0.8": lognormal(2, 0.8).ppf,
            "lognormal:mean=2,deviation=0.8,high=3": cut(lognormal(2, 0.8), 0, 3),
            "weibull:scale=2,shape=3,share=number": stats.weibull_min(3, scale=2).ppf,
            "uniform:low=1,high=3": stats.uniform(1, 2).ppf,
            "power:exponent=-3,low=1,high=5": cut(stats.pareto(2), 1, 5),
            "power:exponent=-1,low=1,high=5": stats.loguniform(1, 5).ppf,
            "power:exponent=2,low=1,high=5": cut(stats.powerlaw(3, scale=5), 1, 5),
        }
        for law, ppf in laws.items():
            with self.subTest(law):
                np.testing.assert_allclose(jam.sizes(law, self.N), ppf(self.u()), rtol=2e-12)

    def test_quantiles_by_volume(self):
        """The density by number is that by volume over s^d: sums of volume and numbers against quadrature."""
        laws = {
            "normal:mean=2,deviation=0.3,low=1,high=3,share=volume": (stats.norm(2, 0.3), 1, 3),
            "lognormal:mean=2,deviation=0.8,share=volume": (lognormal(2, 0.8), 1e-4, 200),
            "lognormal:mean=2,deviation=0.8,low=0.5,share=volume": (lognormal(2, 0.8), 0.5, 200),
            "weibull:scale=2,shape=1.5,low=0.2": (stats.weibull_min(1.5, scale=2), 0.2, 50),
            "uniform:low=1,high=3,share=volume": (stats.uniform(1, 2), 1, 3),
            "power:exponent=-1,low=1,high=3,share=volume": (stats.loguniform(1, 3), 1, 3),
        }
        for d in (2, 3):
            for text, (law, low, high) in laws.items():
                with self.subTest(text, d=d):
                    s = jam.sizes(text, self.N, dim=d)
                    x = np.geomspace(low, high, 200001)
                    number = integrate.cumulative_trapezoid(law.pdf(x) / x**d * x, np.log(x), initial=0)
                    all_volume = law.cdf(high) - law.cdf(low)
                    # total volume of n spheres is n means by number
                    self.assertAlmostEqual(np.sum(s**d) / self.N * number[-1] / all_volume, 1, delta=1e-6)
                    # at the ends of each sphere's share of the number the sums of volume are those of the law
                    edge = np.interp((np.arange(self.N) + 1) / self.N, number / number[-1], x)
                    asked = (law.cdf(edge) - law.cdf(low)) / all_volume
                    np.testing.assert_allclose(np.cumsum(s**d) / np.sum(s**d), asked, atol=2e-6)

    def test_random_draws_have_the_law(self):
        for law, given in (
            ("normal", dict(mean=3.0, deviation=0.5)), ("lognormal", dict(mean=3.0, deviation=0.9)), ("uniform", dict(low=1.0, high=2.0)),
            ("weibull", dict(scale=2.0, shape=2.5, share="number")),
        ):
            with self.subTest(law):
                even, drawn = jam.sizes(law, 100000, **given), jam.sizes(law, 100000, draw="random", seed=5, **given)
                self.assertGreater(stats.ks_2samp(drawn, even).pvalue, 1e-4)
                report = jam.size_report(even)
                self.assertAlmostEqual(report.polydispersity, even.std() / even.mean(), delta=1e-12)

    def test_sieve_curves_come_back(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "grading.csv")
            path.write_text("size,passing\n" + "".join(f"{a}, {b}\n" for a, b in CURVE), encoding="ascii")
            s = jam.sizes("sieve", 20000, curve=CURVE)
            np.testing.assert_array_equal(s, jam.sizes("sieve", 20000, curve=path))
            report = jam.size_report(s)
            passing = [100 * np.sum(s[s <= size] ** 3) / np.sum(s**3) for size, _ in CURVE]
            self.assertLess(np.abs(np.array(passing) - [b for _, b in CURVE]).max(), 100 * report.largest_share)
            for found, share in ((report.d10, 10), (report.d50, 50), (report.d90, 90)):
                x = np.exp(np.interp(share, [b for _, b in CURVE], np.log([a for a, _ in CURVE])))
                self.assertAlmostEqual(found / x, 1, delta=3e-3)

    def test_a_list_has_its_shares(self):
        self.assertEqual(len(jam.sizes("equal", 10.0)), 10)  # a whole number, as elsewhere
        s = jam.sizes("list", 10, curve={1.4: 0.3, 1.0: 0.7})
        self.assertEqual(list(s), [1.0] * 7 + [1.4] * 3)
        filled = jam.sizes("list:1=0.5,2=0.5,share=volume", porosity=0.5, box=20.0)
        self.assertAlmostEqual(np.sum(filled[filled < 1.5] ** 3) / np.sum(filled**3), 0.5, delta=0.002)


class Densities(unittest.TestCase):
    def test_n_follows_and_the_packing_has_the_diameters_asked_for(self):
        cell = (10.0, 10.0, 30.0)
        s = jam.sizes("sieve", curve=[(1, 0), (2, 60), (4, 100)], porosity=0.45, cell=cell)
        packing = jam.System.random(diameters=s, cell=cell, packing_fraction=0.3)
        report = packing.compress(porosity=0.45, growth_rate=0.1)
        self.assertEqual(report.stop_reason.name, "PACKING_FRACTION")
        self.assertLess(abs(packing.packing_fraction - 0.55), 1e-12)
        np.testing.assert_allclose(packing.diameters, s, rtol=1e-12)

    def test_the_volume_is_that_of_the_library(self):
        """To the bit: LAPACK has another on each processor."""
        for k in range(20):
            vectors = np.random.default_rng(k).uniform(-1, 1, (3, 3)) + 1.5 * np.eye(3)
            packing = jam.System.random(8, cell=vectors)
            made = [jam.sizes("lognormal:mean=0.3,deviation=0.2", porosity=0.6, cell=c) for c in (vectors, packing.cell)]
            np.testing.assert_array_equal(*made)
            volume = np.prod(np.diag(packing.cell))
            self.assertAlmostEqual(np.pi / 6 * np.sum(made[0] ** 3) / volume, 0.4, delta=1e-13)
        for wrong in ([[0.0, 1.0], [1.0, 0.0]], [[1.0, 0.0], [2.0, 0.0]]):
            with self.assertRaisesRegex(ValueError, "determinant"):
                jam.sizes("equal", porosity=0.5, cell=wrong, dim=2)

    def test_starts_by_porosity(self):
        self.assertAlmostEqual(jam.System.random(20, porosity=0.75).packing_fraction, 0.25, delta=1e-14)
        with self.assertRaisesRegex(TypeError, "give one of them"):
            jam.System.random(20, porosity=0.7, packing_fraction=0.3)
        self.assertEqual(jam.System.random(diameters=[1.0, 2.0, 3.0]).n, 3)

    def test_progress_is_that_of_the_density(self):
        """The default protocol has a second stage, which a density below the first one's pressure never reaches."""
        seen = []
        jam.System.random(n=4000, packing_fraction=0.3).compress(packing_fraction=0.6, progress=lambda p: seen.append(p.fraction))
        self.assertGreater(max(seen), 0.5)

    def test_densities_beyond_reach_are_refused_before_work(self):
        with self.assertRaisesRegex(jam.errors.UnplaceableError, r"porosity 0\.3\).* jam near 0\.643 .*Farr and Groot.*0\.384"):
            jam.System.random(1000).compress(porosity=0.3)
        with self.assertRaisesRegex(jam.errors.UnplaceableError, "libjam"):
            jam.System.random(1000, 2, diameters=[1.0] * 500 + [1.4] * 500).compress(packing_fraction=0.9)

    def test_the_estimate_is_that_of_the_paper(self):
        """Farr and Groot give 0.6435 for equal spheres, which their constant was fitted to."""
        self.assertAlmostEqual(jam.size_report([1.0]).jammed_fraction, 0.6435, delta=2e-4)
        self.assertEqual(jam.size_report([1.0]).source.name, "FARR_GROOT")
        for sizes in ([1.0, 1.4], [1.0, 1.0, 1.0, 3.0], jam.sizes("lognormal:deviation=0.5", 400)):
            for d, bound in ((2, 0.03), (3, 0.02)):
                s = np.resize(sizes, 400)
                packing = jam.System.random(400, d, diameters=s)
                packing.compress(pressure=1e4)
                found = packing.crunch().packing_fraction
                self.assertAlmostEqual(jam.size_report(s, d).jammed_fraction, found, delta=bound)

    def test_bad_input_is_named(self):
        with self.assertRaisesRegex(jam.errors.ArgumentError, "'bidisperse' is no law"):
            jam.sizes("bidisperse", 10, ratio=1.4)
        for error, text, call in (
            (TypeError, "give n", lambda: jam.sizes("equal")),
            (TypeError, "give n or a density", lambda: jam.sizes("equal", 5, porosity=0.5, box=9.0)),
            (TypeError, "needs cell or box", lambda: jam.sizes("equal", porosity=0.5)),
            (ValueError, "porosity is 1.5", lambda: jam.sizes("equal", porosity=1.5, box=9.0)),
            (TypeError, "deviation is given twice", lambda: jam.sizes("normal:deviation=0.1", 5, deviation=0.2)),
            (TypeError, "n must be a whole number", lambda: jam.sizes("equal", 5.5)),
            (TypeError, "did you mean", lambda: jam.sizes("normal", 5, deviatoin=0.1)),
            (ValueError, r"shape \(rows, 2\)", lambda: jam.sizes("sieve", 5, curve=[1, 2, 3])),
            (jam.errors.ArgumentError, "diameters", lambda: jam.size_report([1.0, -1.0])),
            (jam.errors.NonfiniteError, "diameters", lambda: jam.size_report([1.0, np.nan])),
        ):
            with self.subTest(text), self.assertRaisesRegex(error, text):
                call()
