"""jam: jammed packings of hard spheres, made and analysed.

    import jam
    packing = jam.System.random(n=1024, dim=3, seed=1)
    packing.compress()            # event-driven molecular dynamics with growth
    print(packing.crunch())       # to the jamming point
    packing.contacts.forces       # numpy
    jam.plot.packing(packing)     # matplotlib, loaded when it is used

Arrays of shape (n, d) and indices from 0. Errors are subclasses of jam.JamError; jam.raw has the C functions.
"""
from __future__ import annotations

import typing
from typing import Any

from ._built_for import refuse_another_python
from ._interrupted import end_in_one_line

end_in_one_line()
refuse_another_python()

from . import errors as errors, raw as raw
from ._api.generated import *  # noqa: F401,F403  enums and report dataclasses
from ._api.equations import EosForm as EosForm, Glass as Glass, eos as eos, glass_fit as glass_fit
from ._api.generated import JAM_ABI, StatusCode as StatusCode
from .advice import Advice as Advice, advise as advise
from ._api.size_laws import size_report as size_report, sizes as sizes
from .errors import JamError as JamError
from ._system.observe import Observed as Observed, Step as Step
from .system import Contacts as Contacts, Modes as Modes, System as System

__version__ = raw.jam_version()
if raw.jam_abi_version() != JAM_ABI:
    raise ImportError(
        f"jam was built for ABI {JAM_ABI} of libjam, the library that was found has {raw.jam_abi_version()}"
    )

if typing.TYPE_CHECKING:  # what __getattr__ imports when it is used
    from . import cli as cli, digits as digits, ensemble as ensemble, files as files, near_jamming as near_jamming, plot as plot
    from . import radii as radii
    from . import scaling as scaling, statistics as statistics, store as store
    from .store import load as load

_LAZY = ("plot", "files", "cli", "digits", "ensemble", "near_jamming", "radii", "scaling", "statistics", "store")


def __getattr__(name: str) -> Any:
    if name in _LAZY:
        import importlib

        return importlib.import_module("." + name, __name__)
    if name == "load":
        from .store import load

        return load
    raise AttributeError(f"module 'jam' has no attribute {name!r}")


def __dir__() -> list[str]:
    own = {name for name, value in globals().items() if not name.startswith("_") and _is_ours(value)}
    return sorted(own | set(_LAZY) | {"__version__", "errors", "load", "raw"})


def _is_ours(value: Any) -> bool:
    """Leaves out what this module imported for itself: typing's names, helpers of the generated code."""
    return getattr(value, "__module__", "").split(".")[0] == "jam" or isinstance(value, (int, str))
