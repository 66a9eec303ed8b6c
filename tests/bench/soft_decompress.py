#!/usr/bin/env python3
"""Decompression of soft spheres to jamming over several seeds: time, work, and the comparison with crunch.

usage: soft_decompress.py FILE.json N SEEDS [OPTION=VALUE ...]
SEEDS: 6 for seeds 1 to 6, 85-100 for a part. OPTION: one of System.decompress, e.g. distance=1e-11.
Prints a row a packing: processor time (crunch included), its part in crunch (wall), and what jam_decompress reports.
"""
import json
import sys
import time

import jam


def main():
    name, n = sys.argv[1], int(sys.argv[2])
    first, last = (int(seed) for seed in (sys.argv[3] if "-" in sys.argv[3] else "1-" + sys.argv[3]).split("-"))
    options = {}
    for word in sys.argv[4:]:
        key, value = word.split("=")
        try:
            options[key] = int(value)
        except ValueError:
            try:
                options[key] = float(value)
            except ValueError:
                options[key] = value
    rows = []
    print("seed status  cpu     crunch  steps back evaluations factor. distance   residual  excess same force diff.")
    for seed in range(first, last + 1):
        packing = jam.System.random(n=n, seed=seed, packing_fraction=0.70, overlap="allow")
        begun = time.process_time()
        r = packing.decompress(**options)
        row = {"seed": seed, "status": int(r.status), "cpu": time.process_time() - begun}
        for key in (
            "seconds_crunch steps restored evaluations factorisations distance force_residual excess_contacts "
            "same_network force_difference jammed_fraction crunch_fraction rattlers isostatic"
        ).split():
            row[key] = getattr(r, key)
        rows.append(row)
        print(
            f"{seed:4d} {row['status']:6d} {row['cpu']:7.2f} {row['seconds_crunch']:7.2f} {r.steps:5d} {r.restored:4d} "
            f"{r.evaluations:11d} {r.factorisations:7d} {r.distance:9.2e} {r.force_residual:9.1e} {r.excess_contacts:6d} "
            f"{r.same_network:4d} {r.force_difference:9.2e}",
            flush=True,
        )
        with open(name, "w", encoding="ascii") as file:
            json.dump({"n": n, "options": options, "packings": rows}, file)


if __name__ == "__main__":
    main()
