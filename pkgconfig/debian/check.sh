#!/bin/sh
# check.sh BUILD: the folder as Debian's tools read it. libjam1.symbols has the symbols of the built library, and the
# packages have all that it installs; its prefix is /usr.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=$(cd "$1" && pwd)
for tool in dpkg-parsechangelog dpkg-gensymbols dh; do
  command -v $tool >/dev/null || { echo "$tool is not installed (Debian: dpkg-dev, debhelper)"; exit 77; }
done
grep -qx 'CMAKE_INSTALL_PREFIX:[A-Z]*=/usr' "$build/CMakeCache.txt" || { echo "the build is not for /usr"; exit 77; }
for part in PYTHON FORTRAN STATIC CLI; do
  grep -qx "JAM_BUILD_$part:BOOL=ON" "$build/CMakeCache.txt" || { echo "JAM_BUILD_$part is not ON"; exit 77; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/source" && cp -r "$here" "$work/source/debian"
cd "$work/source"
version=$(sed -n 's/^version: //p' "$here/../../.github/CITATION.cff")  # the last release
dpkg-parsechangelog -S Version | grep -qx "$version-1" || { echo "changelog: the version is not $version-1"; exit 1; }
dh binary --no-act --without python3 --buildsystem=cmake+ninja | grep -q dh_makeshlibs
dpkg-gensymbols -c2 -plibjam1 -Odebian/symbols.new -Idebian/libjam1.symbols \
  -e"$(ls "$build"/libjam.so.*.*.*)" >"$work/differ" || { cat "$work/differ"; exit 1; }
for package in libjam1 libjam-dev python3-jam jam-tools jam-doc; do
  grep -qx "Package: $package" debian/control && test -s "debian/$package.install" ||
    { echo "$package lacks an entry or a list of files"; exit 1; }
done
# Each file of the build belongs to a package, or is named in not-installed.
DESTDIR="$work/source/debian/tmp" cmake --install "$build" >/dev/null
rm -rf debian/tmp/usr/share/doc/jam/html  # the site, where the target docs has made it
dh_install
dh_missing --fail-missing
echo "debian/ fits the build"
