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
Attributes beside the arrays say what they mean (see records.py).

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
from .content import CONTACTS, SCHEMA, Packing
from .provenance import provenance
from .records import report_text, report_value
from .replacing import MENDED, replacing, require_ending
from .seal import seal


def _text(value: str) -> Any:
    """Text of fixed length, which lies in one place of a file."""
    data = value.encode()
    return np.array(data, h5py.string_dtype("utf-8", max(1, len(data))))


def _put(packing: Packing, path: str, value: Any) -> None:
    """Any result of a call: a number, text, an array, a report, a named tuple of them."""
    if hasattr(value, "_asdict"):
        for key, part in value._asdict().items():
            _put(packing, f"{path}/{key}", part)
    elif is_dataclass(value):
        packing.arrays[path], packing.texts[path] = report_value(value), report_text(value)
    elif value is not None:
        packing.arrays[path] = _text(value) if isinstance(value, str) else np.asarray(value)


def _h5md(made: Packing, system: Any, closed: list[bool]) -> None:
    spheres = "particles/spheres"
    made.attributes.update({
        "h5md": {"version": np.array([1, 1], np.int32)},
        "h5md/author": {"name": "unknown"},
        "h5md/creator": {"name": "jam", "version": raw.jam_version()},
        f"{spheres}/box": {
            "dimension": np.int32(system.dim), "boundary": ["none" if shut else "periodic" for shut in closed],
        },
    })
    made.arrays.update({
        f"{spheres}/position/value": system.positions[None],
        f"{spheres}/box/edges/value": system.cell[None],
        f"{spheres}/box/edges/step": np.zeros(1, np.int64),
        f"{spheres}/box/edges/time": np.zeros(1),
    })


def _known(ask: Callable[[], Any]) -> Any:
    """A result, None for one that the packing does not have."""
    try:
        return ask()
    except StateError:
        return None


def image(
    system: Any,
    *,
    refined: bool = False,
    analysis: Mapping[str, Any] | None = None,
    protocol: str | None = None,
    protocol_id: str = "",
    times: Mapping[str, float] | None = None,
) -> bytes:
    """The bytes of a packing's file.

    Parameters
    ----------
    system : System
        The arrays of the file are those of its checkpoint to the last bit.
    refined : bool
        Centres as sums of two doubles too, see System.refined_positions.
    analysis : mapping, optional
        Results by name: numbers, arrays, reports, named tuples of them.
    protocol, protocol_id : str, optional
        The protocol as JSON and its name.
    times : mapping, optional
        Seconds by name, beside the moment of writing.
    """
    state, packing = system._checkpointed()
    info, contacts, report = packing.info, _known(lambda: packing.contacts), _known(lambda: packing.report)
    closed, made = closed_axes(info), Packing({}, {}, {})
    _h5md(made, packing, closed)
    about = {"schema": SCHEMA, "seed": info.seed, "protocol": protocol_id, **provenance(), "written": time.time()}
    walls = {"container": container_word(info), "walls": np.array(walls_of(info))} if any(closed) else {}
    made.attributes.update({"jam": {**about, **(times or {}), **walls}, "jam/analysis": {}})
    known = report is not None or contacts is not None
    parts = {
        "particles/spheres/refined": packing.refined_positions() if refined else None,
        "jam/state": np.frombuffer(state, np.uint8),
        "jam/diameters": packing.diameters,
        "jam/report": report,
        "jam/history": _known(lambda: packing.history) if known else None,
        "jam/calls": json.dumps(packing.calls),
        "jam/protocol": protocol,
        **{"jam/analysis/" + name: value for name, value in (analysis or {}).items()},
    }
    if contacts is not None:
        parts["jam/coordination"] = packing.coordination
        parts.update({"jam/contacts/" + name: getattr(contacts, name) for name in CONTACTS})
    for path, value in parts.items():
        _put(made, path, value)
    memory = io.BytesIO()
    seal(memory, made)
    return memory.getvalue()


def save(system: Any, path: str | os.PathLike[str], **more: Any) -> None:
    """Writes one packing with all its results; jam.load reads it. The path ends in .h5 or .hdf5. For `more` see image()."""
    require_ending(path, (".h5", ".hdf5"), "save writes HDF5; write() writes other formats")
    write_file(path, image(system, **more))


def write_file(path: str | os.PathLike[str], data: bytes, parts: str | os.PathLike[str] | None = None) -> None:
    """Writes a file so that it is there as a whole or not at all; see replacing.py."""
    try:
        with replacing(path, parts=parts) as file:
            file.write(data)
    except OSError as error:
        raise StoreError(error.errno, f"{path} cannot be written: {error.strerror}. {MENDED}") from error
