"""jam.digits: decimals of a jammed packing, by rational arithmetic that shares nothing with the steps that made them."""
import unittest
from decimal import Decimal
from fractions import Fraction

import numpy as np

import jam
import jam.digits

PI = Fraction("3.14159265358979323846264338327950288419716939937510582097494459230781640628620899862803482534211706798214808651")


def jammed(n, dim, seed=1, **more):
    packing = jam.System.random(n=n, dim=dim, seed=seed, diameters=[1.0, 1.4] * (n // 2), **more)
    packing.compress()
    assert packing.crunch().jammed
    return packing


def exact(values):
    return [[Fraction(v) for v in row] for row in values]


class Digits(unittest.TestCase):
    def check_packing(self, packing, digits):
        """Distances of all contacts are one factor times sigma; forces balance; both to the radii."""
        found = jam.digits.refine(packing, digits)
        for radius in (found.packing_fraction_radius, found.radius / Decimal(packing.info.box), found.forces_radius):
            self.assertLess(radius, Decimal(10) ** -digits)
        x, cell, sigma = exact(found.positions), exact(packing.cell), [Fraction(s) for s in packing.diameters]
        d, r = packing.dim, Fraction(found.radius)
        net, ratios, inverse = {}, [], np.linalg.inv(packing.cell)
        for (i, j), force in zip(packing.contacts.pairs, found.forces):
            shift = np.round((packing.positions[j] - packing.positions[i]) @ inverse)
            between = [x[i][k] - x[j][k] + sum(int(n) * cell[c][k] for c, n in enumerate(shift)) for k in range(d)]
            contact = (sigma[i] + sigma[j]) / 2 * (1 if sigma[i] == sigma[j] else 1 + Fraction(packing.info.non_additivity))
            ratios.append(sum(v * v for v in between) / contact**2)
            for sphere, sign in ((i, 1), (j, -1)):
                for k in range(d):
                    net[sphere, k] = net.get((sphere, k), 0) + sign * Fraction(force) * between[k] / contact
        # each coordinate within r: a squared distance changes by less than 2 d (2 r) |r| + d (2 r)^2
        self.assertLess(max(ratios) - min(ratios), 10 * d * r / min(sigma))
        self.assertLess(max(map(abs, net.values())), Fraction(found.forces_radius) * 100 + 1000 * r / min(sigma))
        self.assertLess(abs(sum(map(Fraction, found.forces)) / len(found.forces) - 1), Fraction(found.forces_radius))
        if d == 2:  # the factor is G
            volume = cell[0][0] * cell[1][1]
            phi = PI / 4 * sum(s**2 for s in sigma) * ratios[0] / volume
            self.assertLess(abs(phi - Fraction(found.packing_fraction)), max(Fraction(found.packing_fraction_radius) * 10, 10 ** -100))
        return found

    def test_contacts_close_and_forces_balance_to_the_radius(self):
        self.check_packing(jammed(32, 2), 60)
        self.check_packing(jammed(32, 3), 40)

    def test_any_unit_cell_and_mixture(self):
        self.check_packing(jammed(24, 2, cell=[[3e7, 0], [1e7, 2e7]]), 50)
        self.check_packing(jammed(24, 2, non_additivity=0.2), 50)

    def test_the_radius_holds_for_fewer_digits(self):
        packing = jammed(32, 3)
        few, many = (jam.digits.refine(packing, digits) for digits in (20, 200))
        self.assertLessEqual(abs(few.packing_fraction - many.packing_fraction), few.packing_fraction_radius)
        self.assertLessEqual(max(abs(few.positions - many.positions).ravel()), few.radius)
        self.assertLessEqual(max(abs(few.forces - many.forces)), few.forces_radius)

    def test_what_has_no_proof_is_refused(self):
        fcc = jam.System.from_arrays([[0, 0, 0], [0, 0.5, 0.5], [0.5, 0, 0.5], [0.5, 0.5, 0]], [0.5**0.5], box=1)
        fcc = fcc.tile([2, 2, 2])
        fcc.contacts_from_geometry()
        with self.assertRaisesRegex(jam.errors.StateError, "only isostatic packings"):
            jam.digits.refine(fcc, 50)
        with self.assertRaisesRegex(jam.errors.StateError, "no contact network"):
            jam.digits.refine(jam.System.random(n=10, dim=2, seed=1), 50)
        with self.assertRaisesRegex(jam.errors.StateError, "periodic packings"):
            jam.digits.refine(jammed(24, 2, walls="x"), 50)
        with self.assertRaisesRegex(ValueError, "digits is 10"):
            jam.digits.refine(jammed(24, 2), 10)
