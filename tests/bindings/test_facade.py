"""What a Python user sees: documented signatures, types, names, tables and pictures that do not depend on the clock."""
import inspect
import re
import threading
import unittest

import numpy as np

import jam
from packings import crunched_disks, disks


def methods():
    return [(n, f) for n, f in inspect.getmembers(jam.System, inspect.isfunction) if not n.startswith("_")]


class Facade(unittest.TestCase):
    def test_docstrings_speak_python(self):
        for name, method in methods():
            doc = inspect.getdoc(method) or ""
            self.assertTrue(doc, f"{name} has no docstring")
            for word in (r"\bjam_[a-z]", r"JAM_E_", r"@since", r"Threads:", r"\bNULL\b", r"\*rows"):
                self.assertIsNone(re.search(word, doc), f"{name} speaks C: {word}")

    def test_every_parameter_is_named_and_typed(self):
        for name, method in methods():
            doc = inspect.getdoc(method)
            if "Parameters\n----------" not in doc:
                continue
            section = doc.split("Parameters\n----------\n")[1].split("\n\n")[0]
            said = {w for line in re.findall(r"^(\w[\w, ]*) : ", section, re.M) for w in re.split(", ", line)}
            there = {
                p.name
                for p in inspect.signature(method).parameters.values()
                if p.kind not in (p.VAR_KEYWORD, p.VAR_POSITIONAL)
            }
            self.assertLessEqual(said, there, name)
            if "struct" not in name and not name.startswith("_"):
                self.assertLessEqual(there - {"self", "progress"}, said, name)

    def test_signatures_show_the_options(self):
        names = list(inspect.signature(jam.System.crunch).parameters)
        for option in ("method", "strain", "step_tolerance", "wall_time", "threads"):
            self.assertIn(option, names)
        self.assertIn("growth_rate", inspect.signature(jam.System.compress).parameters)
        self.assertIn("{'barrier_path', 'sequential_lp'}", jam.System.crunch.__doc__)

    def test_yes_and_no_are_bools(self):
        report = disks().crunch()
        self.assertIs(report.jammed, True)
        self.assertIs(report.stationary, True)
        s = disks()
        self.assertIs(s.crunch(max_lps=1).jammed, False)

    def test_a_verdict_is_true_for_yes_alone(self):
        s = crunched_disks()
        self.assertTrue(s.rigidity().jammed)
        self.assertFalse(s.rigidity("strict").jammed)
        self.assertFalse(s.report.strictly_jammed)
        s.crunch()
        for open_ in (s.report.strictly_jammed, jam.Verdict.UNDECIDED):
            with self.assertRaisesRegex(ValueError, f"{open_.name} is neither .*compare with Verdict.YES"):
                bool(open_)

    def test_other_words_of_the_field_name_ours(self):
        s = jam.System.random(n=10, dim=2)
        for word, ours in (("phi", "packing_fraction"), ("N", "n"), ("gr", "pair_correlation"), ("bonds", "contacts")):
            with self.assertRaisesRegex(AttributeError, f"{word!r}; did you mean {ours}\\?"):
                getattr(s, word)
            self.assertFalse(hasattr(s, word))
        with self.assertRaisesRegex(TypeError, "did you mean dim"):
            jam.System.random(n=10, d=2)
        with self.assertRaisesRegex(TypeError, "did you mean growth_rate"):
            s.compress(rate=1e-2)
        with self.assertRaisesRegex(TypeError, "jam.sizes"):
            jam.System.random(n=10, polydispersity=0.1)

    def test_the_trace_does_not_depend_on_the_clock(self):
        curves = []
        for _ in range(2):
            s = disks()
            with s.observing(sample_every=2):
                s.compress(growth_rate=1e-2, pressure=200)
            line = jam.plot.trace(s).lines[0]
            curves.append((line.get_xdata(), line.get_ydata()))
        self.assertGreater(len(curves[0][0]), 10)
        np.testing.assert_array_equal(curves[0], curves[1])

    def test_calls_of_one_process_share_threads(self):
        # Debian's OpenBLAS ends a process with more than 128 threads inside it; ten calls ask for 640.
        start = jam.System.random(n=400, seed=1)
        start.compress(packing_fraction=0.6)
        systems = [start.copy() for _ in range(11)]
        systems[0].crunch(threads=2)
        calls = [threading.Thread(target=s.crunch, kwargs={"threads": 64}) for s in systems[1:]]
        for call in calls:
            call.start()
        for call in calls:
            call.join()
        for s in systems[1:]:
            np.testing.assert_array_equal(s.positions, systems[0].positions)
