"""python3 -m jam: the command line of jam-pack, whose code it runs. Python adds pictures and GSD files."""
from __future__ import annotations

import os
import sys
from typing import Any

from . import raw
from ._api.calls import freeze
from ._api.generated import OPTIONS
from .errors import JamError
from .system import System

NAME = "python3 -m jam"


def _say(error: Exception) -> None:
    print(f"{NAME}: {error}", file=sys.stderr, flush=True)


def _read(path: str, options: Any) -> Any:
    """The handle of a packing in a GSD file, None after a message."""
    given = {name: getattr(options, name) for name in OPTIONS["jam_create_options"]}
    for held in ("n", "dim", "box", "packing_fraction"):  # of the file
        del given[held]
    frame = given.pop("frame")
    try:
        return System.read(path, frame=frame, **given).handle
    except (JamError, ValueError, IndexError, OSError, ImportError) as error:
        _say(error)
        return None


def main(arguments: list[str] | None = None) -> int:
    """Runs a command line, by default that of the process, and returns the exit status."""
    words = [NAME, *(sys.argv[1:] if arguments is None else arguments)]
    seen: list[Any] = []

    def progress(record: Any) -> bool:
        seen.append(freeze(record, "jam_progress"))
        return False

    def finish(handle: Any, output: str | None, picture: str | None) -> bool:
        system = System(handle)
        system.trace = seen
        try:
            if output is not None:
                system.write(output)
            if picture is not None:
                _draw(system, picture)
        except (JamError, OSError, ValueError, ImportError) as error:
            _say(error)
            return False
        return True

    sys.stdout.flush()  # C writes to the same place by a buffer of its own
    code: int = raw.pack([os.fsencode(word) for word in words], _read, finish, progress)
    return code


def _draw(system: System, path: str) -> None:
    from . import plot

    try:
        crunched = len(system.contacts) > 0
    except JamError:
        crunched = False
    figure = plot.summary(system) if crunched else plot.packing(system).figure
    figure.savefig(path, dpi=150)
