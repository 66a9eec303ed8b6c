"""Reports as compound values, and back; and what the arrays of a file mean, written beside them as attributes, so that plain
h5py explains itself."""
from __future__ import annotations

import functools
import inspect
import re
from dataclasses import astuple, fields
from enum import IntEnum
from typing import Any, Callable

import h5py
import numpy as np

from .._api import generated
from .._api.arrays import Array
from .._api.generated import HistoryColumn, StatusCode, StepPhase, Verdict


def enum_of(kind: str) -> Any:
    """The enum of a field's type; None of numbers and truth values."""
    found = getattr(generated, kind, None)
    return found if isinstance(found, type) and issubclass(found, IntEnum) else None


def dtype_of(cls: type, of_enum: Callable[[Any], Any] = lambda _: "i4") -> np.dtype[Any]:
    """A report as one compound value; of_enum: what an enum is in it."""
    kinds = {"int": "i8", "bool": "i8", "float": "f8"}
    return np.dtype([(f.name, kinds.get(str(f.type)) or of_enum(enum_of(str(f.type)))) for f in fields(cls)])


def unknown(kind: str) -> Any:
    """What stands for a member of a report that was never made: nan, -1, a verdict UNTESTED, the status E_STATE.

    A bool is false and another enum 0: no certificate, no reason.
    """
    known = {"float": float("nan"), "int": -1, "Verdict": Verdict.UNTESTED, "StatusCode": StatusCode.E_STATE}
    return known.get(kind, 0)


def unpack(value: Array, cls: type) -> Any:
    """A report of a class from a compound value; what an older file does not hold is unknown."""
    given: dict[str, Any] = {}
    for f in fields(cls):
        known, kind = f.name in (value.dtype.names or ()), str(f.type)
        number, enum = value[f.name].item() if known else unknown(kind), enum_of(kind)
        given[f.name] = bool(number) if kind == "bool" else enum(number) if enum and number in set(enum) else number
    return cls(**given)


# ---- words beside the arrays
#: Unit and meaning of each array by its name. Lengths have the unit of the box.
_MEANING = {
    "particles/spheres/refined/high": ("length", "centres (n, d) of the proof are high + low, to about 31 digits"),
    "particles/spheres/refined/low": ("length", "(n, d), what a double leaves of the centres of the proof"),
    "particles/spheres/position/value": ("length", "centres (1, n, d), in the cell whose vectors are box/edges"),
    "particles/spheres/box/edges/value": ("length", "cell vectors (1, d, d), one a row"),
    "jam/state": ("", "bytes of a checkpoint of libjam, which System.from_checkpoint reads: all that dynamics need"),
    "jam/diameters": ("length", "diameter of each sphere (n,)"),
    "jam/contacts/pairs": ("", "spheres i < j of each contact, from 0; i = j: a sphere and its own image"),
    "jam/contacts/vectors": ("1", "unit vector from the centre of j to that of i, of the image that touches"),
    "jam/contacts/gaps": ("1", "h = r / sigma_ij - 1: 0 touches, > 0 open, < 0 overlaps"),
    "jam/contacts/forces": ("1", "force of each contact, mean 1; > 0 pushes the spheres apart; NaN: contacts by distance"),
    "jam/coordination": ("1", "contacts of each sphere (n,); 0: a rattler"),
    "jam/report": ("", "report of the crunch: jam_crunch_report of jam.h"),
    "jam/history": ("", "steps of the crunch in order, one a row"),
    "jam/calls": ("", "JSON: the calls that moved the spheres, each with all options and what ended it"),
    "jam/protocol": ("", "JSON: the protocol of the ensemble, every default spelled out"),
}


def _members(cls: type) -> list[tuple[IntEnum, str]]:
    """Members of an enum with the meaning that stands beside each in the source."""
    try:
        found = dict(re.findall(r"^    (\w+) = -?\d+  # (.*)$", inspect.getsource(cls), flags=re.M))
    except OSError:  # installed without sources
        found = {}
    members: Any = cls
    return [(m, found.get(m.name, "")) for m in members]


def _words(cls: type) -> str:
    return "; ".join(f"{int(m)} {m.name.lower()}" + (f": {text}" if text else "") for m, text in _members(cls))


def _as_enum(enum: Any) -> Any:
    """An enum of HDF5, with its names."""
    return h5py.enum_dtype({m.name: int(m) for m in enum}, basetype="i4") if enum else "i4"


@functools.lru_cache(maxsize=None)
def _report(cls: type) -> tuple[np.dtype[Any], dict[str, str]]:
    """The type of a report in a file, and its attributes: its fields, and the numbers of each enum."""
    enums = {str(f.type): enum_of(str(f.type)) for f in fields(cls)}
    text = {kind: _words(enum) for kind, enum in enums.items() if enum}
    return dtype_of(cls, _as_enum), {"fields": inspect.cleandoc(cls.__doc__ or ""), **text}


def report_value(report: Any) -> Any:
    """A report as a file has it."""
    return np.array(astuple(report), _report(report.__class__)[0])


def report_text(report: Any) -> dict[str, str]:
    """Its attributes: its fields, and the numbers of each enum."""
    return _report(report.__class__)[1]


@functools.lru_cache(maxsize=None)
def _history_text() -> dict[str, str]:
    columns = "; ".join(f"{m.name.lower()}: {text}" for m, text in _members(HistoryColumn))
    return {"fields": columns, "phase": _words(StepPhase)}


def explanation(path: str) -> dict[str, str]:
    """Attributes of an array, where its name is known."""
    unit, meaning = _MEANING.get(path, ("", ""))
    found = {}
    # in H5MD's own group a unit is one of its list, and readers refuse others; ours has any unit of length
    if unit and not path.startswith("particles/"):
        found["unit"] = unit
    if meaning:
        found["description"] = meaning
    return found | (_history_text() if path == "jam/history" else {})
