"""Option structs and enums from Python's values; wrong names get the nearest right ones."""
from __future__ import annotations

import difflib
import math
from typing import Any

from .. import raw
from . import generated
from .generated import OPTIONS


def as_enum(value: Any, kind: str, name: str) -> int:
    """An enum value of the argument `name`, given by number, member or word ('mk')."""
    if isinstance(value, str):
        enum = getattr(generated, kind)
        try:
            return int(enum[value.upper()])
        except KeyError:
            raise ValueError(f"{name}={value!r} is none of {', '.join(m.name.lower() for m in enum)}") from None
    return int(number(value, "int", name))


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
    "tol_overlap": "has no counterpart: no step can create an overlap; report.max_overlap gives the largest",
    "zero_force": "has no counterpart: report.min_force gives the smallest force",
    "verbose": "progress=True",
    "monitor_step": "progress=True",
    "sqrGamma0": "has no counterpart: the first stage is chosen by itself",
    "sqrΓ0": "has no counterpart: the first stage is chosen by itself",
    "thresholds_bounds": "has no counterpart: radius and bound follow the density",
    "L": "box",
    "R": "diameters (twice the radii) or radii",
}


# Other words of the field for what has one name here.
_OTHER_WORDS = {
    "N": "n",
    "d": "dim",
    "ndim": "dim",
    "phi": "packing_fraction",
    "density": "packing_fraction",
    "volume_fraction": "packing_fraction",
    "rate": "growth_rate",
    "tol": "gain_tolerance",
    "tolerance": "gain_tolerance",
    "max_time": "wall_time",
    "timeout": "wall_time",
    "side": "box",
    "coordination_number": "coordination",
    "z": "coordination",
    "bonds": "contacts",
    "gr": "pair_correlation",
    "g_r": "pair_correlation",
    "rdf": "pair_correlation",
    "sq": "structure_factor",
    "scale": "scale_diameters",
    "is_jammed": "check",
    "jammed": "report",
    "phi_J": "report",
    "eigenmodes": "modes",
    "spectrum": "density_of_states",
    "step": "run",
    "grow": "compress",
    "plot": "page",
    "draw": "page",
}
_ELSEWHERE = {
    "polydispersity": 'diameters=jam.sizes("normal", n, deviation=...) draws such sizes',
    "radii": "diameters takes twice the radii",
}


def other_word(name: str, known: Any) -> str:
    """What another word of the field is called here; "" where nothing of that name is known."""
    return _OTHER_WORDS.get(name, "") if _OTHER_WORDS.get(name) in known else ""


def unknown(name: str, known: Any) -> str:
    """What to say of an option that does not exist: the nearest names, and ours for one of CALiPPSO."""
    if name in _CALIPPSO:
        ours = _CALIPPSO[name]
        return f"{name!r} of CALiPPSO " + (ours if ours.startswith("has no") else f"is {ours} here")
    if word := other_word(name, known):
        return f"did you mean {word}?"
    if name in _ELSEWHERE:
        return _ELSEWHERE[name]
    near = difflib.get_close_matches(name, list(known), 3)
    return f"did you mean {' or '.join(near)}?" if near else f"there are {', '.join(known)}"


def option_struct(struct: str, given: dict[str, Any], beside: tuple[str, ...] = ()) -> Any:
    """An option struct with the library's defaults and the given values. None keeps the default. beside: what the caller
    takes too."""
    known = OPTIONS[struct]
    made = getattr(raw, struct)()
    for name, value in given.items():
        if name not in known:
            raise TypeError(f"unknown option {name!r}; {unknown(name, (*beside, *known))}")
        if value is None:
            continue
        kind = known[name][0]
        if kind in ("float", "int", "bool"):
            value = number(value, kind, name)
        else:
            value = as_enum(value, kind, name)
        try:
            setattr(made, name, value)
        except OverflowError as error:
            bits = 32 if "int32" in str(error) else 64
            raise ValueError(f"{name} is {value}, it must lie in -2**{bits - 1} to 2**{bits - 1} - 1") from None
    return made


def number(value: Any, kind: str, name: str) -> float | int:
    """A value of the kind float or int; what would lose a fraction is a TypeError."""
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
