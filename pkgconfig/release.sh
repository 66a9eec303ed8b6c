#!/bin/sh
# release.sh VERSION FOLDER [PART...]: all files of a release, made from a clean clone of the tag vVERSION, or of HEAD
# where there is none, and tried; CONTENTS.md says how. The same commit and TMPDIR give the same bytes. Parts: source,
# sdist, wheels, debian, windows, npm. What this machine cannot make is left out, and both the script and CONTENTS.md
# say so.
# JAM_RELEASE_OPTIONS: more options of CMake for a trial of wheels, debian and windows.
set -eu
version=$1 root=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "$2"
out=$(cd "$2" && pwd)
shift 2
parts=${*:-source sdist wheels debian windows npm}
commit=$(git -C "$root" rev-parse -q --verify "v$version^{commit}" || git -C "$root" rev-parse HEAD)
SOURCE_DATE_EPOCH=$(git -C "$root" show -s --format=%ct "$commit")
work=${TMPDIR:-/tmp}/libjam-$version  # one name for all runs: gfortran writes the path of a source into its object
mkdir "$work"
trap 'rm -rf "$work"' EXIT
export SOURCE_DATE_EPOCH TZ=UTC TMPDIR="$work" CCACHE_BASEDIR="$work" CCACHE_NOHASHDIR=1 JAM_LIBRARIES=zlib
umask 022
git clone -q --no-hardlinks "$root" "$work/libjam"
cd "$work/libjam"
git checkout -q --detach "$commit"
found=$(sed -n 's/^project(jam VERSION \([0-9.]*\).*/\1/p; s/^set(JAM_VERSION_SUFFIX "\([^"]*\).*/\1/p' CMakeLists.txt |
  tr -d '\n')
[ "$found" = "$version" ] || { echo "the tree is version $found: pkgconfig/set_version.py sets another" >&2; exit 2; }
. tests/platforms/common.sh
small="-DCMAKE_BUILD_TYPE=Release -DJAM_BUILD_TESTS=OFF ${JAM_RELEASE_OPTIONS:-}"
python='env PYTHONPATH=bindings/python /usr/bin/python3 -B'

row() { # row FILE HOW
  printf '| %s | %s | %s |\n' "$1" "$(stat -c %s "$out/$1")" "$2" >>"$work/rows"
  echo "$1: $2"
}
skip() { echo "- $1 left out: $2" | tee -a "$work/skipped"; }
wants() { case " $parts " in *" $1 "*) ;; *) return 1 ;; esac; }
run() { "$@" >"$work/log" 2>&1 || { tail -30 "$work/log" >&2; echo "failed: $*" >&2; exit 1; }; }
# begin NAME GLOB: whether the part is wanted; what an earlier run left goes.
begin() { wants "$1" || return 1; echo "== $1"; rm -f "$out"/$2; }
named() { (cd "$out" && ls $1); }

if begin source 'libjam-*.tar.gz'; then
  sh pkgconfig/archive.sh "$commit" "$out"
  file=$(named 'libjam-*.tar.gz')
  mkdir "$work/source"
  tar -xzf "$out/$file" -C "$work/source" --strip-components=1
  # without SWIG and without git: Fortran and Julia come from the generated layers
  run cmake -S "$work/source" -B "$work/source/build" -G Ninja $small -DJAM_DIMENSIONS="2;3" -DJAM_WERROR=ON \
    -DJAM_BUILD_FORTRAN=ON -DSWIG_PROGRAM=/nowhere -DGIT_PROGRAM=/nowhere
  run cmake --build "$work/source/build" -j "$jobs"
  run "$work/source/build/examples/example_first"
  run "$work/source/build/examples/example_fortran_first"
  row "$file" "unpacked, built without git and SWIG for d = 2 and 3; an example in C and one in Fortran ran"
fi

