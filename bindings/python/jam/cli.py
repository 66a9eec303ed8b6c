"""python3 -m jam: the command line of jam-pack, whose code it runs. Python adds pictures and GSD files."""
from __future__ import annotations

import os
import sys
from typing import Any

from . import raw
from ._api.calls import freeze
from ._api.generated import OPTIONS, Container
from ._api.options import option_struct
from ._api.shown import only
from ._formats import gsd
from ._formats.replacing import replacing
from .errors import JamError
from .system import System

__all__ = ["main"]
__dir__ = only(__all__)

NAME = "python3 -m jam"


def _say(error: Exception) -> None:
    """For the program, which prints it."""
    raw.jam_set_error(str(error))


def _read(path: str, options: Any) -> Any:
    """The handle of a packing in a GSD file, None where it cannot be read."""
    given = {name: getattr(options, name) for name in OPTIONS["jam_create_options"]}
    for held in ("n", "dim", "box", "packing_fraction"):  # of the file
        del given[held]
    frame = given.pop("frame")
    given["container"] = Container(options.container).name.lower()
    given["walls"] = "".join(axis for c, axis in enumerate("xyz") if options.walls >> c & 1)
    try:
        made = System.read(path, frame=frame, **given)
        if options.box not in (made.box, option_struct("jam_create_options", {}).box):
            raise ValueError(f"{path}: the option box is {options.box:g}, but the file has {made.box:g}: leave the option out")
        return made.handle
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

    def check(output: str | None, picture: str | None) -> bool:
        try:
            if output is not None:
                gsd.package()
                if not gsd.is_name(output):  # with .gz behind it
                    raise ValueError(f"--output {output}: GSD files are not compressed")
            if picture is not None:
                _check_picture(picture)
        except (ImportError, ValueError) as error:
            _say(error)
            return False
        return True

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

    if sys.stdout:  # None where the descriptor is closed
        sys.stdout.flush()  # C writes to the same place by a buffer of its own
    return raw.pack([os.fsencode(word) for word in words], _read, check, finish, progress)


def _check_picture(path: str) -> None:
    from matplotlib.backend_bases import FigureCanvasBase

    known = FigureCanvasBase.get_supported_filetypes()
    if os.path.splitext(path)[1][1:].lower() not in known:
        raise ValueError(f"--plot {path}: no picture is drawn by this ending; use one of {', '.join(sorted(known))}")


def _draw(system: System, path: str) -> None:
    from . import plot

    try:
        crunched = len(system.contacts) > 0
    except JamError:
        crunched = False
    figure = plot.summary(system) if crunched else plot.packing(system).figure
    with replacing(path) as part:
        figure.savefig(part, format=os.path.splitext(path)[1][1:].lower(), dpi=150)
