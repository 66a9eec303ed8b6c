#!/usr/bin/env python3
"""Dynamics and crunch from several starts and seeds: factorisations, processor time, residuals. JSON to stdout.

usage: crunch_cases.py [FILE]      FILE: a packing of another program, as the last case. PYTHONPATH: the built module.
"""
import json
import sys
import time

import jam

# name, seeds, options of the start, growth stages; no stages: the crunch begins at the random start
DEFAULT = None
FAST = [(1e-2, 500)]
CASES = (
    ("1024 spheres, default growth", 5, dict(n=1024, dim=3), DEFAULT),
    ("1024 disks, size ratio 1.4, default growth", 5, dict(n=1024, dim=2, diameters=[1.0] * 512 + [1.4] * 512), DEFAULT),
    ("512 spheres in d = 4, default growth", 5, dict(n=512, dim=4), DEFAULT),
    ("1024 spheres, G = 1e-2 to p = 500", 10, dict(n=1024, dim=3), FAST),
    ("512 spheres, random start", 10, dict(n=512, dim=3), ()),
    ("1000 spheres, size ratio 4, random start", 3, dict(n=1000, dim=3, packing_fraction=0.19, diameters=[1.0] * 500 + [4.0] * 500), ()),
    ("2000 disks, size ratio 10, random start", 3, dict(n=2000, dim=2, packing_fraction=0.25, diameters=[1.0] * 1000 + [10.0] * 1000), ()),
    ("4096 spheres, G = 1e-2 to p = 1e6", 3, dict(n=4096, dim=3), [(1e-2, 1e6)]),
)  # fmt: skip


def run(system, stages):
    began = time.process_time()
    if stages is DEFAULT:
        system.compress()
    elif stages:
        system.compress(stages=stages)
    grown = time.process_time()
    report = system.crunch()
    return {
        "dynamics": grown - began,
        "crunch": time.process_time() - grown,
        "factorisations": report.factorisations,
        "phi": report.packing_fraction,
        "jammed": bool(report.jammed),
        "excess": report.excess_contacts,
        "residual": report.force_residual,
        "overlap": report.max_overlap,
    }


def main():
    cases = []
    for name, seeds, start, stages in CASES:
        runs = [run(jam.System.random(seed=seed, **start), stages) for seed in range(1, seeds + 1)]
        cases.append({"case": name, "runs": runs})
        print(name, [r["factorisations"] for r in runs], file=sys.stderr, flush=True)
    if len(sys.argv) > 1:
        cases.append({"case": "1024 spheres, grown by another program to p = 1e5", "runs": [run(jam.System.read(sys.argv[1]), ())]})
    print(json.dumps({"cases": cases}, indent=1))


if __name__ == "__main__":
    main()
