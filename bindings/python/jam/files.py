"""Files for other programs: VTK PolyData (.vtp, ParaView) of the spheres and of the force network, and CSV tables.

Extended XYZ (OVITO, ASE) and the plain format are written by System.write. Files are written beside and renamed.
"""
from __future__ import annotations

import os
import tempfile
from contextlib import contextmanager
from typing import Any, Iterator

import numpy as np

from .errors import StateError, UnsupportedError
from .results import Modes
from .system import System


@contextmanager
def _replacing(path: str | os.PathLike) -> Iterator[Any]:
    """A text file that takes the place of path when all went well."""
    folder, name = os.path.split(os.fspath(path))
    descriptor, beside = tempfile.mkstemp(prefix=name + ".", dir=folder or ".", text=True)
    try:
        with os.fdopen(descriptor, "w", encoding="ascii") as file:
            yield file
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(beside, 0o666 & ~mask)
        os.replace(beside, path)
    except BaseException:
        os.unlink(beside)
        raise


def half_bonds(system: System) -> tuple[np.ndarray, np.ndarray]:
    """Each contact as two half lines, one from each centre, so that none crosses the box.

    Returns ends (2 contacts, 2, d) and, for each, the index of its contact.
    """
    c, x, s = system.contacts, system.positions, system.diameters
    half = (0.25 * (s[c.pairs[:, 0]] + s[c.pairs[:, 1]]) * (1.0 + c.gaps))[:, None] * c.vectors
    a, b = x[c.pairs[:, 0]], x[c.pairs[:, 1]]
    ends = np.concatenate([np.stack([a, a - half], 1), np.stack([b, b + half], 1)])
    return ends, np.tile(np.arange(len(c)), 2)


def _kinds(system: System) -> np.ndarray | None:
    """0 rattler, 1 buckler, 2 other; None before crunch."""
    try:
        return np.where(system.rattlers, 0, np.where(system.bucklers, 1, 2))
    except StateError:
        return None


def _padded(x: np.ndarray) -> np.ndarray:
    d = x.shape[-1]
    if d > 3:
        raise ValueError(f"VTK holds two or three dimensions, not {d}")
    return np.concatenate([x, np.zeros((*x.shape[:-1], 3 - d))], -1)


def _data(file: Any, name: str, values: np.ndarray, components: int = 1) -> None:
    whole = np.issubdtype(values.dtype, np.integer)
    file.write(
        f'<DataArray type="{"Int64" if whole else "Float64"}" Name="{name}" NumberOfComponents="{components}" format="ascii">\n'
    )
    np.savetxt(file, values.reshape(-1, components), fmt="%d" if whole else "%.17g")
    file.write("</DataArray>\n")


def _polydata(path: Any, points: np.ndarray, cells: str, size: int, point_data: dict, cell_data: dict) -> None:
    count = len(points) // size
    with _replacing(path) as file:
        file.write(
            '<?xml version="1.0"?>\n<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">\n<PolyData>\n'
            f'<Piece NumberOfPoints="{len(points)}" NumberOfVerts="{count if cells == "Verts" else 0}" '
            f'NumberOfLines="{count if cells == "Lines" else 0}" NumberOfStrips="0" NumberOfPolys="0">\n<Points>\n'
        )
        _data(file, "Points", points, 3)
        file.write(f"</Points>\n<{cells}>\n")
        _data(file, "connectivity", np.arange(len(points)))
        _data(file, "offsets", np.arange(size, len(points) + 1, size))
        file.write(f"</{cells}>\n<PointData>\n")
        for name, values in point_data.items():
            _data(file, name, values)
        file.write("</PointData>\n<CellData>\n")
        for name, values in cell_data.items():
            _data(file, name, values)
        file.write("</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n")


def write_vtk(system: System, path: str | os.PathLike) -> None:
    """The spheres as .vtp points with diameter, contacts and kind (0 rattler, 1 buckler, 2 other).

    In ParaView: filter Glyph, sphere, scale by `diameter`, factor 1.
    """
    data, kinds = {"diameter": system.diameters}, _kinds(system)
    if kinds is not None:
        data.update(contacts=system.coordination, kind=kinds)
    _polydata(path, _padded(system.positions), "Verts", 1, data, {})


