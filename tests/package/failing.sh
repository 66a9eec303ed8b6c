#!/bin/sh
# failing.sh BUILD PREFIX LIBDIR: programs in C, C++ and Fortran whose calls fail get a status or an exception, and the
# text. Each is linked with the shared library and, where it is installed, with the static one, by every compiler found.
set -eu
build=$1 prefix=$2 libdir=$3
here=$(cd "$(dirname "$0")" && pwd)/failing
work=$build/tests/package/failing
rm -rf "$work" && mkdir -p "$work/static" && cd "$work"
export PKG_CONFIG_PATH="$libdir/pkgconfig" LD_LIBRARY_PATH="$libdir"
die() { echo "$*" >&2; exit 1; }

# A folder with the archives alone comes first, so -ljam means the static library; jam.pc names what it needs.
kinds=shared
if [ -f "$libdir/libjam.a" ]; then
  kinds="shared static"
  cp "$libdir"/lib*.a static
fi
flags() { # PACKAGE KIND
  if [ "$2" = static ]; then echo "-L$work/static $(pkg-config --cflags --libs --static "$1")"
  else pkg-config --cflags --libs "$1"; fi
}
tried=0
# shellcheck disable=SC2046
for kind in $kinds; do
  for compiler in gcc clang g++ clang++ gfortran; do
    command -v $compiler >/dev/null || continue
    case $compiler in
    gfortran)
      [ -f "$libdir/pkgconfig/jam-fortran.pc" ] || continue
      gfortran -J. "$here/fails.f90" -o fails $(flags jam-fortran $kind) ;;
    *++) $compiler -std=c++17 -Wall -Werror "$here/fails.cpp" -o fails $(flags jam $kind) ;;
    *) $compiler -std=c99 -Wall -Werror "$here/fails.c" -o fails $(flags jam $kind) ;;
    esac
    if [ $kind = static ] && ldd ./fails | grep -q libjam; then die "$compiler: it needs the shared library"; fi
    ./fails >said 2>&1 || die "$compiler, $kind: status $?: $(cat said)"
    grep -qx 'dim is 9, supported are 2\.\.8' said || die "$compiler, $kind: the text is '$(cat said)'"
    tried=$((tried + 1))
  done
done
echo "$tried programs were told of their failures"
[ "$kinds" != shared ] || exit 0

# The archive has no names but the calls and those of its inside, so it has none of the program's. DW.ref. is the
# compiler's, one word for exceptions.
names() { nm -g --defined-only "$1" 2>nm.log | awk 'NF == 3 {print $3}' | grep -v '^DW[.]ref[.]' | sort -u; }
names "$libdir/libjam.a" >inside
if grep -v '^jam_\|3jam6inside' inside; then die "libjam.a has names of its own outside of jam::inside"; fi
c++ -std=c++17 -c "$here/fails.cpp" -o fails.o $(pkg-config --cflags jam)
names fails.o >program
test -s inside && test -s program || die "nm finds no names"
comm -12 inside program >both
if [ -s both ]; then die "two things have one name: $(c++filt <both)"; fi

# A program that uses Eigen, aligned in another way than libjam's, keeps its own copy of it.
if grep -qw avx2 /proc/cpuinfo 2>/dev/null && grep -qw fma /proc/cpuinfo; then
  # shellcheck disable=SC2046
  c++ -std=c++17 -mavx2 -mfma "$here/hosts_eigen.cpp" -o hosts_eigen $(pkg-config --cflags eigen3) $(flags jam static)
  ./hosts_eigen >said || die "a program that uses Eigen with AVX2: status $?"
fi
