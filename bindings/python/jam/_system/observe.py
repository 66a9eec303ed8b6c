"""Records of moving spheres: observables of the dynamics, steps of a crunch."""
from __future__ import annotations

from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Callable, Iterator

from .. import errors
from .._api.arrays import Array, as_rows
from .._api.tuples import ObservedCorrelationResult, ObservedGapsResult, ObservedPairsResult, ObservedSpheresResult
from .handle import Base


@dataclass(frozen=True, repr=False)
class Step:
    """One step of a crunch. The linear network has rows for LP steps only.

    Attributes
    ----------
    displacements : array, shape (n, d)
        Of all spheres, unwrapped, in the unit of the box.
    pairs : int32 array, shape (m, 2)
        Pairs that carry force in the LP.
    vectors : array, shape (m, d)
        r_ij before the step.
    duals : array, shape (m,)
        Multipliers, all positive.
    """

    displacements: Array
    pairs: Array
    vectors: Array
    duals: Array

    def __repr__(self) -> str:
        return f"Step({len(self.displacements)} spheres, {len(self.duals)} linear contacts)"


class Observed:
    """What a system has recorded since observe(). Every access makes copies."""

    def __init__(self, system: "Observing") -> None:
        self._system = system

    @property
    def series(self) -> Array:
        """Structured array with fields time, collisions (per particle), fraction, pressure, error (of the pressure), msd."""
        return as_rows(self._system._ask("observed_series"))

    @property
    def stress(self) -> Array:
        """Stress tensor (d, d) since observe(): P_ab V / (N kT), positive in compression, trace d times the reduced pressure."""
        return self._system._ask("observed_stress")

    @property
    def spheres(self) -> ObservedSpheresResult:
        """collisions (n,) and unwrapped displacement (n, d). Collisions are counted with collisions=1 only."""
        return self._system._ask("observed_spheres")

    @property
    def pairs(self) -> ObservedPairsResult:
        """pair (m, 2), collisions (m,), momentum (m,), and time: momentum over time is the mean force."""
        return self._system._ask("observed_pairs")

    @property
    def gaps(self) -> ObservedGapsResult:
        """low, high, density, error of each bin, (bins,)."""
        return self._system._ask("observed_gaps")

    @property
    def correlation(self) -> ObservedCorrelationResult:
        """r (bins,), g (bins,)."""
        return self._system._ask("observed_correlation")


class Observing(Base):
    """Recording on a system."""

    @contextmanager
    def observing(self, **options: Any) -> Iterator[Observed]:
        """Records what run and compress do inside a with block. The Observed stays readable after it.

        Takes the options of observe().

        Examples
        --------
        >>> import jam
        >>> fluid = jam.System.random(n=64, dim=3, seed=1)
        >>> with fluid.observing(sample_every=5, gap_bins=20) as seen:
        ...     report = fluid.run(20)
        >>> seen.series.dtype.names[:3], len(seen.series) > 2
        (('time', 'collisions', 'fraction'), True)
        """
        self.call("observe", **options)
        try:
            yield Observed(self)
        finally:
            self.call("stop_observing")

    def _stepper(self, on_step: Callable[[Step], Any], user: Callable[..., Any] | None) -> Callable[..., Any]:
        """A progress callable that passes each finished step to on_step. A true answer of either stops the call."""

        def on_progress(p: Any) -> bool:
            stop = bool(user(p)) if user else False
            try:
                step = Step(*self._ask("crunch_step"))
            except errors.StateError:  # amid a step
                return stop
            return bool(on_step(step)) or stop

        return on_progress
