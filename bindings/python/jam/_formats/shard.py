"""Files of many packings, a group each."""
from __future__ import annotations

import os
from pathlib import Path
from typing import Any, Mapping

import h5py
import numpy as np

from .._api.generated import CrunchReport
from ..errors import StoreError
from .content import Packing
from .explain import explanation, report_text, report_value
from .records import unpack
from .replacing import replacing
from .seal import check_names, entry, seal
from .sealed import read_packing


def write_shard(path: str | os.PathLike[str], protocol: str, packings: Mapping[str, Path | tuple[Path, str | None]]) -> list[str]:
    """Writes one file of many packings, a group each, from their files by name; (file, name): from a shard.

    Returns what is wrong with each file that cannot be read: it is left out.
    """
    left_out: list[str] = []

    def fill(shard: Any) -> dict[str, Any]:
        shard.attrs["protocol"] = protocol
        made, copier = {}, _Copier()
        for name, place in packings.items():
            try:
                source, inner = place if isinstance(place, tuple) else (place, None)
                packing = read_packing(source, inner)
            except StoreError as error:
                left_out.append(str(error.strerror))
                continue
            made[name] = copier.copy(packing, shard.create_group(name))
        return made

    try:
        with replacing(path, "w+b") as file:
            seal(file, fill)
    except StoreError:
        raise
    except OSError as error:
        raise StoreError(error.errno or 5, f"{path} cannot be written: {error}") from error
    return left_out


class _Copier:
    """Copies packings by the low calls of h5py: the high ones take ten times as long as libhdf5 for small arrays."""

    def __init__(self) -> None:
        self.types: dict[Any, Any] = {}

    def copy(self, packing: Packing, target: Any) -> dict[str, Any]:
        """A packing into a group of another file; returns its index."""
        check_names(packing.arrays)
        groups = {"": target.id}
        for path, attributes in packing.attributes.items():
            node = self.group(groups, path)
            for key, value in attributes.items():
                self.attribute(node, key, value)
        data = {}
        for path, value in packing.arrays.items():
            text = explanation(path)
            if path == "jam/report":
                report = unpack(value, CrunchReport)
                value, text = report_value(report), report_text(report)
            inner, _, name = path.rpartition("/")
            space = h5py.h5s.create_simple(value.shape) if value.shape else h5py.h5s.create(h5py.h5s.SCALAR)
            node = h5py.h5d.create(self.group(groups, inner), name.encode(), self.type_of(value.dtype), space)
            if value.size:
                node.write(h5py.h5s.ALL, h5py.h5s.ALL, np.ascontiguousarray(value))
            for key, words in text.items():
                self.attribute(node, key, words)
            data[path] = entry(node, value)
        return {"data": data, "attributes": packing.attributes}

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
