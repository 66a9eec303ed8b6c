"""The system of spheres: a thin, native-feeling layer over the C handle."""
from __future__ import annotations

import os
import threading
from contextlib import contextmanager
from dataclasses import dataclass, fields
from pickle import PicklingError
from typing import Any, Callable, Iterable, Mapping, Sequence

import numpy as np

from . import _calls, errors, raw
from ._generated import CALLS, HistoryColumn, Info, MdReport, Model, ModesWhich, Progress, Report, StatusCode
from ._methods import Methods, StressStatesResult
from ._progress import reporter

TRACE_LENGTH = 200_000  # progress records kept by a system


def _text(value: Any) -> str:
    if hasattr(value, "name"):
        return value.name.lower()
    return f"{value:.12g}" if isinstance(value, float) else str(value)


def _repr(self: Any) -> str:
    width = max(len(f.name) for f in fields(self))
    lines = [f"  {f.name:{width}s}  {_text(getattr(self, f.name))}" for f in fields(self)]
    status = getattr(self, "status", None)
    head = type(self).__name__ + (f" ({status.name.lower()})" if status is not None and status != 0 else "")
    return "\n".join([head] + lines)


for _class in set(_calls.REPORTS.values()):
    _class.__repr__ = _repr  # reports print as a table
    _class.status = StatusCode.OK  # > 0: stopped early, and why; the state is valid


class _View:
    """Memory of a handle shown to numpy, read-only; keeps the handle alive as long as any array on it."""

    def __init__(self, handle: Any, address: int, shape: tuple[int, ...]) -> None:
        self._handle = handle
        self.__array_interface__ = {"version": 3, "typestr": "<f8", "shape": shape, "data": (address, True)}


class _Dispatch:
    """The progress callable of a handle for all its life: hands a record to whoever runs the call on this thread.

    Setting it anew for each call would not do: a setter is a call of its own and would use up a pending cancel.
    """

    def __init__(self) -> None:
        self._targets: dict[int, Callable] = {}

    def __call__(self, progress: Any) -> bool:
        target = self._targets.get(threading.get_ident())
        return target(progress) if target else False

    @contextmanager
    def to(self, target: Callable) -> Any:
        me = threading.get_ident()
        before = self._targets.get(me)
        self._targets[me] = target
        try:
            yield
        finally:
            if before is None:
                del self._targets[me]
            else:
                self._targets[me] = before


@dataclass(frozen=True)
class Contacts:
    """The contact network; row k of every array is the same contact.

    pairs: (contacts, 2) int32, i < j (i = j for an image of one sphere). vectors: (contacts, d), unit vectors from j
    to i. gaps: (contacts,), h = r/sigma_ij - 1. forces: (contacts,), mean 1.
    """

    pairs: np.ndarray
    vectors: np.ndarray
    gaps: np.ndarray
    forces: np.ndarray

    def __len__(self) -> int:
        return len(self.pairs)

    def __repr__(self) -> str:
        return f"Contacts({len(self)} pairs, d = {self.vectors.shape[1]})"

    def table(self) -> np.ndarray:
        """As one structured array with fields i, j, vector, gap, force."""
        d = self.vectors.shape[1]
        rows = np.empty(len(self), [("i", "i4"), ("j", "i4"), ("vector", "f8", (d,)), ("gap", "f8"), ("force", "f8")])
        rows["i"], rows["j"] = self.pairs[:, 0], self.pairs[:, 1]
        rows["vector"], rows["gap"], rows["force"] = self.vectors, self.gaps, self.forces
        return rows


@dataclass(frozen=True)
class Modes:
    """Modes of a network, ascending. values: (m,) = omega^2; nan where the solver stopped early (then status > 0).

    vectors: (m, N', d) of unit length; participation: (m,), sum |v_i|^4 / (sum |v_i|^2)^2, 1/N' to 1.
    spheres: (N',), the index of each stable sphere.
    """

    values: np.ndarray
    vectors: np.ndarray
    participation: np.ndarray
    spheres: np.ndarray
    status: StatusCode = StatusCode.OK

    @property
    def frequencies(self) -> np.ndarray:
        """(m,): omega, with round-off below zero taken as zero."""
        return np.sqrt(np.maximum(self.values, 0.0))

    def __len__(self) -> int:
        return len(self.values)

    def __repr__(self) -> str:
        w = self.frequencies
        return f"Modes({len(self)} modes of {len(self.spheres)} spheres" + (f", omega {w[0]:.4g}..{w[-1]:.4g})" if len(w) else ")")


