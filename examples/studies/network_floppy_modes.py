#!/usr/bin/env python3
"""Two floppy modes in d = 2 side by side: a localised and an extended one, of contacts with nearly the same force.

usage: network_floppy_modes.py PICTURE.png [N] [SEED]
Opening one contact (red) moves all stable disks (arrows) while every other contact stays closed. Localised: the median
displacement is far below 1/sqrt(N). Needs the Python package `jam`, numpy, matplotlib.
"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import jam  # noqa: E402


def draw(axis, packing, map_, contact, field, title):
    positions, diameters, z = packing.positions, packing.diameters, packing.coordination
    for k, (x, s) in enumerate(zip(positions, diameters)):
        axis.add_patch(plt.Circle(x, 0.5 * s, color="0.93" if z[k] else "0.8", linewidth=0))
    field = 0.5 * diameters.mean() * 6.0 * field / np.sqrt((field**2).sum(axis=1)).max()
    axis.quiver(*positions[map_].T, *field.T, angles="xy", scale_units="xy", scale=1, width=0.003, color="tab:blue")
    net = packing.contacts
    i, normal = net.pairs[contact, 0], net.vectors[contact]
    middle = positions[i] - 0.5 * diameters[i] * normal
    axis.plot(*middle, "o", color="red", markersize=6)
    axis.set(xlim=(0, packing.box), ylim=(0, packing.box), aspect="equal", xticks=[], yticks=[], title=title)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    n, seed = int(sys.argv[2]) if len(sys.argv) > 2 else 400, int(sys.argv[3]) if len(sys.argv) > 3 else 1
    packing = jam.System.random(n=n, dim=2, seed=seed, packing_fraction=0.4, diameters=np.where(np.arange(n) % 2, 1.4, 1.0))
    packing.compress(growth_rate=1e-2, pressure=1e4)
    report = packing.crunch()
    if report.excess_contacts != 0:
        sys.exit(f"{report.excess_contacts} excess contacts: floppy modes need one state of self-stress; try another seed")
    force, local = packing.forces, (packing.contact_classes() & 1) != 0
    modes, map_ = packing.floppy_modes(), packing.hessian_map()
    b = modes.median * np.sqrt(len(map_))
    print(f"N' = {len(map_)}: median b sqrt(N') of {local.sum()} localised contacts {np.median(b[local]):.3f}, of {(~local).sum()} extended {np.median(b[~local]):.3f}")
    one = np.argmin(b)  # the most localised
    candidates = np.flatnonzero(b > np.median(b[~local]))
    two = candidates[np.argmin(abs(force[candidates] - force[one]))]
    figure, axes = plt.subplots(1, 2, figsize=(13, 6.8))
    for axis, k, name in ((axes[0], one, "localised"), (axes[1], two, "extended")):
        title = f"{name}: f = {force[k]:.3g}, b sqrt(N') = {b[k]:.2g}, s+ = {modes.s_plus[k]:.2g}, s* = {modes.s_star[k]:.2g}"
        print(title)
        draw(axis, packing, map_, k, packing.floppy_mode(int(k)), title)
    figure.tight_layout()
    figure.savefig(sys.argv[1], dpi=100)


if __name__ == "__main__":
    main()
