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

import contextlib
import hashlib
import json
import math
import os
import re
from typing import IO, Any, Collection, Iterable, Iterator, NamedTuple, Sequence

import numpy as np

from .._api.arrays import Array
from ..errors import StoreError
from .replacing import open_regular

try:
    import h5py
except ImportError as error:  # pragma: no cover
    raise ImportError("packings are stored by h5py: install python3-h5py") from error
from .records import described

USER_BLOCK = 512
INDEX = "seal"
BEGIN = b"jam packing file"
_MOST_ARRAYS, _DEEPEST = 4096, 12  # of a packing: bounds what a crafted index can ask for
_KIND = re.compile(r"[<>|][biufcS][1-9][0-9]{0,8}")
_CHUNK = 1 << 20
SCHEMA = 1
_LARGEST_INDEX = 1 << 22  # bytes
MOST_PACKINGS = 10_000  # of a shard: its index stays below _LARGEST_INDEX
_SEAL = re.compile(rb"index (\d{20}) (\d{20})\nindex sha256 ([0-9a-f]{64})\nsha256 ([0-9a-f]{64})\n")
_READERS = "h5py reads its arrays, and System.from_arrays takes positions, diameters and cell vectors"
#: Arrays with a second name, as H5MD has them.
SAME = {f"particles/spheres/box/edges/{k}": f"particles/spheres/position/{k}" for k in ("step", "time")}


class Packing(NamedTuple):
    """One packing: its arrays and the attributes of its groups, by their path in the file."""

    arrays: dict[str, Array]
    attributes: dict[str, dict[str, Any]]

    def get(self, path: str) -> Any:
        """A number, an array or text; of a group a dict of them. None where there is none."""
        if path in self.arrays:
            value: Any = self.arrays[path][()]
            return value.decode() if isinstance(value, bytes) else value
        names = dict.fromkeys(name[len(path) + 1 :].partition("/")[0] for name in self.arrays if name.startswith(path + "/"))
        return {name: self.get(f"{path}/{name}") for name in names} or None


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
    fields = [("", text)] if isinstance(text, str) else [(str(name), kind) for name, kind in text]
    for _, kind in fields:
        if not _KIND.fullmatch(kind):
            raise ValueError(f"{kind!r} is not a type of numbers or text")
    made: Any = text if isinstance(text, str) else fields
    return np.dtype(made)


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


class _ErrorKeepingFile:
    """Hides errors of a file from libhdf5, which after an error would keep the file open and end the process at exit with a
    segmentation fault. After the first error nothing is written; leaving the block raises that error."""

    def __init__(self, file: IO[bytes]) -> None:
        self.file = file
        self.error: BaseException | None = None

    def __enter__(self) -> _ErrorKeepingFile:
        return self

    def __exit__(self, *_: Any) -> None:
        if self.error is not None:
            raise self.error

    def __getattr__(self, name: str) -> Any:
        def call(*given: Any) -> Any:
            if self.error is None:
                try:
                    return getattr(self.file, name)(*given)
                except BaseException as error:  # a full disk, or Ctrl-C
                    self.error = error
            return 0

        return call


def seal(file: IO[bytes], content: Packing | Iterable[tuple[str, Packing]], **attributes: Any) -> None:
    """Writes one packing, or many with their names, a group each, as a sealed file whose attributes are these.

    The file is open to be written and read.
    """
    # every HDF5 reads "earliest"
    with _ErrorKeepingFile(file) as held, h5py.File(held, "w", userblock_size=USER_BLOCK, libver="earliest") as inside:
        inside.attrs.update(attributes)
        if isinstance(content, Packing):
            place = _write(content, inside)
        else:
            places = {}
            for name, packing in content:
                places[name] = _write(packing, inside.create_group(name))
                if held.error is not None:
                    break
            place = _put(inside, {"packings": places})
    length, whole = file.seek(0, 2), digest_of_rest(file)
    file.seek(0)
    file.write(head_of(length, place, whole))


def _put(group: Any, index: dict[str, Any]) -> list[Any]:
    """Writes an index; returns its place, size and digest."""
    text = json.dumps(index, default=lambda value: value.tolist()).encode()
    node = group.create_dataset(INDEX, data=np.frombuffer(text, np.uint8))
    return [int(node.id.get_offset()), len(text), digest(text)]


def _write(packing: Packing, group: Any) -> list[Any]:
    """Writes a packing and its index into a group; returns the place of the index, as _put(). By the low calls of h5py: with the
    high ones all of this takes twice as long."""
    check_names(packing.arrays)
    data, above = {}, h5py.h5p.create(h5py.h5p.LINK_CREATE)
    above.set_create_intermediate_group(True)
    for path, value in packing.arrays.items():
        kind, words = described(path, value.dtype)
        stored = h5py.h5t.py_create(kind, logical=True)
        node = h5py.h5d.create(group.id, path.encode(), stored, h5py.h5s.create_simple(value.shape), lcpl=above)
        if value.size:
            node.write(h5py.h5s.ALL, h5py.h5s.ALL, np.ascontiguousarray(value), stored)
        _describe(node, words)
        text = value.dtype.str if value.dtype.names is None else [[k, value.dtype[k].str] for k in value.dtype.names]
        place = int(node.get_offset()) if value.nbytes else USER_BLOCK
        data[path] = [place, list(value.shape), text, digest(value.tobytes())]
    for path in SAME.keys() & data.keys():
        group[SAME[path]] = group[path]
    for path, attributes in packing.attributes.items():
        _describe(group.require_group(path).id, attributes)
    return _put(group, {"data": data, "attributes": packing.attributes})


