"""python3 -m jam: what jam-pack does, with the same options, and pictures."""
from __future__ import annotations

import argparse
import json
import math
import os
import sys
import time
from typing import Any, Callable

from . import files, raw
from ._api.generated import LogLevel, Phase, StopReason, Verdict
from ._formats.replacing import replacing
from ._options import ABOUT, EXAMPLE, NOTES, OPTIONS, STAGES
from ._start import density, start, take_cell, take_sizes
from ._system.progress import every_ten_seconds
from .errors import JamError, UnplaceableError
from .system import System

DONE, EARLY, USAGE, FAILED, OUTPUT = range(5)  # exit status, as jam-pack
CANCELLED, LIMIT, NOT_CONVERGED, PRECISION = 1, 2, 3, 4
PACKINGS = (".xyz", ".extxyz", ".data", ".lmp", ".vtp", ".gsd", ".dat", ".txt")


def _positive(text: str) -> float:
    value = float(text)
    if not (0 < value < math.inf):
        raise argparse.ArgumentTypeError(f"{text!r} must be a finite number > 0")
    return value


def _pressure(text: str) -> float:
    if not _positive(text) > 1:
        raise argparse.ArgumentTypeError(f"{text!r} must be larger than 1, an ideal gas")
    return float(text)


def _not_negative(text: str) -> float:
    return 0.0 if float(text) == 0 else _positive(text)


def _delta(text: str) -> float:
    if not -1 < float(text) <= 1:
        raise argparse.ArgumentTypeError(f"{text!r} must be a number above -1 and at most 1")
    return float(text)


def _integer(low: int, high: int) -> Callable[[str], int]:
    def take(text: str) -> int:
        if not low <= int(text) <= high:
            raise argparse.ArgumentTypeError(f"{text!r} must be an integer in {low}..{high}")
        return int(text)

    return take


def _fraction(text: str) -> float:
    if not 0 < float(text) < 1:
        raise argparse.ArgumentTypeError(f"{text!r} must be above 0 and below 1")
    return float(text)


def _stage(text: str) -> tuple[float, float | None]:
    rate, colon, pressure = text.partition(":")
    return _positive(rate), _pressure(pressure) if colon else None


_KINDS: dict[str, Callable[[str], Any]] = {
    "positive": _positive,
    "not_negative": _not_negative,
    "pressure": _pressure,
    "delta": _delta,
    "stage": _stage,
    "fraction": _fraction,
    "sizes": take_sizes,
    "cell": take_cell,
}


def _file(text: str) -> str:
    if not text:
        raise argparse.ArgumentTypeError("'' must be the name of a file")
    return text


def parser(named_only: bool = False) -> argparse.ArgumentParser:
    """By the table of options, which jam-pack's parser is made from too. named_only: without defaults."""
    p = argparse.ArgumentParser(
        prog="python3 -m jam",
        description=ABOUT,
        epilog=f"Example: python3 -m jam {EXAMPLE}. {NOTES}",
        allow_abbrev=False,
    )
    for name, kind, metavar, default, (low, high), words, *_, text in OPTIONS:
        more: dict[str, Any] = {"help": text.replace("%", "%%"), "default": default}
        if kind == "switch":
            more.update(action="store_true", default=False)
        elif kind == "choice":
            more["choices"] = words
        else:
            more["metavar"] = metavar
            more["type"] = _integer(low, high) if kind == "integer" else _KINDS.get(kind, _file)
        if kind == "stage":
            more["action"] = "append"
        if named_only:
            more["default"] = argparse.SUPPRESS
        p.add_argument("--" + name, **more)
    p.add_argument("--version", action="version", version=f"jam {raw.jam_version()}")
    return p


