#!/usr/bin/python3
"""Error against time of the pore space: the volume of the mesh against its edge, the porosity of the image against its voxels.

usage: pore_space.py [--n 1024] [--out FILE.json] [--picture FILE.png]

A jammed packing; exact are its solid volume, and that of the spheres with their cylinders. Times are of the processor and
contain the file. PYTHONPATH: the built module.
"""
import argparse
import json
import tempfile
import time
from pathlib import Path

import jam

EDGES = (1.0, 0.5, 0.25, 0.125, 0.0625)
VOXELS = (32, 64, 128, 256, 512)


def measure(s, folder):
    rows = []

    def add(kind, at, call):
        seconds = []
        while len(seconds) < 3 and sum(seconds) < 0.5:  # the best of three where that is short
            began = time.process_time()
            error, size = call()
            seconds.append(time.process_time() - began)
        rows.append(dict(kind=kind, at=at, error=abs(error), bytes=size, seconds=min(seconds)))
        print(rows[-1], flush=True)

    for contacts in ("kept", "bridged"):
        for edge in EDGES:

            def mesh():
                r = s.write_stl(str(Path(folder, "p.stl")), contacts=contacts, edge=edge)
                return r.volume / r.solid - 1, r.bytes

            add(f"mesh, contacts {contacts}", edge, mesh)
    for lines in (0, 1, 4):
        for m in VOXELS:

            def image():
                r = s.write_voxels(str(Path(folder, "p.npy")), nx=m, ny=m, nz=m, lines=lines)
                return r.porosity - (1 - s.packing_fraction), r.bytes

            add(f"image, {lines**2} line{'s' * (lines > 1)} a voxel" if lines else "image, centres", m, image)
    return rows


def draw(rows, picture):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(10, 4.2))
    for axis, start in zip(axes, ("mesh", "image")):
        where = dict(xytext=(-6, -12), ha="right") if start == "mesh" else dict(xytext=(5, 6))
        kinds = list(dict.fromkeys(r["kind"] for r in rows if r["kind"].startswith(start)))
        for kind, marker in zip(kinds, "os^"):
            mine = [r for r in rows if r["kind"] == kind]
            axis.loglog([r["seconds"] for r in mine], [r["error"] for r in mine], marker=marker, label=kind)
            for r in mine if kind == kinds[0] else ():
                name = f"edge {r['at']:g} R" if start == "mesh" else f"{r['at']:g}$^3$"
                axis.annotate(name, (r["seconds"], r["error"]), textcoords="offset points", fontsize=8, **where)
        axis.margins(0.2)
        axis.set_xlabel("seconds of the processor")
        axis.legend(fontsize=8)
        axis.grid(alpha=0.3)
    axes[0].set_ylabel("error of the solid volume, relative")
    axes[1].set_ylabel("error of the porosity")
    figure.tight_layout()
    figure.savefig(picture, dpi=120)


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--n", type=int, default=1024)
    p.add_argument("--out", default="pore_space.json")
    p.add_argument("--picture", default="pore_space.png")
    args = p.parse_args()
    s = jam.System.random(args.n, 3, 1)
    s.compress()
    s.crunch()
    with tempfile.TemporaryDirectory() as folder:
        rows = measure(s, folder)
    Path(args.out).write_text(json.dumps(dict(n=args.n, packing_fraction=s.packing_fraction, rows=rows), indent=1) + "\n")
    draw(rows, args.picture)


if __name__ == "__main__":
    main()
