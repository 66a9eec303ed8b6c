"""The folder of an ensemble: where the files lie, what is there, and an index that only saves time.

    protocols/<id>.json          each protocol with every default spelled out
    packings/ab/<name>.h5        one packing; ab are the first two digits of its name
    packings/ab/<name>.json      a failure: status and text
    parts/                       unfinished files
    index.sqlite                 rows of packings by name, size and time of change; made again from the files at any time

The existence of a file is the only truth: a row of the index counts only for a file of the same size and time, and
with the checksum that was written with it. A file that is damaged is named and left out; nobody removes it unasked.
"""
from __future__ import annotations

import hashlib
import json
import math
import os
import sqlite3
import time
from dataclasses import fields
from pathlib import Path
from typing import Any, Iterator, NamedTuple

import numpy as np

from .._api.arrays import Array
from .._api.generated import CrunchReport
from .._formats.groups import refusing
from .._formats.provenance import provenance
from .._formats.read_packing import jam_of
from .._formats.records import dtype_of, unknown
from .._formats.replacing import check_writable, remove_abandoned
from .._formats.sealed import open_file
from .._formats.write_packing import write_file
from ..errors import StoreError
from .protocol import identity

_REPORT = dtype_of(CrunchReport)
_REPORT_FIELDS: tuple[str, ...] = _REPORT.names or ()
#: A row of a table: what distinguishes packings, the report of the crunch, and the crystal score (nan: not asked for).
ROW = np.dtype(
    [
        *[("seed", "i8"), ("name", "S32"), ("protocol", "S12"), ("version", "S24")],
        *[("commit", "S12"), ("library", "S16"), ("n", "i4"), ("dim", "i4")],
        *[(k, _REPORT[k]) for k in _REPORT_FIELDS],
        *[("crystal_score", "f8"), ("seconds_made", "f8"), ("written", "f8")],
    ]
)
FIELDS: tuple[str, ...] = ROW.names or ()


class Found(NamedTuple):
    """A file that is there."""

    path: str
    size: int
    changed: int


_CHECK = 16  # bytes of the checksum behind a row in the index


def row_of(file: Any, name: str) -> Array:
    """The row of a packing from its open file."""
    made, jam = np.zeros((), ROW), file["jam"]
    attributes = jam.attrs
    for key in ("seed", "protocol", "version", "written"):
        made[key] = attributes[key]
    for key, absent in (("commit", ""), ("library", ""), ("seconds_made", np.nan)):  # older files have no builds
        made[key] = attributes.get(key, absent)
    made["name"], made["n"] = name, len(jam["diameters"])
    made["dim"] = file["particles/spheres/position/value"].shape[2]
    for f in fields(CrunchReport):
        made[f.name] = unknown(str(f.type))
    made["packing_fraction"], made["diameter_mean"] = _of_spheres(file)
    if "report" in jam:
        report = jam["report"]
        for key in set(_REPORT_FIELDS) & set(report.dtype.names):
            made[key] = report[key]
    score = jam.get("analysis/crystal_score")
    made["crystal_score"] = np.nan if score is None or score.dtype.kind != "f" else score[()]
    return made


def _of_spheres(file: Any) -> tuple[float, float]:
    """Packing fraction and mean diameter, which need no crunch."""
    sigma, cell = file["jam/diameters"], file["particles/spheres/box/edges/value"][0]
    d = len(cell)
    ball = math.pi ** (d / 2) / math.gamma(d / 2 + 1) / 2**d
    return ball * float((sigma**d).sum()) / abs(float(np.linalg.det(cell))), float(sigma.mean())


def builds_of(rows: Array) -> tuple[str, ...]:
    """The builds of libjam that made the packings of a table: version, commit, digest of the library."""
    found = np.unique(rows[["version", "commit", "library"]])
    return tuple(
        " ".join(f"{word} {part.decode()}".strip() for word, part in zip(("", "commit", "library"), row) if part)
        for row in found
    )


