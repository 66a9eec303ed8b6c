"""Frames of GSD by HOOMD's schema: what stands in a frame itself, what in frame 0, and what libjam keeps beside.

Needs python3-gsd.
"""
from __future__ import annotations

import os
from typing import Any, NamedTuple

import numpy as np

from .._api.arrays import Array
from .._api.given import refuse_unstored, sizes_of
from .frames import bad, box_of, from_corner, in_range, notes_of, plane, refuse_cell, say_outside, say_unread
from .replacing import open_regular, replacing

# Positions are float32 in GSD's schema, which opens and closes gaps of 1e-7. The doubles are kept beside them.
_POSITION, _DIAMETER, _CELL = "jam/position", "jam/diameter", "jam/cell"
_KEPT = (_POSITION, _DIAMETER, _CELL)
# What every frame is read from; its number of steps says nothing about the packing.
_READ = {"configuration/step", "configuration/dimensions", "configuration/box", "particles/N", "particles/position"}
_SIZES = {"particles/diameter"}


class Doubles(NamedTuple):
    """What libjam keeps beside the float32 of a frame."""

    positions: Array
    diameters: Array
    cell: Array


def write(path: str | os.PathLike[str], system: Any) -> None:
    """Writes one frame: float32 for every reader of GSD, and the doubles in chunks log/jam, which `arguments` prefers."""
    system = system.copy()  # of one moment
    refuse_unstored(system, "GSD")
    import gsd.hoomd

    positions, diameters, cell = system.positions, system.diameters, system.cell
    if len(cell) > 3:
        raise ValueError(f"GSD has two or three dimensions, this packing has d = {len(cell)}")
    frame = gsd.hoomd.Snapshot()
    frame.configuration.dimensions = len(cell)
    frame.configuration.box = _box(cell)
    frame.particles.N = len(diameters)
    frame.particles.position = _centred(positions, cell)
    frame.particles.diameter = diameters
    frame.log = {_POSITION: np.array(positions), _DIAMETER: np.array(diameters), _CELL: np.array(cell)}
    with replacing(path) as part, gsd.hoomd.open(part.name, "wb") as file:
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
    import gsd.hoomd

    name = os.fsdecode(path)
    refuse_cell(options, name)
    open_regular(name).close()
    try:
        opened = gsd.hoomd.open(name, "rb")
    except RuntimeError as error:  # the package's only word for a file that is none of GSD
        raise bad(name, f"no GSD file that can be read: {error}") from None
    with opened as file:
        at, notes = in_range(name, frame, len(file)), notes_of(frame, len(file))
        found = _Frame(name, file, at)
        by_hand = diameters is not None or radii is not None
        x, whole, boxed = found.positions()
        kept = found.doubles() if doubles else None
        read = _READ | (_SIZES | {"log/" + key for key in _KEPT} if kept else set())
        if not by_hand and kept is None:
            sizes, places = found.diameters()
            read = read | places
        unread = sorted(found.chunks() - read)
    d = found.dim
    cell = whole[:d, :d]
    x = plane(name, x, whole, d, notes)
    say_unread(notes, "chunks", unread)
    if kept is not None:
        x, sizes, cell = kept
    else:
        if not boxed:
            notes.append("the file names no box: its side is taken as 1")
        notes.append("positions of the file have single precision, about 7 digits")
        x = from_corner(x, -0.5 * cell.sum(0), notes)
        say_outside(notes, x, cell)
    if by_hand:
        sizes = sizes_of(diameters, radii, len(x))
    return dict(positions=x, diameters=sizes, **box_of(cell), dim=d, **options), notes


def _box(cell: Array) -> Array:
    """Lx, Ly, Lz and the tilt factors of lower-triangular vectors."""
    d = len(cell)
    box = np.zeros(6)
    box[:d] = np.diag(cell)
    box[3] = cell[1, 0] / cell[1, 1]
    if d == 3:
        box[4:] = cell[2, 0] / cell[2, 2], cell[2, 1] / cell[2, 2]
    return box


def _centred(x: Array, cell: Array) -> Array:
    """In the cell around the origin, as HOOMD wants them, with z = 0 in d = 2."""
    s = np.linalg.solve(cell.T, np.asarray(x).T).T - 0.5
    found = np.zeros((len(x), 3))
    found[:, : len(cell)] = (s - np.floor(s + 0.5)) @ cell
    return found


