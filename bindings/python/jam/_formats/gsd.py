"""Frames of GSD by HOOMD's schema: what stands in a frame itself, what in frame 0, and what libjam keeps beside.

Needs python3-gsd.
"""
from __future__ import annotations

import os
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Callable

import numpy as np

from .._api.arrays import Array
from .._api.given import sizes_of
from .frames import bad, box_of, from_corner, in_range, notes_of, plane, refuse_cell, say_outside, say_unread
from .replacing import open_regular, replacing

# Positions are float32 in GSD's schema, which opens and closes gaps of 1e-7. The doubles are kept beside them.
_POSITION, _DIAMETER, _CELL = "jam/position", "jam/diameter", "jam/cell"
_KEPT = (_POSITION, _DIAMETER, _CELL)
# What every frame is read from; its number of steps says nothing about the packing.
_READ = {"configuration/step", "configuration/dimensions", "configuration/box", "particles/N", "particles/position"}
_SIZES = {"particles/diameter"}

Bad = Callable[[str], Exception]  # the exception for what is no packing


@dataclass
class Doubles:
    positions: Array
    diameters: Array
    cell: Array


@dataclass
class Found:
    dim: int
    positions: Array  # (n, 3), float32, around the centre of the cell
    diameters: Array | None
    cell: Array  # (3, 3), one vector a row
    doubles: Doubles | None
    boxed: bool  # the file names its box
    unread: list[str] = field(default_factory=list)  # chunks that hold more


def write(path: str | os.PathLike[str], positions: Array, diameters: Array, cell: Array) -> None:
    """Writes one frame: float32 for every reader of GSD, and the doubles in chunks log/jam, which `arguments` prefers."""
    import gsd.hoomd

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
        at, by_hand = in_range(name, frame, len(file)), diameters is not None or radii is not None
        found, notes = _read(file, at, partial(bad, name), not by_hand, doubles), notes_of(frame, len(file))
    d, cell, sizes = found.dim, found.cell[: found.dim, : found.dim], found.diameters
    x = plane(name, found.positions, found.cell, d, notes)
    say_unread(notes, "chunks", found.unread)
    if found.doubles is not None:
        x, sizes, cell = found.doubles.positions, found.doubles.diameters, found.doubles.cell
    else:
        if not found.boxed:
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


def _read(file: Any, frame: int, bad: Bad, sizes: bool, doubles: bool) -> Found:
    """One frame, with its diameters and with libjam's doubles where they are asked for."""
    one = file[frame]
    d, n = int(one.configuration.dimensions), int(one.particles.N)
    if d not in (2, 3):
        raise bad(f"configuration/dimensions is {d}, it must be 2 or 3")
    if n == 0:
        raise bad(f"frame {frame} has no sphere")
    if n > 1 and _chunk(file, frame, "particles/position") is None:
        raise bad(f"frame {frame} has no chunk particles/position")
    lx, ly, lz, xy, xz, yz = (float(v) for v in one.configuration.box)
    cell = np.array([[lx, 0, 0], [xy * ly, ly, 0], [xz * lz, yz * lz, lz]])
    x = np.asarray(one.particles.position)
    # GSD leaves its default box of side 1 out, so a file without a box holds either that one or none
    boxed = _chunk(file, frame, "configuration/box") is not None
    if not boxed and np.abs(x[:, :d]).max() > 0.5 + 1e-6:
        raise bad("no chunk configuration/box, and some positions lie outside the default box of side 1")
    kept = _doubles(file, frame, one, bad) if doubles else None
    found = Found(d, x, None, cell, kept, boxed)
    read = _READ | (_SIZES | {"log/" + name for name in _KEPT} if kept else set())
    if sizes and kept is None:
        found.diameters, places = _diameters(file, frame, one, bad)
        read = read | places
    found.unread = sorted(_names(file, frame) - read)
    return found


def _names(file: Any, frame: int) -> set[str]:
    """The chunks that this frame has, of its own or from frame 0."""
    names = file.file.find_matching_chunk_names("")
    return {name for name in names if any(file.file.chunk_exists(frame=k, name=name) for k in (frame, 0))}


def _chunk(file: Any, frame: int, name: str) -> Any:
    """A chunk of this frame, or of frame 0 where this frame has none: the rule of the schema."""
    for k in (frame, 0):
        if file.file.chunk_exists(frame=k, name=name):
            return file.file.read_chunk(frame=k, name=name)
    return None


