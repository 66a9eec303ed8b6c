"""Ensembles: protocols, the files of packings, campaigns that are killed, folders that cannot be written."""
import json
import os
import pickle
import random
import resource
import signal
import sqlite3
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import unittest.mock
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import h5py
import numpy as np

import jam
from jam._formats import replacing
from jam.ensemble import Ensemble, LocalPool, ProtocolError, StoreError, WorkerDied

SMALL = dict(n=24, dim=2, diameters={"law": "bidisperse"}, stages=[{"growth_rate": 0.1, "pressure": 100.0}])


def same_bits(a, b):
    """Compares two packings of one seed: state and network, not times."""
    for name in ("positions", "diameters", "velocities", "forces", "coordination"):
        np.testing.assert_array_equal(getattr(a, name), getattr(b, name))
    np.testing.assert_array_equal(a.contacts.pairs, b.contacts.pairs)


class Protocols(unittest.TestCase):
    def test_every_default_is_spelled_out_and_json_keeps_it(self):
        full = jam.ensemble.complete(dict(n=128, dim=3))
        self.assertEqual(json.loads(jam.ensemble.to_json(full)), full)
        self.assertEqual(jam.ensemble.complete(full), full)
        self.assertEqual(full["start"]["packing_fraction"], 0.2)
        self.assertEqual(full["crunch"]["wall_time"], "inf")
        self.assertEqual([s["pressure"] for s in full["stages"]], [500.0, 1e7])
        self.assertEqual(full, jam.ensemble.complete({"start": {"n": 128}}))

    def test_what_no_crunch_made_is_unknown(self):
        with tempfile.TemporaryDirectory() as folder:
            e = Ensemble(folder, dict(SMALL, crunch=None, analysis={}))
            self.assertEqual(e.run([1, 2], progress=False, workers=1).jammed, 0)
            table = e.table()
            for row, entry in zip(table, e):
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
            for wrong in (1.5, -1, 2**64):
                with self.assertRaisesRegex(ProtocolError, "seed"):
                    Ensemble(folder, SMALL).run([wrong], progress=False)

    def test_wrong_entries_are_named(self):
        for wrong, text in (
            (dict(n=10, speed=3), "speed"),
            (dict(n=0), "n = 0"),
            (dict(n=10, start={"n": 10}), "given twice"),
            (dict(n=10, diameters=[1.0, 2.0]), "diameters must be 10"),
            (dict(n=10, diameters={"law": "gauss"}), "gauss"),
            (dict(n=10, lattice="fcc"), "4 m"),
            (dict(n=10, stages=[{"verb": "shake"}]), "shake"),
            (dict(n=10, stages=[{"pressur": 10}]), "pressur"),
            (dict(n=10, crunch={"method": "guess"}), "guess"),
            (dict(n=10, analysis={"colour": {}}), "colour"),
            (dict(n=10, analysis={"gaps": {"h_max": 1.0}}), "stable_only"),
            (dict(n=10, model="flat"), "flat"),
        ):
            with self.assertRaisesRegex(ProtocolError, text):
                jam.ensemble.complete(wrong)

    def test_names_depend_on_protocol_seed_and_version_alone(self):
        a, b = Ensemble("x", SMALL), Ensemble("y", dict(SMALL, n=26))
        self.assertEqual(a.name(1), Ensemble("z", a.protocol).name(1))
        self.assertNotEqual(a.name(1), a.name(2))
        self.assertNotEqual(a.name(1), b.name(1))
        self.assertNotEqual(a.name(1), jam.ensemble.packing_name(a.id, 1, "other version"))

    def test_laws_of_diameters_and_the_lattice(self):
        s = jam.ensemble.begin(
            jam.ensemble.complete(
                dict(n=500, lattice="fcc", packing_fraction=0.7, diameters={"law": "lognormal", "deviation": 0.004})
            ),
            3,
        )
        self.assertAlmostEqual(s.packing_fraction, 0.7, places=12)
        # deviation of 500 draws: standard error 3 %; five of them
        self.assertAlmostEqual(s.diameters.std() / s.diameters.mean(), 0.004, delta=0.0006)
        self.assertGreater(s.bond_order(6, 1.2).min(), 0.57)  # 0.5745 in an FCC crystal


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = Path(cls.folder.name, "a.h5")
        cls.s = jam.System.random(n=40, dim=3, seed=5)
        cls.s.compress(growth_rate=0.05)
        cls.s.crunch()
        cls.s.save(cls.path)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

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

    def test_dynamics_go_on_to_the_same_bits(self):
        a, b = jam.load(self.path), self.s.copy()
        for s in (a, b):
            s.scale_diameters(0.99)
            s.run(5.0)
        np.testing.assert_array_equal(a.positions, b.positions)
        with self.assertRaises(RuntimeError):
            a.forces  # a system that moved has no network

    def test_a_loaded_system_has_its_network(self):
        back = jam.load(self.path)
        np.testing.assert_array_equal(back.modes(3).values, self.s.modes(3).values)
        back.contacts_from_geometry()
        np.testing.assert_allclose(back.modes(3).values, self.s.modes(3).values, rtol=1e-6)
        # forces from positions alone are good to the rounding of positions over the smallest singular value
        np.testing.assert_allclose(back.forces, self.s.forces, atol=1e-8)

    def test_h5md_layout(self):
        with h5py.File(self.path, "r") as f:
            spheres = f["particles/spheres"]
            np.testing.assert_array_equal(f["h5md"].attrs["version"], [1, 1])
            np.testing.assert_array_equal(spheres["position/value"][0], self.s.positions)
            np.testing.assert_array_equal(spheres["box/edges/value"][0], np.eye(3))
            self.assertEqual(list(spheres["box"].attrs["boundary"]), ["periodic"] * 3)
            self.assertEqual(spheres["position/step"], spheres["box/edges/step"])  # one hard link
            self.assertEqual(f["jam"].attrs["version"], jam.__version__)
            for key in ("compiler", "blas_kernel", "machine", "written"):
                self.assertIn(key, f["jam"].attrs)

    def test_mari_kurchan_shifts_come_back(self):
        s = jam.System.random(n=30, dim=3, seed=2, model="mk", packing_fraction=1.0)
        s.compress(growth_rate=0.1, pressure=1e3)
        s.crunch()
        s.save(self.path.with_name("mk.h5"))
        back = jam.load(self.path.with_name("mk.h5"))
        same_bits(back, s)
        np.testing.assert_array_equal(back.gaps(1.0, 0).gap, s.gaps(1.0, 0).gap)  # contacts are left out
        for one in (back, s):
            one.scale_diameters(0.9)
        np.testing.assert_array_equal(back.gaps(1.0, 0).gap, s.gaps(1.0, 0).gap)

    def test_a_packing_without_network(self):
        s = jam.System.random(n=20, dim=2, seed=1)
        s.save(self.path.with_name("start.h5"))
        back = jam.load(self.path.with_name("start.h5"))
        np.testing.assert_array_equal(back.positions, s.positions)
        with self.assertRaises(RuntimeError):
            back.report

    def test_other_files_are_refused_with_a_reason(self):
        text = self.path.with_name("text.h5")
        text.write_text("no HDF5")
        with h5py.File(self.path.with_name("other.h5"), "w") as f:
            f["x"] = 1
        cut = self.path.with_name("cut.h5")
        cut.write_bytes(self.path.read_bytes()[:5000])
        for name in ("text.h5", "other.h5", "missing.h5", "cut.h5"):
            with self.assertRaisesRegex(StoreError, name):
                jam.load(self.path.with_name(name))


