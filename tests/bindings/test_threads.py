"""Several threads on one system, and callables that C holds: nothing crashes, every answer and file is of one moment."""
import gc
import itertools
import pickle
import sys
import threading
import time
import unittest
import weakref

import numpy as np

import jam
from packings import InFolder

DISKS = [1.0] * 15 + [1.4] * 15


def crunched():
    disks = jam.System.random(n=30, dim=2, seed=1, diameters=DISKS)
    disks.crunch()
    return disks


class Told:
    def __call__(self, *_):
        return False


class Callables(unittest.TestCase):
    def test_a_log_lives_as_long_as_c_holds_it_and_no_longer(self):
        disks, told = crunched(), Told()
        first = weakref.ref(told)
        disks.log(told, "debug")
        del told
        gc.collect()
        self.assertIsNotNone(first())
        told = Told()
        second = weakref.ref(told)
        disks.log(told, "debug")
        self.assertIsNone(first())
        refused = []

        def replace(_):  # the call that runs has the handle alone: C keeps the old one
            try:
                disks.log(Told())
            except jam.errors.BusyError:
                refused.append(True)

        del told
        disks.scale_diameters(0.9)
        disks.crunch(progress=replace)
        self.assertTrue(refused)
        self.assertIsNotNone(second())
        with self.assertRaises(jam.errors.ArgumentError):
            disks.log(Told(), 99)
        self.assertIsNotNone(second())
        disks.log(None)
        self.assertIsNone(second())

    def test_a_second_system_of_a_busy_handle_leaves_the_first_its_progress(self):
        disks, seen = crunched(), []

        def again(p):
            try:
                jam.System(disks.handle)
            except jam.errors.BusyError:
                gc.collect()
                seen.append(p.steps)

        disks.scale_diameters(0.9)
        disks.crunch(progress=again)
        self.assertGreater(len(seen), 1)  # the later ones came by the callable of the first

    def test_ctrl_c_between_two_lines_of_log_leaves_no_dangling_callable(self):
        """A trace function raises at every line of System.log, as Ctrl-C may; then C logs to what it holds."""
        disks = crunched()

        def interrupt(at):
            count = itertools.count()

            def tracer(frame, event, _):
                if frame.f_code is not jam.System.log.__code__:
                    return tracer if event == "call" else None
                if event == "line" and next(count) == at:
                    raise KeyboardInterrupt
                return tracer

            return tracer

        for at in range(4):
            before = sys.gettrace()
            sys.settrace(interrupt(at))
            try:
                disks.log(Told(), "debug")
            except KeyboardInterrupt:
                pass
            finally:
                sys.settrace(before)
            gc.collect()
            held = [Told() for _ in range(100)]  # would lie where a freed one lay
            disks.scale_diameters(0.95)
            disks.crunch()
            del held


class Files(InFolder):
    def test_what_a_progress_callable_saves_is_the_last_step(self):
        for verb, options in (
            ("compress", {}),
            ("crunch", {}),
            ("monte_carlo", dict(sweeps=50000)),
            ("run", dict(collisions_per_particle=1e5)),
        ):
            disks = jam.System.random(n=60, dim=2, seed=1, diameters=DISKS * 2)
            start, saved = disks.positions.copy(), []

            def progress(_):
                if len(saved) < 3:
                    file = self.folder / f"{verb}{len(saved)}.h5"
                    disks.save(file)
                    disks.write_checkpoint(str(file) + ".jam")
                    saved.append(file)
                return len(saved) == 3

            getattr(disks, verb)(progress=progress, **options)
            self.assertTrue(saved, verb)
            for file in saved:
                back, same = jam.load(file), jam.System.from_checkpoint(str(file) + ".jam")
                np.testing.assert_array_equal(back.positions, same.positions)
                np.testing.assert_array_equal(back.diameters, same.diameters)
                np.testing.assert_array_equal(back.velocities, same.velocities)
                self.assertEqual(back.calls[-1]["verb"], verb)
                self.assertEqual((back.calls[-1]["status"], back.calls[-1]["stop_reason"]), ("running", "none"))
            self.assertTrue((jam.load(saved[-1]).positions != start).any(), verb)
            self.assertEqual(len(disks.calls), 1)
            self.assertNotEqual(disks.calls[0]["status"], "running")

    def test_calls_that_failed_or_were_interrupted_are_recorded_as_such(self):
        disks = crunched()
        with self.assertRaises(jam.errors.ArgumentError):
            disks.compress(growth_rate=-1.0)
        self.assertEqual([c["verb"] for c in disks.calls], ["crunch"])

        def interrupt(_):
            raise KeyboardInterrupt

        disks.scale_diameters(0.9)
        with self.assertRaises(KeyboardInterrupt):
            disks.compress(progress=interrupt)
        self.assertEqual([c["status"] for c in disks.calls], ["ok", "cancelled"])


