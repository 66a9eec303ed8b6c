"""The C functions as SWIG wraps them: jam.raw.jam_crunch and so on. Their types are those of jam.h."""
from typing import Any

def __getattr__(name: str) -> Any: ...
