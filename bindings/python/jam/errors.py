"""Exceptions: one class for each status below zero. All derive from JamError and from the fitting builtin."""

from ._api.shown import only
from ._api import exceptions
from ._api.errors import ClosedError, StoppedError, StoreError
from ._api.exceptions import *  # noqa: F401,F403

__all__ = ["ClosedError", "StoppedError", "StoreError"]
__all__ += exceptions.__all__
__dir__ = only(__all__)
