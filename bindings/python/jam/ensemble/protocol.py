"""The protocol of an ensemble: a plain dict that says how one packing is made from a seed; bindings/docs/ensembles.md has its
parts. complete() checks it and spells out every default; make() makes the packing.
"""
from __future__ import annotations

import copy
import hashlib
import inspect
import json
from contextlib import contextmanager, suppress
from typing import Any, Iterable, Iterator, Mapping, Sequence

import numpy as np

from .. import errors
from .._api.documented import changing, measuring
from .._api.generated import GROWTH_STAGES, OPTIONS, StatusCode
from .._api.given import cell_of, enclosure_of
from .._api.options import option_struct, spelled_out, unknown
from .._api.size_laws import rows_of, sizes as draw_sizes
from .._formats.write_packing import ALGORITHM
from .._system.verbs import stage_of
from ..system import System

#: Laws of diameters and what they take by default; besides these, every law of jam.sizes.
LAWS = {"bidisperse": {"ratio": 1.4, "share": 0.5}, "lognormal": {"deviation": 0.1}}
ANALYSIS: dict[str, dict[str, Any]] = {"gaps": {"h_max": 0.1, "stable_only": 1}, "crystal_score": {}}
_OF_A_DRAW = {"dim", "n", "seed", "cell_volume", "packing_fraction"}  # what start and seed say
_MOST_TRIED = 4096  # spheres of starts that are made to see whether any has room
_OF_SOFT = ("relax", "decompress", "shear")  # stages of spheres that overlap
_OF_SHEAR = ("to", "mode", "stress")  # what this stage takes beside the options of its verb


class ProtocolError(ValueError):
    """A protocol that cannot be run; the text names the entry and says what is allowed."""


@contextmanager
def _entry(where: str) -> Iterator[None]:
    """What is wrong inside is a ProtocolError that names the entry."""
    try:
        yield
    except (errors.JamError, TypeError, ValueError) as error:
        raise ProtocolError(f"{where}: {error}") from None


def _dict(given: Any, where: str) -> dict[str, Any]:
    """An entry that is one, or null in place of an empty one."""
    if not isinstance(given, (Mapping, type(None))):
        raise ProtocolError(f"{where} must be a dict, not {given!r}")
    return dict(given or {})


def _options(struct: str, given: Mapping[str, Any], leave_out: tuple[Any, ...] = ()) -> dict[str, Any]:
    """All options of a struct, those that are not given at the library's defaults."""
    known = [k for k in OPTIONS[struct] if k not in leave_out]
    if unknown := set(given) - set(known):
        raise ProtocolError(f"unknown {', '.join(sorted(unknown))}; there are {', '.join(known)}")
    return {k: v for k, v in spelled_out(option_struct(struct, dict(given)), struct).items() if k in known}


def _diameters(given: Any, n: int, dim: int) -> Any:
    if not isinstance(given, Mapping):
        sizes = np.asarray(given, float)
        if sizes.shape != (n,) or not (np.isfinite(sizes) & (sizes > 0)).all():
            raise ProtocolError(f"diameters must be {n} finite numbers > 0, a law, or None")
        return sizes.tolist()
    law = {k: float(v) if isinstance(v, (int, float)) else v for k, v in given.items()}
    law = {"law": law.pop("law", None), **LAWS.get(str(given.get("law")), {}), **law}
    known, text = {*OPTIONS["jam_diameters_options"], "curve"} - _OF_A_DRAW, "no law has {}; there are {}"
    if law["law"] == "bidisperse":
        known, text = set(LAWS["bidisperse"]), "bidisperse has no {}; it takes {}"
    if unknown := set(law) - known - {"law"}:
        raise ProtocolError("diameters: " + text.format(", ".join(sorted(unknown)), " and ".join(sorted(known))))
    with _entry(f"diameters {dict(given)!r}"):
        text, rows = rows_of(str(law["law"]), law.get("curve"))
        if rows is not None and not isinstance(law.get("curve"), (list, tuple)):  # of a file, which may change, or of a dict
            law.update(law=text, curve=rows.tolist())
        sizes_of_law(law, n, dim, 1)
    return law