if begin sdist 'jamming-*.tar.gz'; then
  run $python -c 'import build_wheel, sys; build_wheel.build_sdist(sys.argv[1])' "$out"
  file=$(named 'jamming-*.tar.gz')
  /usr/bin/python3 -m venv "$work/pip"
  mkdir "$work/sdist"
  tar -xzf "$out/$file" -C "$work/sdist" --strip-components=1
  # by the compiler's options of bindings/pip, in a folder of the same place
  run "$work/pip/bin/pip" wheel --no-index --no-deps --config-settings build-dir="$work/sdist/build-wheel" \
    --config-settings cmake=-DJAM_WERROR=ON -w "$work/from_sdist" "$work/sdist"
  run sh tests/bindings/wheel.sh "$work"/from_sdist/*.whl
  row "$file" "pip made a wheel of it without git and an index; README's example ran with numpy alone"
fi

# wheel PROCESSOR: by zig for GLIBC 2.17, with its C++ library and zlib inside. CMake takes the build for a native one,
# as it would look for a Python of the other processor.
wheel() {
  tools=$work/zig/$1-linux-gnu.2.17 libraries=$work/libraries-$1
  run env CC="$tools/cc" AR="$tools/ar" sh tests/platforms/dependencies.sh "$libraries" "$1-linux-gnu"
  headers=$(/usr/bin/python3 -c 'import sysconfig; print(sysconfig.get_path("include"))')
  name=$(basename "$headers")
  mkdir -p "$libraries/python/$1-linux-gnu/$name"
  config=/usr/include/$1-linux-gnu/$name/pyconfig.h
  # between 64-bit processors of one order of bytes nothing differs in what the module uses of it
  [ -f "$config" ] || config=$(ls /usr/include/*-linux-gnu/"$name"/pyconfig.h | head -1)
  cp "$config" "$libraries/python/$1-linux-gnu/$name"
  run env CCACHE_DISABLE=1 CC="$tools/cc" CXX="$tools/c++" CFLAGS="-I$libraries/python" LDFLAGS=-s \
    PKG_CONFIG_LIBDIR="$libraries/lib/pkgconfig" _PYTHON_HOST_PLATFORM="linux-$1" $python -c '
import build_wheel, sys
out, build, *options = sys.argv[1:]
build_wheel.build_wheel(out, {"build-dir": build, "cmake": options})' "$out" "$work/wheel-$1" -GNinja \
    -DCMAKE_UNITY_BUILD=ON -DCMAKE_STRIP=/bin/true -DSPECTRA_INCLUDE="$libraries/include" ${JAM_RELEASE_OPTIONS:-}
}
if begin wheels 'jamming-*.whl'; then
  if sh pkgconfig/zig.sh "$work/zig" x86_64-linux-gnu.2.17 &&
    sh pkgconfig/zig.sh "$work/zig" aarch64-linux-gnu.2.17; then
    wheel x86_64
    file=$(named 'jamming-*x86_64.whl')
    run sh tests/bindings/wheel.sh "$out/$file"
    row "$file" "README's example ran in an environment with numpy alone, without compiler and network"
    wheel aarch64
    file=$(named 'jamming-*aarch64.whl')
    how="built, not run: no emulator or compiler for arm64 here"
    if need_or_skip qemu-user gcc-aarch64-linux-gnu >/dev/null; then
      mkdir "$work/arm"
      /usr/bin/python3 -m zipfile -e "$out/$file" "$work/arm"
      run aarch64-linux-gnu-gcc -Iinclude examples/c/first.c -o "$work/arm/first" "$work"/arm/jam/libjam.so.* -lm
      run qemu-aarch64 -L /usr/aarch64-linux-gnu -E LD_LIBRARY_PATH="$work/arm/jam" "$work/arm/first"
      how="an example in C ran with its library under an emulator; nothing imported the module"
    fi
    row "$file" "$how"
  else
    skip wheels "zig cannot be had"
  fi
fi

if begin debian '*.deb'; then
  run cmake -S . -B build -G Ninja $small -DJAM_WERROR=ON -DCMAKE_INSTALL_PREFIX=/usr \
    -DJAM_BUILD_PYTHON=ON -DJAM_BUILD_FORTRAN=ON -DJAM_BUILD_STATIC=ON -DJAM_BUILD_EXAMPLES=OFF
  run cmake --build build -j "$jobs"
  (cd build && run cpack -G DEB)
  cp build/*.deb "$out"
  run sh tests/bindings/deb.sh "$PWD" build
  for file in $(named "*.deb"); do
    row "$file" "unpacked; programs in C, Fortran and Python and jam-pack ran; lintian finds nothing"
  done
fi

if begin windows 'libjam-*-windows-x86_64.zip'; then
  triplet=x86_64-w64-mingw32 name=libjam-$version-windows-x86_64
  if need_or_skip g++-mingw-w64-x86-64-posix wine64 wine; then
    run sh tests/platforms/dependencies.sh "$work/libraries-windows" $triplet
    export PKG_CONFIG_LIBDIR="$work/libraries-windows/lib/pkgconfig"
    run cmake -S . -B "$work/windows" -G Ninja $small -DCMAKE_UNITY_BUILD=ON \
      -DCMAKE_SYSTEM_NAME=Windows -DCMAKE_SYSTEM_PROCESSOR=x86_64 -DCMAKE_C_COMPILER=$triplet-gcc-posix \
      -DCMAKE_CXX_COMPILER=$triplet-g++-posix -DCMAKE_RC_COMPILER=$triplet-windres -DJAM_LAPACK=OFF -DJAM_CLP=OFF \
      -DJAM_USE_VORO=OFF -DSPECTRA_INCLUDE="$work/libraries-windows/include" -DJAM_BUILD_EXAMPLES=OFF \
      -DCMAKE_SHARED_LINKER_FLAGS=-Wl,--no-insert-timestamp -DCMAKE_EXE_LINKER_FLAGS=-Wl,--no-insert-timestamp
    run cmake --build "$work/windows" -j "$jobs"
    unset PKG_CONFIG_LIBDIR
    run cmake --install "$work/windows" --prefix "$work/$name" --strip
    cp -r examples/c examples/cpp "$work/$name/share"
    cp examples/lab.html "$work/$name"
    # where the zip is unpacked, not where it was made
    sed -i "s|$work/$name|\${pcfiledir}/../..|" "$work/$name/lib/pkgconfig/jam.pc"
    run $python pkgconfig/spdx.py zip "$work/$name" "$out/$name.zip"
    # shellcheck disable=SC2046
    run $triplet-gcc-posix "$work/$name/share/c/first.c" -o "$work/$name/bin/first.exe" \
      $(PKG_CONFIG_LIBDIR="$work/$name/lib/pkgconfig" pkg-config --cflags --libs jam)
    export WINEPREFIX="$work/wine" WINEDEBUG=-all
    (cd "$work/$name/bin" && run wine first.exe && run wine jam-pack.exe --n 100 --dim 2 --diameters-ratio 1.4 \
      --quiet --report report.json && grep -q '"jammed": true' report.json)
    row "$name.zip" "an example in C was linked; it and jam-pack.exe ran under wine with the DLL; not run on Windows"
  else
    skip "the zip for Windows" "mingw-w64 and wine cannot be had"
  fi
fi

if begin npm 'jamming-*.tgz'; then
  if need_or_skip emscripten swig && command -v npm >/dev/null; then
    run cmake -C pkgconfig/presets/wasm.cmake -S . -B "$work/wasm" -G Ninja
    run cmake --build "$work/wasm" -j "$jobs" --target jam_js jam_wasm
    (cd "$out" && run npm pack --silent "$work/wasm/js")
    file=$(named 'jamming-*.tgz')
    run sh tests/js/installed.sh "$work/wasm/js"
    row "$file" "npm installed it in an empty folder without a network; a packing, a worker and the bundle ran by Node"
  else
    skip "the npm package" "emscripten or npm cannot be had"
  fi
fi

$python pkgconfig/spdx.py list "$commit" "$out"
# Parts that earlier runs made of the same commit keep their rows.
if grep -q "commit $commit" "$out/CONTENTS.md" 2>/dev/null; then
  grep '^| .*[0-9] |' "$out/CONTENTS.md" | while IFS='|' read -r _ file rest; do
    if named "$file" >/dev/null 2>&1 && ! grep -qF "|$file|" "$work/rows"; then echo "|$file|$rest"; fi
  done >"$work/earlier"
  cat "$work/earlier" >>"$work/rows"
fi
{
  printf '# libjam %s\n\n`sh pkgconfig/release.sh %s FOLDER`, commit %s.\n\n' "$version" "$version" "$commit"
  printf '| file | bytes | how it was tried |\n|---|---|---|\n'
  LC_ALL=C sort "$work/rows"
  if [ -f "$work/skipped" ]; then echo && cat "$work/skipped"; fi
} >"$out/CONTENTS.md"
sh pkgconfig/checksums.sh "$out"
