"""The build backend of pyproject.toml (PEP 517): CMake builds the library and the module, and both go into one wheel.

The wheel has dense products of libjam's own and no Clp, so that it needs no library beside those that every system has.
`--config-settings build-dir=FOLDER` keeps the build, so that the next wheel is made faster;
`--config-settings "cmake=-DJAM_LAPACK=ON -GNinja"` adds options of CMake, in one text: pip before 23.1
takes the last of several settings.
"""
from __future__ import annotations

import base64
import gzip
import hashlib
import io
import os
import re
import shlex
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile
from pathlib import Path

import wheel_tag

NAME = "jamming"
ROOT = Path(__file__).resolve().parents[2]
LICENCES = ("LICENSE", "pkgconfig/LINKED.md")


def _version() -> str:
    """As Python writes it: 1.1.0-dev is 1.1.0.dev0."""
    cmake = (ROOT / "CMakeLists.txt").read_text()
    number, suffix = re.search(r'project\(jam VERSION ([\d.]+)[\s\S]*set\(JAM_VERSION_SUFFIX "([^"]*)', cmake).groups()
    return number + suffix.replace("-dev", ".dev0")


def _tag(files: dict[str, bytes]) -> str:
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    objects = {name: data for name, data in files.items() if ".so" in name}
    return f"{python}-{python}-{wheel_tag.platform_tag(objects)}"


def _metadata(licences: bool = True, objects: dict[str, bytes] | None = None) -> str:
    """METADATA.in, whose head an install by CMake has too, with the README as the description."""
    head = (ROOT / "bindings/python/METADATA.in").read_text().replace("@JAM_PYTHON_VERSION@", _version())
    # zig's compilers put these two into the objects
    for library, licence in (b"libz.so", "Zlib"), (b"libstdc++.so", "Apache-2.0 WITH LLVM-exception"):
        if objects and not any(library in data for data in objects.values()):
            head = re.sub("(?m)^License-Expression: .*", rf"\g<0> AND {licence}", head)
    named = "".join(f"License-File: {Path(path).name}\n" for path in LICENCES)
    source = re.search(r"Project-URL: Source, (.*)", head).group(1)
    release = re.search(r"(?m)^version: (.*)$", (ROOT / ".github/CITATION.cff").read_text()).group(1)
    # links of the README are those of its folder, which an index does not have
    readme = (ROOT / "README.md").read_text()
    for kind, mark in (("raw", r"(!\[[^]]*\]"), ("blob", r"(\]")):
        readme = re.sub(mark + r"\()(?!https?:|#)/?([^)]+)", rf"\1{source}/{kind}/v{release}/\2", readme)
    return f"{head}{named if licences else ''}Description-Content-Type: text/markdown; charset=UTF-8\n\n{readme}"


def _installed(folder: str, config: dict) -> Path:
    """Builds the tree and installs its Python part below the folder, the library beside the module."""
    build, prefix = Path(config.get("build-dir") or Path(folder, "build")), Path(folder, "prefix")
    given = config.get("cmake") or []  # later versions of pip make a list of repeated settings
    options = [
        "-DCMAKE_BUILD_TYPE=Release",
        "-DCMAKE_UNITY_BUILD=ON",
        "-DJAM_LAPACK=OFF",
        "-DJAM_CLP=OFF",
        "-DJAM_USE_VORO=OFF",
        "-DJAM_BUILD_PYTHON=ON",
        "-DJAM_BUILD_TESTS=OFF",
        "-DJAM_BUILD_EXAMPLES=OFF",
        "-DJAM_BUILD_CLI=OFF",
        f"-DJAM_PYTHON={sys.executable}",
        f"-DCMAKE_INSTALL_PREFIX={prefix}",
        "-DCMAKE_INSTALL_LIBDIR=jam",
        "-DJAM_PYTHON_DIR=.",
        *(shlex.split(given) if isinstance(given, str) else given),
    ]
    jobs = str(os.cpu_count() or 1)
    subprocess.run(["cmake", "-S", str(ROOT), "-B", str(build), *options], check=True)
    subprocess.run(["cmake", "--build", str(build), "-j", jobs], check=True)
    for component in ("python", "runtime"):
        subprocess.run(["cmake", "--install", str(build), "--component", component, "--strip"], check=True)
    return prefix


