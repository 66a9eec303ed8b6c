#!/bin/sh
# header.sh INCLUDE_DIR: jam.h is pedantic C99, later C and C++, twice in one file and alone, under every compiler
# there is; jam.hpp is C++17 without a warning.
set -eu
include=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
printf '#include <jam/jam.h>\n#include <jam/jam.h>\nint main(void) { return jam_abi_version() == JAM_ABI; }\n' \
  >"$scratch/a.c"
cp "$scratch/a.c" "$scratch/a.cpp"
strict="-pedantic-errors -Wall -Wextra -Werror -fsyntax-only"
for cc in gcc clang; do
  command -v $cc >/dev/null || continue
  for std in c99 c11 c17; do
    $cc -std=$std $strict -Wstrict-prototypes -Wmissing-prototypes -Wc++-compat -I"$include" "$scratch/a.c"
  done
  for std in c++11 c++17 c++20; do
    $cc -x c++ -std=$std $strict -I"$include" "$scratch/a.cpp"
  done
  [ $cc = gcc ] || more="-Wcomma -Wweak-vtables"
  $cc -x c++ -std=c++17 $strict ${more:-} -I"$include" -include jam/jam.hpp "$scratch/a.cpp"
  echo "$cc: ok"
done
