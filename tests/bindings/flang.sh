#!/bin/sh
# The Fortran layer, its two tests and the examples by LLVM's compiler, beside gfortran, which builds all else. flang
# before 20 does not compile arguments of any rank: skipped (77) without a later one.
# usage: flang.sh ROOT FOLDER_OF_LIBJAM FOLDER_OF_GENERATED_SOURCES
set -eu
flang=
for name in flang-24 flang-23 flang-22 flang-21 flang-20; do
  if command -v $name >/dev/null; then flang=$name; break; fi
done
[ -n "$flang" ] || { echo "no flang of version 20 or later is installed"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
for file in "$3/jam" "$1/bindings/fortran/jam_base" "$3/jam_packing"; do
  "$flang" -O1 -c "$file.f90" -o "$(basename "$file").o"
done
run() {
  "$flang" -O1 "$1" jam.o jam_base.o jam_packing.o -L"$library" -ljam -Wl,-rpath,"$library" -o program
  shift
  ./program "$@" >output || { cat output; return 1; }
}
library=$2
run "$1/tests/bindings/fortran_layer.f90"
grep -q "all as expected" output
run "$1/tests/bindings/fortran_packing.f90"
grep -q "all as expected" output
for example in first cells; do run "$1/examples/fortran/$example.f90"; done
echo "$("$flang" --version | head -n 1): all as expected"
