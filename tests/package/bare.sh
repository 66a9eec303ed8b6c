#!/bin/sh
# bare.sh FOLDER [LINE...]: lines of README's table "Install" in a bare Debian 12, which debootstrap makes as
# FOLDER/bare; each line has a copy of it, with the source and nothing else. Lines: browser, python, debian, cmake,
# octave; npm and Windows are tried by pkgconfig/release.sh. Commands are those of README, packages those of the pages
# that it links. For root, with a network.
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$1"
folder=$(cd "$1" && pwd)
shift
lines=${*:-browser python debian cmake octave}
[ "$(id -u)" = 0 ] || { echo "only root can make a bare Debian"; exit 77; }

packages=$(sed -n 's/^`\(build-essential [^`]*\)`.*/\1/p' "$source/bindings/docs/tutorial_packager.md")
octave=$(sed -n 's/.*packages `\(octave [^`]*\)`.*/\1/p' "$source/bindings/docs/octave.md")
if [ -z "$packages" ] || [ -z "$octave" ]; then echo "a page names no packages"; exit 1; fi
row() { sed -n "s/^| $1[^|]*| \`\([^\`]*\)\`.*/\1/p" "$source/README.md"; }

# begin LINE: a copy of the bare system with the source, as $root.
begin() {
  command -v debootstrap >/dev/null || { echo "debootstrap is not installed"; exit 77; }
  [ -e "$folder/bare/etc/debian_version" ] ||
    debootstrap --variant=minbase bookworm "$folder/bare" >"$folder/debootstrap.log"
  root=$folder/$1
  rm -rf "$root"
  cp -a "$folder/bare" "$root"
  echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/unsafe"  # the copy is removed at the end
  mkdir "$root/libjam"
  git -C "$source" archive HEAD | tar -xf - -C "$root/libjam"
}
# inside COMMAND: in that system, in the folder of the source. Programs find their libraries by /proc.
inside() {
  unshare -m sh -c 'mount -t proc proc "$1/proc" && exec chroot "$@"' - \
    "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/srv DEBIAN_FRONTEND=noninteractive \
    sh -euc "cd /libjam; $1" \
    >>"$root.log" 2>&1 || { tail -30 "$root.log"; echo "failed in $root: $1"; exit 1; }
}
install() { inside "apt-get update -q && apt-get install -q -y --no-install-recommends $*"; }
passed() { echo "$1: $2"; rm -rf "$folder/$1"; }

for line in $lines; do
  rm -f "$folder/$line.log"
  case $line in
    browser)
      # the page as a file, in a process that has no network but its own
      unshare -n sh -c 'ip link set lo up && exec "$@"' - env PYTHONPATH="$source/tests/bindings" \
        /usr/bin/python3 -B - <<'PYTHON'
import lab_page, browser, pathlib, tempfile
with tempfile.TemporaryDirectory() as folder:
    lab = lab_page.Lab(browser, pathlib.Path(folder))
    lab.make({"n": 32, "dim": 3, "seed": 2})
    lab.press("prove-go")
    written = lab.saved("save-xyz", "packing.xyz").split()[0]
    assert written == b"32" and not lab.text("error") and "proved" in lab.text("proof"), lab.text("error")
print("browser: examples/lab.html made, proved and wrote a packing without a network")
PYTHON
      ;;
    python)
      begin python
      install python3-venv python3-numpy
      command=$(row 'Python on Linux' | sed 's|pip install|venv/bin/pip install --no-index|')
      inside "python3 -m venv --system-site-packages venv; $command"
      sed -n '/^```python$/,/^```$/p' "$source/README.md" | sed '/^```/d; /jam[.]plot/d' >"$root/srv/readme.py"
      inside "apt-get remove -q -y gcc g++ cmake && cd /srv && /libjam/venv/bin/python readme.py && test -s packing.xyz"
      passed python "$command; README's example ran, compilers removed"
      ;;
    debian)
      begin debian
      command=$(row 'Debian 12')
      inside "$command && test -s packing.png && test -s packing.html"
      passed debian "$command drew packing.png and wrote packing.html"
      ;;
    cmake)
      begin cmake
      # shellcheck disable=SC2086
      install $packages
      command=$(row CMake)
      sed -n '/^```c$/,/^```$/p' "$source/README.md" | sed '/^```/d' >"$root/srv/example.c"
      inside "$command; export PKG_CONFIG_PATH=\$(dirname \$(find ~/opt -name jam.pc)); cd /srv
        cc example.c \$(pkg-config --cflags --libs jam) -Wl,-rpath,\$(pkg-config --variable=libdir jam) -o example
        ./example; ~/opt/bin/jam-pack --n 100 --dim 2 --diameters-ratio 1.4 --output packing.xyz --quiet
        ~/opt/bin/jam-pack check packing.xyz"
      passed cmake "$command; README's program in C and jam-pack ran"
      ;;
    octave)
      begin octave
      # shellcheck disable=SC2086
      install $packages $octave
      inside "cmake -S . -B build -DJAM_BUILD_OCTAVE=ON && cmake --build build -j2 && cd /srv &&
        octave --no-gui --path /libjam/build/octave /libjam/examples/octave/first.m"
      passed octave "built with -DJAM_BUILD_OCTAVE=ON; the first example ran"
      ;;
    *) echo "there is no line $line"; exit 2 ;;
  esac
done
