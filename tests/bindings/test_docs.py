"""Examples in the docstrings of the Python package run and give what they show; words that newcomers try are answered."""
import contextlib
import doctest
import importlib.util
import inspect
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import jam

MODULES = ("system", "_system.verbs", "_system.network", "_system.state", "_system.observe", "_system.writing", "_system.converting", "plot.motions", "_api.results", "_api.size_laws", "advice")


def missing_package(function):
    """The first package that a function imports and that is not installed, or None."""
    try:
        source = inspect.getsource(function)
    except (OSError, TypeError):
        return None
    names = re.findall(r"^\s+import (\w+)|^\s+from (\w+)[\w.]* import", source, re.M)
    return next((name for pair in names for name in pair if name and not importlib.util.find_spec(name)), None)


def examples_of(module):
    """The examples of a module's docstrings, but those of functions that need a package which is not installed."""
    for test in doctest.DocTestFinder().find(module):
        function = module
        for part in test.name[len(module.__name__) + 1 :].split("."):
            function = getattr(function, part, function)
        missing = inspect.isfunction(function) and missing_package(function)
        if missing:
            print(f"{test.name}: python3-{missing} is not installed, so its examples are left out")
        else:
            yield test


class Examples(unittest.TestCase):
    def test_docstrings_run(self):
        run, failed = 0, 0
        runner = doctest.DocTestRunner()
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):  # examples write files
            for name in MODULES:
                try:
                    module = importlib.import_module("jam." + name)
                except ModuleNotFoundError as error:
                    print(f"jam.{name}: {error.name} is not installed, so its examples are left out")
                    continue
                for test in examples_of(module):
                    found = runner.run(test)
                    run, failed = run + found.attempted, failed + found.failed
        self.assertEqual(failed, 0)
        self.assertGreater(run, 20)


