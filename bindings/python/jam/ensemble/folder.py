"""The folder of an ensemble: where the files lie, and what is there.

    protocols/<id>.json          each protocol with every default spelled out
    packings/ab/<name>.h5        one packing; ab are the first two digits of its name
    packings/ab/<name>.json      a failure: status and text
    *.h5                         shards of many packings, as Ensemble.export writes
    parts/                       unfinished files
    index.bin                    rows of packings: see rows.py

A packing is known by what stands in its file: protocol, seed and algorithm. Its name, which follows from them, only says
where to look first. Where several files hold the packing of one seed, one counts and the others are named. So is a file that
is damaged, or that has the name of another packing. Nobody removes one unasked.
"""
from __future__ import annotations

import json
import os
import time
import warnings
from contextlib import suppress
from functools import partial
from itertools import chain, count
from pathlib import Path
from random import SystemRandom
from tempfile import TemporaryFile
from typing import Any, Callable, Iterable, Iterator, NamedTuple

import numpy as np

from .._api.arrays import Array
from .._formats.replacing import remove_abandoned, replacing, writing
from .._formats.seal import names_in, read_packing, refusing
from .._formats.write_packing import ALGORITHM, provenance
from ..errors import StoreError
from .protocol import identity, packing_name
from .rows import ROW, DamagedWarning, Entry, build_of, key_of, name_at, read_index, row_of, write_index

LOOKED_UP = 2  # rows of the index, each time it is used


class Content(NamedTuple):
    """The packings of a folder."""

    entries: list[Entry]  # those that count, by seed
    damaged: dict[Path, str]  # files that cannot be read, and what is wrong with each
    doubles: dict[Path, str]  # files whose packings do not count, as others hold them
    odd: dict[Path, str]  # files that count, though they have the name of another packing

    def lost(self) -> int:
        """How many packings are in damaged files alone. A file of another name may be anything, and is none."""
        return len({name_at(path, None) for path in self.damaged} - {"", *(str(e.row["name"], "ascii") for e in self.entries)})


