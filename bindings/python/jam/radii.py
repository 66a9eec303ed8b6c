"""The largest sum of radii: a search from many starts, and decimals of its best with a proved radius.

A start is random. `System.maximise_radii` brings it to a local maximum. Then one move after the other changes the best
packing of the start a little: all spheres, those around a point, one sphere moved into a hole, or two exchanged. Radii
shrink until no spheres overlap, and the next maximum is near, as no room is taken off first.
"""
from __future__ import annotations

import json
import time
from concurrent.futures import FIRST_COMPLETED, Future, wait
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ._api.arrays import Array, parts, placed
from ._api.given import closed_axes, walls_of
from ._api.shown import only
from ._formats.replacing import replacing, writing
from .ensemble.pool import LocalPool
from ._sum_proof import Proved, prove_sum
from .errors import JamError
from .system import System

__all__ = ["Best", "Proved", "Search", "best_of", "prove"]
__dir__ = only(__all__)

MOVES = 60  # without a gain that end a start
NEAR = 1e-5  # room of maximise_radii after a move
SMALLEST, LARGEST = -4.0, -1.0  # powers of ten of displacements, over the mean distance of spheres
HOLES = 64  # random points of which the one with most room is taken
SAME = 1e-12  # of two sums, relative: one packing


class Best(NamedTuple):
    """A local maximum."""

    value: float  #: the sum of w_i R_i
    start: int  #: number of the start that led to it
    positions: Array  #: (n, d)
    radii: Array  #: (n,)
    cell: Array  #: (d, d), which strain= deforms


class Search(NamedTuple):
    """What a search has found so far."""

    best: list[Best]  #: of different sums, the largest first
    starts: int  #: that ended
    maxima: int  #: local maxima that were computed
    seconds: float  #: wall time of all calls

    @property
    def value(self) -> float:
        """The largest sum; nan where no start has ended at a maximum."""
        return self.best[0].value if self.best else float("nan")


def _separations(x: Array, point: Array, cell: Array, closed: Array) -> Array:
    """Vectors to a point; of the images the nearest, but for cells that are far from rectangular."""
    part = parts(x - point, cell)
    return placed(np.where(closed, part, part - np.round(part)), cell)


def _moved(packing: System, closed: Array, turning: int, rng: np.random.Generator) -> tuple[Array, Array]:
    """Positions and radii after one random move. The wall turns about the centre of so many first axes."""
    x, radii, cell = packing.positions.copy(), packing.diameters / 2, packing.cell
    n, d = x.shape
    unit = (float(np.prod(np.diag(cell))) / n) ** (1 / d)
    length = unit * 10 ** rng.uniform(SMALLEST, LARGEST)
    kind = int(rng.integers(4)) if n > 1 else 0
    if kind == 0:
        x += length * rng.normal(size=x.shape)
    elif kind == 1:
        point = placed(rng.random(d), cell)
        near = np.argsort((_separations(x, point, cell, closed) ** 2).sum(1))[: int(rng.integers(2, 9))]
        x[near] += 0.3 * unit * rng.normal(size=(len(near), d)) * rng.random()
    elif kind == 2:
        moved = int(rng.integers(n))
        others = np.arange(n) != moved
        points = placed(rng.random((HOLES, d)), cell)
        room = [float((np.sqrt((_separations(x[others], p, cell, closed) ** 2).sum(1)) - radii[others]).min()) for p in points]
        best = int(np.argmax(room))
        x[moved], radii[moved] = points[best], max(room[best], 0.1 * radii.min())
    else:
        a, b = rng.choice(n, 2, replace=False)
        radii[[a, b]] = radii[[b, a]]
        x += length * rng.normal(size=x.shape)
    low, high, room = np.zeros(d), cell.sum(0), 1e-3 * unit
    x = np.where(closed, np.clip(x, low + room, high - room), x)
    if turning:  # every centre lies inside the round wall
        half = high[:turning] / 2
        from_axis = np.linalg.norm(x[:, :turning] - half, axis=1, keepdims=True)
        x[:, :turning] = half + (x[:, :turning] - half) * np.minimum(1.0, (half[0] - room) / np.maximum(from_axis, room))
    return x, radii


