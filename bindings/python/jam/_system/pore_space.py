"""The pore space of a system as arrays."""
from __future__ import annotations

from typing import Any, Sequence

import numpy as np

from .._api.arrays import Array
from .._api.options import number
from .handle import Base


class PoreSpace(Base):
    """Images of solid and void. Meshes, profiles and pore sizes are calls of C: write_stl, solid_profile, pore_sizes."""

    def image(self, size: float | None = None, *, shape: Sequence[int] | None = None, lines: int = 0) -> Array:
        """The solid as an image, indexed [x, y, z] (d = 2: [x, y]), periodic where the cell is.

        Parameters
        ----------
        size : float, optional
            Edge of a voxel, about: edges of the brick become whole numbers of voxels. Default: box / 100.
        shape : sequence of int, optional
            Voxels along each edge instead.
        lines : int
            0: a voxel is solid where its centre is. Else its solid share, by exact lengths on lines^(d-1) lines along x.

        Returns
        -------
        image : array
            uint8, 0 void, 1 solid, 2 outside a round container. With lines float32: shares, -1 outside.
        """
        if shape is not None and (size is not None or len(shape) != self.dim):
            raise ValueError(f"shape must have {self.dim} numbers, and size is then left out; shape is {shape}, size {size}")
        given: dict[str, Any] = {"lines": lines}
        if size is not None:
            given["size"] = size
        if shape is not None:
            given.update((axis, int(number(k, "int", "shape"))) for axis, k in zip(("nx", "ny", "nz"), shape))
            if min(shape) < 1:
                raise ValueError(f"each number of shape must be at least 1, not {min(shape)}")
        report, values = self.call("voxels", **given)
        image = values.reshape(report.nz, report.ny, report.nx).T[..., slice(None) if self.dim == 3 else 0]
        if lines:
            return image.astype(np.float32)
        solid: Array = (image != 0).view(np.uint8)
        solid += image < 0
        return solid
