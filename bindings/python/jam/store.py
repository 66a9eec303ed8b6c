"""One packing, one HDF5 file: save, load, and files of many packings. _formats/write_packing.py has the layout."""
from __future__ import annotations

import json
import os

from ._api.shown import only
from ._formats.seal import damaged, read_packing, refusing
from ._formats.write_packing import image, provenance, save, write_shard
from .errors import JamError, StoreError
from .system import System, restore

__all__ = ["StoreError", "image", "load", "provenance", "save", "write_shard"]
__dir__ = only(__all__)


def load(
    path: str | os.PathLike[str],
    name: str | None = None,
    *,
    memory_limit: float | None = None,
) -> System:
    """A packing from a file of save(), of an ensemble, or, by its name, from a shard of Ensemble.export.

    It has its contact network, report and history, so that all calls work as on the system that was saved.

    Parameters
    ----------
    name : str, optional
        Of the packing in a shard.
    memory_limit : float, optional
        Bytes of the largest packing that is read; default a quarter of the machine's memory.

    Raises
    ------
    StoreError
        The file is not there, is damaged, was changed since it was written, or contains no packing. The text names it.
    """
    packing = read_packing(path, name, None if memory_limit is None else float(memory_limit))
    with refusing(path):
        calls, stored = json.loads(packing.get("jam/calls")), packing.arrays
        if not (isinstance(calls, list) and all(isinstance(c, dict) for c in calls)):
            raise ValueError("jam/calls is not a list of calls")
        for record, dimensions in (("jam/report", 0), ("jam/history", 1)):
            if record in stored and not (stored[record].dtype.names and stored[record].ndim == dimensions):
                raise ValueError(f"{record} is {stored[record].dtype}, not a record")
        try:
            made = restore(stored["jam/state"].tobytes(), calls, [])
            same = {"particles/spheres/position/value": made.positions[None], "jam/diameters": made.diameters}
            if "jam/contacts/pairs" in stored:
                same.update({"jam/contacts/" + part: value for part, value in vars(made.contacts).items()})
        except JamError as error:
            if isinstance(error, MemoryError):
                raise
            raise damaged(path, f"jam/state: {error}") from error
        for part, value in same.items():
            if (stored[part].dtype, stored[part].shape, stored[part].tobytes()) != (value.dtype, value.shape, value.tobytes()):
                raise damaged(path, f"{part} is not that of jam/state")
        return made