def _effects(p: argparse.ArgumentParser, o: argparse.Namespace, arguments: list[str] | None) -> set[str]:
    """Nothing is ignored in silence: an option that can have no effect beside the others is refused. Returns the options that
    the command line names."""
    named = {name.replace("_", "-") for name in vars(parser(True).parse_args(arguments))}
    for name, _, _, _, _, _, _, without, needs, _ in OPTIONS:
        if name not in named:
            continue
        for other in without:
            if other in named:
                p.error(f"--{name} has no effect beside --{other}")
        if needs and not named & set(needs):
            p.error(f"--{name} has no effect without --{needs[0]}")
    if o.model == "euclid" and "model" in named and (o.zeta is not None or o.plant is not None):
        p.error(f"--model euclid contradicts {'--plant' if o.zeta is None else '--zeta'}")
    if o.cell and len(o.cell) not in (o.dim, o.dim * o.dim):
        p.error(
            f"--cell has {len(o.cell)} numbers, in d = {o.dim} it needs {o.dim} sides or {o.dim * o.dim} components of vectors"
        )
    aim = density(o)
    if aim is not None and o.phi0 is not None and o.phi0 > aim:
        p.error(f"--phi0 {o.phi0:g} lies above the packing fraction {aim:g} to grow to")
    still = o.no_md or (o.input and not o.growth and aim is None)
    if o.checkpoint and o.no_crunch and still and not (o.resume or o.nve or o.growth):
        p.error("--checkpoint has no effect: neither dynamics nor a crunch run")
    if "pressure" in named and (still or (o.growth and all(pressure for _, pressure in o.growth))):
        p.error("--pressure has no effect: no stage of growth runs up to it")
    return named


def _same(a: str | None, b: str | None) -> bool:
    """One file under two names, but for pipes and devices, which take what comes."""
    if a is None or b is None or (os.path.exists(a) and not os.path.isfile(a)):
        return False
    return os.path.realpath(a) == os.path.realpath(b)


class _Log:
    """--log: what the library says, a line each; written in place, so that it can be read while the program runs."""

    def __init__(self, path: str | None) -> None:
        self.begin = time.monotonic()
        self.file = None if path is None else sys.stdout if path == "-" else open(path, "w", encoding="utf-8")

    def line(self, level: int, text: str) -> None:
        assert self.file is not None
        word = "warning" if level == LogLevel.WARNING else "info"
        print(f"{time.monotonic() - self.begin:10.3f} {word} {text}", file=self.file, flush=True)

    def follow(self, system: System) -> None:
        if self.file is not None:
            system.log(self.line)

    def close(self, system: System) -> None:
        if self.file is not None:
            system.log(None)
            if self.file is not sys.stdout:
                self.file.close()


