"""Progress of long calls: a bar by tqdm if it is installed, else one line that is rewritten. A file gets nothing."""
from __future__ import annotations

import math
import sys
from typing import Any, Callable


def _time_left(p: Any) -> str:
    if math.isnan(p.fraction):
        return ""
    part = f"{100 * p.fraction:.0f} %"
    if math.isnan(p.seconds_left):
        return part
    low, high = p.seconds_left / p.seconds_left_spread, p.seconds_left * p.seconds_left_spread
    return f"{part}, {p.seconds_left:.2g} s left ({low:.2g} to {high:.2g})"


def _text(p: Any) -> str:
    word = getattr(p.phase, "name", str(p.phase)).lower()
    parts = [f"{word:8s}"] + ([] if math.isnan(p.packing_fraction) else [f"phi {p.packing_fraction:.8f}"])
    if word in ("run", "compress"):
        if not math.isnan(p.pressure):
            parts.append(f"p {p.pressure:.4g}")
        parts.append(f"{p.collisions:.3g} collisions")
    else:
        parts.append(f"step {p.steps}")
        if p.gain > 0:
            parts.append(f"gain {p.gain:.1e}")
    parts += [f"{p.seconds:.1f} s", _time_left(p)]
    return "  ".join(part for part in parts if part)


def _in_notebook() -> bool:
    shell = sys.modules.get("IPython")
    instance = shell.get_ipython() if shell else None
    return instance is not None and type(instance).__name__ == "ZMQInteractiveShell"


class Line:
    """Progress reporter; call it with a Progress, close it at the end."""

    def __init__(self) -> None:
        self._bar: Any = None
        self._last = ""
        self._on = sys.stderr is not None and sys.stderr.isatty() or _in_notebook()
        if self._on:
            try:
                from tqdm.auto import tqdm

                self._bar = tqdm(total=1.0, bar_format="{desc} |{bar}|", leave=True)
            except ImportError:
                pass

    def __call__(self, p: Any) -> bool:
        if not self._on:
            return False
        text = _text(p)
        if self._bar is not None:
            self._bar.set_description_str(text, refresh=False)
            if not math.isnan(p.fraction):
                self._bar.n = min(1.0, p.fraction)
            self._bar.refresh()
        else:
            sys.stderr.write("\r" + text.ljust(len(self._last)))
            sys.stderr.flush()
            self._last = text
        return False

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()
        elif self._last:
            sys.stderr.write("\n")


def end(told: Any) -> None:
    """Closes a reporter that can be closed."""
    if hasattr(told, "close"):
        told.close()


def reporter(progress: bool | Callable[..., Any] | None) -> Callable[..., Any] | None:
    if progress is True:
        return Line()
    if progress is None or progress is False:
        return None
    if not callable(progress):
        raise TypeError("progress must be True, False or a callable that takes a Progress")
    return progress
