"""What calls return: reports that print as tables, the contact network, modes."""
from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from . import _calls
from ._generated import StatusCode


def _text(value: Any) -> str:
    if hasattr(value, "name"):
        return value.name.lower()
    return f"{value:.12g}" if isinstance(value, float) else str(value)


def _repr(self: Any) -> str:
    width = max(len(f.name) for f in fields(self))
    lines = [f"  {f.name:{width}s}  {_text(getattr(self, f.name))}" for f in fields(self)]
    status = getattr(self, "status", None)
    head = type(self).__name__ + (f" ({status.name.lower()})" if status is not None and status != 0 else "")
    return "\n".join([head] + lines)


for _class in set(_calls.REPORTS.values()):
    _class.__repr__ = _repr  # reports print as a table
    _class.status = StatusCode.OK  # > 0: stopped early, and why; the state is valid


@dataclass(frozen=True)
class Contacts:
    """The contact network; row k of every array is the same contact.

    pairs: (contacts, 2) int32, i < j (i = j for an image of one sphere). vectors: (contacts, d), unit vectors from j
    to i. gaps: (contacts,), h = r/sigma_ij - 1. forces: (contacts,), mean 1.
    """

    pairs: np.ndarray
    vectors: np.ndarray
    gaps: np.ndarray
    forces: np.ndarray

    def __len__(self) -> int:
        return len(self.pairs)

    def __repr__(self) -> str:
        return f"Contacts({len(self)} pairs, d = {self.vectors.shape[1]})"

    def table(self) -> np.ndarray:
        """As one structured array with fields i, j, vector, gap, force."""
        d = self.vectors.shape[1]
        rows = np.empty(len(self), [("i", "i4"), ("j", "i4"), ("vector", "f8", (d,)), ("gap", "f8"), ("force", "f8")])
        rows["i"], rows["j"] = self.pairs[:, 0], self.pairs[:, 1]
        rows["vector"], rows["gap"], rows["force"] = self.vectors, self.gaps, self.forces
        return rows


@dataclass(frozen=True)
class Modes:
    """Modes of a network, ascending. values: (m,) = omega^2; nan where the solver stopped early (then status > 0).

    vectors: (m, N', d) of unit length; participation: (m,), sum |v_i|^4 / (sum |v_i|^2)^2, 1/N' to 1.
    spheres: (N',), the index of each stable sphere.
    """

    values: np.ndarray
    vectors: np.ndarray
    participation: np.ndarray
    spheres: np.ndarray
    status: StatusCode = StatusCode.OK

    @property
    def frequencies(self) -> np.ndarray:
        """(m,): omega, with round-off below zero taken as zero."""
        return np.sqrt(np.maximum(self.values, 0.0))

    def __len__(self) -> int:
        return len(self.values)

    def __repr__(self) -> str:
        w = self.frequencies
        return f"Modes({len(self)} modes of {len(self.spheres)} spheres" + (
            f", omega {w[0]:.4g}..{w[-1]:.4g})" if len(w) else ")"
        )
