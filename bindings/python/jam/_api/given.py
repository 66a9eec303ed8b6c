"""What the arguments of System.random, from_arrays and read mean. Mistakes that look like valid input are refused by name."""
from __future__ import annotations

from typing import Any

import numpy as np

from .exceptions import UnsupportedError
from .arrays import Array, as_array
from .generated import JAM_MAX_DIM, Container


def cell_of(box: Any, cell: Any, dim: int) -> tuple[float | None, Array | None]:
    """The side of a cube, or cell vectors (dim, dim), or neither of them when nothing was given."""
    if box is not None and cell is not None:
        raise TypeError("box and cell both name the periodic cell: give one of them")
    name, given = ("cell", cell) if box is None else ("box", box)
    if given is None:
        return None, None
    x, single = as_array(given, name=name), np.ndim(given) == 0
    if single and name == "box":
        return float(x[0]), None
    if x.shape == (dim, dim) and name == "cell":
        return None, x
    if dim and x.shape == (dim,):  # the sides of a brick
        return (float(x[0]), None) if (x == x[0]).all() else (None, np.diag(x))
    wanted = f"one side or {dim} sides" if name == "box" else f"{dim} vectors, shape ({dim}, {dim}), or {dim} sides"
    hint = ""
    if x.shape == (dim, dim):
        hint = ": give vectors by cell="
    elif x.shape == (6,):
        hint = (
            ": six numbers are lengths and angles in ASE, lengths and tilts in HOOMD. Give the vectors, "
            "for ASE's cell=ase.geometry.cellpar_to_cell(...)"
        )
    elif single:
        raise ValueError(f"cell must be {wanted}, not one number: for a cube give box=")
    elif dim == 2 and x.shape in ((3,), (3, 3)):
        hint = ": leave the third direction out"
    raise ValueError(f"{name} must be {wanted}, not an array of shape {x.shape}{hint}")


CONTAINERS = {kind.name.lower(): int(kind) for kind in Container}


def enclosure_of(container: Any, walls: Any, dim: int | None) -> tuple[int, int]:
    """The numbers of container= and walls=. Walls are a truth value for each axis, or letters such as "xz". dim: None where only
    a file knows it."""
    if container is not None and container not in CONTAINERS:
        raise ValueError(f"container must be one of {', '.join(map(repr, CONTAINERS))}, not {container!r}")
    kind = CONTAINERS[container or "brick"]
    if walls is None:
        return kind, 0
    if isinstance(walls, str):
        letters = "xyz"[: min(dim or 3, 3)]
        if set(walls) - set(letters) or len(set(walls)) != len(walls):
            raise ValueError(f"walls must name axes of {letters!r} once each, not {walls!r}")
        return kind, sum(1 << letters.index(axis) for axis in walls)
    axes = list(walls) if np.ndim(walls) == 1 else None
    wanted = len(axes or ()) if dim is None else dim
    if axes is None or len(axes) != wanted or any(axis not in (True, False) for axis in axes):
        raise ValueError(f"walls must be {dim or 'd'} truth values, one for each axis, or letters such as 'x', not {walls!r}")
    return kind, sum(1 << c for c, axis in enumerate(axes) if axis)


def container_word(info: Any) -> str:
    return Container(info.container).name.lower()


def walls_of(info: Any) -> list[bool]:
    """Axes with flat walls."""
    return [bool(info.walls >> c & 1) for c in range(info.dim)]


def closed_axes(info: Any) -> list[bool]:
    """Axes along which nothing repeats. A container closes all of them but z of a cylinder and, without flat walls, those of a brick."""
    return [wall or info.container != Container.BRICK and (info.container, c) != (Container.CYLINDER, 2) for c, wall in enumerate(walls_of(info))]


def refuse_unstored(system: Any, name: str) -> None:
    """For a format without walls and non-additive diameters, in the words of the library."""
    if len(system.walls().axis):
        raise UnsupportedError(f"{name} cannot store walls: write extended XYZ, LAMMPS data or a checkpoint")
    if system.info.non_additivity != 0:
        raise UnsupportedError(f"{name} cannot store non_additivity = {system.info.non_additivity:g}: write extended XYZ or a checkpoint")


