"""Ensembles: one protocol times many seeds, made by any concurrent.futures.Executor, one file a packing.

    import jam
    e = jam.ensemble.Ensemble("folder", dict(n=128, dim=3))
    e.run(range(1, 101))                 # killed? run it again: what is there is not made twice
    e.table()["packing_fraction"]        # reports
    for forces, gaps in e.each("forces", "gaps"): ...   # one packing after the other, read when asked for
    jam.ensemble.table("folder")         # all protocols of a folder

Data flow: protocol x seed -> make_packing in a worker -> a file -> the folder, which all later calls read.
The worker writes the file itself; only a row of the table goes back. Bits do not depend on the executor.
A file that is damaged is named by a DamagedWarning and by status(), and left out of all that is read.
"""
from __future__ import annotations

import json
import os
import random
import time
import warnings
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Iterable, Iterator, Mapping

import numpy as np

from .._api.arrays import Array
from .. import store
from .._formats.replacing import remove_abandoned
from .folder import FIELDS, Folder, Found, builds_of
from .pool import LocalPool, WorkerDied
from .protocol import ProtocolError, begin, complete, identity, make, minimal, packing_name, to_json

from .._api.errors import StoreError
from .._formats.sealed import open_file
from ..system import System

WINDOW = 1000  # calls handed to the executor ahead of time: bounds its memory, not the work
ATTEMPTS = 3  # workers that may be lost over one packing before it is recorded as a failure
INDEX_SECONDS = 10.0  # rows are added to the index so often

class DamagedWarning(UserWarning):
    """Files of an ensemble that cannot be read are left out; the text names them."""


def make_packing(
    folder: str, protocol: str, seed: int, attempt: int = 1, remake_damaged: bool = False
) -> tuple[Any, ...]:
    """Makes one packing and its file: the call that an executor runs.

    Parameters
    ----------
    folder, protocol : str
        Folder of the ensemble; the complete protocol as JSON.
    attempt : int
        How often this seed was tried, so that a scheduler takes it for a new call.
    remake_damaged : bool
        Makes a packing again whose file cannot be read.

    Returns
    -------
    tuple
        ("done", name, size, changed, row), ("failed", name, text) or ("damaged", name, text).
    """
    files, chosen = Folder(folder), json.loads(protocol)
    protocol_id = identity(chosen)
    name = packing_name(protocol_id, seed)
    path = files.packing(name)
    row = b""
    try:
        row = files.row_from_file(name, path)  # somebody else may have made it since
    except StoreError as error:
        if path.exists() and not remake_damaged:
            return "damaged", name, str(error.strerror)
    if not row:
        start, cpu = time.monotonic(), time.process_time()
        try:
            system, results = make(chosen, seed)
        except Exception as error:  # a failure is a result too
            status = getattr(getattr(error, "status", None), "name", type(error).__name__)
            files.write_failure(name, protocol_id, seed, status.lower(), str(error))
            return "failed", name, f"{status}: {error}"
        times = {"seconds_made": time.monotonic() - start, "seconds_processor": time.process_time() - cpu}
        data = store.image(system, analysis=results, protocol=protocol, protocol_id=protocol_id, times=times)
        store.write_file(path, data, files.parts)
        row = files.row_from_file(name, path)
    files.failure(name).unlink(missing_ok=True)
    stat = path.stat()
    return "done", name, stat.st_size, stat.st_mtime_ns, row


@dataclass(frozen=True)
class Status:
    """What is there of the seeds asked for."""

    asked: int
    done: int
    jammed: int
    failed: int
    #: What is wrong with each file that cannot be read; a text names its file. Without seeds: of any protocol.
    damaged: tuple[str, ...] = ()
    #: Builds of libjam that made the packings: more than one may differ in the last bits. The table has columns of it.
    builds: tuple[str, ...] = field(default=())

    @property
    def missing(self) -> int:
        """Neither made, failed nor damaged."""
        return max(0, self.asked - self.done - self.failed - len(self.damaged))

    def __str__(self) -> str:
        text = (
            f"{self.done} of {self.asked} packings are there, {self.jammed} jammed; {self.failed} failed, "
            f"{self.missing} to be made"
        )
        if self.damaged:
            text += f"; {len(self.damaged)} damaged and left out: " + "; ".join(self.damaged[:3])
        if len(self.builds) > 1:
            text += f"; made by {len(self.builds)} builds: " + ", ".join(self.builds)
        return text


