#!/bin/sh
# Sets up a bare Debian 12 and runs all tests, in six parts:
#   release     everything, by GCC, warnings as errors
#   kernels     the release build's tests of crunches and full spectra as on a processor of fewer instructions, and
#               with OpenBLAS's products for another one
#   alone       the library of the wheel, without LAPACK, Clp and voro++: unit tests of what takes their place
#   sanitizers  address and undefined behaviour, by Clang, warnings as errors: unit tests and those of the C interface,
#               but ten that take minutes each
#   threads     the thread sanitizer, by Clang, over the tests that use several threads
#   fuzz        libFuzzer on every target for 20 seconds, 60 in all
# More run when they are named, as they take long:
#   clang       the library without sanitizers by Clang, and its C tests
#   quick       a loop of two minutes: the library for d = 2 and 3, and tests that end within seconds. It installs
#               only what a C library needs
#   openblas    crunches by the products of OpenBLAS (JAM_BLAS=openblas), as on three processors: packings end
#               elsewhere, and what the tests state must hold there too
#   processors, windows, macos, libcxx  cross builds for arm64, s390x and riscv64 under qemu; for Windows under wine;
#               for macOS, which is not run; with libc++: tests/platforms. Where the compilers cannot be installed
#               they skip, saying so
#   recipes     the recipes of package managers, executed without them: tests/package/recipes.py
#   coverage    which branches of src the tests of units, of the C interface and of Python reach, by Clang;
#               tests/README.md has the table. It fails below the floor of tests/coverage.py
#   browser     libjam for JavaScript by Emscripten, its tests by Node, and the page lab.html where ./build is there
#   sanitized_physics  address and undefined behaviour by GCC, over all that runs without other programs, those ten too
# And `packages` installs what the six parts and `browser` need, and does nothing else.
# `sh tests/run.sh`, from any folder; the builds are ./build, ./build-wheel (also of a test in ./build), ./build-asan
# (of two parts), ./build-threads, ./build-clang, ./build-asan-gcc, ./build-openblas, ./build-two and ./build-wasm.
# Uses ccache where it is installed. Parts can be named: `sh tests/run.sh release clang`.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
. tests/debian.sh
. tests/sanitized.sh
parts=${*:-release kernels alone sanitizers threads fuzz}
need_packages build-essential cmake ninja-build pkg-config python3 libeigen3-dev coinor-libclp-dev libspectra-dev \
  zlib1g-dev libcmocka-dev
if [ "$parts" != quick ]; then
  need_packages clang lld clang-format libopenblas-dev voro++-dev swig gfortran lintian debhelper dh-python \
    python3-dev python3-venv python3-numpy python3-scipy python3-matplotlib python3-h5py python3-pandas python3-tqdm \
    python3-mpi4py openmpi-bin python3-distributed python3-dask python3-networkx chromium python3-gsd python3-ase \
    python3-mdanalysis python3-vtk9 lammps liggghts mypy python3-nbclient python3-ipykernel doxygen python3-sphinx \
    python3-breathe python3-myst-parser furo locales
fi

# Parts leave a core idle while they wait for a single program or a browser, so two run at once. The output of the
# second one is printed at the end.
if [ $# -eq 0 ]; then
  log=$(mktemp)
  trap 'rm -f "$log"' EXIT
  sh tests/run.sh sanitizers threads fuzz >"$log" 2>&1 &
  second=$!
  status=0
  sh tests/run.sh release kernels alone || status=1
  wait "$second" || status=1
  cat "$log"
  exit $status
fi

wants() { case " $parts " in *" $1 "*) ;; *) return 1 ;; esac; }
jobs=$(nproc)
at_once=$((jobs + 1))  # tests: some wait
if command -v ccache >/dev/null; then export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache; fi
bindings=
if [ -f bindings/CMakeLists.txt ]; then bindings="-DJAM_BUILD_PYTHON=ON -DJAM_BUILD_FORTRAN=ON"; fi
if [ -n "$bindings" ] && [ "$parts" != quick ]; then
  if (need_packages octave liboctave-dev) >/dev/null 2>&1; then
    bindings="$bindings -DJAM_BUILD_OCTAVE=ON"
  else
    echo "skipped: the module for Octave; octave and liboctave-dev cannot be installed here"
  fi
fi
# OpenBLAS must not put more threads on cores that run tests side by side.
export OPENBLAS_NUM_THREADS=1

