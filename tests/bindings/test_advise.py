"""jam.advise: what it advises keeps what it promises."""
import unittest

import jam


class Advise(unittest.TestCase):
    def test_the_advice_gives_its_digits(self):
        for dim, sizes in ((2, [1.0] * 50 + [1.4] * 50), (3, None)):
            start = jam.System.random(100, dim, 7, diameters=sizes)
            start.compress(stages=jam.advise(100, dim).stages)
            exact = start.copy().crunch()
            self.assertTrue(exact.jammed)
            for digits in (3, 6):
                advice = jam.advise(100, dim, digits)
                self.assertLessEqual(advice.error, 10.0**-digits)
                found = start.copy().crunch(**advice.crunch).packing_fraction
                self.assertLess(abs(found - exact.packing_fraction), 10.0**-digits)

    def test_more_digits_never_cost_less_tolerance(self):
        for dim in (2, 3, 4):
            errors = [jam.advise(300, dim, digits).error for digits in range(1, 16)]
            self.assertEqual(errors, sorted(errors, reverse=True))
            self.assertEqual(jam.advise(300, dim).crunch, {})

    def test_time_grows_with_size_and_far_sizes_are_marked(self):
        seconds = [jam.advise(n).seconds for n in (100, 300, 1000, 3000, 10000)]
        self.assertEqual(seconds, sorted(seconds))
        self.assertFalse(jam.advise(300).extrapolated)
        self.assertTrue(jam.advise(10**6).extrapolated)
        self.assertEqual(set(jam.advise(300).table()), set(vars(jam.advise(300))))

    def test_what_cannot_be_advised(self):
        for wrong in ((1, 3, 5), (100, 7, 5), (100, 3, 0), (100, 3, 16), (100, 3, float("nan"))):
            with self.assertRaises(ValueError):
                jam.advise(*wrong)
