"""Rows of packings as tables: numpy as they are stored, pandas with words for enums."""
from __future__ import annotations

import os
from dataclasses import fields
from enum import IntEnum
from typing import Any

from .._api import generated
from .._api.arrays import Array
from .._api.generated import CrunchReport
from .folder import Folder, Place
from .row import FIELDS
from .status import warn

#: Enum of each field of the table that has one.
ENUMS: dict[str, type[IntEnum]] = {
    f.name: found
    for f in fields(CrunchReport)
    if isinstance(found := getattr(generated, str(f.type), None), type) and issubclass(found, IntEnum)
}


def _column(rows: Array, name: str) -> Any:
    """Text as str, and enums as words: None for a number that has none."""
    column = rows[name]
    if column.dtype.kind == "S":
        return column.astype(str)
    if name in ENUMS:
        words = {int(value): value.name.lower() for value in ENUMS[name]}
        return [words.get(int(number)) for number in column]
    return column


def as_table(rows: Array, pandas: bool) -> Any:
    """The rows, or a DataFrame of them."""
    if not pandas:
        return rows
    import pandas as pd

    return pd.DataFrame({name: _column(rows, name) for name in FIELDS})


def readable(files: Folder, protocol: str | None = None) -> tuple[Array, list[Place]]:
    """Packings that count, of a protocol or of all, and where each lies; a warning names the files that are left out."""
    rows, places, damaged, doubles, _ = files.content()
    warn([*damaged.values(), *doubles.values()])
    mine = [k for k, name in enumerate(rows["protocol"].tolist()) if protocol in (None, name.decode())]
    return rows[mine], [places[k] for k in mine]


def protocols(folder: str | os.PathLike[str]) -> dict[str, dict[str, Any]]:
    """The protocols of a folder, a dict by name; Ensemble(folder, name) opens one."""
    return {name: read() for name, read in Folder(folder).protocols().items()}


def table(folder: str | os.PathLike[str], pandas: bool = False) -> Any:
    """Reports of all packings of a folder, of every protocol: the table of Ensemble, whose column `protocol` names it."""
    return as_table(readable(Folder(folder))[0], pandas)
