"""The largest sums of radii of n disks in the unit square, or balls in the cube, that a search finds, to 30 digits with the
proved radius.

usage: radii_records.py DIM FIRST LAST SECONDS FOLDER     searches of n = FIRST .. LAST in FOLDER, which another call continues;
                                                          writes results/radii_records.json, of DIM 3 radii_balls.json
"""
import sys
from pathlib import Path

import jam
import jam.radii
from jam.errors import StateError

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "bindings/docs"))

import figures  # noqa: E402

dim, first, last = map(int, sys.argv[1:4])
seconds, folder = float(sys.argv[4]), Path(sys.argv[5])
scene = {"walls": "xyz"[:dim], "box": 1.0}
rows = []
for n in range(first, last + 1):
    found = jam.radii.best_of(n, dim, **scene, seconds=seconds, folder=folder / str(n), workers=1)
    best = found.best[0]
    packing = jam.System.from_arrays(best.positions, radii=best.radii, overlap="shrink", **scene)
    packing.maximise_radii(room=1e-9)
    try:
        proved = jam.radii.prove(packing, 40)
        value, radius = f"{proved.value:.30f}", f"{proved.value_radius:.0e}"
    except StateError:  # more or fewer contacts than unknowns
        value, radius = f"{best.value:.15f}", "not proved"
    rows.append([n, value, radius, found.starts, found.maxima, round(found.seconds)])
    print(*rows[-1], flush=True)
name = "radii_records.json" if dim == 2 else "radii_balls.json"
figures.save(HERE / "results" / name, "radii_records.py", ["n", "sum of radii", "proved to", "starts", "maxima", "seconds"], rows)
