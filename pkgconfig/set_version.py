#!/usr/bin/env python3
"""Sets version and ABI number in every file of the tree that names them, and lists where another one is left.

usage: set_version.py ROOT VERSION ABI     Then: a build, tests/abi/abi.py update BUILD.
VERSION is that of a release, 1.2.3, or of the tree between two releases, 1.2.3-dev. The latter leaves the recipes, the citation
and Debian's changelog alone: they name the last release.
"""
import os
import re
import subprocess
import sys
import time
from pathlib import Path

root, version, abi = Path(sys.argv[1]).resolve(), sys.argv[2], sys.argv[3]
if not re.fullmatch(r"\d+\.\d+\.\d+(-dev)?", version) or not abi.isdigit():
    sys.exit(__doc__)
number, dash, dev = version.partition("-")
now = int(os.environ.get("SOURCE_DATE_EPOCH", time.time()))
today, at = (time.strftime(form, time.gmtime(now)) for form in ("%Y-%m-%d", "%a, %d %b %Y %H:%M:%S +0000"))

NUMBER = r"\d+\.\d+\.\d+"
# file, what stands there, what shall; {v}, {n}, {s}, {m} and {a} are version, its numbers, its suffix, its first two
# numbers and the ABI number
TREE = [
    ("CMakeLists.txt", rf"(project\(jam VERSION ){NUMBER}", r"\g<1>{n}"),
    ("CMakeLists.txt", r'(set\(JAM_VERSION_SUFFIX ")[^"]*', r"\g<1>{s}"),
    ("bindings/julia/Jam/Project.toml", rf'(?m)^(version = "){NUMBER}[^"]*', r"\g<1>{v}"),
    ("tests/package/consumer/CMakeLists.txt", r"(find_package\(jam )\d+\.\d+", r"\g<1>{m}"),
    ("include/jam/jam.h", r"(?m)^(#define JAM_ABI )\d+", r"\g<1>{a}"),
    ("src/capi/jam.map", r"JAM_\d+", "JAM_{a}"),
    *((name, r"libjam\d+", "libjam{a}") for name in (
        "pkgconfig/debian/control", "pkgconfig/debian/check.sh", "pkgconfig/package.cmake", "bindings/README.md",
        "pkgconfig/package_scripts.cmake", "tests/bindings/deb.sh", "bindings/docs/quickstart.md")),
    *((name, r"libjam\.so\.\d+", "libjam.so.{a}") for name in (
        "tests/bindings/deb.sh", "bindings/julia/Jam/src/Jam.jl", "bindings/docs/julia.md")),
]  # fmt: skip
RELEASE = [
    (".github/CITATION.cff", rf"(?m)^version: {NUMBER}\n(date-released: .*\n)?", "version: {v}\ndate-released: {d}\n"),
    ("bindings/docs/cite.md", rf"(version = {{){NUMBER}", r"\g<1>{v}"),
    ("pkgconfig/recipes/package.py", rf'(version\("|/v){NUMBER}', r"\g<1>{v}"),
    ("pkgconfig/recipes/guix.scm", rf'(\(version "){NUMBER}', r"\g<1>{v}"),
    ("pkgconfig/recipes/recipe.yaml", rf'(version: "){NUMBER}', r"\g<1>{v}"),
    ("pkgconfig/recipes/build_tarballs.jl", rf'(version = v"){NUMBER}', r"\g<1>{v}"),
    ("pkgconfig/recipes/vcpkg/vcpkg.json", rf'("version": "){NUMBER}', r"\g<1>{v}"),
]  # fmt: skip

for name, before, after in TREE + ([] if dev else RELEASE):
    text = (root / name).read_text()
    values = dict(v=version, n=number, s=dash + dev, m=number.rpartition(".")[0], a=abi, d=today)
    new, found = re.subn(before, after.format(**values), text)
    if not found:
        sys.exit(f"{name} has nothing like {before}")
    (root / name).write_text(new)
debian = root / "pkgconfig/debian"
changes = debian / "changelog"
earlier = changes.read_text()
if not dev and not earlier.startswith(f"libjam ({version}-"):  # entries of earlier releases stay as they are
    maintainer = re.search(r"(?m)^ -- (.*>)", earlier).group(1)
    entry = f"libjam ({version}-1) unstable; urgency=medium\n\n  * New upstream release.\n\n -- {maintainer}  {at}\n\n"
    changes.write_text(entry + earlier)
for file in sorted(debian.glob("libjam[0-9]*.*")):
    file.rename(debian / re.sub(r"^libjam\d+", f"libjam{abi}", file.name))

# Records and results name what they were made with.
KEPT = ("tests/abi/", "tests/bench/results/", "pkgconfig/debian/libjam", "CHANGELOG.md", "pkgconfig/set_version.py")
listed = subprocess.run(["git", "-C", str(root), "ls-files", "-z"], capture_output=True, text=True).stdout.split("\0")
left = []
for name in listed or []:
    if not name or name.startswith(KEPT) or not (root / name).is_file():
        continue
    try:
        lines = (root / name).read_text(encoding="utf-8").splitlines()
    except UnicodeDecodeError:
        continue
    for number, line in enumerate(lines, 1):
        for other in re.findall(r"\blibjam(?:\.so\.)?(\d+)\b(?!\.\d)", line):
            if other != abi:
                left.append(f"{name}:{number}: {line.strip()}")
print("\n".join(left) or f"version {version}, ABI {abi}")
sys.exit(bool(left))