class _Work:
    """The stages of one run, within its time; out collects what the report says."""

    def __init__(self, system: System, o: argparse.Namespace, out: dict[str, Any]) -> None:
        self.system, self.o, self.out = system, o, out
        self.progress = None if o.quiet else True if sys.stderr.isatty() else every_ten_seconds()
        self.deadline = time.monotonic() + (math.inf if o.wall_time is None else o.wall_time)

    def left(self) -> float:
        found: float = max(1e-3, self.deadline - time.monotonic())
        return found

    def stage(self, verb: str, **options: Any) -> int:
        """With --checkpoint in slices: they cost nothing, and a killed job goes on from the last one."""
        o, out = self.o, self.out
        while True:
            try:
                md = getattr(self.system, verb)(
                    progress=self.progress,
                    wall_time=min(o.checkpoint_every if o.checkpoint else math.inf, self.left()),
                    **options,
                )
            finally:
                if o.checkpoint:
                    self.system.write_checkpoint(o.checkpoint)
            out["collisions"] += md.collisions
            out["seconds_md"] += md.seconds
            out["pressure"] = md.pressure
            out["md_stop_reason"] = out["stop_reason"] = md.stop_reason.name.lower()
            if md.status != LIMIT or md.stop_reason != StopReason.WALL_TIME or self.left() <= 1e-3:
                return int(md.status)
            options["resume"] = 1

    def stages(self) -> list[tuple[str, dict[str, float]]]:
        o, aim = self.o, density(self.o)
        steps: list[tuple[str, dict[str, Any]]] = (
            [("run", {"collisions_per_particle": o.nve})] if o.nve > 0 and not o.resume else []
        )
        if not o.no_md and (o.growth or not o.input):
            # By default those stages that --pressure lies beyond, and the one that leads there.
            before = (1.0, *(p for _, p in STAGES[:-1]))
            ends = (*(p for _, p in STAGES[:-1]), math.inf)
            own = zip((g for g, _ in STAGES), before, ends)
            chosen = o.growth or [(g, min(end, o.pressure)) for g, begin, end in own if o.pressure > begin]
            steps += [("compress", {"growth_rate": g, "pressure": p or o.pressure}) for g, p in chosen]
        if aim is not None:  # without --growth the protocol of the library
            growths = [s for s in steps if s[0] == "compress"] if o.growth else [("compress", {"pressure": o.pressure})]
            steps = [s for s in steps if s[0] == "run"] + [(v, {**g, "packing_fraction": aim}) for v, g in growths]
        if o.resume:  # what the checkpoint was in the middle of; then the stages that lead beyond its pressure, or none
            if self.system.info.paused == Phase.CRUNCH:
                return []
            paused = {Phase.RUN: "run", Phase.COMPRESS: "compress"}.get(self.system.info.paused)
            more = {"collisions_per_particle": o.nve} if paused == "run" and o.nve > 0 else {}
            if paused:
                steps.insert(0, (paused, {"resume": 1, **more}))
        return steps

    def run(self) -> int:
        o, out, status = self.o, self.out, 0
        reached, aim = self.system.pressure, density(o)
        if aim is not None and self.system.packing_fraction > aim * (1 + 1e-12):
            said = f"the packing fraction is {self.system.packing_fraction:.6g}, above the {aim:.6g} to grow to"
            print(f"python3 -m jam: warning: {said}: nothing was done", file=sys.stderr)
            out["fell_short"] = True
            return 0
        for verb, options in self.stages():
            if aim is not None and out["md_stop_reason"] == "packing_fraction":
                break
            if o.resume and options.get("pressure", math.inf) <= reached:
                continue
            if not options.get("resume"):
                stage = {"run": "nve", "compress": "growth"}[verb]
                shown = {k: float(x) for k, x in options.items()}
                if aim is not None and verb == "compress":
                    shown.pop("packing_fraction" if "growth_rate" in shown else "pressure")
                out["protocol"].append({"stage": stage} | shown)
            status = self.stage(verb, **options)
            reached = self.system.pressure
            if not options.get("resume") and verb == "compress":
                out["protocol"][-1]["stop_reason"] = out["md_stop_reason"]
            if status in (NOT_CONVERGED, PRECISION):  # no reason to stop, but never unseen
                if status == NOT_CONVERGED:
                    out["fell_short"] = True
                name = f"growth {options['growth_rate']:g}" if "growth_rate" in options else verb
                why = f"{out['md_stop_reason']}: {raw.jam_last_error()}"
                print(f"python3 -m jam: warning: {name} ended at p = {reached:.4g}: {why}", file=sys.stderr)
            if status in (CANCELLED, LIMIT):
                return status
        if aim is not None and out["md_stop_reason"] != "packing_fraction":
            out["fell_short"] = True
            said = f"growth ended at p = {reached:.4g}, before the packing fraction {aim:.6g}"
            print(f"python3 -m jam: warning: {said}", file=sys.stderr)
        if not o.no_crunch:
            method = {"barrier": "barrier_path"}.get(o.method, o.method.replace("-", "_"))
            r = self.system.crunch(
                progress=self.progress,
                wall_time=self.left(),
                method=method,
                strain=o.strain,
                lp_solver=o.lp,
                threads=o.threads,
                duality_gap=o.duality_gap,
                prove=o.prove,
                keep_steps=o.page_steps if o.page else 0,
                checkpoint=o.checkpoint,
                checkpoint_every=o.checkpoint_every,
            )
            out["protocol"].append({"stage": "crunch", "method": method, "strain": o.strain})
            if o.prove:
                numbers = int(r.theorem), int(r.proof_cause), r.proof_radius, r.proof_value, r.proof_bound
                out["proof"] = raw.jam_proof_text(*numbers) if r.jammed else "not tried: not jammed"
            status, out["crunch"], out["stop_reason"] = int(r.status), r, r.stop_reason.name.lower()
        return status


