"""Files of packings: damage is found and named, crafted files reach nothing, plain h5py finds its way, part files."""
import hashlib
import io
import json
import os
import re
import resource
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

import jam
from packings import InFolder
from jam._formats import replacing, seal
from jam.store import StoreError


def crafted(data, change):
    """A file whose index an attacker changed, with all checksums made to fit."""
    data = bytearray(data)
    at, size = map(int, re.search(rb"index (\d{20}) (\d{20})", data).groups())
    index = json.loads(bytes(data[at : at + size]))
    made = change(index)
    index = index if made is None else made
    text = index if isinstance(index, bytes) else json.dumps(index).encode()
    data += text  # behind the HDF5, where its length does not matter
    place = [len(data) - len(text), len(text), hashlib.sha256(text).hexdigest()]
    data[:512] = seal.head_of(len(data), place, hashlib.sha256(data[512:]).hexdigest())
    return bytes(data)


class Case(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        cls.disks = jam.System.random(n=32, dim=2, seed=1, diameters=[1.0] * 16 + [1.4] * 16)
        cls.disks.crunch()
        cls.path = cls.folder / "good.h5"
        cls.disks.save(cls.path)
        cls.good = cls.path.read_bytes()

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def written(self, data, name="changed.h5"):
        path = self.folder / name
        path.write_bytes(data)
        return path


class Damage(Case):
    def test_names_of_other_formats_are_refused(self):
        for name in ("a.npz", "a.xyz", "a.XYZ.gz", Path("a.gsd"), "a.json", "a.pkl", "a", b"a.stl"):
            for save in (self.disks.save, lambda path: jam.store.save(self.disks, path)):
                with self.assertRaisesRegex(ValueError, r"must end in \.h5 or \.hdf5"):
                    save(name)
                self.assertFalse(Path(os.fsdecode(name)).exists())

    def test_the_seal_is_what_the_file_says_of_itself(self):
        head = self.good[:512].decode()
        self.assertIn(f"length {len(self.good):020d}", head)
        command = f"tail -c +513 {self.path} | sha256sum"
        found = subprocess.run(command, shell=True, capture_output=True, text=True, check=True).stdout.split()[0]
        self.assertIn(f"\nsha256 {found}\n", head)

    def test_a_flipped_bit_is_found_and_the_array_is_named(self):
        """All ways of damage, and flips all over the file: tests/fuzz/packings.py."""
        with h5py.File(self.path, "r") as file:
            place = file["jam/contacts/forces"].id.get_offset()
        data = bytearray(self.good)
        data[place + 100] ^= 4
        with self.assertRaisesRegex(StoreError, "changed.h5.*jam/contacts/forces"):
            jam.load(self.written(data))
        for data in (b"", self.good[:10], self.good[:511]):
            with self.assertRaisesRegex(StoreError, "changed.h5"):
                jam.load(self.written(data))

    def test_what_another_program_changed_is_refused(self):
        path = self.written(self.good)
        with h5py.File(path, "r+") as file:
            file["jam/contacts/forces"][0] = 7.0
        with self.assertRaisesRegex(StoreError, "jam/contacts/forces.*h5py.*from_arrays"):
            jam.load(path)
        with h5py.File(self.written(self.good), "r+") as file:
            file["notes"] = "of another program"
        with self.assertRaisesRegex(StoreError, "changed by another program"):
            jam.load(path)
        with h5py.File(path, "w") as file, h5py.File(io.BytesIO(self.good), "r") as source:
            for name in ("h5md", "particles", "jam"):
                source.copy(name, file)
        with self.assertRaisesRegex(StoreError, "without the seal.*h5py.*from_arrays"):
            jam.load(path)

    def test_parts_that_differ_under_a_seal_that_fits(self):
        # The system comes from jam/state, so an edit beside it must not get lost.
        for name, text in (
            ("jam/contacts/forces", "jam/contacts/forces is not that of jam/state"),
            ("particles/spheres/position/value", "position/value is not that of jam/state"),
            ("jam/state", "jam/state: "),
        ):

            def edit(index, name=name):
                entry = index["data"][name]
                part = data[entry[0] : entry[0] + size]
                entry[3] = hashlib.sha256(part).hexdigest()

            with h5py.File(io.BytesIO(self.good), "r") as file:
                size = file[name].nbytes
                at = file[name].id.get_offset() + 7 % size
            data = bytearray(self.good)
            data[at] ^= 1
            with self.assertRaisesRegex(StoreError, text + ".*from_arrays"):
                jam.load(self.written(crafted(data, edit)))

    def test_files_that_are_none(self):
        os.mkfifo(self.folder / "pipe")
        for name, text in (("pipe", "no regular file"), (".", "no regular file"), ("none", "No such file")):
            with self.assertRaisesRegex(StoreError, text):
                jam.load(self.folder / name)
        for content, text in ((b"2\n2\n0.1\n", "System.read reads XYZ"), (b"", "is empty"), (b"jamstat", "from_checkpoint reads it")):
            with self.assertRaisesRegex(StoreError, text):
                jam.load(self.written(content))


class Crafted(Case):
    """Checksums fit, as anybody can compute them."""

    def refused(self, change, text="changed.h5"):
        limit = resource.getrlimit(resource.RLIMIT_AS)
        path = self.written(crafted(self.good, change))
        signal.alarm(60)
        resource.setrlimit(resource.RLIMIT_AS, (4 << 30, limit[1]))
        try:
            with self.assertRaisesRegex(StoreError, text):
                jam.load(path)
        finally:
            resource.setrlimit(resource.RLIMIT_AS, limit)
            signal.alarm(0)

    def put(self, name, entry):
        """Another entry of the index, with the checksum of the bytes it names."""

        def change(index):
            at, shape, kind = entry(*index["data"][name][:3])
            digest = ""
            if isinstance(kind, str):
                size = int(np.prod(shape, dtype=object)) * int(kind[2:] or 0)
                digest = hashlib.sha256(self.good[at : at + size]).hexdigest()
            index["data"][name] = [at, shape, kind, digest]

        return change

    def entry_of_forces(self):
        with h5py.File(self.path, "r") as file:
            return [file["jam/contacts/forces"].id.get_offset(), [63], "<f8", "0" * 64]

    def test_nothing_changed_is_read(self):
        path = self.written(crafted(self.good, lambda index: None))
        np.testing.assert_array_equal(jam.load(path).forces, self.disks.forces)

    def test_places_and_sizes_beyond_the_file(self):
        name = "jam/contacts/forces"
        for entry in (
            lambda at, shape, kind: (at, [4 << 30], kind),
            lambda at, shape, kind: (len(self.good), shape, kind),
            lambda at, shape, kind: (-8, shape, kind),
            lambda at, shape, kind: (at, [-1], kind),
            lambda at, shape, kind: (at, [0, 10**18], kind),
            lambda at, shape, kind: (at, [], "|S999999999"),
        ):
            self.refused(self.put(name, entry))

    def test_types_that_are_no_numbers(self):
        for kind in ("|O8", "O", "|V8", "<M8", "<f3", "|S0", [["a", "|O8"]], [], {"a": 1}, 7, None):
            self.refused(self.put("jam/contacts/forces", lambda at, shape, _, kind=kind: (at, shape, kind)))

    def test_arrays_that_do_not_fit_the_packing(self):
        n, contacts = self.disks.n, len(self.disks.forces)
        for name, entry in (
            ("jam/contacts/pairs", lambda at, shape, kind: (self.good.index(self.disks.forces.tobytes()), shape, kind)),
            ("jam/contacts/pairs", lambda at, shape, kind: (at, [2 * contacts], kind)),
            ("jam/contacts/forces", lambda at, shape, kind: (at, [contacts - 1], kind)),
            ("jam/contacts/vectors", lambda at, shape, kind: (at, [2 * contacts, 1], kind)),
            ("jam/diameters", lambda at, shape, kind: (at, [n - 1], kind)),
            ("jam/report", lambda at, shape, kind: (at, [10], "<f8")),
            ("jam/history", lambda at, shape, kind: (at, [10], "<f8")),
            ("jam/calls", lambda at, shape, kind: (at, [], "|S3")),
            ("jam/state", lambda at, shape, kind: (at, [100], kind)),
        ):
            self.refused(self.put(name, entry))

    def test_an_index_that_is_none(self):
        for text in (
            b"",
            b"[" * 100000,
            b"9" * 1000000,
            b"\xff\xfe",
            b"null",
            b"[]",
            b'{"data": 1, "attributes": 2}',
            b'{"packings": 3}',
            b'{"data": {}, "attributes": {}}',
            b" " * (5 << 20),
        ):
            self.refused(lambda index, text=text: text)
        for part in ("data", "attributes"):
            self.refused(lambda index, part=part: index.pop(part) and None)
        forces = list(self.entry_of_forces())
        self.refused(lambda index: index["data"].update({f"a{k}": forces for k in range(5000)}), "4096")
        self.refused(lambda index: index["data"].update({"a/" * 100 + "b": forces}), "deep")
        self.refused(lambda index: index["data"].update({f"a{k}": forces for k in range(1000)}), "longer than the file")
        self.refused(lambda index: index["attributes"]["jam"].update(schema="x"))
        self.refused(lambda index: index["attributes"]["jam"].update(schema=99), "newer")
        self.refused(lambda index: index["data"].pop("jam/state") and None)

    def test_links_external_data_and_pipes_in_hdf5_are_not_followed(self):
        """Only places of the index are read, none of what HDF5 would follow."""
        os.mkfifo(self.folder / "fifo")

        def external(file):
            del file["jam/contacts/forces"]
            file["jam/contacts"].create_dataset("forces", shape=(100,), dtype="u1", external=[(str(self.folder / "fifo"), 0, 100)])

        def link(file):
            del file["jam/contacts"]
            file["jam/contacts"] = h5py.ExternalLink(str(self.path), "jam/contacts")

        def huge(file):
            del file["jam/state"]
            file["jam"].create_dataset("state", shape=(4 << 30,), dtype="u1", chunks=(1 << 20,), compression="gzip")

        for change in (external, link, huge):
            path = self.written(self.good)
            with h5py.File(path, "r+") as file:
                change(file)
            signal.alarm(60)
            with self.assertRaisesRegex(StoreError, "damaged"):
                jam.load(path)
            data = path.read_bytes()  # the old index under a new seal
            place = re.search(rb"index (\d{20}) (\d{20})\nindex sha256 ([0-9a-f]{64})", data)
            index = [int(place[1]), int(place[2]), place[3].decode()]
            head = seal.head_of(len(data), index, hashlib.sha256(data[512:]).hexdigest())
            try:
                loaded = jam.load(self.written(head + data[512:]))
                np.testing.assert_array_equal(loaded.forces, self.disks.forces)
            except StoreError:
                pass
            signal.alarm(0)

    def test_a_file_longer_than_the_limit_is_refused_unread(self):
        path = self.folder / "sparse.h5"
        place = re.search(rb"index (\d{20}) (\d{20})\nindex sha256 ([0-9a-f]{64})\nsha256 ([0-9a-f]{64})", self.good)
        index = [int(place[1]), int(place[2]), place[3].decode()]
        for head, why in ((self.good[:512], "does not fit"), (seal.head_of(1 << 42, index, place[4].decode()), "memory_limit=")):
            with open(path, "wb") as file:
                file.write(head + self.good[512:])
                file.truncate(1 << 42)
            with self.assertRaisesRegex(StoreError, why):
                jam.load(path)
        with self.assertRaisesRegex(StoreError, "memory_limit="):
            jam.load(self.path, memory_limit=1000)
        with self.assertRaisesRegex(StoreError, "memory_limit="):
            jam.load(self.path, memory_limit=float("nan"))
        with self.assertRaisesRegex(ValueError, "float"):
            jam.load(self.path, memory_limit="a")
        path.unlink()


class PlainHdf5(Case):
    def test_h5py_explains_itself(self):
        with h5py.File(self.path, "r") as file:
            report = file["jam/report"]
            names = h5py.check_enum_dtype(report.dtype["stop_reason"])
            self.assertEqual(names["CONVERGED"], int(report["stop_reason"]))
            self.assertIn("8 converged: crunch: both tolerances met", report.attrs["StopReason"])
            self.assertIn("packing_fraction: phi_J when jammed", report.attrs["fields"])
            for name in ("state", "diameters", "coordination", "history", "calls"):
                self.assertTrue(file["jam"][name].attrs["description"], name)
            for name, unit in (("pairs", None), ("vectors", "1"), ("gaps", "1"), ("forces", "1")):
                self.assertEqual(file["jam/contacts"][name].attrs.get("unit"), unit)
            self.assertIn("from the centre of j to that of i", file["jam/contacts/vectors"].attrs["description"])
            self.assertIn("2 lp: an LP", file["jam/history"].attrs["phase"])
            x, pairs = file["particles/spheres/position/value"][0], file["jam/contacts/pairs"][()]
            apart = x[pairs[:, 0]] - x[pairs[:, 1]]
            apart -= np.rint(apart)
            along = (apart * file["jam/contacts/vectors"][()]).sum(1)
            np.testing.assert_allclose(along, np.linalg.norm(apart, axis=1))  # the sign is what the text says

    def test_h5md_asks_for_step_and_time_of_each_element(self):
        many = self.folder / "many.h5"
        self.assertEqual(jam.store.write_shard(many, "", {"a": self.path, "b": self.path}), [])
        for path, groups in ((self.path, [""]), (many, ["a/", "b/"])):
            with h5py.File(path, "r") as file:
                for element in (f"{group}particles/spheres/{name}" for group in groups for name in ("position", "box/edges")):
                    self.assertEqual((len(file[element]["step"]), len(file[element]["time"])), (1, 1), element)


class Parts(InFolder):
    def test_what_a_killed_writer_left_goes_and_nothing_else(self):
        target = self.folder / ("x" * 255)  # the longest name there is
        users = [self.folder / name for name in ("x.part-20240101", ".jam-notes.part", "y.part")]
        for file in users:
            file.write_text("mine")
        code = f"import os; from jam._formats import replacing\nwith replacing.replacing({str(target)!r}) as f: os.kill(os.getpid(), 9)"
        subprocess.run([sys.executable, "-c", code])
        left = set(self.folder.iterdir()) - set(users)
        self.assertEqual(len(left), 1)
        with replacing.replacing(target) as file:  # two writers at once: neither takes the other's file
            with replacing.replacing(target) as other:
                other.write(b"other")
            file.write(b"last")
        self.assertEqual(target.read_bytes(), b"last")
        self.assertEqual(set(self.folder.iterdir()), {target, *users})

    def test_a_file_of_another_owner_keeps_him_and_lends_nobody_any_rights(self):
        disks = jam.System.random(n=16, dim=2, seed=1)
        for writer, name in ((disks.save, "a.h5"), (lambda path: jam.files.write_csv(disks, path), "a.csv")):
            target = self.folder / name
            for special in (0o7777, 0o4750, 0o2775, 0o1700):
                target.write_text("old")
                if os.geteuid() == 0:
                    os.chown(target, 65534, 65534)
                target.chmod(special)
                before = target.stat()
                writer(target)
                after = target.stat()
                self.assertEqual(after.st_mode & 0o7777, special & 0o777, name)
                self.assertEqual((after.st_uid, after.st_gid), (before.st_uid, before.st_gid))
                self.assertNotEqual(after.st_ino, before.st_ino)

    def test_an_error_leaves_the_old_file_and_its_permissions_stay(self):
        target = self.folder / "a"
        target.write_text("old")
        target.chmod(0o640)
        with self.assertRaises(ZeroDivisionError), replacing.replacing(target) as file:
            file.write(b"new")
            1 // 0
        self.assertEqual(target.read_text(), "old")
        with replacing.replacing(target) as file:
            file.write(b"new")
        self.assertEqual((target.read_text(), target.stat().st_mode & 0o777), ("new", 0o640))
        self.assertEqual(list(self.folder.iterdir()), [target])
