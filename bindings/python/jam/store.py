"""One packing, one HDF5 file: save, load, and files of many packings. _formats/write_packing.py has the layout."""
from __future__ import annotations

import json
import os

import numpy as np

from ._api.shown import only
from ._formats.content import damaged, refusing
from ._formats.provenance import provenance
from ._formats.sealed import read_packing
from ._formats.shard import write_shard
from ._formats.write_packing import image, save
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
        Bytes of the largest file that is read; default a quarter of the machine's memory.

    Raises
    ------
    StoreError
        The file is not there, is damaged, was changed since it was written, or contains no packing. The text names it.
    """
    packing = read_packing(path, name, memory_limit)
    with refusing(path):
        sizes = packing.array("jam/diameters", "f8", -1)
        n = len(sizes)
        places = packing.array("particles/spheres/position/value", "f8", 1, n, -1)
        calls = json.loads(packing.get("jam/calls"))
        if not (isinstance(calls, list) and all(isinstance(c, dict) for c in calls)):
            raise ValueError("jam/calls is not a list of calls")
        packing.check_record("jam/report")
        packing.check_record("jam/history", -1)
        contacts = packing.contacts(n, places.shape[2])
        try:
            made = restore(packing.arrays["jam/state"].tobytes(), calls, [])
            same = contacts is None or contacts.table().tobytes() == made.contacts.table().tobytes()
        except JamError as error:
            if isinstance(error, MemoryError):
                raise
            raise damaged(path, f"jam/state: {error}") from error
        if not (np.array_equal(made.positions, places[0]) and np.array_equal(made.diameters, sizes)):
            raise damaged(path, "positions or diameters are not those of jam/state")
        if not same:
            raise damaged(path, "contacts are not those of jam/state")
        return made
