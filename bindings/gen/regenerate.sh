#!/bin/sh
# Writes the options of jam-pack, its completion and its page, which are committed. Needs swig and Debian's python3.
exec /usr/bin/python3 -B "$(dirname "$0")/generate.py" "$@"
