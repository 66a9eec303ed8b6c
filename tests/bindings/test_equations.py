"""Equations of state against virial coefficients, and the fit of the glass branch against lines that are known."""
import math
import unittest

import numpy as np

import jam


def third_virial(d):
    """B_3 / B_2^2 = 2 I_{3/4}((d + 1) / 2, 1 / 2), exact in every d (Luban and Baram, J. Chem. Phys. 76, 3233 (1982)). The
    incomplete beta function I is the integral of cos^d from pi / 6 over that from 0 to pi / 2; by Gauss and Legendre."""
    x, w = np.polynomial.legendre.leggauss(60)
    part = [(w @ np.cos(low + (math.pi / 2 - low) * (x + 1) / 2) ** d) * (math.pi / 2 - low) for low in (math.pi / 6, 0.0)]
    return 2 * part[0] / part[1]


class Equations(unittest.TestCase):
    def test_dilute_gas(self):
        for form in ("carnahan_starling", "py_virial", "py_compressibility", "virial"):
            self.assertEqual(jam.eos(form, 3, 0.0), 1)
            self.assertAlmostEqual((jam.eos(form, 3, 1e-4) - 1) / 1e-4 - 4 - 10e-4, 0, 6)  # B_2 and B_3
            with self.assertRaises(jam.errors.UnsupportedError):
                jam.eos(form, 2, 0.3)
        self.assertAlmostEqual(jam.eos("carnahan_starling", 3, 0.5), 13, 12)
        self.assertAlmostEqual(jam.eos("virial", 3, 0.1), jam.eos("carnahan_starling", 3, 0.1), 3)
        self.assertEqual((jam.eos("mk", 3, 0.5), jam.eos("mk", 4, 0.5)), (3, 5))
        self.assertAlmostEqual(jam.eos(jam.EosForm.FREE_VOLUME, 3, 0.6, 0.64), 3 / (1 - 0.6 / 0.64), 12)
        # disks: second virial coefficient 2, third 3.125 in this form (exact 3.128)
        self.assertAlmostEqual((jam.eos("henderson", 2, 1e-4) - 1) / 1e-4 - 2 - 3.125e-4, 0, 7)

    def test_liquid_of_every_dimension(self):
        freezing = {2: 0.70, 3: 0.494, 4: 0.288, 5: 0.174, 6: 0.105, 7: 0.06, 8: 0.035}
        for d in range(2, 9):
            x = 1e-3
            f = x * 2.0 ** (1 - d)  # x = B_2 rho
            a, b = ((jam.eos("pade", d, k * f) - 1) / (k * x) - 1 for k in (1, 2))
            self.assertEqual(jam.eos("pade", d, 0.0), 1)
            self.assertAlmostEqual((4 * a - b) / (2 * x), third_virial(d), 5)  # without the term of B_4
            # it rises up to its pole or maximum, beyond freezing
            before, end = 0.99, None
            for phi in np.arange(0, 1, 0.002):
                try:
                    p = jam.eos("pade", d, phi)
                except jam.errors.ArgumentError as error:
                    self.assertIn(f"in d = {d}", str(error))
                    end = phi
                    break
                self.assertGreater(p, before)
                before = p
            self.assertGreater(end, 1.3 * freezing[d])
        # closed forms of d = 2 and 3 are good to 0.5 % up to freezing
        self.assertAlmostEqual(jam.eos("pade", 2, 0.5) / jam.eos("henderson", 2, 0.5), 1, delta=0.005)
        self.assertAlmostEqual(jam.eos("pade", 3, 0.49) / jam.eos("carnahan_starling", 3, 0.49), 1, delta=0.005)

    def test_refusals(self):
        for wrong, given in (
            (jam.errors.UnsupportedError, ("henderson", 3, 0.3)),
            (jam.errors.ArgumentError, ("henderson", 2, 1.0)),
            (jam.errors.ArgumentError, ("free_volume", 3, 0.7, 0.64)),
            (jam.errors.ArgumentError, (99, 3, 0.3)),
            (jam.errors.DimensionError, (0, 1, 0.3)),
            (jam.errors.ArgumentError, (0, 3, math.nan)),
            (ValueError, ("no_such_form", 3, 0.3)),
        ):
            with self.assertRaises(wrong):
                jam.eos(*given)
        p = np.array([1e5, 2e5, 3e5])
        phi = 0.64 * (1 - 3 / p)
        for given in ((phi, p[:2]), (phi, -p), (phi[::-1], p), (phi * math.nan, p)):
            with self.assertRaises(jam.errors.ArgumentError):
                jam.glass_fit(*given)
        with self.assertRaises(jam.errors.TooFewError):
            jam.glass_fit(phi[:2], p[:2])

    def test_errors_of_a_glass_fit_are_those_of_the_covariance_matrix(self):
        k = np.arange(9)
        for number, (low, high) in enumerate(((0.60, 0.63), (0.50, 0.60), (0.40, 0.55))):
            phi = low + (high - low) * k / 8
            p = 1 / ((1 - phi / 0.64) / 2.9 + 1e-5 * np.sin(5 * k + number))
            x = np.stack([np.ones(9), phi], 1)  # 1/p = a + c phi: d' = 1 / a and phi_J = -a / c, to first order
            (a, c), rest = np.linalg.lstsq(x, 1 / p, rcond=None)[:2]
            cov = np.linalg.inv(x.T @ x) * rest[0] / 7
            g = jam.glass_fit(phi, p)
            self.assertAlmostEqual(g.dimension * a, 1, 9)
            self.assertAlmostEqual(g.jammed_fraction * c / a, -1, 9)
            self.assertAlmostEqual(g.dimension_error * a**2 / math.sqrt(cov[0, 0]), 1, 6)
            slopes = np.array([-1 / c, a / c**2])
            self.assertAlmostEqual(g.jammed_error / math.sqrt(slopes @ cov @ slopes), 1, 5)
            self.assertAlmostEqual(g.r_squared, 1 - rest[0] / ((1 / p - (1 / p).mean()) ** 2).sum(), 9)
