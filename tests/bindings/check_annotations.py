"""Prose of the header changes no generated code: a header with nothing but tags in its comments generates the same."""
import argparse
import ast
import re
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bindings/gen"))

import annotations  # noqa: E402
import generate  # noqa: E402
import languages  # noqa: E402
from header import read_header  # noqa: E402

HEADING = re.compile(r"^(\w+ : .*|Parameters|Returns|Raises|\w+Error(, \w+Error)*)$")


def python_code(text):
    """Names, types and values; of docstrings what stands in them as code: parameters, types, shapes, exceptions."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") == "OPTIONS":
            for options in node.value.values:
                options.values = [v.elts[0] for v in options.values]  # without the meaning
        if isinstance(node, (ast.ClassDef, ast.FunctionDef, ast.Module)) and ast.get_docstring(node) is not None:
            lines = [line.strip() for line in ast.get_docstring(node).splitlines()]
            node.body[0].value.value = [line for line in lines if HEADING.match(line)]
    return ast.dump(tree, indent=1)


def code(name, text):
    """A generated file without what it says to people."""
    if name.endswith(".py"):
        return python_code(text)
    if name.endswith(".jl"):
        text = re.sub(r'""".*?"""\n', "", text, flags=re.S)
    if name.endswith(".i"):
        text = re.sub(r'%feature\("docstring"\) (\w+) ".*?(?<!\\)"\n', r"\1\n", text, flags=re.S)
    if name.endswith((".ts", ".mjs")):
        text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    comment = {".jl": "#", ".f90": "!"}.get(Path(name).suffix)
    lines = [line.split(comment)[0].rstrip() if comment else line for line in text.splitlines()]
    return "\n".join(line for line in lines if line.strip())


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--swig", default="swig")
    swig = parser.parse_args().swig
    header = ROOT / "include/jam/jam.h"
    bare = annotations.stripped(header.read_text())
    words = sum(len(c.split()) for c in re.findall(r"/\*(.*?)\*/", bare, re.S))
    assert words < 0.2 * sum(len(c.split()) for c in re.findall(r"/\*(.*?)\*/", header.read_text(), re.S)), words
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "jam.h"
        copy.write_text(bare)
        full, without = read_header(header, swig), read_header(copy, swig)
        # a call that neither a rule nor a list has ends the build, with its name
        copy.write_text(header.read_text().replace("JAM_API const char *jam_notes", "JAM_API const char *jam_new_text(void);\nJAM_API const char *jam_notes"))
        languages.check(full)
        try:
            languages.check(read_header(copy, swig))
            sys.exit("a call that no language lists was taken")
        except annotations.HeaderError as error:
            assert "jam_new_text" in str(error), error
    page = (ROOT / "bindings/docs/add_language.md").read_text()
    unnamed = {a.role for f in full.functions for a in f.args} - set(re.findall(r"`(\w+)`", page))
    if unnamed:
        sys.exit(f"add_language.md does not name the roles {sorted(unnamed)}")
    assert len(generate.BUILT) >= 6, generate.BUILT
    changed = [n for n in generate.BUILT if code(n, generate.BUILT[n](full)) != code(n, generate.BUILT[n](without))]
    if changed:
        sys.exit(f"prose of {header} decides on code in {', '.join(changed)}")
    print(f"{len(full.functions)} functions, {len(full.structs)} structs: the same code without prose")


if __name__ == "__main__":
    main()
