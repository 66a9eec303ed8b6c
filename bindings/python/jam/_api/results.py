"""What calls return: the contact network, modes, floppy modes."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from .arrays import Array
from .generated import StatusCode
from .shown import by_shapes


@dataclass(frozen=True)
class Contacts:
    """The contact network. Row k of every array is the same contact.

    Attributes
    ----------
    pairs : int32 array, shape (contacts, 2)
        i < j, or i = j for a sphere and its own image. j = -1 - w for the wall of row w of System.walls().
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


class Correlation(np.ndarray[Any, np.dtype[np.float64]]):
    """g(r), shape (bins,): an array, so that programs for 1.0 run on. What is computed of it is a plain one.

    Attributes
    ----------
    r : array, shape (bins,)
        The middles of the bins, in mean diameters.
    """

    r: Array

    def __array_wrap__(self, made: Any, *_: Any) -> Any:
        return np.asarray(made)[()]


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
        return np.sqrt(np.maximum(self.values, 0.0))

    def __len__(self) -> int:
        return len(self.values)

    def __repr__(self) -> str:
        w = self.frequencies
        return f"Modes({len(self)} modes of {len(self.spheres)} spheres" + (
            f", omega {w[0]:.4g}..{w[-1]:.4g})" if len(w) else ")"
        )


class FloppyModesResult(NamedTuple):
    """Floppy modes by contact, shape (contacts,) each; dr is the mode and F the mean force. Openings have the unit of
    positions. s_return is s* of R. Diaz Hernandez Rojas, PhD thesis, Sapienza 2021, whose index is twice stability."""

    median: Array  # b = median |dr_i| / |dr|: far below 1/sqrt(N') when the mode is localised
    weight: Array  # W = f / median |dr_i|: f equals W times the displacement far away
    s_plus: Array  # opening at which, to first order, the next contact forms
    s_star: Array  # opening at which, to second order, the diameters are least
    stability: Array  # s_star / s_plus
    s_return: Array  # opening 2 s_star at which, to second order, the diameters are back at their start

    def __repr__(self) -> str:
        return by_shapes(self)
