"""The container of packings: an HDF5 file for every program, and a seal that jam checks before it uses a byte.

    bytes 0 to 511    text: length of the file, place and SHA-256 of the index, SHA-256 of all bytes from 512 on
    bytes from 512    HDF5, which every HDF5 program opens: the text is a user block to it
    `seal` in HDF5    the index, JSON: of each dataset its place, type, shape and SHA-256; attributes of the groups

Reading goes by the index and never by libhdf5: damaged or crafted structures of HDF5 can end the process, hang, or lead
to other files. The index is small, names nothing outside of the file, and each of its numbers is checked. A file of one
packing is checked as a whole. Of a shard, which holds many, only what is read is checked, and the length.
"""
from __future__ import annotations

import contextlib
import hashlib
import io
import json
import math
import mmap
import os
import re
import stat
from typing import Any, Callable, Collection, Iterator, Mapping, Sequence

import numpy as np

from .._api.arrays import Array
from .._api.errors import StoreError

try:
    import h5py
except ImportError as error:  # pragma: no cover
    raise ImportError("packings are stored by h5py: install python3-h5py") from error

USER_BLOCK = 512
INDEX = "seal"
_LARGEST_INDEX = 1 << 22  # bytes; 1000 packings of a shard take 0.1 MB
_MOST_ARRAYS, _DEEPEST = 4096, 12  # of a packing: bounds what a crafted index can ask for
_CHUNK = 1 << 20
_BEGIN = b"jam packing file"
_UNWRITTEN = "0" * 64
_KIND = re.compile(r"[<>|][biufcS][0-9]{1,9}")


def damaged(path: Any, what: str) -> StoreError:
    """The error for a file that is not what jam wrote."""
    return StoreError(
        5,
        f"{path} is damaged, or was changed by another program: {what}. Use another copy or make it again. "
        "unverified=True reads a file of your own without this check",
    )


@contextlib.contextmanager
def refusing(path: Any) -> Iterator[None]:
    """Whatever the content of a file leads to inside is one StoreError."""
    try:
        yield
    except StoreError:
        raise
    except (KeyError, ValueError, TypeError, IndexError, AttributeError, RecursionError, OverflowError) as error:
        raise damaged(path, f"{type(error).__name__}: {error}") from error
    except OSError as error:
        raise StoreError(error.errno or 5, f"{path} cannot be read: {error.strerror or error}") from error


# ---- writing
def _head(length: int, index: Sequence[Any], whole: str) -> bytes:
    """The user block. Every byte of it follows from the file, so that it is checked by making it again."""
    text = (
        f"{_BEGIN.decode()}, format 1\nlength {length:020d}\nindex {index[0]:020d} {index[1]:020d}\n"
        f"index sha256 {index[2]}\nsha256 {whole}\n"
        f"From byte {USER_BLOCK} on this is HDF5, for every program that reads HDF5.\n"
        "jam refuses it after any change. To check the bytes without jam:\n"
        f"tail -c +{USER_BLOCK + 1} FILE | sha256sum\n"
    )
    return text.encode().ljust(USER_BLOCK - 1) + b"\n"


def _plain_value(value: Any) -> Any:
    """An attribute as JSON holds it."""
    value = value.tolist() if hasattr(value, "tolist") else value
    if isinstance(value, list):
        return [_plain_value(v) for v in value]
    return value.decode() if isinstance(value, bytes) else value


def _entry(path: str, node: Any) -> list[Any]:
    """Place, shape, type and (later) digest of a dataset."""
    kind, plan = node.dtype, node.id.get_create_plist()
    if kind.hasobject or plan.get_layout() != h5py.h5d.CONTIGUOUS:
        raise TypeError(f"{path}: only arrays of numbers and text of fixed length are stored, not {kind}")
    text: Any = kind.str if kind.names is None else [[k, kind[k].str] for k in kind.names]
    return [int(node.id.get_offset()) if node.nbytes else USER_BLOCK, list(node.shape), text, _UNWRITTEN]


