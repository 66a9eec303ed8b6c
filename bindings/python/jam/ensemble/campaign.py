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
from .folder import Folder
from .protocol import identity, make, packing_name, to_json

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
        write_file(path, data, files.parts)
        row = files.row_from_file(name, path)
    files.failure(name).unlink(missing_ok=True)
    stat = path.stat()
    return "done", name, stat.st_size, stat.st_mtime_ns, row


class Campaign:
    """One campaign: hands calls to the executor and takes their answers."""

    def __init__(
        self, files: Folder, protocol: Mapping[str, Any], pool: Executor, bar: Any, remake_damaged: bool
    ) -> None:
        self.pool, self.bar, self.files, self.remake_damaged = pool, bar, files, remake_damaged
        self.id, self.protocol = identity(protocol), to_json(protocol)
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
            self.files.write_failure(packing_name(self.id, seed), self.id, seed, "worker_lost", text)
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
