"""Packings and lattices that several tests make, and how they compare two."""
import itertools
import tempfile
import unittest
from pathlib import Path

import numpy as np

import jam

#: A protocol of an ensemble whose packings take a tenth of a second
SMALL = dict(n=24, dim=2, diameters={"law": "bidisperse"}, stages=[{"growth_rate": 0.1, "pressure": 100.0}])


class InFolder(unittest.TestCase):
    """Cases that write files: each has a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)


def fluid(n=64, dim=3, seed=1, fraction=0.55):
    s = jam.System.random(n, dim, seed)
    s.compress(growth_rate=1e-2, packing_fraction=fraction)
    return s


def packing(n=64, dim=3, seed=1, **more):
    s = jam.System.random(n, dim, seed, **more)
    s.compress(growth_rate=3e-2, pressure=500.0)
    report = s.crunch()
    assert report.jammed, (n, dim, seed)
    return s


def disks(seed=1):
    return jam.System.random(n=64, dim=2, seed=seed, diameters=[1.0] * 32 + [1.4] * 32)


def crunched_disks():
    s = disks()
    s.crunch()
    return s


def state(s):
    return np.array(s.positions), np.array(s.diameters), np.array(s.cell)


def lattice(basis, vectors, sizes):
    """Spheres of diameter 1 on basis + integer combinations of the vectors."""
    vectors = np.array(vectors, float)
    cells = np.array(list(itertools.product(*map(range, sizes)))) @ vectors
    x = (cells[:, None, :] + np.array(basis, float)[None]).reshape(-1, len(vectors))
    return x, np.diag(sizes) @ vectors


def cubic(m, dim=3):
    return lattice([[0] * dim], np.eye(dim), [m] * dim)


def fcc(m):
    basis = np.array([[0, 0, 0], [0, 1, 1], [1, 0, 1], [1, 1, 0]]) / np.sqrt(2)
    return lattice(basis, np.sqrt(2) * np.eye(3), [m] * 3)


def triangular(m):
    return lattice([[0, 0]], [[1, 0], [0.5, np.sqrt(3) / 2]], [m, m])


def same_bits(a, b):
    """Compares two packings of one seed: state and network, not times."""
    for name in ("positions", "diameters", "velocities", "forces", "coordination"):
        np.testing.assert_array_equal(getattr(a, name), getattr(b, name))
    np.testing.assert_array_equal(a.contacts.pairs, b.contacts.pairs)
