"""Ensembles: one protocol times many seeds, made by any concurrent.futures.Executor, one file for each packing.

    import jam
    e = jam.ensemble.Ensemble("folder", dict(n=128, dim=3))
    e.run(range(1, 101))                 # killed? run it again: what is there is not made twice
    e.table()["packing_fraction"]        # reports
    for forces, gaps in e.each("forces", "gaps"): ...   # one packing after the other, read on first use
    jam.ensemble.table("folder")         # all protocols of a folder
"""

from .._api.shown import only
from ..errors import StoreError
from .ensemble import Ensemble, protocols, table
from .pool import LocalPool, WorkerDied
from .protocol import ProtocolError, begin, complete, identity, make, minimal, packing_name, to_json
from .rows import DamagedWarning, Entry, Status

__all__ = [
    "DamagedWarning",
    "Ensemble",
    "Entry",
    "LocalPool",
    "ProtocolError",
    "Status",
    "StoreError",
    "WorkerDied",
    "begin",
    "complete",
    "identity",
    "make",
    "minimal",
    "packing_name",
    "protocols",
    "table",
    "to_json",
]
__dir__ = only(__all__)
