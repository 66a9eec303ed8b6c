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
from .._formats.seal import MOST_PACKINGS
from ..errors import StoreError
from .ensemble import Ensemble
from .protocol import ProtocolError
from .rows import Status


def _seeds(text: str) -> list[int]:
    """1-100, 7, or several with commas: 1-100,205."""
    whole = re.fullmatch("[0-9]+(-[0-9]+)?(,[0-9]+(-[0-9]+)?)*", text)
    parts = re.findall("([0-9]+)-?([0-9]*)", text if whole else "")
    found = [seed for first, last in parts for seed in range(int(first), int(last or first) + 1)]
    if not found:
        raise argparse.ArgumentTypeError(f"{text!r} must be seeds like 1-100 or 1-100,205")
    return found


def _part(text: str) -> slice:
    found = re.fullmatch("([0-9]+)/([0-9]+)", text)
    if not found or int(found[1]) >= int(found[2]):
        raise argparse.ArgumentTypeError(f"{text!r} must be K/M with K in 0..M-1, e.g. $SLURM_ARRAY_TASK_ID/10")
    return slice(int(found[1]), None, int(found[2]))


def parser() -> Parser:
    p = Parser(
        prog="python3 -m jam ensemble",
        description="Makes many packings of one protocol, one file each. What is there is not made again.",
        epilog="Example: python3 -m jam ensemble run packings --n 128 --seeds 1-100. Exit status: 0 all are there; "
        "1 some failed or are missing; 2 wrong command line; 3 protocol or folder refused; 4 the folder cannot be written.",
    )
    verbs = p.add_subparsers(dest="verb", required=True)
    run = verbs.add_parser("run", help="make the packings that are not there")
    status = verbs.add_parser("status", help="count packings and failures")
    export = verbs.add_parser("export", help="pack the packings into HDF5 files of many")
    protocol = "the protocol, or the name of one of DIR; default that of DIR, if it has one only"
    for verb in (run, status, export):
        verb.add_argument("folder", metavar="DIR")
        verb.add_argument("--protocol", metavar="FILE.json|NAME", help=protocol)
        verb.add_argument("--n", type=int, help="spheres: with the default protocol instead of a file")
        verb.add_argument("--dim", type=int, help="dimension: with the default protocol instead of a file")
    for verb in (run, status):
        verb.add_argument("--seeds", type=_seeds, required=verb is run, metavar="A-B", help="seeds, e.g. 1-100,205")
    run.add_argument("--part", type=_part, metavar="K/M", help="only each M-th seed, from the K-th: for job arrays")
    run.add_argument("--executor", choices=["process", "mpi", "dask"], default="process")
    run.add_argument("--workers", type=int, help="processes of --executor process (all cores)")
    run.add_argument("--scheduler", metavar="ADDRESS", help="dask scheduler, e.g. tcp://host:8786")
    run.add_argument("--retry", action="store_true", help="also the seeds that failed before")
    run.add_argument("--remake-damaged", action="store_true", help="also the seeds whose file cannot be read")
    run.add_argument("--quiet", action="store_true")
    status.add_argument("--json", action="store_true")
    export.add_argument("target", metavar="OUT", help="folder of the shards")
    export.add_argument("--shard", type=int, default=1000, help="packings a file (1000)")
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
    with ExitStack() as stack:
        ensemble = _ensemble(o)
        pool: Any = None  # processes of this machine
        if o.executor == "mpi":
            from mpi4py.futures import MPIPoolExecutor

            pool = stack.enter_context(MPIPoolExecutor())
        if o.executor == "dask":
            from distributed import Client

            pool = stack.enter_context(Client(o.scheduler, set_as_default=False)).get_executor()
        seeds, of_all = o.seeds[o.part or slice(None)], o.part is None
        status = ensemble.run(seeds, pool, not o.quiet, o.retry, o.workers, o.remake_damaged, search=of_all)
    return status


@printed
def main(arguments: list[str] | None = None) -> int:
    """Returns the exit status. In the body only print may raise OSError, as `printed` needs."""
    p = parser()
    o = p.parse(arguments)
    if o.verb == "run" and (o.executor == "dask") != (o.scheduler is not None):
        p.error("--executor dask and --scheduler ADDRESS belong together")
    if o.verb == "export" and not 1 <= o.shard <= MOST_PACKINGS:
        p.error(f"--shard is {o.shard}, it must be from 1 to {MOST_PACKINGS}")
    as_json = o.verb == "status" and o.json
    try:
        if o.verb == "export":
            made = _ensemble(o).export(o.target, o.shard)
        else:
            status = _run(o) if o.verb == "run" else _ensemble(o).status(o.seeds)
    except StoreError as error:
        return refuse(OUTPUT, str(error), as_json)
    except BrokenExecutor as error:
        return refuse(PARTIAL, f"the executor broke: {error}. What was finished is kept: run again", as_json)
    except KeyboardInterrupt:
        return refuse(PARTIAL, "interrupted; what was finished is kept: run again to continue", as_json)
    except (ValueError, OSError, ImportError) as error:
        return refuse(REFUSED, str(error), as_json)
    if o.verb == "export":
        print(f"{len(made)} files in {o.target}")
        return DONE
    code = PARTIAL if status.failed or status.missing or status.damaged else DONE
    if as_json:
        shown = ("asked", "done", "jammed", "failed", "missing", "damaged", "odd", "builds")
        print(json_answer(code, "", **{k: getattr(status, k) for k in shown}))
    elif o.verb == "status" or not o.quiet:
        print(status)
    return code
