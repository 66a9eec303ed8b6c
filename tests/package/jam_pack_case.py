"""The program that a test of jam-pack runs, its first argument, and a folder for each case."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

program = sys.argv.pop(1)


def run(*args, seconds=120, **more):
    return subprocess.run([program, *map(str, args)], capture_output=True, text=True, timeout=seconds, check=False, **more)


class InFolder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.dir = pathlib.Path(self.folder.name)

    def tearDown(self):
        left = [p.name for p in self.dir.iterdir() if ".part-" in p.name or p.name.startswith(".jam")]
        self.folder.cleanup()
        self.assertEqual(left, [], "temporary files are left")

    def refuse(self, status, text, *args):
        """Status and text, also in the JSON of --json; nothing else on standard output."""
        done = run(*args, seconds=20, cwd=self.dir)
        self.assertEqual(done.returncode, status, f"{args}: {done.stderr}")
        self.assertIn(text, done.stderr, str(args))
        if "--json" in args:
            said = json.loads(done.stdout)
            self.assertEqual((said["status"], text in said["text"]), (status, True), said)
        else:
            self.assertEqual(done.stdout, "", str(args))

    def report(self, *args, status=0):
        done = run(*args, "--report", "-")
        if status is not None:
            self.assertEqual(done.returncode, status, f"{args}: {done.stderr}")
        return json.loads(done.stdout)
