"""python3 -m jam ensemble run|status|export DIR: ensembles from the command line and from batch jobs."""
from __future__ import annotations

import argparse
import json
import os
import re
import sys
from concurrent.futures import BrokenExecutor
from contextlib import ExitStack
from typing import Any, NoReturn

from ..errors import StoreError
from .ensemble import Ensemble
from .protocol import ProtocolError
from .status import Status

DONE, PARTIAL, USAGE, REFUSED, OUTPUT = range(5)  # exit status, as python3 -m jam


class _Once(argparse.Action):
    """An option that stands once: a second value would replace the first one in silence."""

    def __call__(self, p: argparse.ArgumentParser, o: argparse.Namespace, value: Any, name: str | None = None) -> None:
        given = vars(o).setdefault("_given", set())
        if name and self.dest in given:
            p.error(f"{name} is given twice: leave one out")
        given.add(self.dest)
        vars(o)[self.dest] = self.const if self.nargs == 0 else value


class _Parser(argparse.ArgumentParser):
    """Takes options by their whole names, each once, and answers in JSON where that was asked for."""

    arguments: list[str] = []

    def __init__(self, **more: Any) -> None:
        super().__init__(allow_abbrev=False, **more)

    def flag(self, name: str, **more: Any) -> None:
        self.add_argument(name, action=_Once, nargs=0, const=True, default=False, **more)

    def option(self, *names: str, **more: Any) -> None:
        self.add_argument(*names, action=_Once, **more)

    def error(self, message: str) -> NoReturn:
        if "--json" in _Parser.arguments:
            print(_json(USAGE, message))
        super().error(message)


def _json(code: int, text: str, **more: Any) -> str:
    """As of the other verbs: exit status, what was said, and what there is."""
    return json.dumps({"status": code, "text": text, **more})


def _seeds(text: str) -> list[int]:
    """1-100, 7, or several with commas: 1-100,205."""
    found: list[int] = []
    for part in text.split(","):
        first, dash, last = part.partition("-")
        try:
            found += range(int(first), int(last if dash else first) + 1)
        except ValueError:
            raise argparse.ArgumentTypeError(f"{text!r} must be seeds like 1-100 or 1-100,205") from None
    if not found:
        raise argparse.ArgumentTypeError(f"{text!r} names no seed")
    return found


def _part(text: str) -> tuple[int, int]:
    k, slash, m = text.partition("/")
    try:
        part = int(k), int(m)
    except ValueError:
        part = (-1, 0)
    if not slash or not 0 <= part[0] < part[1]:
        raise argparse.ArgumentTypeError(f"{text!r} must be K/M with K in 0..M-1, e.g. $SLURM_ARRAY_TASK_ID/10")
    return part


def parser() -> argparse.ArgumentParser:
    p = _Parser(
        prog="python3 -m jam ensemble",
        description="Makes many packings of one protocol, one file each. What is there is not made again.",
        epilog="Example: python3 -m jam ensemble run packings --n 128 --seeds 1-100. Exit status: 0 all are there; "
        "1 some failed or are missing; 2 wrong command line; 3 protocol or folder refused; 4 the folder cannot be written.",
    )
    verbs = p.add_subparsers(dest="verb", required=True)
    for verb, text in (
        ("run", "make the packings that are not there"),
        ("status", "count packings and failures"),
        ("export", "pack the packings into HDF5 files of many"),
    ):
        v = verbs.add_parser(verb, help=text)
        v.add_argument("folder", metavar="DIR")
        v.option(
            "--protocol",
            metavar="FILE.json|NAME",
            help="the protocol, or the name of one of DIR; default that of DIR, if it has one only",
        )
        v.option("--n", type=int, help="spheres: with the default protocol instead of a file")
        v.option("--dim", type=int, help="dimension: with the default protocol instead of a file")
        if verb != "export":
            v.option("--seeds", type=_seeds, required=verb == "run", metavar="A-B", help="seeds, e.g. 1-100,205")
        if verb == "run":
            v.option(
                "--part", type=_part, metavar="K/M", help="only each M-th seed, from the K-th: for job arrays"
            )
            v.option("--executor", choices=["process", "mpi", "dask"], default="process")
            v.option("--workers", type=int, help="processes of --executor process (all cores)")
            v.option("--scheduler", metavar="ADDRESS", help="dask scheduler, e.g. tcp://host:8786")
            v.flag("--retry", help="also the seeds that failed before")
            v.flag("--remake-damaged", help="also the seeds whose file cannot be read")
            v.flag("--quiet")
        if verb == "status":
            v.flag("--json")
        if verb == "export":
            v.add_argument("target", metavar="OUT", help="folder of the shards")
            v.option("--shard", type=int, default=1000, help="packings a file (1000)")
    return p