class Stress(InFolder):
    """What several calls of C or a file make up, asked by some threads while another moves the spheres: an answer of one
    moment, or an error that says why not. Each call of C from several threads: tests/capi/thread_calls.c."""

    ALLOWED = (jam.JamError, NotImplementedError, ImportError, ValueError)

    def setUp(self):
        super().setUp()
        before = sys.getswitchinterval()
        self.addCleanup(sys.setswitchinterval, before)
        sys.setswitchinterval(1e-5)

    def calls(self, mine):
        """{name: a call}, whose files have names of their own."""
        file = lambda ending: self.folder / f"{mine}{ending}"
        return {
            **{k: lambda s, k=k: getattr(s, k) for k in ("contacts", "forces", "history", "report", "info", "soft_history", "pressure")},
            **{k: lambda s, k=k: getattr(s, k)() for k in ("copy", "hessian", "to_pandas", "rigidity", "check", "_repr_html_")},
            "call": lambda s: s.call("coordination"),
            "compare": lambda s: s.compare(s.copy()),
            "compress": lambda s: s.compress(growth_rate=0.1, pressure=20.0),
            "gaps": lambda s: s.gaps(0.1, False),
            "log": lambda s: s.log(Told(), "debug"),
            "modes": lambda s: s.modes(3),
            "page": lambda s: s.page(file(".html")),
            "pickle": lambda s: pickle.loads(pickle.dumps(s)),
            "save": lambda s: (s.save(file(".h5")), jam.load(file(".h5"))),
            "scale_diameters": lambda s: s.scale_diameters(0.999),
            "tile": lambda s: s.tile((2, 1)),
            "write": lambda s: s.write(file(".xyz")),
            "write_contacts": lambda s: s.write_contacts(file(".csv")),
        }

    def test_answers_are_of_one_moment(self):
        disks = crunched()
        names = list(self.calls(0))
        end, wrong, answers = time.monotonic() + 6.0, [], dict.fromkeys(names, 0)

        def check(name, answer):
            if name == "contacts":
                self.assertEqual({len(x) for x in (answer.pairs, answer.vectors, answer.gaps, answer.forces)}, {len(answer)})
                np.testing.assert_allclose((answer.vectors**2).sum(1), 1.0, rtol=1e-12)
                out = np.zeros((disks.n, disks.dim))  # forces of one crunch balance
                for k, sign in ((0, 1.0), (1, -1.0)):
                    np.add.at(out, answer.pairs[:, k], sign * answer.forces[:, None] * answer.vectors)
                self.assertLess(abs(out).max(), 1e-6)
            elif name == "forces":
                self.assertFalse(np.isnan(answer).any())
            elif name == "hessian":
                self.assertLess(abs(answer - answer.T).max(), 1e-12)

        def ask(k):
            mine = self.calls(k)
            for name in itertools.islice(itertools.cycle(names), 7 * k, None):
                if time.monotonic() > end or wrong:
                    return
                try:
                    check(name, mine[name](disks))
                    answers[name] += 1
                except self.ALLOWED:
                    pass
                except BaseException as error:
                    wrong.append(f"{name}: {type(error).__name__}: {error}")

        def move():
            while time.monotonic() < end and not wrong:
                for verb in (lambda: disks.scale_diameters(0.98), disks.crunch):
                    try:
                        verb()
                    except jam.JamError:
                        pass
                time.sleep(0.002)

        threads = [threading.Thread(target=ask, args=(k,)) for k in range(3)] + [threading.Thread(target=move)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])
        self.assertGreater(sum(answers.values()), 0)
        disks.log(None)
        disks.crunch()  # nobody is left inside
        self.assertTrue(disks.report.jammed)
