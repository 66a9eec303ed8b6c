#!/usr/bin/env python3
"""Draws packings between walls: disks between lines and in a circle, spheres in a tube and in a ball.

usage: draw_walls.py PICTURE.png
"""
import sys

import jam
import jam.plot
import matplotlib.pyplot as plt
import numpy as np

two_sizes = np.where(np.arange(150) % 2, 1.0, 1.4)
scenes = {
    "disks between lines": dict(n=150, dim=2, packing_fraction=0.4, cell=[1.6, 1.0], walls="y", diameters=two_sizes),
    "disks in a circle": dict(n=150, dim=2, packing_fraction=0.4, container="ball", diameters=two_sizes),
    "spheres in a tube": dict(n=200, packing_fraction=0.2, cell=[1, 1, 1.6], container="cylinder"),
    "spheres in a ball": dict(n=200, packing_fraction=0.2, container="ball"),
}
figure, axes = plt.subplots(1, 4, figsize=(15, 4.6))
for ax, (title, options) in zip(axes, scenes.items()):
    system = jam.System.random(seed=1, **options)
    system.compress(pressure=1e6)
    jam.plot.packing(system, ax)
    ax.set_title(f"{title}\n$\\phi$ = {system.packing_fraction:.4f}", fontsize=11)
figure.tight_layout()
figure.savefig(sys.argv[1], dpi=100, bbox_inches="tight")
