"""python3 -m jam: what jam-pack does, with the same options, and pictures."""
from __future__ import annotations

import argparse
import json
import math
import os
import sys
import time
from typing import Any

from . import files, raw
from ._generated import Phase, StopReason
from ._start import start, take_diameters
from .errors import JamError
from .system import System

DONE, EARLY, USAGE, FAILED, OUTPUT = range(5)  # exit status, as jam-pack
CANCELLED, LIMIT = 1, 2
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


def _whole(text: str) -> int:
    if int(text) < 0:
        raise argparse.ArgumentTypeError(f"{text!r} must be an integer >= 0")
    return int(text)


def _stage(text: str) -> tuple[float, float | None]:
    rate, colon, pressure = text.partition(":")
    return _positive(rate), _pressure(pressure) if colon else None


def parser() -> argparse.ArgumentParser:
    p = argparse.ArgumentParser(
        prog="python3 -m jam",
        description="Makes a jammed packing of hard spheres: random start, "
        "event-driven molecular dynamics with growth, then iterated linear programming.",
        epilog="Example: python3 -m jam --n 512 --dim 2 --diameters-ratio 1.4 --output p.xyz --plot p.png. "
        "Exit status: 0 done; 1 stopped early or not jammed, the state reached is written; 2 wrong command "
        "line; 3 request or input refused; 4 an output cannot be written.",
    )
    p.add_argument("--n", type=int, help="spheres (1024)")
    p.add_argument("--dim", type=int, default=3, help="dimension, 2..8 (3)")
    p.add_argument(
        "--phi0", type=_positive, help="packing fraction of the random start (0.2; halved per dimension above 3)"
    )
    p.add_argument(
        "--diameters-ratio",
        type=_positive,
        default=1.0,
        metavar="R",
        help="half of the spheres are R times as large (1)",
    )
    p.add_argument(
        "--diameters",
        type=take_diameters,
        metavar="WHAT",
        help="bidisperse:R as above; lognormal:S with S the standard "
        "deviation over the mean; or a file of diameters, of which the ratios count",
    )
    p.add_argument(
        "--non-additivity",
        type=_delta,
        default=0.0,
        metavar="D",
        help="spheres of unequal diameters touch at (1 + D) times their mean diameter, -1 < D <= 1 (0)",
    )
    p.add_argument(
        "--model", choices=["euclid", "mk"], default="euclid", help="distance: Euclidean (default) or Mari-Kurchan"
    )
    p.add_argument("--zeta", type=_not_negative, metavar="Z", help="strength of the Mari-Kurchan shifts (infinite)")
    p.add_argument(
        "--plant", type=_positive, metavar="F", help="Mari-Kurchan start, planted in equilibrium at packing fraction F"
    )
    p.add_argument("--seed", type=int, default=1)
    p.add_argument(
        "--input", metavar="FILE", help="start from a file; MD is then off unless --growth or --nve is given"
    )
    p.add_argument("--box", type=_positive, default=1.0, help="side of the box for a plain file that names none (1)")
    p.add_argument("--shrink", action="store_true", help="shrink overlapping spheres of the file to contact")
    p.add_argument(
        "--nve", type=_not_negative, default=0.0, metavar="C", help="first C collisions per particle without growth (0)"
    )
    p.add_argument(
        "--growth",
        type=_stage,
        action="append",
        metavar="RATE[:P]",
        help="a stage; repeatable. Default 1e-2:500, then 3e-3",
    )
    p.add_argument("--pressure", type=_pressure, default=1e7, metavar="P", help="target of stages without :P (1e7)")
    p.add_argument("--no-md", action="store_true")
    p.add_argument("--checkpoint", metavar="FILE", help="state of the dynamics, every minute and where they stop")
    p.add_argument(
        "--resume",
        metavar="FILE",
        help="go on from a checkpoint, to the same bits: the stage that was cut off, then those "
        "stages whose pressure lies beyond",
    )
    p.add_argument("--no-crunch", action="store_true")
    p.add_argument("--lp", choices=["ipm", "clp"], default="ipm")
    p.add_argument("--threads", type=int, choices=[1, 2], default=1)
    p.add_argument("--wall-time", type=_positive, metavar="SECONDS", help="limit for the whole run")
    p.add_argument(
        "--output",
        metavar="FILE",
        help="the packing: .xyz or .extxyz for extended XYZ; .dat, .txt or no ending for plain text",
    )
    p.add_argument("--page", metavar="FILE.html", help="the packing to look at in a browser; needs no network")
    p.add_argument("--contacts", metavar="FILE", help="the contact network as .csv, .dump (LAMMPS) or .vtp (ParaView)")
    p.add_argument(
        "--spectrum", metavar="FILE.csv", help="lowest modes of the harmonic Hessian: omega^2, omega, participation"
    )
    p.add_argument("--modes", type=_whole, metavar="K", help="how many --spectrum writes (100); 0: all")
    p.add_argument("--gaps", metavar="FILE.csv", help="gaps h < 1 of pairs that are no contacts, sorted")
    p.add_argument(
        "--structure",
        metavar="FILE.csv",
        help="a line a sphere: contacts, class, sums of contact vectors and forces, Q6, " "local packing fraction",
    )
    p.add_argument("--report", metavar="FILE|-", help="figures and certificate as JSON")
    p.add_argument("--vtk", metavar="PREFIX", help="PREFIX.vtp and PREFIX-forces.vtp for ParaView")
    p.add_argument("--plot", metavar="PICTURE", help="spheres, force network, forces and the way there, by matplotlib")
    p.add_argument("--quiet", action="store_true")
    p.add_argument("--version", action="version", version=f"jam {raw.jam_version()}")
    return p


