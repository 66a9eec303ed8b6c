"""What files of several frames in three coordinates have in common: errors, frames, planes of d = 2, notes."""
from __future__ import annotations

import os
from typing import Any, Iterable

import numpy as np

from .._api.arrays import Array
from .._api.errors import make
from .._api.generated import StatusCode
from .._api.given import ROUNDING
from .replacing import open_regular

# A plane may be uneven by this part of its cell: distances in it change by less than their rounding.
_FLAT = 1e-8


def bad(path: str, text: str) -> Exception:
    """The error for a file that is no packing."""
    return make(int(StatusCode.E_FORMAT), f"{path}: {text}")


def readable(path: str | os.PathLike[str], options: dict[str, Any]) -> str:
    """The name of a file that can be read, without options that it gives itself."""
    name = os.fsdecode(path)
    for option in ("box", "cell", "dim"):
        if options.get(option) is not None:
            raise TypeError(f"{option}={options[option]!r} would be without effect: {name} gives it")
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
    return dict(positions=x, **box_of(cell), dim=dim)


def box_of(cell: Array) -> dict[str, Any]:
    cube = (cell == cell[0, 0] * np.eye(len(cell))).all()
    return {"box": float(cell[0, 0])} if cube else {"cell": cell}


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
