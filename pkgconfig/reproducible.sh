#!/bin/sh
# reproducible.sh FOLDER [CMAKE_OPTION...]: builds the library twice without a cache, in two folders from two copies of
# the source, with two umasks and, where faketime is installed, at two times, and compares what an install writes byte
# by byte.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
work=$1
shift
rm -rf "$work/one" "$work/another_folder"
build() { # build FOLDER UMASK TIME OPTION...
  folder=$1 mask=$2 when=$3
  shift 3
  (
    umask "$mask"
    mkdir -p "$folder/source"
    (cd "$root" && git ls-files -z | xargs -0 cp --parents -t "$folder/source")
    clock=
    if command -v faketime >/dev/null; then clock="faketime $when"; fi
    export CCACHE_DISABLE=1
    cmake -S "$folder/source" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr \
      -DJAM_COMMIT=000000000000 -DJAM_BUILD_TESTS=OFF -DJAM_BUILD_EXAMPLES=OFF -DJAM_BUILD_STATIC=ON "$@" \
      >"$folder/log"
    $clock cmake --build "$folder/build" >>"$folder/log"
    DESTDIR="$folder/installed" cmake --install "$folder/build" --strip >>"$folder/log"
  )
}
build "$work/one" 022 '2026-01-01' "$@"
build "$work/another_folder" 077 '2026-07-02' "$@"
for folder in one another_folder; do
  (cd "$work/$folder/installed" && find . -type f | LC_ALL=C sort | xargs sha256sum) >"$work/$folder.sums"
done
diff "$work/one.sums" "$work/another_folder.sums"
echo "$(wc -l <"$work/one.sums") files are the same"
