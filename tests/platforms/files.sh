#!/bin/sh
# Files of one platform are read on another: a packing, and a checkpoint, from which both go on. What both write then
# must have the same bytes. A processor with the other order of bytes must refuse the checkpoint with its reason.
# usage: files.sh FOLDER ORDER JAM_PACK OTHER...     ORDER: of bytes there, same or other
#                                                    OTHER: the other platform's jam-pack, behind its emulator
set -eu
folder=$1 order=$2 here=$3
shift 3
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
}
# resume FILE PROGRAM...
resume() {
  file=$1
  shift
  "$@" --resume checkpoint --growth 0.1:1e4 --no-crunch --output "$file" --quiet
}
write here "$here" >>log
write there "$@" >>log
if [ "$order" = other ]; then
  if resume there/resumed.dat "$@" 2>refused; then echo "the checkpoint was read" >&2; exit 1; fi
  grep 'order of bytes' refused || { cat refused >&2; exit 1; }
else
  resume here/resumed.dat "$here"
  resume there/resumed.dat "$@"
fi
diff -r here there
