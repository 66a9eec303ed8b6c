"""Calls any C function of the header by its conventions: options by keyword, arrays as numpy, count then fill."""
from __future__ import annotations

import math
from typing import Any, Iterable

import numpy as np

from .. import raw
from . import errors, exceptions, generated
from .arrays import DTYPES, Array, as_array, unknown_array
from .generated import CALLS, EXTENTS, OPTIONS, REPORTS, ROWS, StatusCode, TABLES
from .options import as_enum, option_struct, unknown
from .tuples import TUPLES

raw.set_error_factory(errors.make)


def freeze(struct: Any, name: str) -> Any:
    """A report struct of the raw layer as its dataclass."""
    cls = REPORTS[name]
    values = {}
    for field, kind in cls.__annotations__.items():
        value = getattr(struct, field)
        if kind == "bool":
            value = bool(value)
        elif kind not in ("int", "float"):
            try:
                value = getattr(generated, kind)(value)
            except ValueError:
                pass  # an unknown value of a newer library stays a number
        values[field] = value
    return cls(**values)


def new_report(name: str) -> Any:
    return getattr(raw, name)()


def _shape(extents: tuple[str, ...], count: str, m: int, d: int, n: int, alone: bool) -> tuple[int, ...]:
    """Shape of an array that a call fills, by the header's @shape, with one extent that the call gave: m is *rows; or
    *needed, the elements of a single array, and of several n for each value of that extent.
    """
    known = {i: d if e == "d" else n if e == "n" else int(e) for i, e in enumerate(extents) if e in ("d", "n") or e.isdigit()}
    if len(known) < len(extents) - 1:
        return (m,)
    given = m // (math.prod(known.values()) if alone else n if count == "needed" else 1)
    return tuple(known.get(i, given + (given > 0 and e.endswith("+ 1"))) for i, e in enumerate(extents))


def _spelled(shape: Iterable[Any]) -> str:
    parts = [str(e) for e in shape]
    return f"({', '.join(parts)}{',' if len(parts) == 1 else ''})"


def _check_shape(name: str, array: Array, extents: tuple[str, ...], known: dict[str, Any]) -> None:
    """Refuses an input that has not the header's @shape, nor is flat with as many elements, as in C. known: extents by
    letter, or a callable that asks; a letter that nobody knows is what the first array makes it.
    """
    wanted: list[int | None] = []
    for at, letter in enumerate(extents):
        if callable(known.get(letter)):
            known[letter] = known[letter]()
        if letter not in known and array.ndim == len(extents):
            known[letter] = array.shape[at]
        wanted.append(int(letter) if letter.isdigit() else known.get(letter))
    if array.ndim == len(extents) and all(a in (None, b) for a, b in zip(wanted, array.shape)):
        return
    if array.ndim == 1 and len(extents) > 1:
        size = math.prod(e for e in wanted if e is not None)
        if array.size == size or (None in wanted and size and array.size % size == 0):
            return
    shape = [e if n is None or e.isdigit() else n for e, n in zip(extents, wanted)]
    hint = ": transposed?" if array.ndim == len(extents) and list(array.shape) == wanted[::-1] else ""
    letters = "" if all(e.isdigit() or n is None for e, n in zip(extents, wanted)) else f"{_spelled(extents)} = "
    raise exceptions.ArgumentError(f"{name} must have shape {letters}{_spelled(shape)}, not {array.shape}{hint}")


def _letters(handle: Any, dim: int) -> dict[str, Any]:
    """Extents that a system has: d, n, and the N' stable spheres where there is a network."""

    def stable() -> int | None:
        try:
            return int(raw.jam_hessian_map(handle, None)[1])
        except exceptions.StateError:
            raw.jam_set_error("")
            return None  # the call itself says that there is none

    return {} if handle is None else {"d": dim, "n": lambda: raw.jam_view(handle, raw.JAM_VIEW_DIAMETERS)[1][1], "N'": stable}


INPUTS = ("scalar", "string", "array_in", "struct_in", "handle")


def _take_inputs(name: str, table: tuple[Any, ...], args: tuple[Any, ...], named: dict[str, Any]) -> dict[str, Any]:
    """Python arguments by the header's names. Other keywords must be members of an option struct."""
    inputs = [a for a in table if a[1] in INPUTS]
    plain = [a[0] for a in inputs if a[1] != "struct_in"]
    structs = {a[0]: a[2] for a in inputs if a[1] == "struct_in"}
    if len(args) > len(plain):
        raise TypeError(f"{name} takes at most {len(plain)} positional arguments: {', '.join(plain)}")
    given = dict(zip(plain, args))
    members: dict[str, dict[str, Any]] = {s: {} for s in structs}
    for key, value in named.items():
        if value is None and key not in plain:
            continue
        owners = [s for s, kind in structs.items() if key in OPTIONS[kind]]
        if key in plain:
            given[key] = value
        elif len(owners) == 1:
            members[owners[0]][key] = value
        else:
            known = plain + [k for s in structs.values() for k in OPTIONS[s]]
            raise TypeError(f"{name}: unknown option {key!r}; {unknown(key, known)}")
    given.update({s: option_struct(kind, members[s]) for s, kind in structs.items()})
    optional = {a[0] for a in inputs if a[1] == "array_in"}
    if missing := set(plain) - optional - set(given):
        raise TypeError(f"{name} needs {', '.join(sorted(missing))}")
    return given


