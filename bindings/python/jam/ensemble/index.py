"""index.sqlite of an ensemble's folder: rows of the table by place, size and time of change. It only saves time.

It lies in the folder and may be anybody's, so it is asked for nothing but rows of our own table, of which each counts only
for a file of the same size and time and with the checksum that was written with it.
"""
from __future__ import annotations

import contextlib
import hashlib
import sqlite3
from pathlib import Path
from typing import Any, Callable, Mapping, NamedTuple

from .row import ROW, hash_of_row

_CHECK = 16  # bytes of the checksum behind a row
_SQL = "CREATE TABLE rows (name TEXT PRIMARY KEY, size INTEGER, changed INTEGER, row BLOB) WITHOUT ROWID"


class Stamp(NamedTuple):
    """What tells whether a file has changed."""

    size: int
    changed: int


def _checksum(place: str, stamp: Stamp, row: bytes) -> bytes:
    return hashlib.sha256(f"{place} {stamp.size} {stamp.changed} ".encode() + row).digest()[:_CHECK]


def _ask(path: Path, question: Callable[[sqlite3.Connection], Any]) -> Any:
    """The answer to a question to our table, made anew in place of any other layout, view or trigger. None where the file
    is busy, may not be written or is no database, which goes: the files of the folder say all.
    """
    try:
        with contextlib.closing(sqlite3.connect(path, timeout=5.0)) as base:
            there = base.execute("SELECT type, name, sql FROM sqlite_master LIMIT 2").fetchall()
            if base.execute("PRAGMA user_version").fetchone()[0] == hash_of_row() and there == [("table", "rows", _SQL)]:
                return question(base)
        _remove(path)
        with contextlib.closing(sqlite3.connect(path, timeout=5.0)) as base:
            base.executescript(f"{_SQL}; PRAGMA user_version = {hash_of_row()};")
            return question(base)
    except sqlite3.DatabaseError as error:
        if "malformed" in str(error) or "not a database" in str(error):
            _remove(path)
        return None


def _remove(path: Path) -> None:
    for ending in ("", "-journal", "-wal", "-shm"):
        path.with_name(path.name + ending).unlink(missing_ok=True)


def read(path: Path, places: Mapping[str, Stamp]) -> dict[str, bytes]:
    """Rows of these places, as far as they are known and right."""
    rows: dict[str, bytes] = {}

    def collect(base: sqlite3.Connection) -> None:
        asked = "SELECT row FROM rows WHERE name = ? AND typeof(row) = 'blob' AND length(row) = ?"
        for place, stamp in places.items():
            for (blob,) in base.execute(asked, (place, ROW.itemsize + _CHECK)):
                if blob[-_CHECK:] == _checksum(place, stamp, blob[:-_CHECK]):
                    rows[place] = blob[:-_CHECK]

    if path.exists():
        _ask(path, collect)
    return rows


def add(path: Path, rows: Mapping[str, tuple[Stamp, bytes]]) -> None:
    """Adds rows. Nothing is lost where that cannot be."""

    def insert(base: sqlite3.Connection) -> None:
        made = [(place, *stamp, row + _checksum(place, stamp, row)) for place, (stamp, row) in rows.items()]
        with base:
            base.executemany("INSERT OR REPLACE INTO rows VALUES (?, ?, ?, ?)", made)

    if rows:
        _ask(path, insert)
