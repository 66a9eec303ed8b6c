"""Writes what is generated from include/jam/jam.h and the table of options.

usage: generate.py [--check] [--out FOLDER] [--options FOLDER] [--header FILE] [--swig PROGRAM]
    (nothing)         the page of the guide on the options
    --check           only says whether it differs
    --out FOLDER      the files of BUILT, which each build makes for itself, below FOLDER
    --options FOLDER  of these those of OPTIONS, which need no SWIG
"""
import argparse
import sys
from pathlib import Path

import emit_c
import emit_command_page
import emit_fortran
import emit_fortran_packing
import emit_js
import emit_julia
import emit_julia_calls
import emit_methods
import emit_octave
import emit_options
import emit_python
import emit_swig
import languages
from annotations import HeaderError
from header import read_header

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "bindings/docs/command_line.md"
OPTIONS = {
    "cli/options_table.h": emit_options.emit_c,
    "cli/jam-pack.bash": emit_options.emit_bash,
    "cli/_jam-pack": emit_options.emit_zsh,
}
BUILT = {
    **OPTIONS,
    "julia/raw.jl": emit_julia.emit,
    "julia/tables.jl": emit_julia_calls.emit_tables,
    "julia/methods.jl": emit_julia_calls.emit_methods,
    "fortran/jam.f90": emit_fortran.emit,
    "fortran/jam_packing.f90": emit_fortran_packing.emit,
    "python/jam_gen.i": emit_swig.emit,
    "python/jam/_api/generated.py": emit_python.emit,
    "python/jam/_api/exceptions.py": emit_python.emit_errors,
    "python/jam/_api/tuples.py": emit_methods.emit_tuples,
    "python/jam/_system/methods.py": emit_methods.emit,
    "js/api.mjs": emit_js.emit,
    "js/index.d.ts": emit_js.emit_types,
    "octave/jam_gen.i": emit_octave.emit,
    "layout.c": emit_c.emit,
}


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--out", type=Path)
    parser.add_argument("--options", type=Path)
    parser.add_argument("--header", default=ROOT / "include/jam/jam.h")
    parser.add_argument("--swig", default="swig")
    args = parser.parse_args()
    if args.options:
        for name, emit in OPTIONS.items():
            write(args.options / name, emit(None))
        return
    if not args.out:
        text = emit_command_page.emit()
        if PAGE.read_text() != text:
            if args.check:
                sys.exit(f"{PAGE} is not what the generator makes: run bindings/gen/generate.py")
            PAGE.write_text(text)
        return
    try:
        api = read_header(args.header, args.swig)
        languages.check(api)
    except HeaderError as error:
        sys.exit(f"{args.header}: {error}")
    for name, emit in BUILT.items():
        write(args.out / name, emit(api))


if __name__ == "__main__":
    main()
