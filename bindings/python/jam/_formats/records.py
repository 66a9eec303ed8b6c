"""Reports as compound values; and what the arrays of a file mean, written beside them as attributes, so that plain h5py
explains itself."""
from __future__ import annotations

import functools
import inspect
import re
from dataclasses import fields
from enum import IntEnum
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from .._api import generated
from .._api.arrays import Array
from .._api.generated import CrunchReport, HistoryColumn, StatusCode, StepPhase, Verdict


def enum_of(kind: str) -> Any:
    """The enum of a field's type; None of numbers and truth values."""
    found = getattr(generated, kind, None)
    return found if isinstance(found, type) and issubclass(found, IntEnum) else None


_UNKNOWN = {"float": float("nan"), "int": -1, "Verdict": Verdict.UNTESTED, "StatusCode": StatusCode.E_STATE}


def fill(made: Array, report: Any = None) -> None:
    """The report of a crunch into a record that has its members. What no crunch made, or an older file does not hold, is
    unknown: nan, -1, a verdict UNTESTED, the status E_STATE. A bool is then false and another enum 0: no certificate, no
    reason.
    """
    there = () if report is None else report.dtype.names or ()
    for f in fields(CrunchReport):
        made[f.name] = report[f.name] if f.name in there else _UNKNOWN.get(str(f.type), 0)


# ---- words beside the arrays
#: Unit and meaning of each array by its name. Lengths have the unit of the box. In H5MD's own group a unit is one of its
#: list, and readers refuse others.
_MEANING = {
    "particles/spheres/refined/high": ("", "centres (n, d) of the proof are high + low, to about 31 digits"),
    "particles/spheres/refined/low": ("", "(n, d), what a double leaves of the centres of the proof"),
    "particles/spheres/position/value": ("", "centres (1, n, d), in the cell whose vectors are box/edges"),
    "particles/spheres/box/edges/value": ("", "cell vectors (1, d, d), one a row"),
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


@functools.lru_cache(maxsize=None)
def _words(cls: Any) -> str:
    """Number and name of each member of an enum, with the meaning that stands beside it in the source."""
    try:  # not by inspect: Python 3.11 cannot parse on two threads at once
        source = Path(generated.__file__).read_text("utf-8")
    except OSError:  # installed without sources
        source = ""
    own = re.search(rf"^class {cls.__name__}\(.*?(?=^\S|\Z)", source, flags=re.M | re.S)
    found = dict(re.findall(r"^    (\w+) = -?\d+  # (.*)$", own[0] if own else "", flags=re.M))
    return "; ".join(f"{int(m)} {m.name.lower()}: {found.get(m.name, '')}".removesuffix(": ") for m in cls)


@functools.lru_cache(maxsize=None)
def of_report(cls: type) -> tuple[np.dtype[Any], dict[str, str]]:
    """The type of a report in a file, enums with their names, and its attributes: fields, and the numbers of each enum."""
    kinds: dict[str, Any] = {"int": "i8", "bool": "i8", "float": "f8"}
    text = {"fields": inspect.cleandoc(cls.__doc__ or "")}
    for kind in {str(f.type): None for f in fields(cls)}:
        if enum := enum_of(kind):
            kinds[kind] = h5py.enum_dtype({m.name: int(m) for m in enum}, basetype="i4")
            text[kind] = _words(enum)
    return np.dtype([(f.name, kinds[str(f.type)]) for f in fields(cls)]), text


_BY_MEMBERS = {tuple(f.name for f in fields(report)): report for report in generated.REPORTS.values()}


def described(path: str, kind: np.dtype[Any]) -> tuple[np.dtype[Any], dict[str, str]]:
    """The type and the attributes of an array in a file: those of a report, which is known by its members, or of its name."""
    if report := _BY_MEMBERS.get(kind.names or ()):
        return of_report(report)
    found = {key: text for key, text in zip(("unit", "description"), _MEANING.get(path, ())) if text}
    if path == "jam/history":
        found.update(fields=_words(HistoryColumn), phase=_words(StepPhase))
    return kind, found
