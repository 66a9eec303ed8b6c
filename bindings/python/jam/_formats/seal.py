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
from typing import IO, Any, Collection, Iterable, Sequence

import numpy as np

from .content import Packing, plain_value

try:
    import h5py
except ImportError as error:  # pragma: no cover
    raise ImportError("packings are stored by h5py: install python3-h5py") from error
from .records import explanation

USER_BLOCK = 512
INDEX = "seal"
BEGIN = b"jam packing file"
_MOST_ARRAYS, _DEEPEST = 4096, 12  # of a packing: bounds what a crafted index can ask for
_KIND = re.compile(r"[<>|][biufcS][0-9]{1,9}")
_CHUNK = 1 << 20
#: Arrays with a second name, as H5MD has them.
SAME = {f"particles/spheres/box/edges/{k}": f"particles/spheres/position/{k}" for k in ("step", "time")}


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


def _put(group: Any, index: dict[str, Any]) -> list[Any]:
    """Writes an index; returns its place, size and digest."""
    text = json.dumps(index).encode()
    node = group.create_dataset(INDEX, data=np.frombuffer(text, np.uint8))
    return [int(node.id.get_offset()), len(text), digest(text)]


def seal(file: IO[bytes], content: Packing | Iterable[tuple[str, Packing]], **attributes: Any) -> None:
    """Writes a sealed file.

    Parameters
    ----------
    file : io.BytesIO, or a file open to be written and read
        Takes the bytes.
    content : Packing, or pairs of a name and a Packing
        One packing, or many, a group each.
    **attributes
        Of the file as a whole.
    """
    writer, parts = _Writer(), {}
    with h5py.File(file, "w", userblock_size=USER_BLOCK, libver="earliest") as inside:  # every HDF5 reads it
        inside.attrs.update(attributes)
        index: dict[str, Any] = {"data": {}, "attributes": {}}
        if isinstance(content, Packing):
            index = writer.write(content, inside["/"].id)
        else:
            for name, packing in content:
                group = inside.create_group(name)
                parts[name] = _put(group, writer.write(packing, group.id))
        place = _put(inside, {"packings": parts} if parts else index)
    length, whole = file.seek(0, 2), digest_of_rest(file)
    file.seek(0)
    file.write(head_of(length, place, whole))


class _Writer:
    """Writes packings by the low calls of h5py: the high ones take ten times as long as libhdf5 for small arrays."""

    def __init__(self) -> None:
        self.types: dict[Any, Any] = {}

    def write(self, packing: Packing, target: Any) -> dict[str, Any]:
        """A packing into a group; returns its index: of each array place, shape, type and digest."""
        check_names(packing.arrays)
        groups = {"": target}
        for path, attributes in packing.attributes.items():
            node = self.group(groups, path)
            for key, value in attributes.items():
                self.attribute(node, key, value)
        data = {}
        for path, value in packing.arrays.items():
            if value.dtype.hasobject:
                raise TypeError(f"{path}: only arrays of numbers and text of fixed length are stored, not {value.dtype}")
            inner, _, name = path.rpartition("/")
            kind = self.type_of(value.dtype)
            space = h5py.h5s.create_simple(value.shape) if value.shape else h5py.h5s.create(h5py.h5s.SCALAR)
            node = h5py.h5d.create(self.group(groups, inner), name.encode(), kind, space)
            if value.size:
                node.write(h5py.h5s.ALL, h5py.h5s.ALL, np.ascontiguousarray(value), kind)
            for key, words in (packing.texts.get(path) or explanation(path)).items():
                self.attribute(node, key, words)
            text = value.dtype.str if value.dtype.names is None else [[k, value.dtype[k].str] for k in value.dtype.names]
            place = int(node.get_offset()) if value.nbytes else USER_BLOCK
            data[path] = [place, list(value.shape), text, digest(value.tobytes())]
        for path, same in SAME.items():
            if path in data:
                above, _, name = same.rpartition("/")
                self.group(groups, above).links.create_hard(name.encode(), target, path.encode())
        return {"data": data, "attributes": plain_value(packing.attributes)}

    def group(self, groups: dict[str, Any], path: str) -> Any:
        path = "" if path == "." else path
        if path not in groups:
            above, _, name = path.rpartition("/")
            groups[path] = h5py.h5g.create(self.group(groups, above), name.encode())
        return groups[path]

    def type_of(self, kind: Any) -> Any:
        key = kind if kind.metadata is None else (kind, str(kind.metadata))
        if key not in self.types:
            self.types[key] = h5py.h5t.py_create(kind, logical=True)
        return self.types[key]

    def attribute(self, node: Any, name: str, value: Any) -> None:
        kind = h5py.string_dtype() if isinstance(value, str) else None
        array = np.asarray(value, dtype=kind)
        if array.dtype.kind == "U":  # several texts
            array = array.astype(h5py.string_dtype())
        space = h5py.h5s.create_simple(array.shape) if array.shape else h5py.h5s.create(h5py.h5s.SCALAR)
        h5py.h5a.create(node, name.encode(), self.type_of(array.dtype), space).write(array)
