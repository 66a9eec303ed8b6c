#!/bin/sh
# julia.sh BUILD: runs the Julia layer's tests and all examples with a real Julia. Takes a Julia on PATH, or else
# fetches Debian 11's package (1.5.3) with what it needs into BUILD/julia-run: nothing is installed, and apt's own lists
# stay as they are. Exit status 77 (skipped) where no Julia can be had.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=$(cd "$1" && pwd)
home=$build/julia-run
skip() { echo "skipped: $*"; exit 77; }

fetch() {
  command -v apt-get >/dev/null || skip "no Julia on PATH and no apt-get to fetch one"
  uri=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 2>/dev/null | grep '/debian/*$' | head -n 1)
  [ -n "$uri" ] || skip "no Julia on PATH, and apt knows no Debian archive"
  mkdir -p "$home/apt/lists/partial" "$home/apt/cache/archives/partial" "$home/apt/empty.d" "$home/deb" "$home/tree"
  : >"$home/apt/status"
  echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $uri bullseye main" >"$home/apt/sources.list"
  # An apt of its own: own lists, own cache, and a system on which nothing is installed.
  private() {
    apt-get -q -o Dir::Etc::SourceList="$home/apt/sources.list" -o Dir::Etc::SourceParts="$home/apt/empty.d" \
      -o Dir::Etc::Preferences=/dev/null -o Dir::Etc::PreferencesParts="$home/apt/empty.d" \
      -o Dir::State="$home/apt" -o Dir::State::Lists="$home/apt/lists" -o Dir::State::Status="$home/apt/status" \
      -o Dir::Cache="$home/apt/cache" -o APT::Sandbox::User= -o Debug::NoLocking=1 \
      -o Acquire::Languages=none -o Acquire::Retries=2 -o Acquire::http::Timeout=60 "$@"
  }
  private update >"$home/apt/log" 2>&1 || skip "no Julia on PATH, and $uri cannot be read"
  private install -y --no-install-recommends --print-uris julia >"$home/apt/uris" 2>>"$home/apt/log" ||
    skip "no Julia on PATH, and $uri has no bullseye/julia"
  # The C and C++ run-time libraries are the host's: libjam was linked against them, and they are newer.
  host='libc6|libc-bin|libgcc-s1|libstdc\+\+6|libgomp1|libgfortran5|libquadmath0|gcc-.*-base|libcrypt1'
  host="$host|dpkg|tar|debconf|perl-base|install-info"
  packages=$(sed -n "s/^'[^']*\/\([^_/']*\)_.*/\1/p" "$home/apt/uris" | sed 's/%2b/+/g' |
    grep -vE "^($host)\$")
  (cd "$home/deb" && private download $packages) >>"$home/apt/log" 2>&1 ||
    skip "the packages of Julia cannot be fetched"
  for deb in "$home"/deb/*.deb; do dpkg -x "$deb" "$home/tree"; done
  rm -rf "$home/deb"
  touch "$home/complete"
}

if command -v julia >/dev/null; then
  julia=julia
else
  [ -f "$home/complete" ] || fetch
  lib=$home/tree/usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || gcc -print-multiarch)
  julia=$home/tree/usr/bin/julia
  blas=$(find "$home/tree" -name 'lib*.so*' -path '*openblas*' -printf '%h\n' | sort -u | tr '\n' ':')
  JULIA_LIBRARIES=$lib/julia:$lib:$blas
  export JULIA_BINDIR="$home/tree/usr/bin"
fi
# -O0: most of the time goes into compiling, and libjam does the work.
# Debian 11's Julia loads libunwind, whose unwinder aborts in C++ exceptions. libgcc's must come first.
run() { LD_PRELOAD=${JULIA_LIBRARIES:+libgcc_s.so.1} LD_LIBRARY_PATH=${JULIA_LIBRARIES:-} "$julia" -O0 "$@"; }
run --version
export JULIA_DEPOT_PATH="$home/depot" JULIA_LOAD_PATH="$build/julia:@stdlib" JAM_LIBRARY="$build/libjam.so"
work=$home/work
rm -rf "$work" && mkdir -p "$work"
cd "$work"
# the programs of the guide's page
block() { sed -n "/^## $1/,/^## /p" "$root/bindings/docs/julia.md" | sed -n '/^```julia$/,/^```$/p' | grep -v '^```'; }
block "From nothing" >guide.jl
block "CALiPPSO" >>guide.jl
printf '1.17 0.05 false\n1.04 0.03 false\n' >theirs.txt
# One process for tests, guide and examples, as most of the time goes into compiling what they share.
cat >all.jl <<'EOF'
tests, examples = ARGS
include(tests)
write("start.dat", System(n = 64, dim = 3, seed = 1, packing_fraction = 0.3); format = :plain)
for program in ["guide.jl"; readdir(examples; join = true)]
    println("== ", basename(program))
    append!(empty!(ARGS), basename(program) == "calippso.jl" ? ["start.dat", "theirs.txt", "0.5"] : [])
    Base.include(Module(), abspath(program))
end
EOF
run all.jl "$build/julia/Jam/test/runtests.jl" "$root/examples/julia"
