#!/bin/sh
# Files of one platform are read on another: a packing, and a checkpoint, from which both go on. What both write then
# must have the same bytes.
# usage: files.sh FOLDER JAM_PACK OTHER...     OTHER: the other platform's jam-pack, behind its emulator
set -eu
folder=$1 here=$2
shift 2
mkdir -p "$folder"
cd "$folder"
rm -rf here there
mkdir here there
"$here" --n 60 --dim 3 --seed 1 --diameters-ratio 1.4 --growth 0.1:1e2 --no-crunch --checkpoint checkpoint \
  --output start.xyz.gz --quiet >log

# write NAME PROGRAM...: into the folder NAME.
write() {
  name=$1
  shift
  for ending in xyz dat data vtp; do "$@" export start.xyz.gz "$name/packing.$ending"; done
  "$@" --resume checkpoint --growth 0.1:1e4 --no-crunch --output "$name/resumed.dat" --quiet
}
write here "$here" >>log
write there "$@" >>log
diff -r here there
