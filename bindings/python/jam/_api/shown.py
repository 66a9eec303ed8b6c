"""How results print."""
from __future__ import annotations

from dataclasses import fields
from difflib import get_close_matches
from enum import IntEnum
from typing import Any, Callable

import numpy as np


class Word(IntEnum):
    """A value of an enum of jam.h: a number that prints as its word."""

    def __str__(self) -> str:
        return self.name.lower()

    def __format__(self, spec: str) -> str:
        return int.__format__(self, spec) if spec[-1:] in tuple("bcdeEfFgGnoxX%") else format(str(self), spec)


class Answer(Word):
    """An enum with YES, NO and values that are neither: those have no truth."""

    def __bool__(self) -> bool:
        if self.name not in ("YES", "NO"):
            kind = type(self).__name__
            raise ValueError(f"a {kind} of {self.name} is neither true nor false: compare with {kind}.YES")
        return self.name == "YES"


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


def no_member(report: Any, name: str) -> str:
    """What to say of a member that a report does not have."""
    known = [f.name for f in fields(report)]
    density = name in ("phi", "phi_J", "phi_j", "density", "volume_fraction") and "packing_fraction" in known
    near = ["packing_fraction"] if density else get_close_matches(name, known, 3)
    return f"a {type(report).__name__} has no member {name!r}" + (f"; did you mean {' or '.join(near)}?" if near else "")


_FEW_ROWS = 12


def by_shapes(result: Any) -> str:
    """A named tuple of results: columns of a few rows as a table; else arrays by shape, numbers as they are."""
    if shapes := {value.shape if isinstance(value, np.ndarray) else None for value in result}:
        shape = shapes.pop()
        if not shapes and shape and len(shape) == 1 and shape[0] <= _FEW_ROWS and len(result) > 1:
            return _rows(result)
    parts = (
        f"{name}={'array' + str(value.shape) if isinstance(value, np.ndarray) else value}"
        for name, value in zip(result._fields, result)
    )
    return f"{type(result).__name__}({', '.join(parts)})"


def _rows(result: Any) -> str:
    columns = [[name, *(f"{x:.6g}" for x in value)] for name, value in zip(result._fields, result)]
    widths = [max(map(len, column)) for column in columns]
    lines = ["  ".join(f"{cell:>{width}}" for cell, width in zip(row, widths)) for row in zip(*columns)]
    return "\n  ".join([type(result).__name__, *lines])


def only(names: list[str]) -> Callable[[], list[str]]:
    """`__dir__` of a module: what it is for, without what it imports."""
    return lambda: sorted(names)
