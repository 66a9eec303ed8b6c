#!/usr/bin/python3
"""draw_pore_space.py PICTURE: a bridged mesh, a section of the image, pore sizes, and the profile in a tube."""
import struct
import sys
import tempfile
from pathlib import Path

import jam
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection


def corners(path):
    data = Path(path).read_bytes()
    (count,) = struct.unpack_from("<I", data, 80)
    return np.frombuffer(data, np.dtype([("n", "<f4", 3), ("x", "<f4", (3, 3)), ("e", "<u2")]), count, 84)["x"]


bed = jam.System.random(n=200, seed=1)
bed.compress(growth_rate=1e-2, pressure=1e6)
bed.crunch()
tube = jam.System.random(n=2000, seed=1, packing_fraction=0.25, cell=[1, 1, 3], container="cylinder")
tube.compress(packing_fraction=0.58)

figure = plt.figure(figsize=(11, 8.5))
few = jam.System.random(n=40, seed=2)
few.compress(growth_rate=1e-2, pressure=1e6)
few.crunch()
with tempfile.TemporaryDirectory() as folder:
    path = str(Path(folder, "few.stl"))
    report = few.write_stl(path, contacts="bridged", bridge=0.3, edge=0.2)
    mesh = corners(path)
axis = figure.add_subplot(2, 2, 1, projection="3d")
normal = np.cross(mesh[:, 1] - mesh[:, 0], mesh[:, 2] - mesh[:, 0])
normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-30)[:, None]
light = 0.35 + 0.65 * np.clip(normal @ np.array([0.3, -0.6, 0.74]), 0, 1)
colour = np.where(np.abs(normal).max(1)[:, None] > 1 - 1e-6, [[0.85, 0.55, 0.25]], [[0.45, 0.6, 0.8]])
axis.add_collection3d(Poly3DCollection(mesh, facecolors=colour * light[:, None], edgecolors="none"))
axis.set(xlim=(0, 1), ylim=(0, 1), zlim=(0, 1), box_aspect=(1, 1, 1))
axis.set_axis_off()
axis.set_title(f"{report.triangles} triangles, {report.bridges} bridges; cuts in brown", fontsize=10)

axis = figure.add_subplot(2, 2, 2)
image = bed.image(size=1 / 300)
axis.imshow(image[:, :, 150].T, origin="lower", cmap="Greys", extent=(0, 1, 0, 1))
axis.set(xlabel="x", ylabel="y", title=f"image, porosity {1 - image.mean():.4f} (exact {1 - bed.packing_fraction:.4f})")

axis = figure.add_subplot(2, 2, 3)
pores = bed.pore_sizes(20000, 1)
sigma = bed.diameters.mean()
for values, name in ((pores.distance, "largest sphere about the point"), (pores.radius, "largest sphere with the point")):
    axis.hist(2 * values / sigma, bins=80, density=True, histtype="step", label=name)
axis.set(xlabel="pore diameter / sphere diameter", ylabel="density", title="pore sizes at 20000 points of the void")
axis.legend(fontsize=8)

axis = figure.add_subplot(2, 2, 4)
profile = tube.solid_profile(3, 120)
wall = (0.5 - 0.5 * (profile.low + profile.high)) / tube.diameters.mean()
axis.plot(wall, 1 - profile.solid)
axis.axhline(1 - tube.packing_fraction, color="0.6", lw=0.8)
axis.set(xlabel="distance from the wall / sphere diameter", ylabel="porosity", xlim=(0, wall.max()), title="shells of a tube")
figure.tight_layout()
figure.savefig(sys.argv[1], dpi=80)
