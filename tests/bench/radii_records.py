"""The largest sums of radii of n disks in the unit square that a search finds, to 30 digits with the proved radius.

usage: radii_records.py FIRST LAST SECONDS FOLDER     searches of n = FIRST .. LAST in FOLDER, which another call continues;
                                                      writes results/radii_records.json
"""
import sys
from pathlib import Path

import jam
import jam.radii
from jam.errors import StateError

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "bindings/docs"))

import figures  # noqa: E402

first, last, seconds, folder = int(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3]), Path(sys.argv[4])
rows = []
for n in range(first, last + 1):
    found = jam.radii.best_of(n, walls="xy", seconds=seconds, folder=folder / str(n), workers=1)
    best = found.best[0]
    packing = jam.System.from_arrays(best.positions, radii=best.radii, overlap="shrink", box=1.0, walls="xy")
    packing.maximise_radii(room=1e-9)
    try:
        proved = jam.radii.prove(packing, 40)
        value, radius = f"{proved.value:.30f}", f"{proved.value_radius:.0e}"
    except StateError:  # more or fewer contacts than unknowns
        value, radius = f"{best.value:.15f}", "not proved"
    rows.append([n, value, radius, found.starts, found.maxima, round(found.seconds)])
    print(*rows[-1], flush=True)
figures.save(HERE / "results/radii_records.json", "radii_records.py", ["n", "sum of radii", "proved to", "starts", "maxima", "seconds"], rows)
