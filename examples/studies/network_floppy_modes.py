#!/usr/bin/env python3
"""Two floppy modes in d = 2 side by side: a localised and an extended one, of contacts with nearly the same force.

usage: network_floppy_modes.py PICTURE.png [N [SEED [RESULT.json]]]
Opening one contact (red) moves all stable disks (arrows) while every other contact stays closed. Localised: the median
displacement is far below 1/sqrt(N). Packings in which a disk touches six equal ones have a second state of self-stress and are passed
over: SEED, or the first one after it, that has a single one is drawn. Needs the Python package `jam`, numpy, matplotlib.
"""
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import jam

sys.path.append(str(Path(__file__).resolve().parents[2] / "bindings/docs"))
import figures  # noqa: E402


def draw(axis, packing, map_, contact, field, title):
    diameters, z = packing.diameters, packing.coordination
    net = packing.contacts
    i, normal = net.pairs[contact, 0], net.vectors[contact]
    middle = packing.positions[i] - 0.5 * diameters[i] * normal
    positions = (packing.positions - middle + 0.5 * packing.box) % packing.box  # the opened contact in the middle
    images = [np.array([a, b]) * packing.box for a in (-1, 0, 1) for b in (-1, 0, 1)]
    for x, s, k in zip(positions, diameters, z):
        for image in images:
            if (np.abs(x + image - 0.5 * packing.box) < 0.5 * (packing.box + s)).all():
                axis.add_patch(plt.Circle(x + image, 0.5 * s, color="0.92" if k else "0.78", linewidth=0))
    field = 3.0 * diameters.mean() * field / np.sqrt((field**2).sum(axis=1)).max()
    axis.quiver(*positions[map_].T, *field.T, angles="xy", scale_units="xy", scale=1, width=0.004, color="tab:blue")
    axis.plot(*np.full(2, 0.5 * packing.box), "o", color="red", markersize=5)
    axis.set(xlim=(0, packing.box), ylim=(0, packing.box), aspect="equal", xticks=[], yticks=[])
    axis.set_title(title, fontsize=8)


def single_state(n, seed):
    """A packing with one state of self-stress, from the first seed that gives one."""
    for k in range(seed, seed + 20):
        packing = jam.System.random(
            n=n, dim=2, seed=k, packing_fraction=0.4, diameters=np.where(np.arange(n) % 2, 1.4, 1.0)
        )
        packing.compress(growth_rate=1e-2, pressure=1e4)
        excess = packing.crunch().excess_contacts
        if excess == 0:
            return packing
        print(f"seed {k}: {excess} excess contacts, passed over")
        packing.close()
    sys.exit("no packing with one state of self-stress")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    n, seed = int(sys.argv[2]) if len(sys.argv) > 2 else 400, int(sys.argv[3]) if len(sys.argv) > 3 else 1
    packing = single_state(n, seed)
    force, local = packing.forces, (packing.contact_classes() & 1) != 0
    modes, map_ = packing.floppy_modes(), packing.hessian_map()
    b = modes.median * np.sqrt(len(map_))
    print(
        f"N' = {len(map_)}: median b sqrt(N') of {local.sum()} localised contacts {np.median(b[local]):.3f}, of {(~local).sum()} extended {np.median(b[~local]):.3f}"
    )
    rows = []
    # Of the most localised fiftieth and of the most extended tenth, the two contacts that are closest in force.
    ones = np.flatnonzero(local & (b <= np.quantile(b, 0.02)))
    twos = np.flatnonzero(~local & (b >= np.quantile(b, 0.9)))
    one, two = min(((j, k) for j in ones for k in twos), key=lambda pair: abs(np.log(force[pair[0]] / force[pair[1]])))
    figure, grid = plt.subplots(2, 2, figsize=(10, 7.6), gridspec_kw={"height_ratios": (3, 1)})
    axes, below = grid
    for axis, k, name in ((axes[0], one, "localised"), (axes[1], two, "extended")):
        title = f"{name}: f = {force[k]:.4g}, b √N' = {b[k]:.2g}, W = {modes.weight[k]:.2g}, s⁺ = {modes.s_plus[k]:.2g}, s* = {modes.s_star[k]:.2g}"
        print(title)
        rows.append([name, packing.n, packing.packing_fraction, *(float(x[k]) for x in (force, b, modes.weight, modes.s_plus))])
        field = packing.floppy_mode(int(k))
        draw(axis, packing, map_, k, field, title)
        below[int(name == "extended")].semilogy(map_, np.linalg.norm(field, axis=1) / np.linalg.norm(field), ".", ms=3)
    for axis in below:
        axis.axhline(1 / np.sqrt(len(map_)), color="0.5", ls=":", lw=1)
        axis.set(xlabel="disk i; dotted: 1 / √N'", ylabel="|dr_i| of the unit mode", ylim=(1e-4, 1))
    figure.tight_layout()
    figure.savefig(sys.argv[1], dpi=80)
    if len(sys.argv) > 4:
        columns = ["mode", "N", "phi_J", "force", "median displacement times root N'", "W", "opening of the next contact"]
        figures.save(sys.argv[4], f"network_floppy_modes.py PICTURE.png {n} {seed}", columns, rows)


if __name__ == "__main__":
    main()
