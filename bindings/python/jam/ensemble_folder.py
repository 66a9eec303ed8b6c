"""The folder of an ensemble: where the files lie, what is there, and an index that only saves time.

    protocols/<id>.json          each protocol with every default spelled out
    packings/ab/<name>.h5        one packing; ab are the first two digits of its name
    packings/ab/<name>.json      a failure: status and text
    parts/                       unfinished files
    index.sqlite                 rows of packings by name, size and time of change; made again from the files at any time

The existence of a file is the only truth: a row of the index counts only for a file of the same size and time.
"""
from __future__ import annotations

import hashlib
import json
import os
import socket
import sqlite3
import time
from pathlib import Path
from typing import Any, Iterator, NamedTuple

import numpy as np

from ._types import Array
from . import store
from ._generated import REPORTS

STALE_SECONDS = (
    86400.0  # an unfinished file of another machine is removed after a day; of this one when its writer is gone
)
_REPORT = store._dtype(REPORTS["jam_crunch_report"])
_REPORT_FIELDS: tuple[str, ...] = _REPORT.names or ()
#: A row of a table: what tells packings apart, the report of the crunch, and the crystal score (nan: not asked for).
ROW = np.dtype(
    [
        *[("seed", "i8"), ("name", "S32"), ("protocol", "S12"), ("version", "S24"), ("n", "i4"), ("dim", "i4")],
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


def row_of(jam: Any, name: str) -> Array:
    """The row of a packing from its group `jam`."""
    made = np.zeros((), ROW)
    for key in ("seed", "protocol", "version", "written"):
        made[key] = jam.attrs[key]
    made["seconds_made"] = jam.attrs.get("seconds_made", np.nan)
    made["name"], made["n"] = name, jam["diameters"].shape[0]
    made["dim"] = jam.parent["particles/spheres/box"].attrs["dimension"]
    if "report" in jam:
        report = jam["report"][()]
        for key in set(_REPORT_FIELDS) & set(report.dtype.names):
            made[key] = report[key]
    score = jam.get("analysis/crystal_score")
    made["crystal_score"] = np.nan if score is None or score.dtype.kind != "f" else score[()]
    return made


class Folder:
    """Files of one folder."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
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
            probe = self.parts / f".probe.{socket.gethostname()}.{os.getpid()}.part"
            probe.write_bytes(b"")
            probe.unlink()
        except OSError as error:
            raise store.StoreError(
                error.errno, f"{self.path}: this folder cannot be written: {error.strerror}"
            ) from error
        self.remove_stale_parts()

    def remove_stale_parts(self) -> None:
        """Removes unfinished files whose writer is gone."""
        for file in self.parts.iterdir():
            if _is_stale(file):
                file.unlink(missing_ok=True)

    # ---- protocols
    def protocols(self) -> dict[str, dict[str, Any]]:
        """Protocols by name."""
        found = sorted((self.path / "protocols").glob("*.json"))
        return {p.stem: json.loads(p.read_text(encoding="utf-8")) for p in found}

    def keep_protocol(self, name: str, text: str) -> None:
        path = self.path / "protocols" / (name + ".json")
        if not path.exists():
            store.write_file(path, text.encode() + b"\n", self.parts)

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

    def rows(self, done: dict[str, Found] | None = None) -> Array:
        """Rows of all packings that are there, by seed: from the index where it fits, else from the files."""
        done = self.scan()[0] if done is None else done
        blobs, unknown, fresh = [], [], []
        known = self._index_read()
        for name, found in done.items():
            size, changed, blob = known.get(name, (0, 0, b""))
            if size == found.size and changed == found.changed:
                blobs.append(blob)
            else:
                unknown.append((name, found))
        for name, found in unknown:
            blob = self._row_from_file(name, found.path)
            if blob:
                blobs.append(blob)
                fresh.append((name, found.size, found.changed, blob))
        self.index_add(fresh)
        rows = np.frombuffer(b"".join(blobs), ROW)
        return rows[np.argsort(rows["seed"], kind="stable")]

    @staticmethod
    def _row_from_file(name: str, path: str) -> bytes:
        try:
            with store.open_file(path) as file:
                return row_of(store._jam(file, path), name).tobytes()
        except store.StoreError:
            if os.path.exists(path):
                raise
            return b""  # removed by somebody since the scan

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
        """Adds rows to the index. Nothing is lost where that cannot be: the files are read instead."""
        if not rows:
            return
        try:
            base = self._index()
            try:
                with base:
                    base.executemany("INSERT OR REPLACE INTO rows VALUES (?, ?, ?, ?)", rows)
            finally:
                base.close()
        except sqlite3.DatabaseError as error:
            if "malformed" in str(error) or "not a database" in str(error):
                (self.path / "index.sqlite").unlink(missing_ok=True)

    # ---- failures
    def failures(self, failed: dict[str, Found] | None = None) -> Iterator[dict[str, Any]]:
        """Records of failures: seed, protocol, status, text, version, machine, time."""
        for found in (self.scan()[1] if failed is None else failed).values():
            with open(found.path, encoding="utf-8") as file:
                yield json.load(file)

    def write_failure(self, name: str, protocol_id: str, seed: int, status: str, text: str) -> None:
        record = {"seed": seed, "protocol": protocol_id, "status": status, "text": text, "time": time.time()}
        data = json.dumps({**record, **store.provenance()}, indent=2).encode() + b"\n"
        store.write_file(self.failure(name), data, self.parts)


def hash_of_row() -> int:
    """A number that changes with ROW: an index of another layout is made again."""
    return int.from_bytes(hashlib.sha256(str(ROW.descr).encode()).digest()[:3], "big") + 1


def _is_stale(file: Path) -> bool:
    """Whether the writer of an unfinished file is gone: its name ends in machine.process.random.part."""
    try:
        *_, process, _, part = file.name.split(".")
        age = time.time() - file.stat().st_mtime
    except (ValueError, OSError):
        return False
    if part != "part":
        return False
    if f".{socket.gethostname()}." not in file.name:
        return age > STALE_SECONDS
    try:
        os.kill(int(process), 0)
    except ProcessLookupError:
        return True
    except (ValueError, PermissionError):
        pass
    return False
