"""What calls return: reports that print as tables, the contact network, modes."""
from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from .arrays import Array
from .._system import methods
from .generated import REPORTS, StatusCode


def _text(value: Any) -> str:
    if hasattr(value, "name"):
        found: str = value.name.lower()
        return found
    return f"{value:.12g}" if isinstance(value, float) else str(value)


def _repr(self: Any) -> str:
    width = max(len(f.name) for f in fields(self))
    lines = [f"  {f.name:{width}s}  {_text(getattr(self, f.name))}" for f in fields(self)]
    status = getattr(self, "status", None)
    head = type(self).__name__ + (f" ({status.name.lower()})" if status is not None and status != 0 else "")
    if text := getattr(self, "status_text", ""):
        head += ": " + text
    return "\n".join([head] + lines)


for _class in set(REPORTS.values()):
    setattr(_class, "__repr__", _repr)  # reports print as a table


def _paragraph(self: Any) -> str:
    return getattr(self, "text", "") or _repr(self)


setattr(REPORTS["jam_check_report"], "__str__", _paragraph)
setattr(REPORTS["jam_check_report"], "__repr__", _paragraph)


def _short(self: Any) -> str:
    """A named tuple of results: arrays by shape, numbers as they are."""
    parts = (
        f"{name}={'array' + str(value.shape) if isinstance(value, np.ndarray) else value}"
        for name, value in zip(self._fields, self)
    )
    return f"{type(self).__name__}({', '.join(parts)})"


for _class in vars(methods).values():
    if isinstance(_class, type) and issubclass(_class, tuple):
        setattr(_class, "__repr__", _short)


@dataclass(frozen=True)
class Contacts:
    """The contact network. Row k of every array is the same contact.

    Attributes
    ----------
    pairs : int32 array, shape (contacts, 2)
        i < j, or i = j for a sphere and its own image.
    vectors : array, shape (contacts, d)
        Unit vectors from j to i.
    gaps : array, shape (contacts,)
        h = r/sigma_ij - 1.
    forces : array, shape (contacts,)
        Mean 1.
    """

    pairs: Array
    vectors: Array
    gaps: Array
    forces: Array

    def __len__(self) -> int:
        return len(self.pairs)

    def __repr__(self) -> str:
        return f"Contacts({len(self)} pairs, d = {self.vectors.shape[1]})"

    def table(self) -> Array:
        """One structured array with fields i, j, n1 ... nd (unit vector), gap, force; pandas.DataFrame takes it."""
        axes = [f"n{k + 1}" for k in range(self.vectors.shape[1])]
        columns = [("i", "i4"), ("j", "i4")] + [(name, "f8") for name in (*axes, "gap", "force")]
        rows = np.empty(len(self), columns)
        rows["i"], rows["j"] = self.pairs[:, 0], self.pairs[:, 1]
        for k, name in enumerate(axes):
            rows[name] = self.vectors[:, k]
        rows["gap"], rows["force"] = self.gaps, self.forces
        return rows


@dataclass(frozen=True)
class Modes:
    """Modes of a network, in ascending order.

    Attributes
    ----------
    values : array, shape (m,)
        omega squared; nan where the solver stopped early (then status > 0).
    vectors : array, shape (m, N', d)
        Of unit length.
    participation : array, shape (m,)
        The sum of the fourth powers over the squared sum of squares, between 1/N' and 1.
    spheres : array, shape (N',)
        The index of each stable sphere.
    """

    values: Array
    vectors: Array
    participation: Array
    spheres: Array
    status: StatusCode = StatusCode.OK

    @property
    def frequencies(self) -> Array:
        """(m,): omega, with round-off below zero taken as zero."""
        found: Array = np.sqrt(np.maximum(self.values, 0.0))
        return found

    def __len__(self) -> int:
        return len(self.values)

    def __repr__(self) -> str:
        w = self.frequencies
        return f"Modes({len(self)} modes of {len(self.spheres)} spheres" + (
            f", omega {w[0]:.4g}..{w[-1]:.4g})" if len(w) else ")"
        )
