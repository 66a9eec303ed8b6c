"""Isoconfigurational runs: their sums, files, and campaigns that go on after a kill. Public as jam.near_jamming."""
from __future__ import annotations

import hashlib
import json
import os
import struct
import zipfile
import zlib
from dataclasses import dataclass, field, fields, replace
from typing import Any, Sequence

import numpy as np

from .. import raw
from .._api.arrays import Array, as_array, as_vector
from .._api.calls import same
from .._api.generated import IsoconfColumn, StatusCode
from .._api.options import number, option_struct
from .._formats.replacing import open_regular, replacing, require_ending
from ..errors import StoreError

# What numpy and zipfile make of a damaged .npz file
_DAMAGE: tuple[type[Exception], ...] = (OSError, ValueError, KeyError, TypeError, AttributeError, EOFError, RuntimeError)
_DAMAGE += (zipfile.BadZipFile, zlib.error, struct.error)
_SUMS = ("displacement", "square", "distance2", "distance4")


def _require_npz(path: str | os.PathLike[str]) -> None:
    require_ending(path, (".npz",), "runs are stored as arrays of numpy")


@dataclass(frozen=True, repr=False)
class Runs:
    """Sums over isoconfigurational runs, block by block of run numbers; b blocks, m instants.

    instants (m,); counts (b,): runs of each block; displacement, square (b, m, n, d): sums of dr_c and dr_c^2;
    distance2, distance4 (b, m, n): of |dr|^2 and |dr|^4; series: {column: (b, m)}, sums of one number a run;
    kept: {index of an instant: (runs, n, d)}; first_run: number of the first run; status: of the call;
    origin: digest of the packing and the options that the runs were made from.
    """

    instants: Array
    counts: Array
    displacement: Array
    square: Array
    distance2: Array
    distance4: Array
    series: dict[str, Array]
    first_run: int = 0
    block: int = 1
    kept: dict[int, Array] = field(default_factory=dict)
    status: StatusCode = StatusCode.OK
    step: float = 0.0
    acceptance: float = 0.0
    origin: str = ""

    # ---- sums and means
    @property
    def runs(self) -> int:
        """Number of runs in the sums."""
        return int(self.counts.sum())

    @property
    def blocks(self) -> int:
        return len(self.counts)

    def total(self, name: str, weights: Any = None) -> Array:
        """The sum of a quantity over runs, blocks added in their order; weights (b,): how often each block counts."""
        if self.blocks == 0:
            stalled = self.status == StatusCode.NOT_CONVERGED
            raise ValueError("no run was made: " + ("the first cannot move" if stalled else "the call was stopped before the first ended"))
        values = getattr(self, name) if name in _SUMS or name == "counts" else self.series[name]
        if weights is None:
            out = np.zeros_like(values[0])
            for one in values:  # in order, as the library adds them
                out = out + one
            return out
        return np.tensordot(np.asarray(weights, float), values, 1)

    def mean(self, name: str, weights: Any = None) -> Array:
        """Mean over runs: of displacement (m, n, d), distance2 (m, n), ... or a column of series (m,)."""
        return self.total(name, weights) / self.total("counts", weights)

    def variance(self, weights: Any = None) -> Array:
        """Var[dr_c] over runs (m, n, d)."""
        return self.mean("square", weights) - self.mean("displacement", weights) ** 2

    @property
    def msd(self) -> Array:
        """Mean-square displacement (m,), unit of box^2."""
        return self.mean("msd")

    @property
    def time(self) -> Array:
        """Mean simulated time at each instant (m,); Monte Carlo: sweeps."""
        return self.mean("time")

    def deviation(self, name: str) -> Array:
        """Standard deviation over runs of time, msd, scattering, overlap or energy at each instant (m,)."""
        square = {"time": "time2"}.get(name, name + "2")
        return np.sqrt(np.maximum(0.0, self.mean(square) - self.mean(name) ** 2))

    def chi4(self, name: str = "overlap") -> Array:
        """chi_4(t) = N (<Q^2> - <Q>^2) of 'overlap' or 'scattering' (m,), over runs from this one configuration."""
        return self.distance2.shape[2] * self.deviation(name) ** 2

    def halves(self) -> tuple[Array, Array]:
        """Weights of two halves of the blocks, even and odd."""
        if self.blocks < 2:
            raise ValueError("one block of runs has no halves: make more runs, or give a smaller block= to isoconf()")
        odd = np.arange(self.blocks) % 2
        return 1.0 - odd, odd.astype(float)

    # ---- files, parts of a campaign
    def whole_blocks(self) -> "Runs":
        """These without a last block that is not full."""
        if self.blocks == 0 or self.counts[-1] == self.block:
            return self
        left = self.runs - int(self.counts[-1])
        return replace(
            self,
            **{name: getattr(self, name)[:-1] for name in _SUMS + ("counts",)},
            series={k: v[:-1] for k, v in self.series.items()},
            kept={k: v[:left] for k, v in self.kept.items()},
        )

    def merge(self, other: "Runs") -> "Runs":
        """These runs and those that follow them. Bits are those of one campaign, as blocks begin at multiples of `block`."""
        if not np.array_equal(self.instants, other.instants) or self.block != other.block:
            raise ValueError("the two have other instants or blocks")
        if self.origin != other.origin:
            raise ValueError("the two are runs from other packings, or with other options")
        if other.first_run != self.first_run + self.runs:
            raise ValueError(
                f"runs {other.first_run} ... do not follow {self.first_run} ... {self.first_run + self.runs - 1}"
            )
        if other.first_run % self.block:
            raise ValueError(f"run {other.first_run} is inside a block of {self.block}: split at multiples of it")
        joined = {name: np.concatenate([getattr(self, name), getattr(other, name)]) for name in _SUMS + ("counts",)}
        return replace(
            self,
            **joined,
            series={k: np.concatenate([v, other.series[k]]) for k, v in self.series.items()},
            kept={k: np.concatenate([v, other.kept[k]]) for k, v in self.kept.items() if k in other.kept},
            status=max(self.status, other.status),
        )

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes an .npz file, and the name must end so, beside and renamed."""
        _require_npz(path)
        arrays = {f.name: getattr(self, f.name) for f in fields(self) if f.name not in ("series", "kept")}
        arrays.update({"series_" + k: v for k, v in self.series.items()})
        arrays.update({f"kept_{k}": v for k, v in self.kept.items()})
        arrays = {k: np.asarray(v) for k, v in arrays.items()}
        with replacing(path) as file:
            np.savez(file, **arrays, sha256=np.array(_digest(arrays)))

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> "Runs":
        """Reads what save wrote. A damaged file is a jam.errors.StoreError."""
        try:
            with open_regular(path) as opened, np.load(opened) as file:
                data = {k: file[k] for k in file.files}
                if data.pop("sha256", "") != _digest(data):
                    raise ValueError("its arrays differ from its checksum")
            plain = {f.name: data[f.name] for f in fields(cls) if f.name not in ("series", "kept")}
            series = {k[7:]: data[k] for k in data if k.startswith("series_")}
            kept = {int(k[5:]): data[k] for k in data if k.startswith("kept_")}
            for name in ("first_run", "block", "step", "acceptance", "origin"):
                plain[name] = plain[name].item()
            plain["status"] = StatusCode(int(plain["status"]))
        except FileNotFoundError:
            raise
        except _DAMAGE as error:
            raise StoreError(5, f"{path} is damaged, or not a file of runs: {error}. Use another copy") from error
        return cls(**plain, series=series, kept=kept)

    def __repr__(self) -> str:
        return f"Runs({self.runs} runs, {len(self.instants)} instants, {self.distance2.shape[2]} spheres)"


def take_runs(system: Any) -> Runs:
    """The runs that a system holds, also after System.from_checkpoint; instants are then those of the first call."""
    report = system._ask("get_isoconf_report")
    m, n, d = report.instants, system.n, system.dim
    sums: dict[str, list[Array]] = {name: [] for name in _SUMS}
    counts: list[int] = []
    measured: list[Any] = []
    for block in range(report.blocks):
        found = system._ask("isoconf_series", block)
        counts.append(int(found.runs[0]))
        measured.append(found)
        for one in (system._ask("isoconf_displacements", block), system._ask("isoconf_distances", block)):
            for name in one._fields:
                sums[name].append(getattr(one, name))
    same(repr(system._ask("get_isoconf_report")), repr(report))
    shape = {name: (0, m, n, d) if name in ("displacement", "square") else (0, m, n) for name in _SUMS}
    series = {
        c.name.lower(): np.array([getattr(one, c.name.lower()) for one in measured]).reshape(-1, m)
        for c in IsoconfColumn
        if c != IsoconfColumn.RUNS
    }
    filled: dict[str, Any] = {name: np.array(v) if v else np.empty(shape[name]) for name, v in sums.items()}
    return Runs(
        instants=np.full(m, np.nan),
        counts=np.array(counts, dtype=np.int64),
        **filled,
        series=series,
        first_run=report.first_run,
        status=system.status,
        step=report.step,
        acceptance=report.acceptance,
    )


def make_runs(
    system: Any,
    instants: Any,
    monte_carlo: dict[str, Any] | None,
    keep: Sequence[int],
    progress: Any,
    options: dict[str, Any],
) -> Runs:
    """What System.isoconf calls."""
    with system._reporting(progress):
        times = as_vector(instants, name="instants")
        made = option_struct("jam_isoconf_options", options)
        chosen = None if monte_carlo is None else option_struct("jam_monte_carlo_options", monte_carlo)
        kept = as_array(np.array([number(k, "int", "keep") for k in keep], np.int64), "int32_t", "keep")
        origin = _origin(system, dict(options, block=made.block, keep=keep, monte_carlo=monte_carlo))
        status = raw.jam_isoconf(
            system.handle, made, chosen, times, kept if kept.size else None, raw.jam_isoconf_report()
        )
        system._note(status)
    runs = take_runs(system)
    sets = {int(k): system._ask("isoconf_kept", int(k)) for k in kept}
    return replace(runs, instants=times, block=made.block, kept=sets, status=system.status, origin=origin)


def _digest(arrays: dict[str, Any]) -> str:
    """SHA-256 of arrays with their names, types and shapes: zip's own checksums miss a member that is gone."""
    found = hashlib.sha256()
    for name, array in sorted(arrays.items()):
        found.update(f"{name} {array.dtype.str} {array.shape} ".encode() + np.ascontiguousarray(array).tobytes())
    return found.hexdigest()


