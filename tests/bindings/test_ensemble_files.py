"""Protocols of ensembles, and the files of their packings."""
import json
import pickle
import tempfile
import unittest

import h5py
import numpy as np

import jam
from jam.ensemble import Ensemble, ProtocolError
from packings import SMALL, InFolder, same_bits

SOFT = {"verb": "monte_carlo", "alpha": 2.0, "temperature": 1e-3}


class Protocols(unittest.TestCase):
    def test_every_default_is_spelled_out_and_json_keeps_it(self):
        full = jam.ensemble.complete(dict(n=128, dim=3))
        self.assertEqual(json.loads(jam.ensemble.to_json(full)), full)
        self.assertEqual(jam.ensemble.complete(full), full)
        self.assertEqual(full["start"]["packing_fraction"], 0.2)
        self.assertEqual(full["crunch"]["wall_time"], "inf")
        self.assertEqual([s["pressure"] for s in full["stages"]], [500.0, 1e6])
        self.assertEqual(full, jam.ensemble.complete({"start": {"n": 128}}))

    def test_what_no_crunch_made_is_unknown(self):
        for scene in ({"container": "ball"}, {}):
            with tempfile.TemporaryDirectory() as folder:
                e = Ensemble(folder, dict(SMALL, crunch=None, analysis={}, **scene))
                self.assertEqual(e.run([1, 2], progress=False, workers=1).jammed, 0)
                table = e.table()
                for row, entry in zip(table, e, strict=True):
                    system = entry.system()
                    self.assertAlmostEqual(row["packing_fraction"], system.packing_fraction, 12)
                    self.assertAlmostEqual(row["diameter_mean"], system.diameters.mean(), 12)
        for name in ("rattlers", "contacts", "excess_contacts", "strictly_jammed", "lp_solves", "contacts_kept"):
            self.assertEqual(table[name].tolist(), [-1, -1], name)
        for name in ("max_overlap", "force_residual", "gain", "min_gap", "seconds", "rigidity_margin"):
            self.assertTrue(np.isnan(table[name]).all(), name)
        self.assertEqual(table["status"].tolist(), [jam.StatusCode.E_STATE] * 2)
        self.assertEqual(table["jammed"].tolist(), [0, 0])

    def test_seeds_are_whole(self):
        with tempfile.TemporaryDirectory() as folder:
            for wrong in (1.5, -1, 2**63):
                with self.assertRaisesRegex(ProtocolError, "seed"):
                    Ensemble(folder, SMALL).run([wrong], progress=False)

    def test_wrong_entries_are_named(self):
        for wrong, text in (
            (dict(n=10, speed=3), "speed"),
            (dict(n=0), "n = 0"),
            (dict(n=10, start={"n": 10}), "given twice"),
            (dict(n=10, diameters=[1.0, 2.0]), "diameters must be 10"),
            (dict(n=10, diameters={"law": "gauss"}), "gauss"),
            (dict(n=10, diameters={"law": "bidisperse", "rato": 1.3}), "bidisperse has no rato; it takes ratio and share"),
            (dict(n=10, diameters={"law": "bidisperse", "ratio": "a"}), "a ratio > 0"),
            (dict(n=10, diameters={"law": "lognormal", "ratio": 1.3}), "no law has ratio; there are .*deviation"),
            (dict(n=10, analysis={"gap": {}}), "did you mean gaps"),
            (dict(SMALL, packing_fraction=0.95), "no packing of seeds 1, 2, 3 can begin"),
            (dict(n=10, lattice="fcc"), "unknown lattice"),
            (dict(n=10, stages=[{"verb": "shake"}]), "shake"),
            *((dict(n=10, stages=[{"verb": v}]), f"no stage is called '{v}'") for v in ("isoconf", "check", "diameters", "crunch")),
            (dict(n=10, stages=[{"pressur": 10}]), "pressur"),
            (dict(n=10, crunch={"method": "guess"}), "guess"),
            (dict(n=10, analysis={"colour": {}}), "colour"),
            *(  # what changes the packing, returns no numbers, writes a file or needs another packing
                (dict(n=10, analysis={name: {}}), f"analysis.'{name}'.: no method of System that measures")
                for name in ("compress", "crunch", "maximise_radii", "contacts_from_geometry", "strain", "tile", "copy", "cancel",
                             "add_note", "write_stl", "compare")
            ),
            (dict(n=10, analysis={"bond_order": {"l": 6}}), "cutoff"),
            (dict(n=10, model="flat"), "flat"),
            (dict(n=10, stages=[(-1.0, 10.0)]), r"stages\[0\]: growth_rate is -1"),
            (dict(n=10, crunch={"strain": "volume"}), "crunch: strain is 4, which frees the volume"),
            (dict(n=10, overlap="shrink"), "refuse"),
            (dict(n=10, overlap="allow"), r"stages\[0\]: compress is for hard spheres"),
            (dict(n=10, overlap="allow", stages=[{"verb": "shear"}], crunch=None), r"stages\[0\]: shear needs to"),
            (dict(n=10, overlap="allow", stages=[{"verb": "shear", "to": 0.1}]), "crunch: crunch is for hard spheres"),
            (dict(n=10, overlap="allow", stages=[{"verb": "shear", "to": 0.1, "step": -1}], crunch=None), "step"),
            (dict(n=10, stages=[{"verb": "relax"}]), "overlap='allow'"),
            (dict(n=10, stages=[SOFT]), "crunch: crunch is for hard spheres, .* put decompress before it, or crunch=None"),
            (dict(n=10, stages=[SOFT, {"growth_rate": 0.1}]), r"stages\[1\]: compress is for hard spheres"),
        ):
            with self.assertRaisesRegex(ProtocolError, text):
                jam.ensemble.complete(wrong)
        for right in (dict(stages=[SOFT], crunch=None), dict(stages=[SOFT, SOFT, {"verb": "decompress"}]), dict(stages=[SOFT, {"verb": "relax"}])):
            jam.ensemble.complete(dict(right, n=10))

    def test_the_error_of_a_wrong_analysis_lists_the_names_that_measure(self):
        with self.assertRaises(ProtocolError) as refused:
            jam.ensemble.complete(dict(n=10, analysis={"zzz": {}}))
        named = str(refused.exception).partition("there are ")[2].split(", ")
        self.assertLessEqual({"gaps", "floppy_modes", "modes", "isoconf", "rigidity", "moduli", "prove", "crystal_score"}, {*named})
        self.assertFalse({"cancel", "add_note", "compress", "copy", "tile", "observe", "write"} & {*named})

    def test_names_depend_on_protocol_seed_and_algorithm_alone(self):
        a, b = Ensemble("x", SMALL), Ensemble("y", dict(SMALL, n=26))
        self.assertEqual(a.name(1), Ensemble("z", a.protocol).name(1))
        self.assertNotEqual(a.name(1), a.name(2))
        self.assertNotEqual(a.name(1), b.name(1))
        self.assertNotEqual(a.name(1), jam.ensemble.packing_name(a.id, 1, "other algorithm"))

    def test_laws_of_diameters(self):
        law = {"law": "lognormal", "deviation": 0.004}
        s = jam.ensemble.begin(jam.ensemble.complete(dict(n=500, packing_fraction=0.2, diameters=law)), 3)
        self.assertAlmostEqual(s.packing_fraction, 0.2, places=12)
        # deviation of 500 draws: standard error 3 %; five of them
        self.assertAlmostEqual(s.diameters.std() / s.diameters.mean(), 0.004, delta=0.0006)


