"""How many packings a time allows, from those that are there."""
from __future__ import annotations

import math
import os
from dataclasses import dataclass

from .._api.arrays import Array


@dataclass(frozen=True)
class Capacity:
    """How many packings a number of workers make in a time."""

    packings: int  #: in `wall_time`, by all workers
    wall_time: float  #: seconds
    workers: int
    seconds: float  #: of one packing on one worker: the mean
    deviation: float  #: standard deviation of the seconds; nan from one packing
    measured: int  #: packings that were measured
    jammed: float  #: share of these that are jammed
    failed: float  #: share of the seeds tried that failed
    bytes: float  #: size of one file: the mean

    def __str__(self) -> str:
        return (
            f"{self.packings} packings in {self.wall_time:g} s by {self.workers} workers: {self.seconds:.3g} s each "
            f"(measured on {self.measured}); {self.jammed:.0%} jammed, {self.failed:.0%} failed; "
            f"{_in_bytes(self.packings * self.bytes)} on disk"
        )


def _in_bytes(number: float) -> str:
    """In the unit that fits: 112 kB."""
    for unit in ("bytes", "kB", "MB", "GB"):
        if number < 999.5:
            return f"{number:.3g} {unit}"
        number /= 1000
    return f"{number:.3g} TB"


def check_plan(wall_time: float, workers: int | None) -> int:
    """Refuses a time or a number of workers that makes no sense; returns the number of workers."""
    if not 0 < wall_time < math.inf:
        raise ValueError(f"wall_time is {wall_time}, it must be positive and finite")
    count = len(os.sched_getaffinity(0)) if workers is None else workers
    if count < 1:
        raise ValueError(f"workers is {workers}, it must be at least 1")
    return count


def capacity(rows: Array, failed: int, size: float, wall_time: float, workers: int) -> Capacity:
    """From the rows of packings with their seconds, the number of seeds that failed and the bytes of a packing."""
    seconds = rows["seconds_made"]
    return Capacity(
        packings=int(workers * wall_time / seconds.mean()),
        wall_time=float(wall_time),
        workers=workers,
        seconds=float(seconds.mean()),
        deviation=float(seconds.std(ddof=1)) if len(rows) > 1 else math.nan,
        measured=len(rows),
        jammed=float((rows["jammed"] == 1).mean()),
        failed=failed / (failed + len(rows)),
        bytes=size,
    )