class Entry:
    """One packing of an ensemble, read from its file when asked for.

    Attributes are what System calls them: positions, diameters, pairs, vectors, contact_gaps, forces, coordination,
    rattlers (which spheres are), history; `gaps` are those of the protocol's analysis; `analysis(name)` reads any other
    result. Numbers of the report go by their names, the number of rattlers by row["rattlers"].
    """

    _PLACES = {
        "pairs": "contacts/pairs",
        "vectors": "contacts/vectors",
        "contact_gaps": "contacts/gaps",
        "forces": "contacts/forces",
        "gaps": "analysis/gaps/gap",
        "diameters": "diameters",
        "coordination": "coordination",
        "history": "history",
    }

    def __init__(self, row: Any, path: Path, unverified: bool = False) -> None:
        #: The row of the table
        self.row = row
        #: The file
        self.path = path
        self._unverified = unverified

    seed = property(lambda self: int(self.row["seed"]))

    def read(self, *names: str) -> tuple[Any, ...]:
        """Several of the attributes with one opening of the file."""
        with open_file(self.path, self._unverified) as file:
            store._jam(file, self.path)
            return tuple(self._get(file, name) for name in names)

    def _get(self, file: Any, name: str) -> Any:
        if name == "rattlers":
            return self._get(file, "coordination") == 0
        if name == "positions":
            return file["particles/spheres/position/value"][0]
        if name in FIELDS and name not in self._PLACES:
            return self.row[name]
        place = self._PLACES.get(name, "analysis/" + name)
        if place not in file["jam"]:
            there = list(self._PLACES) + ["positions"] + list(file["jam/analysis"])
            raise KeyError(f"{self.path} holds no {name!r}; there may be {', '.join(there)}")
        return store._read(file["jam/" + place])

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name not in (*self._PLACES, "positions", *FIELDS):
            raise AttributeError(name)
        return self.read(name)[0]

    def analysis(self, name: str) -> Any:
        """A result of the protocol's analysis: a number, an array, text, or a dict of them."""
        return self.read(name)[0]

    def system(self) -> System:
        """The packing itself."""
        return store.load(self.path, unverified=self._unverified)

    def __repr__(self) -> str:
        return f"Entry(seed={self.seed}, n={self.row['n']}, jammed={self.row['jammed']}, {self.path.name})"


