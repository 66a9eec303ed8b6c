"""Exceptions: one class for each status below zero. All derive from JamError and from the fitting builtin."""
from __future__ import annotations

import re

from .. import raw
from .generated import StatusCode


class JamError(Exception):
    """A call of libjam failed; the system is as it was before the call.

    status: the StatusCode. The text is the library's, with the name and value at fault.
    """

    status: StatusCode | None = None


_BUILTIN = {
    "ARGUMENT": (ValueError,),
    "DIMENSION": (ValueError,),
    "NONFINITE": (ValueError,),
    "OVERLAP": (ValueError,),
    "UNPLACEABLE": (ValueError,),
    "TOO_FEW": (ValueError,),
    "FORMAT": (ValueError,),
    "IO": (OSError,),
    "MEMORY": (MemoryError,),
    "UNSUPPORTED": (NotImplementedError,),
    "STATE": (RuntimeError,),
    "BUSY": (RuntimeError,),
}
_BY_STATUS: dict[int, type[JamError]] = {}
for _code in StatusCode:
    if _code < 0:
        _word = _code.name.removeprefix("E_")
        _name = "".join(w.capitalize() for w in _word.split("_")) + "Error"
        _class = type(
            _name,
            (JamError, *_BUILTIN.get(_word, ())),
            {"status": _code, "__module__": "jam.errors", "__doc__": f"Status JAM_{_code.name}."},
        )
        globals()[_name] = _BY_STATUS[int(_code)] = _class


def __getattr__(name: str) -> type[JamError]:
    """For programs that check types: the classes are made above, from the header's status codes."""
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


class ClosedError(JamError, ValueError):
    """The system was closed."""


class StoppedError(JamError, TimeoutError):
    """A call that makes a system was stopped by wall_time or by its progress callable, so there is none.

    Also a setter that a cancel() of another thread has ended: the system is as before.
    """


class StoreError(OSError):
    """A file of Python's own formats that cannot be written or read; the text names the file, the cause and what to do."""


_OWN: tuple[type[Exception], ...] = (JamError, ClosedError, StoppedError, StoreError)
for _class in _OWN:
    _class.__module__ = "jam.errors"  # where users find them, in texts and in pickles
__all__ = [_class.__name__ for _class in (*_OWN, *_BY_STATUS.values())]

# Where a Python name differs from the C function's.
_NAMES = {
    "create": "System.random or System.from_arrays",
    "observe": "observing()",
    "crunch_report_get": "report",
    "set_positions": "positions",
    "set_velocities": "velocities",
}


def _in_python(text: str) -> str:
    """The library's text with its C functions under their Python names: `jam_crunch` is `crunch()`."""
    from ..system import System

    def name(found: re.Match[str]) -> str:
        word = found.group(1)
        if word in _NAMES:
            return _NAMES[word]
        return f"{word}()" if callable(getattr(System, word, None)) else found.group(0)

    return re.sub(r"\bjam_([a-z_]+)\b", name, text)


def last_text() -> str:
    """Why this thread's last call of the library has not the status OK."""
    return _in_python(raw.jam_last_error())


def make(status: int, text: str) -> JamError:
    """The exception for a status; called by the raw layer."""
    kind = _BY_STATUS.get(status, JamError)
    hint = ""
    if status == StatusCode.E_OVERLAP and "shrink" not in text:
        hint = '; overlap="shrink" in System.read and System.from_arrays scales all diameters until no pair overlaps'
    return kind(_in_python(text) + hint)
