"""Where a packing was made."""
from __future__ import annotations

import functools
import hashlib
import platform
import re
import socket
from pathlib import Path

import numpy as np

from .. import raw

#: The algorithm that makes packings, named by the release that was first to have it. With protocol and seed it is what a
#: packing of an ensemble is. It rises when one protocol and seed are meant to give another packing: another start, order of
#: random numbers or path of the dynamics, another default of an option, a crunch that ends elsewhere as a rule. It stays
#: where a build, a processor or a mended fault changes the last digits, or few packings. Files tell the builds apart.
ALGORITHM = "1.0.0"


def _library() -> str | None:
    try:
        with open("/proc/self/maps", encoding="utf-8") as maps:
            return next((line.split(maxsplit=5)[5].strip() for line in maps if "/libjam.so" in line), None)
    except OSError:
        return None


@functools.lru_cache(maxsize=None)
def provenance() -> dict[str, str]:
    """Version, commit, compiler, BLAS kernel, machine and Python of this process, and a digest of the library itself."""
    compiler, cpu, digest = "unknown", platform.machine(), ""
    path = _library()
    if path:
        data = Path(path).read_bytes()
        found = re.search(rb"(GCC: \([^)]*\) [\d.]+|clang version [\d.]+)", data)
        compiler = found.group(1).decode() if found else compiler
        digest = hashlib.sha256(data).hexdigest()[:16]
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as info:
            cpu = next((line.partition(":")[2].strip() for line in info if line.startswith("model name")), cpu)
    except OSError:
        pass
    return {
        "version": raw.jam_version(),
        "algorithm": ALGORITHM,
        "commit": raw.jam_commit(),
        "library": digest,
        "blas_kernel": raw.jam_blas_kernel(),
        "abi": str(raw.jam_abi_version()),
        "compiler": compiler,
        "machine": socket.gethostname(),
        "processor": cpu,
        "python": platform.python_version(),
        "numpy": np.__version__,
    }
