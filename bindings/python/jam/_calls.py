"""Calls any C function of the header by its conventions: options by keyword, arrays as numpy, count then fill."""
from __future__ import annotations

from typing import Any

import numpy as np

from . import _generated, errors, raw
from ._generated import CALLS, OPTIONS, REPORTS, ROWS, StatusCode

raw.set_error_factory(errors.make)
_DTYPES = {"double": np.float64, "int32_t": np.int32, "int64_t": np.int64, "uint64_t": np.uint64, "size_t": np.uint64}


def as_array(values: Any, dtype: str = "double", name: str = "array") -> np.ndarray:
    """Values as a C-contiguous array of the C type: as it is where it fits, else copied once (other dtypes, strides
    and Fortran order are welcome; complex numbers and text are not)."""
    array = np.asarray(values)
    wanted = np.dtype(_DTYPES[dtype])
    if array.dtype != wanted and not np.can_cast(array.dtype, wanted, "same_kind"):
        raise TypeError(f"{name}: cannot convert {array.dtype} to {wanted} without loss")
    return np.ascontiguousarray(array, wanted)


def as_enum(value: Any, kind: str) -> int:
    """An enum value given by number, member or name ('mk')."""
    if isinstance(value, str):
        enum = getattr(_generated, kind)
        try:
            return int(enum[value.upper()])
        except KeyError:
            raise ValueError(f"{value!r} is none of {', '.join(m.name.lower() for m in enum)}") from None
    return int(value)


def options(struct: str, given: dict[str, Any]) -> Any:
    """An option struct of the library's defaults, changed by what is given (None leaves the default)."""
    known = OPTIONS[struct]
    made = getattr(raw, struct)()
    for name, value in given.items():
        if name not in known:
            raise TypeError(f"unknown option {name!r}; {struct[4:]} are {', '.join(known)}")
        if value is None:
            continue
        kind = known[name][0]
        if kind == "float":
            value = float(value)
        elif kind == "int":
            if int(value) != value:
                raise TypeError(f"{name} must be a whole number, not {value!r}")
            value = int(value)
        else:
            value = as_enum(value, kind)
        setattr(made, name, value)
    return made


def freeze(struct: Any, name: str) -> Any:
    """A report struct of the raw layer as its dataclass."""
    cls = REPORTS[name]
    values = {}
    for field, kind in cls.__annotations__.items():
        value = getattr(struct, field)
        if kind not in ("int", "float"):
            try:
                value = getattr(_generated, kind)(value)
            except ValueError:
                pass  # a value that is newer than this table stays a number
        values[field] = value
    return cls(**values)


def new_report(name: str) -> Any:
    return getattr(raw, name)()


def describe(struct: str) -> str:
    """Lines for a docstring: each option with its meaning."""
    return "\n".join(f"    {name}: {text}" for name, (_, text) in OPTIONS[struct].items())


def invoke(handle: Any, name: str, *args: Any, **named: Any) -> Any:
    """Calls jam_<name> on a handle. Inputs are taken in the order of the header; outputs are returned.

    Arrays come back flat, as the header says; several outputs as a tuple; nothing else: the status.
    """
    table = CALLS["jam_" + name][1]
    inputs = [a for a in table if a[1] in ("scalar", "string", "array_in", "struct_in")]
    if len(args) > len(inputs):
        raise TypeError(f"{name} takes at most {len(inputs)} arguments")
    given = {**dict(zip((a[0] for a in inputs), args))}
    if struct := next((a[2] for a in inputs if a[1] == "struct_in"), None):
        given.update({k: named.pop(k) for k in list(named) if any(k == a[0] for a in inputs)})
        given.setdefault(next(a[0] for a in inputs if a[1] == "struct_in"), options(struct, named))
    else:
        given.update(named)
    unknown = set(given) - {a[0] for a in inputs}
    missing = {a[0] for a in inputs if a[1] != "array_in"} - set(given)
    if unknown or missing:
        raise TypeError(f"{name}: unexpected {sorted(unknown)}, missing {sorted(missing)}")
    passed, fills, reports = [], [], []
    for arg, role, ctype in table:
        if role == "array_in":
            value = given.get(arg)
            passed.append(None if value is None else as_array(value, ctype, arg).reshape(-1))
        elif role in ("scalar", "string", "struct_in"):
            passed.append(given[arg])
        elif role == "struct_out":
            reports.append((new_report(ctype), ctype))
            passed.append(reports[-1][0])
        elif role == "array_out":
            fills.append((len(passed), ctype))
            passed.append(None)
    function = getattr(raw, "jam_" + name)
    answer = function(handle, *passed)
    arrays = []
    if fills:
        if len(fills) > 1:
            raise TypeError(f"{name} has several output arrays: no method is made for it")
        at, ctype = fills[0]
        needed = answer[1]
        arrays = [np.empty(needed, np.dtype(ROWS[ctype]) if ctype in ROWS else _DTYPES[ctype])]
        passed[at] = arrays[0]
        answer = function(handle, *passed)
        answer = [answer[0], *answer[2:]]
    status, *scalars = answer if isinstance(answer, (list, tuple)) else [answer]
    results = arrays + [freeze(r, n) for r, n in reports] + scalars
    if not results:
        return StatusCode(status)
    return results[0] if len(results) == 1 else tuple(results)