class Files(InFolder):
    def setUp(self):
        super().setUp()
        self.path = self.folder / "a.h5"
        self.s = jam.System.random(n=40, dim=3, seed=5)
        self.s.compress(growth_rate=0.05)
        self.s.crunch()
        self.s.save(self.path)

    def test_a_file_and_a_pickle_hold_everything(self):
        for back in (jam.load(self.path), pickle.loads(pickle.dumps(self.s))):
            same_bits(back, self.s)
            self.assertEqual(back.report, self.s.report)
            np.testing.assert_array_equal(back.contacts.vectors, self.s.contacts.vectors)
            np.testing.assert_array_equal(back.contacts.gaps, self.s.contacts.gaps)
            for name in self.s.history.dtype.names:
                np.testing.assert_array_equal(back.history[name], self.s.history[name])
            self.assertEqual([c["verb"] for c in back.calls], ["compress", "crunch"])
            self.assertEqual(back.calls[0]["options"]["growth_rate"], 0.05)
            self.assertEqual((back.seed, back.box), (5, 1.0))
            back.save(self.path.with_name("again.h5"))
            same_bits(jam.load(self.path.with_name("again.h5")), self.s)

    def test_h5md_layout(self):
        with h5py.File(self.path, "r") as f:
            spheres = f["particles/spheres"]
            np.testing.assert_array_equal(f["h5md"].attrs["version"], [1, 1])
            np.testing.assert_array_equal(spheres["position/value"][0], self.s.positions)
            np.testing.assert_array_equal(spheres["box/edges/value"][0], np.eye(3))
            self.assertEqual(list(spheres["box"].attrs["boundary"]), ["periodic"] * 3)
            self.assertEqual(spheres["position/step"], spheres["box/edges/step"])  # one hard link
            build = f["jam"].attrs
            self.assertEqual((build["version"], build["commit"]), (jam.__version__, jam.raw.jam_commit()))
            self.assertRegex(build["library"], "^[0-9a-f]{16}$")
            for key in ("compiler", "blas_kernel", "machine", "written"):
                self.assertIn(key, build)

    def test_a_packing_without_network(self):
        s = jam.System.random(n=20, dim=2, seed=1)
        s.save(self.path.with_name("start.h5"))
        back = jam.load(self.path.with_name("start.h5"))
        np.testing.assert_array_equal(back.positions, s.positions)
        with self.assertRaises(RuntimeError):
            back.report
