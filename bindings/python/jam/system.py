"""The system of spheres: a thin, native-feeling layer over the C handle."""
from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import Any

from . import _calls, errors, raw
from ._network import Network
from ._state import State
from ._verbs import Verbs
from .results import Contacts, Modes

__all__ = ["Contacts", "Modes", "System"]


class System(State, Verbs, Network):
    """N spheres in a periodic cube.

    Made by System.random, System.from_arrays or System.read; then run, compress and crunch move it, and report,
    contacts, forces, gaps, hessian and modes tell about the jammed network. Lengths are in the unit of `box`, sigma is
    a diameter, kT/m = 1. One call at a time: a second thread that calls a running system gets BusyError.
    Ctrl-C stops a running call with the state valid and raises KeyboardInterrupt.
    """

    # ---- making
    @classmethod
    def random(
        cls,
        n: int = 1024,
        dim: int = 3,
        seed: int = 1,
        *,
        packing_fraction: float = 0.2,
        diameters: Any = None,
        **options: Any,
    ) -> "System":
        """Random sequential start.

        n: number of spheres. dim: 2..8. seed: of every random stream. packing_fraction: of the start.
        diameters: None (all equal) or n values of which only the ratios count.
        options: box, model ('euclid' or 'mk'), mk_zeta, masses, non_additivity.
        """
        sizes = None if diameters is None else _calls.as_array(diameters, name="diameters").reshape(-1)
        return cls._create(dict(options, n=n, dim=dim, seed=seed, packing_fraction=packing_fraction), None, sizes)

    @classmethod
    def from_arrays(cls, positions: Any, diameters: Any, box: float = 1.0, **options: Any) -> "System":
        """From positions (n, d), unit of box, wrapped into [0, box), and diameters (n,) or one number.

        Any real dtype, order and stride; what is not C-contiguous float64 is copied once.
        options: overlap ('refuse' or 'shrink'), seed, model, mk_zeta, masses, non_additivity.
        """
        x = _calls.as_array(positions, name="positions")
        if x.ndim != 2:
            raise ValueError(f"positions must have shape (n, d), not {x.shape}")
        sizes = _calls.as_array(diameters, name="diameters")
        if sizes.ndim > 1 or sizes.size not in (1, len(x)):
            raise ValueError(f"diameters must be one number or have shape ({len(x)},), not {sizes.shape}")
        return cls._create(dict(options, n=len(x), dim=x.shape[1], box=box), x.reshape(-1), sizes.reshape(-1))

    @classmethod
    def read(cls, path: str | os.PathLike, **options: Any) -> "System":
        """From a file, plain text or extended XYZ, told by its content. options: box, overlap, seed, model, mk_zeta,
        masses, non_additivity; what the file holds wins."""
        made = _calls.options("jam_create_options", options)
        return cls(raw.jam_read(os.fspath(path), made)[1])

    @classmethod
    def from_checkpoint(cls, path: str | os.PathLike) -> "System":
        """From a file of checkpoint_write: dynamics go on to the same bits as if they had never stopped."""
        return cls(raw.jam_checkpoint_read(os.fspath(path))[1])

    @classmethod
    def _create(cls, options: dict, positions: Any, diameters: Any) -> "System":
        made = _calls.options("jam_create_options", options)
        return cls(raw.jam_create(made, positions, diameters)[1])

    # ---- life
    def close(self) -> None:
        """Frees the system, as soon as no array shows its memory any more. Any other use is then a ClosedError."""
        self._handle = None

    def __enter__(self) -> "System":
        self.handle
        return self

    def __exit__(self, *exc: Any) -> None:
        self.close()

    def copy(self) -> "System":
        """Deep copy with its results."""
        made = System(raw.jam_copy(self.handle)[1])
        made.trace, made.calls, made._carried = list(self.trace), list(self.calls), self._carried
        return made

    __copy__ = copy

    def __deepcopy__(self, memo: dict) -> "System":
        return self.copy()

    def __reduce__(self) -> tuple:
        with tempfile.TemporaryDirectory() as folder:  # the checkpoint alone holds all: velocities, Mari-Kurchan shifts
            file = Path(folder, "state")
            self.checkpoint_write(str(file))
            return _restore, (file.read_bytes(), self._results(), self.calls, self.trace)

    def _results(self) -> tuple | None:
        found: list[Any] = []
        for name in ("report", "contacts", "history"):
            try:
                found.append(getattr(self, name))
            except errors.StateError:
                found.append(None)
        return tuple(found) if found[1] is not None or found[0] is not None else None

    def __repr__(self) -> str:
        if self._handle is None:
            return "System(closed)"
        i = self.info
        return f"System(n={i.n}, dim={i.dim}, packing_fraction={i.packing_fraction:.8g}, box={i.box:g}, seed={i.seed})"

    def __len__(self) -> int:
        return self.n

    # ---- files
    def write(self, path: str | os.PathLike, format: int | str = "auto") -> None:
        """Writes the packing, 17 digits: 'plain' or 'xyz' (extended XYZ); 'auto' goes by the name."""
        raw.jam_write(self.handle, os.fspath(path), _calls.as_enum(format, "Format"))

    def save(self, path: str | os.PathLike) -> None:
        """Writes the packing with all its results to one HDF5 file, which jam.load reads (needs python3-h5py).

        Stored are the state that dynamics go on from, report, contacts, forces, history, the calls made with their
        options, and where it was made. Positions and box have the layout of H5MD.
        """
        from . import store

        store.save(self, path)


def _restore(state: bytes, results: tuple | None, calls: list, trace: list) -> System:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "state")
        file.write_bytes(state)
        made = System.from_checkpoint(file)
    made._carried, made.calls, made.trace = results, calls, trace
    return made
