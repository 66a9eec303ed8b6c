#!/bin/sh
# Writes the page of the guide on the options of jam-pack, which is committed. Needs Debian's python3.
exec /usr/bin/python3 -B "$(dirname "$0")/generate.py" "$@"
