"""Writes every generated file of the bindings from include/jam/jam.h and the table of options. With --check only says what differs.

usage: generate.py [--check] [--header FILE] [--swig PROGRAM]
"""
import argparse
import sys
from pathlib import Path

import emit_c
import emit_fortran
import emit_fortran_packing
import emit_julia
import emit_julia_calls
import emit_methods
import emit_options
import emit_python
import emit_swig
from annotations import HeaderError
from model import read_header

ROOT = Path(__file__).resolve().parents[2]
FILES = {
    "bindings/julia/Jam/src/raw.jl": emit_julia.emit,
    "bindings/julia/Jam/src/tables.jl": emit_julia_calls.emit_tables,
    "bindings/julia/Jam/src/methods.jl": emit_julia_calls.emit_methods,
    "bindings/fortran/jam.f90": emit_fortran.emit,
    "bindings/fortran/jam_packing.f90": emit_fortran_packing.emit,
    "bindings/python/jam_gen.i": emit_swig.emit,
    "bindings/python/jam/_api/generated.py": emit_python.emit,
    "bindings/python/jam/_api/exceptions.py": emit_python.emit_errors,
    "bindings/python/jam/_api/tuples.py": emit_methods.emit_tuples,
    "bindings/python/jam/_system/methods.py": emit_methods.emit,
    "tests/bindings/layout.c": emit_c.emit,
    "bindings/cli/options_table.h": emit_options.emit_c,
    "bindings/cli/completion/jam-pack.bash": emit_options.emit_bash,
    "bindings/cli/completion/_jam-pack": emit_options.emit_zsh,
    "bindings/docs/command_line.md": emit_options.emit_page,
}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--header", default=ROOT / "include/jam/jam.h")
    parser.add_argument("--swig", default="swig")
    args = parser.parse_args()
    try:
        api = read_header(args.header, args.swig)
    except HeaderError as error:
        sys.exit(f"{args.header}: {error}")
    stale = []
    for name, emit in FILES.items():
        path, text = ROOT / name, emit(api)
        if path.exists() and path.read_text() == text:
            continue
        stale.append(name)
        if not args.check:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
    for name in stale:
        print(("is not what the generator makes: " if args.check else "written: ") + name)
    if args.check and stale:
        sys.exit("run: sh bindings/gen/regenerate.sh")


if __name__ == "__main__":
    main()
