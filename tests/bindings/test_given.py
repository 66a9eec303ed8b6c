"""Arguments of System.from_arrays and System.random: understood, or refused by name with the way out."""
import tempfile
import unittest
from pathlib import Path

import numpy as np

import jam

X = np.array([[0.1, 0.2, 0.3], [0.6, 0.7, 0.8], [0.35, 0.9, 0.15]])
make = jam.System.from_arrays


class Shapes(unittest.TestCase):
    """Every array that a call takes has the header's shape, or is flat as in C; a transposed one is refused by name."""

    @classmethod
    def setUpClass(cls):
        cls.disks = jam.System.random(n=16, dim=2, seed=1, diameters=[1.0] * 8 + [1.4] * 8)
        cls.disks.crunch()
        cls.planted = jam.System.random(n=6, dim=2, seed=1, model="mk")

    def test_other_shapes_of_as_many_numbers_are_refused(self):
        pairs = np.array([(0, 1), (2, 3), (4, 5)], np.int32)
        for system, call, name, array in (
            (self.planted, "mk_shifts", "pair", pairs), (self.disks, "set_positions", "positions", self.disks.positions),
            (self.disks, "strain", "strain", np.zeros((2, 2))), (self.disks, "bloch_modes", "wave", np.array([0.5, 0.0])),
            (self.disks, "refined_positions", "ratio", self.disks.diameters), (self.disks, "bloch_rigidity", "count", np.array([1, 2], np.int32)),
        ):
            wrong = [array[None], *([array.T] if array.shape != array.T.shape else [])]
            for other in wrong:
                with self.assertRaisesRegex(ValueError, f"{name} must have shape", msg=f"{call}: {other.shape}"):
                    system.copy().call(call, **{name: other})
        np.testing.assert_array_equal(self.planted.call("mk_shifts", pair=pairs.ravel()), self.planted.call("mk_shifts", pair=pairs))

    def test_tables_where_a_row_of_numbers_is_wanted(self):
        table = np.ones((2, 2))
        for call in (
            lambda: jam.System.random(n=4, dim=2, diameters=table),
            lambda: jam.size_report(table, dim=2),
            lambda: self.disks.isoconf(table),
            lambda: self.disks.tile([[1, 2]]),
            lambda: self.disks.bloch_modes([[0.5, 0.0]]),
            lambda: self.disks.bloch_rigidity([[1, 2]]),
        ):
            with self.assertRaisesRegex(ValueError, "must be a row of numbers"):
                call()
        with self.assertRaisesRegex(jam.ensemble.ProtocolError, "diameters must be 4"):
            jam.ensemble.complete(dict(n=4, dim=2, diameters=table))
        with self.assertRaisesRegex(ValueError, r"height must have shape \(16,\) or \(16, 2\)"):
            self.disks.page("never.html", values={"height": np.ones((4, 4))})