def invoke(handle: Any, dim: int, name: str, args: tuple[Any, ...], named: dict[str, Any]) -> tuple[StatusCode, Any]:
    """Calls jam_<name>: inputs by position or keyword, members of option structs by keyword, outputs returned.

    Returns the status and the outputs: None, one result, or a named tuple. The size of arrays is queried first.
    """
    on_system, table = CALLS["jam_" + name]
    given = _take_inputs(name, table, args, named)
    passed: list[Any] = []
    outputs: dict[str, Any] = {}
    fills, asked = [], []
    extents, known = EXTENTS.get("jam_" + name, {}), _letters(handle, dim)
    for arg, role, ctype in table:
        if role == "array_in":
            value = given.get(arg)
            if value is not None:
                value = as_array(value, ctype, arg)
                _check_shape(arg, value, extents[arg], known)
            passed.append(None if value is None else value.reshape(-1))
        elif role == "handle":
            passed.append(getattr(given[arg], "handle", given[arg]))
        elif role in INPUTS:
            passed.append(as_enum(given[arg], ctype, arg) if role == "scalar" and ctype not in DTYPES else given[arg])
        elif role == "columns":
            passed.append(TABLES["jam_" + name])
        elif role == "struct_out":
            outputs[arg] = (new_report(ctype), ctype)
            passed.append(outputs[arg][0])
        elif role == "array_out":
            fills.append((arg, len(passed), ctype))
            outputs[arg] = None
            passed.append(None)
        elif role == "scalar_out":
            asked.append(arg)
    function, first = getattr(raw, "jam_" + name), (handle,) if on_system else ()
    answer = function(*first, *passed)
    status, *scalars = answer if isinstance(answer, (list, tuple)) else [answer]
    count = next((k for k, arg in enumerate(asked) if arg in ("needed", "rows")), None)
    if fills and count is not None and status in (0, StatusCode.AMBIGUOUS, StatusCode.NOT_JAMMED):
        m, spheres = scalars[count], raw.jam_view(handle, raw.JAM_VIEW_DIAMETERS)[1][1] if on_system else 0
        for arg, at, ctype in fills:
            shape = _shape(extents.get(arg, ("m",)), asked[count], m, dim, spheres, len(fills) == 1)
            outputs[arg] = unknown_array(shape, np.dtype(ROWS[ctype]) if ctype in ROWS else DTYPES[ctype])
            passed[at] = outputs[arg].reshape(-1)
        try:
            status, *scalars = function(*first, *passed)
        except exceptions.BufferError:
            raw.jam_set_error("")
            scalars[count] = -1
        same(scalars[count], m)
    if not any(isinstance(o, tuple) and "stop_reason" in REPORTS[o[1]].__annotations__ for o in outputs.values()):
        not_cancelled(status)
    results = {a: freeze(*o) if isinstance(o, tuple) else o for a, o in outputs.items()}
    results.update({a: v for a, v in zip(asked, scalars) if a not in ("needed", "rows")})
    if (columns := TABLES.get("jam_" + name)) and results["table"] is not None:
        flat = results["table"]
        return StatusCode(status), TUPLES[name](*(np.ascontiguousarray(flat[k::columns]) for k in range(columns)))
    if len(results) > 1:
        return StatusCode(status), TUPLES[name](*results.values())
    return StatusCode(status), next(iter(results.values()), None)


def same(found: Any, before: Any) -> None:
    """Raises where another thread has changed the packing between two calls that belong together, such as count and fill."""
    if not np.array_equal(found, before):
        raise exceptions.BusyError("another thread changed the packing while it was read: call again, or read a copy()")


def not_cancelled(status: int) -> int:
    """Raises where a cancel has ended a call: it has written nothing. Reports with a stop_reason say how far theirs came."""
    if status == StatusCode.CANCELLED:
        raise errors.StoppedError(errors.last_text())
    return status


def finished(answer: Any) -> None:
    """Raises where a cancel of another thread has ended a call that returns nothing."""
    status = answer[0] if isinstance(answer, (list, tuple)) else answer
    if status != 0:
        raise errors.StoppedError(errors.last_text())
