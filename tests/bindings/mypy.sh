#!/bin/sh
# mypy.sh PACKAGE CACHE: the Python package under mypy --strict, by the section of its pyproject.toml.
command -v mypy >/dev/null || { echo "mypy is not installed (Debian: mypy): the types were not checked"; exit 77; }
cd "$1" && exec mypy --cache-dir "$2"