def write_vtk_network(system: System, path: str | os.PathLike) -> None:
    """The force network as .vtp lines with force (mean 1) and gap; each contact as two half lines.

    In ParaView: filter Tube, vary radius by `force`.
    """
    ends, index = half_bonds(system)
    contacts = system.contacts
    _polydata(
        path,
        _padded(ends).reshape(-1, 3),
        "Lines",
        2,
        {"force": np.repeat(contacts.forces[index], 2)},
        {"force": contacts.forces[index], "gap": contacts.gaps[index], "contact": index},
    )


def _axes(d: int) -> list[str]:
    return list("xyz"[:d]) if d <= 3 else [f"x{k + 1}" for k in range(d)]


def write_csv(system: System, path: str | os.PathLike) -> None:
    """One line a sphere: coordinates, diameter and, after crunch, contacts."""
    columns, names = [system.positions, system.diameters[:, None]], _axes(system.dim) + ["diameter"]
    if _kinds(system) is not None:
        columns, names = columns + [system.coordination[:, None]], names + ["contacts"]
    with _replacing(path) as file:
        np.savetxt(file, np.hstack(columns), fmt="%.17g", delimiter=",", header=",".join(names), comments="")


def write_contacts_csv(system: System, path: str | os.PathLike) -> None:
    """One line a contact: i, j, unit vector, gap, force (mean 1)."""
    c = system.contacts
    rows = np.hstack([c.pairs, c.vectors, c.gaps[:, None], c.forces[:, None]])
    with _replacing(path) as file:
        np.savetxt(
            file,
            rows,
            fmt=["%d", "%d"] + ["%.17g"] * (rows.shape[1] - 2),
            delimiter=",",
            header=",".join(["i", "j"] + [f"n{k + 1}" for k in range(system.dim)] + ["gap", "force"]),
            comments="",
        )


def write_spectrum_csv(modes: Modes, path: str | os.PathLike) -> None:
    """One line a mode that converged: number, lambda = omega^2, omega, participation."""
    values = modes.values[: np.count_nonzero(np.isfinite(modes.values))]
    rows = np.column_stack(
        [np.arange(len(values)), values, modes.frequencies[: len(values)], modes.participation[: len(values)]]
    )
    with _replacing(path) as file:
        np.savetxt(
            file, rows, fmt=["%d"] + ["%.17g"] * 3, delimiter=",", header="mode,lambda,omega,participation", comments=""
        )


def write_gaps_csv(system: System, path: str | os.PathLike, h_max: float = 1.0) -> None:
    """One line a gap below h_max that is no contact, ascending: i, j, gap, and 1 when both spheres are stable."""
    gaps, rattlers = system.gaps(h_max, False), system.rattlers
    stable = ~rattlers[gaps.pair].any(1)
    with _replacing(path) as file:
        np.savetxt(
            file,
            np.column_stack([gaps.pair, gaps.gap, stable]),
            fmt=["%d", "%d", "%.17g", "%d"],
            delimiter=",",
            header="i,j,gap,stable",
            comments="",
        )


def write_structure_csv(system: System, path: str | os.PathLike) -> None:
    """One line a sphere: contacts, class, C_i = sum n_ij, S_i and the same with forces, Q6, Voronoi packing fraction (d = 3)."""
    d, z = system.dim, system.coordination
    plain, weighted = system.sphere_structure(0), system.sphere_structure(1)
    q6 = system.bond_order(6, 1.2)
    try:
        phi = [f"{x:.17g}" for x in system.local_fraction()]
    except UnsupportedError:  # no Voronoi cells but in d = 3
        phi = [""] * system.n
    names = np.where(z == 0, "rattler", np.where(z == d + 1, "buckler", "stable"))
    with _replacing(path) as file:
        file.write(",".join(["sphere,z,class"] + [f"c{k + 1}" for k in range(d)] + ["s,fs,q6,phi"]) + "\n")
        for i in range(system.n):
            numbers = ",".join(f"{x:.17g}" for x in (*plain.c[i], plain.s[i], weighted.s[i], q6[i]))
            file.write(f"{i},{z[i]},{names[i]},{numbers},{phi[i]}\n")
