"""The base of a System: the C handle, views of its memory, and the route of its progress records."""
from __future__ import annotations

import threading
from contextlib import contextmanager
from typing import Any, Callable

import numpy as np

from .. import errors, raw
from .._api.calls import finished, freeze, invoke
from .._api.errors import last_text, refused
from .._api.generated import Info, Progress, Report, StatusCode
from .methods import Methods
from .progress import end, reporter

TRACE_LENGTH = 200_000  # progress records kept by a system
_DOUBLE = np.dtype(np.float64).str  # in the byte order of this machine


class _View:
    """Read-only memory of a handle for numpy. It keeps the handle alive as long as an array uses it."""

    def __init__(self, handle: Any, address: int, shape: tuple[int, ...]) -> None:
        self._handle = handle
        self.__array_interface__ = {"version": 3, "typestr": _DOUBLE, "shape": shape, "data": (address, True)}


class _Dispatch:
    """The progress callable of a handle. It passes a record to the caller on the same thread.

    It is set once, because a setter is a call of its own and would use up a pending cancel.
    """

    def __init__(self) -> None:
        self._targets: dict[int, Callable[..., Any]] = {}

    def __call__(self, progress: Any) -> bool:
        target = self._targets.get(threading.get_ident())
        return target(progress) if target else False

    @contextmanager
    def to(self, target: Callable[..., Any]) -> Any:
        me = threading.get_ident()
        before = self._targets.get(me)
        self._targets[me] = target
        try:
            yield
        finally:
            if before is None:
                del self._targets[me]
            else:
                self._targets[me] = before


class Base(Methods):
    """The handle of a system, and the reports of its calls."""

    @property
    def n(self) -> int:
        """Number of spheres."""
        raise NotImplementedError

    @property
    def dim(self) -> int:
        """Dimension d."""
        raise NotImplementedError

    def copy(self) -> Any:
        """A packing of its own: what reads several parts of one reads them there, as no other thread moves it."""
        raise NotImplementedError

    def __init__(self, handle: Any) -> None:
        self._handle: Any = handle
        self._first_info: Info | None = None
        #: Calls that moved the spheres: verb, options (every one), status and stop reason of each
        self.calls: list[dict[str, Any]] = []
        #: Progress records of this system's calls, at most one every 0.05 s
        self.trace: list[Progress] = []
        #: Status of the last call, also of one that raised: > 0 where it stopped early or the answer is not unique.
        #: Reading a property leaves it as it is
        self.status: StatusCode = StatusCode.OK
        #: Why, in a sentence; "" for status OK
        self.status_text = ""
        self._dispatch = _Dispatch()
        raw.set_progress(handle, self._dispatch)

    @property
    def handle(self) -> Any:
        """The C handle, for jam.raw."""
        if self._handle is None:
            raise errors.ClosedError("the system is closed")
        return self._handle

    def _recorder(self, user: Callable[..., Any] | None) -> Callable[..., Any]:
        def on_progress(p: Any) -> bool:
            record = freeze(p, "jam_progress")
            if len(self.trace) < TRACE_LENGTH:
                self.trace.append(record)
            return bool(user(record)) if user else False

        return on_progress

    @contextmanager
    def _reporting(self, progress: Any) -> Any:
        """Sends progress records of the calls inside to the trace and to the caller's callable. Keeps the status of an exception."""
        user = reporter(progress)
        with self._failing(), self._dispatch.to(self._recorder(user)):
            try:
                yield
            finally:
                end(user)

    @contextmanager
    def _failing(self) -> Any:
        """Keeps the status and the text of the call inside where it ends by an exception."""
        raw.jam_set_error("")
        try:
            yield
        except BaseException as error:
            text = last_text()
            if isinstance(error, errors.JamError) and error.status is not None and (refused(error) or not text):
                self.status, self.status_text = error.status, str(error)
            elif text:  # Ctrl-C, an exception of a callable or cancel() has stopped the library
                self.status, self.status_text = StatusCode.CANCELLED, text
            elif isinstance(error, Exception):  # the library was not called
                self.status, self.status_text = StatusCode.E_ARGUMENT, str(error)
            raise

    def _done(self, work: Callable[[], Any]) -> None:
        """A call of the library that returns nothing."""
        with self._failing():
            finished(work())
            self._note(StatusCode.OK)

    def call(self, name: str, *args: Any, progress: Any = None, **named: Any) -> Any:
        """Calls the C function jam_<name> on this system by the header's conventions.

        Inputs by position or keyword, members of option structs by keyword; arrays of any real dtype. Outputs are
        returned: an array, a number, a report, or a named tuple of them. self.status holds the StatusCode, and
        self.status_text says why it is not OK.
        """
        handle = self.handle
        with self._reporting(progress):
            status, result = invoke(handle, self.dim, name, args, named)
            self._note(status, result)
        return result

    def _ask(self, name: str, *args: Any) -> Any:
        """What call() returns, for properties: the status of the last call stays."""
        return invoke(self.handle, self.dim, name, args, {})[1]

    def _note(self, status: int, report: Any = None) -> None:
        """Keeps the status of a call that has just returned, on this thread, and writes it on its report."""
        self.status = StatusCode(status)
        self.status_text = last_text() if status else ""
        if isinstance(report, Report):
            object.__setattr__(report, "status", self.status)
            object.__setattr__(report, "status_text", self.status_text)
