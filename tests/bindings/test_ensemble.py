"""Ensembles: protocols, the files of packings, campaigns that are killed, folders that cannot be written."""
import os
import random
import resource
import signal
import subprocess
import sys
import threading
import time
import unittest
import unittest.mock
from pathlib import Path

import h5py
import numpy as np

import jam
from jam._formats import replacing
from jam.ensemble import DamagedWarning, Ensemble, LocalPool, ProtocolError, StoreError, folder
from packings import SMALL, InFolder, same_bits


class Campaigns(InFolder):
    def setUp(self):
        super().setUp()
        self.folder /= "e"

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

    def test_jamming_by_shear(self):
        """Spheres that touch nothing are sheared until they jam; a run goes on, and gives the bits of one system."""
        shear = {"verb": "shear", "to": 0.5, "step": 5e-3, "until": "jammed", "resolution": 1e-4, "max_evaluations": 30000}
        start = dict(n=64, dim=2, packing_fraction=0.83, overlap="allow", diameters={"law": "bidisperse"}, crunch=None)
        e = Ensemble(self.folder, dict(start, stages=[{"verb": "relax"}, shear], analysis={"shear_history": {}, "stress": {}}))
        e.run([1], progress=False, workers=1)
        Ensemble(e.files.path).run([1, 2, 3], progress=False, workers=1)
        sheared = 0
        for entry in e:
            same_bits(entry.system(), jam.ensemble.make(e.protocol, entry.seed)[0])
            rows = entry.analysis("shear_history")
            self.assertGreater(rows["pressure"][-1], 0)  # contacts carry force, and before they did not
            self.assertTrue((rows["pressure"][:-1] == 0).all())
            sheared += len(rows["strain"]) > 1
            cell = entry.system().cell
            self.assertAlmostEqual(cell[1, 0] / cell[1, 1], rows["strain"][-1], 12)
        self.assertGreater(sheared, 0)

    def test_the_index_is_never_trusted(self):
        e = Ensemble(self.folder, SMALL)
        e.run([1, 2, 3], progress=False, workers=1)
        rows, index, mine = e.table(), e.files.index, self.folder / "mine"
        good = bytearray(index.read_bytes())
        mine.write_bytes(b"mine")
        for plant in (
            lambda: None,
            lambda: index.write_bytes(b"this is no index" * 100),
            lambda: index.write_bytes(good[:200] + bytes([good[200] ^ 64]) + good[201:]),
            lambda: index.write_bytes(good[:-1]),
            lambda: index.symlink_to(mine),
            lambda: os.mkfifo(index),  # who opens it waits without end
            lambda: index.touch() or os.truncate(index, 1 << 42),  # more than any memory
        ):
            index.unlink(missing_ok=True)
            plant()
            np.testing.assert_array_equal(e.table(), rows)
        self.assertEqual(mine.read_bytes(), b"mine")
        index.unlink()
        e.table()
        with unittest.mock.patch("jam.ensemble.folder.read_packing", wraps=folder.read_packing) as read:
            np.testing.assert_array_equal(e.table(), rows)  # rows of the index, where files are as they were
        self.assertEqual(read.call_count, folder.LOOKED_UP)

        known = folder.read_index(index)  # wrong rows under a right checksum
        forged = rows.copy()
        forged["packing_fraction"] += 0.01
        by_seed = {row["seed"]: row.tobytes() for row in forged}
        folder.write_index(index, {k: by_seed[np.frombuffer(row, rows.dtype)[0]["seed"]] for k, row in known.items()})
        with self.assertWarnsRegex(DamagedWarning, "index.bin has another row"):
            np.testing.assert_array_equal(e.table(), rows)
        self.assertEqual(folder.read_index(index), known)
        next(iter(e)).path.unlink()  # a file that is gone is gone from the table
        np.testing.assert_array_equal(e.table(), rows[1:])

    def test_failures_are_files_and_are_tried_again_on_request(self):
        wrong = dict(n=5000, dim=3, packing_fraction=0.7)  # no random start is so dense; of so many none is tried before
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
        self.assertEqual((status.done, status.made, status.remade, status.damaged), (3, 1, (str(victim),), ()))
        self.assertIn(f"1 made now; made again: {victim}", str(status))
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

    def test_damaged_records_and_protocols(self):
        e = Ensemble(self.folder, SMALL)
        e.run([1, 2], progress=False, workers=1)
        e.files.failure(e.name(5)).write_text('{"seed": 5')
        self.assertEqual(e.status([1, 5]).failed, 1)
        record = e.failures()[0]
        self.assertEqual((record["seed"], record["status"]), (-1, "damaged_record"))
        self.assertIn(str(e.files.failure(e.name(5))), record["text"])
        kept = self.folder / "protocols" / f"{e.id}.json"
        kept.write_text(kept.read_text().replace('"diameters"', '"lattice": null, "diameters"'))  # as older versions wrote it
        self.assertEqual(Ensemble(self.folder).protocol, e.protocol)
        for text in (kept.read_text().replace('"n": 24', '"n": 25'), "{", "[]"):
            kept.write_text(text)
            with self.assertRaisesRegex(StoreError, kept.name):
                Ensemble(self.folder)

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

    def test_killed_workers_lose_no_finished_packing(self):
        e, kills, seen, seeds = Ensemble(self.folder, SMALL), [0], {}, 0
        with LocalPool(3) as pool:
            ended = threading.Event()

            def kill():
                while kills[0] < 12 and not ended.wait(random.uniform(0.02, 0.6)):
                    for path in e.files.found(".h5"):
                        seen.setdefault(path, path.stat().st_mtime_ns)
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
            status = e.run(range(seeds), pool, progress=False, retry=True)  # what lost its worker
        self.assertEqual((status.done, status.failed), (seeds, 0))
        self.assertEqual({path: path.stat().st_mtime_ns for path in seen}, seen)  # finished files were neither lost nor written again
        for entry in e:
            self.assertGreater(len(entry.system().forces), 0)
        self.assertEqual(list(e.files.parts.iterdir()), [])

    def test_a_killed_campaign_leaves_no_worker_and_goes_on(self):
        e = Ensemble(self.folder, SMALL)
        code = f"import jam; jam.ensemble.Ensemble({str(self.folder)!r}, {SMALL!r}).run(range(1, 500), workers=2)"
        campaign = subprocess.Popen([sys.executable, "-c", code])
        deadline = time.monotonic() + 60.0
        while len(list(e.files.found(".h5"))) < 3 and time.monotonic() < deadline:
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

    def test_four_campaigns_write_one_folder(self):
        code = f"import jam; jam.ensemble.Ensemble({str(self.folder)!r}, {SMALL!r}).run(range(12), workers=1, progress=False)"
        campaigns = [subprocess.Popen([sys.executable, "-c", code]) for _ in range(4)]
        self.assertEqual([c.wait(timeout=120) for c in campaigns], [0] * 4)
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