class Campaigns(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.folder = Path(self.holder.name, "e")

    def tearDown(self):
        self.holder.cleanup()

    def test_run_goes_on_where_it_was_and_gives_the_bits_of_one_system(self):
        e = Ensemble(self.folder, SMALL)
        self.assertEqual(str(e.run(range(1, 4), progress=False, workers=2)).split(",")[0], "3 of 3 packings are there")
        before = {x.seed: x.path.stat().st_mtime_ns for x in e}
        status = Ensemble(self.folder).run(range(1, 6), progress=False, workers=2)  # the folder knows its protocol
        self.assertEqual((status.asked, status.done, status.missing), (5, 5, 0))
        self.assertEqual({x.seed: x.path.stat().st_mtime_ns for x in e if x.seed < 4}, before)
        for entry in e:
            alone, results = jam.ensemble.make(e.protocol, entry.seed)
            same_bits(entry.system(), alone)
            np.testing.assert_array_equal(entry.gaps, results["gaps"].gap)
            np.testing.assert_array_equal(entry.forces, alone.forces)
            self.assertEqual(entry.row["packing_fraction"], alone.report.packing_fraction)
        table = e.table(pandas=True)
        self.assertEqual(list(table.seed), [1, 2, 3, 4, 5])
        forces = list(e.each("forces"))
        self.assertEqual(sum(map(len, forces)), int(table.contacts.sum()))

    def test_the_index_is_never_trusted(self):
        e = Ensemble(self.folder, SMALL)
        e.run([1, 2, 3], progress=False, workers=1)
        rows = e.table()
        index = self.folder / "index.sqlite"
        index.unlink()
        np.testing.assert_array_equal(e.table(), rows)
        self.assertTrue(index.exists())
        index.write_bytes(b"this is no database" * 100)
        np.testing.assert_array_equal(e.table(), rows)
        next(iter(e)).path.unlink()  # a file that is gone is gone from the table
        np.testing.assert_array_equal(e.table(), rows[1:])

    def test_failures_are_files_and_are_tried_again_on_request(self):
        wrong = dict(n=40, dim=3, packing_fraction=0.7)  # no random start is so dense
        e = Ensemble(self.folder, wrong)
        status = e.run([1, 2], progress=False, workers=1)
        self.assertEqual((status.done, status.failed, status.missing), (0, 2, 0))
        first = e.failures()
        self.assertEqual([f["seed"] for f in first], [1, 2])
        self.assertEqual(first[0]["status"], "e_unplaceable")
        self.assertIn("packing", first[0]["text"])
        e.run([1, 2], progress=False, workers=1)
        self.assertEqual(e.failures(), first)
        e.run([1], progress=False, workers=1, retry=True)
        self.assertGreater(e.failures()[0]["time"], first[0]["time"])

    def test_two_protocols_share_a_folder(self):
        a, b = Ensemble(self.folder, SMALL), Ensemble(self.folder, dict(SMALL, n=30))
        a.run([1, 2], progress=False, workers=1)
        b.run([1], progress=False, workers=1)
        self.assertEqual((len(a), len(b)), (2, 1))
        with self.assertRaisesRegex(ProtocolError, f"2 protocols .*{a.id}"):
            Ensemble(self.folder)
        for one in (a, b):
            for name in (one.id, one.id[:8]):
                again = Ensemble(self.folder, name)
                self.assertEqual((again.id, again.protocol), (one.id, one.protocol))
        with self.assertRaisesRegex(ProtocolError, "0 of them begin with 'xyz'"):
            Ensemble(self.folder, "xyz")
        self.assertEqual(jam.ensemble.protocols(self.folder), {a.id: a.protocol, b.id: b.protocol})
        table = jam.ensemble.table(self.folder, pandas=True)
        self.assertEqual(sorted(zip(table.protocol, table.seed)), sorted([(a.id, 1), (a.id, 2), (b.id, 1)]))

    def test_a_damaged_file_is_named_and_left_out(self):
        e = Ensemble(self.folder, SMALL)
        e.run([1, 2, 3], progress=False, workers=1)
        victim = e.files.packing(e.name(2))
        good = victim.read_bytes()
        flipped = bytearray(good)
        flipped[good.index(jam.load(victim).forces.tobytes())] ^= 1
        for damage in (good[:5000], bytes(flipped), b"", good + b"x"):
            victim.write_bytes(damage)
            with self.assertWarnsRegex(jam.ensemble.DamagedWarning, str(victim)):
                self.assertEqual(list(e.table()["seed"]), [1, 3])
            self.assertEqual(list(e.damaged()), [victim])
            status = e.run([1, 2, 3], progress=False, workers=1)  # goes on, and says so
            self.assertEqual((status.asked, status.done, status.missing, len(status.damaged)), (3, 2, 0, 1))
            self.assertIn(str(victim), str(status))
            self.assertEqual(victim.read_bytes(), damage)
            with self.assertWarns(jam.ensemble.DamagedWarning):
                self.assertEqual(len(list(e.each("forces"))), 2)
            with self.assertWarns(jam.ensemble.DamagedWarning):
                shards = e.export(self.folder / "out")
            with h5py.File(shards[0], "r") as shard:
                self.assertEqual(set(shard), {e.name(1), e.name(3), "seal"})
        self.assertEqual(e.status([1]).damaged, ())
        status = e.run([1, 2, 3], progress=False, workers=1, remake_damaged=True)
        self.assertEqual((status.done, status.damaged), (3, ()))
        same_bits(jam.load(victim), jam.ensemble.make(e.protocol, 2)[0])

    def test_damage_after_the_table_was_made_is_found_when_it_is_read(self):
        e = Ensemble(self.folder, SMALL)
        e.run([1, 2], progress=False, workers=1)
        victim = e.files.packing(e.name(2))
        stat = victim.stat()
        data = bytearray(victim.read_bytes())
        data[len(data) // 2] ^= 1
        victim.write_bytes(data)
        os.utime(victim, ns=(stat.st_atime_ns, stat.st_mtime_ns))  # as a disk loses a bit
        with self.assertWarnsRegex(jam.ensemble.DamagedWarning, str(victim)):
            self.assertEqual(len(list(e.each("forces"))), 1)

    def test_damaged_rows_records_and_protocols(self):
        e = Ensemble(self.folder, SMALL)
        e.run([1, 2], progress=False, workers=1)
        rows = e.table()
        base = sqlite3.connect(self.folder / "index.sqlite")
        with base:
            for name, row in base.execute("SELECT name, row FROM rows").fetchall():
                changed = bytearray(row)
                changed[130] ^= 64
                base.execute("UPDATE rows SET row = ? WHERE name = ?", (bytes(changed), name))
        base.close()
        np.testing.assert_array_equal(e.table(), rows)
        e.files.failure(e.name(5)).write_text('{"seed": 5')
        self.assertEqual(e.status([1, 5]).failed, 1)
        record = e.failures()[0]
        self.assertEqual((record["seed"], record["status"]), (-1, "damaged_record"))
        self.assertIn(str(e.files.failure(e.name(5))), record["text"])
        kept = self.folder / "protocols" / f"{e.id}.json"
        for text in (kept.read_text().replace('"n": 24', '"n": 25'), "{", "[]"):
            kept.write_text(text)
            with self.assertRaisesRegex(StoreError, kept.name):
                Ensemble(self.folder)

    def test_two_builds_in_a_folder_are_told_apart(self):
        e = Ensemble(self.folder, SMALL)
        e.run([1], ThreadPoolExecutor(1), progress=False)
        self.assertNotIn("builds", str(e.status()))
        other = dict(jam.store.provenance(), commit="0123456789ab", library="f" * 16)
        with unittest.mock.patch("jam._formats.write_packing.provenance", lambda: other):
            status = e.run([1, 2], ThreadPoolExecutor(1), progress=False)
        self.assertIn("made by 2 builds", str(status))
        self.assertIn("commit 0123456789ab library ffffffffffffffff", str(status))
        self.assertEqual(e.table()["commit"][1], b"0123456789ab")
        self.assertEqual(e.table()["commit"][0].decode(), jam.raw.jam_commit())

    def test_a_file_under_way_stays_whoever_asks(self):
        """A writer of another container may have a process number that lives nowhere here, and the same host name."""
        e = Ensemble(self.folder, SMALL)
        e.files.prepare()
        other = f"import jam; jam.ensemble.Ensemble({str(self.folder)!r}, {SMALL!r}).files.prepare()"
        with replacing.replacing(self.folder / "packings/00/x.h5", parts=e.files.parts) as file:
            file.write(b"under way")
            subprocess.run([sys.executable, "-c", other], check=True)
            self.assertEqual(len(list(e.files.parts.iterdir())), 1)
            hidden = subprocess.run(  # the same host name, process numbers of its own
                ["unshare", "--user", "--map-root-user", "--pid", "--fork", sys.executable, "-c", other],
                capture_output=True,
            )
            if hidden.returncode:
                print("no container could be made:", hidden.stderr.decode()[-200:], file=sys.stderr)
        self.assertEqual((self.folder / "packings/00/x.h5").read_bytes(), b"under way")
        self.assertEqual(list(e.files.parts.iterdir()), [])

    def test_shards(self):
        e = Ensemble(self.folder, SMALL)
        e.run([1, 2, 3], progress=False, workers=1)
        shards = e.export(self.folder / "out", per_shard=2)
        self.assertEqual(len(shards), 2)
        same_bits(jam.load(shards[1], e.name(3)), jam.ensemble.make(e.protocol, 3)[0])
        with self.assertRaisesRegex(StoreError, "shard of 2 packings"):
            jam.load(shards[0])

    def test_killed_workers_lose_no_finished_packing(self):
        """The long form, with 1000 kills, is tests/bench/ensemble_store.py."""
        e, kills, seen, seeds = Ensemble(self.folder, SMALL), [0], {}, 0
        with LocalPool(3) as pool:
            ended = threading.Event()

            def kill():
                while kills[0] < 12 and not ended.wait(random.uniform(0.02, 0.6)):
                    for found in e.files.scan()[0].items():
                        seen.setdefault(*found)
                    if pids := pool.pids:
                        os.kill(random.choice(pids), signal.SIGKILL)
                        kills[0] += 1

            thread = threading.Thread(target=kill)
            thread.start()
            while not kills[0]:  # a fast machine may end the first thirty before the first kill
                seeds += 30
                e.run(range(seeds), pool, progress=False)
            ended.set()
            thread.join()
            status = e.run(range(seeds), pool, progress=False, retry=True)  # what lost three workers
        self.assertEqual((status.done, status.failed), (seeds, 0))
        there = e.files.scan()[0]
        self.assertEqual({k: there[k] for k in seen}, seen)  # finished files were neither lost nor written again
        for entry in e:
            self.assertGreater(len(entry.system().forces), 0)
        self.assertEqual(list(e.files.parts.iterdir()), [])

    def test_a_killed_campaign_leaves_no_worker_and_goes_on(self):
        e = Ensemble(self.folder, SMALL)
        code = f"import jam; jam.ensemble.Ensemble({str(self.folder)!r}, {SMALL!r}).run(range(1, 500), workers=2)"
        campaign = subprocess.Popen([sys.executable, "-c", code])
        deadline = time.monotonic() + 60.0
        while len(e.files.scan()[0]) < 3 and time.monotonic() < deadline:
            time.sleep(0.05)
        children = Path(f"/proc/{campaign.pid}/task").glob("*/children")
        workers = [int(p) for c in children for p in c.read_text().split()]
        campaign.kill()
        campaign.wait()
        self.assertEqual(len(workers), 2)
        while any(os.path.exists(f"/proc/{p}") for p in workers) and time.monotonic() < deadline:
            time.sleep(0.05)
        self.assertFalse(any(os.path.exists(f"/proc/{p}") for p in workers))
        done = len(e)
        self.assertGreaterEqual(done, 3)
        e.run(range(1, 5), progress=False, workers=2)
        self.assertGreaterEqual(len(e), done)
        self.assertEqual(e.status(range(1, 5)).missing, 0)

    def test_eight_campaigns_write_one_folder(self):
        code = f"import jam; jam.ensemble.Ensemble({str(self.folder)!r}, {SMALL!r}).run(range(12), workers=1, progress=False)"
        campaigns = [subprocess.Popen([sys.executable, "-c", code]) for _ in range(8)]
        self.assertEqual([c.wait(timeout=120) for c in campaigns], [0] * 8)
        e = Ensemble(self.folder, SMALL)
        self.assertEqual(e.status(range(12)).done, 12)
        for entry in e:
            same_bits(entry.system(), jam.ensemble.make(e.protocol, entry.seed)[0])

    def test_folders_that_cannot_be_written(self):
        with self.assertRaisesRegex(StoreError, "/sys/jam-packings.*cannot be written"):
            Ensemble("/sys/jam-packings", SMALL).run([1], progress=False)
        e = Ensemble(self.folder, SMALL)
        e.run([1], progress=False, workers=1)
        # A disk that is full shows itself as a write that fails: here a limit on the size of a file does.
        code = (
            "import jam, resource, signal, sys\n"
            "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
            f"e = jam.ensemble.Ensemble({str(self.folder)!r})\n"
            "e.files.prepare()\n"
            "resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))\n"
            "try: e.run([1, 2, 3], progress=False, workers=2)\n"
            "except jam.ensemble.StoreError as error: sys.exit(str(error))\n"
        )
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "cannot be written.*File too large.*Nothing that was finished is lost")
        self.assertEqual(len(e), 1)
        self.assertEqual(list(e.files.parts.iterdir()), [])
        self.assertEqual(resource.getrlimit(resource.RLIMIT_FSIZE)[0], resource.RLIM_INFINITY)

    def test_a_campaign_that_fails_leaves_no_unfinished_file(self):
        e = Ensemble(self.folder, SMALL)

        class KilledWhileItWrote(LocalPool):
            def submit(self, *_):
                (e.files.parts / f".jam-{'0' * 16}-{'1' * 32}.part").touch()
                raise StoreError("the disk is full")

        with unittest.mock.patch("jam.ensemble.ensemble.LocalPool", KilledWhileItWrote):
            with self.assertRaisesRegex(StoreError, "the disk is full"):
                e.run([1], progress=False)
        self.assertEqual(list(e.files.parts.iterdir()), [])


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