def _hash(data: bytes) -> str:
    return "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()


def build_wheel(
    wheel_directory: str, config_settings: dict | None = None, metadata_directory: str | None = None
) -> str:
    info = f"{NAME}-{_version()}.dist-info"
    processor = sysconfig.get_platform().rpartition("-")[2]  # _PYTHON_HOST_PLATFORM names another one in a cross build
    with tempfile.TemporaryDirectory() as folder:
        files = {}
        prefix = _installed(folder, config_settings or {})
        for file in sorted((prefix / "jam").rglob("*")):
            # a wheel holds no links: of the library's names only the one that the loader asks for
            if (
                file.is_file()
                and "__pycache__" not in file.parts
                and not re.search(r"\.so(\.\d+){3}$|jam\.so$", file.name)
            ):
                files[str(file.relative_to(prefix)).replace(f"-{os.uname().machine}-", f"-{processor}-")] = file.read_bytes()
    tag = _tag(files)
    files[f"{info}/METADATA"] = _metadata(objects={name: data for name, data in files.items() if ".so" in name}).encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: jam\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    for path in LICENCES:
        files[f"{info}/licenses/{Path(path).name}"] = (ROOT / path).read_bytes()
    record = "".join(f"{path},{_hash(data)},{len(data)}\n" for path, data in files.items())
    files[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    name = f"{NAME}-{_version()}-{tag}.whl"
    with zipfile.ZipFile(Path(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in files.items():
            wheel.writestr(zipfile.ZipInfo(path, (2020, 1, 1, 0, 0, 0)), data, zipfile.ZIP_DEFLATED)
    return name


def _sources() -> list[str]:
    """What git has; in a tree without git, all but builds."""
    listed = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-z"], capture_output=True, text=True)
    if listed.returncode == 0 and listed.stdout:
        return sorted(name for name in listed.stdout.split("\0") if name and (ROOT / name).is_file())
    found = (path.relative_to(ROOT) for path in ROOT.rglob("*") if path.is_file())
    return sorted(str(path) for path in found if not path.parts[0].startswith("build") and "__pycache__" not in path.parts)


def build_sdist(sdist_directory: str, config_settings: dict | None = None) -> str:
    """The whole tree: a wheel is made from it as from a clone. The same tree gives the same bytes."""
    base = f"{NAME}-{_version()}"
    name = f"{base}.tar.gz"
    files = {path: (ROOT / path).read_bytes() for path in _sources()}
    files["PKG-INFO"] = _metadata(licences=False).encode()  # LINKED.md has another place there
    commit = subprocess.run(["git", "-C", str(ROOT), "rev-parse", "HEAD"], capture_output=True, text=True)
    if commit.returncode == 0:
        archived = "pkgconfig/archive_commit"
        files[archived] = files[archived].replace(b"$Format:%H$", commit.stdout.strip().encode())
    # an archive of source is built from its root
    project = (ROOT / "bindings/python/pyproject.toml").read_bytes()
    files["pyproject.toml"] = project.replace(b'backend-path = ["."]', b'backend-path = ["bindings/python"]')
    with open(Path(sdist_directory, name), "wb") as raw, gzip.GzipFile("", "wb", 9, raw, mtime=0) as packed:
        with tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as archive:
            for path, data in sorted(files.items()):
                entry = tarfile.TarInfo(f"{base}/{path}")
                entry.size, entry.mode = len(data), 0o644
                if path != "PKG-INFO" and os.access(ROOT / path, os.X_OK):
                    entry.mode = 0o755
                archive.addfile(entry, io.BytesIO(data))
    return name