class Ensemble:
    """Packings of one protocol in a folder.

    Parameters
    ----------
    folder : path
        Made by run() where it is missing. Other protocols may live in it, and other campaigns may run in it.
    protocol : mapping or str, optional
        See jam.ensemble.complete; ``dict(n=128, dim=3)`` is enough. A str is the name of one of the folder, or its
        beginning; None: the only one of the folder.
    unverified : bool
        Also reads files without a seal, or with one that does not fit: of an older version, or changed by another
        program. Only for files of your own.
    """

    def __init__(
        self,
        folder: str | os.PathLike[str],
        protocol: Mapping[str, Any] | str | None = None,
        unverified: bool = False,
    ) -> None:
        self.files = Folder(folder, unverified)
        if protocol is None or isinstance(protocol, str):
            names = self.files.protocol_names()
            known = [k for k in names if k.startswith(protocol or "")]
            if len(known) != 1:
                asked = "" if protocol is None else f", {len(known)} of them begin with {protocol!r}"
                raise ProtocolError(
                    f"{folder} holds {len(names)} protocols ({', '.join(names) or 'none'}){asked}: give one, or its name"
                )
            protocol = self.files.protocol(known[0])  # as it was written: later options have their defaults in it
        else:
            protocol = complete(protocol)
        #: The protocol with every default spelled out
        self.protocol: dict[str, Any] = dict(protocol)
        #: Its name
        self.id = identity(self.protocol)

    def name(self, seed: int) -> str:
        """Name of the packing of a seed, with this version of libjam."""
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
    ) -> Status:
        """Makes the packings of these seeds that are not there yet.

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

        Returns
        -------
        Status
            What is there of these seeds.

        Raises
        ------
        StoreError
            The folder cannot be written (read-only, disk full). Nothing that was finished is lost.
        """
        seeds = list(dict.fromkeys(int(s) for s in seeds))
        self.files.prepare()
        self.files.keep_protocol(self.id, to_json(self.protocol))
        done, failed = self.files.scan()
        names = {s: self.name(s) for s in seeds}
        left_out = self.files.rows({k: done[k] for k in names.values() if k in done})[1] if remake_damaged else {}
        todo = [
            s for s in seeds if (names[s] not in done and (retry or names[s] not in failed)) or names[s] in left_out
        ]
        random.shuffle(todo)  # two campaigns with the same seeds then share the work
        own = executor is None
        pool = LocalPool(workers) if executor is None else executor
        try:
            _Run(self, pool, _bar(progress, len(seeds), len(seeds) - len(todo)), remake_damaged).work(todo)
        except BaseException:
            if own:
                pool.shutdown(cancel_futures=True)  # packings under way are dropped, their workers killed
                with suppress(OSError):  # the error that ended the campaign is the one to tell
                    remove_abandoned(self.files.parts)  # a worker may have been killed while it wrote
            raise
        if own:
            pool.shutdown()
        return self.status(seeds)

    # ---- reading
    def status(self, seeds: Iterable[int] | None = None) -> Status:
        """What is there of the seeds; None: of all that were made or failed."""
        done, failed = self.files.scan()
        rows, left_out = self.files.rows(done)
        rows = rows[rows["protocol"] == self.id.encode()]
        if seeds is None:
            lost = sum(f["protocol"] == self.id for f in self.files.failures(failed))
            asked = len(rows) + lost + len(left_out)
        else:
            names = [self.name(s) for s in dict.fromkeys(seeds)]
            rows = rows[np.isin(rows["name"], np.array(names, "S32"))]
            left_out = {k: v for k, v in left_out.items() if k in set(names)}
            asked, lost = len(names), sum(n in failed for n in names)
        jammed = int((rows["jammed"] != 0).sum())
        return Status(asked, len(rows), jammed, lost, tuple(left_out.values()), builds_of(rows))

    def _rows(self) -> Array:
        rows = _readable(self.files)
        found: Array = rows[rows["protocol"] == self.id.encode()]
        return found

    def damaged(self) -> dict[Path, str]:
        """Files of the folder that cannot be read, of any protocol, and what is wrong with each."""
        return {self.files.packing(name): text for name, text in self.files.rows()[1].items()}

    def table(self, pandas: bool = False) -> Any:
        """Reports of all packings of this protocol, a row each, by seed.

        Returns
        -------
        numpy structured array, or pandas.DataFrame
            Fields: seed, name, protocol, version, commit and library (the build), n, dim, the fields of CrunchReport
            (enums as numbers), crystal_score, seconds_made, written. Files that cannot be read have no row.
        """
        return _as_table(self._rows(), pandas)

    def failures(self) -> list[dict[str, Any]]:
        """Records of the seeds that failed: seed, status, text, machine, time.

        Records that cannot be read, of any protocol, come first: seed -1, status "damaged_record".
        """
        found: list[dict[str, Any]] = sorted(
            (f for f in self.files.failures() if f["protocol"] in (self.id, "")), key=lambda f: int(f["seed"])
        )
        return found

    def __len__(self) -> int:
        return len(self._rows())

    def __iter__(self) -> Iterator[Entry]:
        """Entries by seed."""
        for row in self._rows():
            yield Entry(row, self.files.packing(row["name"].decode()), self.files.unverified)

    def each(self, *names: str, jammed: bool = True, max_crystal_score: float = np.inf) -> Iterator[Any]:
        """Results of one packing after the other: an array for one name, a tuple for several.

        Parameters
        ----------
        names : str
            Attributes of Entry: "forces", "gaps", "coordination", "positions", "pairs", ...
        jammed : bool
            Only packings with a certificate.
        max_crystal_score : float
            Leaves out packings with more order (1 to 2 is usual for equal spheres).
        """
        for entry in self:
            if (jammed and not entry.row["jammed"]) or entry.row["crystal_score"] > max_crystal_score:
                continue
            try:
                found = entry.read(*names)
            except StoreError as error:
                _warn([str(error.strerror)])
                continue
            yield found[0] if len(names) == 1 else found

    def export(self, folder: str | os.PathLike[str], per_shard: int = 1000) -> list[Path]:
        """Packs the packings into HDF5 files of `per_shard` each, a group a packing; jam.load(path, name) reads one.

        Returns
        -------
        list of Path
            The shards, in the order of seeds.
        """
        target = Path(folder)
        target.mkdir(parents=True, exist_ok=True)
        rows, made = self._rows(), []
        for k in range(0, len(rows), per_shard):
            names = [name.decode() for name in rows["name"][k : k + per_shard]]
            path = target / f"{self.id}-{k // per_shard:05d}.h5"
            left_out = store.write_shard(path, to_json(self.protocol), {n: self.files.packing(n) for n in names})
            _warn(left_out)
            made.append(path)
        return made


