#!/bin/sh
# From a bare Debian 12 to a jammed packing: installs what is missing, builds, packs 1024 spheres from nothing, crunches
# them to the jamming point and prints the report. It writes packing.html (or the file named as first argument), the
# packing to turn and to slice in a browser.
set -eu
start=$PWD
root=$(cd "$(dirname "$0")/.." && pwd)
page=${1:-packing.html}
case $page in /*) ;; *) page=$start/$page ;; esac
. "$root/tests/debian.sh"
need_packages build-essential cmake ninja-build pkg-config libeigen3-dev coinor-libclp-dev libspectra-dev \
  zlib1g-dev

echo "== build"
cmake -S "$root" -B "$root/build-quick" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON \
  -DJAM_BUILD_TESTS=OFF -DJAM_WERROR="${JAM_WERROR:-OFF}" >/dev/null
cmake --build "$root/build-quick"

echo "== pack 1024 spheres"
cd "$root/build-quick"
./jam-pack --n 1024 --dim 3 --seed 1 --output packing.xyz --contacts contacts.csv --report report.json \
  --page "$page"
cat report.json

echo "Open in a browser: $page"
echo "Packing, contact network and report are in $root/build-quick: packing.xyz contacts.csv report.json"
