"""Which protocol and tolerances give so many digits of phi_J, and what they cost."""
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from ._api.generated import GROWTH_STAGES
from ._api.shown import only

__all__ = ["Advice", "advise"]
__dir__ = only(__all__)

# Made by tests/bench/advise.py --table: (dimension, spheres): (seconds of growth, (seconds of crunch, largest error of
# phi_J) for each of OPTIONS). One thread.
MEASURED: dict[tuple[int, int], tuple[float, tuple[tuple[float, float], ...]]] = {
    (2, 128): (0.095, ((0.0031, 1.5e-07), (0.0045, 3.8e-08), (0.0071, 0.0))),
    (2, 512): (0.44, ((0.0099, 7.1e-06), (0.031, 1.9e-08), (0.042, 0.0))),
    (3, 128): (0.18, ((0.0094, 2.6e-06), (0.017, 1.2e-06), (0.023, 0.0))),
    (3, 512): (0.72, ((0.11, 5.7e-07), (0.22, 1.2e-07), (0.51, 0.0))),
    (3, 1024): (1.6, ((0.17, 1.5e-06), (0.7, 5.4e-08), (0.83, 0.0))),
    (4, 128): (0.33, ((0.019, 4.3e-07), (0.029, 6.2e-08), (0.052, 0.0))),
    (4, 256): (0.76, ((0.059, 8.9e-06), (0.097, 8.6e-06), (0.83, 0.0))),
}
STAGES = (GROWTH_STAGES[0], (GROWTH_STAGES[1][0], 1e5))  # the library's, to a lower pressure
OPTIONS: tuple[dict[str, float], ...] = (
    {"gain_tolerance": 1e-3, "step_tolerance": 1.0, "polish": 0},
    {"gain_tolerance": 1e-6, "step_tolerance": 1e-2, "polish": 0},
    {},
)
MOST_DIGITS = 15
MARGIN = 10.0  # over the largest error that was measured: few seeds were


@dataclass(frozen=True)
class Advice:
    """What to call, and what it costs."""

    stages: tuple[tuple[float, float], ...]  #: for compress(stages=...): growth rates and pressures
    crunch: dict[str, float]  #: options of crunch()
    error: float  #: of phi_J of this packing's own jamming point: ten times the largest measured; 1e-15 for the defaults
    jammed: bool  #: whether crunch certifies the packing; loose tolerances end before that
    seconds: float  #: expected for both, one thread of the machine of the benchmarks
    extrapolated: bool  #: the size lies outside those that were measured

    def table(self) -> dict[str, Any]:
        """All fields, as pandas takes them."""
        return dict(vars(self))


def _seconds(n: int, dim: int, row: int) -> tuple[float, bool]:
    """By power laws between the measured sizes, and beyond them the nearest one."""
    sizes = sorted(size for d, size in MEASURED if d == dim)
    total = [MEASURED[dim, size][0] + MEASURED[dim, size][1][row][0] for size in sizes]
    k = min(max(1, sum(size < n for size in sizes)), len(sizes) - 1)
    slope = math.log(total[k] / total[k - 1]) / math.log(sizes[k] / sizes[k - 1])
    return total[k] * (n / sizes[k]) ** slope, not sizes[0] <= n <= sizes[-1]


def advise(n: int, dim: int = 3, digits: float = MOST_DIGITS) -> Advice:
    """Protocol and tolerances for a number of digits of phi_J, from measured tables.

    The digits, and `error`, are of the jamming point of this one packing: how far the crunch ends from the density at
    which the packing that the growth made jams. They say nothing of the protocol. Another seed or growth rate leads to
    another packing, whose phi_J differs from the third or fourth digit on; the same growth to another pressure changes
    phi_J from the fifth to seventh digit on (1.7e-6 from p = 1e5 to 1e7, 2.7e-6 to 1e12; N = 1024, d = 3).

    Parameters
    ----------
    n : int
        Spheres, at least 2.
    dim : int
        Dimension, 2 to 4.
    digits : float
        Wanted digits of phi_J, above 0 and at most 15.

    Returns
    -------
    Advice

    Examples
    --------
    >>> import jam
    >>> advice = jam.advise(512, 3, digits=15)
    >>> advice.crunch, advice.jammed
    ({}, True)
    >>> glass = jam.System.random(64, 3, 1)
    >>> report = glass.compress(stages=advice.stages)
    >>> glass.crunch(**advice.crunch).jammed
    True
    """
    dimensions = sorted({d for d, _ in MEASURED})
    if dim not in dimensions:
        raise ValueError(f"dim is {dim}, measured are {', '.join(map(str, dimensions))}")
    if n < 2:
        raise ValueError(f"n is {n}, it must be at least 2")
    if not 0 < digits <= MOST_DIGITS:
        raise ValueError(f"digits is {digits}, it must be above 0 and at most {MOST_DIGITS}")
    for row, options in enumerate(OPTIONS):
        worst = MARGIN * max(rows[row][1] for (d, _), (_, rows) in MEASURED.items() if d == dim)
        if worst <= 10.0**-digits or not options:
            break
    seconds, extrapolated = _seconds(n, dim, row)
    error = worst if options else 10.0**-MOST_DIGITS
    return Advice(STAGES, dict(options), error, not options, seconds, extrapolated)
