"""index.bin of an ensemble's folder: rows of the table, each by a digest of its file's place, size and time of change.

It only saves time. It lies in the folder and may be anybody's: it is read as bytes of fixed length behind their checksum,
and a row counts only for the file that its digest names. Some rows are compared with their files each time (folder.py).
"""
from __future__ import annotations

import contextlib
import hashlib
import os
from dataclasses import fields
from pathlib import Path
from typing import Mapping

from .._api.generated import CrunchReport
from .._formats.records import unknown
from .._formats.replacing import open_regular
from .._formats.write_packing import write_file
from .row import ROW

_KEY = 32  # bytes of a digest
_LARGEST = 1 << 30  # bytes; 1e5 packings take 70 MB


def key_of(path: Path, inner: str | None) -> bytes:
    """What the index calls a packing, of a file as it is now."""
    stat = path.stat()
    text = f"{path.parent.name}/{path.name}:{inner or ''} {stat.st_size} {stat.st_mtime_ns}"
    return hashlib.sha256(text.encode(errors="surrogateescape")).digest()


def _checksum(rows: bytes) -> bytes:
    """Changes with the rows, with their layout, and with what stands for unknown in them."""
    absent = [unknown(str(f.type)) for f in fields(CrunchReport)]
    return hashlib.sha256(f"{ROW.descr} {absent}".encode() + rows).digest()


def read(path: Path) -> dict[bytes, bytes]:
    """Rows by key; none where it is not the index that was written."""
    try:
        with open_regular(path) as file:
            data = file.read() if os.fstat(file.fileno()).st_size <= _LARGEST else b""
    except OSError:
        return {}
    if data[:_KEY] != _checksum(data[_KEY:]):
        return {}
    size = _KEY + ROW.itemsize
    return {data[k : k + _KEY]: data[k + _KEY : k + size] for k in range(_KEY, len(data), size)}


def write(path: Path, rows: Mapping[bytes, bytes]) -> None:
    """Nothing is lost where that cannot be."""
    data = b"".join(key + row for key, row in rows.items())
    with contextlib.suppress(OSError):
        if path.is_symlink():  # somebody's: what it leads to is not replaced
            path.unlink()
        write_file(path, _checksum(data) + data)
