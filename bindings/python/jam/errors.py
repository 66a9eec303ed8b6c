"""Exceptions: one class for each status below zero, all derived from JamError and from the fitting builtin."""
from __future__ import annotations

from ._generated import StatusCode


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
            {"status": _code, "__module__": __name__, "__doc__": f"Status JAM_{_code.name}."},
        )
        globals()[_name] = _BY_STATUS[int(_code)] = _class


class ClosedError(JamError, ValueError):
    """The system was closed."""


def make(status: int, text: str) -> JamError:
    """The exception for a status; called by the raw layer."""
    return _BY_STATUS.get(status, JamError)(text)
