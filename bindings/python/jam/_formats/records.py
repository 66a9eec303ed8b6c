"""Reports as compound values, and back."""
from __future__ import annotations

from dataclasses import fields
from enum import IntEnum
from typing import Any, Callable

import numpy as np

from .._api import generated
from .._api.arrays import Array
from .._api.generated import StatusCode, Verdict


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
