"""Exceptions beside those of the status codes, and the texts of all."""
from __future__ import annotations

import re

from .. import raw
from .exceptions import BY_STATUS, JamError


class ClosedError(JamError, ValueError):
    """The system was closed."""

    __module__ = "jam.errors"


class StoppedError(JamError, TimeoutError):
    """A call was stopped before it made anything: by cancel(), its progress callable or, where it makes a system, wall_time.

    The system is as before. Calls that move spheres return the report of what they reached instead.
    """

    __module__ = "jam.errors"


class StoreError(OSError):
    """A file of Python's own formats that cannot be written or read; the text names the file, the cause and what to do."""

    __module__ = "jam.errors"


#: Names of System's methods, which system.py adds: texts call C functions by them
METHODS: set[str] = set()
# Where a Python name differs from the C function's.
_NAMES = {
    "create": "System.random or System.from_arrays",
    "observe": "observing()",
    "read": "System.read",
    "read_checkpoint": "System.from_checkpoint",
    "get_crunch_report": "report",
    "set_positions": "positions",
    "set_velocities": "velocities",
}


def _in_python(text: str) -> str:
    """The library's text with its C functions under their Python names: `jam_crunch` is `crunch()`, `jam_x(sys, 2)` is `x(2)`."""

    def name(found: re.Match[str]) -> str:
        word = found.group(1)
        return _NAMES.get(word) or (f"{word}({found.group(2) or ''})" if word in METHODS else found.group(0))

    return re.sub(r"\bjam_([a-z_]+)\b(?:\(sys, ([^()]*)\))?", name, text)


def last_text() -> str:
    """Why this thread's last call of the library has not the status OK."""
    return _in_python(raw.jam_last_error())


def refused(error: BaseException) -> bool:
    """Whether this thread's last call of the library has raised an exception itself, and no callable that it called."""
    return isinstance(error, JamError) and bool(text := last_text()) and str(error).startswith(text)


def make(status: int, text: str, call: str = "") -> JamError:
    """The exception for a status; called by the raw layer with the name of its function."""
    kind = BY_STATUS.get(status, JamError)
    hint = ""
    # of calls that take it, where diameters are at fault
    if call in ("jam_create", "jam_read") and re.search("overlap|cannot fit", text) and not re.search("shrink|same centre", text):
        hint = '; overlap="shrink" in System.read and System.from_arrays scales all diameters until no pair overlaps'
    return kind(_in_python(text) + hint)
