"""What digits of a jammed packing cost: processor time and errors of crunch by tolerance, from grown states.

usage: advise.py [N [SEEDS]]         one size in d = 3, as JSON: the guide's table "Which digits cost what"
       advise.py --table [SEEDS]     sizes and dimensions of jam.advise, as the table in bindings/python/jam/advice.py
"""
import json
import statistics
import sys
import time

import jam
from jam.advice import STAGES

ROWS = (
    dict(gain_tolerance=1e-3, step_tolerance=1.0, polish=0),
    dict(gain_tolerance=1e-6, step_tolerance=1e-2, polish=0),
    dict(gain_tolerance=1e-9, step_tolerance=1e-5, polish=0),
    dict(polish=0),
    {},
)
SIZES = {2: (128, 512), 3: (128, 512, 1024), 4: (128, 256)}


def measured(n, dim, seeds):
    """For each row of options (seconds, error of phi_J, force residual, overlap, jammed) of each seed; seconds of growth.
    Disks are half of them 1.4 times as large: equal ones order."""
    found, growth = [[] for _ in ROWS], []
    for seed in range(1, seeds + 1):
        sizes = [1.0] * (n // 2) + [1.4] * (n - n // 2) if dim == 2 else None
        start = jam.System.random(n, dim, seed, diameters=sizes)
        began = time.process_time()
        start.compress(stages=STAGES)
        growth.append(time.process_time() - began)
        runs = []
        for options in ROWS:
            s = start.copy()
            began = time.process_time()
            report = s.crunch(**options)
            runs.append((time.process_time() - began, report))
        exact = runs[-1][1].packing_fraction
        for row, (seconds, r) in zip(found, runs):
            row.append((seconds, abs(r.packing_fraction - exact), r.force_residual, r.max_overlap, r.jammed))
    return found, growth


def table(seeds):
    """A line a dimension and size: seconds of growth; (seconds of crunch, largest error of phi_J) for each row."""
    for dim, sizes in SIZES.items():
        for n in sizes:
            found, growth = measured(n, dim, seeds)
            rows = [
                f"({statistics.median(r[0] for r in row):.2g}, {max(r[1] for r in row):.1e})"
                for row in (found[0], found[1], found[-1])
            ]
            print(f"    ({dim}, {n}): ({statistics.median(growth):.2g}, ({', '.join(rows)})),", flush=True)


def main():
    words = sys.argv[1:]
    if words and words[0] == "--table":
        return table(int(words[1]) if len(words) > 1 else 3)
    n = int(words[0]) if words else 1024
    seeds = int(words[1]) if len(words) > 1 else 3
    found, _ = measured(n, 3, seeds)
    made = []
    for options, rows in zip(ROWS, found):
        keys = ("seconds", "error", "residual", "overlap")
        made.append({"options": options, "jammed": sum(bool(row[4]) for row in rows)})
        made[-1].update((key, statistics.median(float(row[k]) for row in rows)) for k, key in enumerate(keys))
    print(json.dumps({"n": n, "seeds": seeds, "rows": made}, indent=1))


if __name__ == "__main__":
    main()
