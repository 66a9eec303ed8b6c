"""HOOMD's GSD files, and whatever ASE reads. Both need the other package: python3-gsd, python3-ase."""
from __future__ import annotations

import os
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ._formats import gsd as _gsd
from ._api import errors
from ._api.generated import StatusCode
from ._api.given import sizes_of
from ._formats.replacing import replacing
from ._api.arrays import Array

if TYPE_CHECKING:
    from .system import System

# A plane may be uneven by this part of its cell: distances in it change by less than their rounding.
_FLAT = 1e-8


def _bad(path: str, text: str) -> Exception:
    return errors.make(int(StatusCode.E_FORMAT), f"{path}: {text}")


def write_gsd(system: System, path: str | os.PathLike[str]) -> None:
    """Writes one frame: float32 for every reader of GSD, and the doubles in chunks log/jam, which `read_gsd` prefers."""
    import gsd.hoomd

    if system.dim > 3:
        raise ValueError(f"GSD holds two or three dimensions, this packing has d = {system.dim}")
    with replacing(path) as part, gsd.hoomd.open(part.name, "wb") as file:
        file.append(_gsd.frame_of(system))


def read_gsd(
    path: str | os.PathLike[str],
    frame: int = -1,
    *,
    diameters: Any = None,
    radii: Any = None,
    doubles: bool = True,
    **options: Any,
) -> System:
    """Reads one frame of a GSD file; the last by default.

    Files that libjam wrote come back to the bit. Others hold float32, so that spheres in contact overlap by 1e-7:
    overlap='shrink' is then needed.

    Diameters are looked for in particles/diameter, in the spheres of particles/type_shapes and in
    state/hpmc/sphere/radius. Those found must agree. A file with none of them is refused: GSD leaves out its default,
    diameters of 1, so that such a file may hold spheres of that size or none.

    Parameters
    ----------
    path : path-like
        The file.
    frame : int
        Number of the frame from 0; negative ones count from the end.
    diameters : array_like, optional
        Instead of those in the file: one for all or one for each sphere, in the order of the frame.
    radii : array_like, optional
        Instead of diameters.
    doubles : bool
        False leaves the chunks log/jam out. They are refused where another program changed the frame beside them.
    **options
        As of System.from_arrays, but for box, cell and dim, which the file holds.
    """
    import gsd.hoomd

    from .system import System

    name = os.fsdecode(path)
    _refuse_cell(options, name)
    try:
        opened = gsd.hoomd.open(name, "rb")
    except RuntimeError as error:  # the package's only word for a file that is none of GSD
        raise _bad(name, f"no GSD file that can be read: {error}") from None
    with opened as file:
        at, by_hand = _in_range(name, frame, len(file)), diameters is not None or radii is not None
        found = _gsd.read(file, at, partial(_bad, name), not by_hand, doubles)
    d, cell, sizes = found.dim, found.cell[: found.dim, : found.dim], found.diameters
    x = _plane(name, found.positions, found.cell, d) + 0.5 * cell.sum(0)
    if found.doubles is not None:
        x, sizes, cell = found.doubles.positions, found.doubles.diameters, found.doubles.cell
    if by_hand:
        sizes = sizes_of(diameters, radii, len(x))
    return System.from_arrays(x, sizes, **_box(cell), dim=d, **options)


def _refuse_cell(options: dict[str, Any], path: str) -> None:
    for name in ("box", "cell", "dim"):
        if options.get(name) is not None:
            raise TypeError(f"{name}={options[name]!r} would be without effect: {path} holds it")


def _in_range(path: str, frame: int, count: int) -> int:
    if count == 0:
        raise _bad(path, "the file holds no frame")
    if not -count <= frame < count:
        raise IndexError(f"{path}: frame {frame} is out of range, the file holds {count}: 0 to {count - 1}, or -1 for the last")
    return int(frame) % count


def _plane(path: str, x: Array, cell: Array, dim: int) -> Array:
    """The first dim coordinates. In d = 2 the spheres must lie in one plane z = const, and two vectors in it."""
    if dim == 2 and x.shape[1] == 3:
        room = _FLAT * float(np.abs(cell[:2]).max())
        if x.dtype == np.float32:
            room += 2.0 * float(np.finfo(np.float32).eps * np.abs(x).max())
        step = np.abs(x[:, 2] - x[0, 2])
        if not (step <= room).all():
            i = int(np.argmax(step))
            raise _bad(
                path,
                f"spheres 0 and {i} have z = {x[0, 2]:g} and {x[i, 2]:g}, but d = 2 takes one plane z = const: "
                "if this is a slice through a packing in d = 3, it has no cell in d = 2; else rotate it into the plane x, y",
            )
        for k in range(2):
            if not abs(cell[k, 2]) <= room:
                raise _bad(path, f"cell vector {k} is {cell[k].tolist()} and leaves the plane z = const of d = 2")
    return np.asarray(x[:, :dim], float)


