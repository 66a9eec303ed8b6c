"""A file that only passes bytes to libjam or from it: in memory where the system has such files (Linux), else on the disk.

On a disk libjam waits until the bytes are written: 14 ms for a packing that needs 0.2 ms to copy.
"""
from __future__ import annotations

import os
import tempfile
from contextlib import contextmanager
from pathlib import Path
from typing import Iterator

from ..errors import JamError


@contextmanager
def passing_file() -> Iterator[Path]:
    """The path of an empty file; the file goes with the block, and no error names it."""
    try:
        number = os.memfd_create("jam")
    except (AttributeError, OSError):  # another system, or an old kernel
        number = -1
    path = Path(f"/dev/fd/{number}")
    try:
        if number >= 0 and path.exists():
            yield path
        else:
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder, "state")
                yield path
    except JamError as error:
        raise type(error)(str(error).replace(str(path), "the state of the system")) from None
    finally:
        if number >= 0:
            os.close(number)