def _start(given: Mapping[str, Any]) -> dict[str, Any]:
    rest: dict[str, Any] = {"n": 1024, "dim": 3, **given}
    sizes, cell, walls, container = (rest.pop(key, None) for key in ("diameters", "cell", "walls", "container"))
    rest["box"], vectors = cell_of(rest.get("box"), cell, rest["dim"])
    kind, flat = enclosure_of(container, walls, rest["dim"])
    made = _options("jam_create_options", {**rest, "container": kind, "walls": flat}, ("seed",))  # the packing's own
    made["walls"] = [bool(flat >> c & 1) for c in range(rest["dim"])] if flat else None
    made["cell"] = None if vectors is None else vectors.tolist()
    if made["packing_fraction"] == 0:  # the library's own, spelled out
        made["packing_fraction"] = round(System.random(1, made["dim"]).packing_fraction, 12)
    if made["overlap"] == "shrink":
        raise ProtocolError("overlap is 'refuse' (hard spheres) or 'allow' (soft ones)")
    if made["n"] < 1:
        raise ProtocolError(f"n = {made['n']} must be >= 1")
    diameters = None if sizes is None else _diameters(sizes, made["n"], made["dim"])
    return {**made, "diameters": diameters}


def _check_room(start: Mapping[str, Any]) -> System | None:
    """A density that no seed reaches is one of the protocol. Returns the first start."""
    for seed in (1, 2, 3) if start["n"] <= _MOST_TRIED else ():
        with suppress(errors.JamError) if seed < 3 else _entry("start: no packing of seeds 1, 2, 3 can begin"):
            return begin({"start": start}, seed)
    return None


def _check_analysis(analysis: Mapping[str, Any], system: System) -> None:
    """Options that the library refuses, asked of a start in calls that stop at once. What a start lacks, such as forces or the
    runs of an earlier analysis, is none of the protocol."""
    with suppress(errors.JamError):  # a network, without which options are not looked at
        system.contacts_from_geometry()
    for name, given in analysis.items():
        if given and not any(name.startswith(f"{other}_") for other in analysis):
            call = getattr(system, name)
            stop = {"progress": lambda _: True} if "progress" in inspect.signature(call).parameters else {}
            with _entry(f"analysis[{name!r}]"):
                try:
                    call(**given, **stop)
                except errors.JamError as error:
                    if isinstance(error, errors.ArgumentError):
                        raise


def _stage(given: Mapping[str, Any] | Sequence[float]) -> dict[str, Any]:
    """A stage: options with its verb, or as in System.compress a pair (growth_rate, pressure)."""
    rest: dict[str, Any] = dict(stage_of(given))
    verb = rest.pop("verb", "compress")
    verbs = [v for v in changing(System) if v != "crunch" and f"jam_{v}_options" in OPTIONS]
    if verb not in verbs:
        raise ProtocolError(f"no stage is called {verb!r}; there are {', '.join(verbs)}")
    own = {k: rest.pop(k, None) for k in (_OF_SHEAR if verb == "shear" else ())}
    own.update({k: np.asarray(v, float).tolist() for k, v in own.items() if v is not None})
    return {"verb": verb, **own, **_options(f"jam_{verb}_options", rest, ("resume",))}


def _analysis(name: str, given: Mapping[str, Any]) -> dict[str, Any]:
    if name not in (known := [*measuring(System), "crystal_score"]):
        raise ProtocolError(f"no method of System that measures a packing has this name; {unknown(name, known)}")
    takes = [p for p in list(inspect.signature(getattr(System, name)).parameters.values())[1:] if p.name != "progress"]
    try:
        call = inspect.Signature(takes).bind(**given)
    except TypeError as error:
        raise ProtocolError(f"{error}; there are {', '.join(p.name for p in takes)}") from None
    call.apply_defaults()
    options = call.arguments.pop("options", {})
    return {**call.arguments, **options}


