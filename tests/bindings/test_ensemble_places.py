"""What counts in an ensemble's folder: packings are known by what stands in their files, each seed counts once, every odd
file is named."""
import json
import os
import shutil
import subprocess
import sys
import unittest
import unittest.mock
import warnings
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

import jam
from jam.ensemble import DamagedWarning, Ensemble
from jam.ensemble import folder as places
from packings import SMALL, InFolder, same_bits

OTHER = dict(SMALL, n=18)


class Case(InFolder):
    def setUp(self):
        super().setUp()
        self.e = Ensemble(self.folder / "e", SMALL)

    def make(self, seeds, e=None, **more):
        """In this process, where tests can patch what is written."""
        with ThreadPoolExecutor(1) as pool:
            return (self.e if e is None else e).run(seeds, pool, progress=False, **more)

    def file(self, seed):
        return self.e.files.packing(self.e.name(seed))

    def written_by(self, **changes):
        """Files that another release writes: a value of None is left out."""
        made = {**jam.store.provenance(), **changes}
        made = {k: v for k, v in made.items() if v is not None}
        return unittest.mock.patch("jam._formats.write_packing.provenance", lambda: made)

    def seeds(self):
        return self.e.table()["seed"].tolist()

    def warned(self, text):
        return self.assertWarnsRegex(DamagedWarning, text)


class Names(Case):
    def test_a_copy_counts_once_and_is_named(self):
        """What a file manager leaves is nothing of the ensemble."""
        self.make([1, 2, 3])
        (self.e.files.packings / ".DS_Store").write_bytes(b"x")
        beside = [self.file(1).with_name("a backup copy.h5"), self.file(1).with_name(self.file(1).stem + " copy.h5")]
        copies = [*beside, self.e.files.packings / "00" / "moved.h5", self.e.files.packings / "one level too high.h5"]
        for copy in copies:
            shutil.copy(self.file(1), copy)
        with self.warned("4 files are omitted: .*holds the packing of seed 1 .*, as .* does, which counts"):
            self.assertEqual(self.seeds(), [1, 2, 3])
        with self.warned("omitted"):
            self.assertEqual(len(list(self.e.each("forces"))), 3)
        status = self.e.status()
        self.assertEqual((status.asked, status.done, status.missing, status.damaged), (3, 3, 0, ()))
        for copy in copies:
            self.assertIn(str(copy), " ".join(status.odd))
        self.assertEqual(set(self.e.damaged()), set(copies))
        self.assertEqual(self.make([1, 2, 3]).made, 0)
        self.file(1).unlink()
        with self.warned("3 files are omitted"):
            self.assertEqual(self.seeds(), [1, 2, 3])

    def test_only_packings_are_counted(self):
        """Of what cannot be read, that under a packing's name is one, unless another file holds it."""
        self.make([1, 2])
        folder = self.file(1).parent
        os.mkfifo(folder / "fifo.h5")
        (folder / "empty.h5").write_bytes(b"")
        (folder / f"{self.file(1).stem}-2.h5").write_bytes(b"x")
        (folder / f"{self.file(1).stem} copy.h5").mkdir()
        status = self.e.status()
        self.assertEqual((status.asked, status.done, status.missing), (2, 2, 0))
        self.assertIn("2 of 2 packings are there", str(status))
        self.assertIn("fifo.h5", " ".join(status.damaged))
        self.file(2).write_bytes(b"x")
        self.assertEqual((self.e.status().asked, self.e.status().done), (2, 1))

    def test_a_renamed_file_is_the_packing_that_it_holds(self):
        self.make([1, 2])
        renamed = self.file(1).rename(self.e.files.packings / "00" / "my best packing.h5")
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # nothing is left out
            self.assertEqual(self.seeds(), [1, 2])
        status = self.make([1, 2])
        self.assertEqual((status.made, status.done), (0, 2))
        self.assertRegex(str(status), f"{renamed} has another name than the packing of seed 1")
        first = next(iter(self.e))
        self.assertEqual(first.path, renamed)
        same_bits(first.system(), jam.ensemble.make(self.e.protocol, 1)[0])

    def test_a_file_under_another_seeds_name_blocks_no_seed_and_is_not_overwritten(self):
        self.make([1, 2])
        data = self.file(1).read_bytes()
        self.file(3).write_bytes(data)
        with self.warned("omitted"):
            self.assertEqual(self.seeds(), [1, 2])
        status = self.make([1, 2, 3])
        self.assertEqual((status.made, status.done, status.missing), (1, 3, 0))
        self.assertIn(str(self.file(3)), str(status))
        self.assertEqual(self.file(3).read_bytes(), data)
        with self.warned("omitted"):
            self.assertEqual(self.seeds(), [1, 2, 3])
        status = self.make([1, 2, 3], search=False)  # looks beside the other packing too
        self.assertEqual((status.made, status.done, status.missing), (0, 3, 0))
        self.file(1).unlink()  # the other one is the packing of seed 1
        self.assertEqual(self.seeds(), [1, 2, 3])
        self.assertEqual(self.make([1, 2, 3]).made, 0)

    def test_a_file_of_another_protocol_under_a_seeds_name(self):
        self.make([1])
        other = Ensemble(self.folder / "f", OTHER)
        self.make([5], other)
        shutil.copy(other.files.packing(other.name(5)), self.file(2))
        self.assertEqual(self.seeds(), [1])
        self.assertRegex(self.e.damaged()[self.file(2)], f"seed 5 of protocol {other.id}")
        self.assertEqual(self.e.status([1, 2]).missing, 1)
        status = self.make([1, 2])
        self.assertEqual((status.made, status.done, status.missing), (1, 2, 0))
        self.assertEqual(self.seeds(), [1, 2])
        table = jam.ensemble.table(self.folder / "e")
        self.assertEqual(sorted(zip(table["protocol"].tolist(), table["seed"].tolist())),
                         sorted([(self.e.id.encode(), 1), (self.e.id.encode(), 2), (other.id.encode(), 5)]))

    def test_look_for_own_names_opens_no_other_file(self):
        self.make(range(1, 9))
        self.e.files.index.unlink()
        opened = []

        def seen(path, *more):
            opened.append(Path(path))
            return real(path, *more)

        real = places.read_packing
        with unittest.mock.patch.object(places, "read_packing", seen), unittest.mock.patch.object(places.Folder, "found", None):
            status = self.make([3, 5, 9], search=False)
        self.assertEqual((status.asked, status.done, status.made), (3, 3, 1))
        self.assertEqual(set(opened), {self.file(k) for k in (3, 5, 9)})


