"""The folder of an ensemble: where the files lie, and what is there.

    protocols/<id>.json          each protocol with every default spelled out
    packings/ab/<name>.h5        one packing; ab are the first two digits of its name
    packings/ab/<name>.json      a failure: status and text
    *.h5                         shards of many packings, as Ensemble.export writes
    parts/                       unfinished files
    index.sqlite                 rows of packings: see index.py

A packing is known by what stands in its file: protocol, seed and algorithm. Its name, which follows from them, only says
where to look first. Where several files hold the packing of one seed, one counts and the others are named. So is a file that
is damaged, or that has the name of another packing. Nobody removes one unasked.
"""
from __future__ import annotations

import json
import os
import time
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any, Callable, Iterable, Iterator, NamedTuple

import numpy as np

from .._api.arrays import Array
from .._formats.groups import Shard, refusing
from .._formats.provenance import ALGORITHM, provenance
from .._formats.read_packing import jam_of, plain
from .._formats.replacing import check_writable, remove_abandoned
from .._formats.sealed import open_file
from .._formats.write_packing import write_file
from ..errors import StoreError
from . import index
from .index import Stamp
from .protocol import identity, packing_name
from .row import ROW, hash_of_row, row_of

__all__ = ["Content", "Folder", "Place", "hash_of_row"]


class Place(NamedTuple):
    """Where a packing lies: its file, and its name in a shard."""

    path: Path
    inner: str | None = None


class Content(NamedTuple):
    """The packings of a folder."""

    rows: Array  # of those that count, by seed
    places: list[Place]  # of each row
    damaged: dict[Path, str]  # files that cannot be read, and what is wrong with each
    doubles: dict[Path, str]  # files whose packings do not count, as others hold them
    misnamed: dict[Path, str]  # files that count, though they have the name of another packing