class Stumbles(unittest.TestCase):
    """Mistakes of newcomers get an answer that names the way out."""

    def test_transposed_positions(self):
        x = np.random.default_rng(1).random((20, 3))
        for given, sizes in ((x.T, 0.01), (x[:5].T, np.full(5, 0.01))):
            with self.assertRaisesRegex(ValueError, "transposed"):
                jam.System.from_arrays(given, sizes)
        jam.System.from_arrays(x.T.copy().T, 0.01)

    def test_radii(self):
        x = [[0.2, 0.2], [0.7, 0.7]]
        np.testing.assert_array_equal(jam.System.from_arrays(x, radii=[0.1, 0.05]).diameters, [0.2, 0.1])
        for sizes in ({}, {"diameters": 0.1, "radii": 0.1}):
            with self.assertRaisesRegex(TypeError, "either diameters or radii"):
                jam.System.from_arrays(x, **sizes)

    def test_names_of_calippso(self):
        s = jam.System.random(n=8, dim=2)
        for theirs, ours in (("l0", "neighbour_radius"), ("max_iters", "max_lps"), ("sbound", "step_bound")):
            with self.assertRaisesRegex(TypeError, ours):
                s.crunch(**{theirs: 1})
        with self.assertRaisesRegex(TypeError, "did you mean gain_tolerance"):
            s.crunch(gain_tolerence=1e-9)

    def test_wrong_values_are_named_with_their_argument(self):
        s = jam.System.random(n=8, dim=2)
        for call, text in (
            (lambda: s.crunch(method="lp"), "method='lp' is none of barrier_path, sequential_lp"),
            (lambda: s.rigidity("weak"), "kind='weak' is none of collective, strict"),
            (lambda: s.write("a.xyz", "x"), "format='x' is none of"),
            (lambda: jam.System.random(n=8, diameters="1:1.4"), "diameters must be numbers, not text .*jam.sizes"),
            (lambda: jam.System.random(n=8, diameters=[1, 1.4]), "diameters has 2 numbers, it must have 1 or n = 8"),
            (lambda: s.compress(stages=[(1e-2)]), r"stages: each must be a pair \(growth_rate, pressure\).*not 0.01"),
            (lambda: s.compress(stages=[(1e-2, 1e3, 3)]), "stages: each must be a pair"),
            (lambda: jam.System.random(n=8, ratio=1.4), "there are diameters, cell, dim"),
            (lambda: jam.System.random(n=8, overlap=0.7), "overlap must be a whole number, not 0.7"),
            (lambda: s.crunch(method=0.9), "method must be a whole number, not 0.9"),
            (lambda: s.rigidity(0.5), "kind must be a whole number, not 0.5"),
            (lambda: s.image(shape=(2.9, 3)), "shape must be a whole number, not 2.9"),
            (lambda: s.isoconf([1.0], keep=[0.5], runs=2), "keep must be a whole number, not 0.5"),
            (lambda: s.pair_correlation(2.0, 20, a=5, b=7), "a=5 and b=7 are kinds of spheres"),
            (lambda: s.run(1).phi_J, "'phi_J'; did you mean packing_fraction"),
            (lambda: s.run(1).colisions, "'colisions'; did you mean collisions"),
        ):
            with self.assertRaisesRegex((TypeError, ValueError, AttributeError), text):
                call()
        self.assertFalse(hasattr(s.run(1), "colour"))
        with tempfile.TemporaryDirectory() as folder:
            name = str(Path(folder, "a.xyz"))
            s.write(name)
            with self.assertRaisesRegex(ValueError, r"no checkpoint of libjam; System.read reads"):
                jam.System.from_checkpoint(name)

    def test_messages_name_python_calls(self):
        s = jam.System.random(n=8, dim=2)
        with self.assertRaisesRegex(jam.errors.StateError, r"call crunch\(\) or contacts_from_geometry\(\) first"):
            s.forces
        with self.assertRaisesRegex(jam.errors.OverlapError, 'overlap="shrink"'):
            jam.System.from_arrays([[0.5, 0.5], [0.55, 0.5]], 0.1)

    def test_shrinking_is_advised_where_it_helps(self):
        apart = jam.System.from_arrays([[0.2, 0.5], [0.7, 0.5]], 0.3)
        soft = jam.System.from_arrays([[0.2, 0.5], [0.3, 0.5]], 0.3, overlap="allow")
        for call in (
            lambda: setattr(apart, "positions", [[0.2, 0.5], [0.3, 0.5]]),
            lambda: apart.scale_diameters(3.0),
            lambda: soft.run(),
            lambda: jam.System.from_arrays([[0.2, 0.5], [0.2, 0.5]], 0.3),
            lambda: jam.System.from_arrays([[0.01, 0.01]], 0.1, container="ball"),
        ):
            with self.assertRaises(jam.errors.OverlapError) as caught:
                call()
            self.assertNotIn("shrink", str(caught.exception))
        for call in (lambda: jam.System.from_arrays([[0.5, 0.5]], 1.3), lambda: jam.System.from_arrays([[0.01, 0.5]], 0.1, walls="x")):
            with self.assertRaisesRegex(jam.errors.OverlapError, 'overlap="shrink"'):
                call()

    def test_short_representations(self):
        s = jam.System.random(n=64, dim=2, diameters=[1.0] * 32 + [1.4] * 32)
        s.crunch()
        for value in (s.gaps(1.0, True), s.density_of_states(moments=32, points=20), s.stress_states()):
            self.assertRegex(repr(value), r"^\w+\(\w+=array\(\d+")
            self.assertLess(len(repr(value)), 200)
        self.assertEqual(s.contacts.table().dtype.names, ("i", "j", "n1", "n2", "gap", "force"))


class AnotherPython(unittest.TestCase):
    def test_a_python_without_numpy_is_told(self):
        words = [sys.executable, "-S", "-c", "import jam"]  # -S: no installed packages
        done = subprocess.run(words, capture_output=True, text=True, env={"PYTHONPATH": str(Path(jam.__file__).parents[1])})
        self.assertEqual(done.returncode, 1)
        self.assertIn(f"ImportError: jam needs numpy, which {sys.executable} does not find", done.stderr)

    def test_the_import_names_the_python_that_it_was_built_for(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(shutil.copytree(Path(jam.__file__).parent, Path(folder, "jam")))
            (module,) = copy.glob("_raw.*.so")
            module.rename(copy / "_raw.cpython-32-none.so")
            done = subprocess.run(
                [sys.executable, "-c", "import jam"], cwd=folder, capture_output=True, text=True, env={"PYTHONPATH": folder}
            )
        self.assertEqual(done.returncode, 1)
        for word in ("ImportError", "_raw.cpython-32-none.so", "-DJAM_PYTHON=" + sys.executable):
            self.assertIn(word, done.stderr)
