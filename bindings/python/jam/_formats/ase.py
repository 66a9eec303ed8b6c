"""What ASE reads: CIF, POSCAR and more. Needs python3-ase."""
from __future__ import annotations

import os
from types import SimpleNamespace
from typing import Any

import numpy as np

from .._api.given import closed_axes, enclosure_of, sizes_of
from .frames import agreed, bad, chosen, placed, readable, say_unread

# What info may hold, as to_ase writes it; else the caller names it.
NAMED = ("walls", "container", "non_additivity")

# What other programs call the sizes of spheres, as factors to the diameter.
_SIZES = {"radius": 2.0, "radii": 2.0, "diameter": 1.0, "diameters": 1.0}

# Formats in which a file may list the atoms in another order than ASE: the option that leaves its order as it is.
_SORTED = {"lammps-dump-text": {"order": False}, "lammps-dump-binary": {"order": False}, "lammps-data": {"sort_by_id": False}}


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

    if dim not in (2, 3):
        raise ValueError(f"dim must be 2 or 3 in files of ASE, not {dim!r}")
    name = readable(path, options)
    kind = ase.io.formats.filetype(name)
    frames = ase.io.read(name, index=":", format=kind)
    at, notes = chosen(name, frame, len(frames))
    named = {key: options.pop(key, None) for key in NAMED}
    given = of_atoms(frames[at], diameters, radii=radii, dim=dim, notes=notes, where=name, named=named)
    if kind in _SORTED and given["diameters"].size > 1 and not (diameters is None and radii is None):
        as_written = ase.io.read(name, index=at, format=kind, **_SORTED[kind])
        if not np.array_equal(as_written.positions, frames[at].positions):
            raise bad(
                name,
                "ASE sorts these atoms by id, but the file has another order, so it is unclear which atom has which "
                "diameter: System.read takes the radii from a column of the file; or sort the file by id",
            )
    return dict(given, **options), notes


def of_atoms(
    atoms: Any, diameters: Any, *, radii: Any, dim: int, notes: list[str], where: str, named: dict[str, Any]
) -> dict[str, Any]:
    """What System.from_arrays takes for an ase.Atoms. where: what an error calls it; notes get what was not read. named:
    of NAMED what the caller names, for atoms that do not."""
    if len(atoms) == 0:
        raise bad(where, "the atoms have no sphere")
    named = {key: value for key, value in named.items() if value is not None}
    mixed, ours = atoms.info.get("non_additivity"), named.pop("non_additivity", None)
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
    return dict(scene, diameters=sizes, **walls, **delta)


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