class Given(unittest.TestCase):
    def refused(self, words, call, *args, kind=ValueError, **named):
        with self.assertRaises(kind) as told:
            call(*args, **named)
        for word in words:
            self.assertIn(word, str(told.exception))

    def test_sides(self):
        for named in ({"box": [2, 2, 2]}, {"cell": (2.0, 2.0, 2.0)}, {"box": np.float64(2)}):
            s = make(X, 0.2, **named)
            self.assertEqual(s.box, 2.0)
            np.testing.assert_array_equal(s.cell, 2 * np.eye(3))
            np.testing.assert_array_equal(s.positions, X)
        for name in ("box", "cell"):
            np.testing.assert_array_equal(make(X, 0.2, **{name: [1, 1, 2]}).cell, np.diag([1.0, 1.0, 2.0]))
            s = jam.System.random(n=20, dim=2, **{name: [1, 3]})
            self.assertAlmostEqual(abs(np.linalg.det(s.cell)), 3.0)
            self.assertAlmostEqual(s.packing_fraction, 0.2)
        s.cell = [[2.0, 0.0], [0.5, 6.0]]
        np.testing.assert_array_equal(s.cell, [[2.0, 0.0], [0.5, 6.0]])

    def test_whole_numbers_that_do_not_fit(self):
        s = make(X, 0.2, box=2)
        for count in ((2**32 + 2, 1, 1), (-(2**32) + 1, 1, 1), np.array([2**31, 1, 1]), np.array([2**63, 1, 1], np.uint64)):
            for call in (s.tile, s.bloch_rigidity):
                self.refused(["count holds", "2147483647"], call, count)
        with self.assertRaisesRegex(ValueError, "kind holds 4294967297"):
            s.pair_correlation(0.5, 4, kind=[2**32 + 1, 0, 0], a=1, b=1)
        self.assertEqual(s.tile(np.array([2, 1, 1], np.uint64)).n, 6)

    def test_cells_that_are_none(self):
        six = [1, 1, 2, 90, 90, 90]
        for name in ("box", "cell"):
            self.refused([name, "(6,)", "cellpar_to_cell", "HOOMD"], make, X, 0.2, **{name: six})
            self.refused([name, "(2,)"], make, X, 0.2, **{name: [1, 1]})
        self.refused(["box", "cell="], make, X, 0.2, box=np.eye(3))
        self.refused(["box", "(0,)"], make, np.zeros((2, 0)), 0.2, box=[])
        self.refused(["cell", "box="], make, X, 0.2, cell=2.0)
        self.refused(["cell", "third direction"], make, X[:, :2], 0.2, cell=np.eye(3))
        self.refused(["determinant", "exchange two"], make, X, 0.2, cell=[[0, 1, 0], [1, 0, 0], [0, 0, 1]])
        for call in (lambda **n: make(X, 0.2, **n), lambda **n: jam.System.random(n=10, **n)):
            self.refused(["box and cell"], call, box=2.0, cell=np.eye(3), kind=TypeError)

    def test_masked_values(self):
        self.refused(["positions", "1 values are masked"], make, np.ma.array(X, mask=X == 0.7), 0.2)
        self.refused(["diameters", "masked"], make, X, np.ma.array([0.1, 0.2, 0.1], mask=[0, 1, 0]))
        self.assertEqual(make(np.ma.array(X), 0.2).n, 3)
        s = make(X, 0.2)
        with self.assertRaises(ValueError):
            s.positions = np.ma.array(X, mask=X == 0.7)

    def test_a_last_column_of_sizes(self):
        r = np.array([0.1, 0.1, 0.1])
        for sizes in ({"diameters": 0.2}, {"radii": 0.1}, {"diameters": 2 * r}, {"radii": r}, {"diameters": r}):
            self.refused(["last column", "positions[:, :3]", "dim=4"], make, np.column_stack([X, r]), **sizes)
        self.refused(["radii=positions[:, 3]"], make, np.column_stack([X, r]), kind=TypeError)
        self.refused(["last column"], make, np.column_stack([X[:, :2], [0.1, 0.2, 0.1]]), [0.2, 0.4, 0.2])
        self.assertEqual(make(np.column_stack([X, r]), 0.2, dim=4).dim, 4)
        self.assertEqual(make(np.column_stack([X, [0.1, 0.1, 0.3]]), 0.2).dim, 4)

    def test_dim_and_n_confirm(self):
        self.assertEqual(make(X, 0.2, dim=3, n=3).n, 3)
        self.refused(["(n, 2)"], make, X, 0.2, dim=2)
        self.refused(["n is 4"], make, X, 0.2, n=4)
        self.refused(["packing_fraction", "without effect"], make, X, 0.2, packing_fraction=0.5, kind=TypeError)

    def test_positions_of_another_box(self):
        self.refused(["positions[0, 2]", "1.2", "box="], make, 4 * X, 0.2)
        self.refused(["positions[0, 0]", "-0.4"], make, X - 0.5, 0.2)
        self.assertEqual(make(4 * X, 0.2, box=4).box, 4)
        np.testing.assert_allclose(make(X + 5.0, 0.2, box=1).positions, X, rtol=1e-14)  # named: wrapped
        x = X.copy()
        x[0] = 1.0, -1e-17, 0.0  # rounding of a wrap
        self.assertEqual(make(x, 0.2).n, 3)
        self.refused(["nan"], make, np.where(X == 0.7, np.nan, X), 0.2)

    def test_numbers_out_of_range(self):
        for seed in (2**64, 2**63, -(2**63) - 1):
            self.refused(["seed", str(seed), "2**63"], make, X, 0.2, seed=seed)
        self.assertEqual(make(X, 0.2, seed=2**63 - 1).seed, 2**63 - 1)
        self.refused(["n is", "2**"], jam.System.random, n=2**70)
        for wrong in ("many", [1, 2], float("nan"), 1.5):
            self.refused(["seed", "whole number"], make, X, 0.2, seed=wrong, kind=TypeError)
        self.refused(["packing_fraction", "number"], jam.System.random, n=10, packing_fraction=[0.1], kind=TypeError)

    def test_box_beside_a_file_that_names_one(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "a.dat")
            jam.System.random(n=10, dim=2, box=2.0).write(path)
            self.assertEqual(jam.System.read(path, box=2.0).box, 2.0)
            self.refused(["box"], jam.System.read, path, box=3.0)
            self.refused(["gives its cell"], jam.System.read, path, box=[1, 2])
