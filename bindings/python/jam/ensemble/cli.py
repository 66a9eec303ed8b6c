"""python3 -m jam ensemble run|status|export DIR: ensembles from the command line and from batch jobs."""
from __future__ import annotations

import argparse
import json
import os
import re
from concurrent.futures import BrokenExecutor
from contextlib import ExitStack
from typing import Any

from .._api.command import DONE, OUTPUT, PARTIAL, REFUSED, Parser, json_answer, printed, refuse
from ..errors import StoreError
from .ensemble import Ensemble
from .protocol import ProtocolError
from .rows import Status

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
    found = re.fullmatch(r"([0-9]+)/([0-9]+)", text)
    if not found or int(found[1]) >= int(found[2]):
        raise argparse.ArgumentTypeError(f"{text!r} must be K/M with K in 0..M-1, e.g. $SLURM_ARRAY_TASK_ID/10")
    return int(found[1]), int(found[2])


def parser() -> Parser:
    p = Parser(
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
        v.add_argument(
            "--protocol",
            metavar="FILE.json|NAME",
            help="the protocol, or the name of one of DIR; default that of DIR, if it has one only",
        )
        v.add_argument("--n", type=int, help="spheres: with the default protocol instead of a file")
        v.add_argument("--dim", type=int, help="dimension: with the default protocol instead of a file")
        if verb != "export":
            v.add_argument("--seeds", type=_seeds, required=verb == "run", metavar="A-B", help="seeds, e.g. 1-100,205")
        if verb == "run":
            v.add_argument(
                "--part", type=_part, metavar="K/M", help="only each M-th seed, from the K-th: for job arrays"
            )
            v.add_argument("--executor", choices=["process", "mpi", "dask"], default="process")
            v.add_argument("--workers", type=int, help="processes of --executor process (all cores)")
            v.add_argument("--scheduler", metavar="ADDRESS", help="dask scheduler, e.g. tcp://host:8786")
            v.add_argument("--retry", action="store_true", help="also the seeds that failed before")
            v.add_argument("--remake-damaged", action="store_true", help="also the seeds whose file cannot be read")
            v.add_argument("--quiet", action="store_true")
        if verb == "status":
            v.add_argument("--json", action="store_true")
        if verb == "export":
            v.add_argument("target", metavar="OUT", help="folder of the shards")
            v.add_argument("--shard", type=int, default=1000, help="packings a file (1000)")
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


def _executor(o: argparse.Namespace, stack: ExitStack) -> Any:
    """The executor that was asked for; None for processes of this machine."""
    if o.executor == "mpi":
        from mpi4py.futures import MPIPoolExecutor

        return stack.enter_context(MPIPoolExecutor())
    if o.executor == "dask":
        from distributed import Client

        return stack.enter_context(Client(o.scheduler, set_as_default=False)).get_executor()
    return None


def _run(o: argparse.Namespace) -> Status:
    seeds, options = o.seeds, dict(progress=not o.quiet, retry=o.retry, workers=o.workers, remake_damaged=o.remake_damaged)
    if o.part:
        seeds = seeds[o.part[0] :: o.part[1]]
    with ExitStack() as stack:
        status = _ensemble(o).run(seeds, _executor(o, stack), search=o.part is None, **options)
    return status


def _refuse(o: argparse.Namespace, code: int, text: str) -> int:
    return refuse(code, text, o.verb == "status" and o.json)


def main(arguments: list[str] | None = None) -> int:
    """Returns the exit status."""
    return printed(lambda: _answer(arguments))


def _answer(arguments: list[str] | None) -> int:
    """Exit status of a command line. The only OSError that leaves it is that of print."""
    p = parser()
    o = p.parse(arguments)
    if o.verb == "run" and (o.executor == "dask") != (o.scheduler is not None):
        p.error("--executor dask and --scheduler ADDRESS belong together")
    try:
        if o.verb == "export":
            made = _ensemble(o).export(o.target, o.shard)
        else:
            status = _run(o) if o.verb == "run" else _ensemble(o).status(o.seeds)
    except StoreError as error:
        return _refuse(o, OUTPUT, str(error))
    except BrokenExecutor as error:
        return _refuse(o, PARTIAL, f"the executor broke: {error}. What was finished is kept: run again")
    except KeyboardInterrupt:
        return _refuse(o, PARTIAL, "interrupted; what was finished is kept: run again to continue")
    except (ValueError, OSError, ImportError) as error:
        return _refuse(o, REFUSED, str(error))
    if o.verb == "export":
        print(f"{len(made)} files in {o.target}")
        return DONE
    code = PARTIAL if status.failed or status.missing or status.damaged else DONE
    if o.verb == "status" and o.json:
        shown = ("asked", "done", "jammed", "failed", "missing", "damaged", "odd", "builds")
        print(json_answer(code, "", **{k: getattr(status, k) for k in shown}))
    elif o.verb == "status" or not o.quiet:
        print(status)
    return code
