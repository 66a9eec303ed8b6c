"""Files of many packings, a group each."""
from __future__ import annotations

import os
from pathlib import Path
from typing import Any, Mapping

from .._api.generated import CrunchReport
from ..errors import StoreError
from .content import Packing
from .explain import explain, put_report
from .records import unpack
from .replacing import replacing
from .seal import seal
from .sealed import read_packing


def write_shard(path: str | os.PathLike[str], protocol: str, packings: Mapping[str, Path | tuple[Path, str | None]]) -> list[str]:
    """Writes one file of many packings, a group each, from their files by name; (file, name): from a shard.

    Returns what is wrong with each file that cannot be read: it is left out.
    """
    left_out: list[str] = []

    def fill(shard: Any) -> list[str]:
        shard.attrs["protocol"], made = protocol, []
        for name, place in packings.items():
            try:
                source, inner = place if isinstance(place, tuple) else (place, None)
                packing = read_packing(source, inner)
            except StoreError as error:
                left_out.append(str(error.strerror))
                continue
            _copy(packing, shard.create_group(name))
            made.append(name)
        return made

    try:
        with replacing(path, "w+b") as file:
            seal(file, fill)
    except StoreError:
        raise
    except OSError as error:
        raise StoreError(error.errno or 5, f"{path} cannot be written: {error}") from error
    return left_out


def _copy(packing: Packing, target: Any) -> None:
    """A packing into a group of another file."""
    for path, attributes in packing.attributes.items():
        target.require_group(path or ".").attrs.update(attributes)
    for path, value in packing.arrays.items():
        if path == "jam/report":
            put_report(target, path, unpack(value, CrunchReport))
        else:
            explain(target.create_dataset(path, data=value), path)
