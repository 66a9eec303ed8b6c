"""Files of many packings, a group each."""
from __future__ import annotations

import os
from pathlib import Path
from typing import Any, Mapping

from .._api.generated import CrunchReport
from ..errors import StoreError
from .explain import explain
from .groups import Group
from .read_packing import jam_of
from .records import unpack
from .replacing import replacing
from .seal import seal
from .sealed import open_file
from .write_packing import put


def write_shard(path: str | os.PathLike[str], protocol: str, packings: Mapping[str, Path | tuple[Path, str | None]]) -> list[str]:
    """Writes one file of many packings, a group each, from their files by name; (file, name): from a shard.

    Returns what is wrong with each file that cannot be read: it is left out.
    """
    left_out: list[str] = []

    def fill(shard: Any) -> list[str]:
        shard.attrs["protocol"], made = protocol, []
        for name, place in packings.items():
            source, inner = place if isinstance(place, tuple) else (place, None)
            try:
                with open_file(source) as file:  # checked as a whole
                    packing: Any = file[inner] if inner else file
                    jam_of(packing, source)
                    copy(packing, shard.create_group(name))
                    made.append(name)
            except StoreError as error:
                left_out.append(str(error.strerror))
        return made

    try:
        with replacing(path, "w+b") as memory:
            seal(memory, fill)
    except StoreError:
        raise
    except OSError as error:
        raise StoreError(error.errno or 5, f"{path} cannot be written: {error}") from error
    return left_out


def copy(source: Any, target: Any, at: str = "") -> None:
    """A group of a file into another file."""
    target.attrs.update(source.attrs)
    for name, node in source.items():
        if isinstance(node, Group):
            copy(node, target.create_group(name), f"{at}{name}/")
        elif at + name == "jam/report":
            put(target, name, unpack(node, CrunchReport))
        else:
            explain(target.create_dataset(name, data=node), at + name)
