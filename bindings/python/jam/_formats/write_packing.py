"""One packing, one HDF5 file: positions and box as H5MD, all else in the group `jam`. records.py says what each array means.

    h5md, particles/spheres      H5MD 1.1: box/edges as a full matrix, position as a trajectory of one frame
    particles/spheres/refined    centres as high + low, of save(refined=True)
    jam  (attributes)            schema, seed, protocol (its name), provenance; with walls container ("brick",
                                 "cylinder", "ball") and walls, one truth value an axis. Then the boundary of H5MD is
                                 "none" along closed axes, and partner -1 - w of a contact is wall w of System.walls()
    jam/contacts                 row k of each array is the same contact
    jam/analysis                 results of the protocol's analysis by name

The file is sealed (see seal.py), and appears whole or not at all (see replacing.py).
"""
from __future__ import annotations

import contextlib
import functools
import hashlib
import io
import json
import os
import platform
import re
import socket
import time
from dataclasses import astuple, is_dataclass
from pathlib import Path
from typing import Any, Iterator, Mapping

import h5py
import numpy as np

from .. import raw
from .._api.generated import REPORTS
from .._api.given import closed_axes, container_word, walls_of
from ..errors import StateError, StoreError
from .records import of_report
from .replacing import replacing, require_ending
from .seal import SCHEMA, Packing, read_packing, seal

#: The algorithm that makes packings, named by the release that was first to have it. With protocol and seed it is what a
#: packing of an ensemble is. It rises when one protocol and seed are meant to give another packing: another start, order of
#: random numbers or path of the dynamics, another default of an option, a crunch that ends elsewhere as a rule. It stays
#: where a build, a processor or a mended fault changes the last digits, or few packings. Files tell the builds apart.
ALGORITHM = "1.0.0"


def _line(path: str, word: str) -> str:
    """The first line of a file of the system with a word; "" where there is none."""
    with contextlib.suppress(OSError), open(path, encoding="utf-8") as lines:
        return next((line.strip() for line in lines if word in line), "")
    return ""


@functools.lru_cache(maxsize=None)
def provenance() -> dict[str, str]:
    """Version, commit, compiler, BLAS kernel, machine and Python of this process, and a digest of the library itself."""
    compiler, digest = "unknown", ""
    if library := _line("/proc/self/maps", "/libjam.so"):
        data = Path(library.split(maxsplit=5)[5]).read_bytes()
        if found := re.search(rb"(GCC: \([^)]*\) [\d.]+|clang version [\d.]+)", data):
            compiler = found[0].decode()
        digest = hashlib.sha256(data).hexdigest()[:16]
    cpu = _line("/proc/cpuinfo", "model name").partition(":")[2].strip() or platform.machine()
    return {
        "version": raw.jam_version(),
        "algorithm": ALGORITHM,
        "commit": raw.jam_commit(),
        "library": digest,
        "blas_kernel": raw.jam_blas_kernel(),
        "abi": str(raw.jam_abi_version()),
        "compiler": compiler,
        "machine": socket.gethostname(),
        "processor": cpu,
        "python": platform.python_version(),
        "numpy": np.__version__,
    }


def _parts_of(value: Any) -> dict[Any, Any] | None:
    """Of a result that is several, by name."""
    if isinstance(value, dict):
        return value
    if is_dataclass(value):
        return vars(value)
    names = getattr(value, "_fields", ("data", "indices", "indptr") if hasattr(value, "indptr") else None)
    return names and {name: getattr(value, name) for name in names}


def _put(packing: Packing, path: str, value: Any) -> None:
    """Any result of a call: a number, text, an array, a report, a named tuple of them, modes, a sparse matrix (CSR)."""
    if value.__class__ in REPORTS.values():
        packing.arrays[path] = np.array(astuple(value), of_report(value.__class__)[0])
    elif (parts := _parts_of(value)) is not None:
        for key, part in parts.items():
            _put(packing, f"{path}/{key}", part)
    elif isinstance(value, str):  # of fixed length, which lies in one place of a file
        data = value.encode()
        packing.arrays[path] = np.array(data, h5py.string_dtype("utf-8", max(1, len(data))))
    elif value is not None:
        packing.arrays[path] = np.asarray(value)


def image(
    system: Any,
    *,
    refined: bool = False,
    analysis: Mapping[str, Any] | None = None,
    protocol: str | None = None,
    attributes: Mapping[str, Any] | None = None,
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
    protocol : str, optional
        The protocol as JSON.
    attributes : mapping, optional
        Of the group jam, beside the provenance: the name of the protocol, seconds.
    """
    state, packing = system._checkpointed()
    info, known = packing.info, {}
    for name in ("contacts", "report", "history"):
        with contextlib.suppress(StateError):  # there is none before a crunch
            known[name] = getattr(packing, name)
    closed, spheres = closed_axes(info), "particles/spheres"
    about = {"schema": SCHEMA, "seed": info.seed, "protocol": "", **provenance(), "written": time.time(), **(attributes or {})}
    if any(closed):
        about.update(container=container_word(info), walls=np.array(walls_of(info)))
    made = Packing({}, {
        "h5md": {"version": np.array([1, 1], np.int32)},
        "h5md/author": {"name": "unknown"},
        "h5md/creator": {"name": "jam", "version": raw.jam_version()},
        f"{spheres}/box": {
            "dimension": np.int32(packing.dim), "boundary": ["none" if shut else "periodic" for shut in closed],
        },
        "jam": about,
        "jam/analysis": {},
    })
    parts = {
        f"{spheres}/position/value": packing.positions[None],
        f"{spheres}/box/edges/value": packing.cell[None],
        f"{spheres}/box/edges/step": np.zeros(1, np.int64),
        f"{spheres}/box/edges/time": np.zeros(1),
        f"{spheres}/refined": packing.refined_positions() if refined else None,
        "jam/state": np.frombuffer(state, np.uint8),
        "jam/diameters": packing.diameters,
        "jam/report": known.get("report"),
        "jam/history": known.get("history") if known.keys() & {"report", "contacts"} else None,
        "jam/calls": json.dumps(packing.calls),
        "jam/protocol": protocol,
        "jam/analysis": dict(analysis or {}),
        "jam/contacts": known.get("contacts"),
        "jam/coordination": packing.coordination if "contacts" in known else None,
    }
    for path, value in parts.items():
        _put(made, path, value)
    memory = io.BytesIO()
    seal(memory, made)
    return memory.getvalue()


def save(system: Any, path: str | os.PathLike[str], **more: Any) -> None:
    """Writes one packing with all its results; jam.load reads it. The path ends in .h5 or .hdf5. For `more` see image()."""
    require_ending(path, (".h5", ".hdf5"), "save writes HDF5; write() writes other formats")
    data = image(system, **more)
    with replacing(path) as file:
        file.write(data)


def write_shard(
    path: str | os.PathLike[str], protocol: str, packings: Mapping[str, Path | tuple[Path, str | None]]
) -> list[str]:
    """Writes one file of many packings, a group each, from their files by name; (file, name): from a shard.

    Returns what is wrong with each file that cannot be read: it is left out.
    """
    left_out: list[str] = []

    def found() -> Iterator[tuple[str, Packing]]:
        for name, place in packings.items():
            try:
                yield name, read_packing(*(place if isinstance(place, tuple) else (place, None)))
            except StoreError as error:
                left_out.append(str(error.strerror))

    with replacing(path) as file:
        seal(file, found(), protocol=protocol)
    return left_out
