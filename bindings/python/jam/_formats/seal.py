"""The container of packings: an HDF5 file for every program, and a seal that jam checks before it uses a byte.

    bytes 0 to 511    text: length of the file, place and SHA-256 of the index, SHA-256 of all bytes from 512 on
    bytes from 512    HDF5, which every HDF5 program opens: the text is a user block to it
    `seal` in HDF5    the index, JSON: of each dataset its place, type, shape and SHA-256; attributes of the groups

Reading goes by the index and never by libhdf5: damaged or crafted structures of HDF5 can end the process, hang, or lead
to other files. The index is small, names nothing outside of the file, and each of its numbers is checked. A file of one
packing is checked as a whole. Of a shard, which holds many, only what is read is checked, and the length.
"""
from __future__ import annotations

import hashlib
import io
import json
import math
import mmap
import re
from typing import Any, Callable, Collection, Sequence

import numpy as np

from ..errors import StoreError
from .groups import plain_value

try:
    import h5py
except ImportError as error:  # pragma: no cover
    raise ImportError("packings are stored by h5py: install python3-h5py") from error

USER_BLOCK = 512
INDEX = "seal"
BEGIN = b"jam packing file"
_MOST_ARRAYS, _DEEPEST = 4096, 12  # of a packing: bounds what a crafted index can ask for
_UNWRITTEN = "0" * 64
_KIND = re.compile(r"[<>|][biufcS][0-9]{1,9}")


def head_of(length: int, index: Sequence[Any], whole: str) -> bytes:
    """The user block. Every byte of it follows from the file, so that it is checked by making it again."""
    text = (
        f"{BEGIN.decode()}, format 1\nlength {length:020d}\nindex {index[0]:020d} {index[1]:020d}\n"
        f"index sha256 {index[2]}\nsha256 {whole}\n"
        f"From byte {USER_BLOCK} on this is HDF5, for every program that reads HDF5.\n"
        "jam refuses it after any change. To check the bytes without jam:\n"
        f"tail -c +{USER_BLOCK + 1} FILE | sha256sum\n"
    )
    return text.encode().ljust(USER_BLOCK - 1) + b"\n"


def type_of(text: Any) -> np.dtype[Any]:
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


def size_of(shape: Sequence[int], kind: np.dtype[Any]) -> int:
    return math.prod(shape) * kind.itemsize


def check_names(names: Collection[str]) -> None:
    if len(names) > _MOST_ARRAYS or any(name.count("/") > _DEEPEST for name in names):
        raise ValueError(f"more than {_MOST_ARRAYS} arrays, or groups nested more than {_DEEPEST} deep")


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
            found["attributes"][path] = {k: plain_value(v) for k, v in node.attrs.items()}

    group.visititems(add)
    check_names(found["data"])
    return found


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
            entry[3] = _digest(image, entry[0], size_of(entry[1], type_of(entry[2])))
        at, size, _ = place
        image[at : at + size] = json.dumps(index).encode()
        place[2] = _digest(image, at, size)
    image[:USER_BLOCK] = head_of(len(image), places[-1][1], _digest(image, USER_BLOCK, len(image)))
