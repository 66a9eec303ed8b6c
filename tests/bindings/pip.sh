#!/bin/sh
# pip installs the package into a fresh environment, without an index; it runs from there and pip lists it.
# usage: pip.sh ROOT BUILD_FOLDER_OF_THE_WHEEL     Skipped (77) where python3-venv is missing.
set -eu
/usr/bin/python3 -c 'import ensurepip, venv' 2>/dev/null || { echo "python3-venv is not installed"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
/usr/bin/python3 -m venv --system-site-packages "$work/venv"
mkdir -p "$2"
"$work/venv/bin/pip" install -q --no-index --config-settings "build-dir=$2" "$1/bindings/python"
cd "$work"
"$work/venv/bin/pip" list 2>/dev/null | grep -E '^jam +[0-9]'
env -u PYTHONPATH -u LD_LIBRARY_PATH "$work/venv/bin/python" - "$work" <<'END'
import sys
from importlib.metadata import version

import jam

assert jam.__file__.startswith(sys.argv[1]), jam.__file__
assert version("jam") == jam.__version__.split("-")[0]
disks = jam.System.random(n=64, dim=2, seed=1, diameters=[1.0] * 32 + [1.4] * 32)
assert disks.crunch().jammed
print("jammed:", disks)
END
"$work/venv/bin/pip" uninstall -q -y jam
