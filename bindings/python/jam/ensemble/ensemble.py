"""Packings of one protocol in a folder: the call that makes one in a worker, campaigns of many, and reading what is there."""
from __future__ import annotations

import json
import os
import random
import time
from concurrent.futures import BrokenExecutor, Executor, Future, as_completed
from contextlib import nullcontext, suppress
from dataclasses import replace
from pathlib import Path
from typing import Any, Iterable, Iterator, Mapping

import numpy as np

from .._formats.replacing import writing
from .._formats.seal import MOST_PACKINGS
from .._formats.write_packing import image, write_shard
from ..errors import StoreError
from .folder import Content, Folder
from .pool import LocalPool
from .protocol import ProtocolError, complete, identity, make, packing_name, to_json, whole_seed
from .rows import Entry, Status, as_table, build_of, warn


def make_packing(folder: str, protocol: str, seed: int, remake_damaged: bool) -> str:
    """Makes one packing and its file, by the complete protocol as JSON: the call that an executor runs. The worker writes the
    file itself; only a word goes back: "done", "failed" or "damaged", a file that cannot be read and is not to be made again.
    """
    files, chosen = Folder(folder), json.loads(protocol)
    protocol_id = identity(chosen)
    name = packing_name(protocol_id, seed)
    path, there = files.place(name)  # somebody else may have made it since
    if there == "damaged" and not remake_damaged:
        return there
    if there != "done":
        start, cpu = time.monotonic(), time.process_time()
        try:
            system, results = make(chosen, seed)
        except ImportError:  # of every packing here: there is nothing to record of this one
            raise
        except Exception as error:  # a failure is a result too
            status = getattr(getattr(error, "status", None), "name", type(error).__name__)
            files.write_failure(protocol_id, seed, status.lower(), str(error))
            return "failed"
        seconds = {"seconds_made": time.monotonic() - start, "seconds_processor": time.process_time() - cpu}
        files.write(path, image(system, analysis=results, protocol=protocol, attributes={"protocol": protocol_id, **seconds}))
    files.failure(name).unlink(missing_ok=True)
    return "done"


def lasts(failure: Mapping[str, Any]) -> bool:
    """A failure that the library found in the protocol or its packing. All others may have been of the machine or the folder, or of
    a worker that was killed: the next run tries them again.
    """
    status = str(failure["status"])
    return status.startswith("e_") and status not in ("e_memory", "e_io", "e_busy")


def with_bar(answers: Iterable[Any], total: int, done: int) -> Iterable[Any]:
    """The same answers. A bar of tqdm counts them, on a terminal and if tqdm is installed."""
    with suppress(ImportError):
        from tqdm import tqdm

        make_bar: Any = tqdm  # stubs of tqdm that some machines have do not know disable=None: no bar where no terminal is
        answers = make_bar(answers, total=total, initial=done, unit="packing", disable=None)
    return answers


def readable(files: Folder, protocol: str | None = None) -> list[Entry]:
    """Packings that count, of a protocol or of all; a warning names the files that are left out."""
    content = files.content()
    warn([*content.damaged.values(), *content.doubles.values()])
    return [e for e in content.entries if protocol in (None, e.row["protocol"].decode())]


