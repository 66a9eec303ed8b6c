"""Reports as compound values, and back."""
from __future__ import annotations

from dataclasses import fields
from enum import IntEnum
from typing import Any

import numpy as np

from .._api import generated
from .._api.arrays import Array
from .._api.generated import StatusCode, Verdict


def dtype_of(cls: type) -> np.dtype[Any]:
    kinds = {"int": "i8", "bool": "i8", "float": "f8"}
    return np.dtype([(f.name, kinds.get(str(f.type), "i4")) for f in fields(cls)])


def unknown(kind: str) -> Any:
    """What stands for a member of a report that was never made: nan, -1, a verdict UNTESTED, the status E_STATE.

    A bool is false and another enum 0: no certificate, no reason.
    """
    known = {"float": float("nan"), "int": -1, "Verdict": Verdict.UNTESTED, "StatusCode": StatusCode.E_STATE}
    return known.get(kind, 0)


def pack(report: Any) -> Array:
    """A report as one compound value; enums as their numbers."""
    made = np.zeros((), dtype_of(type(report)))
    for f in fields(report):
        made[f.name] = getattr(report, f.name)
    return made


def unpack(value: Array, cls: type) -> Any:
    """A report of a class from a compound value; what an older file does not hold is unknown."""
    given: dict[str, Any] = {}
    for f in fields(cls):
        known, kind = f.name in (value.dtype.names or ()), str(f.type)
        number = value[f.name].item() if known else unknown(kind)
        enum = getattr(generated, kind, None) if kind not in ("int", "bool", "float") else None
        if isinstance(enum, type) and issubclass(enum, IntEnum) and number in set(enum):
            number = enum(number)
        given[f.name] = bool(number) if kind == "bool" else number
    return cls(**given)
