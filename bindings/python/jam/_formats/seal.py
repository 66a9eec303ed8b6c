"""The container of packings: an HDF5 file for every program, and a seal that jam checks before it uses a byte.

    bytes 0 to 511    text: length of the file, place and SHA-256 of the index, SHA-256 of all bytes from 512 on
    bytes from 512    HDF5, which every HDF5 program opens: the text is a user block to it
    `seal` in HDF5    the index, JSON: of each dataset its place, type, shape and SHA-256; attributes of the groups.
                      Each packing of a shard has one, and the shard's own gives the places of these

Reading goes by the index and never by libhdf5: damaged or crafted structures of HDF5 can end the process, hang, or lead
to other files. The index is small, names nothing outside of the file, and each of its numbers is checked. A file of one
packing is checked as a whole. Of a shard, which holds many, only what is read is checked, and the length.
"""
from __future__ import annotations

import hashlib
import json
import math
import re
from typing import IO, Any, Callable, Collection, Mapping, Sequence

import numpy as np

from .content import plain_value

try:
    import h5py
except ImportError as error:  # pragma: no cover
    raise ImportError("packings are stored by h5py: install python3-h5py") from error

USER_BLOCK = 512
INDEX = "seal"
BEGIN = b"jam packing file"
_MOST_ARRAYS, _DEEPEST = 4096, 12  # of a packing: bounds what a crafted index can ask for
_KIND = re.compile(r"[<>|][biufcS][0-9]{1,9}")
_CHUNK = 1 << 20


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


def digest(data: Any) -> str:
    return hashlib.sha256(data).hexdigest()


def digest_of_rest(file: IO[bytes]) -> str:
    """SHA-256 of all behind the user block."""
    found = hashlib.sha256()
    file.seek(USER_BLOCK)
    while data := file.read(_CHUNK):
        found.update(data)
    return found.hexdigest()


def entry(node: Any, value: Any) -> list[Any]:
    """Place, shape, type and digest of a dataset (as h5py.h5d has it) of this value."""
    kind = value.dtype
    text: Any = kind.str if kind.names is None else [[k, kind[k].str] for k in kind.names]
    return [int(node.get_offset()) if value.nbytes else USER_BLOCK, list(value.shape), text, digest(value.tobytes())]


def _entry(path: str, node: Any) -> list[Any]:
    kind, plan = node.dtype, node.id.get_create_plist()
    if kind.hasobject or plan.get_layout() != h5py.h5d.CONTIGUOUS:
        raise TypeError(f"{path}: only arrays of numbers and text of fixed length are stored, not {kind}")
    return entry(node.id, np.asarray(node[()]))


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


def _put(group: Any, index: dict[str, Any]) -> list[Any]:
    """Writes an index; returns its place, size and digest."""
    text = json.dumps(index).encode()
    node = group.create_dataset(INDEX, data=np.frombuffer(text, np.uint8))
    return [int(node.id.get_offset()), len(text), digest(text)]


def seal(file: IO[bytes], fill: Callable[[Any], Mapping[str, Any]]) -> None:
    """Writes a sealed file.

    Parameters
    ----------
    file : io.BytesIO, or a file open to be written and read
        Takes the bytes.
    fill : callable
        Writes the content into an h5py.File: contiguous arrays, text of fixed length. Of a shard it returns the index of
        each group by its name; of one packing none.
    """
    with h5py.File(file, "w", userblock_size=USER_BLOCK, libver="earliest") as inside:  # every HDF5 reads it
        packings = fill(inside)
        parts = {name: _put(inside[name], index) for name, index in packings.items()}
        place = _put(inside, {"packings": parts} if packings else _index_of(inside))
    length, whole = file.seek(0, 2), digest_of_rest(file)
    file.seek(0)
    file.write(head_of(length, place, whole))