class System(Methods):
    """N spheres in a periodic cube.

    Made by System.random, System.from_arrays or System.read; then run, compress and crunch move it, and report,
    contacts, forces, gaps, hessian and modes tell about the jammed network. Lengths are in the unit of `box`, sigma is
    a diameter, kT/m = 1. One call at a time: a second thread that calls a running system gets BusyError.
    Ctrl-C stops a running call with the state valid and raises KeyboardInterrupt.
    """

    def __init__(self, handle: Any, mk_zeta: float | None = None) -> None:
        self._handle: Any = handle
        self._mk_zeta = mk_zeta
        self._first_info: Info | None = None
        self._carried: tuple | None = None  # report and contacts that came with a pickle
        #: Progress records of this system's calls, at most one every 0.05 s
        self.trace: list[Progress] = []
        #: Status of the last call: > 0 where it stopped early or the answer is not unique
        self.status: StatusCode = StatusCode.OK
        handle._dispatch = self._dispatch = _Dispatch()  # the C side holds a borrowed reference
        raw.set_progress(handle, self._dispatch)

    # ---- making
    @classmethod
    def random(cls, n: int = 1024, dim: int = 3, seed: int = 1, *, packing_fraction: float = 0.2,
               diameters: Any = None, **options: Any) -> "System":
        """Random sequential start.

        n: number of spheres. dim: 2..8. seed: of every random stream. packing_fraction: of the start.
        diameters: None (all equal) or n values of which only the ratios count.
        options: box, model ('euclid' or 'mk'), mk_zeta.
        """
        sizes = None if diameters is None else _calls.as_array(diameters, name="diameters").reshape(-1)
        return cls._create(dict(options, n=n, dim=dim, seed=seed, packing_fraction=packing_fraction), None, sizes)

    @classmethod
    def from_arrays(cls, positions: Any, diameters: Any, box: float = 1.0, **options: Any) -> "System":
        """From positions (n, d), unit of box, wrapped into [0, box), and diameters (n,) or one number.

        Any real dtype, order and stride; what is not C-contiguous float64 is copied once.
        options: overlap ('refuse' or 'shrink'), seed, model, mk_zeta.
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
        """From a file, plain text or extended XYZ, told by its content. options: box, overlap, seed, model, mk_zeta."""
        made = _calls.options("jam_create_options", options)
        return cls(raw.jam_read(os.fspath(path), made)[1], options.get("mk_zeta"))

    @classmethod
    def _create(cls, options: dict, positions: Any, diameters: Any) -> "System":
        made = _calls.options("jam_create_options", options)
        return cls(raw.jam_create(made, positions, diameters)[1], options.get("mk_zeta"))

    # ---- life
    @property
    def handle(self) -> Any:
        """The C handle, for jam.raw."""
        if self._handle is None:
            raise errors.ClosedError("the system is closed")
        return self._handle

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
        made = System(raw.jam_copy(self.handle)[1], self._mk_zeta)
        made.trace, made._carried = list(self.trace), self._carried
        return made

    __copy__ = copy

    def __deepcopy__(self, memo: dict) -> "System":
        return self.copy()

    def __reduce__(self) -> tuple:
        info = self.info
        if info.model == Model.MK:  # re-drawn pairs of a planted start are known to the handle alone
            raise PicklingError("a Mari-Kurchan system cannot be pickled: its shifts are not part of the arrays; use copy()")
        options = {"box": info.box, "seed": info.seed, "model": int(info.model), "mk_zeta": self._mk_zeta}
        velocities = self.velocities.copy()
        return _restore, (self.positions.copy(), self.diameters.copy(), velocities if velocities.any() else None, options,
                          self._results(), self.trace)

    def _results(self) -> tuple | None:
        try:
            return self.report, self.contacts
        except errors.JamError:
            return None

    def __repr__(self) -> str:
        if self._handle is None:
            return "System(closed)"
        i = self.info
        return f"System(n={i.n}, dim={i.dim}, packing_fraction={i.packing_fraction:.8g}, box={i.box:g}, seed={i.seed})"

    def __len__(self) -> int:
        return self.n

    # ---- state
    @property
    def info(self) -> Info:
        """What the system is now."""
        made = _calls.new_report("jam_info")
        raw.jam_info_get(self.handle, made)
        return _calls.freeze(made, "jam_info")

    n = property(lambda self: self._constant("n"), doc="Number of spheres.")
    dim = property(lambda self: self._constant("dim"), doc="Dimension d.")
    box = property(lambda self: self._constant("box"), doc="Side of the cube.")
    seed = property(lambda self: self._constant("seed"), doc="Seed recorded at creation.")
    packing_fraction = property(lambda self: self.info.packing_fraction, doc="Volume of the spheres over that of the box.")
    pressure = property(lambda self: self.info.pressure, doc="Reduced pressure last measured by MD, nan before.")

    def _constant(self, name: str) -> Any:
        """What cannot change in the life of a handle: info sums over all spheres each time."""
        self.handle
        if self._first_info is None:
            self._first_info = self.info
        return getattr(self._first_info, name)

    def _show(self, function: Callable, flat: bool = False) -> np.ndarray:
        handle = self.handle
        _, (address, count) = function(handle)
        n = raw.jam_diameters_view(handle)[1][1]
        return np.asarray(_View(handle, address, (n,) if flat else (n, count // n)))

    @property
    def positions(self) -> np.ndarray:
        """(n, d) in [0, box): a read-only view without copy that follows the system and keeps it alive."""
        return self._show(raw.jam_positions_view)

    @positions.setter
    def positions(self, values: Any) -> None:
        self._set(raw.jam_set_positions, values, "positions")

    @property
    def velocities(self) -> np.ndarray:
        """(n, d), kT/m = 1: read-only view; zero until the first MD call."""
        return self._show(raw.jam_velocities_view)

    @velocities.setter
    def velocities(self, values: Any) -> None:
        self._set(raw.jam_set_velocities, values, "velocities")

    def _set(self, function: Callable, values: Any, name: str) -> None:
        x = _calls.as_array(values, name=name)
        shape = self._show(raw.jam_positions_view).shape
        if x.shape != shape:
            raise ValueError(f"{name} must have shape {shape}, not {x.shape}")
        function(self.handle, x.reshape(-1))
        self._carried = None

    @property
    def diameters(self) -> np.ndarray:
        """(n,), unit of box: read-only view."""
        return self._show(raw.jam_diameters_view, flat=True)

    def scale_diameters(self, factor: float) -> None:
        """Multiplies all diameters."""
        raw.jam_scale_diameters(self.handle, float(factor))
        self._carried = None

    # ---- verbs
    def _recorder(self, user: Callable | None) -> Callable:
        def on_progress(p: Any) -> bool:
            record = _calls.freeze(p, "jam_progress")
            if len(self.trace) < TRACE_LENGTH:
                self.trace.append(record)
            return bool(user(record)) if user else False
        return on_progress

    def _verb(self, name: str, struct: str, report: str, progress: Any, options: Mapping[str, Any] | None) -> Any:
        handle, user = self.handle, reporter(progress)
        chosen = None if options is None else _calls.options(struct, dict(options))
        made = _calls.new_report(report)

        with self._dispatch.to(self._recorder(user)):
            try:
                status = getattr(raw, name)(handle, chosen, made)
            finally:
                if hasattr(user, "close"):
                    user.close()
        self._carried = None
        frozen = _calls.freeze(made, report)
        self.status = StatusCode(status)
        object.__setattr__(frozen, "status", self.status)
        return frozen

    def run(self, collisions_per_particle: float | None = None, *, progress: Any = None, **options: Any) -> MdReport:
        """Event-driven NVE dynamics. Returns an MdReport; report.status > 0 says that it stopped early."""
        return self._verb("jam_run", "jam_run_options", "jam_md_report", progress,
                          dict(options, collisions_per_particle=collisions_per_particle))

    def compress(self, stages: Iterable[Mapping[str, float] | Sequence[float]] | None = None, *, progress: Any = None,
                 **options: Any) -> MdReport:
        """Lubachevsky-Stillinger compression. Without arguments: the two-stage protocol that avoids crystals.

        stages: a sequence of {option: value} or (growth_rate, pressure), run one after the other, each on top of
        **options; a stage that stops early ends the sequence. Returns the MdReport of the last stage run.
        """
        if stages is None:
            return self._verb("jam_compress", "jam_compress_options", "jam_md_report", progress, options or None)
        report = None
        for stage in stages:
            given = dict(stage) if isinstance(stage, Mapping) else dict(zip(("growth_rate", "pressure"), stage))
            report = self._verb("jam_compress", "jam_compress_options", "jam_md_report", progress, {**options, **given})
            if report.status > 0:
                break
        if report is None:
            raise ValueError("stages is empty")
        return report

    def crunch(self, *, progress: Any = None, **options: Any) -> Report:
        """Iterated linear programming down to the jamming point. Returns the Report with the certificate."""
        return self._verb("jam_crunch", "jam_crunch_options", "jam_report", progress, options or None)

    def cancel(self) -> None:
        """Stops the call that runs on this system in another thread; without one, the next call."""
        raw.jam_cancel(self.handle)

    def log(self, callback: Callable[[int, str], Any] | None, level: int | str = "info") -> None:
        """Sends the library's log lines of up to this level to callback(level, line); None silences it."""
        handle = self.handle
        raw.set_log(handle, callback, _calls.as_enum(level, "LogLevel"))
        handle._log = callback  # the C side holds a borrowed reference

    # ---- the network
    @property
    def report(self) -> Report:
        """Report and certificate of the last crunch."""
        if self._carried:
            return self._carried[0]
        made = _calls.new_report("jam_report")
        raw.jam_report_get(self.handle, made)
        return _calls.freeze(made, "jam_report")

    @property
    def history(self) -> np.ndarray:
        """Steps of the last crunch as a structured array: one field for each HistoryColumn, in lower case."""
        columns = [self.call("crunch_history", int(c)) for c in HistoryColumn]
        rows = np.empty(len(columns[0]), [(c.name.lower(), "f8") for c in HistoryColumn])
        for c, values in zip(HistoryColumn, columns):
            rows[c.name.lower()] = values
        return rows

    @property
    def contacts(self) -> Contacts:
        """Pairs, unit vectors, gaps and forces of the contacts, as copies."""
        if self._carried:
            return self._carried[1]
        return Contacts(self.call("contacts"), self.call("contact_vectors"),
                        self.call("contact_gaps"), self.call("forces"))

    @property
    def forces(self) -> np.ndarray:
        """(contacts,), mean 1; times report.force_scale they are lambda r."""
        return self._carried[1].forces if self._carried else self.call("forces")

    @property
    def coordination(self) -> np.ndarray:
        """(n,) int32: contacts of each sphere, 0 for rattlers."""
        if self._carried:
            return np.bincount(self._carried[1].pairs.reshape(-1), minlength=self.n).astype(np.int32)
        return self.call("coordination")

    @property
    def rattlers(self) -> np.ndarray:
        """(n,) bool."""
        return self.coordination == 0

    @property
    def bucklers(self) -> np.ndarray:
        """(n,) bool: spheres with exactly d + 1 contacts."""
        return self.coordination == self.dim + 1

    # ---- stiffness and modes
    def hessian(self, stiffness: int | str = "harmonic", **options: Any) -> Any:
        """Hessian of the contact network as scipy.sparse.csr_matrix (d N', d N'), unit: stiffness at the mean force.

        Row d k + c is component c of sphere hessian_map()[k]; rattlers are left out.
        stiffness: 'harmonic', 'power' (with alpha) or 'hard'. options: alpha, prestress.
        """
        from scipy.sparse import csr_matrix
        chosen = _calls.options("jam_hessian_options", dict(options, stiffness=stiffness))
        size = self.dim * len(self.call("hessian_map"))
        count = raw.jam_hessian(self.handle, chosen, None, None, None)[1]
        start, column, value = np.empty(size + 1, np.int32), np.empty(count, np.int32), np.empty(count)
        raw.jam_hessian(self.handle, chosen, start, column, value)
        return csr_matrix((value, column, start), shape=(size, size))

    def modes(self, k: int = 10, which: int | str = "lowest", stiffness: int | str = "harmonic", *, progress: Any = None,
              alpha: float | None = None, prestress: float | None = None, **options: Any) -> "Modes":
        """Vibrational modes of the network. k: how many. which: 'lowest', 'highest', 'near' (with frequency), 'all'.

        progress: as in crunch. options: frequency, tolerance, memory_limit.
        """
        handle, user = self.handle, reporter(progress)
        h = _calls.options("jam_hessian_options", {"stiffness": stiffness, "alpha": alpha, "prestress": prestress})
        o = _calls.options("jam_modes_options", dict(options, which=which, count=k))
        spheres = self.call("hessian_map")
        m = min(k, self.dim * len(spheres)) if _calls.as_enum(which, "ModesWhich") != ModesWhich.ALL else self.dim * len(spheres)
        values, vectors = np.empty(m), np.empty((m, len(spheres), self.dim))
        participation = np.empty(m)
        with self._dispatch.to(self._recorder(user)):
            status, m = raw.jam_modes(handle, h, o, values, vectors.reshape(-1), participation)
        return Modes(values[:m], vectors[:m], participation[:m], spheres, StatusCode(status))

    # ---- files and everything else
    def write(self, path: str | os.PathLike, format: int | str = "auto") -> None:
        """Writes the packing, 17 digits: 'plain' or 'xyz' (extended XYZ); 'auto' goes by the name."""
        raw.jam_write(self.handle, os.fspath(path), _calls.as_enum(format, "Format"))

    def call(self, name: str, *args: Any, progress: Any = None, **named: Any) -> Any:
        """Calls the C function jam_<name> on this system by the header's conventions.

        Inputs by position or keyword, members of option structs by keyword; arrays of any real dtype. Outputs are
        returned: an array, a number, a report, or a named tuple of them. self.status holds the StatusCode.
        """
        handle, user = self.handle, reporter(progress)
        with self._dispatch.to(self._recorder(user)):
            try:
                self.status, result = _calls.invoke(handle, self.dim, name, args, named)
            finally:
                if hasattr(user, "close"):
                    user.close()
        if CALLS["jam_" + name][1] and name in _MOVERS:
            self._carried = None
        return result

    def stress_states(self, *, progress: Any = None) -> StressStatesResult:
        """States of self-stress from positions alone: force (contacts,), basis (m, contacts), residual."""
        handle, contacts = self.handle, self.report.contacts
        with self._dispatch.to(self._recorder(reporter(progress))):
            m = raw.jam_stress_states(handle, None, None)[-1]
            force, basis = np.empty(contacts if m else 0), np.empty((m, contacts))
            status, residual, _ = raw.jam_stress_states(handle, force, basis.reshape(-1))
        self.status = StatusCode(status)
        return StressStatesResult(force, basis, residual)


def _restore(positions: Any, diameters: Any, velocities: Any, options: dict, results: Any, trace: list) -> System:
    made = System.from_arrays(positions, diameters, **options)
    if velocities is not None:
        made.velocities = velocities
    made._carried, made.trace = results, trace
    return made


_MOVERS = {"set_positions", "set_velocities", "scale_diameters", "contacts_from_geometry"}


for _verb, _struct in (("run", "run"), ("compress", "compress"), ("crunch", "crunch")):
    getattr(System, _verb).__doc__ += (
        "\n\n        progress: True for a bar, or a callable(Progress) whose true answer stops the call.\n        Options:\n    "
        + _calls.describe(f"jam_{_struct}_options").replace("\n", "\n    ") + "\n        ")