def _report(system: System, out: dict[str, Any]) -> dict[str, Any]:
    i, r = system.info, out["crunch"]
    made = {
        "n": i.n,
        "dim": i.dim,
        "seed": i.seed,
        "options": out["options"],
        "protocol": out["protocol"],
        "method": r.method.name.lower() if r else None,
        "lp_solver": r.lp_solver.name.lower() if r else None,
        "notes": system.notes.splitlines(),
        "packing_fraction": i.packing_fraction,
        "diameter_mean": i.diameter_mean,
        "pressure": out["pressure"],
        "collisions": out["collisions"],
        "collisions_per_second": out["collisions"] / out["seconds_md"] if out["seconds_md"] else None,
    }
    for key in (
        "lp_solves",
        "factorisations",
        "contacts",
        "rattlers",
        "bucklers",
        "isostatic_contacts",
        "excess_contacts",
        "undecided_contacts",
        "max_overlap",
        "force_residual",
        "gamma_residual",
        "min_force",
        "min_gap",
        "duality_gap",
        "gain",
        "packing_fraction_start",
        "displacement_max",
        "displacement_rms",
        "displacement_max_stable",
        "displacement_rms_stable",
    ):
        made[key] = getattr(r, key) if r else None
    for key in ("contacts_start", "contacts_kept"):
        made[key] = getattr(r, key) if r and getattr(r, key) >= 0 else None
    made["jammed"] = bool(r.jammed) if r else None
    made["proof"] = out["proof"]
    made["proof_radius"] = r.proof_radius if r else None
    made |= {
        "stop_reason": out["stop_reason"],
        "md_stop_reason": out["md_stop_reason"],
        "seconds_md": out["seconds_md"],
        "seconds_crunch": r.seconds if r else 0.0,
        "version": raw.jam_version(),
        "commit": raw.jam_commit(),
        "blas_kernel": raw.jam_blas_kernel(),
    }
    return {k: None if isinstance(v, float) and not math.isfinite(v) else v for k, v in made.items()}


def _write(system: System, o: argparse.Namespace, out: dict[str, Any]) -> None:
    crunched = out["crunch"] is not None
    if o.output:
        system.write(o.output)
    if o.contacts and crunched:
        ending = os.path.splitext(o.contacts.removesuffix(".gz"))[1]
        system.write_contacts("/dev/stdout" if o.contacts == "-" else o.contacts, "auto" if ending else "csv")
    if o.proof and crunched:
        system.write_proof(o.proof)
    if o.page:
        system.page(o.page)
    if o.gaps and crunched:
        files.write_gaps_csv(system, o.gaps)
    if o.structure and crunched:
        files.write_structure_csv(system, o.structure)
    if o.spectrum and crunched:
        k = 100 if o.modes is None else o.modes
        files.write_spectrum_csv(system.modes(k) if k else system.modes(which="all"), o.spectrum)
    if o.vtk:
        files.write_vtk(system, o.vtk + ".vtp")
        if crunched:
            files.write_vtk_network(system, o.vtk + "-forces.vtp")
    if o.report:
        text = json.dumps(_report(system, out), indent=2) + "\n"
        if o.report in ("-", "/dev/stdout"):
            sys.stdout.write(text)
        else:
            with replacing(o.report, "w") as file:
                file.write(text)
    if o.plot:
        from . import plot

        (plot.summary(system) if crunched and out["crunch"].contacts else plot.packing(system).figure).savefig(
            o.plot, dpi=150
        )
    if not o.quiet and o.report != "-":
        for line in system.notes.splitlines():
            print(f"start: {line}")
        print(out["crunch"] if crunched else system.info)


def _outputs(p: argparse.ArgumentParser, o: argparse.Namespace) -> list[str]:
    """The files that will be written: each its own, none over the input, none without the crunch that it shows."""
    outputs = {name: after for name, kind, _, _, _, _, after, *_ in OPTIONS if kind == "output"} | {"vtk": False}
    chosen = {k: getattr(o, k) for k in outputs}
    chosen = {k: path for k, path in chosen.items() if path and path != "-"}
    for key, path in chosen.items():
        for other in chosen:
            if other != key and _same(chosen[other], path):
                p.error(f"--{key} and --{other} must be different files")
        sizes = o.sizes[1] if o.sizes and o.sizes[0] == "file" else None
        if (
            (key != "output" and _same(o.input, path))
            or (key != "checkpoint" and _same(o.resume, path))
            or _same(sizes, path)
        ):
            p.error(f"--{key} would overwrite the input")
        if o.no_crunch and outputs[key]:
            why = "no-crunch" if density(o) is None else "packing-fraction" if o.porosity is None else "porosity"
            p.error(f"--{key} needs the crunch that --{why} leaves out")
    name = (o.output or "").removesuffix(".gz")
    ending = os.path.splitext(name)[1]
    if ending not in (*PACKINGS, "") and not ending[1:].isdigit():
        p.error(f"--output {o.output}: no format is known by this ending; use {', '.join(PACKINGS)} or none")
    if o.strain != "none" and o.output and (ending in (".dat", ".txt", "") or ending[1:].isdigit()):
        p.error("--strain needs an --output in another format: plain text holds cubes alone")
    if o.non_additivity and o.output and not o.output.endswith((".xyz", ".extxyz")):
        p.error("--non-additivity needs an --output that ends in .xyz or .extxyz: plain text cannot hold it")
    if o.resume and o.input:
        p.error("--resume and --input both give a start: leave one out")
    return list(chosen.values())


