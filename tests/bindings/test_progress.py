"""What progress=True shows: a bar of tqdm on terminals and in notebooks, a plain line without tqdm, nothing elsewhere."""
import io
import sys
import types
import unittest
import unittest.mock

import jam


class Terminal(io.StringIO):
    def isatty(self):
        return True


class Bar:
    """Takes the calls that tqdm would get; refuses what tqdm does not have."""

    made = []

    def __init__(self, *, total, bar_format, leave):
        self.total, self.bar_format, self.n, self.seen, self.texts, self.closed = total, bar_format, 0.0, [], [], False
        Bar.made.append(self)

    def set_description_str(self, desc=None, refresh=True):
        self.texts.append(desc)

    def refresh(self):
        assert not self.closed, "a closed bar is drawn"
        self.seen.append(self.n)

    def close(self):
        self.closed = True


def modules(tqdm, notebook):
    """sys.modules as they are where tqdm is, or is not, installed, and in, or outside of, a notebook's kernel."""
    made = {"tqdm": None, "tqdm.auto": None}
    if tqdm:
        made = {"tqdm": types.ModuleType("tqdm"), "tqdm.auto": types.ModuleType("tqdm.auto")}
        made["tqdm.auto"].tqdm = Bar
    made["IPython"] = types.ModuleType("IPython")
    shell = type("ZMQInteractiveShell" if notebook else "TerminalInteractiveShell", (), {})()
    made["IPython"].get_ipython = lambda: shell
    return unittest.mock.patch.dict(sys.modules, made)


def work():
    return jam.System.random(n=60, dim=2, seed=3, diameters=[1.0, 1.4] * 30)


class Showing(unittest.TestCase):
    def shown(self, call, *, tqdm, notebook, terminal):
        """What goes to the standard error, and the bars, while call runs."""
        Bar.made = []
        with modules(tqdm, notebook), unittest.mock.patch(
            "sys.stderr", Terminal() if terminal else io.StringIO()
        ) as stream:
            call()
            return stream.getvalue(), Bar.made

    def test_nothing_without_standard_error(self):
        with unittest.mock.patch("sys.stderr", None):
            self.assertTrue(work().crunch(progress=True).jammed)

    def test_bar_where_tqdm_is(self):
        for notebook, terminal in ((False, True), (True, False)):
            text, bars = self.shown(
                lambda: work().crunch(progress=True), tqdm=True, notebook=notebook, terminal=terminal
            )
            self.assertEqual((text, len(bars)), ("", 1))
            bar = bars[0]
            self.assertTrue(bar.closed and bar.seen)
            self.assertRegex(bar.texts[-1], r"^(crunch|polish) .*phi 0\.\d+ .*step \d+")
            self.assertTrue(all(0 <= n <= bar.total for n in bar.seen))

    def test_bar_follows_growth_and_crunch(self):
        def call():
            s = jam.System.random(n=800, seed=1)
            s.compress(growth_rate=3e-3, pressure=1e3, progress=True)
            s.crunch(progress=True)

        _, bars = self.shown(call, tqdm=True, notebook=True, terminal=False)
        for bar in bars:
            self.assertEqual(bar.seen, sorted(bar.seen))
            self.assertGreater(bar.seen[-1], 0.5)
            self.assertRegex(bar.texts[-1], r"\d+ %(, [\d.e+-]+ s left \([\d.e+-]+ to [\d.e+-]+\))?$")

    def test_each_call_has_its_bar_and_closes_it_when_it_fails(self):
        def stages():
            s = work()
            s.compress(stages=[(0.1, 20), (0.1, 50)], progress=True)
            s.crunch(progress=True)
            with self.assertRaises(jam.JamError):
                s.crunch(max_lps=0, progress=True)
            s.modes(5, progress=True)

        _, bars = self.shown(stages, tqdm=True, notebook=True, terminal=False)
        self.assertGreaterEqual(len(bars), 4)
        self.assertTrue(all(bar.closed for bar in bars))

    def test_plain_line_without_tqdm(self):
        for notebook, terminal in ((False, True), (True, False)):
            text, _ = self.shown(lambda: work().crunch(progress=True), tqdm=False, notebook=notebook, terminal=terminal)
            self.assertRegex(text, r"^\r(crunch|polish) .*phi 0\.\d+.*\n$")

    def test_nothing_into_files_and_pipes(self):
        for tqdm in (False, True):
            text, bars = self.shown(lambda: work().crunch(progress=True), tqdm=tqdm, notebook=False, terminal=False)
            self.assertEqual((text, bars), ("", []))

    def test_wrong_kind(self):
        with self.assertRaises(TypeError):
            work().crunch(progress=3)
