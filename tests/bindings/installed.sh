#!/bin/sh
# Consumers of an installed tree in Fortran, Python and CMake, without the build tree. package/failing has those in C
# and C++, by pkg-config.
# usage: installed.sh BUILD_FOLDER SOURCE_FOLDER PYTHON_FOLDER_BELOW_PREFIX LIBRARY_FOLDER_BELOW_PREFIX
set -eu
build=$1 source=$2 python_dir=$3 lib_dir=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/p" >"$work/log"
cd "$work"
export PKG_CONFIG_PATH="$work/p/$lib_dir/pkgconfig"
link="-L$work/p/$lib_dir -Wl,-rpath,$work/p/$lib_dir"
# shellcheck disable=SC2086
gfortran "$source/examples/fortran/first.f90" -o f_first $(pkg-config --cflags --libs jam-fortran) $link
./f_first >f.out
# the installed source serves a compiler whose .mod files differ
# shellcheck disable=SC2086
sources=$work/p/share/jam/fortran
gfortran -J"$work" "$sources/jam.f90" "$sources/jam_base.f90" "$sources/jam_packing.f90" \
  "$source/examples/fortran/first.f90" -o f_source $link \
  -ljam
./f_source >f2.out
cmp f.out f2.out
PYTHONPATH="$work/p/$python_dir" /usr/bin/python3 -c "
import importlib.metadata, jam, jam.raw, os
assert os.path.realpath(jam.__file__).startswith(os.path.realpath('$work')), jam.__file__
assert importlib.metadata.version('jamming') == jam.raw.jam_version().replace('-dev', '.dev0')
assert importlib.metadata.requires('jamming')[0] == 'numpy>=1.20'
s = jam.System.random(n=40, dim=2, seed=3, diameters=[1.0, 1.4] * 20)
assert s.crunch().jammed"
test -f "$(echo "$work/p/$python_dir"/jam/__pycache__/system.*.pyc)"
test -f "$work/p/share/jam/julia/Jam/src/raw.jl"
# the checker finds its other files
/usr/bin/python3 -I "$work/p/share/jam/jamproof.py" "$source/examples/studies/reference_set/d2-n64-equal-07.jamproof" |
  grep -q '^trapped: '
mkdir cmake_consumer && cd cmake_consumer
cat >CMakeLists.txt <<EOF
cmake_minimum_required(VERSION 3.22)
project(consumer LANGUAGES CXX Fortran)
find_package(jam REQUIRED)
add_executable(cpp $source/examples/cpp/first.cpp)
set_target_properties(cpp PROPERTIES CXX_STANDARD 17)
find_package(Threads REQUIRED)
target_link_libraries(cpp jam::jam Threads::Threads)
add_executable(fortran $source/examples/fortran/first.f90)
target_link_libraries(fortran jam::fortran)
EOF
cmake -S . -B b -DCMAKE_PREFIX_PATH="$work/p" >log && cmake --build b >>log
./b/cpp >/dev/null && ./b/fortran >/dev/null
echo "Fortran (module and source), Python and CMake consumers run"
