"""Calls any C function of the header by its conventions: options by keyword, arrays as numpy, count then fill."""
from __future__ import annotations

import difflib
import inspect
import math
import textwrap
from typing import Any, Callable

import numpy as np

from .arrays import Array
from . import generated, errors
from .._system import methods
from .. import raw
from .generated import CALLS, OPTIONS, REPORTS, ROWS, TABLES, StatusCode

raw.set_error_factory(errors.make)
_DTYPES = {"double": np.float64, "int32_t": np.int32, "int64_t": np.int64, "uint64_t": np.uint64, "size_t": np.uint64}


def as_array(values: Any, dtype: str = "double", name: str = "array") -> Array:
    """Values as a C-contiguous array of the C type, copied only if needed. Complex, masked numbers and text are refused."""
    if isinstance(values, np.ma.MaskedArray) and (masked := np.count_nonzero(values.mask)):
        raise ValueError(f"{name}: {masked} values are masked: fill them, or leave these spheres out")
    array = np.asarray(values)
    wanted = np.dtype(_DTYPES[dtype])
    if array.dtype != wanted and not np.can_cast(array.dtype, wanted, "same_kind"):
        raise TypeError(f"{name}: cannot convert {array.dtype} to {wanted} without loss")
    return np.ascontiguousarray(array, wanted)


def as_enum(value: Any, kind: str) -> int:
    """An enum value given by number, member or name ('mk')."""
    if isinstance(value, str):
        enum = getattr(generated, kind)
        try:
            return int(enum[value.upper()])
        except KeyError:
            raise ValueError(f"{value!r} is none of {', '.join(m.name.lower() for m in enum)}") from None
    return int(value)


# Options of CALiPPSO.jl, for users who come from it; bindings/docs/coming_from.md has the whole table.
_CALIPPSO = {
    "l0": "neighbour_radius (in mean diameters)",
    "ℓ0": "neighbour_radius (in mean diameters)",
    "sbound": "step_bound (in mean diameters)",
    "max_iters": "max_lps",
    "tol_Gamma_convergence": "gain_tolerance",
    "tol_Γ_convergence": "gain_tolerance",
    "tol_S_convergence": "step_tolerance (in mean diameters)",
    "optimizer": "lp_solver ('ipm' or 'clp')",
    "solver": "lp_solver ('ipm' or 'clp')",
    "solver_attributes": "lp_tolerance",
    "tol_mechanical_equilibrium": "polish; report.force_residual gives the balance reached",
    "tol_overlap": "nothing: no step can create an overlap; report.max_overlap gives the largest",
    "zero_force": "nothing: report.min_force gives the smallest force",
    "verbose": "progress=True",
    "monitor_step": "progress=True",
    "sqrGamma0": "nothing: the first stage is chosen by itself",
    "sqrΓ0": "nothing: the first stage is chosen by itself",
    "thresholds_bounds": "nothing: radius and bound follow the density",
    "L": "box",
    "R": "diameters (twice the radii) or radii",
}


def _unknown(name: str, known: Any) -> str:
    """What to say of an option that does not exist: the nearest names, and ours for one of CALiPPSO."""
    if name in _CALIPPSO:
        return f"{name!r} of CALiPPSO is {_CALIPPSO[name]} here"
    near = difflib.get_close_matches(name, list(known), 3)
    return f"did you mean {' or '.join(near)}?" if near else f"there are {', '.join(known)}"


def options(struct: str, given: dict[str, Any]) -> Any:
    """An option struct with the library's defaults and the given values. None keeps the default."""
    known = OPTIONS[struct]
    made = getattr(raw, struct)()
    for name, value in given.items():
        if name not in known:
            raise TypeError(f"unknown option {name!r}; {_unknown(name, known)}")
        if value is None:
            continue
        kind = known[name][0]
        if kind in ("float", "int", "bool"):
            value = _number(value, kind, name)
        else:
            value = as_enum(value, kind)
        try:
            setattr(made, name, value)
        except OverflowError as error:
            bits = 32 if "int32" in str(error) else 64
            raise ValueError(f"{name} is {value}, it must lie in -2**{bits - 1} to 2**{bits - 1} - 1") from None
    return made


def _number(value: Any, kind: str, name: str) -> float | int:
    try:
        if kind == "float":
            return float(value)
        whole = int(value)
    except (TypeError, ValueError, OverflowError):
        wanted = "a number" if kind == "float" else "a whole number"
        raise TypeError(f"{name} must be {wanted}, not {value!r}") from None
    if whole != value:
        raise TypeError(f"{name} must be a whole number, not {value!r}")
    return whole


def spelled_out(made: Any, struct: str) -> dict[str, Any]:
    """All members of an option struct as JSON holds them: enums by name, numbers that are not finite as text."""
    plain: dict[str, Any] = {}
    for name, (kind, _) in OPTIONS[struct].items():
        value = getattr(made, name)
        if kind == "float":
            plain[name] = float(value) if math.isfinite(value) else str(float(value))
        else:
            plain[name] = int(value) if kind in ("int", "bool") else getattr(generated, kind)(int(value)).name.lower()
    return plain


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


