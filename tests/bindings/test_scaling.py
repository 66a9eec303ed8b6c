"""Finite-size scaling on synthetic data of known exponents."""
import unittest

import numpy as np

from jam import scaling

GAMMA = 0.41269


def packings(rng, n, exponent, count=40):
    """Left power laws whose plateau N sets: packings of 6 N values, one of them below the plateau's end on average."""
    plateau = (1.0 / (6 * n)) ** (1.0 / (1.0 + exponent))
    return [scaling.draw_left_power(rng, 6 * n, exponent, plateau) for _ in range(count)]


class Estimators(unittest.TestCase):
    def setUp(self):
        self.samples = packings(np.random.default_rng(1), 128, 0.42)

    def test_the_three_distributions_agree(self):
        x = np.geomspace(0.01, 0.9, 20)
        pooled, ranked = scaling.cdf_pooled(self.samples), scaling.cdf_ranked(self.samples)
        grid = scaling.cdf_grid(self.samples, x)
        at = np.searchsorted(pooled.x, x, "right") / len(pooled.x)
        np.testing.assert_allclose(grid.c, at, rtol=1e-12)  # packings hold equally many values
        # 20 correlated points of independent packings: four standard errors
        self.assertLess((abs(np.interp(x, ranked.x, ranked.c) - grid.c) / grid.c_error).max(), 4.0)
        np.testing.assert_allclose(grid.c, x**1.42, atol=4.5 * grid.c_error.max() + 1e-3)

    def test_local_exponents_see_the_law_and_the_plateau(self):
        x = np.geomspace(1e-6, 1.0, 200)
        c = np.where(x < 1e-3, x * 1e-3**0.42, x**1.42)
        slope = scaling.local_exponent(x, c, 0.5)
        np.testing.assert_allclose(slope[x < 3e-4], 1.0, atol=1e-9)
        np.testing.assert_allclose(slope[x > 3e-3], 1.42, atol=1e-9)

    def test_likelihood_of_exact_quantiles(self):
        x = ((np.arange(200000) + 0.5) / 200000) ** (1 / 1.42)
        self.assertAlmostEqual(scaling.fit_power([x, x], 1.0).value, 0.42, places=4)
        self.assertAlmostEqual(scaling.fit_power([x, x], 0.5, 1e-2).value, 0.42, places=3)

    def test_errors_are_over_packings(self):
        """Values that all packings hold alike scatter between packings only."""
        rng = np.random.default_rng(4)
        samples = [np.repeat(scaling.draw_left_power(rng, 50, 0.4, 1e-9), 20) for _ in range(60)]
        independent = [scaling.draw_left_power(rng, 1000, 0.4, 1e-9) for _ in range(60)]
        ratio = scaling.fit_power(samples, 1.0).error / scaling.fit_power(independent, 1.0).error
        self.assertAlmostEqual(ratio, np.sqrt(20), delta=1.5)  # each error is good to 10 %

    def test_what_cannot_be_fitted(self):
        with self.assertRaisesRegex(ValueError, "at least 2"):
            scaling.fit_power([np.array([0.1])], 1.0)
        with self.assertRaisesRegex(ValueError, "values in the range"):
            scaling.fit_power([np.array([0.1]), np.array([0.2])], 1e-3, 1e-4)
        two = [np.array([0.1, 0.3]), np.array([0.2])]
        for low in (0.0, -1.0):
            with self.assertRaisesRegex(ValueError, "low is .*above 0"):
                scaling.fit_power(two, 0.5, low)
        for call in (lambda x: scaling.cdf_grid(x, [0.5]), lambda x: scaling.collapse({8: x, 16: x}, [0.5], [0.4])):
            with self.assertRaisesRegex(ValueError, "packing 2 has no values"):
                call([*two, []])
        broken = [np.array([0.1, np.nan]), np.array([0.2])]
        grid = np.linspace(0, 1, 4)
        for call in (
            lambda: scaling.fit_power(broken, 1.0), lambda: scaling.cdf_pooled(broken), lambda: scaling.cdf_ranked(broken),
            lambda: scaling.cdf_grid(broken, grid), lambda: scaling.collapse({8: broken, 16: broken}, grid, [0.4]),
        ):
            with self.assertRaisesRegex(ValueError, "not finite"):
                call()
        with self.assertRaisesRegex(ValueError, "0 points"):
            scaling.fit_crossover(grid, grid, np.full(4, np.nan), 0.4)

    def test_values_of_zero_and_less_are_counted(self):
        rng = np.random.default_rng(8)
        samples = [scaling.draw_left_power(rng, 30000, 0.4, 1e-9) for _ in range(3)]
        more = [np.append(x, [0.0, -1e-14]) for x in samples]
        for fit in (lambda x: scaling.fit_power(x, 1.0), lambda x: scaling.tail_exponent(x, 1024)):
            without, found = fit(samples), fit(more)
            self.assertEqual((without.omitted, found.omitted), (0, 6))
            self.assertEqual(without[:-1], found[:-1])


class Coverage(unittest.TestCase):
    def test_the_interval_of_one_error_holds_the_truth_in_two_thirds_of_trials(self):
        rng, trials = np.random.default_rng(5), 400
        inside = 0
        for k in range(trials):
            plateau = 2e-3
            samples = [scaling.draw_left_power(rng, 60, -GAMMA, plateau) for _ in range(60)]
            found = scaling.fit_power(samples, 1.0, plateau, resamples=100, seed=k)
            inside += abs(found.value + GAMMA) < found.error
        # 68.3 % with a standard error of 2.3 %: three of them
        self.assertAlmostEqual(inside / trials, 0.683, delta=0.07)

    def test_bootstrap_gives_the_error_of_a_mean(self):
        values = list(np.random.default_rng(6).normal(size=400))
        found = scaling.bootstrap(values, np.mean, 400)
        self.assertAlmostEqual(found.error, np.std(values, ddof=1) / 20.0, delta=0.2 / 20.0)


class CollapseOfSizes(unittest.TestCase):
    def test_exponent_and_quality(self):
        rng = np.random.default_rng(7)
        sizes = {n: packings(rng, n, -GAMMA, 60) for n in (64, 256, 1024)}

        def grid(n):
            return np.geomspace(0.05, 30.0, 24) * (6 * n) ** (-1 / (1 - GAMMA))

        found = scaling.collapse(sizes, grid, [-0.3], resamples=12)
        self.assertLess(abs(found.value[0] + GAMMA), 4 * found.error[0])
        self.assertLess(found.error[0], 0.02)
        self.assertLess(found.quality, 3.0)
        grids = {n: scaling.cdf_grid(s, grid(n)) for n, s in sizes.items()}
        off = scaling.quality(list(grids.items()), *scaling.tail_scaling([-GAMMA - 0.1]))
        self.assertGreater(off, 3 * found.quality)

    def test_crossover_form_is_found_again(self):
        x = np.geomspace(1e-3, 1e3, 60)
        c = scaling.crossover(x, 0.179008, 0.223543, -1.25569, -GAMMA)
        np.testing.assert_allclose(c[0] / x[0], 0.179008, rtol=0.03)
        found, misfit = scaling.fit_crossover(x, c, 0.01 * c, -GAMMA)
        np.testing.assert_allclose(found, [0.179008, 0.223543, -1.25569], rtol=1e-5)
        self.assertLess(misfit, 1e-6)
