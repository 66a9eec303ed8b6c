"""Files of several frames in three coordinates: what those of GSD and of ASE have in common, and what ASE reads (python3-ase)."""
from __future__ import annotations

import os
from types import SimpleNamespace
from typing import Any, Iterable

import numpy as np

from .._api.arrays import Array
from .._api.errors import make
from .._api.generated import StatusCode
from .._api.given import ROUNDING, closed_axes, enclosure_of, refuse_start_options, sizes_of
from .replacing import open_regular

# A plane may be uneven by this part of its cell: distances in it change by less than their rounding.
_FLAT = 1e-8


def bad(path: str, text: str) -> Exception:
    """The error for a file that is no packing."""
    return make(int(StatusCode.E_FORMAT), f"{path}: {text}")


def readable(path: str | os.PathLike[str], options: dict[str, Any]) -> str:
    """The name of a file that can be read, without options that it gives itself."""
    name = os.fsdecode(path)
    refuse_start_options(options, ("box", "cell", "dim"), f"{name} gives it")
    open_regular(name).close()
    return name


def chosen(path: str, frame: int, count: int) -> tuple[int, list[str]]:
    """The number of a frame from 0, and the first notes: which was taken where nobody named one."""
    if count == 0:
        raise bad(path, "the file has no frame")
    if not -count <= frame < count:
        raise IndexError(f"{path}: frame {frame} is out of range, the file has {count}: 0 to {count - 1}, or -1 for the last")
    last = frame == -1 and count > 1
    return int(frame) % count, [f"the last of {count} frames was read; frame=0 to {count - 1} read others"] if last else []


def _plane(path: str, x: Array, cell: Array, notes: list[str]) -> None:
    """In d = 2 the spheres must lie in one plane z = const, and two vectors in it."""
    room = _FLAT * float(np.abs(cell[:2]).max())
    if x.dtype == np.float32:
        room += 2.0 * float(np.finfo(np.float32).eps * np.abs(x).max())
    step = np.abs(x[:, 2] - x[0, 2])
    if not (step <= room).all():
        i = int(np.argmax(step))
        raise bad(
            path,
            f"spheres 0 and {i} have z = {x[0, 2]:g} and {x[i, 2]:g}, but d = 2 takes one plane z = const: "
            "if this is a slice through a packing in d = 3, it has no cell in d = 2; else rotate it into the plane x, y",
        )
    for k in range(2):
        if not abs(cell[k, 2]) <= room:
            raise bad(path, f"cell vector {k} is {cell[k].tolist()} and leaves the plane z = const of d = 2")
    if x[0, 2] != 0.0:
        notes.append(f"the third coordinate, {x[0, 2]:g} of every disk, was omitted")


def placed(path: str, x: Array, cell: Array, corner: Array, dim: int, notes: list[str]) -> dict[str, Any]:
    """What System.from_arrays takes for spheres (n, 3) in a cell with a corner; notes of what was changed or assumed, in the
    words of the readers of text files (src/io)."""
    if dim == 2:
        _plane(path, x, cell, notes)
    x, cell, corner = np.asarray(x[:, :dim], float), cell[:dim, :dim], corner[:dim]
    if corner.any():
        place = " ".join(f"{c:.17g}" for c in corner)
        notes.append(f"the corner of the cell is at {place} in the file: positions are measured from there")
        x = x - corner
    if np.linalg.det(cell) != 0.0:  # else refused by the library
        at = np.linalg.solve(cell.T, x.T)
        if outside := int(((at < -ROUNDING) | (at > 1.0 + ROUNDING)).any(0).sum()):
            notes.append(f"{outside} of {len(x)} spheres lay outside the cell and were wrapped into it")
    return dict(positions=x, cell=cell, dim=dim)


def say_unread(notes: list[str], kind: str, names: Iterable[str]) -> None:
    if names := list(names):
        notes.append(" ".join(f"{kind} of the file that were not read: {', '.join(names)}".split()))


def agreed(path: str, found: dict[str, Array], tolerance: float) -> Array:
    """The diameters of a file that names them in several places."""
    first, *others = found
    for name in others:
        if not np.allclose(found[name], found[first], rtol=tolerance, atol=0.0):
            i = int(np.argmax(np.abs(found[name] - found[first])))
            raise bad(
                path,
                f"sphere {i} has the diameter {found[first][i]:g} by `{first}` and {found[name][i]:g} by `{name}`: "
                "give diameters=",
            )
    return found[first]


# ---- what ASE reads: CIF, POSCAR and more
# What other programs call the sizes of spheres, as factors to the diameter.
_SIZES = {"radius": 2.0, "radii": 2.0, "diameter": 1.0, "diameters": 1.0}

# Formats in which a file may list the atoms in another order than ASE: the option that leaves its order as it is.
_SORTED = {"lammps-dump-text": {"order": False}, "lammps-dump-binary": {"order": False}, "lammps-data": {"sort_by_id": False}}


