"""Files of many packings, a group each."""
from __future__ import annotations

import os
from pathlib import Path
from typing import Iterator, Mapping

from .._api.generated import CrunchReport
from ..errors import StoreError
from .content import Packing
from .records import report_text, report_value, unpack
from .replacing import replacing
from .seal import seal
from .sealed import read_packing


def write_shard(path: str | os.PathLike[str], protocol: str, packings: Mapping[str, Path | tuple[Path, str | None]]) -> list[str]:
    """Writes one file of many packings, a group each, from their files by name; (file, name): from a shard.

    Returns what is wrong with each file that cannot be read: it is left out.
    """
    left_out: list[str] = []

    def found() -> Iterator[tuple[str, Packing]]:
        for name, place in packings.items():
            try:
                source, inner = place if isinstance(place, tuple) else (place, None)
                packing = read_packing(source, inner)
            except StoreError as error:
                left_out.append(str(error.strerror))
                continue
            if "jam/report" in packing.arrays:  # with the words of its enums
                report = unpack(packing.arrays["jam/report"], CrunchReport)
                packing.arrays["jam/report"] = report_value(report)
                packing = packing._replace(texts={"jam/report": report_text(report)})
            yield name, packing

    try:
        with replacing(path, "w+b") as file:
            seal(file, found(), protocol=protocol)
    except StoreError:
        raise
    except OSError as error:
        raise StoreError(error.errno or 5, f"{path} cannot be written: {error}") from error
    return left_out
