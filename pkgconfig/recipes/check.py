#!/usr/bin/env python3
"""Checks the recipes of this folder without their package managers; tests/package/recipes.py executes them.

One version everywhere, that of CMake or, between releases, of the last one; every JAM_ option that a recipe sets is an option of CMake.
usage: check.py ROOT
"""
import re
import sys
from pathlib import Path

root = Path(sys.argv[1]).resolve()
here = root / "pkgconfig/recipes"
problems = []

cmake = (root / "CMakeLists.txt").read_text() + (root / "bindings/CMakeLists.txt").read_text()
options = set(re.findall(r"(?:option|set)\((JAM_\w+)", cmake))
number, suffix = re.search(r'project\(jam VERSION ([\d.]+)[\s\S]*set\(JAM_VERSION_SUFFIX "([^"]*)', cmake).groups()
released = re.search(r"(?m)^version: ([\d.]+)$", (root / ".github/CITATION.cff").read_text()).group(1)
version = released if suffix else number
for path in sorted(here.rglob("*")):
    if not path.is_file() or path.suffix in (".md",) or path.name == "check.py":
        continue
    text = path.read_text()
    named = set(re.findall(r"-D(JAM_\w+)=", text)) | set(re.findall(r'define(?:_from_variant)?\("(JAM_\w+)"', text))
    problems += [f"{path.name}: CMake has no option {name}" for name in sorted(named - options)]
    if path.name not in ("portfile.cmake", "usage") and version not in text:
        problems.append(f"{path.name}: the version is not {version}")

for path in sorted((here.parent / "presets").glob("*.cmake")):
    named = set(re.findall(r"\b(JAM_\w+)", path.read_text()))
    problems += [f"{path.name}: CMake has no option {name}" for name in sorted(named - options)]
if released != version:
    problems.append(f".github/CITATION.cff: the version is not {version}")
if f'version = "{number}{suffix}"' not in (root / "bindings/julia/Jam/Project.toml").read_text():
    problems.append(f"bindings/julia/Jam/Project.toml: the version is not {number}{suffix}")
print("\n".join(problems) or "the recipes have the version and options of the tree")
sys.exit(bool(problems))
