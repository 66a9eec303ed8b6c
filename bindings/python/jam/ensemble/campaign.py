"""Making packings: what a worker does, and who hands out the work. The worker writes the file itself; only a word goes back."""
from __future__ import annotations

import contextlib
import json
import os
import time
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from typing import Any, Mapping, Sequence

from .. import store
from .._formats.write_packing import write_file
from ..errors import StoreError
from .folder import Folder
from .making import make
from .protocol import identity, packing_name, to_json

WINDOW = 1000  # calls handed to the executor ahead of time: bounds its memory, not the work
ATTEMPTS = 3  # workers that may be lost over one packing before it is recorded as a failure


def make_packing(folder: str, protocol: str, seed: int, attempt: int = 1, remake_damaged: bool = False) -> str:
    """Makes one packing and its file, by the complete protocol as JSON: the call that an executor runs.

    attempt: how often this seed was tried, so that a scheduler takes it for a new call. Returns "done", "failed" or
    "damaged": a file that cannot be read, unless it is to be made again.
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
            files.write_failure(protocol_id, seed, status.lower(), str(error))
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
    bar: Any,
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
                    files.write_failure(identity(protocol), seed, "worker_lost", lost)
                if bar is not None:
                    bar.update()
    finally:
        for future in pending:
            future.cancel()
    return made


def progress_bar(wanted: bool, total: int, done: int) -> Any:
    """A bar by tqdm as a context, or a context of None where none is wanted or tqdm is missing."""
    if wanted:
        with contextlib.suppress(ImportError):
            from tqdm import tqdm

            make_bar: Any = tqdm  # stubs of tqdm that some machines have do not know disable=None: no bar where no terminal is
            return make_bar(total=total, initial=done, unit="packing", disable=None)
    return contextlib.nullcontext()
