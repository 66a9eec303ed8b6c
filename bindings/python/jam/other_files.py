"""HOOMD's GSD files, and whatever ASE reads. Both need the other package: python3-gsd, python3-ase."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from ._paths import replacing


from ._types import Array

if TYPE_CHECKING:
    from .system import System

# Positions are float32 in GSD's schema, which opens and closes gaps of 1e-7. The doubles are kept beside them.


def write_gsd(system: System, path: str | os.PathLike[str]) -> None:
    """Writes one frame: float32 for every reader of GSD, and the doubles in chunks log/jam, which `read_gsd` prefers."""
    import gsd.hoomd

    if system.dim > 3:
        raise ValueError(f"GSD holds two or three dimensions, this packing has d = {system.dim}")
    d, cell = system.dim, system.cell
    box = np.zeros(6)
    box[:d] = np.diag(cell)
    if d == 3:
        box[3:] = cell[1, 0] / cell[1, 1], cell[2, 0] / cell[2, 2], cell[2, 1] / cell[2, 2]
    else:
        box[3] = cell[1, 0] / cell[1, 1]
    frame = gsd.hoomd.Snapshot()
    frame.configuration.dimensions = d
    frame.configuration.box = box
    frame.particles.N = system.n
    x = np.zeros((system.n, 3))
    x[:, :d] = _centred(system.positions, cell)
    frame.particles.position = x
    frame.particles.diameter = system.diameters
    frame.log = {
        "jam/position": np.array(system.positions),
        "jam/diameter": np.array(system.diameters),
        "jam/cell": np.array(cell),
    }
    with replacing(path) as part, gsd.hoomd.open(part.name, "wb") as file:
        file.append(frame)


def _centred(x: Array, cell: Array) -> Array:
    """In the cell around the origin, as HOOMD wants them."""
    s = np.linalg.solve(cell.T, np.asarray(x).T).T - 0.5
    found: Array = (s - np.floor(s + 0.5)) @ cell
    return found


def read_gsd(path: str | os.PathLike[str], frame: int = -1, **options: Any) -> System:
    """Reads one frame of a GSD file; the last by default.

    Files that libjam wrote come back to the bit. Others hold float32, so that spheres in contact overlap by 1e-7:
    overlap='shrink' is then needed.
    """
    import gsd.hoomd

    from .system import System

    with gsd.hoomd.open(os.fsdecode(path), "rb") as file:
        one = file[frame]
    if "jam/position" in one.log:
        cell = one.log["jam/cell"]
        return System.from_arrays(one.log["jam/position"], one.log["jam/diameter"].reshape(-1), **_box(cell), **options)
    d = int(one.configuration.dimensions)
    lx, ly, lz, xy, xz, yz = (float(v) for v in one.configuration.box)
    cell = np.array([[lx, 0, 0], [xy * ly, ly, 0], [xz * lz, yz * lz, lz]])[:d, :d]
    x = np.asarray(one.particles.position, float)[:, :d] + 0.5 * cell.sum(0)
    return System.from_arrays(x, np.asarray(one.particles.diameter, float), **_box(cell), **options)


def _box(cell: Array) -> dict[str, Any]:
    cube = (cell == cell[0, 0] * np.eye(len(cell))).all()
    return {"box": float(cell[0, 0])} if cube else {"cell": cell}


def read_ase(path: str | os.PathLike[str], diameters: Any = None, *, dim: int = 3, **options: Any) -> System:
    """Reads any file that ASE reads (CIF, POSCAR, ...), periodic in all directions.

    Parameters
    ----------
    path : path-like
        ASE tells the format by the name or the content.
    diameters : array_like, optional
        One for all or one for each sphere. Needed unless the file has an array `radius`.
    dim : int
        2 leaves the third coordinate out.
    **options
        As of System.from_arrays; overlap='shrink' for files with few digits.
    """
    import ase.io

    from .system import System

    atoms = ase.io.read(os.fsdecode(path))
    if not all(atoms.pbc[:dim]):
        raise ValueError(f"{os.fsdecode(path)}: the cell must be periodic in every direction, pbc is {list(atoms.pbc)}")
    if diameters is None:
        if "radius" not in atoms.arrays:
            raise ValueError(f"{os.fsdecode(path)} has no array `radius`: give diameters=")
        diameters = 2.0 * atoms.arrays["radius"]
    cell = np.asarray(atoms.cell)[:dim, :dim]
    return System.from_arrays(np.asarray(atoms.positions)[:, :dim], diameters, **_box(cell), **options)
