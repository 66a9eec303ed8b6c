#!/usr/bin/env python3
"""Which systems a wheel runs on: the versions of GLIBC and of GCC's libraries that its shared objects ask for.

usage: wheel_tag.py WHEEL...     prints them, and the tag that they allow; exit status 1 where the wheel claims more
"""
from __future__ import annotations

import re
import sys
import sysconfig
import zipfile

# Libraries that every system of a manylinux tag has (PEP 600). Another one would have to be in the wheel.
EVERYWHERE = r"lib(c|m|dl|rt|pthread|stdc\+\+|gcc_s|z)\.so(\.\d+)*|ld-linux[-\w]*\.so\.\d"
# manylinux_2_X has these versions of GCC's library, by the policies of auditwheel.
GLIBCXX = {19: 17, 22: 24, 24: 28, 28: 31, 29: 34, 30: 35, 31: 38, 32: 39, 33: 41}


def reached(objects: dict[str, bytes]) -> tuple[dict[str, tuple[int, ...]], list[str]]:
    """The highest version of each library, and names of libraries that are neither in the wheel nor everywhere."""
    versions: dict[str, tuple[int, ...]] = {}
    foreign = set()
    for data in objects.values():
        # names of versions and libraries stand as they are in the table of dynamic strings
        for library, version in re.findall(rb"\0(GLIBC|GLIBCXX)_([\d.]+)(?=\0)", data):
            found = tuple(int(part) for part in version.split(b"."))
            versions[library.decode()] = max(versions.get(library.decode(), (0,)), found)
        foreign |= {name.decode() for name in re.findall(rb"\0((?:lib[\w+-]+|ld-linux[\w-]*)\.so[.\d]*)(?=\0)", data)}
    own = {name.rsplit("/", 1)[-1] for name in objects}
    return versions, sorted(name for name in foreign - own if not re.fullmatch(EVERYWHERE, name))


def platform_tag(objects: dict[str, bytes]) -> str:
    """manylinux_2_X where the objects ask for nothing else; the platform of this Python otherwise."""
    here = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    versions, foreign = reached(objects)
    if not here.startswith("linux_") or foreign or "GLIBC" not in versions:
        return here
    minor = max(17, versions["GLIBC"][1])
    step = versions.get("GLIBCXX", (0, 0, 0))[2] if len(versions.get("GLIBCXX", ())) > 2 else 0
    newer = [tag for library, tag in sorted(GLIBCXX.items()) if library >= step]
    if step > min(GLIBCXX):
        minor = max(minor, newer[0] if newer else minor)
    return here.replace("linux_", f"manylinux_2_{minor}_", 1)


def shared_objects(wheel: str) -> dict[str, bytes]:
    with zipfile.ZipFile(wheel) as file:
        return {name: file.read(name) for name in file.namelist() if ".so" in name.rsplit("/", 1)[-1]}


def main() -> int:
    status = 0
    for wheel in sys.argv[1:]:
        objects = shared_objects(wheel)
        versions, foreign = reached(objects)
        tag = platform_tag(objects)
        print(f"{wheel.rsplit('/', 1)[-1]}: {tag}")
        for library, version in sorted(versions.items()):
            print(f"  {library}_{'.'.join(map(str, version))}")
        if foreign:
            print("  not in it:", ", ".join(foreign))
        claimed = wheel[: -len(".whl")].rsplit("-", 1)[-1]
        if claimed != tag or foreign:
            print(f"  it claims {claimed}")
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
