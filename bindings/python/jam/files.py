"""Files for other programs: tables, ParaView's files, GSD, and what ASE reads.

System.write and System.write_contacts write most of them by the ending of the name. All appear whole or not at all.
"""
from __future__ import annotations

import os
from contextlib import suppress
from typing import Any, NamedTuple

import numpy as np

from . import raw
from ._api.arrays import Array
from ._api.calls import not_cancelled
from ._api.results import Modes
from ._api.shown import only
from ._api.size_laws import contact_distance
from ._formats import frames, gsd
from ._formats.replacing import replacing
from .errors import StateError
from .system import System

__all__ = [
    "Format", "formats", "half_bonds", "read_ase", "read_gsd", "write_contacts_csv", "write_csv", "write_gaps_csv",
    "write_gsd", "write_spectrum_csv", "write_structure_csv", "write_vtk", "write_vtk_network",
]
__dir__ = only(__all__)


class Format(NamedTuple):
    """A format of files."""

    content: str  # packings, contacts or images
    word: str  # as System.write and System.write_contacts take it
    name: str
    endings: tuple[str, ...]  # of names; an empty one stands for none
    dim: int  # the largest
    holds: tuple[str, ...]  # of spheres, walls, cells (other than cubes), non_additivity
    read: bool
    write: bool


def formats() -> list[Format]:
    """The formats that System.read reads, and those that System.write, write_contacts and write_voxels write.

    Files of System.save and checkpoints are none of them.

    Examples
    --------
    >>> import jam
    >>> [f.word for f in jam.files.formats() if f.content == "packings" and f.write and "walls" in f.holds]
    ['xyz', 'lammps', 'vtp']
    """
    found = []
    for line in raw.jam_formats().splitlines():
        content, _, word, name, endings, dim, holds, use = line.split("\t")
        names = tuple("" if e == "-" else "." + e for e in endings.split())
        found.append(Format(content, word, name, names, int(dim), tuple(holds.split()), "read" in use, "write" in use))
    return [*found, Format("packings", "gsd", "GSD of HOOMD-blue", (".gsd",), 3, ("spheres", "cells"), True, True)]


def half_bonds(system: System) -> tuple[Array, Array]:
    """Each contact as two half lines, one from each centre, so that none crosses the box.

    Returns ends (2 contacts, 2, d) and, for each, the index of its contact.
    """
    system = system.copy()  # of one moment
    c, x, s = system.contacts, system.positions, system.diameters
    wall = c.pairs[:, 1] < 0  # as if the sphere touched its mirror image, cut at the wall
    i, j = c.pairs[:, 0], np.where(wall, c.pairs[:, 0], c.pairs[:, 1])
    distance = contact_distance(s[i], s[j], system.info.non_additivity)
    half = (np.where(wall, 0.25, 0.5) * distance * (1.0 + c.gaps))[:, None] * c.vectors
    a, b = x[i], np.where(wall[:, None], x[i] - 2 * half, x[j])
    ends = np.concatenate([np.stack([a, a - half], 1), np.stack([b, b + half], 1)])
    return ends, np.tile(np.arange(len(c)), 2)


def write_vtk(system: System, path: str | os.PathLike[str]) -> None:
    """The spheres as .vtp points with diameter, contacts and kind (0 rattler, 1 buckler, 2 other).

    In ParaView: filter Glyph, sphere, scale by `diameter`, factor 1.
    """
    system.write(path, "vtp")


def write_vtk_network(system: System, path: str | os.PathLike[str]) -> None:
    """The force network as .vtp lines with force (mean 1) and gap; each contact as two half lines.

    In ParaView: filter Tube, vary radius by `force`.
    """
    system.write_contacts(path, "vtp")


def _axes(d: int) -> list[str]:
    return list("xyz"[:d]) if d <= 3 else [f"x{k + 1}" for k in range(d)]


def write_csv(system: System, path: str | os.PathLike[str]) -> None:
    """One line per sphere: coordinates, diameter and, after crunch, contacts."""
    system = system.copy()  # of one moment
    columns, names = [system.positions, system.diameters[:, None]], _axes(system.dim) + ["diameter"]
    with suppress(StateError):  # there is no network before a crunch
        columns, names = columns + [system.coordination[:, None]], names + ["contacts"]
    with replacing(path) as file:
        np.savetxt(file, np.hstack(columns), fmt="%.17g", delimiter=",", header=",".join(names), comments="")


def write_contacts_csv(system: System, path: str | os.PathLike[str]) -> None:
    """One line per contact: i, j, unit vector, gap, force (mean 1)."""
    system.write_contacts(path, "csv")


def _write_table(path: str | os.PathLike[str], made: tuple[int, str]) -> None:
    """A table as the code of jam-pack has made it."""
    not_cancelled(made[0])
    with replacing(path) as file:
        file.write(made[1].encode("ascii"))


def write_spectrum_csv(modes: Modes, path: str | os.PathLike[str]) -> None:
    """One line per mode that converged: number, lambda = omega^2, omega, inverse participation ratio."""
    _write_table(path, raw.table_of_modes(np.column_stack([modes.values, modes.participation]).reshape(-1)))


def write_gaps_csv(system: System, path: str | os.PathLike[str], h_max: float = 1.0) -> None:
    """One line per gap below h_max that is no contact, ascending: i, j, gap, and 1 when both spheres are stable."""
    _write_table(path, raw.table_of_gaps(system.handle, h_max))


def write_structure_csv(system: System, path: str | os.PathLike[str]) -> None:
    """One line per sphere: contacts, class, C_i = sum n_ij, S_i and the same with forces, Q6, Voronoi packing fraction (d = 3)."""
    _write_table(path, raw.table_of_structure(system.handle))


def write_gsd(system: System, path: str | os.PathLike[str]) -> None:
    """Writes one frame: float32 for every reader of GSD, and the doubles in chunks log/jam, which `read_gsd` prefers."""
    gsd.write(path, system)


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

    Files that libjam wrote come back to the bit. Others store float32, so that spheres in contact overlap by 1e-7:
    overlap='shrink' is then needed.

    Diameters are searched in particles/diameter, in the spheres of particles/type_shapes and in
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
        As of System.from_arrays, except for box, cell and dim, which the file gives.
    """
    return System._noted(*gsd.arguments(path, frame, diameters=diameters, radii=radii, doubles=doubles, **options))


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
        ASE recognises the format by the name or the content.
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
    return System._noted(*frames.of_ase(path, diameters, radii, dim, frame, options))