class _Work:
    """The stages of one run, within its time; out collects what the report says."""

    def __init__(self, system: System, o: argparse.Namespace, out: dict[str, Any]) -> None:
        self.system, self.o, self.out = system, o, out
        self.deadline = time.monotonic() + (math.inf if o.wall_time is None else o.wall_time)

    def left(self) -> float:
        return max(1e-3, self.deadline - time.monotonic())

    def stage(self, verb: str, **options: Any) -> int:
        """With --checkpoint in slices of a minute: they cost nothing, and a killed job goes on from the last one."""
        o, out = self.o, self.out
        while True:
            try:
                md = getattr(self.system, verb)(
                    progress=not o.quiet, wall_time=min(60.0, self.left()) if o.checkpoint else self.left(), **options
                )
            finally:
                if o.checkpoint:
                    self.system.checkpoint_write(o.checkpoint)
            out["collisions"] += md.collisions
            out["seconds_md"] += md.seconds
            out["pressure"] = md.pressure
            out["md_stop_reason"] = out["stop_reason"] = md.stop_reason.name.lower()
            if md.status != LIMIT or md.stop_reason != StopReason.WALL_TIME or self.left() <= 1e-3:
                return int(md.status)
            options["resume"] = 1

    def stages(self) -> list[tuple[str, dict[str, float]]]:
        o = self.o
        steps = [("run", {"collisions_per_particle": o.nve})] if o.nve > 0 and not o.resume else []
        if not o.no_md and (o.growth or not o.input):
            chosen = o.growth or [(1e-2, min(500.0, o.pressure)), (3e-3, None)][: 2 if o.pressure > 500 else 1]
            steps += [("compress", {"growth_rate": g, "pressure": p or o.pressure}) for g, p in chosen]
        if o.resume:  # what the checkpoint was in the middle of; then the stages that lead beyond its pressure
            paused = {Phase.RUN: "run", Phase.COMPRESS: "compress"}.get(self.system.info.paused)
            own = {"collisions_per_particle": o.nve} if paused == "run" and o.nve > 0 else {}
            steps = [(paused, {"resume": 1, **own})] * bool(paused) + steps
        return steps

    def run(self) -> int:
        o, out, status = self.o, self.out, 0
        reached = self.system.pressure
        for verb, options in self.stages():
            if o.resume and options.get("pressure", math.inf) <= reached:
                continue
            status = self.stage(verb, **options)
            reached = self.system.pressure
            if status in (CANCELLED, LIMIT):
                return status
        if not o.no_crunch:
            r = self.system.crunch(progress=not o.quiet, wall_time=self.left(), lp_solver=o.lp, threads=o.threads)
            status, out["crunch"], out["stop_reason"] = int(r.status), r, r.stop_reason.name.lower()
        return status


