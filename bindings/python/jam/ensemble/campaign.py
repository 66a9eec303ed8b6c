"""Making packings: what a worker does, and who hands out the work.

Data flow: protocol x seed -> make_packing in a worker -> a file -> the folder, which all later calls read.
The worker writes the file itself; only a word goes back. Bits do not depend on the executor.
"""
from __future__ import annotations

import contextlib
import json
import os
import time
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from typing import Any, Callable, Iterator, Mapping, Sequence

from .. import store
from .._formats.write_packing import write_file
from ..errors import StoreError
from .folder import Folder
from .making import make
from .protocol import identity, packing_name, to_json

WINDOW = 1000  # calls handed to the executor ahead of time: bounds its memory, not the work
ATTEMPTS = 3  # workers that may be lost over one packing before it is recorded as a failure


def make_packing(folder: str, protocol: str, seed: int, attempt: int = 1, remake_damaged: bool = False) -> str:
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
    str
        "done", "failed" or "damaged".
    """
    files, chosen = Folder(folder), json.loads(protocol)
    protocol_id = identity(chosen)
    name = packing_name(protocol_id, seed)
    try:
        path, there = files.free(name, remake_damaged)  # somebody else may have made it since
    except StoreError:
        return "damaged"
    if not there:
        start, cpu = time.monotonic(), time.process_time()
        try:
            system, results = make(chosen, seed)
        except ImportError:  # of every packing here: there is nothing to record of this one
            raise
        except Exception as error:  # a failure is a result too
            status = getattr(getattr(error, "status", None), "name", type(error).__name__)
            files.write_failure(name, protocol_id, seed, status.lower(), str(error))
            return "failed"
        times = {"seconds_made": time.monotonic() - start, "seconds_processor": time.process_time() - cpu}
        data = store.image(system, analysis=results, protocol=protocol, protocol_id=protocol_id, times=times)
        write_file(path, data, files.parts)
    files.failure(name).unlink(missing_ok=True)
    return "done"


def lasts(failure: Mapping[str, Any]) -> bool:
    """A failure that the library found in the protocol or its packing. All others may have been of the machine or the folder, or of
    a worker that was killed: the next run tries them again.
    """
    status = str(failure["status"])
    return status.startswith("e_") and status not in ("e_memory", "e_io", "e_busy")


def campaign(
    files: Folder,
    protocol: Mapping[str, Any],
    seeds: Sequence[int],
    pool: Executor,
    done_one: Callable[[], Any],
    remake_damaged: bool,
) -> int:
    """Hands one call a seed to the executor and takes the answers; returns how many packings were made."""
    folder, text, made = os.fspath(files.path.resolve()), to_json(protocol), 0
    queue = [(seed, 1) for seed in reversed(seeds)]
    pending: dict[Future[str], tuple[int, int]] = {}
    try:
        while queue or pending:
            while queue and len(pending) < WINDOW:
                seed, attempt = queue.pop()
                pending[pool.submit(make_packing, folder, text, seed, attempt, remake_damaged)] = seed, attempt
            for future in wait(pending, return_when=FIRST_COMPLETED).done:
                seed, attempt = pending.pop(future)
                try:
                    made += future.result() == "done"
                except (StoreError, BrokenExecutor, ImportError):
                    raise  # nothing more can be written or run, or the workers have no jam
                except Exception as error:  # the worker is lost, not the packing
                    if attempt < ATTEMPTS:
                        queue.append((seed, attempt + 1))
                        continue
                    lost = f"{attempt} workers were lost over this packing; the last: {type(error).__name__}: {error}"
                    protocol_id = identity(protocol)
                    files.write_failure(packing_name(protocol_id, seed), protocol_id, seed, "worker_lost", lost)
                done_one()
    except BaseException:
        for future in pending:
            future.cancel()
        raise
    return made


@contextlib.contextmanager
def progress_bar(progress: bool, total: int, done: int) -> Iterator[Callable[[], Any]]:
    """What counts one packing: a bar by tqdm, or nothing where none is wanted or tqdm is missing."""
    bar = None
    if progress:
        with contextlib.suppress(ImportError):
            from tqdm import tqdm

            make_bar: Any = tqdm  # stubs of tqdm that some machines have do not know disable=None: no bar where no terminal is
            bar = make_bar(total=total, initial=done, unit="packing", disable=None)
    try:
        yield bar.update if bar is not None else lambda: None
    finally:
        if bar is not None:
            bar.close()
