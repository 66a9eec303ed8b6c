#!/usr/bin/env python3
"""The package for JavaScript beside a native libjam: processor seconds of the same work, in turns, and bytes of the module.
The first work of each kind, in which the engine of JavaScript compiles, takes up to half a second more and is left out.

usage: wasm.py BUILD-WASM BUILD [--sizes 256,1024] [--rounds 3] [--gate]
BUILD: a build with the Python module and the target jam_of_set, the library whose loops JAM_BITS_SET names.
--gate: fails where the module is 10 % larger than in results/wasm.json, or a step takes 5 % more native times than there.
"""
import argparse
import gzip
import json
import os
import statistics
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
STEPS = ("compress", "crunch", "check", "prove")
NATIVE = """
import json, sys, time
import jam
made = {}
for n in 2 * list(map(int, sys.argv[1].split(","))):  # the second time counts
    p = jam.System.random(n=n, dim=3, seed=1)
    for step in sys.argv[2].split(","):
        begun = time.process_time()
        getattr(p, step)()
        made[f"{n} {step}"] = time.process_time() - begun
print(json.dumps(made))
"""
WASM = """
const { load } = await import(process.env.JAM_JS);
const made = {};
const jam = await load();
const sizes = process.argv[1].split(',');
for (const n of [...sizes, ...sizes]) { // the first time compiles
  const p = jam.random({ n: Number(n), seed: 1 });
  for (const step of process.argv[2].split(',')) {
    const begun = process.cpuUsage();
    p[step]();
    const used = process.cpuUsage(begun);
    made[`${n} ${step}`] = (used.user + used.system) / 1e6;
  }
}
console.log(JSON.stringify(made));
"""


def run(command, **more):
    done = subprocess.run(command, env={**os.environ, "OPENBLAS_NUM_THREADS": "1", **more}, capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr)
    return json.loads(done.stdout)


def measure(args):
    rounds = []
    library = args.native / "tests/libjam_of_set.so"
    if not library.exists():
        sys.exit(f"{library} is not there: cmake --build {args.native} --target jam_of_set")
    work = [args.sizes, ",".join(STEPS)]
    for _ in range(args.rounds):
        wasm = run(["node", "--input-type=module", "-e", WASM, *work], JAM_JS=str(args.wasm.resolve() / "js/node.mjs"))
        native = run([sys.executable, "-c", NATIVE, *work], PYTHONPATH=str(args.native / "python"), LD_PRELOAD=str(library.resolve()))
        rounds.append((wasm, native))
    module = (args.wasm / "js/jam.wasm").read_bytes()
    # the least of each: other jobs only add
    rows = {key: [min(r[k][key] for r in rounds) for k in (0, 1)] for key in rounds[0][0]}
    return {"bytes": len(module), "gzipped": len(gzip.compress(module, 9, mtime=0)), "rows": rows}


def gate(now, before):
    """now: as measure() gives it; before: rows of results/wasm.json, of which the first has the bytes."""
    sizes, *steps = before
    faults = [f"{key}: {now[key]}, {was} before" for key, was in zip(("bytes", "gzipped"), sizes[1:3]) if now[key] > 1.10 * was]
    for name, *_, was in steps:
        wasm, native = now["rows"].get(name.removesuffix(" (s)"), (0.0, 1.0))  # a size that is not measured now
        if wasm / native > 1.05 * was:
            faults.append(f"{name}: {wasm / native:.2f} native times, {was:.2f} before")
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("wasm", type=Path)
    parser.add_argument("native", type=Path)
    parser.add_argument("--sizes", default="256,1024")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--gate", action="store_true")
    args = parser.parse_args()
    now = measure(args)
    print(json.dumps(now, indent=1))
    print(f"median native times: {statistics.median(w / n for w, n in now['rows'].values()):.2f}", file=sys.stderr)
    if args.gate and (faults := gate(now, json.loads((HERE / "results/wasm.json").read_text())["rows"])):
        sys.exit("\n".join(faults))


if __name__ == "__main__":
    main()
