#!/bin/sh
# pip makes a wheel of the tree, without an index, and wheel.sh installs and runs it. The archive of the source has the
# same bytes each time, and the settings of its build at its root.
# usage: pip.sh ROOT BUILD_FOLDER_OF_THE_WHEEL JAM_WERROR     Skipped (77) where python3-venv is missing.
set -eu
/usr/bin/python3 -c 'import ensurepip, venv' 2>/dev/null || { echo "python3-venv is not installed"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
/usr/bin/python3 -m venv "$work/venv"
mkdir -p "$2"
"$work/venv/bin/pip" wheel -q --no-index --no-deps --config-settings "build-dir=$2" \
  --config-settings "cmake=-DJAM_WERROR=$3 -DCMAKE_EXPORT_COMPILE_COMMANDS=ON" -w "$work" "$1/bindings/python"
[ -s "$2/compile_commands.json" ] || { echo "the second of two options of CMake has no effect"; exit 1; }
sh "$1/tests/bindings/wheel.sh" "$work"/jamming-*.whl
# The tag of a wheel follows the newest version of GCC's library and of GLIBC that it asks for.
(cd "$1" && PYTHONPATH=bindings/python /usr/bin/python3 -B -c '
import wheel_tag
for glibc, step, minor in ((14, 19, 17), (17, 22, 24), (27, 22, 27), (17, 28, 31), (34, 30, 35)):
    data = f"\0GLIBC_2.{glibc}\0GLIBCXX_3.4.{step}\0".encode()
    tag = wheel_tag.platform_tag({"libjam.so": data})
    assert tag.startswith(f"manylinux_2_{minor}_"), (glibc, step, tag)')
for folder in one two; do
  mkdir "$work/$folder"
  (cd "$1" && PYTHONPATH=bindings/python /usr/bin/python3 -B -c \
    'import build_wheel, sys; build_wheel.build_sdist(sys.argv[1])' "$work/$folder")
done
cmp "$work"/one/jamming-*.tar.gz "$work"/two/jamming-*.tar.gz
tar -xzf "$work"/one/jamming-*.tar.gz -C "$work/one"
grep -q '^backend-path = \["bindings/python"\]' "$work"/one/jamming-*/pyproject.toml
if commit=$(git -C "$1" rev-parse HEAD 2>/dev/null); then
  grep -qx "$commit" "$work"/one/jamming-*/pkgconfig/archive_commit ||
    { echo "the archive does not name its commit"; exit 1; }
fi