class Folder:
    """Files of one folder. unverified: also those without a seal, or with one that does not fit."""

    def __init__(self, path: str | os.PathLike[str], unverified: bool = False) -> None:
        self.path, self.unverified = Path(path), unverified
        self.packings, self.parts = self.path / "packings", self.path / "parts"

    # ---- names
    def packing(self, name: str) -> Path:
        return self.packings / name[:2] / (name + ".h5")

    def failure(self, name: str) -> Path:
        return self.packings / name[:2] / (name + ".json")

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
    def protocol_names(self) -> list[str]:
        """Names of the protocols, in order."""
        return sorted(p.stem for p in (self.path / "protocols").glob("*.json"))

    def protocol(self, name: str) -> dict[str, Any]:
        """The protocol of a name, as it was written: later options have their defaults in it."""
        path = self.path / "protocols" / (name + ".json")
        with refusing(path):
            found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
            if identity(found) != name:
                raise StoreError(
                    22,
                    f"{path} does not contain the protocol of its name: it was changed, or this version has other "
                    "defaults. Give the protocol itself",
                )
        return found

    def keep_protocol(self, name: str, text: str) -> None:
        path = self.path / "protocols" / (name + ".json")
        if not path.exists():
            write_file(path, text.encode() + b"\n", self.parts)

    # ---- what is there
    def scan(self) -> tuple[dict[str, Found], dict[str, Found]]:
        """Packings and failures by name. A failure that was mended later is no failure any more."""
        done: dict[str, Found] = {}
        failed: dict[str, Found] = {}
        try:
            folders = [e.path for e in os.scandir(self.packings)]
        except FileNotFoundError:
            return done, failed
        for folder in folders:
            with os.scandir(folder) as entries:
                for entry in entries:
                    name, _, kind = entry.name.partition(".")
                    if kind in ("h5", "json"):
                        stat = entry.stat()
                        (done if kind == "h5" else failed)[name] = Found(entry.path, stat.st_size, stat.st_mtime_ns)
        return done, {k: v for k, v in failed.items() if k not in done}

    def rows(self, done: dict[str, Found] | None = None) -> tuple[Array, dict[str, str]]:
        """Rows of all packings that are there, by seed: from the index where it fits, else from the files.

        Files that cannot be read have no row: the second answer has a text for the name of each.
        """
        done = self.scan()[0] if done is None else done
        blobs, fresh = [], []
        left_out: dict[str, str] = {}
        known = self._index_read()
        for name, found in done.items():
            size, changed, blob = known.get(name, (0, 0, b""))
            if (size, changed) != found[1:] or not isinstance(blob, bytes):
                blob = b""
            if blob[ROW.itemsize :] != _checksum(name, found.size, found.changed, blob[: ROW.itemsize]):
                try:
                    row = self.row_from_file(name, found.path)
                except StoreError as error:
                    if os.path.exists(found.path):  # else removed by somebody since the scan
                        left_out[name] = str(error.strerror)
                    continue
                blob = row + _checksum(name, found.size, found.changed, row)
                fresh.append((name, found.size, found.changed, row))
            blobs.append(blob[: ROW.itemsize])
        if not self.unverified:
            self.index_add(fresh)
        rows = np.frombuffer(b"".join(blobs), ROW)
        return rows[np.argsort(rows["seed"], kind="stable")], left_out

    def row_from_file(self, name: str, path: str | os.PathLike[str]) -> bytes:
        """The row of a packing from its file."""
        with open_file(path, self.unverified) as file, refusing(path):
            jam_of(file, path)
            return row_of(file, name).tobytes()

    # ---- index
    def _index(self) -> sqlite3.Connection:
        base = sqlite3.connect(self.path / "index.sqlite", timeout=5.0)
        version = hash_of_row()
        if base.execute("PRAGMA user_version").fetchone()[0] != version:
            base.executescript(
                "DROP TABLE IF EXISTS rows;"
                "CREATE TABLE rows (name TEXT PRIMARY KEY, size INTEGER, changed INTEGER, row BLOB) WITHOUT ROWID;"
                f"PRAGMA user_version = {version};"
            )
        return base

    def _index_read(self) -> dict[str, tuple[int, int, bytes]]:
        if not (self.path / "index.sqlite").exists():
            return {}
        try:
            base = self._index()
            try:
                return {r[0]: r[1:] for r in base.execute("SELECT name, size, changed, row FROM rows")}
            finally:
                base.close()
        except sqlite3.Error:
            return {}  # busy or damaged: the files say all

    def index_add(self, rows: list[tuple[str, int, int, bytes]]) -> None:
        """Adds name, size, time of change and row. Nothing is lost where that cannot be: the files are read instead."""
        if not rows:
            return
        try:
            base = self._index()
            try:
                with base:
                    checked = [(k, size, at, row + _checksum(k, size, at, row)) for k, size, at, row in rows]
                    base.executemany("INSERT OR REPLACE INTO rows VALUES (?, ?, ?, ?)", checked)
            finally:
                base.close()
        except sqlite3.DatabaseError as error:
            if "malformed" in str(error) or "not a database" in str(error):
                (self.path / "index.sqlite").unlink(missing_ok=True)

    # ---- failures
    def failures(self, failed: dict[str, Found] | None = None) -> Iterator[dict[str, Any]]:
        """Records of failures: seed, protocol, status, text, version, commit, machine, time.

        One that cannot be read has the status "damaged_record", the seed -1 and no protocol.
        """
        for found in (self.scan()[1] if failed is None else failed).values():
            try:
                with refusing(found.path), open(found.path, encoding="utf-8") as file:
                    record = json.load(file)
                    record = {**record, "seed": int(record["seed"]), "protocol": str(record["protocol"])}
            except StoreError as error:
                record = {"seed": -1, "protocol": "", "status": "damaged_record", "text": error.strerror, "time": 0.0}
            yield record

    def write_failure(self, name: str, protocol_id: str, seed: int, status: str, text: str) -> None:
        record = {"seed": seed, "protocol": protocol_id, "status": status, "text": text, "time": time.time()}
        data = json.dumps({**record, **provenance()}, indent=2).encode() + b"\n"
        write_file(self.failure(name), data, self.parts)


def hash_of_row() -> int:
    """A number that changes with ROW and with what stands for unknown: an index of another layout is made again."""
    absent = [unknown(str(f.type)) for f in fields(CrunchReport)]
    return int.from_bytes(hashlib.sha256(f"{ROW.descr} {absent} {_CHECK}".encode()).digest()[:3], "big") + 1


def _checksum(name: str, size: int, changed: int, row: bytes) -> bytes:
    """Behind a row in the index: a changed row, or one of another file, is read from its file again."""
    return hashlib.sha256(f"{name} {size} {changed} ".encode() + row).digest()[:_CHECK]
