"""Exceptions: one class for each status below zero. All derive from JamError and from the fitting builtin."""
from __future__ import annotations

from ._api import errors as _errors
from ._api.errors import *  # noqa: F401,F403
from ._api.errors import JamError

__all__ = _errors.__all__


def __getattr__(name: str) -> type[JamError]:
    """For programs that check types: the classes are made from the header's status codes."""
    raise AttributeError(f"module 'jam.errors' has no attribute {name!r}")
