"""Worker processes of this machine as a concurrent.futures.Executor.

The pool of processes in the standard library cannot be used after one of its workers was killed, and does not say which call
that worker ran. Here each thread of a pool of threads has a worker process of its own behind a pair of pipes: a killed worker
fails one call, and the next call gets a new worker. A worker ends when its pipe closes, so none outlives a killed campaign.
Workers import jam and not the user's script, which therefore needs no `if __name__ == "__main__"`.

The folder that a program is called in may belong to anybody, and a file there may have the name of a module: workers import
nothing from it. A callable of another package than jam brings the folders along that the caller imports from; they come
behind all others, so that they hide nothing.
"""
from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import threading
from concurrent.futures import Future, ThreadPoolExecutor
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
        self._workers: dict[int, subprocess.Popen[bytes]] = {}  # by thread
        self._begins, self._killed = threading.Lock(), False

    @property
    def pids(self) -> list[int]:
        """Process ids of the workers that live now."""
        return [p.pid for p in list(self._workers.values()) if p.poll() is None]

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Calls fn in a worker; fn is found there by its module and name, arguments and answer go by pickle."""
        return super().submit(self._call, pickle.dumps((_folders_for(fn), pickle.dumps((fn, args, kwargs)))))

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Ends the pool. With cancel_futures also the calls that run now: their workers are killed."""
        super().shutdown(wait=False, cancel_futures=cancel_futures)
        if cancel_futures:
            with self._begins:
                self._killed = True
                for process in self._workers.values():
                    process.kill()
        super().shutdown(wait=wait)
        if wait:
            for process in self._workers.values():
                _end(process)

    def __exit__(self, kind: Any, *_: Any) -> None:
        """After an exception, packings under way are dropped and their workers killed."""
        self.shutdown(cancel_futures=kind is not None)

    def _begin(self) -> subprocess.Popen[bytes]:
        home = str(Path(__file__).resolve().parents[2])
        paths = [home] + [p for p in os.environ.get("PYTHONPATH", "").split(os.pathsep) if p and p != home]
        environment = dict(os.environ, PYTHONPATH=os.pathsep.join(paths), OPENBLAS_NUM_THREADS="1")
        command = [sys.executable, "-c", f"{_OWN_PATH}; from jam.ensemble.pool import main; main()"]
        with self._begins:
            if self._killed:
                raise WorkerDied("the pool was shut down before the worker began")
            process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment)
            self._workers[threading.get_ident()] = process
        return process

    def _call(self, call: bytes) -> Any:
        process = self._workers.get(threading.get_ident())
        if process is None or process.poll() is not None:
            process = self._begin()
        try:
            assert process.stdin and process.stdout  # both are pipes
            process.stdin.write(call)
            process.stdin.flush()
            done, answer = pickle.load(process.stdout)
        except Exception:  # the pipe closed amid the call
            process.kill()
            status = _end(process)
            how = f"signal {signal.Signals(-status).name}" if status < 0 else f"exit status {status}"
            raise WorkerDied(f"worker {process.pid} ended by {how}") from None
        if not done:
            raise answer
        return answer


def _folders_for(fn: Callable[..., Any]) -> list[str]:
    """Where a worker may search for the module of a callable, beside its own path."""
    package = str(getattr(fn, "__module__", None)).partition(".")[0]
    return [] if package in ("jam", "builtins") else [os.path.abspath(p) for p in sys.path]


def _end(process: subprocess.Popen[bytes]) -> int:
    """Closes the pipes, waits for the worker and returns its exit status."""
    assert process.stdin and process.stdout  # both are pipes
    try:
        process.stdin.close()
    except OSError:
        pass  # what was left in the buffer has no reader
    process.stdout.close()
    return process.wait()


def main() -> None:
    """A worker: reads calls from its standard input and writes answers, until the pipe closes."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C goes to all processes of a terminal: the campaign decides
    calls, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a library prints must not get between the answers
    while True:
        try:
            folders, call = pickle.load(calls)
        except EOFError:
            return
        try:
            answers.write(_answer(folders, call))
            answers.flush()
        except BrokenPipeError:
            os._exit(1)  # the campaign is gone: nobody reads this answer


def _answer(folders: list[str], call: bytes) -> bytes:
    """Whether the call ended well, and what it returned or raised."""
    sys.path += [p for p in folders if p not in sys.path]
    try:
        fn, args, kwargs = pickle.loads(call)
        return pickle.dumps((True, fn(*args, **kwargs)))
    except Exception as error:
        try:
            return pickle.dumps((False, error))
        except Exception:
            return pickle.dumps((False, RuntimeError(f"the answer cannot be sent: {error}")))
