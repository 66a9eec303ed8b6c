#!/bin/sh
# Writes the generated files of all bindings from include/jam/jam.h. Needs swig and Debian's python3.
exec /usr/bin/python3 -B "$(dirname "$0")/generate.py" "$@"
