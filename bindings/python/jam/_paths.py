"""Where files are written that appear whole or not at all."""
from __future__ import annotations

import errno
import os


def replaceable(path: str | os.PathLike[str]) -> str:
    """The regular file that a rename onto path may replace. Links are followed, so that they stay.

    Devices, pipes and folders are refused: a rename would put a file in their place.
    """
    real = os.path.realpath(os.fspath(path))
    if os.path.exists(real) and not os.path.isfile(real):
        raise OSError(errno.EINVAL, "it is no regular file", os.fspath(path))
    return real
