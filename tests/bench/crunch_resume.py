#!/usr/bin/env python3
"""What a stop costs a crunch: factorisations and jamming density of crunches that go on from a checkpoint.

usage: crunch_resume.py FILE.json N SEEDS [PRESSURE]
Starts: random points at 0.3, or growth at G = 1e-2 up to PRESSURE. It stops at 0.2, 0.4, 0.6 and 0.8 of the factorisations.
A row a stop: factorisations of the whole crunch, of both parts together, and by how much phi_J differs.
"""
import json
import os
import sys
import tempfile

import jam


PRESSURE = float(sys.argv[4]) if len(sys.argv) > 4 else 0.0


def start(n, seed):
    packing = jam.System.random(n, seed=seed, packing_fraction=0.3)
    if PRESSURE:
        packing.compress([(1e-2, PRESSURE)])
    return packing


def stopped(n, seed, at, file):
    """Factorisations until the stop and after it, the report at the end."""
    system = start(n, seed)
    first = system.crunch(progress=lambda p: p.factorisations >= at)
    system.write_checkpoint(file)
    system = jam.System.from_checkpoint(file)
    return first.factorisations, system.crunch(), system


def main():
    name, n, seeds = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    rows = []
    file = os.path.join(tempfile.mkdtemp(), "state")
    print("seed  part  whole  stopped  phi_J / whole - 1  same contacts")
    for seed in range(1, seeds + 1):
        system = start(n, seed)
        whole = system.crunch()
        contacts = set(map(tuple, system.contacts.pairs))
        for part in (0.2, 0.4, 0.6, 0.8):
            before, rest, system = stopped(n, seed, part * whole.factorisations, file)
            row = {
                "seed": seed,
                "part": part,
                "whole": whole.factorisations,
                "stopped": before + rest.factorisations,
                "phi": rest.packing_fraction / whole.packing_fraction - 1.0,
                "same": set(map(tuple, system.contacts.pairs)) == contacts,
                "jammed": bool(rest.jammed),
            }
            rows.append(row)
            print("{seed:4d} {part:5.2f} {whole:6d} {stopped:8d} {phi:18.2e}  {same}".format(**row), flush=True)
            with open(name, "w", encoding="ascii") as out:
                json.dump({"n": n, "pressure": PRESSURE, "rows": rows}, out)
    cost = sum(r["stopped"] for r in rows) / sum(r["whole"] for r in rows)
    same = sum(r["same"] for r in rows)
    print(f"factorisations with a stop over without: {cost:.2f}; {same} of {len(rows)} end at the same packing")


if __name__ == "__main__":
    main()
