"""The state of a system: positions, velocities, diameters and what is known of them at once."""
from __future__ import annotations

from typing import Any, Callable

import numpy as np

from .. import raw
from .._api.arrays import Array, as_array
from .._api.calls import freeze, new_report
from .._api.generated import Info
from .handle import Base, _View


class State(Base):
    """State of a system. Its arrays are read-only views of the system's memory."""

    @property
    def info(self) -> Info:
        """Number, dimension, box, packing fraction, pressure and model, as an Info."""
        made = new_report("jam_info")
        raw.jam_get_info(self.handle, made)
        return freeze(made, "jam_info")

    @property
    def n(self) -> int:
        """Number of spheres."""
        return self._constants().n

    @property
    def dim(self) -> int:
        """Dimension d."""
        return self._constants().dim

    @property
    def box(self) -> float:
        """Side of the cube; V^(1/d) of another cell."""
        return self.info.box

    @property
    def seed(self) -> int:
        """Seed recorded at creation."""
        return self._constants().seed

    @property
    def notes(self) -> str:
        """What was changed or assumed when the system was made, a sentence a line: shrunk diameters, wrapped or sorted spheres,
        columns and frames not read. '' when nothing."""
        return raw.jam_notes(self.handle)

    @property
    def packing_fraction(self) -> float:
        """Volume of the spheres over that of the cell."""
        return self.info.packing_fraction

    @property
    def pressure(self) -> float:
        """Reduced pressure of this packing as molecular dynamics measured it; nan before, and once spheres moved otherwise."""
        return self.info.pressure

    def _constants(self) -> Info:
        """Values that never change for a handle, kept because info sums over all spheres each time."""
        self.handle
        if self._first_info is None:
            self._first_info = self.info
        return self._first_info

    def _show(self, array: int, flat: bool = False) -> Array:
        handle = self.handle
        _, (address, count) = raw.jam_view(handle, array)
        n = raw.jam_view(handle, raw.JAM_VIEW_DIAMETERS)[1][1]
        return np.asarray(_View(handle, address, (n,) if flat else (n, count // n)))

    @property
    def positions(self) -> Array:
        """Positions in [0, box), or in the brick of another cell, shape (n, d): a read-only view without copy that follows the system.

        Assign a new array to move the spheres.
        """
        return self._show(raw.JAM_VIEW_POSITIONS)

    @positions.setter
    def positions(self, values: Any) -> None:
        self._set(raw.jam_set_positions, values, "positions")

    @property
    def velocities(self) -> Array:
        """Velocities with kT/m = 1, shape (n, d): a read-only view; zero until molecular dynamics draws them.

        Assign a new array to set them; contacts and report stay.
        """
        return self._show(raw.JAM_VIEW_VELOCITIES)

    @velocities.setter
    def velocities(self, values: Any) -> None:
        self._set(raw.jam_set_velocities, values, "velocities")

    def _set(self, function: Callable[..., Any], values: Any, name: str) -> None:
        x = as_array(values, name=name)
        shape = self._show(raw.JAM_VIEW_POSITIONS).shape
        if x.shape != shape:
            raise ValueError(f"{name} must have shape {shape}, not {x.shape}")
        self._done(lambda: function(self.handle, x.reshape(-1)))

    @property
    def diameters(self) -> Array:
        """Diameters in the unit of the box, shape (n,): a read-only view."""
        return self._show(raw.JAM_VIEW_DIAMETERS, flat=True)

    @property
    def radii(self) -> Array:
        """Half the diameters, shape (n,)."""
        return 0.5 * self.diameters

    @property
    def cell(self) -> Array:
        """Cell vectors as they were given, shape (d, d), one a row, lower-triangular.

        Assign other vectors to change the cell at fixed Cartesian positions. Vectors that are no lower triangle are
        rotated to one, and the spheres with them; `notes` says so.
        """
        out = np.empty((self.dim, self.dim))
        raw.jam_get_cell(self.handle, out.reshape(-1))
        return out

    @cell.setter
    def cell(self, vectors: Any) -> None:
        self._done(lambda: raw.jam_set_cell(self.handle, self._matrix(vectors, "cell"), None, None))

    def strain(self, strain: Any) -> None:
        """Deforms cell and positions by r -> (1 + strain) r, strain of shape (d, d); diameters stay."""
        self._done(lambda: raw.jam_strain(self.handle, self._matrix(strain, "strain")))

    def _matrix(self, values: Any, name: str) -> Array:
        x = as_array(values, name=name)
        if x.shape != (self.dim, self.dim):
            raise ValueError(f"{name} must have shape ({self.dim}, {self.dim}), not {x.shape}")
        return x.reshape(-1)

    def scale_diameters(self, factor: float) -> None:
        """Multiplies all diameters by factor."""
        self._done(lambda: raw.jam_scale_diameters(self.handle, float(factor)))
