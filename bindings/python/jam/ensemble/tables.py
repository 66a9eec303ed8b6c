"""Rows of packings as tables: numpy as they are stored, pandas with words for enums and options as columns."""
from __future__ import annotations

import os
from dataclasses import fields
from enum import IntEnum
from typing import Any, Iterator, Mapping

from .._api import generated
from .._api.arrays import Array
from .._api.generated import CrunchReport
from .folder import Folder, Place
from .protocol import minimal
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


def _flat(value: Any, name: str = "") -> Iterator[tuple[str, Any]]:
    """Options by names such as stages.0.growth_rate; a list of numbers is one value."""
    if isinstance(value, Mapping) and value:
        for key, part in value.items():
            yield from _flat(part, f"{name}.{key}" if name else str(key))
    elif isinstance(value, list) and any(isinstance(part, Mapping) for part in value):
        for k, part in enumerate(value):
            yield from _flat(part, f"{name}.{k}")
    else:
        yield name, value


def option_columns(protocols: Mapping[str, Mapping[str, Any]], of_rows: list[str]) -> dict[str, list[Any]]:
    """A column for each option that one of the protocols sets otherwise than the library does by itself.

    Parameters
    ----------
    protocols : mapping of str to complete protocol
    of_rows : list of str
        Name of the protocol of each row. Where a protocol has no such option the value is None.
    """
    used = {name: protocols[name] for name in dict.fromkeys(of_rows)}
    names = list(dict.fromkeys(key for p in used.values() for key, _ in _flat(minimal(p))))
    values = {name: dict(_flat(p)) for name, p in used.items()}
    return {key: [values[name].get(key) for name in of_rows] for key in names}


def as_table(rows: Array, pandas: bool, protocols: Mapping[str, Mapping[str, Any]] | None = None) -> Any:
    """The rows, or a DataFrame of them; protocols adds their options."""
    if not pandas:
        return rows
    import pandas as pd

    columns = {name: _column(rows, name) for name in FIELDS}
    if protocols is not None:
        columns.update(option_columns(protocols, list(columns["protocol"])))
    return pd.DataFrame(columns)


def readable(files: Folder, protocol: str | None = None) -> tuple[Array, list[Place]]:
    """Packings that count, of a protocol or of all, and where each lies; a warning names the files that are left out."""
    rows, places, damaged, doubles, _ = files.content()
    warn([*damaged.values(), *doubles.values()])
    mine = [k for k, name in enumerate(rows["protocol"].tolist()) if protocol in (None, name.decode())]
    return rows[mine], [places[k] for k in mine]


def protocols(folder: str | os.PathLike[str]) -> dict[str, dict[str, Any]]:
    """The protocols of a folder, a dict by name; Ensemble(folder, name) opens one."""
    return {name: read() for name, read in Folder(folder).protocols().items()}


def table(
    folder: str | os.PathLike[str], pandas: bool = False, unverified: bool = False, options: bool = False
) -> Any:
    """Reports of all packings of a folder, of every protocol: the table of Ensemble, whose column `protocol` names it.

    options: a DataFrame that also has a column for each option that one of the protocols sets otherwise than the library
    does by itself, such as start.n or stages.0.growth_rate.
    """
    files = Folder(folder, unverified)
    known = {name: read() for name, read in files.protocols().items()} if options else None
    return as_table(readable(files)[0], pandas or options, known)
