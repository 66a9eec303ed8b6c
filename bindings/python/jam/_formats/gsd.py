"""Frames of GSD by HOOMD's schema: what stands in a frame itself, what in frame 0, and what libjam keeps beside."""
from __future__ import annotations

import os
from typing import Any

import numpy as np

from .._api.arrays import Array, nearest
from .._api.given import refuse_unstored, sizes_of
from .frames import agreed, bad, chosen, placed, readable, say_unread
from .replacing import replacing

# Positions are float32 in GSD's schema, which opens and closes gaps of 1e-7. The doubles are kept beside them.
_KEPT = ("jam/position", "jam/diameter", "jam/cell")
_POSITION, _DIAMETER, _SHAPES, _RADII = "particles/position", "particles/diameter", "particles/type_shapes", "state/hpmc/sphere/radius"
# What every frame is read from; its number of steps says nothing about the packing.
_READ = {"configuration/step", "configuration/dimensions", "configuration/box", "particles/N", _POSITION}


def is_name(path: str | os.PathLike[str]) -> bool:
    """Whether the ending is that of GSD."""
    return os.fsdecode(path).lower().endswith(".gsd")


def package() -> tuple[Any, str]:
    """The module gsd.hoomd, and what its modes "r" and "w" end in: gsd 3 took the b away together with Snapshot."""
    import gsd.hoomd

    return gsd.hoomd, "b" if hasattr(gsd.hoomd, "Snapshot") else ""


def write(path: str | os.PathLike[str], system: Any) -> None:
    """Writes one frame: float32 for every reader of GSD, and the doubles in chunks log/jam, which `arguments` prefers."""
    system = system.copy()  # of one moment
    refuse_unstored(system, "GSD")
    hoomd, binary = package()
    positions, diameters, cell = system.positions, system.diameters, system.cell
    if len(cell) > 3:
        raise ValueError(f"GSD has two or three dimensions, this packing has d = {len(cell)}")
    frame = hoomd.Frame() if hasattr(hoomd, "Frame") else hoomd.Snapshot()
    frame.configuration.dimensions = len(cell)
    frame.particles.N = len(diameters)
    frame.configuration.box, frame.particles.position, frame.particles.diameter = _schema(positions, diameters, cell).values()
    frame.log = {name: np.array(value) for name, value in zip(_KEPT, (positions, diameters, cell))}
    with replacing(path) as part, hoomd.open(part.name, "w" + binary) as file:
        file.append(frame)


def arguments(
    path: str | os.PathLike[str],
    frame: int = -1,
    *,
    diameters: Any = None,
    radii: Any = None,
    doubles: bool = True,
    **options: Any,
) -> tuple[dict[str, Any], list[str]]:
    """What System.from_arrays takes for one frame, and notes; the arguments are those of jam.files.read_gsd."""
    hoomd, binary = package()
    name = readable(path, options)
    try:
        opened = hoomd.open(name, "r" + binary)
    except RuntimeError as error:  # the package's only word for a file that is none of GSD
        raise bad(name, f"no GSD file that can be read: {error}") from None
    with opened as file:
        at, notes = chosen(name, frame, len(file))
        found = _Frame(name, file, at)
        kept = found.doubles() if doubles else None
        if kept is None:
            made, read = found.placed(notes), _READ
        else:
            made = {"positions": kept[0], "cell": kept[2], "dim": found.dim}
            read = {*_READ, _DIAMETER, *(f"log/{name}" for name in _KEPT)}
        if diameters is not None or radii is not None:
            sizes = sizes_of(diameters, radii, found.n)
        elif kept is not None:
            sizes = kept[1]
        else:
            sizes, places = found.diameters()
            read = read | places
        say_unread(notes, "chunks", sorted(found.chunks() - read))
    return dict(made, diameters=sizes, **options), notes


def _schema(x: Array, diameters: Array, cell: Array) -> dict[str, Array]:
    """What HOOMD's schema keeps of a packing: Lx, Ly, Lz and the tilt factors of lower-triangular vectors, positions in the cell
    around the origin with z = 0 in d = 2, and diameters."""
    d = len(cell)
    box, centred = np.zeros(6), np.zeros((len(x), 3))
    box[:d] = np.diag(cell)
    box[3] = cell[1, 0] / cell[1, 1]
    if d == 3:
        box[4:] = cell[2, 0] / cell[2, 2], cell[2, 1] / cell[2, 2]
    centred[:, :d] = nearest(x - 0.5 * cell.sum(0), cell)
    return {"configuration/box": box, _POSITION: centred, _DIAMETER: diameters}


def _close(x: Array, there: Array, cell: Array) -> bool:
    """Whether positions are those of a file but for the last digits of a float32 and vectors of the cell, in which the
    arithmetic of processors differs."""
    d = len(cell)
    apart = np.abs(nearest(np.asarray(there, float)[:, :d] - x[:, :d], cell))
    return bool((apart <= np.finfo(np.float32).eps * np.abs(cell).sum(0)).all()) and np.array_equal(x[:, d:], there[:, d:])


