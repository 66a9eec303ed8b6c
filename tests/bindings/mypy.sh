#!/bin/sh
# mypy.sh PACKAGE CACHE: the Python package under mypy --strict, by its mypy.ini, and a program that uses it, by its
# installed types.
command -v mypy >/dev/null || { echo "mypy is not installed (Debian: mypy): the types were not checked"; exit 77; }
program=$(cd "$(dirname "$0")" && pwd)/typed_program.py
cd "$1" && mypy --cache-dir "$2" && mypy --strict --config-file mypy.ini --cache-dir "$2" "$program"