class Folder:
    """Files of one folder."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        self.packings, self.parts, self.index = self.path / "packings", self.path / "parts", self.path / "index.bin"

    # ---- names
    def packing(self, name: str) -> Path:
        """Where the packing of a name belongs."""
        return self.packings / name[:2] / (name + ".h5")

    def failure(self, name: str) -> Path:
        return self.packing(name).with_suffix(".json")

    def _beside(self, name: str) -> Iterator[Path]:
        """Where the packing of a name may lie: if the file of another packing has the place, it is NAME-2.h5, and so on up to
        the first that is not there."""
        path = self.packing(name)
        yield path
        for k in count(2):
            if not path.exists():
                return
            path = path.with_stem(f"{name}-{k}")
            yield path

    def place(self, name: str) -> tuple[Path, str]:
        """Where a packing lies or may be written, and what is there: "done", "damaged" or ""."""
        for path in self._beside(name):
            try:
                if path.exists() and self.row(path, None)["name"] == name.encode():
                    return path, "done"
            except StoreError:
                return path, "damaged"
        return path, ""

    def prepare(self) -> None:
        """Makes the folders and looks whether they can be written; removes what killed writers left."""
        with writing(self.path):
            for part in [self.path / "protocols", self.parts] + [self.packings / f"{k:02x}" for k in range(256)]:
                part.mkdir(parents=True, exist_ok=True)
            TemporaryFile(dir=self.parts).close()
        remove_abandoned(self.parts)

    # ---- protocols
    def protocols(self) -> dict[str, Callable[[], dict[str, Any]]]:
        """The names of the protocols, in order, and what reads each as it was written: later options have defaults in it."""
        found, wrong = {p.stem: partial(_protocol, p, p.stem) for p in (self.path / "protocols").glob("*.json")}, []
        for path in self._shards():
            try:
                with refusing(path):
                    for first in names_in(path)[:1]:
                        packing = read_packing(path, first)
                        name = str(packing.attributes["jam"]["protocol"])
                        found.setdefault(name, partial(_protocol, path, name, packing.get("jam/protocol")))
            except StoreError as error:  # where other files know the protocol, _places() says what is wrong with this one
                wrong.append(error)
        if wrong and not found:
            raise wrong[0]
        return dict(sorted(found.items()))

    def keep_protocol(self, name: str, text: str) -> None:
        path = self.path / "protocols" / (name + ".json")
        if not path.exists():
            self.write(path, text.encode() + b"\n")

    # ---- what is there
    def _shards(self) -> list[Path]:
        return sorted(self.path.glob("*.h5"))

    def found(self, ending: str) -> Iterator[Path]:
        """All files of packings, .h5, or records of failures, .json."""
        return self.packings.rglob("*" + ending)  # one beside the folders: a file manager or a user put it there

    def _places(self, names: Iterable[str] | None, wrong: dict[Path, str]) -> Iterator[tuple[Path, str | None]]:
        """The places of packings, in files of one and in shards. Tells what is wrong with shards that cannot be read."""
        yield from ((path, None) for path in (self.found(".h5") if names is None else chain(*map(self._beside, names))))
        for path in self._shards():
            try:
                yield from [(path, inner) for inner in names_in(path)]
            except StoreError as error:
                wrong[path] = str(error.strerror)

    def row(self, path: Path, inner: str | None) -> Array:
        """The row of a packing from its file."""
        packing = read_packing(path, inner)
        with refusing(path):
            return row_of(packing)

    def content(self, names: Iterable[str] | None = None, by_index: bool = True) -> Content:
        """The packings that are there: all, or those of some names and of shards. Some rows of the index are compared with
        their files; where one differs, all are taken from the files."""
        damaged: dict[Path, str] = {}
        places: dict[bytes, tuple[Path, str | None]] = {}
        for place in self._places(names, damaged):
            with suppress(FileNotFoundError):  # there is none of this name, or somebody removed it meanwhile
                places[key_of(*place)] = place
        index = read_index(self.index) if names is None and by_index else {}
        rows = {key: index[key] for key in places if key in index}
        looked_up = SystemRandom().sample([*rows], min(LOOKED_UP, len(rows)))
        for key in [key for key in places if key not in rows] + looked_up:
            try:
                rows[key] = self.row(*places[key]).tobytes()
            except StoreError as error:
                rows.pop(key, None)
                if places[key][0].exists():
                    damaged[places[key][0]] = str(error.strerror)
            if key in index and rows.get(key) != index[key]:
                if key in rows:
                    text = f"{self.index} has another row for {places[key][0]} than that file: rows are taken from all files"
                    warnings.warn(text, DamagedWarning, stacklevel=3)
                return self.content(names, by_index=False)
        if names is None and rows != index:
            write_index(self.index, rows)
        return _counted([Entry(row, places[key]) for key, row in zip(rows, np.frombuffer(b"".join(rows.values()), ROW))], damaged)

    # ---- failures
    def failures(self, names: Iterable[str] | None = None) -> dict[str, dict[str, Any]]:
        """Records of failures by name: seed, protocol, status, text, version, commit, machine, time.

        One that cannot be read has the status "damaged_record", the seed -1 and no protocol. One of a packing that was made
        since is none.
        """
        found: dict[str, dict[str, Any]] = {}
        for path in self.found(".json") if names is None else map(self.failure, names):
            try:
                with refusing(path), open(path, encoding="utf-8") as file:
                    record = json.load(file)
                    record = {**record, "seed": int(record["seed"]), "protocol": str(record["protocol"])}
                    name = packing_name(record["protocol"], record["seed"], record.get("algorithm", "1.0.0"))
            except StoreError as error:
                if not path.exists():
                    continue
                name, text = path.stem, error.strerror
                record = {"seed": -1, "protocol": "", "status": "damaged_record", "text": text, "time": 0.0}
            found.setdefault(name, record)
        return {name: record for name, record in found.items() if not self.packing(name).exists()}

    def write_failure(self, protocol_id: str, seed: int, status: str, text: str) -> None:
        record = {"seed": seed, "protocol": protocol_id, "status": status, "text": text, "time": time.time()}
        data = json.dumps({**record, **provenance()}, indent=2).encode() + b"\n"
        self.write(self.failure(packing_name(protocol_id, seed)), data)

    def write(self, path: Path, data: bytes) -> None:
        with replacing(path, self.parts) as file:
            file.write(data)


def _counted(entries: list[Entry], damaged: dict[Path, str]) -> Content:
    """One packing for each seed and protocol: of this library's algorithm, under its own name, the oldest."""

    def claim(e: Entry) -> tuple[int, bytes]:
        return int(e.row["seed"]), e.row["protocol"]

    def renamed(e: Entry) -> bool:
        return name_at(*e._place) != e.row["name"].decode()

    kept: dict[tuple[int, bytes], Entry] = {}
    doubles: dict[Path, list[str]] = {}
    odd: dict[Path, str] = {}
    mine = ALGORITHM.encode()
    for e in sorted(entries, key=lambda e: (claim(e), e.row["algorithm"] != mine, renamed(e), e.row["written"], str(e.path))):
        first = kept.setdefault(claim(e), e)
        what = f"the packing of seed {e.seed} of protocol {e.row['protocol'].decode()}"
        if first is not e:
            ours, theirs = (f"{build_of(row)} (algorithm {row['algorithm'].decode()})" for row in (e.row, first.row))
            builds = "" if ours == theirs else f"; made by {ours} and by {theirs}"
            doubles.setdefault(e.path, []).append(f"{e.path} holds {what}, as {first.path} does, which counts{builds}")
        elif renamed(e) and e._place[1] is None:
            odd[e.path] = f"{e.path} has another name than {what}, which it holds"
    more = "{}; and {} more, which other files hold too"
    named = {path: more.format(texts[0], len(texts) - 1) if texts[1:] else texts[0] for path, texts in doubles.items()}
    return Content([*kept.values()], damaged, named, odd)


def _protocol(path: Path, name: str, text: str | None = None) -> dict[str, Any]:
    with refusing(path):
        found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8") if text is None else text)
        if found["start"].get("lattice", 0) is None:  # protocols of older folders have lattice: null
            del found["start"]["lattice"]
        if identity(found) != name:
            raise StoreError(
                22,
                f"{path} does not contain the protocol of its name: it was changed, or this version has other "
                "defaults. Give the protocol itself",
            )
    return found
