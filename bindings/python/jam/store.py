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

The file is sealed (see _formats/sealed.py): what is read was written by save() to the last bit, and libhdf5 does not parse it.
Attributes beside the arrays say what they mean (see _formats/explain.py).

A file is made in memory, written beside under a name nobody else has, flushed to the disk, and renamed. Readers hence
see all of a file or none of it, and a writer that is killed leaves only a file of the folder `parts`.
"""
from __future__ import annotations

import functools
import hashlib
import io
import json
import os
import platform
import re
import socket
import time
from dataclasses import fields, is_dataclass
from enum import IntEnum
from pathlib import Path
from tempfile import gettempdir
from typing import Any, Mapping

import h5py
import numpy as np

from ._api.arrays import Array
from ._api import generated, errors
from . import raw
from ._formats.explain import explain, report_text, report_type
from ._formats.replacing import replacing
from ._api.errors import StoreError
from ._api.results import Contacts
from ._formats.sealed import Group, Shard, damaged, open_file, refusing, seal
from .system import System, _restore

SCHEMA = 1
_CONTACTS = ("pairs", "vectors", "gaps", "forces")


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
        enum = getattr(generated, kind, None) if kind not in ("int", "bool", "float") else None
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
    """Version, commit, compiler, BLAS kernel, machine and Python of this process, and a digest of the library itself."""
    compiler, cpu, digest = "unknown", platform.machine(), ""
    path = _library()
    if path:
        data = Path(path).read_bytes()
        found = re.search(rb"(GCC: \([^)]*\) [\d.]+|clang version [\d.]+)", data)
        compiler = found.group(1).decode() if found else compiler
        digest = hashlib.sha256(data).hexdigest()[:16]
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as info:
            cpu = next((line.partition(":")[2].strip() for line in info if line.startswith("model name")), cpu)
    except OSError:
        pass
    return {
        "version": raw.jam_version(),
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


# ---- writing
def _text(value: str) -> Any:
    """Text of fixed length, which lies in one place of a file."""
    data = value.encode()
    return np.array(data, h5py.string_dtype("utf-8", max(1, len(data))))


def _put(group: Any, name: str, value: Any) -> None:
    """Any result of a call: a number, text, an array, a report, a named tuple of them."""
    if hasattr(value, "_asdict"):
        inner = group.create_group(name)
        for key, part in value._asdict().items():
            _put(inner, key, part)
    elif is_dataclass(value):
        cls: Any = type(value)
        node = group.create_dataset(name, data=pack(value).astype(report_type(cls)))
        node.attrs.update(report_text(cls))
    elif value is not None:
        node = group.create_dataset(name, data=_text(value) if isinstance(value, str) else value)
        explain(node, node.name.lstrip("/"))


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
    _put(spheres, "position/value", system.positions[None])
    position = spheres["position"]
    position.create_dataset("step", data=np.zeros(1, np.int64))
    position.create_dataset("time", data=np.zeros(1))
    _put(box, "edges/value", system.cell[None])
    edges = box["edges"]
    edges["step"], edges["time"] = position["step"], position["time"]


_MENDED = "Nothing that was finished is lost: correct this and run again"


def _state(system: System) -> tuple[bytes, list[Any]]:
    """The bytes of a checkpoint, which go through a file, and the calls."""
    try:
        found: tuple[bytes, list[Any]] = system.__reduce__()[1][:2]
    except OSError as error:
        raise StoreError(error.errno or 5, f"the state cannot be written below {gettempdir()}: {error}. {_MENDED}") from error
    return found


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

    def fill(file: Any) -> list[str]:
        _h5md(file, system)
        group = file.create_group("jam")
        group.attrs.update({"schema": SCHEMA, "seed": system.seed, "protocol": protocol_id, **provenance()})
        group.attrs["written"] = time.time()
        group.attrs.update(times or {})
        state, calls = _state(system)
        carried = system._results()
        _put(group, "state", np.frombuffer(state, np.uint8))
        _put(group, "diameters", system.diameters)
        if carried:
            report, contacts, history = carried
            _put(group, "report", report)
            _put(group, "history", history)
            if contacts is not None:
                _put(group, "coordination", system.coordination)
                for name in _CONTACTS:
                    _put(group, "contacts/" + name, getattr(contacts, name))
        _put(group, "calls", json.dumps(calls))
        _put(group, "protocol", protocol)
        results = group.create_group("analysis")
        for name, value in (analysis or {}).items():
            _put(results, name, value)
        return []

    memory = io.BytesIO()
    seal(memory, fill)
    return memory.getvalue()


def write_file(path: str | os.PathLike[str], data: bytes, parts: str | os.PathLike[str] | None = None) -> None:
    """Writes a file so that it is there as a whole or not at all; see _formats/replacing.py."""
    try:
        with replacing(path, parts=parts) as file:
            file.write(data)
    except OSError as error:
        raise StoreError(error.errno, f"{path} cannot be written: {error.strerror}. {_MENDED}") from error


def save(system: System, path: str | os.PathLike[str], **more: Any) -> None:
    """Writes one packing with all its results; jam.load reads it. For `more` see image()."""
    write_file(path, image(system, **more))


def write_shard(path: str | os.PathLike[str], protocol: str, packings: Mapping[str, Path]) -> list[str]:
    """Writes one file of many packings, a group each, from their files by name.

    Returns what is wrong with each file that cannot be read: it is left out.
    """
    left_out: list[str] = []

    def fill(shard: Any) -> list[str]:
        shard.attrs["protocol"], made = protocol, []
        for name, source in packings.items():
            try:
                with open_file(source) as file:  # checked as a whole
                    _jam(file, source)
                    _copy(file, shard.create_group(name))
                    made.append(name)
            except StoreError as error:
                left_out.append(str(error.strerror))
        return made

    try:
        with replacing(path, "w+b") as memory:
            seal(memory, fill)
    except StoreError:
        raise
    except OSError as error:
        raise StoreError(error.errno or 5, f"{path} cannot be written: {error}") from error
    return left_out


def _copy(source: Any, target: Any, at: str = "") -> None:
    """A group of a file into another file."""
    target.attrs.update(source.attrs)
    for name, node in source.items():
        if isinstance(node, Group):
            _copy(node, target.create_group(name), f"{at}{name}/")
        elif at + name == "jam/report":
            _put(target, name, unpack(node, _report_class()))
        else:
            explain(target.create_dataset(name, data=node), at + name)


# ---- reading
def _jam(file: Group | Shard, path: Any) -> Group:
    """The group `jam` of a file of one packing."""
    if isinstance(file, Shard):
        raise StoreError(22, f"{path} is a shard of {len(file)} packings: name one, e.g. name={next(iter(file))!r}")
    if "jam" not in file or "schema" not in file["jam"].attrs:
        raise StoreError(22, f"{path} holds no packing of jam (no group `jam`)")
    found: Group = file["jam"]
    if int(found.attrs["schema"]) > SCHEMA:
        raise StoreError(22, f"{path}: schema {found.attrs['schema']} is newer than this jam, which knows {SCHEMA}")
    return found


def _checked(name: str, value: Array, kind: str, *shape: int) -> Array:
    """An array of a type and a shape, -1 for any length."""
    fits = value.ndim == len(shape) and all(a in (-1, b) for a, b in zip(shape, value.shape))
    if not fits or not np.can_cast(value.dtype, kind, "safe"):
        raise ValueError(f"{name} is {value.dtype} of shape {value.shape}, not {kind} of {shape}")
    return value


def _record(name: str, value: Array, dimensions: int) -> Array:
    """A record of numbers, or a row of them."""
    names = value.dtype.names or ()
    if value.ndim != dimensions or not names or any(value.dtype[k].kind not in "iufb" for k in names):
        raise ValueError(f"{name} is {value.dtype} of shape {value.shape}, not a record of numbers")
    return value


def contacts_of(jam: Group, n: int, dim: int) -> Contacts | None:
    """The contacts in a group `jam`, whose shapes and indices fit n spheres, or None."""
    if "contacts" not in jam:
        return None
    pairs, vectors, gaps, forces = (jam["contacts/" + k] for k in _CONTACTS)
    count = len(_checked("contacts/pairs", pairs, "i4", -1, 2))
    if count and not (0 <= pairs.min() and pairs.max() < n):
        raise ValueError(f"contacts/pairs name spheres {pairs.min()} to {pairs.max()} of {n}")
    _checked("contacts/vectors", vectors, "f8", count, dim)
    _checked("contacts/gaps", gaps, "f8", count)
    _checked("contacts/forces", forces, "f8", count)
    return Contacts(pairs, vectors, gaps, forces)


def results_of(jam: Group, n: int, dim: int) -> tuple[Any, ...] | None:
    """Report, contacts and history of a group `jam`, or None."""
    report = unpack(_record("report", jam["report"], 0)[()], _report_class()) if "report" in jam else None
    contacts = contacts_of(jam, n, dim)
    if report is None and contacts is None:
        return None
    return report, contacts, _record("history", jam["history"], 1) if "history" in jam else None


def _report_class() -> type:
    return generated.REPORTS["jam_crunch_report"]


def load(
    path: str | os.PathLike[str],
    name: str | None = None,
    *,
    unverified: bool = False,
    memory_limit: float | None = None,
) -> System:
    """A packing from a file of save(), of an ensemble, or, by its name, from a shard of Ensemble.export.

    It has its contact network, report and history, so that all calls work as on the system that was saved.

    Parameters
    ----------
    name : str, optional
        Of the packing in a shard.
    unverified : bool
        Reads a file that an older version wrote, or another program changed. Only for files of your own.
    memory_limit : float, optional
        Bytes of the largest file that is read; default a quarter of the machine's memory.

    Raises
    ------
    StoreError
        The file is not there, is damaged, was changed since it was written, or holds no packing. The text names it.
    """
    with open_file(path, unverified, memory_limit) as file, refusing(path):
        if name is not None and name not in file:
            raise StoreError(22, f"{path} holds no packing {name!r}")
        packing: Any = file if name is None else file[name]
        jam, places = _jam(packing, path), packing["particles/spheres/position/value"]
        n = len(_checked("diameters", jam["diameters"], "f8", -1))
        dim = _checked("position/value", places, "f8", 1, n, -1).shape[2]
        calls = json.loads(bytes(jam["calls"][()]))
        if not (isinstance(calls, list) and all(isinstance(c, dict) for c in calls)):
            raise ValueError("jam/calls is not a list of calls")
        try:
            made, stored = _restore(jam["state"][()].tobytes(), calls, []), results_of(jam, n, dim)
            same = not stored or stored[1] is None or np.array_equal(stored[1].table(), made.contacts.table())
        except errors.JamError as error:
            if isinstance(error, MemoryError):
                raise
            raise _unfit(path, f"jam/state: {error}", unverified) from error
        if not (np.array_equal(made.positions, places[0]) and np.array_equal(made.diameters, jam["diameters"])):
            raise _unfit(path, "positions or diameters are not those of jam/state", unverified)
        if not same:
            raise _unfit(path, "contacts are not those of jam/state", unverified)
        return made


def _unfit(path: Any, what: str, unverified: bool) -> StoreError:
    """The error for a file whose parts do not fit each other."""
    if not unverified:
        return damaged(path, what)
    return StoreError(
        22,
        f"{path}: {what}. h5py reads its arrays, and System.from_arrays takes positions, diameters and cell vectors",
    )


def _read(node: Any) -> Any:
    if isinstance(node, Group):
        return {k: _read(v) for k, v in node.items()}
    value = node[()]
    return value.decode() if isinstance(value, bytes) else value


def analysis_of(jam: Group) -> dict[str, Any]:
    """Results of the analysis in a group `jam`: named tuples come back as dicts."""
    found: dict[str, Any] = _read(jam["analysis"]) if "analysis" in jam else {}
    return found


__all__ = ["StoreError", "load", "save", "provenance"]