def _doubles(file: Any, frame: int, one: Any, bad: Bad) -> Doubles | None:
    """What libjam kept, where it belongs to this frame: its float32 are the rounded doubles.

    GSD hands out frame 0's log for frames without one. Those are left out when they do not fit; a frame's own are
    refused, for another program changed one of the two.
    """
    log = {name: one.log.get(name) for name in _KEPT}
    if any(value is None for value in log.values()):
        return None
    own = any(file.file.chunk_exists(frame=frame, name="log/" + name) for name in _KEPT)
    kept = Doubles(np.asarray(log[_POSITION]), np.asarray(log[_DIAMETER]).reshape(-1), np.asarray(log[_CELL]))
    wrong = _difference(kept, one)
    if wrong and own:
        raise bad(
            f"{wrong} of frame {frame} does not agree with the copy of libjam in log/jam: another program changed the frame. "
            "doubles=False reads the frame alone",
        )
    return None if wrong else kept


def _difference(kept: Doubles, one: Any) -> str:
    d, n = int(one.configuration.dimensions), int(one.particles.N)
    if kept.positions.shape != (n, d) or kept.diameters.shape != (n,) or kept.cell.shape != (d, d):
        return "the number of spheres or dimensions"
    if not np.array_equal(_box(kept.cell).astype(np.float32)[: 6 if d == 3 else 2], one.configuration.box[: 6 if d == 3 else 2]):
        return "configuration/box"
    if not np.array_equal(_centred(kept.positions, kept.cell).astype(np.float32)[:, :d], one.particles.position[:, :d]):
        return "particles/position"
    if not np.array_equal(kept.diameters.astype(np.float32), one.particles.diameter):
        return "particles/diameter"
    return ""


def _diameters(file: Any, frame: int, one: Any, bad: Bad) -> tuple[Array, set[str]]:
    """Diameters (n,) from each place of the schema that names some, and the chunks that were read for them."""
    found: dict[str, Array] = {}
    if _chunk(file, frame, "particles/diameter") is not None:
        found["particles/diameter"] = np.asarray(one.particles.diameter, float)
    kinds = np.asarray(one.particles.typeid, int)
    by_type = {
        "particles/type_shapes": _of_shapes(one, bad) if _chunk(file, frame, "particles/type_shapes") is not None else None,
        "state/hpmc/sphere/radius": _of_state(file, frame, bad),
    }
    for name, values in by_type.items():
        if values is None:
            continue
        if kinds.min() < 0 or kinds.max() >= len(values):
            raise bad(f"{name} has {len(values)} types, and particles/typeid reaches {kinds.max()}")
        found[name] = values[kinds]
    if not found:
        raise bad(
            "no diameters in the file (particles/diameter, particles/type_shapes, state/hpmc/sphere/radius): give "
            "diameters=, also where they are 1, which GSD does not write",
        )
    first, *others = found
    for name in others:
        if not np.allclose(found[name], found[first], rtol=1e-6, atol=0.0):
            i = int(np.argmax(np.abs(found[name] - found[first])))
            raise bad(
                f"sphere {i} has the diameter {found[first][i]:g} by {first} and {found[name][i]:g} by {name}: "
                "give diameters=",
            )
    return found[first], set(found) | ({"particles/typeid", "particles/types"} if set(found) - _SIZES else set())


def _of_shapes(one: Any, bad: Bad) -> Array | None:
    """Diameters a type from the shapes of HOOMD; None where no type has a shape."""
    shapes = list(one.particles.type_shapes)
    if not any(shapes):
        return None
    sizes = np.empty(len(shapes))
    for k, shape in enumerate(shapes):
        if shape.get("type") not in ("Sphere", "Disk") or "diameter" not in shape:
            raise bad(f"particles/type_shapes: type {k} is {shape}, and no sphere with a diameter: give diameters=")
        sizes[k] = float(shape["diameter"])
    return sizes


def _of_state(file: Any, frame: int, bad: Bad) -> Array | None:
    """Diameters a type from the state of an HPMC integrator of spheres."""
    prefix = "state/hpmc/"
    names = {name for name in file.file.find_matching_chunk_names(prefix)}
    shapes = {name[len(prefix) :].split("/")[0] for name in names if name.count("/") > 2} - {"integrate"}
    if shapes - {"sphere"}:
        raise bad(f"{prefix}: the shapes are {', '.join(sorted(shapes))}, libjam takes spheres: give diameters=")
    radius = _chunk(file, frame, prefix + "sphere/radius")
    return None if radius is None else 2.0 * np.asarray(radius, float).reshape(-1)
