"""Worker processes of this machine as a concurrent.futures.Executor.

The pool of processes in the standard library cannot be used after one of its workers was killed, and does not say which call
that worker ran. Here each thread of a pool of threads has a worker process of its own behind a pair of sockets: a killed worker
fails one call, and the next call gets a new worker. A worker ends when its socket closes, so none outlives a killed campaign.

Workers import jam and not the user's script, which needs no `if __name__ == "__main__"`, and nothing from the current folder,
where anybody may have put a file with the name of a module. A callable of another package than jam brings the folders along
that the caller imports from; they come behind all others, so that they hide nothing.
"""
from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import threading
import traceback
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from multiprocessing.connection import Connection, Pipe
from pathlib import Path
from typing import Any, Callable

_OWN_PATH = "import sys; sys.path[:] = filter(None, sys.path)"  # "" stands for the current folder


class WorkerDied(RuntimeError):
    """The worker process ended before it answered; the text says by which signal or with which exit status."""


class LocalPool(ThreadPoolExecutor):
    """Processes of this machine.

    Parameters
    ----------
    workers : int, optional
        How many; default the number of cores this process may use. Each runs BLAS on one thread.
    """

    def __init__(self, workers: int | None = None) -> None:
        super().__init__(workers or len(os.sched_getaffinity(0)))
        self._workers: dict[int, tuple[subprocess.Popen[bytes], Connection]] = {}  # by thread
        self._begins, self._killed = threading.Lock(), False

    @property
    def pids(self) -> list[int]:
        """Process ids of the workers that live now."""
        return [process.pid for process, _ in list(self._workers.values()) if process.poll() is None]

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Calls fn in a worker; fn is found there by its module and name, arguments and answer go by pickle."""
        package = str(getattr(fn, "__module__", None)).partition(".")[0]
        folders = [] if package in ("jam", "builtins") else [os.path.abspath(p) for p in sys.path]
        return super().submit(self._call, folders, fn, args, kwargs)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Ends the pool. With cancel_futures also the calls that run now: their workers are killed."""
        super().shutdown(wait=False, cancel_futures=cancel_futures)
        if cancel_futures:
            with self._begins:
                self._killed = True
                for process, _ in self._workers.values():
                    process.kill()
        super().shutdown(wait=wait)
        if wait:
            for process, connection in self._workers.values():
                connection.close()
                process.wait()

    def __exit__(self, kind: Any, *_: Any) -> None:
        """After an exception, packings under way are dropped and their workers killed."""
        self.shutdown(cancel_futures=kind is not None)

    def _begin(self) -> tuple[subprocess.Popen[bytes], Connection]:
        home = str(Path(__file__).resolve().parents[2])
        paths = [home] + [p for p in os.environ.get("PYTHONPATH", "").split(os.pathsep) if p and p != home]
        environment = dict(os.environ, PYTHONPATH=os.pathsep.join(paths), OPENBLAS_NUM_THREADS="1")
        ours, theirs = Pipe()
        command = [sys.executable, "-c", f"{_OWN_PATH}; from jam.ensemble.pool import main; main({theirs.fileno()})"]
        with self._begins, theirs:
            if self._killed:
                raise WorkerDied("the pool was shut down before the worker began")
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=2, env=environment, pass_fds=[theirs.fileno()])
            worker = self._workers[threading.get_ident()] = process, ours
        return worker

    def _call(self, folders: list[str], *call: Any) -> Any:
        worker = self._workers.get(threading.get_ident())
        process, connection = self._begin() if worker is None or worker[0].poll() is not None else worker
        sent = pickle.dumps(call)  # what cannot be is an error of this call
        try:
            connection.send((folders, sent))
            done, answer, text = connection.recv()
        except Exception:  # the socket closed amid the call
            process.kill()
            status = process.wait()
            how = f"signal {signal.Signals(-status).name}" if status < 0 else f"exit status {status}"
            raise WorkerDied(f"worker {process.pid} ended by {how}") from None
        try:
            answer = pickle.loads(answer)
        except Exception as error:  # pickle writes some exceptions that it cannot read
            what = f"the call raised {text}, which" if text else f"{error}: the answer is what"
            raise RuntimeError(f"{what} pickle cannot restore") from None
        if not done:
            raise answer
        return answer


def main(descriptor: int) -> None:
    """A worker: reads calls from a socket and writes answers, until it closes."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C goes to all processes of a terminal: the campaign decides
    connection = Connection(descriptor)
    with suppress(EOFError, OSError):  # the campaign is gone: nobody reads this answer
        while True:
            connection.send(_answer(*connection.recv()))


def _answer(folders: list[str], call: bytes) -> tuple[bool, bytes, str]:
    """Whether the call ended well, the pickle of what it returned or raised, and the text of an exception."""
    sys.path += [p for p in folders if p not in sys.path]
    try:
        fn, args, kwargs = pickle.loads(call)
        return True, pickle.dumps(fn(*args, **kwargs)), ""
    except Exception as error:
        text = "".join(traceback.format_exception_only(type(error), error)).strip()
        try:
            return False, pickle.dumps(error), text
        except Exception:
            return False, b"", text
