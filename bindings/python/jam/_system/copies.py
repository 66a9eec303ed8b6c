"""Copies of a packing side by side: as a system of their own, and from one cell by their wave vectors."""
from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from .. import raw
from .._api.arrays import Array, as_vector, unknown_array
from .._api.calls import not_cancelled, same
from .._api.generated import BlochColumn, ModeColumn
from .._api.options import option_struct
from .._api.results import Modes
from .._api.shown import by_shapes
from .handle import Base


class BlochRigidityResult(NamedTuple):
    """What bloch_rigidity returns: a row for each wave vector."""

    wave: Array
    flexes: Array
    margin: Array

    def __repr__(self) -> str:
        return by_shapes(self)


class Copies(Base):
    """Copies of the cell."""

    def tile(self, count: Any) -> Any:
        """An exact supercell: count[c] copies side by side along each cell vector.

        Velocities, contacts and forces go along, so `forces`, `contacts` and `rigidity` need no crunch. A packing that
        is jammed in one cell may not be jammed here: `rigidity` tests it. Where a sphere touches its own image and the contacts
        do not list it (a fixed cell), the copies have none, and a note: call `contacts_from_geometry`.

        Parameters
        ----------
        count : array_like of int, shape (d,)
            Copies along each cell vector; 1 along axes with walls.

        Returns
        -------
        System
            Sphere i of copy (k_0, k_1, ...) is number i + n (k_0 + count[0] (k_1 + count[1] ...)). The vectors of its
            cell are count[c] times those of this one, less multiples of earlier ones where that shortens them.

        Examples
        --------
        >>> import jam
        >>> disks = jam.System.random(n=16, dim=2, seed=1, diameters=[1.0] * 8 + [1.4] * 8)
        >>> report = disks.crunch()
        >>> large = disks.tile((3, 2))
        >>> large.n, len(large.forces) == 6 * report.contacts
        (96, True)
        """
        return type(self)._made(*raw.jam_tile(self.handle, as_vector(count, "int32_t", "count")))  # type: ignore[attr-defined]

    def bloch_modes(
        self,
        wave: Any,
        stiffness: int | str = "harmonic",
        *,
        alpha: float | None = None,
        prestress: float | None = None,
        progress: Any = None,
    ) -> Modes:
        """All modes at a wave vector: the copy of a sphere s_c cells away moves by exp(2 pi i wave . s) times its own motion.

        The modes of tile(count) are those of all wave[c] = q / count[c] together. Refused where a sphere touches its own
        image, the contacts do not list it (a fixed cell), and both move differently at this wave vector.

        Parameters
        ----------
        wave : array_like, shape (d,)
            In units of the reciprocal cell vectors. 0 has the modes of `modes`.
        stiffness : {'harmonic', 'power', 'hard', 'soft'}
            As in `hessian`.
        alpha : float, optional
            Of stiffness 'power', > 1.
        prestress : float, optional
            Overlap (of 'hard' the gap) of a contact of mean force, over the mean diameter.
        progress : bool or callable, optional
            As of `modes`.

        Returns
        -------
        Modes
            Ascending, with complex vectors of shape (d N', N', d) and of unit length.

        Examples
        --------
        >>> import jam
        >>> disks = jam.System.random(n=16, dim=2, seed=1, diameters=[1.0] * 8 + [1.4] * 8)
        >>> report = disks.crunch()
        >>> disks.bloch_modes((0.5, 0)).vectors.shape == (2 * report.stable, report.stable, 2)
        True
        """
        with self._reporting(progress):
            h = option_struct("jam_hessian_options", {"stiffness": stiffness, "alpha": alpha, "prestress": prestress})
            spheres = self._ask("hessian_map")
            m = self.dim * len(spheres)
            table, vectors = unknown_array((m, len(ModeColumn))), unknown_array((m, len(spheres), self.dim, 2))
            flat = as_vector(wave, name="wave")
            status, _ = raw.jam_bloch_modes(self.handle, h, flat, raw.JAM_MODE_COLUMNS, table.reshape(-1), vectors.reshape(-1))
            self._note(not_cancelled(status))
            same(self._ask("hessian_map"), spheres)
        values, participation = np.ascontiguousarray(table.T)
        return Modes(values, vectors.view(complex)[..., 0], participation, spheres, self.status)

    def bloch_rigidity(self, count: Any, *, progress: Any = None) -> BlochRigidityResult:
        """Tests from one cell whether count[c] copies along each cell vector are collectively jammed.

        `status` says the answer: OK jammed, NOT_JAMMED, AMBIGUOUS undecided. The flexes of all rows together are those of
        `tile(count).rigidity()`.

        Parameters
        ----------
        count : array_like of int, shape (d,)
            Copies along each cell vector.
        progress : bool or callable, optional
            As of `rigidity`.

        Returns
        -------
        wave : array, shape (m, d)
            The wave vectors of these copies, as in `bloch_modes`; 0 comes first.
        flexes : int array, shape (m,)
            Complex motions with this wave vector that keep all contacts with force closed, without translations.
        margin : array, shape (m,)
            Least other eigenvalue of S^T S; below 1e-12: a flex. NaN where no contact carries force.
        """
        with self._reporting(progress):
            copies = as_vector(count, "int32_t", "count")
            status, rows = raw.jam_bloch_rigidity(self.handle, copies, None, raw.JAM_BLOCH_COLUMNS, None)
            not_cancelled(status)
            wave, table = unknown_array((rows, self.dim)), unknown_array((rows, len(BlochColumn)))
            status, filled = raw.jam_bloch_rigidity(self.handle, copies, wave.reshape(-1), raw.JAM_BLOCH_COLUMNS, table.reshape(-1))
            self._note(not_cancelled(status))
            same(filled, rows)
        return BlochRigidityResult(wave, table[:, BlochColumn.FLEXES].astype(int), table[:, BlochColumn.MARGIN].copy())
