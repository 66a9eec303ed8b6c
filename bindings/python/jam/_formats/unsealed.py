"""HDF5 files without a seal, read by libhdf5 on the user's word: what leads out of the file or costs memory is refused."""
from __future__ import annotations

import io
import math
from typing import Any, Callable, Sequence

import h5py
import numpy as np

from ..errors import StoreError
from .content import Packing, plain_value


def _no_file_of_jam(node: Any) -> str:
    """What an array has that no file of jam has; "" where it is plain."""
    plan, text = node.id.get_create_plist(), h5py.check_string_dtype(node.dtype) and node.shape == ()  # of older files
    if plan.get_external_count():
        return "has its data in another file"
    if plan.get_nfilters():
        return "is compressed or filtered"
    if plan.get_layout() not in (h5py.h5d.CONTIGUOUS, h5py.h5d.COMPACT):
        return "is chunked or virtual"
    return "contains references or parts of any length" if node.dtype.hasobject and not text else ""


def _read(path: Any, file: Any, length: int) -> Packing:
    """Arrays and attributes of a file by path, of each object once. No honest file holds more bytes than it is long."""
    found, left = Packing({}, {}), length

    def add(name: str, node: Any) -> None:
        nonlocal left
        wrong = ""
        if isinstance(node, h5py.Group):
            found.attributes[name] = {k: plain_value(v) for k, v in node.attrs.items()}
            if not all(isinstance(node.get(key, getlink=True), h5py.HardLink) for key in node):
                wrong = "has a link to another place or file"
        elif isinstance(node, h5py.Dataset):
            wrong = _no_file_of_jam(node)
            left -= math.prod(node.shape) * node.dtype.itemsize
            if not wrong and left < 0:
                wrong = "needs more bytes than the file has"
            if not wrong:
                found.arrays[name] = np.asarray(node[()])
        if wrong:
            raise StoreError(22, f"{path}: {name} {wrong}, which no file of jam has")

    add("", file["/"])
    file.visititems(add)
    return found


def content(path: Any, data: bytearray) -> tuple[Sequence[str] | None, Callable[[str | None], Packing]]:
    """Names of the packings of a shard, None for a file of one; and what gives one of them."""
    try:
        with h5py.File(io.BytesIO(data), "r") as file:
            found = _read(path, file, len(data))
    except StoreError:
        raise
    except (OSError, RuntimeError) as error:  # what h5py makes of libhdf5's errors
        raise StoreError(5, f"{path} cannot be read as HDF5: {error}") from error
    packings = [name[: -len("/jam/state")] for name in found.arrays if name.endswith("/jam/state")]

    def one(name: str | None) -> Packing:
        at = "" if name is None else name + "/"
        arrays = {k[len(at) :]: v for k, v in found.arrays.items() if k.startswith(at)}
        return Packing(arrays, {k[len(at) :]: v for k, v in found.attributes.items() if k.startswith(at)})

    return packings if packings and "jam/state" not in found.arrays else None, one
