#!/usr/bin/env python3
"""Which lines and branches of src the tests of a build reach: a table in tests/README.md, and a floor.

usage: coverage.py BUILD [RESULT]     BUILD: by Clang with -fprofile-instr-generate -fcoverage-mapping; its tests wrote
                                      BUILD/profile/*.profraw. RESULT: tests/bench/results/coverage.json, for the page.
Exit status 1 where fewer branches are reached than the floor.
Branches are those of the source, both ways of each condition; edges of exceptions are none.
"""
import json
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.append(str(ROOT / "bindings/docs"))
import figures  # noqa: E402

FLOOR = 0.88  # share of the branches of src; 0.907 were reached when it was set
COMMAND = "sh tests/run.sh coverage"
build = Path(sys.argv[1])

merged = build / "profile/all.profdata"
profiles = sorted((build / "profile").glob("*.profraw"))
if not profiles:
    sys.exit(f"{build}/profile has no profiles: no test ran")
subprocess.run(["llvm-profdata", "merge", "-sparse", *profiles, "-o", merged], check=True)
programs = [build / "libjam.so", *sorted(path for path in (build / "tests").glob("unit_*") if path.is_file())]
objects = [f"-object={path}" for path in programs[1:]]
export = ["llvm-cov", "export", "-summary-only", f"-instr-profile={merged}", programs[0], *objects]
files = json.loads(subprocess.run(export, check=True, capture_output=True, text=True).stdout)["data"][0]["files"]

KINDS = ("lines", "branches")
sums = defaultdict(lambda: {kind: [0, 0] for kind in KINDS})
for file in files:
    path = Path(build, file["filename"]).resolve()  # ccache makes names relative
    if not path.is_relative_to(ROOT / "src"):
        continue
    layer = path.relative_to(ROOT / "src").parts[0]
    for name in (layer, "all"):
        for kind in KINDS:
            sums[name][kind][0] += file["summary"][kind]["covered"]
            sums[name][kind][1] += file["summary"][kind]["count"]


def share(pair):
    return f"{100.0 * pair[0] / pair[1]:.1f} % of {pair[1]}" if pair[1] else "none"


if not sums:
    sys.exit(f"no source of {ROOT}/src is in the programs of {build}")
rows = [[name, *(share(sums[name][kind]) for kind in KINDS)] for name in sorted(sums, key=lambda n: (n == "all", n))]
for row in rows:
    print(*row, sep="  ")
if len(sys.argv) > 2:
    figures.save(sys.argv[2], COMMAND, ["layer of src", *KINDS], rows)
covered, count = sums["all"]["branches"]
if covered < FLOOR * count:
    sys.exit(f"the tests reach {100 * covered / count:.1f} % of the branches, fewer than {100 * FLOOR:.0f} %")
