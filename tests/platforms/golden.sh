#!/bin/sh
# The bits of ten packings and of the other verbs are those of bits.txt: by the shared library, and by libjam for
# processors of fewer instructions, with other code of the C library and another kernel of OpenBLAS.
# usage: golden.sh BUILD           compares
#        golden.sh BUILD record    writes bits.txt anew, after an algorithm has changed; CHANGELOG.md says so
set -eu
build=$1
golden=$(dirname "$0")/bits.txt
if [ "${2:-}" = record ]; then
  "$build/tests/jam_bits" >"$golden"
  exit
fi
made=$(mktemp) expected=$(mktemp)
trap 'rm -f "$made" "$expected"' EXIT
status=0
# compare NAME COMMAND...
compare() {
  name=$1
  shift
  "$@" >"$made" || status=1
  head -n "$(wc -l <"$made")" "$golden" >"$expected" # lines of d > 3 come last: a build may have fewer dimensions
  cmp -s "$expected" "$made" && echo "$name: same bits" && return
  echo "$name:"
  diff "$expected" "$made" || status=1
}
hidden=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F
compare "this processor" "$build/tests/jam_bits"
for set in portable avx2 avx512; do
  compare "$set" env JAM_BITS_SET=$set GLIBC_TUNABLES=$hidden OPENBLAS_CORETYPE=Prescott "$build/tests/jam_bits_of_set"
done
exit $status