def spell_out(method: Any, struct: str) -> None:
    """Puts the options of a struct in place of **options: into the signature that help() and editors show, and into the
    section Parameters of the docstring."""
    signature = inspect.signature(method)
    shown = [p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD]
    new = {name: entry for name, entry in OPTIONS[struct].items() if name not in signature.parameters}
    for name, (kind, _) in new.items():
        hint = kind if kind in ("int", "float", "bool") else "int | str"
        shown.append(inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=f"{hint} | None"))
    method.__signature__ = signature.replace(parameters=shown)
    rows = [
        "progress : bool or callable, optional",
        "    True: a line that changes. A callable gets a Progress; a true answer",
    ]
    rows[-1] += " stops the call."
    for name, (kind, text) in new.items():
        enum = getattr(generated, kind, None) if kind not in ("int", "float", "bool") else None
        choices = "{" + ", ".join(repr(e.name.lower()) for e in enum) + "}" if enum else kind
        rows.append(f"{name} : {choices}, optional")
        rows += textwrap.wrap(" ".join(text.split()), 100, initial_indent="    ", subsequent_indent="    ")
    block = "\n".join(rows)
    doc = inspect.cleandoc(method.__doc__ or "")  # Python 3.13 has taken the indentation away already
    head = "\n\nParameters\n----------\n"
    if head in doc:
        at = doc.find("\n\n", doc.index(head) + len(head))
        at = len(doc) if at < 0 else at
        method.__doc__ = doc[:at] + "\n" + block + doc[at:] + "\n"
    else:
        at = doc.find("\n\nReturns\n")
        at = len(doc) if at < 0 else at
        method.__doc__ = doc[:at] + head + block + doc[at:] + "\n"


# Shapes of the arrays that calls fill, by name of function and array: m is *needed or *rows, d the dimension. Others are flat (m,).
SHAPES: dict[str, dict[str, Callable[[int, int], tuple[int, ...]]]] = {
    "contacts": {"iout": lambda m, d: (m // 2, 2)},
    "contact_vectors": {"out": lambda m, d: (m // d, d)},
    "crunch_step_contacts": {"iout": lambda m, d: (m // 2, 2)},
    "crunch_step_displacements": {"out": lambda m, d: (m // d, d)},
    "crunch_step_vectors": {"out": lambda m, d: (m // d, d)},
    "floppy_mode": {"out": lambda m, d: (m // d, d)},
    "compare": {"out": lambda m, d: (m // d, d)},
    "elastic_tensor": {"affine": lambda m, d: (d, d, d, d), "relaxed": lambda m, d: (d, d, d, d)},
    "gaps": {"pair": lambda m, d: (m, 2)},
    "sphere_structure": {"c": lambda m, d: (m, d)},
    "observed_spheres": {"displacement": lambda m, d: (m, d)},
    "isoconf_sums": {"displacement": lambda m, d: (m, d), "square": lambda m, d: (m, d)},
    "observed_pairs": {"pair": lambda m, d: (m, 2)},
    "observed_gaps": {"edge": lambda m, d: (m + 1 if m else 0,)},
}
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
            raise TypeError(f"{name}: unknown option {key!r}; {_unknown(key, known)}")
    given.update({s: options(kind, members[s]) for s, kind in structs.items()})
    optional = {a[0] for a in inputs if a[1] == "array_in"}
    if missing := set(plain) - optional - set(given):
        raise TypeError(f"{name} needs {', '.join(sorted(missing))}")
    return given


def invoke(handle: Any, dim: int, name: str, args: tuple[Any, ...], named: dict[str, Any]) -> tuple[StatusCode, Any]:
    """Calls jam_<name>: inputs by position or keyword, members of option structs by keyword, outputs returned.

    Returns the status and the outputs: None, one result, or a named tuple. Arrays are asked for their size first.
    """
    on_system, table = CALLS["jam_" + name]
    given = _take_inputs(name, table, args, named)
    passed: list[Any] = []
    outputs: dict[str, Any] = {}
    fills, asked = [], []
    for arg, role, ctype in table:
        if role == "array_in":
            value = given.get(arg)
            passed.append(None if value is None else as_array(value, ctype, arg).reshape(-1))
        elif role == "handle":
            passed.append(getattr(given[arg], "handle", given[arg]))
        elif role in INPUTS:
            passed.append(as_enum(given[arg], ctype) if role == "scalar" and ctype not in _DTYPES else given[arg])
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
    if fills and count is not None and status in (0, StatusCode.AMBIGUOUS):
        m = scalars[count]
        for arg, at, ctype in fills:
            shape = SHAPES.get(name, {}).get(arg, lambda m, d: (m,))(m, dim)
            outputs[arg] = np.empty(shape, np.dtype(ROWS[ctype]) if ctype in ROWS else _DTYPES[ctype])
            passed[at] = outputs[arg].reshape(-1)
        status, *scalars = function(*first, *passed)
        if status in (StatusCode.CANCELLED,):
            outputs.update({arg: None for arg, _, _ in fills})
    results = {a: freeze(*o) if isinstance(o, tuple) else o for a, o in outputs.items()}
    results.update({a: v for a, v in zip(asked, scalars) if a not in ("needed", "rows")})
    if (columns := TABLES.get("jam_" + name)) and results["table"] is not None:
        flat = results["table"]
        made = getattr(methods, camel(name) + "Result")
        return StatusCode(status), made(*(np.ascontiguousarray(flat[k::columns]) for k in range(columns)))
    if len(results) > 1:
        made = getattr(methods, camel(name) + "Result", None)
        return StatusCode(status), made(*results.values()) if made else tuple(results.values())
    return StatusCode(status), next(iter(results.values()), None)


def finished(answer: Any) -> None:
    """Raises where a cancel of another thread has ended a call that returns nothing."""
    status = answer[0] if isinstance(answer, (list, tuple)) else answer
    if status != 0:
        raise errors.StoppedError(raw.jam_last_error())


def camel(name: str) -> str:
    return "".join(w.capitalize() for w in name.removesuffix("_get").split("_"))
