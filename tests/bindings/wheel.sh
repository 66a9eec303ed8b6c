#!/bin/sh
# wheel.sh WHEEL [PYTHON]: pip installs the wheel into an environment that has numpy and nothing else, without a
# compiler in PATH and without a network. The Python example of README.md runs there, from its import to the file that
# it writes; its plot is left out, as matplotlib is. Then size, and the systems that the wheel's symbols allow.
# Where PYTHON has no numpy, the compiled layer alone runs, and the script says so.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
wheel=$(cd "$(dirname "$1")" && pwd)/$(basename "$1") python=${2:-/usr/bin/python3}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$python" -c 'import ensurepip, venv' 2>/dev/null || { echo "$python has no venv"; exit 77; }
"$python" -m venv "$work/venv"
alone="env -i PATH=$work/venv/bin HOME=$work"
if unshare -rn true 2>/dev/null; then alone="unshare -rn $alone"; fi
packages=$("$work/venv/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
if numpy=$("$python" -c 'import numpy, pathlib; print(pathlib.Path(numpy.__file__).parent)' 2>/dev/null); then
  ln -s "$numpy" "$(dirname "$numpy")"/numpy-*-info "$packages"
else
  numpy=
fi
needs=; [ -n "$numpy" ] || needs=--no-deps
$alone pip install -q --no-index $needs "$wheel"
# What an index reads: the metadata of PEP 639, whose licences are in the wheel, and links that lead somewhere.
"$python" - "$wheel" <<'END'
import email, re, sys, zipfile

wheel = zipfile.ZipFile(sys.argv[1])
info = next(name for name in wheel.namelist() if name.endswith(".dist-info/METADATA"))
meta = email.message_from_bytes(wheel.read(info))
assert meta["Metadata-Version"] == "2.4" and not meta["License"]
assert meta["License-Expression"].startswith("MIT AND MPL-2.0")
for name in meta.get_all("License-File"):
    assert wheel.read(info.replace("METADATA", "licenses/" + name)), name
assert meta["Description-Content-Type"].startswith("text/markdown")
assert meta.get_all("Project-URL") and meta.get_all("Classifier")
text = meta.get_payload(decode=True).decode()
links = re.findall(r"\]\(([^)]*)\)", text)
assert len(links) > 10 and all(link.startswith(("https://", "#")) for link in links), links
END
sed -n '/^```python$/,/^```$/p' "$here/../../README.md" | sed '/^```/d; /jam[.]plot/d' >"$work/readme.py"
grep -q '^import jam$' "$work/readme.py" || { echo "README.md has no Python example"; exit 1; }
cd "$work"
if [ -n "$numpy" ]; then
  $alone python readme.py 2>"$work/progress" || { cat "$work/progress"; exit 1; }
  test -s packing.xyz
else
  echo "$python has no numpy: the compiled layer alone is run"
  $alone python - "$packages/jam" <<'END'
import sys, types

package = sys.modules["jam"] = types.ModuleType("jam")
package.__path__ = [sys.argv[1]]
import jam.raw as raw

print("Python", sys.version.split()[0], "libjam", raw.jam_version(), raw.jam_blas_kernel())
END
fi
bytes=$(wc -c <"$wheel")
echo "$bytes bytes"
[ "$bytes" -le 8388608 ] || { echo "more than 8 MB"; exit 1; }
"$python" -B "$here/../../bindings/python/wheel_tag.py" "$wheel"
