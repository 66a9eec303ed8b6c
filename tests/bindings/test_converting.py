"""A packing as objects of other packages has the numbers of the packing."""
import importlib.util
import tempfile
import unittest

import numpy as np

import jam
from packings import crunched_disks


def needs(name):
    return unittest.skipUnless(importlib.util.find_spec(name), f"python3-{name} is not installed")


class Converting(unittest.TestCase):
    @needs("pandas")
    def test_frames_have_the_numbers_and_words(self):
        packing = crunched_disks()
        spheres, contacts, steps = (packing.to_pandas(what) for what in ("spheres", "contacts", "history"))
        np.testing.assert_array_equal(spheres[["x", "y"]], packing.positions)
        np.testing.assert_array_equal(spheres["diameter"], packing.diameters)
        self.assertEqual((spheres["kind"] == "rattler").sum(), packing.report.rattlers)
        self.assertEqual((spheres["kind"] == "buckler").sum(), packing.report.bucklers)
        np.testing.assert_array_equal(contacts[["i", "j"]], packing.contacts.pairs)
        np.testing.assert_array_equal(contacts[["nx", "ny"]], packing.contacts.vectors)
        self.assertEqual((steps["phase"] == "lp").sum(), packing.report.lp_solves)
        with self.assertRaisesRegex(ValueError, "spheres, contacts, history"):
            packing.to_pandas("forces")
        packing.to_pandas()["x"][:] = 0.0  # a copy
        np.testing.assert_array_equal(spheres["x"], packing.positions[:, 0])

    @needs("pandas")
    def test_frames_without_forces(self):
        loose = jam.System.random(n=8, dim=4)
        self.assertEqual(list(loose.to_pandas()), ["x0", "x1", "x2", "x3", "diameter"])
        with self.assertRaises(jam.errors.StateError):
            loose.to_pandas("contacts")
        bed = jam.System.from_arrays([[0.5, 0.5], [1.5, 0.5]], 0.99, cell=[3, 3], dim=2)
        bed.contacts_by_distance(0.05)
        self.assertEqual(list(bed.to_pandas("contacts")), ["i", "j", "nx", "ny", "gap"])

    @needs("networkx")
    def test_the_graph_balances(self):
        packing = crunched_disks()
        graph = packing.to_networkx()
        self.assertEqual(graph.number_of_edges(), packing.report.contacts)
        net = np.zeros((64, 2))
        for i, j, edge in graph.edges(data=True):
            first, second = (i, j) if i < j else (j, i)  # an edge has no direction, pairs have i < j
            net[first] += edge["force"] * np.array(edge["vector"])
            net[second] -= edge["force"] * np.array(edge["vector"])
        self.assertLess(np.abs(net).max(), 1e-8)
        alone = [i for i, kind in graph.nodes(data="kind") if kind == "rattler"]
        self.assertEqual(alone, list(np.flatnonzero(packing.rattlers)))

    @needs("ase")
    def test_ase_and_back_has_the_same_bits(self):
        cells = {2: [[1.0, 0.0], [0.3, 1.0]], 3: [[1.0, 0.0, 0.0], [0.3, 1.0, 0.0], [0.1, 0.2, 1.0]]}
        for dim, cell in cells.items():
            x = np.random.default_rng(dim).random((20, dim))
            packing = jam.System.from_arrays(x, np.linspace(0.01, 0.02, 20), cell=cell, overlap="allow")
            atoms = packing.to_ase()
            self.assertEqual(list(atoms.pbc), [True, True, dim == 3])
            again = jam.System.from_ase(atoms, dim=dim, overlap="allow")
            np.testing.assert_array_equal(again.positions, packing.positions)
            np.testing.assert_array_equal(again.diameters, packing.diameters)
            np.testing.assert_array_equal(again.cell, packing.cell)
        with self.assertRaisesRegex(ValueError, "three dimensions"):
            jam.System.random(n=8, dim=4).to_ase()
        with self.assertRaisesRegex(ValueError, "dim=2 reads"):
            jam.System.from_ase(crunched_disks().to_ase())
        atoms.arrays.pop("radius")
        with self.assertRaisesRegex(ValueError, "give diameters="):
            jam.System.from_ase(atoms)
        self.assertEqual(jam.System.from_ase(atoms, radii=0.005).diameters[0], 0.01)

    @needs("ase")
    def test_ase_keeps_non_additivity_and_names_the_dimension_of_walls(self):
        mixture = jam.System.random(n=20, dim=3, seed=1, non_additivity=0.2, diameters=[1.0] * 10 + [1.4] * 10)
        again = jam.System.from_ase(mixture.to_ase())
        self.assertEqual(again.info.non_additivity, 0.2)
        self.assertEqual(jam.System.from_ase(mixture.to_ase(), non_additivity=0.2).info.non_additivity, 0.2)
        with self.assertRaisesRegex(ValueError, "non_additivity= is 0.1, that of info is 0.2"):
            jam.System.from_ase(mixture.to_ase(), non_additivity=0.1)
        with self.assertRaisesRegex(ValueError, "dim=2 reads"):
            jam.System.from_ase(jam.System.random(n=8, dim=2, walls="x").to_ase())

    @needs("gsd")
    def test_gsd_refuses_what_it_has_no_place_for(self):
        mixture = jam.System.random(n=20, dim=3, seed=1, non_additivity=0.2, diameters=[1.0] * 10 + [1.4] * 10)
        with tempfile.TemporaryDirectory() as folder:
            for made, text in ((mixture, "non_additivity = 0.2"), (jam.System.random(n=8, walls="x"), "walls")):
                for write in (made.write, lambda path, made=made: jam.files.write_gsd(made, path)):
                    with self.assertRaisesRegex(jam.errors.UnsupportedError, f"GSD cannot store {text}: write extended XYZ"):
                        write(f"{folder}/a.gsd")