def of_ase(
    path: str | os.PathLike[str], diameters: Any, radii: Any, dim: int, frame: int, options: dict[str, Any]
) -> tuple[dict[str, Any], list[str]]:
    """What System.from_arrays takes for one frame, and notes; the arguments are those of jam.files.read_ase."""
    import ase.io
    import ase.io.formats

    if dim not in (2, 3):
        raise ValueError(f"dim must be 2 or 3 in files of ASE, not {dim!r}")
    name = readable(path, options)
    kind = ase.io.formats.filetype(name)
    frames = ase.io.read(name, index=":", format=kind)
    at, notes = chosen(name, frame, len(frames))
    given = of_atoms(frames[at], diameters, options, radii=radii, dim=dim, notes=notes, where=name)
    if kind in _SORTED and given["diameters"].size > 1 and not (diameters is None and radii is None):
        as_written = ase.io.read(name, index=at, format=kind, **_SORTED[kind])
        if not np.array_equal(as_written.positions, frames[at].positions):
            raise bad(
                name,
                "ASE sorts these atoms by id, but the file has another order, so it is unclear which atom has which "
                "diameter: System.read takes the radii from a column of the file; or sort the file by id",
            )
    return given, notes


def of_atoms(
    atoms: Any, diameters: Any, options: dict[str, Any], *, radii: Any, dim: int, notes: list[str], where: str
) -> dict[str, Any]:
    """What System.from_arrays takes for an ase.Atoms. where: what an error calls it; notes get what was not read. options: of
    the caller, who names walls, container and non_additivity where info does not, as to_ase writes it."""
    if len(atoms) == 0:
        raise bad(where, "the atoms have no sphere")
    named = {key: value for key in ("walls", "container") if (value := options.pop(key, None)) is not None}
    mixed, ours = atoms.info.get("non_additivity"), options.pop("non_additivity", None)
    if mixed is not None and ours is not None and float(mixed) != float(ours):
        raise bad(where, f"non_additivity= is {ours}, that of info is {mixed}: leave it out")
    delta = {} if ours is mixed is None else {"non_additivity": float(ours if mixed is None else mixed)}
    walls = _walls_in(where, atoms, dim, named)
    if not walls and not all(atoms.pbc[:dim]):
        hint = "; dim=2 reads a packing of disks" if dim == 3 and all(atoms.pbc[:2]) else ""
        raise bad(
            where,
            f"the cell must be periodic in every direction, or walls= and container= name the walls; pbc is "
            f"{[bool(p) for p in atoms.pbc]}{hint}",
        )
    read = {"positions"}
    if diameters is None and radii is None:
        found = {k: _SIZES[k.lower()] * np.asarray(x, float) for k, x in atoms.arrays.items() if k.lower() in _SIZES}
        if not found:
            raise bad(where, "no array `radius` or `diameter`: give diameters=")
        sizes = agreed(where, found, 0.0)
        read.update(found)
    else:
        sizes = sizes_of(diameters, radii, len(atoms))
    say_unread(notes, "columns", (k for k in atoms.arrays if k not in read))
    say_unread(notes, "keys", (key for key in atoms.info if key not in walls and key not in delta))
    if atoms.constraints:
        notes.append("constraints of the file were not read")
    corner = np.asarray(atoms.get_celldisp()).reshape(-1)
    scene = placed(where, np.asarray(atoms.positions), np.asarray(atoms.cell), corner, dim, notes)
    return dict(scene, diameters=sizes, **walls, **delta, **options)


def _walls_in(path: str, atoms: Any, dim: int, named: dict[str, Any]) -> dict[str, Any]:
    """container= and walls= as to_ase writes them into info, else those that the caller names; {} without walls."""
    given, where = dict(named), "the call"
    if "container" in atoms.info and "walls" in atoms.info:
        where = "info"
        given = {"container": str(atoms.info["container"]), "walls": [bool(w) for w in np.atleast_1d(atoms.info["walls"])]}
        if (dim, len(given["walls"])) == (3, 2):
            raise bad(path, "info names walls of two axes: dim=2 reads a packing of disks")
    if not given:
        return {}
    kind, flat = enclosure_of(given.get("container"), given.get("walls"), dim)
    if named and enclosure_of(named.get("container"), named.get("walls"), dim) != (kind, flat):
        raise bad(path, f"walls= and container= name other walls than info, {given}: leave them out")
    closed = closed_axes(SimpleNamespace(dim=dim, container=kind, walls=flat))
    if [bool(p) for p in atoms.pbc[:dim]] != [not shut for shut in closed]:
        raise bad(path, f"pbc is {[bool(p) for p in atoms.pbc]}, but container and walls of {where} close the axes {closed}")
    return given
