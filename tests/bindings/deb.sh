#!/bin/sh
# Makes the Debian packages of a build for /usr and uses what is in them from C, Fortran and Python, unpacked beside;
# and checks what they ask for, and that lintian finds neither errors nor warnings.
# usage: deb.sh SOURCE_FOLDER BUILD_FOLDER
set -eu
source=$1 build=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/b"
(cd "$build" && cpack -G DEB -B "$work/b" >"$work/log" 2>&1) || { cat "$work/log"; exit 1; }
for package in libjam1 libjam-dev python3-jam jam-tools jam-doc; do
  ls "$work"/b/"$package"_*.deb >/dev/null || { echo "there is no package $package"; exit 1; }
done
needs=$(dpkg-deb -f "$work"/b/libjam1_*.deb Depends)
for package in libc6 libstdc++6 coinor-libclp1; do
  case $needs in *"$package"*) ;; *) echo "libjam1 does not depend on $package: $needs"; exit 1 ;; esac
done
for package in libjam-dev python3-jam jam-tools; do
  dpkg-deb -f "$work/b/$package"_*.deb Depends | grep -q 'libjam1 (' ||
    { echo "$package does not depend on libjam1"; exit 1; }
done
if command -v lintian >/dev/null; then
  lintian --allow-root --fail-on error,warning "$work"/b/*.deb
else
  echo "lintian is not installed: the packages are not checked by it"
fi
for deb in "$work"/b/*.deb; do dpkg-deb -x "$deb" "$work/x"; done
usr=$work/x/usr lib=$(dirname "$(find "$work/x/usr" -name libjam.so)")
size=$(stat -Lc %s "$lib/libjam.so.1")
[ "$size" -lt 7000000 ] || { echo "libjam.so has $size bytes"; exit 1; }
grep -q '^prefix=/usr$' "$lib/pkgconfig/jam.pc"
"$usr/bin/jam-pack" --n 100 --dim 2 --diameters-ratio 1.4 --quiet --report - >"$work/report.json"
grep -q '"jammed": true' "$work/report.json"
cd "$work"
cc -std=c99 -I"$usr/include" "$source/examples/c/first.c" -o c_first -L"$lib" -Wl,-rpath,"$lib" -ljam -lm
./c_first >/dev/null
gfortran -I"$lib/fortran/jam" "$source/examples/fortran/first.f90" -o f_first -L"$lib" -Wl,-rpath,"$lib" \
  -ljam_fortran -ljam
./f_first >/dev/null
PYTHONPATH="$usr/lib/python3/dist-packages" /usr/bin/python3 "$source/examples/python/first.py" p.png >/dev/null
[ -s p.png ]
PYTHONPATH="$usr/lib/python3/dist-packages" /usr/bin/python3 -c 'import importlib.metadata as m; m.version("jamming")'
echo "libjam.so $size bytes; the package serves C, Fortran and Python"