class Releases(Case):
    def test_a_later_release_goes_on_with_what_1_0_0_made(self):
        with self.written_by(version="1.0.0", algorithm=None):  # as 1.0.0 wrote
            self.make([1, 2])
        with unittest.mock.patch("jam.raw.jam_version", lambda: "1.0.9"), self.written_by(version="1.0.9", commit="0123456789ab", library="f" * 16):
            status = self.make([1, 2, 3])
        self.assertEqual((status.made, status.done), (1, 3))
        self.assertIn("made by 2 builds", str(status))
        self.assertIn("1.0.9 commit 0123456789ab library ffffffffffffffff", str(status))
        self.assertEqual(self.seeds(), [1, 2, 3])
        self.assertEqual(self.e.table()["commit"].tolist(), [*[jam.raw.jam_commit().encode()] * 2, b"0123456789ab"])
        self.assertEqual(self.e.table()["algorithm"].tolist(), [b"1.0.0"] * 3)

    def test_names_are_those_of_1_0_0(self):
        """sha256 of protocol, seed and 1.0.0, as that release wrote them."""
        self.assertEqual(jam.ensemble.packing_name("0123456789ab", 7), "762912a1e7700110d118aa0e8f6cdad6")

    def test_of_two_builds_with_one_seed_one_counts_and_a_warning_names_both(self):
        with self.written_by(version="1.0.0", algorithm=None):
            self.make([1])
        twin = self.e.files.packing(jam.ensemble.packing_name(self.e.id, 1, "1.0.1"))  # the name that 1.0.1 would give
        kept = self.file(1).read_bytes()
        self.file(1).unlink()
        with self.written_by(version="1.0.1", algorithm=None):
            self.make([1])
        os.rename(self.file(1), twin)
        self.file(1).write_bytes(kept)
        with self.warned(f"{twin} holds the packing of seed 1 .*made by 1.0.1 .* and by 1.0.0"):
            self.assertEqual(self.e.table()["version"].tolist(), [b"1.0.0"])

    def test_packings_of_another_algorithm_count_until_this_one_has_made_them(self):
        with self.written_by(version="0.9.0", algorithm="0.9.0"):
            self.make([1, 2])
        old = {seed: self.file(seed).rename(self.e.files.packing(jam.ensemble.packing_name(self.e.id, seed, "0.9.0"))) for seed in (1, 2)}
        self.assertEqual(self.seeds(), [1, 2])
        self.assertEqual(self.e.status([1, 2]).missing, 0)
        self.assertEqual(self.make([1]).made, 1)
        with self.warned(f"{old[1]} .*algorithm 0.9.0.*algorithm 1.0.0"):
            self.assertEqual(self.e.table()["algorithm"].tolist(), [b"1.0.0", b"0.9.0"])

    def test_the_algorithm_rises_with_a_default(self):
        """The complete default protocol of the algorithm; options that later releases add are not in it. A default that
        differs is another algorithm: see ALGORITHM in _formats/write_packing.py."""
        kept = json.loads(Path(__file__).with_name(f"protocol_{jam._formats.write_packing.ALGORITHM}.json").read_text())
        now = jam.ensemble.complete({})
        for part in ("start", "crunch"):
            self.assertEqual({k: now[part][k] for k in kept[part]}, kept[part])
        self.assertEqual(len(now["stages"]), len(kept["stages"]))
        for stage, before in zip(now["stages"], kept["stages"]):
            self.assertEqual({k: stage[k] for k in before}, before)
        self.assertEqual(now["analysis"], kept["analysis"])


