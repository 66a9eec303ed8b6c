#!/usr/bin/python3
"""Verdicts on equal disks, grown at G = 1e-2 to p = 500, then at 3e-3 to 1e7. Each jammed one is checked again from
positions, contacts and forces. jamproof.py proves or traps it in integers, and up to 300 disks HiGHS looks for a motion
(`verdict` of failure_map.py). JSON to stdout; exit status 1 if one is wrong.

usage: disks.py N SEEDS [FIRST_SEED]      with PYTHONPATH set to the built module
"""
import collections
import json
import statistics
import sys
import tempfile
import time
from pathlib import Path

import failure_map
import jam

MOST_FOR_HIGHS = 300  # it needs minutes for a thousand

sys.path.append(str(Path(__file__).parents[2] / "bindings/proof"))
import jamproof  # noqa: E402


def proof(system):
    """The first word of what jamproof.py says of the packing: proved, trapped, or not proved."""
    with tempfile.TemporaryDirectory() as folder:
        path = folder + "/a.jamproof"
        system.write_proof(path)
        return jamproof.conclusion(jamproof.Scene(path))[1].split(":")[0]


n, seeds = int(sys.argv[1]), int(sys.argv[2])
first = int(sys.argv[3]) if len(sys.argv) > 3 else 1
rows = []
for seed in range(first, first + seeds):
    s = jam.System.random(n, 2, seed)
    s.compress([(1e-2, 500.0), (3e-3, 1e7)])
    began = time.process_time()
    report = s.crunch(wall_time=600)
    seconds = time.process_time() - began
    kind, reason = failure_map.verdict(s, report, motion=n <= MOST_FOR_HIGHS)
    rows.append(
        {
            "seed": seed,
            "kind": kind,
            "reason": reason,
            "proof": proof(s) if report.jammed else "",
            "rigidity": s.rigidity("collective").jammed.name.lower(),
            "seconds": round(seconds, 3),
            "factorisations": report.factorisations,
            "lps": report.lp_solves,
            "phi": report.packing_fraction,
            "force_residual": report.force_residual,
        }
    )
    print(json.dumps(rows[-1]), file=sys.stderr, flush=True)
json.dump(
    {
        "n": n,
        "kinds": collections.Counter(row["kind"] for row in rows),
        "not_confirmed": sum(row["reason"] == "not confirmed" for row in rows),
        "median_seconds": statistics.median(row["seconds"] for row in rows),
        "median_factorisations": statistics.median(row["factorisations"] for row in rows),
        "rows": rows,
    },
    sys.stdout,
    indent=1,
)
print()
sys.exit(any(row["kind"] == "wrong" for row in rows))