def _describe(node: Any, attributes: dict[str, Any]) -> None:
    for name, value in attributes.items():
        array = np.asarray(value)
        if array.dtype.kind == "U":
            array = array.astype(h5py.string_dtype())
        kind = h5py.h5t.py_create(array.dtype, logical=True)
        h5py.h5a.create(node, name.encode(), kind, h5py.h5s.create_simple(array.shape)).write(array)


def damaged(path: Any, what: str) -> StoreError:
    """The error for a file that is not what jam wrote."""
    text = f"{path} is damaged, or was changed by another program: {what}. Use another copy or make it again; {_READERS}"
    return StoreError(5, text)


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


class _File:
    """An open file whose seal fits. places: of each packing of a shard its index; that of a file of one has no name."""

    def __init__(self, path: Any, file: IO[bytes]) -> None:
        self.path, self.file, self.length = path, file, os.fstat(file.fileno()).st_size
        head = file.read(USER_BLOCK)
        if not head.startswith(BEGIN):
            raise StoreError(22, f"{path} {_what_it_is(head)}")
        if not (found := _SEAL.search(head)):
            raise damaged(path, "its first 512 bytes are not a seal of this version of jam")
        place, self.whole = [int(found[1]), int(found[2]), found[3].decode()], found[4].decode()
        if head != head_of(self.length, place, self.whole):
            raise damaged(path, f"its seal does not fit a file of {self.length} bytes")
        index = self.index(place)
        self.places: dict[str | None, Any] = dict(index["packings"]) if "packings" in index else {None: index}

    def read(self, what: str, at: int, size: int, expected: str) -> bytearray:
        """Bytes whose digest is as expected."""
        if not (isinstance(at, int) and isinstance(size, int) and 0 <= at and 0 <= size <= self.length - at):
            raise ValueError(f"{what}: {size} bytes at {at} lie outside of the file")
        data, _ = bytearray(size), self.file.seek(at)
        if self.file.readinto(data) != size:  # type: ignore[attr-defined]
            raise ValueError("the file got shorter while it was read")
        if digest(data) != expected:
            raise damaged(self.path, f"{what} differs from its checksum")
        return data

    def index(self, place: Sequence[Any]) -> dict[str, Any]:
        if not 0 < place[1] <= _LARGEST_INDEX:
            raise ValueError(f"an index of {place[1]} bytes")
        text = self.read("the index", *place)
        return json.loads(text, parse_int=lambda digits: int(digits[:20]))  # no place or size has more

    def packing(self, name: str | None, limit: float | None) -> Packing:
        index = self.places[name] if name is None else self.index(self.places[name])
        check_names(index["data"])
        size = sum(size_of(shape, type_of(kind)) for _, shape, kind, _ in index["data"].values())
        if size > self.length:
            raise ValueError("the arrays together are longer than the file")
        size = self.length if name is None else size  # bytes read
        # a quarter of the machine's memory, as arrays and system are made of it
        most = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 4 if limit is None else limit
        if not size <= most:
            why = f"{size:.3g} bytes, above the limit of {most:.3g}: give memory_limit= if the file is your own"
            raise StoreError(27, f"{self.path} {'has' if name is None else f'holds a packing {name!r} of'} {why}")
        arrays = {}
        for path, (at, shape, kind, expected) in index["data"].items():
            if not all(isinstance(k, int) and 0 <= k <= self.length for k in shape):
                raise ValueError(f"{path} has the shape {shape}")
            data = self.read(path, at, size_of(shape, type_of(kind)), expected)
            arrays[path] = np.frombuffer(data, type_of(kind)).reshape(shape)
        if name is None and digest_of_rest(self.file) != self.whole:  # later: an array that is damaged is named
            raise damaged(self.path, "the file differs from its checksum, though its arrays are intact")
        return Packing(arrays, index["attributes"])


def _what_it_is(head: bytes) -> str:
    if b"\x89HDF\r\n\x1a\n" in head:
        return f"is HDF5 without the seal of jam: another program wrote it. {_READERS}"
    if head.startswith(b"jamstat"):
        return "is a checkpoint of libjam: System.from_checkpoint reads it"
    return "is no file of System.save; System.read reads XYZ, LAMMPS and other text" if head else "is empty"


def names_in(path: str | os.PathLike[str]) -> list[str]:
    """Names of the packings of a shard; none of a file of one packing."""
    with refusing(path), open_regular(path) as opened:
        return [name for name in _File(path, opened).places if name is not None]


def read_packing(
    path: str | os.PathLike[str], name: str | None = None, memory_limit: float | None = None
) -> Packing:
    """A packing from its file, or by its name from a shard. For memory_limit see store.load()."""
    with refusing(path), open_regular(path) as opened:
        file = _File(path, opened)
        if name not in file.places:
            many = f"is a shard of {len(file.places)} packings: name one, e.g. name={next(iter(file.places), '')!r}"
            raise StoreError(22, f"{path} {many}" if name is None else f"{path} holds no packing {name!r}")
        found = file.packing(name, memory_limit)
        schema = int(found.attributes["jam"]["schema"])
        if schema > SCHEMA:
            raise StoreError(22, f"{path}: schema {schema} is newer than the schema {SCHEMA} of this jam")
        return found
