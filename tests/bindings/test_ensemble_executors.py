"""The same packings from every executor: this machine's pool, the standard library's, MPI, dask.distributed."""
import contextlib
import ctypes
import json
import os
import shutil
import subprocess
import sys
import threading
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np

import jam
from jam.ensemble import Ensemble
from packings import InFolder

SMALL = dict(n=32, dim=3, stages=[{"growth_rate": 0.1, "pressure": 100.0}])
SEEDS = range(1, 6)


@contextlib.contextmanager
def dask_cluster(folder):
    """A scheduler and two workers as processes on the loopback; yields the address."""
    file = Path(folder, "scheduler.json")
    module = [sys.executable, "-m"]
    scheduler = ["distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard"]
    worker = ["distributed.cli.dask_worker", "--nworkers", "1", "--nthreads", "1", "--no-nanny", "--no-dashboard"]
    with open(Path(folder, "dask.txt"), "w", encoding="utf-8") as log, contextlib.ExitStack() as stack:
        for command in (scheduler, worker, worker):
            started = subprocess.Popen(
                module + command + ["--scheduler-file", str(file)], stdout=log, stderr=log, cwd=folder
            )
            stack.callback(started.wait)
            stack.callback(started.kill)
        while not file.exists() or not file.read_text():
            if started.poll() is not None:
                raise RuntimeError(Path(folder, "dask.txt").read_text())
            time.sleep(0.1)
        yield json.loads(file.read_text())["address"]


def hold_the_interpreter(seconds):
    """Sleeps in C without giving the interpreter lock away: what libjam must not do."""
    ctypes.PyDLL(None).usleep(int(seconds * 1e6))
    return seconds


class Executors(InFolder):
    @classmethod
    def setUpClass(cls):
        protocol = jam.ensemble.complete(SMALL)
        cls.expected = {s: jam.ensemble.make(protocol, s)[0] for s in SEEDS}

    def setUp(self):
        super().setUp()
        self.ensemble = Ensemble(self.folder / "e", SMALL)

    def check(self):
        status = self.ensemble.status(SEEDS)
        self.assertEqual(status.done, len(SEEDS), (status, self.ensemble.failures()))
        for entry in self.ensemble:
            if entry.seed not in SEEDS:
                continue
            made, expected = entry.system(), self.expected[entry.seed]
            for name in ("positions", "diameters", "velocities", "forces"):
                np.testing.assert_array_equal(getattr(made, name), getattr(expected, name))

    def test_pools_of_the_standard_library(self):
        with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
            self.ensemble.run(SEEDS[:3], pool, progress=False)
        with ThreadPoolExecutor(2) as pool:
            self.ensemble.run(SEEDS, pool, progress=False)
        self.check()

    def test_a_broken_pool_says_so_and_the_next_goes_on(self):
        with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
            pool.submit(os._exit, 1)
            with self.assertRaisesRegex(Exception, "abruptly"):
                self.ensemble.run(SEEDS, pool, progress=False)
        self.ensemble.run(SEEDS, progress=False, workers=1)
        self.check()

    def test_mpi_with_three_processes(self):
        self.assertIsNotNone(shutil.which("mpiexec"), "openmpi-bin is not installed")
        protocol = self.folder / "p.json"
        protocol.write_text(json.dumps(SMALL))
        mpi = ["mpiexec", "--allow-run-as-root", "--oversubscribe", "-n", "3", sys.executable, "-m", "mpi4py.futures"]
        run = ["-m", "jam", "ensemble", "run", str(self.ensemble.files.path), "--protocol", str(protocol)]
        options = ["--seeds", f"{SEEDS[0]}-{SEEDS[-1]}", "--executor", "mpi"]
        done = subprocess.run(mpi + run + options, capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("5 of 5 packings are there", done.stdout)
        self.check()

    def test_dask_with_two_workers(self):
        from distributed import Client

        with dask_cluster(self.folder) as address, Client(address, set_as_default=False) as client:
            client.wait_for_workers(2)
            status = self.ensemble.run(SEEDS, client.get_executor(), progress=False)
            self.assertEqual(status.done, len(SEEDS), self.ensemble.failures())
            # the command does the same
            command = [sys.executable, "-m", "jam", "ensemble", "run", str(self.ensemble.files.path), "--seeds", "1-6"]
            done = subprocess.run(
                command + ["--executor", "dask", "--scheduler", address], capture_output=True, text=True
            )
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(self.ensemble), 6)
        self.check()

    def test_long_calls_leave_the_interpreter_to_other_threads(self):
        """Or a scheduler of dask, which waits for a sign of its worker, would take it for dead."""
        ticks, ended = [], threading.Event()

        def tick():
            while not ended.wait(0.01):
                ticks.append(time.monotonic())

        thread = threading.Thread(target=tick)
        thread.start()
        s = jam.System.random(n=1000, dim=3, seed=1)
        for call in (lambda: s.run(1e9, wall_time=0.5), lambda: s.compress(growth_rate=1e-5, wall_time=0.5)):
            before = len(ticks)
            call()
            self.assertGreater(len(ticks) - before, 5)  # 50 on an idle machine
        before = len(ticks)
        hold_the_interpreter(0.5)
        self.assertLess(len(ticks) - before, 3)  # the measure can tell
        ended.set()
        thread.join()