def _start(number: int, seed: int, n: int, dim: int, weights: Any, options: dict[str, Any], scene: dict[str, Any]) -> tuple[Best, int]:
    """One start with its moves."""
    rng = np.random.default_rng([seed, number])
    packing = System.random(n=n, dim=dim, seed=int(rng.integers(1 << 40)), **scene)
    report, failed = packing.maximise_radii(weights, **options), 0
    value, maxima = (report.value, 1) if report.maximum else (0.0, 0)
    given = {k: v for k, v in scene.items() if k not in ("cell", "box")}
    closed = np.array(closed_axes(packing.info))
    turning = int(closed.sum()) - sum(walls_of(packing.info))  # flat walls close no axis of a round one
    while failed < MOVES:
        failed += 1
        try:
            x, radii = _moved(packing, closed, turning, rng)
            other = System.from_arrays(x, radii=radii, overlap="shrink", cell=packing.cell, **given)
            report = other.maximise_radii(weights, room=NEAR, **options)
        except JamError:  # no room after this move
            continue
        maxima += report.maximum
        if report.maximum and report.value > value * (1 + SAME):
            packing, value, failed = other, report.value, 0
    return Best(value, number, packing.positions.copy(), packing.diameters / 2, packing.cell.copy()), maxima


class _State:
    """A search that a folder may keep."""

    def __init__(self, asked: dict[str, Any], keep: int, folder: Path | None, cell: Array):
        self.asked, self.keep, self.file = asked, keep, folder / "search.json" if folder else None
        self.best: list[Best] = []
        self.done: set[int] = set()
        self.maxima, self.before = 0, 0.0
        if self.file and self.file.exists():
            try:
                kept = json.loads(self.file.read_text())
                other = kept["asked"] != json.loads(json.dumps(asked))
                # records of searches that kept the cell may be without it
                self.best = [Best(v, k, *map(np.array, (*arrays, cell)[:3])) for v, k, *arrays in kept["best"]]
                self.keep = max(keep, len(self.best))
                self.done, self.maxima, self.before = set(kept["done"]), int(kept["maxima"]), float(kept["seconds"])
            except (ValueError, KeyError, TypeError, UnicodeDecodeError) as error:
                raise ValueError(f"{self.file} is damaged ({error!r}): remove it to begin the search again, or take another folder") from error
            if other:
                raise ValueError(f"{self.file} is of another search: {kept['asked']}; take another folder")
        elif folder:
            with writing(folder):
                folder.mkdir(parents=True, exist_ok=True)

    def add(self, found: Best, maxima: int, seconds: float) -> None:
        self.done.add(found.start)
        self.maxima += maxima
        # of equal sums the earliest start stays, whatever worker ended first
        ranked = sorted([*self.best, *([found] if maxima else [])], key=lambda b: (-b.value, b.start))
        self.best = []
        for b in ranked:
            twin = next((k for k, c in enumerate(self.best) if abs(c.value / b.value - 1) < SAME), None)
            if twin is None:
                self.best.append(b)
            elif b.start < self.best[twin].start:
                self.best[twin] = b
        self.best = self.best[: self.keep]
        if self.file:
            best = [(b.value, b.start, *(x.tolist() for x in b[2:])) for b in self.best]
            kept = {"asked": self.asked, "done": sorted(self.done), "maxima": self.maxima, "seconds": self.before + seconds, "best": best}
            with replacing(self.file) as file:
                file.write(json.dumps(kept).encode())