def _ensemble(o: argparse.Namespace) -> Ensemble:
    chosen: Any = {k: v for k, v in (("n", o.n), ("dim", o.dim)) if v is not None} or None
    if o.protocol:
        if chosen:
            raise ProtocolError("--protocol and --n or --dim are two protocols")
        if re.fullmatch("[0-9a-f]{4,12}", o.protocol) and not os.path.exists(o.protocol):
            return Ensemble(o.folder, o.protocol)
        with open(o.protocol, encoding="utf-8") as file:
            chosen = json.load(file)
    return Ensemble(o.folder, chosen)


def _run(o: argparse.Namespace) -> Status:
    ensemble = _ensemble(o)
    seeds = o.seeds[o.part[0] :: o.part[1]] if o.part else o.seeds
    with ExitStack() as stack:
        executor: Any = None
        if o.executor == "mpi":
            from mpi4py.futures import MPIPoolExecutor

            executor = stack.enter_context(MPIPoolExecutor())
        elif o.executor == "dask":
            from distributed import Client

            client = stack.enter_context(Client(o.scheduler, set_as_default=False))
            executor = client.get_executor()
        status = ensemble.run(
            seeds,
            executor,
            progress=not o.quiet,
            retry=o.retry,
            workers=o.workers,
            remake_damaged=o.remake_damaged,
            search=o.part is None,
        )
    return status


def _refuse(o: argparse.Namespace, code: int, text: str) -> int:
    print(f"jam: {text}", file=sys.stderr)
    if o.verb == "status" and o.json:
        print(_json(code, text))
    return code


def main(arguments: list[str] | None = None) -> int:
    """Returns the exit status."""
    p = parser()
    _Parser.arguments = sys.argv[1:] if arguments is None else arguments
    o = p.parse_args(arguments)
    if o.verb == "run" and (o.executor == "dask") != (o.scheduler is not None):
        p.error("--executor dask and --scheduler ADDRESS belong together")
    try:
        if o.verb == "export":
            made = _ensemble(o).export(o.target, o.shard)
            print(f"{len(made)} files in {o.target}")
            return DONE
        status = _run(o) if o.verb == "run" else _ensemble(o).status(o.seeds)
    except StoreError as error:
        return _refuse(o, OUTPUT, str(error))
    except BrokenExecutor as error:
        return _refuse(o, PARTIAL, f"the executor broke: {error}. What was finished is kept: run again")
    except KeyboardInterrupt:
        return _refuse(o, PARTIAL, "interrupted; what was finished is kept: run again to continue")
    except (ValueError, OSError, ImportError) as error:
        return _refuse(o, REFUSED, str(error))
    code = PARTIAL if status.failed or status.missing or status.damaged else DONE
    if o.verb == "status" and o.json:
        names = ("asked", "done", "jammed", "failed", "missing", "damaged", "odd", "builds")
        print(_json(code, "", **{k: getattr(status, k) for k in names}))
    elif o.verb == "status" or not o.quiet:
        print(status)
    return code