# What may change from one part of a campaign to the next.
_FREE = ("runs", "first_run", "threads", "memory_limit", "wall_time", "progress", "resume")
# What a packing is beside its arrays.
_SCENE = ("seed", "model", "non_additivity", "masses", "container", "walls")


def _origin(system: Any, options: dict[str, Any]) -> str:
    """A digest of the packing, its cell and walls, and of all options that runs depend on."""
    system = system.copy()
    digest, info = hashlib.sha256(), system.info
    for array in (system.positions, system.diameters, system.cell):
        digest.update(np.ascontiguousarray(array).tobytes())
    fixed = {k: v for k, v in options.items() if k not in _FREE}
    if keep := np.ravel(fixed.pop("keep", ())).tolist():
        fixed["keep"] = keep
    if fixed.get("monte_carlo") is None:  # {} are the default options of Monte Carlo
        fixed.pop("monte_carlo", None)
    scene = [float(getattr(info, name)) for name in _SCENE]
    digest.update(json.dumps([scene, fixed], sort_keys=True, default=str).encode())
    return digest.hexdigest()


def campaign(
    system: Any, path: str | os.PathLike[str], instants: Any, runs: int, *, part: int = 100, **options: Any
) -> Runs:
    """Makes `runs` runs in parts and saves them to the .npz file `path` after each: a killed campaign continues.

    part: runs between two savings, rounded up to whole blocks. options: those of System.isoconf but first_run.
    A file of another packing, other instants or options is a ValueError, and stays as it is. One of more runs is returned
    whole.
    """
    _require_npz(path)
    block = int(options.setdefault("block", 20))
    part = -(-part // block) * block
    times, origin = np.asarray(instants, float), _origin(system, options)
    done = Runs.load(path) if os.path.exists(path) else None
    if done is not None and (not np.array_equal(done.instants, times) or done.origin != origin):
        raise ValueError(f"{path} contains runs of another campaign: its packing, instants or options differ")
    if done is not None and done.runs < runs:
        done = done.whole_blocks()  # one that was stopped ends amid a block, which is made again
    while done is None or done.runs < runs:
        first = 0 if done is None else done.runs
        made = system.isoconf(instants, first_run=first, runs=min(part, runs - first), **options)
        done = made if done is None else done.merge(made)
        done.save(path)
        if made.status > 0:
            break
    return done
