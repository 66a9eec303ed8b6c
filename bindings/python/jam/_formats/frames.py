"""What files of several frames in three coordinates have in common: errors, ranges, planes of d = 2."""
from __future__ import annotations

from typing import Any

import numpy as np

from .._api.arrays import Array
from .._api.errors import make
from .._api.generated import StatusCode

# A plane may be uneven by this part of its cell: distances in it change by less than their rounding.
_FLAT = 1e-8


def bad(path: str, text: str) -> Exception:
    """The error for a file that is no packing."""
    return make(int(StatusCode.E_FORMAT), f"{path}: {text}")


def refuse_cell(options: dict[str, Any], path: str) -> None:
    for name in ("box", "cell", "dim"):
        if options.get(name) is not None:
            raise TypeError(f"{name}={options[name]!r} would be without effect: {path} holds it")


def in_range(path: str, frame: int, count: int) -> int:
    if count == 0:
        raise bad(path, "the file holds no frame")
    if not -count <= frame < count:
        raise IndexError(f"{path}: frame {frame} is out of range, the file holds {count}: 0 to {count - 1}, or -1 for the last")
    return int(frame) % count


def plane(path: str, x: Array, cell: Array, dim: int) -> Array:
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
    return np.asarray(x[:, :dim], float)


def box_of(cell: Array) -> dict[str, Any]:
    cube = (cell == cell[0, 0] * np.eye(len(cell))).all()
    return {"box": float(cell[0, 0])} if cube else {"cell": cell}
