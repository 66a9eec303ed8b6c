"""HDF5 files without a seal, read by libhdf5 on the user's word: what leads out of the file or costs memory is refused."""
from __future__ import annotations

import io
import math
from typing import Any

import h5py
import numpy as np

from .._api.arrays import Array
from ..errors import StoreError
from .groups import Group, Shard, plain_value

_MOST_OBJECTS, _DEEPEST = 1_000_000, 12


class _Walk:
    """Arrays and attributes of a file by path. `left` bytes may still be read: no honest file holds more than it is long."""

    def __init__(self, path: Any, length: int) -> None:
        self.path, self.left, self.objects = path, length, 0
        self.arrays: dict[str, Array] = {}
        self.attributes: dict[str, dict[str, Any]] = {}

    def refuse(self, name: str, what: str) -> StoreError:
        return StoreError(22, f"{self.path}: {name} {what}, which no file of jam has")

    def group(self, node: Any, at: str, depth: int) -> None:
        if depth > _DEEPEST:
            raise self.refuse(at, f"lies more than {_DEEPEST} groups deep")
        self.attributes[at.rstrip("/")] = {k: plain_value(v) for k, v in node.attrs.items()}
        for name in node:
            self.objects += 1
            if self.objects > _MOST_OBJECTS:
                raise self.refuse(at, f"is one of more than {_MOST_OBJECTS} objects")
            if not isinstance(node.get(name, getlink=True), h5py.HardLink):
                raise self.refuse(at + name, "is a link to another place or file")
            inner = node[name]
            if isinstance(inner, h5py.Group):
                self.group(inner, f"{at}{name}/", depth + 1)
            elif isinstance(inner, h5py.Dataset):
                self.arrays[at + name] = self.array(inner, at + name)
            else:
                raise self.refuse(at + name, "is neither group nor array")

    def array(self, node: Any, name: str) -> Array:
        plan = node.id.get_create_plist()
        if plan.get_external_count():
            raise self.refuse(name, "has its data in another file")
        if plan.get_nfilters():
            raise self.refuse(name, "is compressed or filtered")
        if plan.get_layout() not in (h5py.h5d.CONTIGUOUS, h5py.h5d.COMPACT):
            raise self.refuse(name, "is chunked or virtual")
        if h5py.check_string_dtype(node.dtype) and node.dtype.hasobject and node.shape == ():
            found = np.array(node[()])  # text of older files
            size = found.nbytes
        elif node.dtype.hasobject:
            raise self.refuse(name, "contains references or parts of any length")
        else:
            size = math.prod(node.shape) * node.dtype.itemsize
        self.left -= size
        if self.left < 0:
            raise self.refuse(name, "needs more bytes than the file has")
        return found if node.dtype.hasobject else np.asarray(node[()])


def content(path: Any, data: memoryview) -> Group | Shard:
    """What open_file gives for a file that is read without its seal."""
    walk = _Walk(path, len(data))
    try:
        with h5py.File(io.BytesIO(data), "r") as file:
            walk.group(file, "", 0)
    except StoreError:
        raise
    except (OSError, RuntimeError) as error:  # what h5py makes of libhdf5's errors
        raise StoreError(5, f"{path} cannot be read as HDF5: {error}") from error
    names = list(walk.arrays)
    if "jam" not in {name.partition("/")[0] for name in names}:
        packings = [k for k in dict.fromkeys(n.partition("/")[0] for n in names) if f"{k}/jam/state" in walk.arrays]
        if packings:
            return Shard(packings, lambda name: _one(walk, name + "/"))
    return Group(names, walk.arrays.__getitem__, walk.attributes)


def _one(walk: _Walk, at: str) -> Group:
    arrays = {k[len(at) :]: v for k, v in walk.arrays.items() if k.startswith(at)}
    attributes = {k[len(at) :]: v for k, v in walk.attributes.items() if k.startswith(at)}
    return Group(list(arrays), arrays.__getitem__, attributes)
