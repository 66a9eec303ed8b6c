"""One packing, one HDF5 file: positions and box as H5MD, all else in the group `jam`.

    h5md, particles/spheres      H5MD 1.1: box/edges as a full matrix, position as a trajectory of one frame
    jam  (attributes)            schema, seed, protocol (its name), provenance
    jam/state                    bytes of a checkpoint: what dynamics depend on, velocities and random shifts among it
    jam/diameters                (n,), unit of the box
    jam/report                   report of the crunch, one compound value
    jam/contacts                 pairs, vectors, gaps, forces: row k of each is the same contact
    jam/coordination             (n,) contacts of each sphere, 0 for rattlers
    jam/history                  steps of the crunch, a compound value a step
    jam/protocol, jam/calls      JSON: the protocol; the calls made with every option and what ended them
    jam/analysis                 results of the protocol's analysis by name

A file is made in memory, written beside under a name nobody else has, flushed to the disk, and renamed. Readers hence
see all of a file or none of it, and a writer that is killed leaves only a file of the folder `parts`.
"""
from __future__ import annotations

import functools
import io
import json
import os
import platform
import re
import socket
import time
import uuid
from dataclasses import fields, is_dataclass
from enum import IntEnum
from pathlib import Path
from typing import Any, Mapping

import numpy as np

from ._types import Array
from . import _generated, raw
from ._paths import replaceable
from .results import Contacts
from .system import System, _restore

try:
    import h5py
except ImportError as error:  # pragma: no cover
    raise ImportError("packings are stored by h5py: install python3-h5py") from error

SCHEMA = 1
_CONTACTS = ("pairs", "vectors", "gaps", "forces")


class StoreError(OSError):
    """A file of packings that cannot be written or read; the text names the file, the cause and what to do."""


# ---- compound values
def _dtype(cls: type) -> np.dtype[Any]:
    kinds = {"int": "i8", "bool": "i8", "float": "f8"}
    return np.dtype([(f.name, kinds.get(str(f.type), "i4")) for f in fields(cls)])


def pack(report: Any) -> Array:
    """A report as one compound value; enums as their numbers."""
    made = np.zeros((), _dtype(type(report)))
    for f in fields(report):
        made[f.name] = getattr(report, f.name)
    return made


def unpack(value: Array, cls: type) -> Any:
    """A report of a class from a compound value; what an older file does not hold is nan or 0."""
    given: dict[str, Any] = {}
    for f in fields(cls):
        known, kind = f.name in (value.dtype.names or ()), str(f.type)
        number = value[f.name].item() if known else float("nan") if kind == "float" else 0
        enum = getattr(_generated, kind, None) if kind not in ("int", "bool", "float") else None
        if isinstance(enum, type) and issubclass(enum, IntEnum) and number in set(enum):
            number = enum(number)
        given[f.name] = bool(number) if kind == "bool" else number
    return cls(**given)


# ---- where a packing was made
def _library() -> str | None:
    try:
        with open("/proc/self/maps", encoding="utf-8") as maps:
            return next((line.split(maxsplit=5)[5].strip() for line in maps if "/libjam.so" in line), None)
    except OSError:
        return None


@functools.lru_cache(maxsize=None)
def provenance() -> dict[str, str]:
    """Version, compiler, BLAS kernel, machine and Python of this process."""
    compiler, cpu = "unknown", platform.machine()
    path = _library()
    if path:
        found = re.search(rb"(GCC: \([^)]*\) [\d.]+|clang version [\d.]+)", Path(path).read_bytes())
        compiler = found.group(1).decode() if found else compiler
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as info:
            cpu = next((line.partition(":")[2].strip() for line in info if line.startswith("model name")), cpu)
    except OSError:
        pass
    return {
        "version": raw.jam_version(),
        "blas_kernel": raw.jam_blas_kernel(),
        "abi": str(raw.jam_abi_version()),
        "compiler": compiler,
        "machine": socket.gethostname(),
        "processor": cpu,
        "python": platform.python_version(),
        "numpy": np.__version__,
    }


# ---- writing
def _put(group: Any, name: str, value: Any) -> None:
    """Any result of a call: a number, text, an array, a report, a named tuple of them."""
    if hasattr(value, "_asdict"):
        inner = group.create_group(name)
        for key, part in value._asdict().items():
            _put(inner, key, part)
    elif is_dataclass(value):
        group.create_dataset(name, data=pack(value))
    elif value is not None:
        group.create_dataset(name, data=value)


def _h5md(file: Any, system: System) -> None:
    head = file.create_group("h5md")
    head.attrs["version"] = np.array([1, 1], np.int32)
    head.create_group("author").attrs["name"] = "unknown"
    creator = head.create_group("creator")
    creator.attrs["name"], creator.attrs["version"] = "jam", raw.jam_version()
    spheres = file.create_group("particles/spheres")
    box = spheres.create_group("box")
    box.attrs["dimension"] = np.int32(system.dim)
    box.attrs["boundary"] = ["periodic"] * system.dim
    position = spheres.create_group("position")
    position.create_dataset("value", data=system.positions[None])
    position.create_dataset("step", data=np.zeros(1, np.int64))
    position.create_dataset("time", data=np.zeros(1))
    edges = box.create_group("edges")
    edges.create_dataset("value", data=system.cell[None])
    edges["step"], edges["time"] = position["step"], position["time"]