class Folder:
    """Files of one folder. unverified: also those without a seal, or with one that does not fit."""

    def __init__(self, path: str | os.PathLike[str], unverified: bool = False) -> None:
        self.path, self.unverified = Path(path), unverified
        self.packings, self.parts, self.index = self.path / "packings", self.path / "parts", self.path / "index.sqlite"

    # ---- names
    def packing(self, name: str) -> Path:
        """Where the packing of a name belongs."""
        return self.packings / name[:2] / (name + ".h5")

    def failure(self, name: str) -> Path:
        return self.packings / name[:2] / (name + ".json")

    def free(self, name: str) -> Path:
        """Where a packing may be written that is not there: beside its own place, where a file of another one has that."""
        path, k = self.packing(name), 1
        while path.exists():
            try:
                if self.row(Place(path))["name"] == name.encode():
                    break
            except StoreError:
                break  # damaged: the caller knows whether it may be replaced
            k += 1
            path = self.packing(name).with_name(f"{name}-{k}.h5")
        return path

    def prepare(self) -> None:
        """Makes the folders and looks whether they can be written; removes what killed writers left."""
        try:
            for part in [self.path / "protocols", self.parts] + [self.packings / f"{k:02x}" for k in range(256)]:
                part.mkdir(parents=True, exist_ok=True)
            check_writable(self.parts)
        except OSError as error:
            raise StoreError(error.errno, f"{self.path}: this folder cannot be written to: {error.strerror}") from error
        remove_abandoned(self.parts)

    # ---- protocols
    def protocols(self) -> dict[str, Callable[[], dict[str, Any]]]:
        """The names of the protocols, in order, and what reads each as it was written: later options have defaults in it."""
        found, wrong = {p.stem: partial(_protocol, p, p.stem) for p in (self.path / "protocols").glob("*.json")}, []
        for path in self._shards():
            try:
                with open_file(path, self.unverified) as shard, refusing(path):
                    jam = jam_of(shard[next(iter(shard))], path)
                    name = str(jam.attrs["protocol"])
                    found.setdefault(name, partial(_protocol, path, name, plain(jam["protocol"])))
            except StoreError as error:  # where other files know the protocol, _places() says what is wrong with this one
                wrong.append(error)
        if wrong and not found:
            raise wrong[0]
        return dict(sorted(found.items()))

    def keep_protocol(self, name: str, text: str) -> None:
        path = self.path / "protocols" / (name + ".json")
        if not path.exists():
            write_file(path, text.encode() + b"\n", self.parts)

    # ---- what is there
    def _shards(self) -> list[Path]:
        return sorted(self.path.glob("*.h5"))

    def scan(self, names: Iterable[str] | None = None) -> tuple[dict[Path, Stamp], list[Path]]:
        """Files of packings with what tells whether they have changed, and records of failures: all, or those of names."""
        found: dict[Path, Stamp] = {}
        failures: list[Path] = []
        for path in self._files() if names is None else map(self.packing, names):
            if path.suffix == ".json":
                failures.append(path)
            elif path.suffix == ".h5":
                with suppress(FileNotFoundError):
                    found[path] = _stamp(path)
        return found, failures

    def _files(self) -> Iterator[Path]:
        with suppress(FileNotFoundError), os.scandir(self.packings) as entries:
            for entry in entries:
                if entry.is_dir():
                    yield from map(Path(entry.path).joinpath, os.listdir(entry.path))
                else:  # where a file manager or a user put it
                    yield Path(entry.path)

    def _places(self, names: Iterable[str] | None) -> tuple[dict[Place, Stamp], dict[Path, str]]:
        """The places of packings, in files of one and in shards; what is wrong with shards that cannot be read."""
        found, wrong = {Place(path): stamp for path, stamp in self.scan(names)[0].items()}, {}
        for path in self._shards():
            try:
                with open_file(path, self.unverified) as shard, refusing(path):
                    found.update((Place(path, inner), _stamp(path)) for inner in shard if isinstance(shard, Shard))
            except StoreError as error:
                wrong[path] = str(error.strerror)
        return found, wrong

    def _key(self, place: Place) -> str:
        return f"{place.path.name}:{place.inner}" if place.inner else f"{place.path.parent.name}/{place.path.name}"

    def indexed(self, path: Path) -> tuple[str, Stamp]:
        """What the index calls a file, and what tells whether it has changed."""
        return self._key(Place(path)), _stamp(path)

    def row(self, place: Place) -> Array:
        """The row of a packing from its file."""
        with open_file(place.path, self.unverified) as file, refusing(place.path):
            packing: Any = file[place.inner] if place.inner else file
            jam_of(packing, place.path)
            return row_of(packing)

    def content(self, names: Iterable[str] | None = None) -> Content:
        """The packings that are there: all, or those of some names and of shards."""
        stamps, damaged = self._places(names)
        known = index.read(self.index, {self._key(place): stamp for place, stamp in stamps.items()})
        fresh, rows = {}, []
        for place, stamp in list(stamps.items()):
            row = known.get(self._key(place))
            if row is None:
                try:
                    row = self.row(place).tobytes()
                except StoreError as error:
                    if os.path.exists(place.path):  # else removed by somebody meanwhile
                        damaged[place.path] = str(error.strerror)
                    del stamps[place]
                    continue
                fresh[self._key(place)] = stamp, row
            rows.append(row)
        if not self.unverified:
            index.add(self.index, fresh)
        return self._counted(np.frombuffer(b"".join(rows), ROW), list(stamps), damaged)

    def _is_home(self, name: str, place: Place) -> bool:
        """A packing has its own name, or the one that free() gave it."""
        return place.inner is None and place.path.parent.name == name[:2] and place.path.stem.partition("-")[0] == name

    def _counted(self, rows: Array, places: list[Place], damaged: dict[Path, str]) -> Content:
        """One packing for each protocol and seed: of this library's algorithm, under its own name, the oldest."""
        homes = [self._is_home(name.decode(), place) for name, place in zip(rows["name"], places)]
        order = sorted(
            range(len(rows)),
            key=lambda k: (rows["algorithm"][k] != ALGORITHM.encode(), not homes[k], rows["written"][k], str(places[k])),
        )
        counts: dict[tuple[bytes, int], int] = {}
        doubles: dict[Path, list[int]] = {}
        misnamed: dict[Path, str] = {}
        for k in order:
            claim = rows["protocol"][k], int(rows["seed"][k])
            if counts.setdefault(claim, k) != k:
                doubles.setdefault(places[k].path, []).append(k)
            elif not homes[k] and places[k].inner is None:
                misnamed[places[k].path] = f"{places[k].path} has another name than {_what(rows[k])}, which it holds"
        kept = sorted(counts.values(), key=lambda k: (int(rows["seed"][k]), rows["protocol"][k]))
        texts = {}
        for path, found in doubles.items():
            first = rows[found[0]]
            other = counts[first["protocol"], int(first["seed"])]
            more = f" and {len(found) - 1} more, which other files hold too" if len(found) > 1 else ""
            same = first[_BUILD].item() == rows[other][_BUILD].item()
            builds = "" if same else f"; made by {_build(first)} and by {_build(rows[other])}"
            texts[path] = f"{path} holds {_what(first)}, as {places[other].path} does, which counts{more}{builds}"
        return Content(rows[kept], [places[k] for k in kept], damaged, texts, misnamed)

    # ---- failures
    def failures(self, names: Iterable[str] | None = None) -> dict[str, dict[str, Any]]:
        """Records of failures by name: seed, protocol, status, text, version, commit, machine, time.

        One that cannot be read has the status "damaged_record", the seed -1 and no protocol. One of a packing that was made
        since is none.
        """
        found: dict[str, dict[str, Any]] = {}
        for path in self.scan()[1] if names is None else map(self.failure, names):
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

    def write_failure(self, name: str, protocol_id: str, seed: int, status: str, text: str) -> None:
        record = {"seed": seed, "protocol": protocol_id, "status": status, "text": text, "time": time.time()}
        data = json.dumps({**record, **provenance()}, indent=2).encode() + b"\n"
        write_file(self.failure(name), data, self.parts)


def _stamp(path: Path) -> Stamp:
    stat = path.stat()
    return Stamp(stat.st_size, stat.st_mtime_ns)


_BUILD = ["version", "commit", "library", "algorithm"]


def _what(row: Any) -> str:
    return f"the packing of seed {row['seed']} of protocol {row['protocol'].decode()}"


def _build(row: Any) -> str:
    version, commit, library, algorithm = (row[k].decode() for k in _BUILD)
    return f"{version} commit {commit or 'unknown'} library {library or 'unknown'} (algorithm {algorithm})"


def _protocol(path: Path, name: str, text: str | None = None) -> dict[str, Any]:
    with refusing(path):
        found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8") if text is None else text)
        if identity(found) != name:
            raise StoreError(
                22,
                f"{path} does not contain the protocol of its name: it was changed, or this version has other "
                "defaults. Give the protocol itself",
            )
    return found
