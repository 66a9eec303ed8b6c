#!/usr/bin/env python3
"""Draws a packing in a cubic cell, d = 2 or 3, and its force network from the files that jam-pack writes.

usage: draw_packing.py PACKING.xyz CONTACTS.csv PICTURE.png

Left the spheres: stable (blue), bucklers with d + 1 contacts (orange), rattlers (grey). Right the contact forces, each
as a line as wide as its force. Make the files with: jam-pack --output PACKING.xyz --contacts CONTACTS.csv
"""
import re
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import EllipseCollection, LineCollection

COLOURS = {"stable": "#4680bf", "bucklers": "#f28c26", "rattlers": "#b8b8b8"}
TURN = np.array([[0.883, 0.469, 0.0], [-0.176, 0.331, 0.927], [0.435, -0.819, 0.375]])  # right, up, towards the eye


def read(packing, contacts):
    with open(packing, encoding="ascii") as file:
        file.readline()
        comment = file.readline()
        rows = np.loadtxt(file, ndmin=2)
    dim = int(re.search(r"\bdim=(\d)", comment).group(1))
    box = float(re.search(r'Lattice="(\S+)', comment).group(1))
    pairs = np.loadtxt(contacts, delimiter=",", skiprows=1, ndmin=2)
    return dim, box, rows[:, 1 : 1 + dim], 2 * rows[:, -2], rows[:, -1], pairs


def half_lines(x, d, pairs):
    """Each contact as two half lines, one from each centre, so that no line crosses the cell; and their forces."""
    i, j = pairs[:, :2].astype(int).T
    reach = 0.25 * ((d[i] + d[j]) * (1 + pairs[:, -2]))[:, None] * pairs[:, 2 : 2 + x.shape[1]]
    lines = np.concatenate([np.stack([x[i], x[i] - reach], 1), np.stack([x[j], x[j] + reach], 1)])
    return lines, np.tile(pairs[:, -1], 2)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    dim, box, x, d, count, pairs = read(*sys.argv[1:3])
    kind = np.select([count == 0, count == dim + 1], ["rattlers", "bucklers"], "stable")
    lines, force = half_lines(x, d, pairs)
    if dim == 3:
        x, lines = (x - box / 2) @ TURN.T, (lines - box / 2) @ TURN.T
        order, far = np.argsort(x[:, 2]), np.argsort(lines[:, :, 2].mean(1))
        x, d, kind, lines, force = x[order], d[order], kind[order], lines[far], force[far]  # the nearest ones last
    depth = np.linspace(0.25, 1, len(x)) if dim == 3 else np.ones(len(x))
    shade = np.array([matplotlib.colors.to_rgb(COLOURS[k]) for k in kind]) * depth[:, None] ** 0.5
    figure, axes = plt.subplots(1, 2, figsize=(12, 6.3))
    discs = EllipseCollection(d, d, np.zeros(len(d)), units="xy", offsets=x[:, :2], offset_transform=axes[0].transData)
    discs.set(facecolors=shade, edgecolors="white", linewidths=0.4)
    axes[0].add_collection(discs)
    grey = np.linspace(0.75, 0, len(lines))[:, None] * np.ones(3) if dim == 3 else "black"
    axes[1].add_collection(LineCollection(lines[:, :, :2], linewidths=0.9 * force, colors=grey, capstyle="round"))
    low, high = x[:, :2].min(0) - d.max() / 2, x[:, :2].max(0) + d.max() / 2
    for panel in axes:
        panel.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
        panel.set_axis_off()
    for name, colour in COLOURS.items():
        axes[0].plot([], [], "o", color=colour, label=f"{np.count_nonzero(kind == name)} {name}")
    axes[0].legend(loc="upper center", bbox_to_anchor=(0.5, 0), ncol=3, frameon=False)
    axes[1].text(0.5, -0.03, f"{len(pairs)} contact forces", transform=axes[1].transAxes, ha="center")
    figure.subplots_adjust(0.01, 0.05, 0.99, 0.99, 0.02)
    figure.savefig(sys.argv[3], dpi=90)


main()
