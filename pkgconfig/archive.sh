#!/bin/sh
# archive.sh COMMIT FOLDER: the source of a release as FOLDER/libjam-VERSION.tar.gz, with the generated layers of other
# languages, so that Fortran and Julia need no SWIG. The same commit gives the same bytes.
set -eu
cd "$(dirname "$0")/.."
version=$(git show "$1:CMakeLists.txt" | sed -n 's/^project(jam VERSION \([0-9.]*\).*/\1/p')
name=libjam-$version
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
git archive --prefix="$name/" "$1" | tar -xf - -C "$work"
/usr/bin/python3 -B "$work/$name/bindings/gen/generate.py" --out "$work/$name/bindings/generated"
tar --sort=name --owner=0 --group=0 --numeric-owner --mode=go=rX --mtime="@$(git show -s --format=%ct "$1")" \
  -cf "$work/tar" -C "$work" "$name"
gzip -9n <"$work/tar" >"$work/gz"
mkdir -p "$2"
mv "$work/gz" "$2/$name.tar.gz"
