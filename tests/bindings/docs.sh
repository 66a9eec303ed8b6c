#!/bin/sh
# Makes the site (a warning is an error) and looks for what a reader needs in it.  usage: docs.sh CMAKE BUILD_FOLDER
# ROOT
set -eu
"$1" --build "$2" --target docs
/usr/bin/python3 -B "$(dirname "$0")/check_site.py" "$2/docs/html"
html=$2/docs/html
installed=$(mktemp -d)
trap 'rm -rf "$installed"' EXIT
"$1" --install "$2" --component guide --prefix "$installed" >"$installed/log"
diff -r "$html" "$installed/share/doc/jam/html" >/dev/null || { echo "the installed guide is another one"; exit 1; }
has() { grep -q "$2" "$html/$1" || { echo "$1 does not show: $2"; exit 1; }; }
has index.html 'makes and analyses jammed packings'                      # start page
has index.html 'search.html'
has bindings/docs/jammed.html 'Collectively jammed'                      # user's guide
has bindings/docs/coming_from.html 'CALiPPSO'
has tests/bench/README.html '_images/crunch_size.png'                    # figures with their pictures
has api/cpp.html 'class.*System'
has api/python.html 'jam.System.crunch'
has src/README.html 'A layer includes only layers to its right'
for page in "$3"/bindings/docs/*.md; do                                  # no page is left out
  name=$(basename "$page" .md)
  [ "$name" = index ] || has index.html "bindings/docs/$name.html"
done
grep -o 'jam_[a-z_0-9]*(' "$3/include/jam/jam.h" | sort -u | while read -r call; do  # every function has its entry
  grep -rq "id=\"c.${call%(}\"" "$html/api" || { echo "no entry for $call)"; exit 1; }
done
