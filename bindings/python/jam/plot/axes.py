"""Where pictures are drawn."""
from __future__ import annotations

import sys
from typing import Any


def axes_of(ax: Any, square: bool = False) -> Any:
    """The axes given, or those of a new figure: of pyplot where it is imported, else free."""
    if ax is not None:
        return ax
    size = (5.6, 5.6) if square else (5.6, 4.2)
    pyplot = sys.modules.get("matplotlib.pyplot")
    if pyplot is not None:
        return pyplot.subplots(figsize=size, layout="constrained")[1]
    from matplotlib.figure import Figure

    return Figure(figsize=size, layout="constrained").subplots()
