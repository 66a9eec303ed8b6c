#!/bin/sh
# From a bare Debian 12 to a picture of a jammed packing: installs what is missing, builds, packs 1024 spheres from
# nothing, crunches them to the jamming point and prints the report. It draws packing.png (or the file named as first
# argument), and beside it writes packing.html, the packing to turn and to slice in a browser.
set -eu
start=$PWD
root=$(cd "$(dirname "$0")/.." && pwd)
picture=${1:-packing.png}
case $picture in /*) ;; *) picture=$start/$picture ;; esac
page=${picture%.*}.html
. "$root/tests/debian.sh"
need_packages build-essential cmake ninja-build pkg-config libeigen3-dev coinor-libclp-dev libspectra-dev \
  zlib1g-dev python3-numpy python3-matplotlib

echo "== build"
cmake -S "$root" -B "$root/build-quick" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON \
  -DJAM_BUILD_TESTS=OFF -DJAM_WERROR="${JAM_WERROR:-OFF}" >/dev/null
cmake --build "$root/build-quick"

echo "== pack 1024 spheres"
cd "$root/build-quick"
./jam-pack --n 1024 --dim 3 --seed 1 --output packing.xyz --contacts contacts.csv --report report.json \
  --page "$page"
cat report.json

echo "== draw"
/usr/bin/python3 "$root/examples/draw_packing.py" packing.xyz contacts.csv "$picture"
echo "Open in a browser: $page"
echo "Packing, contact network and report are in $root/build-quick: packing.xyz contacts.csv report.json"
