"""Making packings: what a worker does, and who hands out the work.

Data flow: protocol x seed -> make_packing in a worker -> a file -> the folder, which all later calls read.
The worker writes the file itself; only a row of the table goes back. Bits do not depend on the executor.
"""
from __future__ import annotations

import json
import os
import time
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from typing import Any, Mapping

from .. import store
from .._formats.write_packing import write_file
from ..errors import StoreError
from . import index
from .folder import Folder, Place
from .index import Stamp
from .making import make
from .protocol import identity, packing_name, to_json

WINDOW = 1000  # calls handed to the executor ahead of time: bounds its memory, not the work
ATTEMPTS = 3  # workers that may be lost over one packing before it is recorded as a failure
INDEX_SECONDS = 10.0  # rows are added to the index so often


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
        ("done", key, stamp, row) of the index, ("failed", name, text) or ("damaged", name, text).
    """
    files, chosen = Folder(folder), json.loads(protocol)
    protocol_id = identity(chosen)
    name = packing_name(protocol_id, seed)
    path, row = files.free(name), None
    try:
        row = files.row(Place(path))  # somebody else may have made it since
    except StoreError as error:
        if path.exists() and not remake_damaged:
            return "damaged", name, str(error.strerror)
    if row is None:
        start, cpu = time.monotonic(), time.process_time()
        try:
            system, results = make(chosen, seed)
        except ImportError:  # of every packing here: there is nothing to record of this one
            raise
        except Exception as error:  # a failure is a result too
            status = getattr(getattr(error, "status", None), "name", type(error).__name__)
            files.write_failure(name, protocol_id, seed, status.lower(), str(error))
            return "failed", name, f"{status}: {error}"
        times = {"seconds_made": time.monotonic() - start, "seconds_processor": time.process_time() - cpu}
        data = store.image(system, analysis=results, protocol=protocol, protocol_id=protocol_id, times=times)
        write_file(path, data, files.parts)
        row = files.row(Place(path))
    files.failure(name).unlink(missing_ok=True)
    return "done", *files.indexed(path), row.tobytes()


def lasts(failure: Mapping[str, Any]) -> bool:
    """A failure that the library found in the protocol or its packing. All others may have been of the machine or the folder, or of
    a worker that was killed: the next run tries them again.
    """
    status = str(failure["status"])
    return status.startswith("e_") and status not in ("e_memory", "e_io", "e_busy")


class Campaign:
    """One campaign: hands calls to the executor and takes their answers."""

    def __init__(
        self, files: Folder, protocol: Mapping[str, Any], pool: Executor, bar: Any, remake_damaged: bool
    ) -> None:
        self.pool, self.bar, self.files, self.remake_damaged = pool, bar, files, remake_damaged
        self.id, self.protocol = identity(protocol), to_json(protocol)
        self.pending: dict[Future[Any], tuple[int, int]] = {}
        self.rows: dict[str, tuple[Stamp, bytes]] = {}
        self.flushed, self.made = time.monotonic(), 0

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
            self.files.write_failure(packing_name(self.id, seed), self.id, seed, "worker_lost", text)
            answer = ("failed", "", text)
        if answer[0] == "done":
            self.rows[answer[1]] = answer[2:]
            self.made += 1
        if self.bar is not None:
            self.bar.update(1)
        return None

    def _flush(self, after: float) -> None:
        if time.monotonic() - self.flushed >= after:
            index.add(self.files.index, self.rows)
            self.rows, self.flushed = {}, time.monotonic()


def progress_bar(progress: bool, total: int, done: int) -> Any:
    """A bar by tqdm, None where none is wanted or tqdm is missing."""
    if not progress:
        return None
    try:
        from tqdm import tqdm
    except ImportError:
        return None
    make: Any = tqdm  # stubs of tqdm that some machines have do not know disable=None: no bar where no terminal is
    return make(total=total, initial=done, unit="packing", disable=None)
