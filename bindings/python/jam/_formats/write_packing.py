"""One packing, one HDF5 file: positions and box as H5MD, all else in the group `jam`.

    h5md, particles/spheres      H5MD 1.1: box/edges as a full matrix, position as a trajectory of one frame
    particles/spheres/refined    centres as high + low, of save(refined=True)
    jam  (attributes)            schema, seed, protocol (its name), provenance; with walls container ("brick",
                                 "cylinder", "ball") and walls, one truth value an axis. Then the boundary of H5MD is
                                 "none" along closed axes, and partner -1 - w of a contact is wall w of System.walls()
    jam/state                    bytes of a checkpoint: what dynamics depend on, velocities and random shifts among it
    jam/diameters                (n,), unit of the box
    jam/report                   report of the crunch, one compound value
    jam/contacts                 pairs, vectors, gaps, forces: row k of each is the same contact
    jam/coordination             (n,) contacts of each sphere, 0 for rattlers
    jam/history                  steps of the crunch, a compound value a step
    jam/protocol, jam/calls      JSON: the protocol; the calls made with every option and what ended them
    jam/analysis                 results of the protocol's analysis by name

The file is sealed (see seal.py): what is read was written by save() to the last bit, and libhdf5 does not parse it.
Attributes beside the arrays say what they mean (see explain.py).

A file is made in memory, written beside under a name nobody else has, flushed to the disk, and renamed. Readers hence
see all of a file or none of it, and a writer that is killed leaves only a file of the folder `parts`.
"""
from __future__ import annotations

import io
import json
import os
import time
from dataclasses import is_dataclass
from typing import Any, Callable, Mapping

import h5py
import numpy as np

from .. import raw
from .._api.given import closed_axes, container_word, walls_of
from ..errors import StateError, StoreError
from .content import CONTACTS, SCHEMA
from .explain import explain, put_report
from .provenance import provenance
from .replacing import MENDED, replacing
from .seal import seal


def _text(value: str) -> Any:
    """Text of fixed length, which lies in one place of a file."""
    data = value.encode()
    return np.array(data, h5py.string_dtype("utf-8", max(1, len(data))))


def put(group: Any, name: str, value: Any) -> None:
    """Any result of a call: a number, text, an array, a report, a named tuple of them."""
    if hasattr(value, "_asdict"):
        inner = group.create_group(name)
        for key, part in value._asdict().items():
            put(inner, key, part)
    elif is_dataclass(value):
        put_report(group, name, value)
    elif value is not None:
        node = group.create_dataset(name, data=_text(value) if isinstance(value, str) else value)
        explain(node, node.name.lstrip("/"))


def _h5md(file: Any, packing: Any, closed: list[bool]) -> None:
    dim = packing.dim
    head = file.create_group("h5md")
    head.attrs["version"] = np.array([1, 1], np.int32)
    head.create_group("author").attrs["name"] = "unknown"
    creator = head.create_group("creator")
    creator.attrs["name"], creator.attrs["version"] = "jam", raw.jam_version()
    spheres = file.create_group("particles/spheres")
    box = spheres.create_group("box")
    box.attrs["dimension"] = np.int32(dim)
    box.attrs["boundary"] = ["none" if shut else "periodic" for shut in closed]
    put(spheres, "position/value", packing.positions[None])
    position = spheres["position"]
    position.create_dataset("step", data=np.zeros(1, np.int64))
    position.create_dataset("time", data=np.zeros(1))
    put(box, "edges/value", packing.cell[None])
    edges = box["edges"]
    edges["step"], edges["time"] = position["step"], position["time"]


def _known(ask: Callable[[], Any]) -> Any:
    """A result, None for one that the packing does not have."""
    try:
        return ask()
    except StateError:
        return None


def image(
    state: bytes,
    packing: Any,
    *,
    analysis: Mapping[str, Any] | None = None,
    protocol: str | None = None,
    protocol_id: str = "",
    times: Mapping[str, float] | None = None,
    refined: Any = None,
) -> bytes:
    """The bytes of a packing's file.

    Parameters
    ----------
    state : bytes
        A checkpoint.
    packing : System
        Made from it, so that the arrays are those of jam/state to the last bit: System._checkpointed.
    analysis : mapping, optional
        Results by name: numbers, arrays, reports, named tuples of them.
    protocol, protocol_id : str, optional
        The protocol as JSON and its name.
    times : mapping, optional
        Seconds by name, beside the moment of writing.
    refined : named tuple, optional
        Centres as sums of two doubles: what System.refined_positions returns.
    """

    def fill(file: Any) -> dict[str, Any]:
        info, contacts, report = packing.info, _known(lambda: packing.contacts), _known(lambda: packing.report)
        closed = closed_axes(info)
        _h5md(file, packing, closed)
        put(file["particles/spheres"], "refined", refined)
        group = file.create_group("jam")
        group.attrs.update({"schema": SCHEMA, "seed": info.seed, "protocol": protocol_id, **provenance()})
        group.attrs["written"] = time.time()
        group.attrs.update(times or {})
        if any(closed):
            group.attrs.update({"container": container_word(info), "walls": np.array(walls_of(info))})
        put(group, "state", np.frombuffer(state, np.uint8))
        put(group, "diameters", packing.diameters)
        if report is not None or contacts is not None:
            put(group, "report", report)
            put(group, "history", _known(lambda: packing.history))
        if contacts is not None:
            put(group, "coordination", packing.coordination)
            for name in CONTACTS:
                put(group, "contacts/" + name, getattr(contacts, name))
        put(group, "calls", json.dumps(packing.calls))
        put(group, "protocol", protocol)
        results = group.create_group("analysis")
        for name, value in (analysis or {}).items():
            put(results, name, value)
        return {}

    memory = io.BytesIO()
    seal(memory, fill)
    return memory.getvalue()


def write_file(path: str | os.PathLike[str], data: bytes, parts: str | os.PathLike[str] | None = None) -> None:
    """Writes a file so that it is there as a whole or not at all; see replacing.py."""
    try:
        with replacing(path, parts=parts) as file:
            file.write(data)
    except OSError as error:
        raise StoreError(error.errno, f"{path} cannot be written: {error.strerror}. {MENDED}") from error
