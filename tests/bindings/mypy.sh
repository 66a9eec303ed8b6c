#!/bin/sh
# mypy.sh CONFIG FOLDER CACHE: the Python package in the folder under mypy --strict, and a program that uses it, by its
# types.
command -v mypy >/dev/null || { echo "mypy is not installed (Debian: mypy): the types were not checked"; exit 77; }
program=$(cd "$(dirname "$0")" && pwd)/typed_program.py
cd "$2" && mypy --config-file "$1" --cache-dir "$3" && mypy --config-file "$1" --cache-dir "$3" "$program"
