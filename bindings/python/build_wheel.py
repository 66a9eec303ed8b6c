"""The build backend of pyproject.toml (PEP 517): CMake builds the library and the module, and both go into one wheel.

`--config-settings build-dir=FOLDER` keeps the build, so that the next wheel is made faster.
"""
from __future__ import annotations

import base64
import hashlib
import os
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def _version() -> str:
    return re.search(r"project\(jam VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


def _tag() -> str:
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def _metadata() -> str:
    return f"""Metadata-Version: 2.1
Name: jam
Version: {_version()}
Summary: Jammed packings of hard spheres, made and analysed
License: MIT
Requires-Python: >=3.10
Requires-Dist: numpy>=1.20
Provides-Extra: all
Requires-Dist: scipy; extra == "all"
Requires-Dist: matplotlib; extra == "all"
Requires-Dist: h5py; extra == "all"
Requires-Dist: pandas; extra == "all"
Requires-Dist: tqdm; extra == "all"
"""


def _installed(folder: str, build: str | None) -> Path:
    """Builds the tree and installs its Python part below the folder, the library beside the module."""
    build, prefix = Path(build or Path(folder, "build")), Path(folder, "prefix")
    options = [
        "-DCMAKE_BUILD_TYPE=Release",
        "-DJAM_BUILD_PYTHON=ON",
        "-DJAM_BUILD_TESTS=OFF",
        "-DJAM_BUILD_EXAMPLES=OFF",
        "-DJAM_BUILD_CLI=OFF",
        f"-DJAM_PYTHON={sys.executable}",
        f"-DCMAKE_INSTALL_PREFIX={prefix}",
        "-DCMAKE_INSTALL_LIBDIR=jam",
        "-DJAM_PYTHON_DIR=.",
    ]
    jobs = str(os.cpu_count() or 1)
    subprocess.run(["cmake", "-S", str(ROOT), "-B", str(build), *options], check=True)
    subprocess.run(["cmake", "--build", str(build), "-j", jobs], check=True)
    for component in ("python", "runtime"):
        subprocess.run(["cmake", "--install", str(build), "--component", component], check=True)
    return prefix


def _hash(data: bytes) -> str:
    return "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()


def build_wheel(
    wheel_directory: str, config_settings: dict | None = None, metadata_directory: str | None = None
) -> str:
    name = f"jam-{_version()}-{_tag()}.whl"
    info = f"jam-{_version()}.dist-info"
    with tempfile.TemporaryDirectory() as folder:
        files = {}
        prefix = _installed(folder, (config_settings or {}).get("build-dir"))
        for file in sorted((prefix / "jam").rglob("*")):
            # a wheel holds no links: of the library's names only the one that the loader asks for
            if (
                file.is_file()
                and "__pycache__" not in file.parts
                and not re.search(r"\.so(\.\d+){3}$|jam\.so$", file.name)
            ):
                files[str(file.relative_to(prefix))] = file.read_bytes()
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: jam\nRoot-Is-Purelib: false\nTag: {_tag()}\n".encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    record = "".join(f"{path},{_hash(data)},{len(data)}\n" for path, data in files.items())
    files[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    with zipfile.ZipFile(Path(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in files.items():
            wheel.writestr(zipfile.ZipInfo(path, (2020, 1, 1, 0, 0, 0)), data, zipfile.ZIP_DEFLATED)
    return name
