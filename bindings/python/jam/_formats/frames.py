"""What files of several frames in three coordinates have in common: errors, ranges, planes of d = 2, notes."""
from __future__ import annotations

from typing import Any, Iterable

import numpy as np

from .._api.arrays import Array
from .._api.errors import make
from .._api.generated import StatusCode
from .._api.given import ROUNDING

# A plane may be uneven by this part of its cell: distances in it change by less than their rounding.
_FLAT = 1e-8


def bad(path: str, text: str) -> Exception:
    """The error for a file that is no packing."""
    return make(int(StatusCode.E_FORMAT), f"{path}: {text}")


def refuse_cell(options: dict[str, Any], path: str) -> None:
    for name in ("box", "cell", "dim"):
        if options.get(name) is not None:
            raise TypeError(f"{name}={options[name]!r} would be without effect: {path} gives it")


def in_range(path: str, frame: int, count: int) -> int:
    if count == 0:
        raise bad(path, "the file has no frame")
    if not -count <= frame < count:
        raise IndexError(f"{path}: frame {frame} is out of range, the file has {count}: 0 to {count - 1}, or -1 for the last")
    return int(frame) % count


def plane(path: str, x: Array, cell: Array, dim: int, notes: list[str]) -> Array:
    """The first dim coordinates. In d = 2 the spheres must lie in one plane z = const, and two vectors in it."""
    if dim == 2 and x.shape[1] == 3:
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
    return np.asarray(x[:, :dim], float)


def box_of(cell: Array) -> dict[str, Any]:
    cube = (cell == cell[0, 0] * np.eye(len(cell))).all()
    return {"box": float(cell[0, 0])} if cube else {"cell": cell}


# Notes of what was changed or assumed, in the words of the readers of text files (src/io).
def notes_of(frame: int, count: int) -> list[str]:
    """The first notes: which frame was taken where nobody named one."""
    if frame != -1 or count == 1:
        return []
    return [f"the last of {count} frames was read; frame=0 to {count - 1} read others"]


def say_unread(notes: list[str], kind: str, names: Iterable[str]) -> None:
    if names := list(names):
        notes.append(" ".join(f"{kind} of the file that were not read: {', '.join(names)}".split()))


def from_corner(x: Array, corner: Array, notes: list[str]) -> Array:
    """Positions from the corner of the cell, where a file has its origin elsewhere."""
    if not corner.any():
        return x
    at = " ".join(f"{c:.17g}" for c in corner)
    notes.append(f"the corner of the cell is at {at} in the file: positions are measured from there")
    return x - corner


def say_outside(notes: list[str], x: Array, cell: Array) -> None:
    if np.linalg.det(cell) == 0.0:
        return  # refused by the library
    at = np.linalg.solve(cell.T, x.T)
    outside = int(((at < -ROUNDING) | (at > 1.0 + ROUNDING)).any(0).sum())
    if outside:
        notes.append(f"{outside} of {len(x)} spheres lay outside the cell and were wrapped into it")
