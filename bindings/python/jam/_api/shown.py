"""How results print."""
from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np


def _text(value: Any) -> str:
    if hasattr(value, "name"):
        found: str = value.name.lower()
        return found
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