def _index_of(group: Any) -> dict[str, Any]:
    found: dict[str, Any] = {"data": {}, "attributes": {}}

    def add(path: str, node: Any) -> None:
        if isinstance(node, h5py.Dataset):
            found["data"][path] = _entry(path, node)
        elif len(node.attrs):
            found["attributes"][path] = {k: _plain_value(v) for k, v in node.attrs.items()}

    group.visititems(add)
    _check_names(found["data"])
    return found


def _check_names(names: Collection[str]) -> None:
    if len(names) > _MOST_ARRAYS or any(name.count("/") > _DEEPEST for name in names):
        raise ValueError(f"more than {_MOST_ARRAYS} arrays, or groups nested more than {_DEEPEST} deep")


def _digest(image: memoryview, at: int, size: int) -> str:
    return hashlib.sha256(image[at : at + size]).hexdigest()


def seal(memory: Any, fill: Callable[[Any], Sequence[str]]) -> None:
    """Writes a sealed file.

    Parameters
    ----------
    memory : io.BytesIO, or a file open to be written and read
        Takes the bytes.
    fill : callable
        Writes the content into an h5py.File: contiguous arrays, text of fixed length. Of a shard it returns the groups
        that have an index each; of one packing none.
    """
    places: list[tuple[dict[str, Any], list[Any]]] = []  # each index with its place, size and digest

    def keep(group: Any, index: dict[str, Any]) -> list[Any]:
        data = np.frombuffer(json.dumps(index).encode(), np.uint8)  # digests come later and change no length
        node = group.create_dataset(INDEX, data=data)
        places.append((index, [int(node.id.get_offset()), data.size, _UNWRITTEN]))
        return places[-1][1]

    with h5py.File(memory, "w", userblock_size=USER_BLOCK, libver="earliest") as file:  # every HDF5 reads it
        packings = fill(file)
        parts = {name: keep(file[name], _index_of(file[name])) for name in packings}
        keep(file, {"packings": parts} if packings else _index_of(file))
    memory.flush()
    image = memory.getbuffer() if isinstance(memory, io.BytesIO) else memoryview(mmap.mmap(memory.fileno(), 0))
    for index, (at, size, _) in places:
        if image[at : at + size] != json.dumps(index).encode():
            raise StoreError(5, f"HDF5 {h5py.version.hdf5_version} writes a file layout that jam cannot seal")
    for index, place in places:
        for entry in index.get("data", {}).values():
            entry[3] = _digest(image, entry[0], _size(entry[1], _type(entry[2])))
        at, size, _ = place
        image[at : at + size] = json.dumps(index).encode()
        place[2] = _digest(image, at, size)
    image[:USER_BLOCK] = _head(len(image), places[-1][1], _digest(image, USER_BLOCK, len(image)))


# ---- reading
def _type(text: Any) -> np.dtype[Any]:
    """A type from an index: numbers, text of fixed length, or a flat record of them."""
    fields = [("", text)] if isinstance(text, str) else text
    for _, kind in fields:
        if not _KIND.fullmatch(kind):
            raise ValueError(f"{kind!r} is not a type of numbers or text")
    described: Any = text if isinstance(text, str) else [(str(k), v) for k, v in text]
    made: np.dtype[Any] = np.dtype(described)
    if made.itemsize == 0:
        raise ValueError(f"{text!r} has no bytes")
    return made


def _size(shape: Sequence[int], kind: np.dtype[Any]) -> int:
    return math.prod(shape) * kind.itemsize


def _small(digits: str) -> int:
    if len(digits) > 20:
        raise ValueError("a number has more than 20 digits")
    return int(digits)


def _largest() -> int:
    """Bytes of the largest file that is read: a quarter of the machine's memory, as arrays and system are made of it."""
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 4