def _report(system: System, out: dict[str, Any]) -> dict[str, Any]:
    i, r = system.info, out["crunch"]
    made = {
        "n": i.n,
        "dim": i.dim,
        "seed": i.seed,
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
        "max_overlap",
        "force_residual",
        "gamma_residual",
        "min_force",
        "min_gap",
        "duality_gap",
        "gain",
    ):
        made[key] = getattr(r, key) if r else None
    made["jammed"] = bool(r.jammed) if r else None
    made |= {
        "stop_reason": out["stop_reason"],
        "md_stop_reason": out["md_stop_reason"],
        "seconds_md": out["seconds_md"],
        "seconds_crunch": r.seconds if r else 0.0,
        "version": raw.jam_version(),
        "blas_kernel": raw.jam_blas_kernel(),
    }
    return {k: None if isinstance(v, float) and not math.isfinite(v) else v for k, v in made.items()}


def _write(system: System, o: argparse.Namespace, out: dict[str, Any]) -> None:
    crunched = out["crunch"] is not None
    if o.output:
        system.write(o.output)
    if o.contacts and crunched:
        system.write_contacts(*(("/dev/stdout", "csv") if o.contacts == "-" else (o.contacts,)))
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
        if o.report == "-":
            sys.stdout.write(text)
        else:
            with files._replacing(o.report) as file:
                file.write(text)
    if o.plot:
        from . import plot

        (plot.summary(system) if crunched and out["crunch"].contacts else plot.packing(system).figure).savefig(
            o.plot, dpi=150
        )
    if not o.quiet and o.report != "-":
        print(out["crunch"] if crunched else system.info)


def _outputs(p: argparse.ArgumentParser, o: argparse.Namespace) -> list[str]:
    """The files that will be written: each its own, none over the input, none without the crunch that it shows."""
    chosen = {
        k: getattr(o, k)
        for k in ("output", "contacts", "report", "spectrum", "gaps", "structure", "plot", "vtk", "page", "checkpoint")
    }
    chosen = {k: path for k, path in chosen.items() if path and path != "-"}
    for key, path in chosen.items():
        for other in chosen:
            if other != key and chosen[other] == path:
                p.error(f"--{key} and --{other} must be different files")
        if key not in ("output", "checkpoint") and path == o.input:
            p.error(f"--{key} would overwrite the input")
        if o.no_crunch and key in ("contacts", "spectrum", "gaps", "structure"):
            p.error(f"--{key} needs the crunch that --no-crunch leaves out")
    name = (o.output or "").removesuffix(".gz")
    ending = os.path.splitext(name)[1]
    if ending not in (*PACKINGS, "") and not ending[1:].isdigit():
        p.error(f"--output {o.output}: no format is known by this ending; use {', '.join(PACKINGS)} or none")
    if o.non_additivity and o.output and not o.output.endswith((".xyz", ".extxyz")):
        p.error("--non-additivity needs an --output that ends in .xyz or .extxyz: plain text cannot hold it")
    if o.resume and o.input:
        p.error("--resume and --input are two starts")
    if o.modes is not None and not o.spectrum:
        p.error("--modes says how many modes --spectrum writes, which is missing")
    return list(chosen.values())


def main(arguments: list[str] | None = None) -> int:
    p = parser()
    o = p.parse_args(arguments)
    if o.no_md and (o.growth or o.nve):
        p.error("--no-md contradicts --growth and --nve")
    outputs = _outputs(p, o)
    for path in outputs:
        folder = os.path.dirname(path) or "."
        if not os.access(folder, os.W_OK):
            print(f"jam: {path}: the folder cannot be written", file=sys.stderr)
            return OUTPUT
    out: dict[str, Any] = {
        "collisions": 0,
        "seconds_md": 0.0,
        "pressure": None,
        "crunch": None,
        "stop_reason": "none",
        "md_stop_reason": "none",
    }
    code = DONE
    try:
        system = start(o)
    except (JamError, ValueError, OSError) as error:
        print(f"jam: {error}", file=sys.stderr)
        return FAILED
    try:
        code = EARLY if _Work(system, o, out).run() > 0 else DONE
    except KeyboardInterrupt:
        print("jam: interrupted; writing the state reached", file=sys.stderr)
        code = EARLY
    except JamError as error:
        print(f"jam: {error}", file=sys.stderr)
        code = FAILED
    try:
        _write(system, o, out)
    except (JamError, OSError, ValueError) as error:
        print(f"jam: {error}", file=sys.stderr)
        return OUTPUT
    return code