def image(
    system: System,
    *,
    analysis: Mapping[str, Any] | None = None,
    protocol: str | None = None,
    protocol_id: str = "",
    times: Mapping[str, float] | None = None,
) -> bytes:
    """The bytes of a packing's file.

    Parameters
    ----------
    system : System
        Any state; the network is stored where there is one.
    analysis : mapping, optional
        Results by name: numbers, arrays, reports, named tuples of them.
    protocol, protocol_id : str, optional
        The protocol as JSON and its name.
    times : mapping, optional
        Seconds by name, beside the moment of writing.
    """
    memory = io.BytesIO()
    with h5py.File(memory, "w") as file:  # the oldest layout: every HDF5 reads it
        _h5md(file, system)
        group = file.create_group("jam")
        group.attrs.update({"schema": SCHEMA, "seed": system.seed, "protocol": protocol_id, **provenance()})
        group.attrs["written"] = time.time()
        group.attrs.update(times or {})
        state, carried, calls = system.__reduce__()[1][:3]
        group.create_dataset("state", data=np.frombuffer(state, np.uint8))
        group.create_dataset("diameters", data=system.diameters)
        if carried:
            report, contacts, history = carried
            _put(group, "report", report)
            _put(group, "history", history)
            if contacts is not None:
                group.create_dataset("coordination", data=system.coordination)
                for name in _CONTACTS:
                    group.create_dataset("contacts/" + name, data=getattr(contacts, name))
        group.create_dataset("calls", data=json.dumps(calls))
        if protocol:
            group.create_dataset("protocol", data=protocol)
        results = group.create_group("analysis")
        for name, value in (analysis or {}).items():
            _put(results, name, value)
    return memory.getvalue()


def write_file(path: str | os.PathLike[str], data: bytes, parts: str | os.PathLike[str] | None = None) -> None:
    """Writes a file so that it is there as a whole or not at all: beside, flushed to the disk, renamed.

    Parameters
    ----------
    parts : path, optional
        Folder of the unfinished file, on the same file system; default that of the file.
    """
    try:
        path = Path(replaceable(path))
    except OSError as error:
        raise StoreError(error.errno, f"{path} cannot be written: {error.strerror}") from error
    name = f".{path.name}.{socket.gethostname()}.{os.getpid()}.{uuid.uuid4().hex[:8]}.part"
    beside = Path(parts or path.parent) / name
    try:
        descriptor = os.open(beside, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
        try:
            with os.fdopen(descriptor, "wb") as file:
                file.write(data)
                file.flush()
                os.fsync(file.fileno())
            os.replace(beside, path)
        except BaseException:
            os.unlink(beside)
            raise
        folder = os.open(path.parent, os.O_RDONLY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)
    except OSError as error:
        raise StoreError(
            error.errno,
            f"{path} cannot be written: {error.strerror}. Nothing that was finished is lost: "
            "mend this and run again",
        ) from error


def save(system: System, path: str | os.PathLike[str], **more: Any) -> None:
    """Writes one packing with all its results; jam.load reads it. For `more` see image()."""
    write_file(path, image(system, **more))


# ---- reading
def open_file(path: str | os.PathLike[str]) -> Any:
    """The h5py.File of a packing or of a shard, read-only."""
    try:
        return h5py.File(path, "r", locking=False)
    except FileNotFoundError:
        raise StoreError(2, f"{path}: there is no such file") from None
    except OSError as error:
        raise StoreError(5, f"{path} is no file of packings: {error}") from error


def _jam(group: Any, path: Any) -> Any:
    found = group.get("jam")
    if found is None or "schema" not in found.attrs:
        names = [k for k, v in group.items() if isinstance(v, h5py.Group) and "jam" in v]
        if names:
            raise StoreError(22, f"{path} is a shard of {len(names)} packings: name one, e.g. name={names[0]!r}")
        raise StoreError(22, f"{path} holds no packing of jam (no group `jam`)")
    if int(found.attrs["schema"]) > SCHEMA:
        raise StoreError(22, f"{path}: schema {found.attrs['schema']} is newer than this jam, which knows {SCHEMA}")
    return found


def results_of(jam: Any) -> tuple[Any, ...] | None:
    """Report, contacts and history of a group `jam`, or None."""
    report = unpack(jam["report"][()], _report_class()) if "report" in jam else None
    contacts = Contacts(*(jam["contacts/" + k][()] for k in _CONTACTS)) if "contacts" in jam else None
    if report is None and contacts is None:
        return None
    return report, contacts, jam["history"][()] if "history" in jam else None


def _report_class() -> type:
    return _generated.REPORTS["jam_crunch_report"]


def load(path: str | os.PathLike[str], name: str | None = None) -> System:
    """A packing from a file of save(), of an ensemble, or, by its name, from a shard of Ensemble.export.

    Reports, contacts, forces, coordination and history are those that were stored. Calls that need the network in
    memory (Hessian, modes, floppy modes) ask for contacts_from_geometry() first.
    """
    with open_file(path) as file:
        if name is not None and name not in file:
            raise StoreError(22, f"{path} holds no packing {name!r}")
        jam = _jam(file if name is None else file[name], path)
        calls = json.loads(jam["calls"][()])
        return _restore(jam["state"][()].tobytes(), results_of(jam), calls, [])


def _read(node: Any) -> Any:
    if isinstance(node, h5py.Group):
        return {k: _read(v) for k, v in node.items()}
    value = node[()]
    return value.decode() if isinstance(value, bytes) else value


def analysis_of(jam: Any) -> dict[str, Any]:
    """Results of the analysis in a group `jam`: named tuples come back as dicts."""
    found: dict[str, Any] = _read(jam["analysis"]) if "analysis" in jam else {}
    return found


__all__ = ["StoreError", "load", "save", "provenance"]