def layout_of(options: dict[str, Any]) -> str:
    """What a file does not say, as jam_read_as takes it, from box, cell, origin and columns. A box of one side stays in
    the options."""
    box, cell = options.get("box"), options.pop("cell", None)
    if box is not None and cell is not None:
        raise TypeError("box and cell both name the periodic cell: give one of them")
    if box is not None and np.ndim(box) > 0:
        cell, options["box"] = box, None
    given = {"cell": cell, "origin": options.pop("origin", None)}
    words = [name + "=" + ",".join(repr(float(v)) for v in np.ravel(as_array(x, name=name))) for name, x in given.items() if x is not None]
    columns = options.pop("columns", None)
    if columns is not None:
        words.append("columns=" + ",".join([columns] if isinstance(columns, str) else columns))
    return " ".join(words)


def sizes_of(diameters: Any, radii: Any, n: int, names: tuple[str, str] = ("diameters", "radii")) -> Array:
    """Diameters (1,) or (n,) from one of the two."""
    if (diameters is None) == (radii is None):
        raise TypeError(f"give either {names[0]} or {names[1]}")
    name, given = ("diameters", diameters) if radii is None else ("radii", radii)
    x = as_array(given, name=name)
    if x.ndim > 1 or x.size not in (1, n):
        raise ValueError(f"{name} must be one number or have shape ({n},), not {x.shape}")
    return x.reshape(-1) if radii is None else 2.0 * x.reshape(-1)


def positions_of(given: Any, diameters: Any, radii: Any, dim: int | None) -> Array:
    """Positions (n, d). A transposed array and a last column of sizes are refused, unless dim= says that it is meant so."""
    x = as_array(given, name="positions")
    if x.ndim != 2:
        raise ValueError(f"positions must have shape (n, d), not {x.shape}")
    if len(x) == 0:
        raise ValueError("positions have no sphere")
    sizes = diameters if radii is None else radii
    count = np.size(sizes)
    turned = x.shape[1] > JAM_MAX_DIM and 2 <= len(x) <= JAM_MAX_DIM
    if turned or (count not in (1, len(x)) and count == x.shape[1]):
        raise ValueError(f"positions must have shape (n, d), not {x.shape}: transposed? Pass positions.T")
    if dim is not None:
        if x.shape[1] != dim:
            raise ValueError(f"positions must have shape (n, {dim}), not {x.shape}")
        return x
    last = x.shape[1] - 1
    columns = f"positions[:, :{last}], radii=positions[:, {last}]"
    if sizes is None:
        hint = f". If the last column contains radii, pass {columns}" if last >= 2 else ""
        raise TypeError(f"give either diameters or radii{hint}")
    if last >= 2 and len(x) > 1 and count in (1, len(x)):
        name = "diameters" if radii is None else "radii"
        size = np.broadcast_to(as_array(sizes, name=name).reshape(-1), len(x))
        if any(np.array_equal(x[:, last], factor * size) for factor in (0.5, 1.0, 2.0)):
            raise ValueError(
                f"the last column of positions {x.shape} contains the sizes of the spheres: pass {columns}. "
                f"If it is a coordinate, pass dim={x.shape[1]}"
            )
    return x


# Positions that were computed in single precision reach out of [0, 1] by this much.
ROUNDING = 1e-6


def refuse_unnamed_box(x: Array) -> None:
    """Positions outside [0, 1] belong to another box than the default, or were not wrapped yet: only the caller knows."""
    out = np.isfinite(x) & ((x < -ROUNDING) | (x > 1.0 + ROUNDING))
    if out.any():
        i, k = np.argwhere(out)[0]
        raise ValueError(
            f"positions[{i}, {k}] is {x[i, k]:g}, outside of the default box of side 1: pass box= or cell=; "
            "box=1 wraps the positions into that box"
        )


def refuse_start_options(options: dict[str, Any], names: tuple[str, ...], source: str) -> None:
    """Options of another way to make a system, which would be without effect."""
    for name in names:
        if options.get(name) is not None:
            raise TypeError(f"{name}={options[name]!r} would be without effect: {source}")