def _warn(system: System) -> None:
    for line in system.notes.splitlines():
        if line.startswith("warning: "):
            print(f"jam: {line}", file=sys.stderr)


def _check(words: list[str]) -> int:
    """check FILE: the verdict on a packing as it is. Exit status 0 jammed, 1 not, 3 undecided, 2 refused."""
    p = argparse.ArgumentParser(prog="python3 -m jam check", description=_check.__doc__, allow_abbrev=False)
    p.add_argument("file")
    p.add_argument("--box", type=_positive, default=1.0)
    p.add_argument("--frame", type=int, default=-1)
    p.add_argument("--non-additivity", type=_delta, default=0.0)
    p.add_argument("--prove", action="store_true")
    p.add_argument("--proof", type=_file, default=None)
    p.add_argument("--wall-time", type=_positive, default=None)
    p.add_argument("--quiet", action="store_true")
    o = p.parse_args(words)
    try:
        system = System.read(o.file, box=o.box, frame=o.frame, non_additivity=o.non_additivity, overlap="allow")
        _warn(system)
        report = system.check(wall_time=o.wall_time, prove=o.prove or o.proof is not None)
        if o.proof and report.jammed == Verdict.YES:
            system.contacts_from_geometry()
            system.write_proof(o.proof)
        elif o.proof:
            print(f"jam: {o.proof} is not written: the packing is not jammed", file=sys.stderr)
    except (JamError, ValueError, OSError) as e:
        print(f"jam: {e}", file=sys.stderr)
        return USAGE
    if not o.quiet:
        print(report)
    return {Verdict.YES: 0, Verdict.NO: 1}.get(report.jammed, 3)


def main(arguments: list[str] | None = None) -> int:
    words = sys.argv[1:] if arguments is None else arguments
    if words[:1] == ["check"]:
        return _check(words[1:])
    p = parser()
    o = p.parse_args(arguments)
    if o.no_md and (o.growth or o.nve):
        p.error("--no-md contradicts --growth and --nve")
    o.no_crunch = o.no_crunch or density(o) is not None
    outputs = _outputs(p, o)
    named = _effects(p, o, arguments)
    for path in outputs:
        folder = os.path.dirname(path) or "."
        if not os.access(folder, os.W_OK):
            print(f"jam: {path}: the folder cannot be written", file=sys.stderr)
            return OUTPUT
    out: dict[str, Any] = {
        # names of files may hold bytes that are not UTF-8, and JSON must not
        "options": [w.encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace") for w in words],
        "protocol": [],
        "collisions": 0,
        "seconds_md": 0.0,
        "pressure": None,
        "crunch": None,
        "proof": None,
        "stop_reason": "none",
        "md_stop_reason": "none",
    }
    code = DONE
    try:
        system = start(o, named)
    except (JamError, ValueError, OSError) as error:
        print(f"jam: {error}", file=sys.stderr)
        return FAILED
    _warn(system)
    log = _Log(o.log)
    try:
        log.follow(system)
        code = EARLY if _Work(system, o, out).run() > 0 or "fell_short" in out else DONE
    except KeyboardInterrupt:
        print("jam: interrupted; writing the state reached", file=sys.stderr)
        code = EARLY
    except JamError as error:
        print(f"jam: {error}", file=sys.stderr)
        if isinstance(error, UnplaceableError):  # the density lies beyond reach: nothing was done that is worth a file
            return FAILED
        code = FAILED
    try:
        log.close(system)
        _write(system, o, out)
    except (JamError, OSError, ValueError) as error:
        print(f"jam: {error}", file=sys.stderr)
        return OUTPUT
    return code
