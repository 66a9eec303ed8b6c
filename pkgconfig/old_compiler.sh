#!/bin/sh
# old_compiler.sh FOLDER [SUITE]: the compilers of an older Debian (bullseye by default, the oldest on Debian's mirrors:
# GLIBC 2.31, GCC 10) as FOLDER/gcc and FOLDER/g++, so that what they make runs on systems as old. Root only.
#   CC=FOLDER/gcc CXX=FOLDER/g++ sh pkgconfig/wheel.sh wheels PYTHON...
# They see this tree, CMake's tests of compilers, Eigen, Spectra and Python's headers where they lie here, for as long
# as they compile; all other headers and all libraries are the older system's.
set -eu
mkdir -p "$1"
folder=$(cd "$1" && pwd) suite=${2:-bullseye}
tree=$(cd "$(dirname "$0")/.." && pwd)
. "$tree/tests/debian.sh"
need_packages debootstrap
system=$folder/$suite
[ -x "$system/usr/bin/g++" ] ||
  debootstrap --variant=minbase --include=g++,zlib1g-dev "$suite" "$system" >"$folder/log" 2>&1 ||
  { tail -3 "$folder/log" >&2; exit 1; }
for compiler in gcc g++; do
  cat >"$folder/$compiler" <<END
#!/bin/sh
# The mounts are this process's own and end with it.
exec unshare -m sh -c '
  for seen in $tree /usr/share/cmake-* /usr/include/eigen3 /usr/include/Spectra \$JAM_PYTHON_HEADERS; do
    mkdir -p "$system\$seen" && mount --bind "\$seen" "$system\$seen"
  done
  exec chroot $system /usr/bin/env -C "\$PWD" $compiler "\$@"' $compiler "\$@"
END
  chmod 755 "$folder/$compiler"
done
"$folder/g++" --version | head -1
