"""What ASE reads: CIF, POSCAR and more. Needs python3-ase."""
from __future__ import annotations

import os
from types import SimpleNamespace
from typing import Any

import numpy as np

from .._api.arrays import Array
from .._api.given import closed_axes, enclosure_of, sizes_of
from .frames import bad, box_of, from_corner, in_range, notes_of, plane, refuse_cell, say_outside, say_unread
from .replacing import open_regular

# What info may hold, as to_ase writes it; else the caller names it.
NAMED = ("walls", "container", "non_additivity")

# What other programs call the sizes of spheres, as factors to the diameter.
_SIZES = {"radius": 2.0, "radii": 2.0, "diameter": 1.0, "diameters": 1.0}


def arguments(
    path: str | os.PathLike[str],
    diameters: Any = None,
    *,
    radii: Any = None,
    dim: int = 3,
    frame: int = -1,
    **options: Any,
) -> tuple[dict[str, Any], list[str]]:
    """What System.from_arrays takes for one frame, and notes; the arguments are those of jam.files.read_ase."""
    import ase.io
    import ase.io.formats

    name = os.fsdecode(path)
    if dim not in (2, 3):
        raise ValueError(f"dim must be 2 or 3 in files of ASE, not {dim!r}")
    refuse_cell(options, name)
    open_regular(name).close()
    kind = ase.io.formats.filetype(name)
    frames = ase.io.read(name, index=":", format=kind)
    at = in_range(name, frame, len(frames))
    atoms = frames[at]
    notes = notes_of(frame, len(frames))
    named = {key: options.pop(key, None) for key in NAMED}
    given = of_atoms(atoms, diameters, radii=radii, dim=dim, notes=notes, where=name, named=named)
    if given["diameters"].size > 1 and not (diameters is None and radii is None):
        _refuse_sorted(name, kind, at, np.asarray(atoms.positions))
    return dict(given, **options), notes


def of_atoms(
    atoms: Any, diameters: Any, *, radii: Any, dim: int, notes: list[str], where: str, named: dict[str, Any]
) -> dict[str, Any]:
    """What System.from_arrays takes for an ase.Atoms. where: what an error calls it; notes get what was not read. named:
    of NAMED what the caller names, for atoms that do not."""
    if len(atoms) == 0:
        raise bad(where, "the atoms have no sphere")
    delta = _delta_in(where, atoms, named.pop("non_additivity"))
    walls = _walls_in(where, atoms, dim, {key: value for key, value in named.items() if value is not None})
    if not walls and not all(atoms.pbc[:dim]):
        hint = "; dim=2 reads a packing of disks" if dim == 3 and all(atoms.pbc[:2]) else ""
        raise bad(
            where,
            f"the cell must be periodic in every direction, or walls= and container= name the walls; pbc is "
            f"{[bool(p) for p in atoms.pbc]}{hint}",
        )
    read = {"positions"}
    if diameters is None and radii is None:
        sizes, names = _sizes_in(where, atoms.arrays)
        read.update(names)
    else:
        sizes = sizes_of(diameters, radii, len(atoms))
    say_unread(notes, "columns", (k for k in atoms.arrays if k not in read))
    say_unread(notes, "keys", (key for key in atoms.info if key not in walls and key not in delta))
    if atoms.constraints:
        notes.append("constraints of the file were not read")
    cell = np.asarray(atoms.cell)
    x = plane(where, np.asarray(atoms.positions), cell, dim, notes)
    cell = cell[:dim, :dim]
    x = from_corner(x, np.asarray(atoms.get_celldisp()).reshape(-1)[:dim], notes)
    say_outside(notes, x, cell)
    return dict(positions=x, diameters=sizes, **box_of(cell), **walls, **delta, dim=dim)


def _delta_in(path: str, atoms: Any, named: Any) -> dict[str, Any]:
    """non_additivity= of info or of the caller; {} where neither has it."""
    found = atoms.info.get("non_additivity")
    if found is not None and named is not None and float(found) != float(named):
        raise bad(path, f"non_additivity= is {named}, that of info is {found}: leave it out")
    value = named if found is None else float(found)
    return {} if value is None else {"non_additivity": value}


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


def _sizes_in(path: str, arrays: dict[str, Array]) -> tuple[Array, list[str]]:
    """Diameters from the one array of a frame that has the name of a size, in either case of letters, and its names."""
    found = [name for name in arrays if name.lower() in _SIZES]
    if not found:
        raise bad(path, "no array `radius` or `diameter`: give diameters=")
    sizes = [_SIZES[name.lower()] * np.asarray(arrays[name], float) for name in found]
    for name, other in zip(found[1:], sizes[1:]):
        if not np.array_equal(other, sizes[0]):
            raise bad(path, f"the arrays `{found[0]}` and `{name}` name different sizes: give diameters=")
    return sizes[0], found


# Formats in which a file may list the atoms in another order than ASE: the option that leaves its order as it is.
_SORTED = {"lammps-dump-text": {"order": False}, "lammps-dump-binary": {"order": False}, "lammps-data": {"sort_by_id": False}}


def _refuse_sorted(path: str, kind: str, frame: int, positions: Array) -> None:
    if kind not in _SORTED:
        return
    import ase.io

    as_written = ase.io.read(path, index=frame, format=kind, **_SORTED[kind])
    if not np.array_equal(as_written.positions, positions):
        raise bad(
            path,
            "ASE sorts these atoms by id, but the file has another order, so it is unclear which atom has which "
            "diameter: System.read takes the radii from a column of the file; or sort the file by id",
        )
