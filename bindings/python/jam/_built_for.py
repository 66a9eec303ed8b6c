"""Says what this Python lacks, or which Python the compiled part is for: the import would only miss a name."""
import sys
from importlib.util import find_spec
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path


def refuse_another_python() -> None:
    if find_spec("numpy") is None:
        raise ImportError(f"jam needs numpy, which {sys.executable} does not find: install it there, or run another Python")
    built = [path.name for path in Path(__file__).parent.glob("_raw.*.so")]
    if built and not any("_raw" + suffix in built for suffix in EXTENSION_SUFFIXES):
        raise ImportError(
            f"jam was built for another Python: {', '.join(built)} does not fit Python {sys.version.split()[0]} of "
            f"{sys.executable}. Run the Python that it was built for, or configure with -DJAM_PYTHON={sys.executable}"
        )
