#!/bin/sh
# format.sh ROOT: C and C++ files are as clang-format 14 with .clang-format leaves them. Skipped (77) without it.
set -eu
cd "$1"
tool=$(command -v clang-format-14 || command -v clang-format || true)
[ -n "$tool" ] || { echo "skipped: no clang-format"; exit 77; }
case $("$tool" --version) in *" 14."*) ;; *) echo "skipped: $("$tool" --version), not 14"; exit 77 ;; esac
find include src tests examples bindings/cli \( -name '*.[ch]' -o -name '*.[ch]pp' \) \
  ! -path 'tests/abi/recorded/*' -print0 |
  xargs -0 "$tool" --dry-run -Werror --style=file
