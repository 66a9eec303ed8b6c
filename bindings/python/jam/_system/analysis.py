"""Analyses with a form of their own in Python: proofs, floppy modes, order."""
from __future__ import annotations

from typing import Any

import numpy as np

from .. import raw
from .._api.arrays import Array, as_array, unknown_array
from .._api.calls import not_cancelled
from .._api.generated import FloppyColumn, ProofReport
from .._api.results import FloppyModesResult
from .handle import Base


def _kind(strict: bool) -> str:
    return "strict" if strict else "collective"


class Analysis(Base):
    """Calls of the header whose arguments Python gives in another way."""

    def prove(self, ratio: Any = None, *, strict: bool = False) -> ProofReport:
        """Proves, despite rounding, that the packing is jammed. Contacts and forces are those of the network.

        Status: 'ok' proved exact or trapped, 'ambiguous' not proved: the report's cause says why. The guide's page "Proofs" has
        theorems and limits.

        Parameters
        ----------
        ratio : array_like, shape (n,), optional
            The exact ratios of the diameters, in any unit. Without them the diameters are taken as they are.
        strict : bool
            The cell deforms too: proves that the packing is strictly jammed, with the diameters as they are.

        Returns
        -------
        ProofReport

        Raises
        ------
        ArgumentError, NonfiniteError, StateError, UnsupportedError
        """
        return self.call("prove", _kind(strict), ratio)

    def write_proof(self, path: str, ratio: Any = None, *, strict: bool = False) -> None:
        """Writes the exact numbers of the proof, which jamproof.py checks with integers alone. Arguments are those of prove().

        Raises
        ------
        ArgumentError, NonfiniteError, StateError, UnsupportedError, IoError
        """
        self.call("write_proof", path, _kind(strict), ratio)

    def floppy_modes(self, *, progress: Any = None) -> FloppyModesResult:
        """The floppy mode of every contact, measured. Needs a single state of self-stress.

        Parameters
        ----------
        progress : bool or callable, optional
            True: a line that changes. A callable gets a Progress; a true answer stops the call.

        Returns
        -------
        FloppyModesResult
            Its arrays have the shape (contacts,).

        Raises
        ------
        StateError, SolverError, MemoryError, BusyError
        """
        table, _ = self._floppy(None, len(self._ask("forces")), False, progress)
        return FloppyModesResult(*np.ascontiguousarray(table.T))

    def floppy_mode(self, contact: int, *, progress: Any = None) -> Array:
        """Displacement over s when one contact opens by s, shape (N', d), of the stable spheres.

        To first order all other contacts stay closed, all diameters change by one factor, and there is no net translation.

        Parameters
        ----------
        contact : int
            Its number among `contacts`.
        progress : bool or callable, optional
            As of floppy_modes().

        Raises
        ------
        ArgumentError, StateError, SolverError, MemoryError, BusyError
        """
        _, vector = self._floppy(as_array([contact], "int64_t", "contact"), 1, True, progress)
        return vector[0]

    def _floppy(self, contact: Any, m: int, moved: bool, progress: Any) -> tuple[Array, Array]:
        """Rows of the table, and the vectors where they are wanted."""
        table = unknown_array((m, len(FloppyColumn)))
        vector = unknown_array((m if moved else 0, len(self._ask("hessian_map")), self.dim))
        with self._reporting(progress):
            status, _ = raw.jam_floppy_modes(
                self.handle, contact, raw.JAM_FLOPPY_COLUMNS, table.reshape(-1), vector.reshape(-1) if moved else None
            )
            self._note(not_cancelled(status))
        return table, vector

    def crystal_score(self) -> float:
        """Order of equal spheres: g at sqrt 2 mean diameters over its mean in 1.2 .. 1.6.

        Below 1 in a good glass, whose g(r) has a minimum there, and about 10 in a perfect FCC crystal. No network is needed.

        Returns
        -------
        float

        Raises
        ------
        ArgumentError, UnsupportedError
        """
        reach, bins = 2.0, 400
        g = self.call("pair_correlation", None, r_max=reach, bins=bins)
        r = (np.arange(bins) + 0.5) * (reach / bins)
        shell = r ** (self.dim - 1)
        near, around = np.abs(r - np.sqrt(2)) < 0.02, (r > 1.2) & (r < 1.6)
        mean = float((g * shell)[around].sum() / shell[around].sum())
        return float((g * shell)[near].sum() / shell[near].sum()) / mean if mean > 0 else 0.0
