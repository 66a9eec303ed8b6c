#!/bin/sh
# What a cross build needs of other libraries, below one folder: zlib and cmocka, compiled from Debian's sources for
# the target, and the headers of Eigen and Spectra, which are the same for all.
# usage: dependencies.sh FOLDER TRIPLET [CMAKE_OPTION...]     does nothing where FOLDER is whole
# CC and AR name another compiler than the triplet's, JAM_LIBRARIES=zlib leaves out cmocka.
set -eu
folder=$1 triplet=$2
shift 2
if [ -f "$folder/whole" ]; then exit 0; fi
libraries=${JAM_LIBRARIES:-zlib cmocka}
compiler=${CC:-$triplet-gcc} archiver=${AR:-$triplet-ar}
mkdir -p "$folder/include" "$folder/apt/lists/partial" "$folder/apt/cache/archives/partial" "$folder/source"
folder=$(cd "$folder" && pwd)

# A list of sources of our own: the machine's may have none, and stays as it is.
release=$(. /etc/os-release && echo "$VERSION_CODENAME")
echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian $release main" \
  >"$folder/apt/sources.list"
apt() {
  apt-get -q -o Dir::Etc::SourceList="$folder/apt/sources.list" -o Dir::Etc::SourceParts=/dev/null \
    -o Dir::State::Lists="$folder/apt/lists" -o Dir::Cache="$folder/apt/cache" -o APT::Sandbox::User=root "$@"
}
(cd "$folder/source" && apt update && apt source --download-only $libraries) >"$folder/log" 2>&1 || {
  tail -3 "$folder/log" >&2
  echo "the sources of $libraries cannot be had from Debian" >&2
  exit 1
}
for name in $libraries; do
  mkdir -p "$folder/source/$name"
  tar -xf "$(ls "$folder/source/${name}"_*.orig.tar.* | grep -v '[.]asc$')" -C "$folder/source/$name" \
    --strip-components=1
done

# zlib's own CMake file builds and installs a shared library too: its sources are a handful.
# It takes TARGET_OS_MAC, which new Clangs define, for a Mac of 1999.
cd "$folder/source/zlib"
for source in adler32 compress crc32 deflate infback inffast inflate inftrees trees uncompr zutil; do
  "$compiler" -O2 -w -fPIC -DHAVE_UNISTD_H -UTARGET_OS_MAC -c $source.c
done
mkdir -p "$folder/lib/pkgconfig"
"$archiver" crs "$folder/lib/libz.a" ./*.o
cp zlib.h zconf.h "$folder/include"
if [ -d "$folder/source/cmocka" ]; then
  cd "$folder/source/cmocka"
  { cmake -S . -B b "$@" -DCMAKE_C_COMPILER="$compiler" -DCMAKE_AR="$(command -v "$archiver")" \
    -DCMAKE_BUILD_TYPE=Release -DWITH_STATIC_LIB=ON &&
    cmake --build b --target cmocka-static; } >>"$folder/log" 2>&1 || { tail -20 "$folder/log" >&2; exit 1; }
  cp "$(find b -name 'libcmocka*.a' ! -name '*.dll.a')" "$folder/lib/libcmocka.a"
  cp include/cmocka*.h "$folder/include"
fi

ln -sfn /usr/include/eigen3 "$folder/include/eigen3"
ln -sfn /usr/include/Spectra "$folder/include/Spectra"
for name in $libraries; do
  case $name in zlib) library=z ;; *) library=$name ;; esac
  cat >"$folder/lib/pkgconfig/$name.pc" <<END
Name: $name
Description: $name for $triplet
Version: 1
Libs: -L$folder/lib -l$library
Cflags: -I$folder/include
END
done
touch "$folder/whole"