class _Frame:
    """One frame of an open file. A chunk that it does not have is that of frame 0: the rule of the schema."""

    def __init__(self, path: str, file: Any, at: int) -> None:
        self.path, self.at, self.file, self.one = path, at, file.file, file[at]
        self.dim, self.n = int(self.one.configuration.dimensions), int(self.one.particles.N)
        if self.dim not in (2, 3):
            raise self.bad(f"configuration/dimensions is {self.dim}, it must be 2 or 3")
        if self.n == 0:
            raise self.bad(f"frame {at} has no sphere")

    def bad(self, text: str) -> Exception:
        return bad(self.path, text)

    def chunks(self) -> set[str]:
        """Those that this frame has, of its own or from frame 0."""
        return {name for name in self.file.find_matching_chunk_names("") if self.chunk_of(name) is not None}

    def chunk_of(self, name: str) -> int | None:
        """The frame that has the chunk."""
        return next((k for k in (self.at, 0) if self.file.chunk_exists(frame=k, name=name)), None)

    def chunk(self, name: str) -> Any:
        k = self.chunk_of(name)
        return None if k is None else self.file.read_chunk(frame=k, name=name)

    def positions(self) -> tuple[Array, Array, bool]:
        """Positions (n, 3) around the centre of the cell, its vectors (3, 3), and whether the file names its box."""
        if self.n > 1 and self.chunk_of("particles/position") is None:
            raise self.bad(f"frame {self.at} has no chunk particles/position")
        lx, ly, lz, xy, xz, yz = (float(v) for v in self.one.configuration.box)
        cell = np.array([[lx, 0, 0], [xy * ly, ly, 0], [xz * lz, yz * lz, lz]])
        x = np.asarray(self.one.particles.position)
        # GSD leaves its default box of side 1 out, so a file without a box holds either that one or none
        boxed = self.chunk_of("configuration/box") is not None
        if not boxed and np.abs(x[:, : self.dim]).max() > 0.5 + 1e-6:
            raise self.bad("no chunk configuration/box, and some positions lie outside the default box of side 1")
        return x, cell, boxed

    def doubles(self) -> Doubles | None:
        """What libjam kept, where it belongs to this frame: its float32 are the rounded doubles.

        GSD hands out frame 0's log for frames without one. Those are left out when they do not fit; a frame's own are
        refused, for another program changed one of the two.
        """
        log = [self.one.log.get(name) for name in _KEPT]
        if any(value is None for value in log):
            return None
        kept = Doubles(np.asarray(log[0]), np.asarray(log[1]).reshape(-1), np.asarray(log[2]))
        wrong = self.difference(kept)
        if wrong and any(self.file.chunk_exists(frame=self.at, name="log/" + name) for name in _KEPT):
            raise self.bad(
                f"{wrong} of frame {self.at} does not agree with the copy of libjam in log/jam: another program changed the "
                "frame. doubles=False reads the frame alone",
            )
        return None if wrong else kept

    def difference(self, kept: Doubles) -> str:
        d, n, one = self.dim, self.n, self.one
        if kept.positions.shape != (n, d) or kept.diameters.shape != (n,) or kept.cell.shape != (d, d):
            return "the number of spheres or dimensions"
        sides = slice(6 if d == 3 else 2)
        if not np.array_equal(_box(kept.cell).astype(np.float32)[sides], one.configuration.box[sides]):
            return "configuration/box"
        if not np.array_equal(_centred(kept.positions, kept.cell).astype(np.float32)[:, :d], one.particles.position[:, :d]):
            return "particles/position"
        return "" if np.array_equal(kept.diameters.astype(np.float32), one.particles.diameter) else "particles/diameter"

    def diameters(self) -> tuple[Array, set[str]]:
        """Diameters (n,) from each place of the schema that names some, and the chunks that were read for them."""
        found: dict[str, Array] = {}
        if self.chunk_of("particles/diameter") is not None:
            found["particles/diameter"] = np.asarray(self.one.particles.diameter, float)
        kinds = np.asarray(self.one.particles.typeid, int)
        for name, values in (("particles/type_shapes", self.of_shapes()), ("state/hpmc/sphere/radius", self.of_state())):
            if values is None:
                continue
            if kinds.min() < 0 or kinds.max() >= len(values):
                raise self.bad(f"{name} has {len(values)} types, and particles/typeid reaches {kinds.max()}")
            found[name] = values[kinds]
        if not found:
            raise self.bad(
                "no diameters in the file (particles/diameter, particles/type_shapes, state/hpmc/sphere/radius): give "
                "diameters=, also where they are 1, which GSD does not write",
            )
        first, *others = found
        for name in others:
            if not np.allclose(found[name], found[first], rtol=1e-6, atol=0.0):
                i = int(np.argmax(np.abs(found[name] - found[first])))
                raise self.bad(
                    f"sphere {i} has the diameter {found[first][i]:g} by {first} and {found[name][i]:g} by {name}: "
                    "give diameters=",
                )
        return found[first], set(found) | ({"particles/typeid", "particles/types"} if set(found) - _SIZES else set())

    def of_shapes(self) -> Array | None:
        """Diameters a type from the shapes of HOOMD; None where no type has a shape."""
        shapes = list(self.one.particles.type_shapes) if self.chunk_of("particles/type_shapes") is not None else []
        if not any(shapes):
            return None
        for k, shape in enumerate(shapes):
            if shape.get("type") not in ("Sphere", "Disk") or "diameter" not in shape:
                raise self.bad(f"particles/type_shapes: type {k} is {shape}, and no sphere with a diameter: give diameters=")
        return np.array([float(shape["diameter"]) for shape in shapes])

    def of_state(self) -> Array | None:
        """Diameters a type from the state of an HPMC integrator of spheres."""
        prefix = "state/hpmc/"
        names = self.file.find_matching_chunk_names(prefix)
        shapes = {name[len(prefix) :].split("/")[0] for name in names if name.count("/") > 2} - {"integrate"}
        if shapes - {"sphere"}:
            raise self.bad(f"{prefix}: the shapes are {', '.join(sorted(shapes))}, libjam takes spheres: give diameters=")
        radius = self.chunk(prefix + "sphere/radius")
        return None if radius is None else 2.0 * np.asarray(radius, float).reshape(-1)
