"""What moves the spheres: dynamics, growth, the crunch; and how to stop it."""
from __future__ import annotations

import os
import re
import time
import warnings
from typing import Any, Callable, Iterable, Mapping, Sequence, TypeVar

import numpy as np

from .. import raw
from .._api.arrays import Array, as_array, as_rows, as_vector
from .._api.calls import freeze, new_report
from .._api.documented import takes
from .._api.errors import refused
from .._api.generated import CrunchReport, DecompressReport, MdReport, MonteCarloReport, RadiiReport, RelaxReport, ShearReport, StatusCode, StopReason
from .._api.options import as_enum, option_struct, spelled_out
from .._api.size_laws import density_of
from ..errors import JamError
from .observe import Observing, Step
from .progress import end, reporter
from .runs import Runs, make_runs

Report = TypeVar("Report")


def stage_of(given: Any) -> dict[str, float]:
    """Options of one stage of growth."""
    if isinstance(given, Mapping):
        return dict(given)
    if np.ndim(given) != 1 or len(given) != 2:
        raise TypeError(f"stages: each must be a pair (growth_rate, pressure) or a dict of options, not {given!r}")
    return dict(zip(("growth_rate", "pressure"), given))


class Verbs(Observing):
    """Long calls on a system."""

    def _verb(self, verb: str, kind: type[Report], progress: Any, options: Mapping[str, Any] | None, **arrays: Any) -> Report:
        handle, struct = self.handle, f"jam_{verb.removeprefix('maximise_')}_options"
        report = "jam_" + re.sub("(?<=[a-z])(?=[A-Z])", "_", kind.__name__).lower()
        with self._failing():
            chosen = None if options is None else option_struct(struct, dict(options))
        made = new_report(report)
        said = {} if chosen is None else dict(spelled_out(chosen, struct))
        said.update({k: a.tolist() for k, a in arrays.items() if a is not None})
        call = {"verb": verb, "options": said}
        call.update(status="running", stop_reason="none")  # what a callable saves meanwhile says so
        with self._reporting(progress):
            self.calls.append(call)
            try:
                status = getattr(raw, "jam_" + verb)(handle, chosen, *arrays.values(), made)
            except BaseException as error:
                if refused(error):  # nothing has moved
                    self.calls[:] = [c for c in self.calls if c is not call]
                else:  # the callable or Ctrl-C has stopped the call, whose last step stays
                    call.update(status="cancelled", stop_reason="cancelled")
                raise
            frozen: Report = freeze(made, report)
            self._note(status, frozen)
        reason = getattr(getattr(frozen, "stop_reason", None), "name", "none")
        call.update(status=StatusCode(status).name.lower(), stop_reason=reason.lower())
        return frozen

    @takes("jam_run_options")
    def run(self, collisions_per_particle: float | None = None, *, progress: Any = None, **options: Any) -> MdReport:
        """Molecular dynamics at constant volume and energy, event by event.

        Parameters
        ----------
        collisions_per_particle : float, optional
            How many to make. Default 100.

        Returns
        -------
        MdReport
            report.status > 0 means that the run stopped early.

        Examples
        --------
        >>> import jam
        >>> fluid = jam.System.random(n=64, dim=3, seed=1)
        >>> report = fluid.run(20)
        >>> report.collisions >= 20 * 64 / 2, report.max_overlap < 1e-9
        (True, True)
        """
        return self._verb("run", MdReport, progress, dict(options, collisions_per_particle=collisions_per_particle))

    @takes("jam_compress_options")
    def compress(
        self,
        stages: Iterable[Mapping[str, float] | Sequence[float]] | None = None,
        *,
        porosity: float | None = None,
        progress: Any = None,
        **options: Any,
    ) -> MdReport:
        """Molecular dynamics while the diameters grow (Lubachevsky and Stillinger 1990).

        Without `stages` and growth_rate it runs the two stages that avoid crystals in d = 3: growth rate 1e-2 to p = 500,
        then 3e-3 to `pressure`, 1e6 by default. Limits, targets and growth_law keep them. A growth_rate makes one stage
        of that rate. With packing_fraction or porosity it ends at exactly this density. From a fluid one that these sizes
        do not reach in disorder is refused.

        Parameters
        ----------
        stages : sequence, optional
            Each stage is a pair (growth_rate, pressure) or a dict of options, growth_rate among them. They run one after the other, and
            `options` hold for all of them; one that every stage gives itself is refused. A stage that stops early ends
            the sequence.
        porosity : float, optional
            Void fraction, 1 - packing_fraction.

        Returns
        -------
        MdReport
            Of the last stage that ran.

        Examples
        --------
        >>> import jam
        >>> glass = jam.System.random(n=64, dim=3, seed=1)
        >>> report = glass.compress(stages=[(3e-2, 100), (1e-2, 1e3)])
        >>> report.stop_reason.name, report.pressure > 900
        ('PRESSURE', True)
        """
        report: MdReport | None = None
        if porosity is not None:
            options["packing_fraction"] = density_of(options.get("packing_fraction"), porosity)
        if stages is None:
            report = self._verb("compress", MdReport, progress, options or None)
        made = [stage_of(s) for s in stages or ()]
        idle = [k for k, v in options.items() if v is not None and made and all(k in given for given in made)]
        if idle:
            raise ValueError(f"{', '.join(idle)} would have no effect: every stage gives its own")
        for given in made:
            report = self._verb("compress", MdReport, progress, {**options, **given})
            if report.status > 0 and report.stop_reason != StopReason.PRESSURE:  # of a density that a later stage may reach
                break
        if report is None:
            raise ValueError("stages is empty")
        return report

    @takes("jam_monte_carlo_options")
    def monte_carlo(self, *, progress: Any = None, **options: Any) -> MonteCarloReport:
        """Metropolis Monte Carlo (J. Chem. Phys. 21, 1087 (1953)) of hard or, with alpha, soft spheres.

        A step of 0 is tuned in a preliminary run and then frozen; ArgumentError when no step is accepted. After soft
        spheres the system allows overlaps, as by 'allow'. Random numbers depend on seed, run, sweep and sphere alone.
        Velocities are dropped. observed_spheres() gives the displacements. An early stop can be resumed, also from
        write_checkpoint().

        Returns
        -------
        MonteCarloReport
        """
        return self._verb("monte_carlo", MonteCarloReport, progress, options)

    @takes("jam_crunch_options")
    def crunch(
        self,
        *,
        progress: Any = None,
        on_step: Callable[[Step], Any] | None = None,
        checkpoint: str | os.PathLike[str] | None = None,
        checkpoint_every: float = 60.0,
        **options: Any,
    ) -> CrunchReport:
        """Moves the spheres to their jamming point and certifies the result.

        Parameters
        ----------
        on_step : callable(Step), optional
            Gets every step with its displacements and linear network, which balances with full_lps=1 only. A true answer
            stops the call.
        checkpoint : path-like, optional
            Name of a file that gets the last step while the call runs. After a kill,
            System.from_checkpoint(checkpoint).crunch() goes on from there. It ends jammed, not always with the same bits.
            A file that cannot be written is a warning.
        checkpoint_every : float
            Seconds between checkpoints. Default 60.

        Returns
        -------
        CrunchReport
            report.jammed is the verdict, report.packing_fraction the jamming density.

        Examples
        --------
        >>> import jam
        >>> disks = jam.System.random(n=64, dim=2, seed=1, diameters=[1.0] * 32 + [1.4] * 32)
        >>> report = disks.crunch()
        >>> report.stop_reason.name, report.force_residual < 1e-10
        ('CONVERGED', True)
        """
        user = reporter(progress)
        told: Callable[[Any], bool] | None = user
        if on_step is not None:
            told, options = self._stepper(on_step, told), {**options, "steps": 1}
        if checkpoint is not None:
            told = self._keeper(os.fsdecode(checkpoint), checkpoint_every, told)
        try:
            report = self._verb("crunch", CrunchReport, told, options or None)
        finally:
            end(user)
        early = report.status in (StatusCode.CANCELLED, StatusCode.LIMIT)
        if checkpoint is not None and (early or report.stop_reason == StopReason.DUALITY_GAP):
            self._keep(os.fsdecode(checkpoint))
        return report

    def _keep(self, path: str) -> None:
        """Writes a checkpoint. A full disk is no reason to lose the packing."""
        try:
            raw.jam_write_checkpoint(self.handle, path)
        except JamError as error:
            warnings.warn(f"no checkpoint was written: {error}", stacklevel=3)

    def _keeper(self, path: str, every: float, told: Callable[[Any], Any] | None) -> Callable[[Any], bool]:
        """A progress callable that writes a checkpoint now and then."""
        kept = time.monotonic()

        def on_progress(p: Any) -> bool:
            nonlocal kept
            if time.monotonic() - kept >= every:
                kept = time.monotonic()
                self._keep(path)
            return bool(told(p)) if told else False

        return on_progress

    @takes("jam_isoconf_options")
    def isoconf(
        self,
        instants: Any,
        *,
        monte_carlo: Mapping[str, Any] | None = None,
        keep: Sequence[int] = (),
        progress: Any = None,
        **options: Any,
    ) -> Runs:
        """Runs from this configuration, each with velocities (or Monte Carlo trials) of its own.

        The packing does not change. A status > 0 says that it stopped early, with the runs that were made.

        Parameters
        ----------
        instants : array_like
            Ascending, in collisions per particle, simulated time (clock='time') or sweeps.
        monte_carlo : mapping, optional
            Options of monte_carlo(); without them the runs are molecular dynamics.
        keep : sequence of int
            Indices of the instants whose displacements of every run are kept.

        Returns
        -------
        near_jamming.Runs
        """
        return make_runs(self, instants, None if monte_carlo is None else dict(monte_carlo), keep, progress, options)

    @takes("jam_radii_options")
    def maximise_radii(self, weights: Any = None, *, moments: Any = None, progress: Any = None, **options: Any) -> RadiiReport:
        """Moves the spheres and changes their radii to a local maximum of the weighted sum of radii, or of a factor of moments.

        Parameters
        ----------
        weights : array_like (n,), optional
            Of the radii in the sum, > 0. Default: all 1.
        moments : sequence of float, optional
            One to four exponents q. The largest report.value = lambda is sought with sum R_i^q = lambda^q times that of the
            start for each of them. Without it: the sum of radii.

        Returns
        -------
        RadiiReport
            Where report.maximum is 1, contacts, forces and gaps are those of the maximum.

        Examples
        --------
        >>> import jam
        >>> two = jam.System.random(n=2, dim=2, walls="xy", seed=1)
        >>> report = two.maximise_radii()
        >>> report.maximum, abs(report.value - (2 - 2 ** 0.5)) < 1e-14
        (True, True)
        """
        given = None if weights is None else as_vector(weights, name="weights")
        if moments is not None:
            exponents = as_vector(moments, name="moments")
            if not 1 <= len(exponents) <= 4:
                raise ValueError(f"moments has {len(exponents)} exponents, one to four are possible")
            named: dict[str, Any] = {f"exponent_{k}": float(q) for k, q in enumerate(exponents, 1)}
            options = dict(moments=len(exponents), **named, **options)
        return self._verb("maximise_radii", RadiiReport, progress, options or None, weights=given)

    @takes("jam_relax_options")
    def relax(self, *, progress: Any = None, **options: Any) -> RelaxReport:
        """Minimises the energy of overlapping spheres (overlap="allow" at creation). Returns a RelaxReport.

        The contact network, its forces and stiffnesses are then as after a crunch: contacts, hessian(stiffness="soft",
        prestress=1), moduli(...). A report whose status is > 0 did not converge, or says why the minimum is none of a
        jammed packing.
        """
        return self._verb("relax", RelaxReport, progress, options or None)

    @takes("jam_decompress_options")
    def decompress(self, *, progress: Any = None, **options: Any) -> DecompressReport:
        """From overlapping spheres down to jamming, compared with crunch. Returns a DecompressReport.

        The system ends as the jammed packing; with crunch=0 as the soft packing. soft_history has every minimum.
        """
        return self._verb("decompress", DecompressReport, progress, options or None)

    @property
    def soft_history(self) -> Array:
        """Minima of the last decompression as a structured array: one field for each SoftColumn, in lower case."""
        return as_rows(self._ask("decompress_history"))

    @takes("jam_shear_options")
    def shear(self, to: Any, mode: Any = None, *, stress: Any = None, progress: Any = None, **options: Any) -> ShearReport:
        """Athermal quasi-static shear of soft spheres (overlap="allow"), or of hard ones by a crunch at each strain.

        Parameters
        ----------
        to : float or array_like
            The last strain, or those at which the shear turns: [0.1, -0.1, 0] is a cycle.
        mode : array_like (d, d), optional
            Strain of amplitude 1, upper-triangular. Default: simple shear, x moves with y.
        stress : array_like (d, d), optional
            What the components that strain= frees are to hold, in place of one pressure. Symmetric.

        Returns
        -------
        ShearReport
            shear_rows has a row for each minimum. report.status > 0 means that the shear stopped early.

        Examples
        --------
        >>> import jam
        >>> soft = jam.System.random(n=64, dim=2, diameters=[1, 1.4] * 32, packing_fraction=0.9, overlap="allow", seed=1)
        >>> report = soft.shear(0.01)
        >>> len(soft.shear_rows) >= 11, abs(report.strain - 0.01) < 1e-15
        (True, True)
        """
        turns = as_vector(np.atleast_1d(to), name="to")
        if mode is None and stress is not None:
            mode = np.eye(self.dim, k=1) * (np.arange(self.dim) == 1)
        parts = [as_array(x, name=name) for name, x in (("mode", mode), ("stress", stress)) if x is not None]
        for name, x in zip(("mode", "stress"), parts):
            if x.shape != (self.dim, self.dim):
                raise ValueError(f"{name} has the shape {x.shape}, it must be ({self.dim}, {self.dim})")
        given = np.concatenate(parts) if parts else None
        return self._verb("shear", ShearReport, progress, options or None, turns=turns, mode=given)

    @property
    def shear_rows(self) -> Array:
        """Rows of the last shear as a structured array: one field for each ShearColumn, in lower case."""
        return as_rows(self._ask("shear_history"))

    def cancel(self) -> None:
        """Stops the call that runs on this system in another thread. If none runs, it stops the next call."""
        raw.jam_cancel(self.handle)

    def log(self, callback: Callable[[int, str], Any] | None, level: int | str = "info") -> None:
        """Sends the library's log lines of up to this level to callback(level, line); None silences it."""
        raw.set_log(self.handle, callback, as_enum(level, "LogLevel", "level"))
