#!/usr/bin/env python3
"""Where dynamics at constant volume miss the caches and mispredict branches, by valgrind's model of a processor.

usage: md_misses.py [--sizes 1024,4096,16384] [--out md_misses.json]

Equal spheres, d = 3, packing fraction 0.48, 40 collisions a sphere; caches of 32 kB and 1 MB. The model runs the kernels of
AVX2 and loads nothing ahead, so it counts what look-ahead must hide. Needs valgrind; PYTHONPATH: the built module.
"""
import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

PARTS = {
    "earliest collision of a list (kernel)": ("earliest_collision", "collisions<"),
    "search of cells (kernel)": ("2::search<", "portable::search<"),
    "new list of a sphere": ("recentre", "candidates", "::append"),
    "look-ahead": ("look_ahead", "prefetch"),
    "prediction and exit": ("predict", "exit_time"),
    "collision": ("collide", "next_event", "advance", "separation"),
    "calendar": ("Calendar::", "Pace::"),
}
EVENTS = ("Ir", "D1mr", "DLmr", "Bcm")
COLLISIONS = 40


def inside(n):
    import jam

    s = jam.System.random(n, 3, 1, packing_fraction=0.25)
    s.compress(growth_rate=0.1, pressure=1e12, packing_fraction=0.48)
    print(s.run(collisions_per_particle=COLLISIONS).collisions)


def measure(n, folder):
    out = Path(folder) / f"{n}.out"
    command = ["valgrind", "--tool=callgrind", "--toggle-collect=jam_run", "--cache-sim=yes", "--branch-sim=yes"]
    command += ["--D1=32768,8,64", "--LL=1048576,8,64", f"--callgrind-out-file={out}", sys.executable, __file__, "--inside", str(n)]
    done = subprocess.run(command, check=True, capture_output=True, text=True, env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
    collisions = int(done.stdout.split()[0])
    text = subprocess.run(
        ["callgrind_annotate", "--show=" + ",".join(EVENTS), "--threshold=100", str(out)], check=True, capture_output=True, text=True
    ).stdout
    counts = {part: [0.0] * len(EVENTS) for part in PARTS}
    share = r"([\d,]+|\.)\s*(?:\([^)]*\))?\s+"
    for line in text.splitlines():
        if not (found := re.match(r"\s*" + share * len(EVENTS) + r"(\S.*)", line)):
            continue
        values = [0 if x == "." else int(x.replace(",", "")) / collisions for x in found.groups()[:-1]]
        name = found.groups()[-1]
        if "PROGRAM TOTALS" in name:
            total = values
            continue
        for part, words in PARTS.items():
            if any(word in name for word in words):
                counts[part] = [a + b for a, b in zip(counts[part], values)]
                break
    return {"n": n, "collisions": collisions, "events": EVENTS, "total": total, "parts": counts}


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--sizes", default="1024,4096,16384")
    p.add_argument("--out", type=Path, default=Path("md_misses.json"))
    p.add_argument("--inside", type=int, help=argparse.SUPPRESS)
    o = p.parse_args()
    if o.inside:
        return inside(o.inside)
    with tempfile.TemporaryDirectory() as folder:
        rows = [measure(int(n), folder) for n in o.sizes.split(",")]
    o.out.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    print(json.dumps(rows, indent=1))


if __name__ == "__main__":
    main()