class Failures(Case):
    def test_what_the_machine_caused_is_tried_again(self):
        wrong = iter([OSError(28, "No space left"), AttributeError("module 'queue' has no attribute 'SimpleQueue'"),
                      jam.errors.MemoryError("the limit is 1 GB")])

        def fail(*_):
            raise next(wrong)

        for _ in range(3):
            with unittest.mock.patch("jam.ensemble.ensemble.make", fail):
                self.assertEqual(self.make([1]).failed, 1)
        status = self.make([1])
        self.assertEqual((status.done, status.failed, status.made), (1, 0, 1))
        self.assertEqual(self.e.failures(), [])

    def test_a_module_that_workers_lack_ends_the_campaign_and_fails_no_seed(self):
        with unittest.mock.patch("jam.ensemble.ensemble.make", side_effect=ImportError("no scipy")):
            with self.assertRaisesRegex(ImportError, "no scipy"):
                self.make([1])
        self.assertEqual(self.e.failures(), [])


class Shards(Case):
    def setUp(self):
        super().setUp()
        self.make([1, 2, 3])
        self.shards = self.e.export(self.folder / "shards", per_shard=2)
        self.s = Ensemble(self.folder / "shards")

    def test_an_ensemble_of_shards_is_that_of_the_files(self):
        self.assertEqual((self.s.id, self.s.protocol), (self.e.id, self.e.protocol))
        np.testing.assert_array_equal(self.s.table(), self.e.table())
        np.testing.assert_array_equal(jam.ensemble.table(self.folder / "shards"), self.e.table())
        self.assertEqual(jam.ensemble.protocols(self.folder / "shards"), {self.e.id: self.e.protocol})
        for name in ("forces", "gaps", "positions", "coordination"):
            for ours, theirs in zip(self.s.each(name), self.e.each(name), strict=True):
                np.testing.assert_array_equal(ours, theirs)
        for ours, theirs in zip(self.s, self.e):
            same_bits(jam.load(ours.path, self.e.name(ours.seed)), theirs.system())
        with self.assertRaisesRegex(jam.ensemble.StoreError, "shard of 2 packings"):
            jam.load(self.shards[0])
        self.assertEqual(str(self.s.status()), str(self.e.status()))

    def test_the_files_may_go_and_a_campaign_goes_on_in_the_shards(self):
        shutil.rmtree(self.folder / "e")
        status = self.make([1, 2, 3, 4], self.s)
        self.assertEqual((status.done, status.made), (4, 1))
        self.assertEqual(self.make([3, 4], self.s, search=False).made, 0)
        self.s.export(self.folder / "again")
        again = Ensemble(self.folder / "again")
        self.assertEqual(again.table()["seed"].tolist(), [1, 2, 3, 4])

    def test_a_shard_beside_its_files_is_named_and_counts_nothing(self):
        for shard in self.shards:
            shutil.copy(shard, self.folder / "e")
        with self.warned("2 files are omitted: .*and 1 more, which other files hold too"):
            self.assertEqual(self.seeds(), [1, 2, 3])

    def test_a_full_disk_is_an_error_and_not_the_end_of_the_process(self):
        """Of shards, the index and packings: each write beyond a limit fails, that of the seal, of arrays, and of what libhdf5
        keeps until it closes a file."""
        code = (
            "import resource, signal, sys, jam\n"
            "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
            "s, e, limit = jam.load('one.h5'), jam.ensemble.Ensemble('e'), int(sys.argv[1])\n"
            "resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))\n"
            "for write in (lambda: e.export('full'), lambda: s.save('full/one.h5')):\n"
            "    try: write()\n"
            "    except jam.ensemble.StoreError as error: print(error)\n"
            "print(len(e.table()))\n"
        )
        shutil.copy(self.file(1), self.folder / "one.h5")
        for limit in (100, 600, 3000, self.file(1).stat().st_size, self.shards[0].stat().st_size):
            (self.folder / "e" / "index.bin").unlink(missing_ok=True)
            command = [sys.executable, "-c", code, str(limit)]
            done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""), limit)
            wanted = ["File too large"] * (1 + (limit < self.file(1).stat().st_size)) + ["^3$"]
            for line, text in zip(done.stdout.splitlines(), wanted, strict=True):
                self.assertRegex(line, text)
            self.assertEqual([p.name for p in (self.folder / "full").iterdir()], ["one.h5"] * (len(wanted) == 2))

    def test_the_memory_limit_is_of_one_packing(self):
        """However long a shard is: what export writes can be read."""
        path, name = self.shards[0], self.e.name(1)
        largest = max(self.file(seed).stat().st_size for seed in (1, 2))
        self.assertGreater(path.stat().st_size, largest)
        same_bits(jam.load(path, name, memory_limit=largest), next(iter(self.e)).system())
        with self.assertRaisesRegex(jam.ensemble.StoreError, f"{name}.*memory_limit="):
            jam.load(path, name, memory_limit=1000)
        for wrong in (-1, 0, 10_001):
            with self.assertRaisesRegex(ValueError, "per_shard"):
                self.e.export(self.folder / "more", wrong)

    def test_a_damaged_shard_is_named(self):
        data = bytearray(self.shards[0].read_bytes())
        data[100] ^= 1
        self.shards[0].write_bytes(data)
        for s in (Ensemble(self.folder / "shards"), Ensemble(self.folder / "shards", SMALL)):
            with self.warned(self.shards[0].name):
                self.assertEqual(s.table()["seed"].tolist(), [3])
            self.assertIn(self.shards[0].name, str(s.damaged()))
        self.shards[1].write_bytes(b"")
        with self.assertRaisesRegex(jam.ensemble.StoreError, self.shards[0].name):
            Ensemble(self.folder / "shards")
