"""Protocols of ensembles, and the files of their packings."""
import json
import pickle
import tempfile
import unittest
import unittest.mock
from pathlib import Path

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
            *(
                (dict(n=10, dim=2, analysis={name: given}), f"analysis.'{name}'.: .*{text}")
                for name, given, text in (
                    ("modes", {"kk": 3}, "unknown option 'kk'"), ("modes", {"k": -1}, "count is -1"), ("gaps", {"h_max": "0.1x"}, "double"),
                    ("gaps", {"h_max": -1.0}, "h_max is -1"), ("moduli", {"stiffness": "q"}, "stiffness"),
                    ("pair_correlation", {"kind": [0, 1], "a": 0, "b": 1}, "kind must have shape"),
                    ("isoconf", {"instants": [2.0, 1.0]}, "ascending"), ("isoconf", {"instants": [1.0], "runs": -2}, "-2 runs"),
                )
            ),
            *(
                (wrong, f"{where}.* must be .*not ")
                for wrong, where in (
                    ({"stages": 5}, "stages"), ({"stages": None}, "stages"), ([1, 2], "protocol"), ({"analysis": ["gaps"]}, "analysis"),
                    ({"start": 3}, "start"), ({"crunch": True}, "crunch"), ({"analysis": {"gaps": 3}}, r"analysis\['gaps'\]"), (7, "protocol"),
                )
            ),
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
        for right in (
            {"pair_correlation": {"kind": [0, 1] * 5, "a": 0, "b": 1}}, {"isoconf": {"instants": [1e9]}, "isoconf_series": {"block": 0}},
            {"observed_gaps": {}}, {"mk_shifts": {}}, {"modes": {"k": 10**6}},  # of the packing, not of the protocol
        ):
            self.assertEqual(set(jam.ensemble.complete(dict(n=10, dim=2, analysis=right))["analysis"]), set(right))

    def test_an_analysis_that_fails_keeps_the_packing(self):
        protocol = jam.ensemble.complete(dict(SMALL, analysis={"gaps": {}}))
        for error in (ValueError("of numpy"), jam.errors.ArgumentError("of the library")):
            with unittest.mock.patch.object(jam.System, "gaps", side_effect=error):
                system, results = jam.ensemble.make(protocol, 1)
            self.assertEqual((results["gaps"], system.report.jammed), (f"not available: {error}", True))
        for error in (ImportError("no scipy"), jam.errors.MemoryError("the limit"), OSError("disk")):  # of the machine
            with unittest.mock.patch.object(jam.System, "gaps", side_effect=error), self.assertRaises(type(error)):
                jam.ensemble.make(protocol, 1)

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

    def test_rows_of_curves_stand_in_the_protocol(self):
        """A file may change, and each worker would look for it in its own folder."""
        rows, made = [[1.0, 0.0], [2.0, 100.0]], {}
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "s.csv")
            path.write_text("1,0\n2,100\n")
            given = [{"law": "sieve", "curve": curve} for curve in (rows, str(path), path, {1.0: 0.0, 2.0: 100.0}, np.array(rows))]
            for law in [*given, {"law": f"sieve:{path}"}, {"law": f"sieve:share=volume,{path}"}]:
                made[str(law)] = jam.ensemble.complete(dict(n=16, dim=2, diameters=law))
            path.write_text("1,0\n8,100\n")
            other = jam.ensemble.complete(dict(n=16, dim=2, diameters=given[1]))
        for protocol in made.values():
            self.assertEqual(protocol["start"]["diameters"]["curve"], rows)
            diameters = jam.ensemble.begin(json.loads(jam.ensemble.to_json(protocol)), 1).diameters
            self.assertLess(diameters.max() / diameters.min(), 2.0)
        identities = {jam.ensemble.identity(protocol) for protocol in made.values()}
        self.assertEqual(len(identities), 2)  # share=volume is spelled out in one
        self.assertNotIn(jam.ensemble.identity(other), identities)
        text = {"law": "list:1=0.5,1.4=0.5"}
        self.assertEqual(jam.ensemble.complete(dict(n=16, dim=2, diameters=text))["start"]["diameters"], text)
        self.assertEqual(jam.ensemble.identity(jam.ensemble.complete(dict(n=128))), "2c3245921be5")

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