class Group(Mapping[str, Any]):
    """Datasets and groups by name, as of h5py: arrays are read, and checked, when asked for."""

    def __init__(self, names: Sequence[str], fetch: Callable[[str], Array], attributes: Mapping[str, Any], at: str = ""):
        self._all, self._fetch, self._attributes, self._at = names, fetch, attributes, at
        inside = [name[len(at) :] for name in names if name.startswith(at)]
        self._datasets, self._inside = set(inside), list(dict.fromkeys(name.partition("/")[0] for name in inside))

    @property
    def attrs(self) -> dict[str, Any]:
        """Attributes of this group."""
        return dict(self._attributes.get(self._at.rstrip("/"), {}))

    def __getitem__(self, name: str) -> Any:
        if name in self._datasets:
            return self._fetch(self._at + name)
        if name not in self:
            raise KeyError(name)
        return Group(self._all, self._fetch, self._attributes, f"{self._at}{name}/")

    def __contains__(self, name: object) -> bool:
        return name in self._datasets or any(d.startswith(f"{name}/") for d in self._datasets)

    def __iter__(self) -> Iterator[str]:
        return iter(self._inside)

    def __len__(self) -> int:
        return len(self._inside)


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
        _check_names(data)
        if sum(_size(shape, _type(kind)) for _, shape, kind, _ in data.values()) > self.length:
            raise ValueError("the arrays together are longer than the file")

        def fetch(name: str) -> Array:
            with refusing(self.path):
                at, shape, kind, digest = data[name]
                if not all(isinstance(k, int) and 0 <= k <= self.length for k in shape):
                    raise ValueError(f"{name} has the shape {shape}")
                bytes_ = self.read(at, _size(shape, _type(kind)))
                if hashlib.sha256(bytes_).hexdigest() != digest:
                    raise damaged(self.path, f"{name} differs from its checksum")
                found: Array = np.frombuffer(bytes_, _type(kind)).reshape(shape)
                return found

        return Group(list(data), fetch, index["attributes"])

    def opened(self) -> tuple[Group | None, dict[str, Any]]:
        """The packing of the file; of a shard None, and the places of its packings' indices."""
        head = bytes(self.read(0, min(USER_BLOCK, self.length)))
        if not head.startswith(_BEGIN):
            raise StoreError(22, f"{self.path} {_what_it_is(head)}")
        found = re.search(rb"index (\d{20}) (\d{20})\nindex sha256 ([0-9a-f]{64})\nsha256 ([0-9a-f]{64})\n", head)
        if not found:
            raise damaged(self.path, "its first 512 bytes are not a seal that this version of jam knows")
        place, whole = [int(found[1]), int(found[2]), found[3].decode()], found[4].decode()
        if head != _head(self.length, place, whole):
            raise damaged(self.path, f"its seal does not fit a file of {self.length} bytes")
        index = self.index(place)
        if "packings" in index:
            return None, dict(index["packings"])
        if self.digest() != whole:
            for name in (group := self.group(index))._all:  # names what is damaged, where that is an array
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


class Shard(Mapping[str, Group]):
    """Packings of a shard by name."""

    def __init__(self, names: Sequence[str], fetch: Callable[[str], Group]) -> None:
        self._names, self._fetch = list(names), fetch

    def __getitem__(self, name: str) -> Group:
        if name not in self._names:
            raise KeyError(name)
        return self._fetch(name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


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
        descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK)  # a pipe without a writer would wait
    try:
        with refusing(path):
            if not stat.S_ISREG(os.fstat(descriptor).st_mode):
                raise StoreError(22, f"{path} is no regular file")
            opened = _content(_File(path, descriptor, memory_limit), unverified)
        yield opened
    finally:
        os.close(descriptor)


def _content(file: _File, unverified: bool) -> Group | Shard:
    if unverified:
        from . import unsealed

        return unsealed.content(file.path, file.read(0, file.length))
    group, places = file.opened()
    if group is not None:
        return group
    return Shard(list(places), lambda name: file.group(file.index(places[name])))