def best_of(
    n: int,
    dim: int = 2,
    *,
    starts: int | None = None,
    seconds: float | None = None,
    until: float | None = None,
    workers: int | None = None,
    folder: Any = None,
    seed: int = 1,
    keep: int = 10,
    weights: Any = None,
    radius_min: float = 0.0,
    radius_max: float | None = None,
    strain: str = "none",
    **scene: Any,
) -> Search:
    """Searches the largest sum of radii of n spheres from many random starts.

    Parameters
    ----------
    n, dim : int
        Number of spheres, dimension.
    starts : int, optional
        How many starts in all, those of earlier calls on this folder among them.
    seconds : float, optional
        No start begins later. One of starts, seconds and until must be given.
    until : float, optional
        The search ends when a sum is at least as large.
    workers : int, optional
        Processes; default the number of cores.
    folder : path-like, optional
        Keeps the search in search.json, which another call with the same arguments continues.
    seed : int
        Start k of this seed always ends at the same packing.
    keep : int
        How many packings of different sums are kept, no fewer than the folder has.
    weights, radius_min, radius_max, strain
        As of `System.maximise_radii`.
    **scene
        box or cell, walls and container, as of `System.random`.

    Returns
    -------
    Search

    Examples
    --------
    >>> import jam.radii
    >>> found = jam.radii.best_of(5, walls="xy", starts=4, workers=1)
    >>> found.starts, round(found.value, 6), found.best[0].radii.shape
    (4, 1.103553, (5,))
    """
    if starts is None and seconds is None and until is None:
        raise ValueError("best_of: give starts, seconds or until, or the search has no end")
    n, dim, seed, keep = int(n), int(dim), int(seed), int(keep)
    if keep < 1:
        raise ValueError(f"keep is {keep}, it must be 1 or more")
    given = None if weights is None else [float(w) for w in weights]
    more = (("radius_max", radius_max), ("strain", strain))
    options: dict[str, Any] = {"radius_min": radius_min, **{k: v for k, v in more if v not in (None, "none")}}
    asked = dict(n=n, dim=dim, seed=seed, weights=given, scene={k: np.asarray(v).tolist() for k, v in scene.items()}, **options)
    begun, first = time.monotonic(), System.random(n=n, dim=dim, **scene)
    state = _State(asked, keep, Path(folder) if folder is not None else None, first.cell.copy())
    first.maximise_radii(given, max_steps=1, **options)  # refuses what every start would
    number = 0
    with LocalPool(workers) as pool:
        running: set[Future[tuple[Best, int]]] = set()
        while True:
            enough = until is not None and bool(state.best) and state.best[0].value >= until
            late = seconds is not None and time.monotonic() - begun > seconds
            while len(running) < 2 * pool._max_workers and not (late or enough) and (starts is None or number < starts):
                if number not in state.done:
                    running.add(pool.submit(_start, number, seed, n, dim, given, options, scene))
                number += 1
            if not running or enough:
                break
            ended, running = wait(running, return_when=FIRST_COMPLETED)
            for future in ended:
                state.add(*future.result(), time.monotonic() - begun)
        pool.shutdown(cancel_futures=True)
    return Search(state.best, len(state.done), state.maxima, state.before + time.monotonic() - begun)


def prove(system: System, digits: int = 30, *, weights: Any = None, path: Any = None) -> Proved:
    """Proves that a strict local maximum of the sum of radii lies at a packing, and gives it to so many digits.

    Parameters
    ----------
    system : System
        At a maximum of `maximise_radii`, in a periodic cell or between flat walls, with as many contacts as unknowns. Between walls
        along all axes orbits of a symmetry may be as many instead.
    digits : int
        From 20 on.
    weights : array_like (n,), optional
        Those of the sum. Default: all 1.
    path : path-like, optional
        Writes the proof file that jamproof.py checks.

    Raises
    ------
    StateError
        No contacts, not as many as unknowns, or a force or gap that may be 0; the text says which.

    Examples
    --------
    >>> import jam, jam.radii
    >>> disks = jam.System.random(n=3, dim=2, walls="xy", seed=1)
    >>> report = disks.maximise_radii()
    >>> found = jam.radii.prove(disks)
    >>> abs(float(found.value) - report.value) < 1e-15, found.value_radius < 1e-30
    (True, True)
    """
    return prove_sum(system, digits, weights, path)