class Ensemble:
    """Packings of one protocol in a folder.

    Parameters
    ----------
    folder : path
        Made by run() where it is missing. Other protocols may live in it, and other campaigns may run in it.
    protocol : mapping or str, optional
        See jam.ensemble.complete; ``dict(n=128, dim=3)`` is enough. A str is the name of one of the folder, or its
        beginning; None: the only one of the folder.
    """

    def __init__(self, folder: str | os.PathLike[str], protocol: Mapping[str, Any] | str | None = None) -> None:
        self.files = Folder(folder)
        if protocol is None or isinstance(protocol, str):
            there = self.files.protocols()
            known = [k for k in there if k.startswith(protocol or "")]
            if len(known) != 1:
                asked = "" if protocol is None else f", {len(known)} of them begin with {protocol!r}"
                raise ProtocolError(
                    f"{folder} contains {len(there)} protocols ({', '.join(there) or 'none'}){asked}: give one, or its name"
                )
            protocol = there[known[0]]()  # as it was written: later options have their defaults in it
        else:
            protocol = complete(protocol)
        #: The protocol with every default spelled out
        self.protocol: dict[str, Any] = dict(protocol)
        #: Its name
        self.id = identity(self.protocol)

    def name(self, seed: int) -> str:
        """Name of the packing of a seed, by the algorithm of this version of libjam."""
        return packing_name(self.id, seed)

    # ---- making
    def run(
        self,
        seeds: Iterable[int],
        executor: Executor | None = None,
        progress: bool = True,
        retry: bool = False,
        workers: int | None = None,
        remake_damaged: bool = False,
        search: bool = True,
    ) -> Status:
        """Makes the packings of these seeds that are not there yet; says what is there of them, and how many were made now.

        Parameters
        ----------
        seeds : iterable of int
            One packing each.
        executor : concurrent.futures.Executor, optional
            Default: a LocalPool of `workers` processes. For example mpi4py.futures.MPIPoolExecutor() or
            dask.distributed.Client(address).get_executor(). It stays open.
        progress : bool
            A bar by tqdm on a terminal.
        retry : bool
            Also those that failed before.
        remake_damaged : bool
            Also those whose file cannot be read: it is replaced. Without it such a file stays, and status() names it.
        search : bool
            False looks for the names of these seeds alone, and not through the whole folder: for many jobs that share a
            disk. It does not find files that were renamed.

        Raises
        ------
        StoreError
            The folder cannot be written (read-only, disk full). Nothing that was finished is lost.
        """
        seeds = list(dict.fromkeys(map(whole_seed, seeds)))
        self.files.prepare()
        self.files.keep_protocol(self.id, to_json(self.protocol))
        names = {s: self.name(s) for s in seeds}
        asked = None if search else names.values()
        before, failures = self.files.content(asked), self.files.failures(names.values())
        settled = {e.row["name"].decode() for e in before.entries}
        settled.update(name for name, failure in failures.items() if lasts(failure) and not retry)
        todo = [s for s in seeds if names[s] not in settled]
        random.shuffle(todo)  # two campaigns with the same seeds then share the work
        context: Any = LocalPool(workers) if executor is None else nullcontext(executor)  # the caller's stays open
        with context as pool:
            made = self._make(todo, pool, len(seeds) if progress else 0, remake_damaged)
        content = self.files.content(asked)
        remade = [p for p in map(self.files.packing, names.values()) if p in before.damaged and p not in content.damaged]
        return replace(self._status(content, seeds), made=made, remade=tuple(map(str, remade)))

    def _make(self, seeds: list[int], pool: Executor, asked: int, remake_damaged: bool) -> int:
        """Hands one call a seed to the executor and takes the answers; returns how many packings were made.
        asked: where the bar ends; 0: no bar."""
        folder, text, made = os.fspath(self.files.path.resolve()), to_json(self.protocol), 0
        seed_of: dict[Future[str], int] = {}
        try:
            for seed in seeds:
                seed_of[pool.submit(make_packing, folder, text, seed, remake_damaged)] = seed
            answers = as_completed(seed_of)
            for future in with_bar(answers, asked, asked - len(seeds)) if asked else answers:
                try:
                    made += future.result() == "done"
                except (StoreError, BrokenExecutor, ImportError):
                    raise  # nothing more can be written or run, or the workers have no jam
                except Exception as error:  # the worker is lost, not the packing
                    self.files.write_failure(self.id, seed_of[future], "worker_lost", f"{type(error).__name__}: {error}")
        finally:
            for future in seed_of:
                future.cancel()
        return made

    # ---- reading
    def status(self, seeds: Iterable[int] | None = None) -> Status:
        """What is there of the seeds; None: of all that were made or failed."""
        return self._status(self.files.content(), None if seeds is None else [whole_seed(s) for s in seeds])

    def _status(self, content: Content, seeds: list[int] | None) -> Status:
        entries = [e for e in content.entries if e.row["protocol"] == self.id.encode()]
        damaged, every = content.damaged, seeds is None
        if seeds is None:
            failed = [f["seed"] for f in self.files.failures().values() if f["protocol"] == self.id]
            seeds = [*(e.seed for e in entries), *failed]
        wanted = set(seeds)
        entries = [e for e in entries if e.seed in wanted]
        left = [self.name(s) for s in wanted.difference(e.seed for e in entries)]
        if not every:
            damaged = {path: damaged[path] for path in map(self.files.packing, left) if path in damaged}
        return Status(
            asked=len(wanted) + (content.lost() if every else 0),
            done=len(entries),
            jammed=sum(bool(e.row["jammed"]) for e in entries),
            failed=len(self.files.failures(left)),  # none of a packing whose file is there, though damaged
            damaged=tuple(damaged.values()),
            odd=(*content.doubles.values(), *content.odd.values()),
            builds=tuple(sorted({build_of(e.row) for e in entries})),
        )

    def damaged(self) -> dict[Path, str]:
        """Odd files of the folder, of any protocol, and what is wrong with each: those that cannot be read, those that hold
        a packing which another file holds too, and those that have the name of another packing."""
        content = self.files.content()
        return {**content.damaged, **content.doubles, **content.odd}

    def table(self, pandas: bool = False) -> Any:
        """Reports of all packings of this protocol, a row each, by seed: a numpy structured array, or a pandas.DataFrame.

        Fields: seed, name, protocol, version, commit and library (the build), algorithm, n, dim, the fields of CrunchReport
        (enums as numbers, in a DataFrame as words), crystal_score, seconds_made, written. Without a crunch packing_fraction and
        diameter_mean are those of the packing, other numbers nan or -1. Each seed has one row, whatever files hold it. Files
        that cannot be read have none.
        """
        return as_table(readable(self.files, self.id), pandas)

    def failures(self) -> list[dict[str, Any]]:
        """Records of the seeds that failed: seed, status, text, machine, time.

        Records that cannot be read, of any protocol, come first: seed -1, status "damaged_record".
        """
        found = [f for f in self.files.failures().values() if f["protocol"] in (self.id, "")]
        return sorted(found, key=lambda f: int(f["seed"]))

    def __len__(self) -> int:
        return len(readable(self.files, self.id))

    def __iter__(self) -> Iterator[Entry]:
        """Entries by seed."""
        return iter(readable(self.files, self.id))

    def each(self, *names: str, jammed: bool = True, max_crystal_score: float = np.inf) -> Iterator[Any]:
        """Results of one packing after the other: an array for one name, a tuple for several.

        Parameters
        ----------
        names : str
            Stored attributes of Entry: "forces", "gaps", "gap_pairs", "coordination", "positions", "contacts", ...
        jammed : bool
            Only packings with a certificate.
        max_crystal_score : float
            Omits packings with more order (1 to 2 is usual for equal spheres).
        """
        for entry in self:
            if (entry.row["jammed"] or not jammed) and not entry.row["crystal_score"] > max_crystal_score:
                try:
                    found = entry.read(*names)
                except StoreError as error:
                    warn([str(error.strerror)])
                else:
                    yield found[0] if len(names) == 1 else found

    def export(self, folder: str | os.PathLike[str], per_shard: int = 1000) -> list[Path]:
        """Packs the packings into HDF5 files of `per_shard` each, 1 to 10,000, a group a packing, in the order of seeds;
        Ensemble(folder) reads them, and jam.load(path, name) one. Returns their paths.
        """
        if not 1 <= per_shard <= MOST_PACKINGS:
            raise ValueError(f"per_shard must be from 1 to {MOST_PACKINGS}, not {per_shard}")
        target = Path(folder)
        with writing(target):
            target.mkdir(parents=True, exist_ok=True)
        entries, made = readable(self.files, self.id), []
        for k in range(0, len(entries), per_shard):
            path = target / f"{self.id}-{k // per_shard:05d}.h5"
            packings = {e.row["name"].decode(): e._place for e in entries[k : k + per_shard]}
            warn(write_shard(path, to_json(self.protocol), packings))
            made.append(path)
        return made


def protocols(folder: str | os.PathLike[str]) -> dict[str, dict[str, Any]]:
    """The protocols of a folder, a dict by name; Ensemble(folder, name) opens one."""
    return {name: read() for name, read in Folder(folder).protocols().items()}


def table(folder: str | os.PathLike[str], pandas: bool = False) -> Any:
    """Reports of all packings of a folder, of every protocol: the table of Ensemble, whose column `protocol` names it."""
    return as_table(readable(Folder(folder)), pandas)