class _Frame:
    """One frame of an open file. A chunk that it does not have is that of frame 0: the rule of the schema."""

    def __init__(self, path: str, file: Any, at: int) -> None:
        self.path, self.at, self.file, self.one = path, at, file.file, file[at]
        self.dim, self.n = int(self.one.configuration.dimensions), int(self.one.particles.N)
        if self.dim not in (2, 3):
            raise bad(self.path, f"configuration/dimensions is {self.dim}, it must be 2 or 3")
        if self.n == 0:
            raise bad(self.path, f"frame {at} has no sphere")

    def chunks(self) -> set[str]:
        """Those that this frame has, of its own or from frame 0."""
        return set(filter(self.has, self.file.find_matching_chunk_names("")))

    def has(self, name: str) -> bool:
        return any(self.file.chunk_exists(frame=k, name=name) for k in (self.at, 0))

    def placed(self, notes: list[str]) -> dict[str, Any]:
        """Positions from the corner of the cell, and its vectors."""
        if self.n > 1 and not self.has(_POSITION):
            raise bad(self.path, f"frame {self.at} has no chunk {_POSITION}")
        lx, ly, lz, xy, xz, yz = (float(v) for v in self.one.configuration.box)
        cell = np.array([[lx, 0, 0], [xy * ly, ly, 0], [xz * lz, yz * lz, lz]])
        x = np.asarray(self.one.particles.position)
        # GSD leaves its default box of side 1 out, so a file without a box holds either that one or none
        if not self.has("configuration/box"):
            if np.abs(x[:, : self.dim]).max() > 0.5 + 1e-6:
                raise bad(self.path, "no chunk configuration/box, and some positions lie outside the default box of side 1")
            notes.append("the file names no box: its side is taken as 1")
        notes.append("positions of the file have single precision, about 7 digits")
        return placed(self.path, x, cell, -0.5 * cell[: self.dim].sum(0), self.dim, notes)

    def doubles(self) -> list[Array] | None:
        """Positions, diameters and cell that libjam kept in this frame: its float32 are the rounded doubles. None where it has
        none, though GSD hands out those of frame 0."""
        if not all(self.file.chunk_exists(frame=self.at, name="log/" + name) for name in _KEPT):
            return None
        kept = [np.asarray(self.one.log[name]) for name in _KEPT]
        wrong = ["the number of spheres or dimensions"]
        if [value.shape for value in kept] == [(self.n, self.dim), (self.n,), (self.dim, self.dim)]:
            found = self.one.configuration.box, self.one.particles.position, self.one.particles.diameter
            wrong = [
                name for (name, value), there in zip(_schema(*kept).items(), found)
                if not (_close(value, there, kept[2]) if name == _POSITION else np.array_equal(value.astype(np.float32), there))
            ]
        if wrong:
            raise bad(
                self.path,
                f"{wrong[0]} of frame {self.at} does not agree with the copy of libjam in log/jam: another program changed the "
                "frame. doubles=False reads the frame alone",
            )
        return kept

    def diameters(self) -> tuple[Array, set[str]]:
        """Diameters (n,) from each place of the schema that names some, and the chunks that were read for them."""
        found = {_DIAMETER: np.asarray(self.one.particles.diameter, float)} if self.has(_DIAMETER) else {}
        kinds = np.asarray(self.one.particles.typeid, int)
        for name, values in self.of_types().items():
            if kinds.min() < 0 or kinds.max() >= len(values):
                raise bad(self.path, f"{name} has {len(values)} types, and particles/typeid reaches {kinds.max()}")
            found[name] = values[kinds]
        if not found:
            raise bad(
                self.path,
                f"no diameters in the file ({_DIAMETER}, {_SHAPES}, {_RADII}): give diameters=, also where they are 1, which GSD "
                "does not write",
            )
        by_type = () if [*found] == [_DIAMETER] else ("particles/typeid", "particles/types")
        return agreed(self.path, found, 1e-6), {*found, *by_type}

    def of_types(self) -> dict[str, Array]:
        """Diameters a type: from the shapes of HOOMD where a type has one, and from the state of an HPMC integrator of spheres."""
        found: dict[str, Array] = {}
        shapes = self.one.particles.type_shapes
        if any(shapes):
            for k, shape in enumerate(shapes):
                if shape.get("type") not in ("Sphere", "Disk") or "diameter" not in shape:
                    raise bad(self.path, f"{_SHAPES}: type {k} is {shape}, and no sphere with a diameter: give diameters=")
            found[_SHAPES] = np.array([float(shape["diameter"]) for shape in shapes])
        prefix = "state/hpmc/"
        names = self.file.find_matching_chunk_names(prefix)
        kinds = {name[len(prefix) :].split("/")[0] for name in names if name.count("/") > 2} - {"integrate"}
        if kinds - {"sphere"}:
            raise bad(self.path, f"{prefix}: the shapes are {', '.join(sorted(kinds))}, libjam takes spheres: give diameters=")
        for k in (k for k in (0, self.at) if self.file.chunk_exists(frame=k, name=_RADII)):
            found[_RADII] = 2.0 * np.asarray(self.file.read_chunk(frame=k, name=_RADII), float).reshape(-1)
        return found