def _warn(left_out: Iterable[str]) -> None:
    texts = list(left_out)
    if texts:
        more = f"; and {len(texts) - 5} more" if len(texts) > 5 else ""
        warnings.warn(f"{len(texts)} files are left out: " + "; ".join(texts[:5]) + more, DamagedWarning, stacklevel=3)


def _readable(files: Folder) -> Array:
    """Rows of the files that can be read; a warning names the others."""
    rows, left_out = files.rows()
    _warn(left_out.values())
    return rows


def _as_table(rows: Array, pandas: bool) -> Any:
    if not pandas:
        return rows
    import pandas as pd

    return pd.DataFrame({k: rows[k].astype(str) if rows[k].dtype.kind == "S" else rows[k] for k in FIELDS})


def protocols(folder: str | os.PathLike[str]) -> dict[str, dict[str, Any]]:
    """The protocols of a folder by name; Ensemble(folder, name) opens one."""
    files = Folder(folder)
    return {name: files.protocol(name) for name in files.protocol_names()}


def table(folder: str | os.PathLike[str], pandas: bool = False, unverified: bool = False) -> Any:
    """Reports of all packings of a folder, of every protocol: the table of Ensemble, whose column `protocol` names it."""
    return _as_table(_readable(Folder(folder, unverified)), pandas)


class _Run:
    """One campaign: hands calls to the executor and takes their answers."""

    def __init__(self, ensemble: Ensemble, pool: Executor, bar: Any, remake_damaged: bool) -> None:
        self.pool, self.bar, self.files, self.remake_damaged = pool, bar, ensemble.files, remake_damaged
        self.ensemble, self.protocol = ensemble, to_json(ensemble.protocol)
        self.pending: dict[Future[Any], tuple[int, int]] = {}
        self.rows: list[tuple[str, int, int, bytes]] = []
        self.flushed = time.monotonic()

    def work(self, todo: list[int]) -> None:
        queue = [(s, 1) for s in reversed(todo)]
        try:
            while queue or self.pending:
                while queue and len(self.pending) < WINDOW:
                    self._submit(*queue.pop())
                for future in wait(self.pending, return_when=FIRST_COMPLETED).done:
                    again = self._take(future, *self.pending.pop(future))
                    if again:
                        queue.append(again)
                self._flush(INDEX_SECONDS)
        except BaseException:
            for future in self.pending:
                future.cancel()
            raise
        finally:
            self._flush(0.0)
            if self.bar is not None:
                self.bar.close()

    def _submit(self, seed: int, attempt: int) -> None:
        folder = os.fspath(self.files.path.resolve())
        call = self.pool.submit(make_packing, folder, self.protocol, seed, attempt, self.remake_damaged)
        self.pending[call] = (seed, attempt)

    def _take(self, future: Future[Any], seed: int, attempt: int) -> tuple[int, int] | None:
        """Takes an answer; returns what must be tried again."""
        try:
            answer = future.result()
        except (StoreError, BrokenExecutor, ImportError):
            raise  # nothing more can be written or run, or the workers have no jam
        except Exception as error:  # the worker is lost, not the packing
            if attempt < ATTEMPTS:
                return seed, attempt + 1
            text = f"{attempt} workers were lost over this packing; the last: {type(error).__name__}: {error}"
            self.files.write_failure(self.ensemble.name(seed), self.ensemble.id, seed, "worker_lost", text)
            answer = ("failed", "", text)
        if answer[0] == "done":
            self.rows.append(answer[1:])
        if self.bar is not None:
            self.bar.update(1)
        return None

    def _flush(self, after: float) -> None:
        if time.monotonic() - self.flushed >= after:
            self.files.index_add(self.rows)
            self.rows, self.flushed = [], time.monotonic()


def _bar(progress: bool, total: int, done: int) -> Any:
    if not progress:
        return None
    try:
        from tqdm import tqdm
    except ImportError:
        return None
    make: Any = tqdm  # stubs of tqdm that some machines have do not know disable=None: no bar where no terminal is
    return make(total=total, initial=done, unit="packing", disable=None)
