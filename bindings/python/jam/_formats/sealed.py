"""Reads files of packings by their seal, which is checked before a byte is used; see seal.py."""
from __future__ import annotations

import contextlib
import json
import os
import re
from typing import IO, Any, Callable, Iterator, Mapping, Sequence

import numpy as np

from .._api.arrays import Array
from ..errors import StoreError
from .content import SCHEMA, Packing, damaged, refusing
from .replacing import open_regular
from .seal import BEGIN, USER_BLOCK, check_names, digest, digest_of_rest, head_of, size_of, type_of

_LARGEST_INDEX = 1 << 22  # bytes; 1000 packings of a shard take 0.1 MB
#: Names of the packings of a shard, None for a file of one; and what reads one of them.
Content = tuple[Sequence[str] | None, Callable[[str | None], Packing]]


def _small(digits: str) -> int:
    if len(digits) > 20:
        raise ValueError("a number has more than 20 digits")
    return int(digits)


def _largest() -> int:
    """Bytes of the largest file that is read: a quarter of the machine's memory, as arrays and system are made of it."""
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 4


class _File:
    """An open file: bytes at a place, and what the seal says of them."""

    def __init__(self, path: Any, file: IO[bytes], limit: float | None) -> None:
        self.path, self.file = path, file
        self.length = os.fstat(file.fileno()).st_size
        most = _largest() if limit is None else limit
        if self.length > most:
            raise StoreError(
                27,
                f"{path} has {self.length:.3g} bytes, at most {most:.3g} are read: give memory_limit= if the file is your own",
            )

    def read(self, at: int, size: int) -> bytearray:
        if not (isinstance(at, int) and isinstance(size, int) and 0 <= at and 0 <= size <= self.length - at):
            raise ValueError(f"{size} bytes at {at} lie outside of the file")
        data, _ = bytearray(size), self.file.seek(at)
        if self.file.readinto(data) != size:  # type: ignore[attr-defined]
            raise ValueError("the file got shorter while it was read")
        return data

    def index(self, place: Sequence[Any]) -> dict[str, Any]:
        """An index, checked against its digest."""
        at, size, expected = place
        if not 0 < size <= _LARGEST_INDEX:
            raise ValueError(f"an index of {size} bytes")
        data = self.read(at, size)
        if digest(data) != expected:
            raise damaged(self.path, "the index differs from its checksum")
        return json.loads(bytes(data), parse_int=_small)

    def array(self, name: str, at: int, shape: Sequence[int], kind: Any, expected: str) -> Array:
        if not all(isinstance(k, int) and 0 <= k <= self.length for k in shape):
            raise ValueError(f"{name} has the shape {shape}")
        data = self.read(at, size_of(shape, type_of(kind)))
        if digest(data) != expected:
            raise damaged(self.path, f"{name} differs from its checksum")
        return np.frombuffer(data, type_of(kind)).reshape(shape)

    def packing(self, index: Mapping[str, Any]) -> Packing:
        data: Mapping[str, Any] = index["data"]
        check_names(data)
        if sum(size_of(shape, type_of(kind)) for _, shape, kind, _ in data.values()) > self.length:
            raise ValueError("the arrays together are longer than the file")
        return Packing({name: self.array(name, *entry) for name, entry in data.items()}, index["attributes"])

    def content(self) -> Content:
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
            places = dict(index["packings"])
            return list(places), lambda name: self.packing(self.index(places[name]))

        def one(_: str | None) -> Packing:
            made = self.packing(index)  # names what is damaged, where that is an array
            if digest_of_rest(self.file) != whole:
                raise damaged(self.path, "the file differs from its checksum, though its arrays are intact")
            return made

        return None, one


def _what_it_is(head: bytes) -> str:
    if b"\x89HDF\r\n\x1a\n" in head:
        return (
            "is HDF5 without the seal of jam: another program wrote it. h5py reads its arrays, and System.from_arrays takes "
            "positions, diameters and cell vectors"
        )
    if head.startswith(b"jamstat"):
        return "is a checkpoint of libjam: System.from_checkpoint reads it"
    return "is no file of System.save; System.read reads XYZ, LAMMPS and other text" if head else "is empty"


@contextlib.contextmanager
def _opened(path: str | os.PathLike[str], memory_limit: float | None = None) -> Iterator[Content]:
    with refusing(path), open_regular(path) as bytes_:
        yield _File(path, bytes_, memory_limit).content()


def names_in(path: str | os.PathLike[str]) -> Sequence[str]:
    """Names of the packings of a shard; none of a file of one packing."""
    with _opened(path) as (names, _):
        return names or ()


def read_packing(
    path: str | os.PathLike[str],
    name: str | None = None,
    memory_limit: float | None = None,
) -> Packing:
    """A packing from its file, or by its name from a shard.

    Parameters
    ----------
    memory_limit : float, optional
        Bytes of the largest file that is read; default a quarter of the machine's memory.
    """
    with _opened(path, memory_limit) as (names, packing):
        if names is not None and name is None:
            raise StoreError(22, f"{path} is a shard of {len(names)} packings: name one, e.g. name={names[0]!r}")
        if name is not None and name not in (names or ()):
            raise StoreError(22, f"{path} holds no packing {name!r}")
        found = packing(name)
        if "schema" not in found.attributes.get("jam", ()):
            raise StoreError(22, f"{path} contains no packing of jam (no group `jam`)")
        if int(found.jam["schema"]) > SCHEMA:
            raise StoreError(22, f"{path}: schema {found.jam['schema']} is newer than the schema {SCHEMA} of this jam")
        return found
