"""The worker processes of ensembles, and the command line."""
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from jam.ensemble import Ensemble, LocalPool, StoreError, WorkerDied
from packings import SMALL, InFolder


class Pool(unittest.TestCase):
    def test_answers_errors_and_dead_workers(self):
        with LocalPool(2) as pool:
            self.assertEqual(list(pool.map(abs, [-1, 2, -3])), [1, 2, 3])
            with self.assertRaises(ZeroDivisionError):
                pool.submit(divmod, 1, 0).result()
            with self.assertRaisesRegex(WorkerDied, "exit status 7"):
                pool.submit(os._exit, 7).result()
            self.assertEqual(pool.submit(abs, -5).result(), 5)
        with self.assertRaises(RuntimeError):
            pool.submit(abs, 1)

    def test_what_pickle_cannot_restore_is_an_error_of_its_call(self):
        """The text of such an exception arrives, and the worker takes the next call."""
        with tempfile.TemporaryDirectory() as folder, LocalPool(1) as pool:
            Path(folder, "odd.py").write_text(
                "class Two(Exception):\n def __init__(self, a, b): super().__init__(f'{a} of {b}')\n"
                "class Local(Exception):\n def __reduce__(self): raise TypeError('no pickle')\n"
                "class Answer:\n def __reduce__(self): return int, ('x',)\n"
                "def two(): raise Two(3, 'seven')\n"
                "def local(): raise Local('a lock')\n"
            )
            sys.path.append(folder)
            self.addCleanup(sys.path.remove, folder)
            import odd

            self.assertEqual(pool.submit(abs, -1).result(), 1)
            worker = pool.pids
            for fn, text in ((odd.two, "Two: 3 of seven"), (odd.local, "Local: a lock"), (odd.Answer, "invalid literal for int")):
                self.assertRegex(f"{type(error := pool.submit(fn).exception()).__name__}: {error}", f"RuntimeError.*{text}")
            self.assertEqual((pool.submit(abs, -2).result(), pool.pids), (2, worker))

    def test_shutdown_kills_what_runs(self):
        pool = LocalPool(1)
        running = pool.submit(time.sleep, 100.0)
        waiting = pool.submit(time.sleep, 100.0)
        while not running.running():
            time.sleep(0.01)
        pool.shutdown(cancel_futures=True)
        self.assertTrue(waiting.cancelled())
        self.assertIsInstance(running.exception(), WorkerDied)


class Imports(InFolder):
    """A program runs in a folder that anybody may write to, with files there that have names of modules."""

    def setUp(self):
        super().setUp()
        self.home, self.current = self.folder / "home", self.folder / "current"
        self.home.mkdir(), self.current.mkdir()
        for name in ("queue", "json", "numpy", "h5py", "tqdm", "signal"):
            (self.current / f"{name}.py").write_text("open('RAN', 'w').close()")

    def run_there(self, *words):
        return subprocess.run(words, cwd=self.current, capture_output=True, text=True)

    def test_workers_import_nothing_from_the_current_folder(self):
        script = self.home / "script.py"
        script.write_text(
            "import jam, mine\n"
            f"e = jam.ensemble.Ensemble('E', {SMALL!r})\n"
            "print(e.run([1, 2], workers=1, progress=False))\n"
            "with jam.ensemble.LocalPool(1) as pool: print(pool.submit(mine.double, 21).result())\n"
        )
        (self.home / "mine.py").write_text("def double(x): return 2 * x\n")
        done = self.run_there(sys.executable, str(script))
        self.assertEqual(done.stderr, "")
        first, second = done.stdout.splitlines()
        self.assertRegex(first, "^2 of 2 packings are there")
        self.assertEqual(second, "42")  # of a module beside the script, as the caller imports it
        self.assertFalse((self.current / "RAN").exists())

    @unittest.skipUnless(os.environ.get("JAM_PACK"), "JAM_PACK is not set: the program jam-pack is not there")
    def test_the_program_imports_nothing_from_the_current_folder(self):
        done = self.run_there(os.environ["JAM_PACK"], "ensemble", "run", "E", "--n", "16", "--dim", "2", "--seeds", "1", "--quiet")
        self.assertFalse((self.current / "RAN").exists())
        if "needs python3" not in done.stderr:  # the first python3 may have no numpy
            self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_a_callable_that_no_worker_finds_is_an_error_of_its_call(self):
        code = "import jam\ndef f(): pass\nwith jam.ensemble.LocalPool(1) as pool:\n print(pool.submit(f).exception(), pool.submit(abs, -1).result())"
        done = self.run_there(sys.executable, "-c", "import sys; sys.path[:] = filter(None, sys.path)\n" + code)
        self.assertRegex(done.stdout, "'f'.* 1$")


