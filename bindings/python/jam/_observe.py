"""What is recorded while the spheres move: observables of the dynamics, steps of a crunch."""
from __future__ import annotations

from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Callable, Iterator

import numpy as np

from . import errors
from ._handle import Base
from ._methods import ObservedCorrelationResult, ObservedGapsResult, ObservedPairsResult, ObservedSpheresResult


@dataclass(frozen=True, repr=False)
class Step:
    """One step of a crunch. displacements: (n, d) of all spheres, images followed, unit of box.

    Of an LP also its linear network (else no rows): pairs (m, 2), vectors (m, d) = r_ij before the step, duals (m,) > 0.
    """

    displacements: np.ndarray
    pairs: np.ndarray
    vectors: np.ndarray
    duals: np.ndarray

    def __repr__(self) -> str:
        return f"Step({len(self.displacements)} spheres, {len(self.duals)} linear contacts)"


class Observed:
    """What a system has recorded since observe(); copies, made when asked for."""

    def __init__(self, system: "Observing") -> None:
        self._system = system

    @property
    def series(self) -> np.ndarray:
        """(samples,) with fields time, collisions (per particle), fraction, pressure, error (of it), msd (box^2)."""
        columns = self._system.call("observed_series")
        rows = np.empty(len(columns.time), [(name, "f8") for name in columns._fields])
        for name, values in zip(columns._fields, columns):
            rows[name] = values
        return rows

    @property
    def spheres(self) -> ObservedSpheresResult:
        """collisions (n,), displacement (n, d), unwrapped; zero collisions unless collisions=1 was asked for."""
        return self._system.call("observed_spheres")

    @property
    def pairs(self) -> ObservedPairsResult:
        """pair (m, 2), collisions (m,), momentum (m,) and the time over which it is the mean force."""
        return self._system.call("observed_pairs")

    @property
    def gaps(self) -> ObservedGapsResult:
        """edge (bins + 1,), density (bins,), error (bins,)."""
        return self._system.call("observed_gaps")

    @property
    def correlation(self) -> ObservedCorrelationResult:
        """r (bins,), g (bins,)."""
        return self._system.call("observed_correlation")


class Observing(Base):
    """Recording on a system."""

    @contextmanager
    def observing(self, **options: Any) -> Iterator[Observed]:
        """Records what run and compress do inside a with block; the Observed stays readable behind it. ::

            with packing.observing(sample_every=5, gap_bins=40) as seen:
                packing.run(200)
            seen.series["pressure"]

        options: those of observe().
        """
        self.call("observe", **options)
        try:
            yield Observed(self)
        finally:
            self.call("observe_stop")

    def _stepper(self, on_step: Callable[[Step], Any], user: Callable | None) -> Callable:
        """A progress callable that hands each finished step of a crunch to on_step; a true answer of either stops the call."""

        def on_progress(p: Any) -> bool:
            stop = bool(user(p)) if user else False
            try:
                step = Step(
                    *(self.call("crunch_step_" + name) for name in ("displacements", "contacts", "vectors", "duals"))
                )
            except errors.StateError:  # amid a step
                return stop
            return bool(on_step(step)) or stop

        return on_progress
