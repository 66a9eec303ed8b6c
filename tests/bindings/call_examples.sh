#!/bin/sh
# The example of each call of the C reference compiles.  usage: call_examples.sh CC ROOT
set -eu
code=$(/usr/bin/python3 -B "$2/bindings/docs/call_examples.py" "$2")
echo "$code" | "$1" -fsyntax-only -std=c99 -Wall -Wextra -Werror -I"$2/include" -xc -