class Command(unittest.TestCase):
    def run_jam(self, *arguments):
        command = [sys.executable, "-m", "jam", "ensemble", *arguments]
        return subprocess.run(command, capture_output=True, text=True)

    def test_what_cannot_be_printed_is_told(self):
        """Of all command lines, into a full device and a closed descriptor, whether Python writes each line by itself or not."""
        with tempfile.TemporaryDirectory() as folder:
            make = self.run_jam("run", folder + "/e", "--n", "8", "--dim", "2", "--seeds", "1", "--quiet")
            self.assertEqual((make.returncode, make.stdout, make.stderr), (0, "", ""))
            start = "1\nLattice=\"1 0 0 0 1 0 0 0 1\" Properties=pos:R:3:radius:R:1\n0.5 0.5 0.5 0.2\n"
            Path(folder, "p.xyz").write_text(start)
            for words in ("--version", "info p.xyz", "check p.xyz", "--n 8 --no-md --no-crunch", "ensemble --help", "ensemble status e",
                          "ensemble status e --json", "ensemble run e --seeds 1", "ensemble export e s", "search --help",
                          "search d --n 1 --walls xy --starts 1 --workers 1"):
                for place in ("> /dev/full", ">&-") if "help" in words else (">&-",):
                    for buffered in ("", "1") if "help" in words else ("",):
                        command, more = f"{sys.executable} -m jam {words} {place}", {**os.environ, "PYTHONUNBUFFERED": buffered}
                        done = subprocess.run(["sh", "-c", command], capture_output=True, text=True, cwd=folder, env=more)
                        self.assertEqual(done.returncode, 4, f"{command}: {done.stderr}")
                        self.assertRegex(done.stderr, "^(.*\n)*.*: cannot write standard output.*\n$", command)
                        self.assertNotIn("Traceback", done.stderr, command)

    def test_closed_descriptors_take_no_file_and_no_message(self):
        """Without standard error, print writes its messages to standard output; a worker had none to begin with."""
        with tempfile.TemporaryDirectory() as folder:
            words = f"{sys.executable} -m jam ensemble run {{}} --n 8 --dim 2 --seeds 1 --workers 1 "
            for k, closed in enumerate(("2>&-", "<&- 2>&-", "<&- >&- 2>&-")):
                done = subprocess.run(["sh", "-c", words.format(f"{folder}/{k}") + closed], capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stderr), (4 if ">&- 2" in closed else 0, ""), closed)
                self.assertEqual([x.seed for x in Ensemble(f"{folder}/{k}")], [1], closed)
            refused = subprocess.run(["sh", "-c", words.format("/sys/jam") + "2>&-"], capture_output=True, text=True)
            self.assertEqual((refused.returncode, refused.stdout), (4, ""))

    def test_ctrl_c_while_the_program_imports_is_one_line(self):
        """Of python3 -m jam and of jam-pack; a program that imports the package has its own Ctrl-C."""
        signal.signal(signal.SIGINT, signal.default_int_handler)  # a background job starts with it ignored
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "numpy").mkdir()
            Path(folder, "numpy/__init__.py").write_text("import os, time\nos.kill(os.getpid(), 2)\ntime.sleep(60)\n")
            environment = {**os.environ, "PYTHONPATH": f"{folder}:{os.environ.get('PYTHONPATH', '')}"}
            programs = [f"{sys.executable} -m jam info x", f"{sys.executable} -m jam ensemble status e"]
            if os.environ.get("JAM_PACK"):
                programs.append(f"PATH={os.path.dirname(sys.executable)}:$PATH {os.environ['JAM_PACK']} ensemble status e")
            for program in programs:
                done = subprocess.run(["sh", "-c", program + "; echo $?"], capture_output=True, text=True, env=environment, timeout=60)
                self.assertEqual((done.stdout, done.stderr), ("130\n", "python3 -m jam: interrupted\n"), program)
            done = subprocess.run([sys.executable, "-c", "import jam"], capture_output=True, text=True, env=environment, timeout=60)
            self.assertRegex(done.stderr, "(?s)^Traceback.*KeyboardInterrupt\n$")

    def test_run_status_export_and_exit_codes(self):
        with tempfile.TemporaryDirectory() as folder:
            protocol, e = Path(folder, "p.json"), str(Path(folder, "e"))
            protocol.write_text(json.dumps(SMALL))
            ran = self.run_jam(
                "run", e, "--protocol", str(protocol), "--seeds", "1-4", "--part", "1/2", "--workers", "1"
            )
            self.assertEqual((ran.returncode, ran.stderr), (0, ""))
            self.assertIn("2 of 2 packings", ran.stdout)
            status = self.run_jam("status", e, "--seeds", "1-4", "--json")
            self.assertEqual(status.returncode, 1)
            found = json.loads(status.stdout)
            self.assertEqual((found["asked"], found["done"], found["missing"]), (4, 2, 2))
            self.assertEqual([x.seed for x in Ensemble(e)], [2, 4])
            self.assertEqual(self.run_jam("export", e, str(Path(folder, "out"))).returncode, 0)
            for target, what in ((protocol, "File exists"), (protocol / "out", "Not a directory"), (Path("/sys/jam"), "")):
                with self.assertRaisesRegex(StoreError, f"^.Errno.*{target} cannot be written: {what}"):
                    Ensemble(e).export(target)
                refused = self.run_jam("export", e, str(target))
                self.assertEqual(refused.returncode, 4, refused.stderr)
            self.assertEqual(self.run_jam("run", e, "--seeds", "x").returncode, 2)
            self.assertEqual(self.run_jam("run", e, "--n", "-3", "--seeds", "1").returncode, 3)
            self.assertEqual(self.run_jam("run", "/sys/jam-packings", "--n", "20", "--seeds", "1").returncode, 4)
