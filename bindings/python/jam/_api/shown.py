"""How results print."""
from __future__ import annotations

from dataclasses import fields
from enum import IntEnum
from typing import Any

import numpy as np


class Word(IntEnum):
    """A value of an enum of jam.h: a number that prints as its word."""

    def __str__(self) -> str:
        return self.name.lower()

    def __format__(self, spec: str) -> str:
        return int.__format__(self, spec) if spec[-1:] in tuple("bcdeEfFgGnoxX%") else format(str(self), spec)


def _text(value: Any) -> str:
    return f"{value:.12g}" if isinstance(value, float) else str(value)


def as_table(report: Any) -> str:
    """A report: its name, a status that is not OK with its reason, and a line a field."""
    width = max(len(f.name) for f in fields(report))
    lines = [f"  {f.name:{width}s}  {_text(getattr(report, f.name))}" for f in fields(report)]
    status = getattr(report, "status", None)
    head = type(report).__name__ + (f" ({status.name.lower()})" if status is not None and status != 0 else "")
    if text := getattr(report, "status_text", ""):
        head += ": " + text
    return "\n".join([head] + lines)


def by_shapes(result: Any) -> str:
    """A named tuple of results: arrays by shape, numbers as they are."""
    parts = (
        f"{name}={'array' + str(value.shape) if isinstance(value, np.ndarray) else value}"
        for name, value in zip(result._fields, result)
    )
    return f"{type(result).__name__}({', '.join(parts)})"