def _check_calls(made: Mapping[str, Any]) -> None:
    """Calls that the scene or model refuses, such as a free cell between walls: asked of two small spheres that have no time."""
    start = made["start"]
    with _entry("start"):
        two = begin({"start": {**start, "n": 2, "packing_fraction": 1e-12, "diameters": None}}, 1)
    calls = [(f"stages[{k}]", stage) for k, stage in enumerate(made["stages"])]
    if made["crunch"] is not None:
        calls.append(("crunch", {"verb": "crunch", **made["crunch"]}))
    soft = overlapping = start["overlap"] == "allow"  # else only soft Monte Carlo makes overlaps
    for where, call in calls:
        options = dict(call, wall_time=1e-9)
        verb = options.pop("verb")
        soft_moves = verb == "monte_carlo" and options["alpha"] > 0
        with _entry(where), suppress(errors.TooFewError, errors.StateError):  # of two spheres, not of the protocol
            if verb in ("relax", "decompress") and not soft:
                raise ProtocolError(f"{verb} needs overlaps: start with overlap='allow', or by Monte Carlo with alpha")
            if overlapping and not soft_moves and verb not in _OF_SOFT:
                raise ProtocolError(f"{verb} is for hard spheres, and these overlap: put decompress before it, or crunch=None")
            if verb == "shear" and options["to"] is None:
                raise ProtocolError("shear needs to, its last strain")
            getattr(two, verb)(**options)
        soft = soft or soft_moves
        overlapping = soft_moves or (soft and verb == "shear")


