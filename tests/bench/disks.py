#!/usr/bin/python3
"""Verdicts on equal disks, grown at G = 1e-2 to p = 500, then at 3e-3 to 1e7. Each jammed one is checked again without libjam:
jamproof.py proves or traps it in integers, and up to 300 disks tests/bindings/jamming_oracle.py judges by HiGHS and singular
values. JSON to stdout; exit status 1 if one is wrong.

usage: disks.py N SEEDS [FIRST_SEED]      with PYTHONPATH set to the built module
"""
import json
import sys
import tempfile
import time
from pathlib import Path

import jam

MOST_FOR_HIGHS = 300  # it needs minutes for a thousand

TREE = Path(__file__).resolve().parents[2]
sys.path += [str(TREE / "bindings/proof"), str(TREE / "tests/bindings")]
import jamming_oracle  # noqa: E402
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
    row = {"seed": seed, "jammed": bool(report.jammed), "seconds": round(time.process_time() - began, 3)}
    row["stop_reason"], row["factorisations"] = report.stop_reason.name.lower(), report.factorisations
    row["rigidity"] = s.rigidity("collective").jammed.name.lower()
    row["proof"] = proof(s) if report.jammed else ""
    row["oracle"] = jamming_oracle.judge(s.positions, s.diameters, s.cell)[0] if report.jammed and n <= MOST_FOR_HIGHS else None
    rows.append(row)
    print(json.dumps(row), file=sys.stderr, flush=True)
print(json.dumps({"n": n, "rows": rows}, indent=1))
sys.exit(any(row["oracle"] is False or row["proof"] == "not proved" for row in rows))