status=0
begun=$(date +%s)
part() { echo "== $1, after $(($(date +%s) - begun)) s"; }
# A node of another source than Debian's brings its own npm.
need_javascript() {
  # shellcheck disable=SC2046
  (need_packages emscripten swig $(for pair in node:nodejs npm:npm; do
    command -v "${pair%:*}" >/dev/null || echo "${pair#*:}"; done)) >/dev/null 2>&1
}
if wants packages; then need_javascript || true; fi

if wants release; then
part "release build"
# For /usr, as the Debian packages are made of it; nothing is installed there. -U: its folders follow the prefix.
# By joined sources, as the quickstart: half the time, and the same objects. A build without options, clang and
# openblas compile each source alone.
# shellcheck disable=SC2086
cmake -S . -B build -G Ninja -U JAM_PYTHON_DIR -DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_UNITY_BUILD=ON -DJAM_BUILD_STATIC=ON -DJAM_WERROR=ON $bindings >/dev/null
cmake --build build -j "$jobs"
part "its tests"
ctest --test-dir build -j "$at_once" --output-on-failure --no-tests=error || status=1
fi

# Kernels of OpenBLAS that this processor has; and what GLIBC_TUNABLES hides from the C library.
has() { if grep -qw "$1" /proc/cpuinfo; then echo "$2"; else echo "$2 is left out: no $1 here" >&2; fi; }
hidden=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F

# Full spectra alone depend on OpenBLAS; unit/golden_bits compares crunches in all vectors of libjam's own.
if wants kernels; then
part "crunches and spectra on fewer instructions"
GLIBC_TUNABLES=$hidden OPENBLAS_CORETYPE=Prescott ctest --test-dir build -j "$at_once" -L 'crunch|spectra' -L quick \
  --output-on-failure --no-tests=error || status=1
kernel=$(has avx512f SkylakeX)
part "spectra by the products for ${kernel:-Nehalem}"
OPENBLAS_CORETYPE=${kernel:-Nehalem} ctest --test-dir build -j "$at_once" -L spectra -L quick \
  --output-on-failure --no-tests=error || status=1
fi

if wants alone; then
part "alone"
# In the folder of bindings/pip, whose objects these are.
cmake -S . -B build-wheel -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DJAM_LAPACK=OFF \
  -DJAM_CLP=OFF -DJAM_USE_VORO=OFF -DJAM_WERROR=ON -DJAM_BUILD_TESTS=ON \
  -DJAM_BUILD_PYTHON=OFF -DJAM_BUILD_EXAMPLES=OFF -DJAM_BUILD_CLI=OFF >/dev/null
alone='unit_analysis_modes unit_analysis_spectrum unit_analysis_structure unit_crunch_recompress unit_crunch_steps'
# shellcheck disable=SC2086
cmake --build build-wheel -j "$jobs" --target $alone
ctest --test-dir build-wheel -j "$at_once" --output-on-failure --no-tests=error \
  -R "^($(echo $alone | sed 's/unit_/unit\//g; s/ /|/g'))\$" || status=1
fi

if wants openblas; then
part "crunches by OpenBLAS"
cmake -S . -B build-openblas -G Ninja -DCMAKE_BUILD_TYPE=Release -DJAM_BLAS=openblas -DJAM_WERROR=ON \
  -DJAM_BUILD_EXAMPLES=OFF -DJAM_BUILD_CLI=OFF >/dev/null
cmake --build build-openblas -j "$jobs"
for kernel in Prescott $(has avx2 Haswell) $(has avx512f SkylakeX); do
part "products of $kernel"
OPENBLAS_CORETYPE=$kernel ctest --test-dir build-openblas -j "$at_once" -L 'crunch|spectra' --output-on-failure \
  --no-tests=error || status=1
done
fi

if wants quick; then
part "quick"
cmake -S . -B build-two -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DJAM_DIMENSIONS="2;3" \
  -DJAM_BUILD_EXAMPLES=OFF >/dev/null
cmake --build build-two -j "$jobs" --target jam_quick
ctest --test-dir build-two -j "$at_once" -L quick --output-on-failure --no-tests=error || status=1
fi

if wants clang; then
part "clang"
# -O1 and the tests of the interface alone: what clang adds are its warnings and another code generator.
cmake -S . -B build-clang -G Ninja -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=None \
  -DCMAKE_C_FLAGS=-O1 -DCMAKE_CXX_FLAGS=-O1 -DJAM_WERROR=ON -DJAM_BUILD_EXAMPLES=OFF -DJAM_BUILD_CLI=OFF >/dev/null
