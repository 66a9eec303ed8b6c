#!/bin/sh
# Makes the API reference (a warning is an error) and looks for what a reader needs in it.  usage: docs.sh CMAKE BUILD_FOLDER
set -eu
"$1" --build "$2" --target docs
html=$2/docs/html
grep -q 'Brings the packing to its jamming point' "$html/jam_8h.html"      # a function
grep -q 'relative complementarity and residual' "$html"/structjam__crunch__options.html  # a member
grep -rq 'class.*System' "$html/classjam_1_1System.html"                      # C++
