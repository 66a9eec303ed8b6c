"""Arrays as C takes them."""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]
DTYPES = {"double": np.float64, "int32_t": np.int32, "int64_t": np.int64, "uint64_t": np.uint64, "size_t": np.uint64}


def unknown_array(shape: Any, dtype: Any = np.float64) -> Array:
    """An array for a call to fill: nan, or -1, where it writes nothing."""
    return np.full(shape, np.nan if np.dtype(dtype).kind == "f" else -1, dtype)


def placed(part: Array, cell: Array) -> Array:
    """Vectors (..., d) from their fractions of the cell's. BLAS would sum in another order on each processor."""
    return np.asarray(sum(part[..., c, None] * cell[c] for c in range(len(cell))))


def parts(x: Array, cell: Array) -> Array:
    """The fractions (..., d) of vectors in a cell that is a lower triangle."""
    part = np.array(x, float)
    for c in reversed(range(len(cell))):
        part[..., c] /= cell[c, c]
        part[..., :c] -= part[..., c, None] * cell[c, :c]
    return part


def nearest(x: Array, cell: Array) -> Array:
    """Vectors (..., d) less those of the cell: each fraction is from -1/2 to below 1/2."""
    part = parts(x, cell)
    return placed(part - np.floor(part + 0.5), cell)


def as_rows(columns: Any) -> Array:
    """The columns of a table, a named tuple, as a structured array."""
    rows = np.empty(len(columns[0]), [(name, "f8") for name in columns._fields])
    for name, values in zip(columns._fields, columns):
        rows[name] = values
    return rows


def as_vector(values: Any, dtype: str = "double", name: str = "array") -> Array:
    """as_array of one number or a row of them: a table would lose its shape without a word."""
    found = as_array(values, dtype, name)
    if found.ndim != 1:
        raise ValueError(f"{name} must be a row of numbers, not an array of shape {found.shape}")
    return found


def as_array(values: Any, dtype: str = "double", name: str = "array") -> Array:
    """Values as a C-contiguous array of the C type, copied only if needed. Complex, masked numbers and text are refused,
    and integers that the type does not hold."""
    if isinstance(values, np.ma.MaskedArray) and (masked := np.count_nonzero(values.mask)):
        raise ValueError(f"{name}: {masked} values are masked: fill them, or leave these spheres out")
    array = np.asarray(values)
    if array.dtype.kind in "US":
        hint = "; jam.sizes gives diameters of a law" if name == "diameters" else ""
        raise TypeError(f"{name} must be numbers, not text ({values!r}){hint}")
    wanted = np.dtype(DTYPES[dtype])
    if array.dtype != wanted and not np.can_cast(array.dtype, wanted, "same_kind"):
        raise TypeError(f"{name}: cannot convert {array.dtype} to {wanted} without loss")
    if wanted.kind in "iu" and array.dtype != wanted and array.size:
        held = np.iinfo(str(wanted))
        for value in (int(array.min()), int(array.max())):
            if not held.min <= value <= held.max:
                raise ValueError(f"{name} holds {value}, its numbers must be {held.min} to {held.max}")
    return np.ascontiguousarray(array, wanted)