cmake --build build-clang -j "$jobs"
ctest --test-dir build-clang -j "$at_once" -L capi -LE long --output-on-failure --no-tests=error || status=1
fi

if wants sanitizers; then
part "address and undefined-behaviour sanitizers"
sanitize_by_clang
cmake --build build-asan -j "$jobs" --target jam_sanitized
part "its tests"
ctest --test-dir build-asan -j "$at_once" -L 'unit|capi' -LE 'long|slow' --timeout 900 \
  --output-on-failure --no-tests=error || status=1
fi

if wants sanitized_physics; then
part "address and undefined-behaviour sanitizers over physics and bindings"
# shellcheck disable=SC2086
sanitize build-asan-gcc $bindings
cmake --build build-asan-gcc -j "$jobs"
ctest --test-dir build-asan-gcc -j "$at_once" -L 'unit|capi|physics|bindings' -LE long --timeout 1800 \
  --output-on-failure --no-tests=error || status=1
fi

if wants threads; then
part "thread sanitizer"
# shellcheck disable=SC2046
cmake -S . -B build-threads -G Ninja $(by_clang) -DCMAKE_BUILD_TYPE=None -DCMAKE_C_FLAGS=-O1 -DCMAKE_CXX_FLAGS=-O1 \
  -DJAM_SANITIZE=thread -DJAM_DIMENSIONS="2;3" -DJAM_BUILD_EXAMPLES=OFF -DJAM_BUILD_CLI=OFF >/dev/null
# What starts threads: races on a handle, handles on threads of their own, and runs and factorisations on several
# threads.
threaded='capi_thread_gate capi_thread_calls capi_host_state capi_isoconfigurational unit_block_cholesky'
# shellcheck disable=SC2086
cmake --build build-threads -j "$jobs" --target $threaded
TSAN_OPTIONS=halt_on_error=1 ctest --test-dir build-threads -j "$at_once" --timeout 900 \
  --output-on-failure --no-tests=error -R "^($(echo "$threaded" | sed 's/_/\//; s/ \([a-z]*\)_/|\1\//g'))\$" || status=1
fi

if wants coverage; then
part "coverage"
need_packages llvm
counting='-O1 -fprofile-instr-generate -fcoverage-mapping'
cmake -S . -B build-coverage -G Ninja -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=None \
  -DCMAKE_C_FLAGS="$counting" -DCMAKE_CXX_FLAGS="$counting" -DJAM_BUILD_EXAMPLES=OFF \
  -DJAM_BUILD_PYTHON=ON >/dev/null
counted=$(ninja -C build-coverage -t targets all | sed -n 's/^\(\(unit\|capi\)_[a-z0-9_]*\): phony$/\1/p')
# shellcheck disable=SC2086
cmake --build build-coverage -j "$jobs" --target $counted jam_python jam-pack
rm -rf build-coverage/profile
LLVM_PROFILE_FILE="$root/build-coverage/profile/%m.profraw" ctest --test-dir build-coverage -j "$at_once" \
  -R '^((unit|capi)/|bindings/python_)' -LE long -E 'golden_bits|_(lab|leaks|types)$' \
  --timeout 900 --output-on-failure --no-tests=error || status=1
/usr/bin/python3 tests/coverage.py build-coverage || status=1
fi

if wants browser; then
part "browser"
if need_javascript; then
cmake -C pkgconfig/presets/wasm.cmake -S . -B build-wasm -G Ninja >/dev/null
cmake --build build-wasm -j "$jobs"
ctest --test-dir build-wasm -j "$at_once" --output-on-failure --no-tests=error || status=1
if [ -f build-wasm/lab.html ] && [ -d build ]; then
JAM_LAB=$root/build-wasm/lab.html ctest --test-dir build -R python_lab --output-on-failure --no-tests=error || status=1
fi
else
echo "skipped: emscripten, nodejs, npm and swig cannot all be installed here"
fi
fi

if wants recipes; then /usr/bin/python3 -B tests/package/recipes.py build-recipes || status=1; fi
if wants processors; then sh tests/platforms/processors.sh || status=1; fi
if wants windows; then sh tests/platforms/windows.sh || status=1; fi
if wants macos; then sh tests/platforms/macos.sh || status=1; fi
if wants libcxx; then sh tests/platforms/libcxx.sh || status=1; fi

if wants fuzz; then
part "fuzzers"
sh tests/fuzz/run.sh 20 || status=1
fi
part "end"
exit $status
