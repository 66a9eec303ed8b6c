"""The worker processes of ensembles, and the command line."""
import json
import os
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import jam
from jam.ensemble import Ensemble, LocalPool, WorkerDied

SMALL = dict(n=24, dim=2, diameters={"law": "bidisperse"}, stages=[{"growth_rate": 0.1, "pressure": 100.0}])


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

    def test_shutdown_kills_what_runs(self):
        pool = LocalPool(1)
        running = pool.submit(time.sleep, 100.0)
        waiting = pool.submit(time.sleep, 100.0)
        while not running.running():
            time.sleep(0.01)
        pool.shutdown(cancel_futures=True)
        self.assertTrue(waiting.cancelled())
        self.assertIsInstance(running.exception(), WorkerDied)


class Command(unittest.TestCase):
    def run_jam(self, *arguments):
        command = [sys.executable, "-m", "jam", "ensemble", *arguments]
        return subprocess.run(command, capture_output=True, text=True)

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
            self.assertEqual(self.run_jam("run", e, "--seeds", "x").returncode, 2)
            self.assertEqual(self.run_jam("run", e, "--n", "-3", "--seeds", "1").returncode, 3)
            self.assertEqual(self.run_jam("run", "/sys/jam-packings", "--n", "20", "--seeds", "1").returncode, 4)


if __name__ == "__main__":
    unittest.main()
