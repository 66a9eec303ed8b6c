#!/usr/bin/env python3
"""Draws a packing and its force network from the files that jam-pack writes.

usage: draw_packing.py PACKING.xyz CONTACTS.csv PICTURE.png

Left the spheres: blue stable, orange bucklers (exactly d+1 contacts, the softest of the stable ones), grey rattlers (none).
Right the contact forces, each contact as a line as wide as its force is strong. d = 2 and d = 3.
Make the files with: jam-pack --output PACKING.xyz --contacts CONTACTS.csv
"""
import re
import sys

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import EllipseCollection, LineCollection
from PIL import Image  # matplotlib needs it too

STABLE, BUCKLER, RATTLER = (0.27, 0.48, 0.72), (0.95, 0.55, 0.15), (0.72, 0.72, 0.72)


def read_xyz(path):
    """Dimension, side of the box, positions (n, d), diameters, contacts of each sphere."""
    with open(path, encoding="ascii") as file:
        count = int(file.readline())
        comment = file.readline()
        rows = np.loadtxt(file, ndmin=2)
    if ":contacts:I:1" not in comment:
        sys.exit(f"{path} has no contacts column: write it with jam-pack after a crunch")
    dim = int(re.search(r"\bdim=(\d)", comment).group(1))
    box = float(re.search(r'Lattice="(\S+)', comment).group(1))
    if dim not in (2, 3) or len(rows) != count:
        sys.exit(f"{path}: d = {dim}, {len(rows)} of {count} spheres; only d = 2 and d = 3 can be drawn")
    return dim, box, rows[:, 1 : 1 + dim], 2.0 * rows[:, -2], rows[:, -1].astype(int)


def read_contacts(path, dim):
    rows = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
    return rows[:, :2].astype(int), rows[:, 2 : 2 + dim], rows[:, -2], rows[:, -1]


def half_lines(x, diameter, contacts):
    """Each contact as two half lines, one from each centre, so that no line crosses the box; and their forces."""
    pair, normal, gap, force = contacts
    reach = 0.25 * ((diameter[pair[:, 0]] + diameter[pair[:, 1]]) * (1.0 + gap))[:, None] * normal
    first, second = x[pair[:, 0]], x[pair[:, 1]]
    return np.concatenate([np.stack([first, first - reach], 1), np.stack([second, second + reach], 1)]), np.tile(
        force, 2
    )


def colours(contacts, dim):
    table = np.tile(STABLE, (len(contacts), 1))
    table[contacts == dim + 1] = BUCKLER
    table[contacts == 0] = RATTLER
    return table


def draw_flat(axes, box, x, diameter, table, contacts):
    """d = 2: discs with their periodic copies at the walls, cut at the box."""
    shifts = [(a * box, b * box) for a in (-1, 0, 1) for b in (-1, 0, 1)]
    for panel, alpha in ((axes[0], 1.0), (axes[1], 0.25)):
        for shift in shifts:
            discs = EllipseCollection(
                diameter,
                diameter,
                np.zeros(len(x)),
                offsets=x + shift,
                units="xy",
                offset_transform=panel.transData,
                facecolors=table,
                edgecolors="white",
                linewidths=0.3,
            )
            discs.set_alpha(alpha)
            panel.add_collection(discs)
        panel.set_xlim(0, box)
        panel.set_ylim(0, box)
    lines, force = half_lines(x, diameter, contacts)
    for shift in shifts:
        axes[1].add_collection(
            LineCollection(lines + np.array(shift), linewidths=0.9 * force, colors="black", capstyle="round")
        )


def view():
    """Orthographic view on a corner of the cube: rows are right, up, towards the eye."""
    a, b = np.radians(28.0), np.radians(22.0)
    turn = np.array([[np.cos(a), np.sin(a), 0], [-np.sin(a), np.cos(a), 0], [0, 0, 1]])
    tilt = np.array([[1, 0, 0], [0, np.sin(b), np.cos(b)], [0, -np.cos(b), np.sin(b)]])
    return tilt @ turn


