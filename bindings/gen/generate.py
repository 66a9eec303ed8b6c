"""Writes what is generated from include/jam/jam.h and the table of options.

usage: generate.py [--check] [--out FOLDER] [--header FILE] [--swig PROGRAM]
    (nothing)     the files of COMMITTED, which a build without SWIG needs
    --check       only says which of these differ
    --out FOLDER  the files of BUILT, which each build makes for itself, below FOLDER
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
from model import read_header

ROOT = Path(__file__).resolve().parents[2]
COMMITTED = {
    "bindings/cli/options_table.h": emit_options.emit_c,
    "bindings/cli/completion/jam-pack.bash": emit_options.emit_bash,
    "bindings/cli/completion/_jam-pack": emit_options.emit_zsh,
    "bindings/docs/command_line.md": emit_command_page.emit,
}
BUILT = {
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
    parser.add_argument("--header", default=ROOT / "include/jam/jam.h")
    parser.add_argument("--swig", default="swig")
    args = parser.parse_args()
    try:
        api = read_header(args.header, args.swig)
        languages.check(api)
    except HeaderError as error:
        sys.exit(f"{args.header}: {error}")
    if args.out:
        for name, emit in BUILT.items():
            write(args.out / name, emit(api))
        return
    texts = {ROOT / name: emit(api) for name, emit in COMMITTED.items()}
    stale = [path for path, text in texts.items() if not path.exists() or path.read_text() != text]
    for path in stale:
        print(("is not what the generator makes: " if args.check else "written: ") + str(path.relative_to(ROOT)))
        if not args.check:
            write(path, texts[path])
    if args.check and stale:
        sys.exit("run: sh bindings/gen/regenerate.sh")


if __name__ == "__main__":
    main()
