"""Non-additive mixtures through the Python layer, against the rule written in numpy."""
import unittest

import numpy as np

import jam

DELTAS = (-0.1, 0.1)


def touching(sizes, delta):
    """Contact distances (n, n): (1 + delta) times the mean diameter for unequal ones."""
    mean = 0.5 * (sizes[:, None] + sizes[None, :])
    return np.where(sizes[:, None] == sizes[None, :], mean, (1 + delta) * mean)


def separations(x, y, box):
    r = x[:, None, :] - y[None, :, :]
    return np.linalg.norm(r - box * np.rint(r / box), axis=2)


class NonAdditive(unittest.TestCase):
    def make(self, dim, delta, n=60):
        sizes = np.where(np.arange(n) < n // 2, 1.0, 1.4)
        return jam.System.random(n, dim, 2, diameters=sizes, packing_fraction=0.2, non_additivity=delta)

    def test_gaps_are_those_of_numpy(self):
        for dim in (2, 3):
            for delta in DELTAS:
                s = self.make(dim, delta)
                h = separations(s.positions, s.positions, 1.0) / touching(s.diameters, delta) - 1
                i, j = np.triu_indices(len(s), 1)
                self.assertEqual(s.info.non_additivity, delta)
                self.assertGreaterEqual(h[i, j].min(), 0.0)
                near = np.sort(h[i, j][h[i, j] < 0.3])
                np.testing.assert_allclose(s.gaps(0.3, 0).gap, near, rtol=0, atol=1e-12)

    def test_insertions_are_those_of_numpy(self):
        """Widom insertions: one more sphere of either size at random points is refused just where numpy sees an overlap."""
        random = np.random.default_rng(5)
        for delta in DELTAS:
            s = self.make(2, delta)
            for size in np.unique(s.diameters):
                sizes, free, expected = np.append(s.diameters, size), [], []
                for point in random.random((150, 2)):
                    far = separations(point[None], s.positions, 1.0)[0]
                    expected.append(bool((far >= touching(sizes, delta)[-1, :-1]).all()))
                    try:
                        jam.System.from_arrays(np.vstack([s.positions, point]), sizes, non_additivity=delta)
                        free.append(True)
                    except jam.errors.OverlapError:
                        free.append(False)
                self.assertEqual(free, expected)
                self.assertTrue(any(free) and not all(free))

    def test_copies_and_pickles(self):
        import copy
        import pickle

        s = self.make(2, 0.1)
        for other in (copy.deepcopy(s), pickle.loads(pickle.dumps(s))):
            self.assertEqual(other.info.non_additivity, 0.1)
