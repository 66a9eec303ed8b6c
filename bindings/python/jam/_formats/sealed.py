"""Reads files of packings by their seal, which is checked before a byte is used; see seal.py."""
from __future__ import annotations

import contextlib
import hashlib
import json
import os
import re
from typing import Any, Iterator, Mapping, Sequence

import numpy as np

from .._api.arrays import Array
from ..errors import StoreError
from . import unsealed
from .groups import Group, Shard, damaged, refusing
from .replacing import open_regular
from .seal import BEGIN, USER_BLOCK, check_names, head_of, size_of, type_of

_LARGEST_INDEX = 1 << 22  # bytes; 1000 packings of a shard take 0.1 MB
_CHUNK = 1 << 20


def _small(digits: str) -> int:
    if len(digits) > 20:
        raise ValueError("a number has more than 20 digits")
    return int(digits)


def _largest() -> int:
    """Bytes of the largest file that is read: a quarter of the machine's memory, as arrays and system are made of it."""
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 4


class _File:
    """An open file: bytes at a place, and what the seal says of them."""

    def __init__(self, path: Any, descriptor: int, limit: float | None) -> None:
        self.path, self.descriptor = path, descriptor
        self.length = os.fstat(descriptor).st_size
        most = _largest() if limit is None else limit
        if self.length > most:
            raise StoreError(
                27,
                f"{path} has {self.length:.3g} bytes, at most {most:.3g} are read: give memory_limit= if the file is your own",
            )

    def read(self, at: int, size: int) -> memoryview:
        if not (isinstance(at, int) and isinstance(size, int) and 0 <= at and 0 <= size <= self.length - at):
            raise ValueError(f"{size} bytes at {at} lie outside of the file")
        data = memoryview(bytearray(size))
        done = 0
        while done < size:
            count = os.preadv(self.descriptor, [data[done : done + (1 << 30)]], at + done)
            if count == 0:
                raise ValueError("the file got shorter while it was read")
            done += count
        return data

    def digest(self) -> str:
        """SHA-256 of all behind the user block."""
        found, at = hashlib.sha256(), USER_BLOCK
        while at < self.length:
            size = min(_CHUNK, self.length - at)
            found.update(self.read(at, size))
            at += size
        return found.hexdigest()

    def index(self, place: Sequence[Any]) -> dict[str, Any]:
        """An index, checked against its digest."""
        at, size, digest = place
        if not 0 < size <= _LARGEST_INDEX:
            raise ValueError(f"an index of {size} bytes")
        data = self.read(at, size)
        if hashlib.sha256(data).hexdigest() != digest:
            raise damaged(self.path, "the index differs from its checksum")
        found: dict[str, Any] = json.loads(bytes(data), parse_int=_small)
        return found

    def group(self, index: Mapping[str, Any]) -> Group:
        data: Mapping[str, Any] = index["data"]
        check_names(data)
        if sum(size_of(shape, type_of(kind)) for _, shape, kind, _ in data.values()) > self.length:
            raise ValueError("the arrays together are longer than the file")

        def fetch(name: str) -> Array:
            with refusing(self.path):
                at, shape, kind, digest = data[name]
                if not all(isinstance(k, int) and 0 <= k <= self.length for k in shape):
                    raise ValueError(f"{name} has the shape {shape}")
                bytes_ = self.read(at, size_of(shape, type_of(kind)))
                if hashlib.sha256(bytes_).hexdigest() != digest:
                    raise damaged(self.path, f"{name} differs from its checksum")
                found: Array = np.frombuffer(bytes_, type_of(kind)).reshape(shape)
                return found

        return Group(list(data), fetch, index["attributes"])

    def opened(self) -> tuple[Group | None, dict[str, Any]]:
        """The packing of the file; of a shard None, and the places of its packings' indices."""
        head = bytes(self.read(0, min(USER_BLOCK, self.length)))
        if not head.startswith(BEGIN):
            raise StoreError(22, f"{self.path} {_what_it_is(head)}")
        found = re.search(rb"index (\d{20}) (\d{20})\nindex sha256 ([0-9a-f]{64})\nsha256 ([0-9a-f]{64})\n", head)
        if not found:
            raise damaged(self.path, "its first 512 bytes are not a seal of this version of jam")
        place, whole = [int(found[1]), int(found[2]), found[3].decode()], found[4].decode()
        if head != head_of(self.length, place, whole):
            raise damaged(self.path, f"its seal does not fit a file of {self.length} bytes")
        index = self.index(place)
        if "packings" in index:
            return None, dict(index["packings"])
        if self.digest() != whole:
            for name in (group := self.group(index)).all:  # names what is damaged, where that is an array
                group[name]
            raise damaged(self.path, "the file differs from its checksum, though its arrays are intact")
        return self.group(index), {}


def _what_it_is(head: bytes) -> str:
    if b"\x89HDF\r\n\x1a\n" in head:
        return (
            "is HDF5 without the seal of jam: an older version or another program wrote it. If the file is your own, "
            "unverified=True reads it, and save() seals it"
        )
    return "is no file of packings"


@contextlib.contextmanager
def open_file(
    path: str | os.PathLike[str], unverified: bool = False, memory_limit: float | None = None
) -> Iterator[Group | Shard]:
    """Opens a file of packings: the content of one as a Group, several as a Shard.

    Parameters
    ----------
    unverified : bool
        Reads files without a seal, or with one that does not fit, by libhdf5. Only for files of your own: libhdf5 can
        be ended or stopped by a crafted file. Links, external data, filters and sizes beyond the file are refused.
    memory_limit : float, optional
        Bytes of the largest file that is read; default a quarter of the machine's memory.
    """
    with refusing(path):
        bytes_ = open_regular(path)
    with bytes_:
        with refusing(path):
            opened = _content(_File(path, bytes_.fileno(), memory_limit), unverified)
        yield opened


def _content(file: _File, unverified: bool) -> Group | Shard:
    if unverified:
        return unsealed.content(file.path, file.read(0, file.length))
    group, places = file.opened()
    if group is not None:
        return group
    return Shard(list(places), lambda name: file.group(file.index(places[name])))