def _box(cell: Array) -> dict[str, Any]:
    cube = (cell == cell[0, 0] * np.eye(len(cell))).all()
    return {"box": float(cell[0, 0])} if cube else {"cell": cell}


# What other programs call the sizes of spheres, as factors to the diameter.
_SIZES = {"radius": 2.0, "radii": 2.0, "diameter": 1.0, "diameters": 1.0}


def read_ase(
    path: str | os.PathLike[str],
    diameters: Any = None,
    *,
    radii: Any = None,
    dim: int = 3,
    frame: int = -1,
    **options: Any,
) -> System:
    """Reads any file that ASE reads (CIF, POSCAR, ...), periodic in all directions.

    Parameters
    ----------
    path : path-like
        ASE tells the format by the name or the content.
    diameters : array_like, optional
        One for all or one for each sphere, in the order of the file. Needed unless the file has an array `radius` or
        `diameter`. Where ASE sorts the spheres of a LAMMPS file by their ids, one for each is refused.
    radii : array_like, optional
        Instead of diameters.
    dim : int
        2 reads a plane z = const and leaves the third direction out.
    frame : int
        Number of the frame from 0; negative ones count from the end.
    **options
        As of System.from_arrays; overlap='shrink' for files with few digits.
    """
    import ase.io
    import ase.io.formats

    from .system import System

    name = os.fsdecode(path)
    if dim not in (2, 3):
        raise ValueError(f"dim must be 2 or 3 in files of ASE, not {dim!r}")
    _refuse_cell(options, name)
    kind = ase.io.formats.filetype(name)
    frames = ase.io.read(name, index=":", format=kind)
    at = _in_range(name, frame, len(frames))
    atoms = frames[at]
    if len(atoms) == 0:
        raise _bad(name, "the frame holds no sphere")
    if not all(atoms.pbc[:dim]):
        hint = "; dim=2 reads a packing of disks" if dim == 3 and all(atoms.pbc[:2]) else ""
        raise _bad(name, f"the cell must be periodic in every direction, pbc is {[bool(p) for p in atoms.pbc]}{hint}")
    positions = np.asarray(atoms.positions)
    if diameters is None and radii is None:
        sizes = _sizes_in(name, atoms.arrays)
    else:
        sizes = sizes_of(diameters, radii, len(atoms))
        if sizes.size > 1:
            _refuse_sorted(name, kind, at, positions)
    cell = np.asarray(atoms.cell)
    return System.from_arrays(_plane(name, positions, cell, dim), sizes, **_box(cell[:dim, :dim]), dim=dim, **options)


def _sizes_in(path: str, arrays: dict[str, Array]) -> Array:
    """Diameters from the one array of a frame that has the name of a size, in either case of letters."""
    found = [name for name in arrays if name.lower() in _SIZES]
    if not found:
        raise _bad(path, "no array `radius` or `diameter`: give diameters=")
    sizes = [_SIZES[name.lower()] * np.asarray(arrays[name], float) for name in found]
    for name, other in zip(found[1:], sizes[1:]):
        if not np.array_equal(other, sizes[0]):
            raise _bad(path, f"the arrays `{found[0]}` and `{name}` name different sizes: give diameters=")
    return sizes[0]


# Formats in which a file may list the atoms in another order than ASE: the option that leaves its order as it is.
_SORTED = {"lammps-dump-text": {"order": False}, "lammps-dump-binary": {"order": False}, "lammps-data": {"sort_by_id": False}}


def _refuse_sorted(path: str, kind: str, frame: int, positions: Array) -> None:
    if kind not in _SORTED:
        return
    import ase.io

    as_written = ase.io.read(path, index=frame, format=kind, **_SORTED[kind])
    if not np.array_equal(as_written.positions, positions):
        raise _bad(
            path,
            "ASE sorts these atoms by id, but the file has another order, so it is unclear which atom has which "
            "diameter: System.read takes the radii from a column of the file; or sort the file by id",
        )
