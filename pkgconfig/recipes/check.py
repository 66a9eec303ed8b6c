#!/usr/bin/env python3
"""Checks the recipes of this folder without their package managers.

Syntax and fields; one version everywhere, that of CMake or, between releases, of the last one; every JAM_ option that a recipe sets is an option of CMake, and
every file that it installs is in the tree. usage: check.py ROOT
"""
import ast
import json
import re
import sys
from pathlib import Path

root = Path(sys.argv[1]).resolve()
here = root / "pkgconfig/recipes"
problems = []


def balanced(name, comment):
    """Brackets of Scheme or Julia, outside strings and comments, which begin with a mark."""
    text = re.sub(r'(?s)"(\\.|[^"\\])*"', '""', (here / name).read_text().replace('"""', '"'))
    text = re.sub(f"{comment}.*", "", text)
    open_brackets = []
    for character in text:
        if character in "([{":
            open_brackets.append(character)
        elif character in ")]}" and (not open_brackets or open_brackets.pop() + character not in ("()", "[]", "{}")):
            problems.append(f"{name}: a bracket does not fit")
    if open_brackets:
        problems.append(f"{name}: a bracket stays open")


def fields(name, there, wanted):
    problems.extend(f"{name}: {key} is missing" for key in wanted if key not in there)


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
ast.parse((here / "package.py").read_text())
port = json.loads((here / "vcpkg/vcpkg.json").read_text())
fields("vcpkg.json", port, ["name", "version", "license", "dependencies"])
balanced("guix.scm", ";")
balanced("build_tarballs.jl", "#")
try:
    import yaml
except ImportError:
    print("recipe.yaml was not parsed: there is no yaml module")
else:
    recipe = yaml.safe_load((here / "recipe.yaml").read_text())
    fields("recipe.yaml", recipe, ["schema_version", "context", "recipe", "source", "outputs", "about", "extra"])
    fields("recipe.yaml: about", recipe["about"], ["homepage", "license", "license_file", "summary"])
    fields("recipe.yaml: extra", recipe["extra"], ["recipe-maintainers"])
    for output in recipe["outputs"]:
        fields("recipe.yaml", output, ["package", "build", "requirements", "tests"])
        if '${{ stdlib("c") }}' not in output["requirements"]["build"]:
            problems.append('recipe.yaml: an output that compiles asks for stdlib("c")')
    problems += [f"recipe.yaml: {name} is not in the tree" for name in recipe["about"]["license_file"] if not (root / name).is_file()]
print("\n".join(problems) or "the recipes are well formed")
sys.exit(bool(problems))
