"""What moves the spheres: dynamics, growth, the crunch; and how to stop it."""
from __future__ import annotations

from typing import Any, Callable, Iterable, Mapping, Sequence

from . import _calls, raw
from ._generated import MdReport, CrunchReport, StatusCode
from ._observe import Observing, Step
from ._progress import reporter


class Verbs(Observing):
    """Long calls on a system."""

    def _verb(self, name: str, struct: str, report: str, progress: Any, options: Mapping[str, Any] | None) -> Any:
        handle = self.handle
        chosen = None if options is None else _calls.options(struct, dict(options))
        made = _calls.new_report(report)
        with self._reporting(progress):
            status = getattr(raw, name)(handle, chosen, made)
        self._carried = None
        frozen = _calls.freeze(made, report)
        self.status = StatusCode(status)
        object.__setattr__(frozen, "status", self.status)
        self.calls.append(
            {
                "verb": name.removeprefix("jam_"),
                "options": {} if chosen is None else _calls.spelled_out(chosen, struct),
                "status": self.status.name.lower(),
                "stop_reason": getattr(getattr(frozen, "stop_reason", None), "name", "none").lower(),
            }
        )
        return frozen

    def run(self, collisions_per_particle: float | None = None, *, progress: Any = None, **options: Any) -> MdReport:
        """Event-driven NVE dynamics. Returns an MdReport; report.status > 0 says that it stopped early."""
        return self._verb(
            "jam_run",
            "jam_run_options",
            "jam_md_report",
            progress,
            dict(options, collisions_per_particle=collisions_per_particle),
        )

    def compress(
        self,
        stages: Iterable[Mapping[str, float] | Sequence[float]] | None = None,
        *,
        progress: Any = None,
        **options: Any,
    ) -> MdReport:
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

    def crunch(
        self, *, progress: Any = None, on_step: Callable[[Step], Any] | None = None, **options: Any
    ) -> CrunchReport:
        """Iterated linear programming down to the jamming point. Returns the CrunchReport with the certificate.

        on_step: a callable(Step) that is given every step with its displacements and linear network (and makes each LP be
        solved in full, which is slower); a true answer stops the call.
        """
        if on_step is not None:
            user = reporter(progress)
            try:
                return self._verb(
                    "jam_crunch",
                    "jam_crunch_options",
                    "jam_crunch_report",
                    self._stepper(on_step, user),
                    {**options, "steps": 1},
                )
            finally:
                if hasattr(user, "close"):
                    user.close()
        return self._verb("jam_crunch", "jam_crunch_options", "jam_crunch_report", progress, options or None)

    def cancel(self) -> None:
        """Stops the call that runs on this system in another thread; without one, the next call."""
        raw.jam_cancel(self.handle)

    def log(self, callback: Callable[[int, str], Any] | None, level: int | str = "info") -> None:
        """Sends the library's log lines of up to this level to callback(level, line); None silences it."""
        handle = self.handle
        raw.set_log(handle, callback, _calls.as_enum(level, "LogLevel"))
        handle._log = callback  # the C side holds a borrowed reference


for _verb, _struct in (("run", "run"), ("compress", "compress"), ("crunch", "crunch")):
    getattr(Verbs, _verb).__doc__ += (
        "\n\n        progress: True for a bar, or a callable(Progress) whose true answer stops the call.\n        Options:\n    "
        + _calls.describe(f"jam_{_struct}_options").replace("\n", "\n    ")
        + "\n        "
    )
