"""What is there of an ensemble, and the warning of what cannot be read."""
from __future__ import annotations

import warnings
from dataclasses import dataclass, field
from typing import Iterable


class DamagedWarning(UserWarning):
    """Files of an ensemble that cannot be read are left out; the text names them."""


def warn(left_out: Iterable[str]) -> None:
    """Names the first files that are left out."""
    texts = list(left_out)
    if texts:
        more = f"; and {len(texts) - 5} more" if len(texts) > 5 else ""
        warnings.warn(f"{len(texts)} files are omitted: " + "; ".join(texts[:5]) + more, DamagedWarning, stacklevel=3)


@dataclass(frozen=True)
class Status:
    """What is there of the seeds asked for."""

    asked: int
    done: int
    jammed: int
    failed: int
    #: What is wrong with each file that cannot be read; a text names its file. Without seeds: of any protocol.
    damaged: tuple[str, ...] = ()
    #: Files that hold the packing of a seed that another file holds too, or that have the name of another packing.
    odd: tuple[str, ...] = ()
    #: Files that could not be read, whose packings run() has made again.
    remade: tuple[str, ...] = ()
    #: Packings that run() has made.
    made: int = 0
    #: Builds of libjam that made the packings: more than one may differ in the last bits. The table has columns of it.
    builds: tuple[str, ...] = field(default=())

    @property
    def missing(self) -> int:
        """Neither made, failed nor damaged."""
        return max(0, self.asked - self.done - self.failed - len(self.damaged))

    def __str__(self) -> str:
        text = (
            f"{self.done} of {self.asked} packings are there, {self.jammed} jammed; {self.failed} failed, "
            f"{self.missing} to be made"
        )
        if self.made:
            text += f"; {self.made} made now"
        if self.damaged:
            text += f"; {len(self.damaged)} damaged and omitted: " + "; ".join(self.damaged[:3])
        if self.odd:
            text += f"; {len(self.odd)} files are odd: " + "; ".join(self.odd[:3])
        if self.remade:
            text += f"; made again: {', '.join(self.remade)}"
        if len(self.builds) > 1:
            text += f"; made by {len(self.builds)} builds: " + ", ".join(self.builds)
        return text
