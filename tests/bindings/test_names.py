"""Names that programs import stay where they are, whatever folder their code lies in; those of the header are not listed."""
import importlib
import pickle
import subprocess
import sys
import unittest

import jam

NAMES = {
    "jam": "Advice Contacts JamError Modes Observed Step StatusCode System advise eos errors glass_fit load raw size_report sizes __version__ "
    "cli digits ensemble files near_jamming plot radii scaling statistics store",
    "jam.advice": "Advice advise",
    "jam.cli": "main",
    "jam.digits": "Refined refine",
    "jam.ensemble": "DamagedWarning Ensemble Entry LocalPool ProtocolError Status StoreError WorkerDied begin complete "
    "identity make minimal packing_name protocols table to_json",
    "jam.errors": "ArgumentError BufferError BusyError ClosedError DimensionError FormatError InternalError IoError JamError "
    "MemoryError NonfiniteError NullError OverlapError SolverError StateError StoppedError StoreError StructSizeError "
    "TooFewError UnplaceableError UnsupportedError",
    "jam.files": "Format formats half_bonds read_ase read_gsd write_contacts_csv write_csv write_gaps_csv write_gsd write_spectrum_csv "
    "write_structure_csv write_vtk write_vtk_network",
    "jam.near_jamming": "Estimate ModeWeights Prediction Predictors Runs campaign clone_distance clone_overlap "
    "collapse_exponent correlation_errors correlations decay_curve is_caged median_over_mean mode_weights overlap prediction "
    "predictors propensity reliability run self_scattering take_runs",
    "jam.plot": "COLOURS VIEW cdf convergence density_of_states displacements mode network packing summary trace",
    "jam.radii": "Best Proved Search best_of prove",
    "jam.scaling": "Cdf Collapse Estimate Exponent bootstrap cdf_grid cdf_pooled cdf_ranked collapse crossover "
    "draw_left_power fit_crossover fit_power local_exponent quality tail_exponent tail_scaling TailExponent",
    "jam.statistics": "Estimate YieldPoint bootstrap collapse collapse_estimate deciles roc_area spearman spearman_components "
    "velocity_spectrum",
    "jam.store": "StoreError image load provenance save write_shard",
    "jam.system": "Contacts Modes System",
}


class Names(unittest.TestCase):
    def test_public_names_stay(self):
        for module, names in NAMES.items():
            found = importlib.import_module(module)
            for name in names.split():
                self.assertTrue(hasattr(found, name), f"{module}.{name}")

    def test_dir_lists_what_a_module_is_for(self):
        for module, names in NAMES.items():
            found = importlib.import_module(module)
            shown = dir(found)
            self.assertLessEqual(set(names.split()) - {"__version__"}, set(shown), module)
            for name in set(shown) - set(NAMES["jam"].split()):
                value = getattr(found, name)
                home = getattr(value, "__module__", "jam") or "jam"
                self.assertTrue(home.startswith("jam") and not name.startswith("_"), f"{module}.{name}")
            self.assertFalse({"Any", "np", "annotations", "Array", "os"} & set(shown), module)

    def test_every_module_is_there_without_an_import_of_its_own(self):
        for module in NAMES:
            code = f"import jam; {module}"
            if module not in ("jam.advice", "jam.system"):  # their names are those of jam
                subprocess.run([sys.executable, "-c", code], check=True)

    def test_errors_have_their_public_name(self):
        for name in NAMES["jam.errors"].split():
            found = getattr(jam.errors, name)
            self.assertEqual(f"{found.__module__}.{found.__name__}", f"jam.errors.{name}")
            self.assertIs(type(pickle.loads(pickle.dumps(found("text")))), found)