def render(points, radii, table, half, pixels=1000):
    """Shaded spheres by a depth buffer: points (n, 3) in the view's frame, window [-half, half]^2."""
    image = np.ones((pixels, pixels, 3))
    depth = np.full((pixels, pixels), -np.inf)
    scale = pixels / (2.0 * half)
    light = np.array([-0.4, 0.6, 0.7]) / np.linalg.norm([-0.4, 0.6, 0.7])
    near, far = points[:, 2].max(), points[:, 2].min()
    for (px, py, pz), r, colour in zip(points, radii, table):
        u, v, s = (px + half) * scale, (py + half) * scale, r * scale
        u0, u1, v0, v1 = (int(max(0, np.floor(c))) for c in (u - s, u + s + 1, v - s, v + s + 1))
        gx, gy = np.meshgrid(
            (np.arange(u0, min(u1, pixels)) + 0.5 - u) / s, (np.arange(v0, min(v1, pixels)) + 0.5 - v) / s
        )
        inside = gx**2 + gy**2 < 1.0
        gz = np.sqrt(np.where(inside, 1.0 - gx**2 - gy**2, 0.0))
        z = pz + r * gz
        window = (slice(v0, v0 + gx.shape[0]), slice(u0, u0 + gx.shape[1]))
        shown = inside & (z > depth[window])
        bright = 0.45 + 0.55 * np.clip(gx * light[0] + gy * light[1] + gz * light[2], 0.0, 1.0)
        bright *= 0.75 + 0.25 * (pz - far) / (near - far + 1e-30)
        depth[window] = np.where(shown, z, depth[window])
        image[window] = np.where(shown[..., None], bright[..., None] * colour, image[window])
    return image


def draw_solid(axes, box, x, diameter, table, contacts):
    """d = 3: shaded spheres, and the forces in the same view, paler with distance."""
    matrix = view()
    half = 0.5 * box * np.abs(matrix[:2]).sum(1).max() + 0.5 * diameter.max()
    centre = np.full(3, 0.5 * box)
    image = render((x - centre) @ matrix.T, 0.5 * diameter, table, half)
    axes[0].imshow(image, origin="lower", extent=(-half, half, -half, half), interpolation="bilinear")
    lines, force = half_lines(x, diameter, contacts)
    lines = (lines - centre) @ matrix.T
    order = np.argsort(lines[:, :, 2].mean(1))
    lines, force = lines[order], force[order]
    near = (lines[:, :, 2].mean(1) - lines[:, :, 2].min()) / np.ptp(lines[:, :, 2])
    shade = np.column_stack(
        [np.outer(1.0 - near, [0.75, 0.78, 0.85]) + np.outer(near, [0.55, 0.05, 0.1]), 0.25 + 0.75 * near]
    )
    axes[1].add_collection(LineCollection(lines[:, :, :2], linewidths=0.85 * force, colors=shade, capstyle="round"))
    corners = np.array([[a, b, c] for a in (0, 1) for b in (0, 1) for c in (0, 1)]) * box
    edges = [(p, q) for k, p in enumerate(corners) for q in corners[k + 1 :] if np.count_nonzero(p != q) == 1]
    edges = (np.array(edges) - centre) @ matrix.T
    axes[1].add_collection(LineCollection(edges[:, :, :2], linewidths=0.6, colors="grey"))
    axes[1].set_xlim(-half, half)
    axes[1].set_ylim(-half, half)


def save(figure, path):
    """PNG with 64 colours: a quarter of the bytes of full colour."""
    figure.set_dpi(90)
    if not path.endswith(".png"):
        figure.savefig(path)
        return
    figure.canvas.draw()
    image = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[..., :3])
    image.quantize(64, kmeans=4, dither=Image.Dither.NONE).save(path, optimize=True)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    dim, box, x, diameter, coordination = read_xyz(sys.argv[1])
    contacts = read_contacts(sys.argv[2], dim)
    figure, axes = plt.subplots(1, 2, figsize=(12, 6.3))
    draw = draw_flat if dim == 2 else draw_solid
    draw(axes, box, x, diameter, colours(coordination, dim), contacts)
    for panel in axes:
        panel.set_aspect("equal")
        panel.set_axis_off()
    rattlers, bucklers = np.count_nonzero(coordination == 0), np.count_nonzero(coordination == dim + 1)
    handles = [
        plt.Line2D([], [], marker="o", linestyle="", markersize=9, color=c, label=text)
        for c, text in (
            (STABLE, f"{len(x) - rattlers - bucklers} stable"),
            (BUCKLER, f"{bucklers} bucklers"),
            (RATTLER, f"{rattlers} rattlers"),
        )
    ]
    axes[0].legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=3, frameon=False)
    axes[1].text(0.5, -0.03, f"{len(contacts[0])} contact forces", transform=axes[1].transAxes, ha="center")
    figure.subplots_adjust(0.01, 0.05, 0.99, 0.99, 0.02)
    save(figure, sys.argv[3])
    print(f"{sys.argv[3]}: {len(x)} spheres, {rattlers} rattlers, {bucklers} bucklers, {len(contacts[0])} contacts")


main()