def complete(protocol: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """A protocol with every default spelled out: plain numbers, text, lists and dicts, as in JSON; infinity is the text "inf".

    Parameters
    ----------
    protocol : mapping
        Any of `start`, `stages`, `crunch`, `analysis`. Entries of `start` may also be given at the top level: ``dict(n=128, dim=3)``.

    Raises
    ------
    ProtocolError
        Names the entry that is wrong and what is allowed there.
    """
    given = copy.deepcopy(_dict(protocol, "the protocol"))
    start, crunch = _dict(given.get("start"), "start"), given.get("crunch", {})
    stages, analysis = given.get("stages", GROWTH_STAGES), _dict(given.get("analysis", ANALYSIS), "analysis")
    if isinstance(stages, (str, Mapping)) or not isinstance(stages, Iterable):
        raise ProtocolError(f"stages must be a list, not {stages!r}")
    made: dict[str, Any] = {"start": None, "stages": [], "crunch": None, "analysis": {}}
    for key in [k for k in given if k not in made]:
        if key in start:
            raise ProtocolError(f"{key} is given twice, at the top and in start")
        start[key] = given[key]
    with _entry("start"):
        made["start"] = _start(start)
    for k, stage in enumerate(stages):
        with _entry(f"stages[{k}]"):
            made["stages"].append(_stage(stage))
    if crunch is not None:
        with _entry("crunch"):
            made["crunch"] = _options("jam_crunch_options", _dict(crunch, "it"))
    for name, options in analysis.items():
        with _entry(f"analysis[{name!r}]"):
            made["analysis"][name] = _analysis(name, _dict(options, "it"))
    _check_calls(made)
    if (begun := _check_room(made["start"])) is not None:
        _check_analysis(made["analysis"], begun)
    with _entry("the protocol cannot be written as JSON"):
        return json.loads(to_json(made))


def to_json(protocol: Mapping[str, Any]) -> str:
    """The protocol as JSON, keys in the order of complete()."""
    return json.dumps(protocol, indent=2, allow_nan=False)


def _changed(given: Mapping[str, Any], default: Mapping[str, Any]) -> dict[str, Any]:
    return {k: v for k, v in given.items() if k not in default or default[k] != v}


def minimal(protocol: Mapping[str, Any]) -> dict[str, Any]:
    """What a complete protocol sets otherwise than the library does by itself."""
    crunch, stages = protocol["crunch"], protocol["stages"]
    return {
        "start": _changed(protocol["start"], _start({})),
        "stages": [{"verb": s["verb"], **_changed(s, _stage({"verb": s["verb"]}))} for s in stages],
        "crunch": None if crunch is None else _changed(crunch, _options("jam_crunch_options", {})),
        "analysis": {k: _changed(v, dict.fromkeys(v)) for k, v in protocol["analysis"].items()},
    }


def identity(protocol: Mapping[str, Any]) -> str:
    """12 hex digits that name a complete protocol: of its minimal form, so that an option which a later libjam adds
    renames nothing. What the defaults are belongs to the algorithm, which stands beside it in the name of a packing."""
    return hashlib.sha256(json.dumps(minimal(protocol), sort_keys=True).encode()).hexdigest()[:12]


def whole_seed(seed: Any) -> int:
    """A seed as an int; 1.5 and 2**63 are none."""
    whole = int(seed)
    if whole != seed or not 0 <= whole < 1 << 63:
        raise ProtocolError(f"a seed must be a whole number from 0 to 2**63 - 1, not {seed!r}")
    return whole


def packing_name(protocol_id: str, seed: int, algorithm: str = ALGORITHM) -> str:
    """32 hex digits that name one packing: of the protocol, the seed and the algorithm."""
    text = f"{protocol_id} {whole_seed(seed)} {algorithm}"
    return hashlib.sha256(text.encode()).hexdigest()[:32]


# ---- one packing
def sizes_of_law(law: Any, n: int, dim: int, seed: int) -> Any:
    """Ratios of the diameters, or None."""
    if not isinstance(law, dict):
        return law
    if law["law"] == "bidisperse":
        if not all(isinstance(law[k], float) for k in ("ratio", "share")) or not (law["ratio"] > 0 and 0 < law["share"] < 1):
            raise ValueError("bidisperse takes a ratio > 0 and a share in (0, 1)")
        return np.where(np.arange(n) < round(law["share"] * n), 1.0, law["ratio"])
    fields: dict[str, Any] = {"draw": "random", "seed": seed, **{k: v for k, v in law.items() if k != "law"}}
    return draw_sizes(str(law["law"]), n, dim=dim, **fields)


def begin(protocol: Mapping[str, Any], seed: int) -> System:
    """The start of a complete protocol."""
    given = dict(protocol["start"])
    if given.get("cell") is not None:
        del given["box"]
    sizes = sizes_of_law(given.pop("diameters"), given["n"], given["dim"], seed)
    return System.random(seed=seed, diameters=sizes, **given)


def make(protocol: Mapping[str, Any], seed: int) -> tuple[System, dict[str, Any]]:
    """Makes one packing, also when it is not jammed, as its report says; and results of the analysis by name.

    A call that fails, such as one that needs a jammed network, gives its error's text. Errors of the machine are raised.
    """
    system = begin(protocol, seed)
    for stage in protocol["stages"]:
        given = dict(stage)
        report = getattr(system, given.pop("verb"))(**given)
        if getattr(report, "status", StatusCode.OK) in (StatusCode.CANCELLED, StatusCode.LIMIT):
            break  # as System.compress: a stage that stopped early ends the sequence
    if protocol["crunch"] is not None:
        system.crunch(**protocol["crunch"])
    results = {}
    for name, given in protocol["analysis"].items():
        try:
            results[name] = getattr(system, name)(**given)
        except (ImportError, MemoryError, OSError, errors.BusyError):  # the next run tries again
            raise
        except Exception as error:
            results[name] = f"not available: {error}"
    return system, results
