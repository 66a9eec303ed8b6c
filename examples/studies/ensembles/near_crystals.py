#!/usr/bin/env python3
"""Near-crystals: FCC spheres and hexagonal disks with a small spread of diameters, section 10 of the studies.

usage: near_crystals.py [--large] [--folder DIR] [--only-read]

Log-normal diameters on the sites of the crystal. Spheres: packing fraction 0.7, growth at G = 1e-3 to p = 1e7, crunch. Disks lie
in the rectangle that fits their lattice, where there is no molecular dynamics: random displacements and a crunch. The thesis
gives no parameters. Known (G. Tsekenis, arXiv 2006.07373): phi_J falls linearly with the spread. Packings that
end without a verdict are left out. Small: 108 spheres, 120 disks, 6 packings a spread. Large: 256 spheres, 480 disks, 60.
"""
import matplotlib.pyplot as plt
import numpy as np
from common import Results, arguments, ensemble, mean_error, seeded

import jam

FULL = {3: np.pi / 18**0.5, 2: np.pi / 12**0.5}
SPREADS = (1e-3, 3e-3, 1e-2, 3e-2)
PACKED = 0.945  # disks: start at this part of the crystal's density
KICK = 0.01  # disks: random displacements at the start, each component, in lattice spacings
ORDER = {3: ("Q_6", 1.2), 2: ("psi_6", 1.2)}


def protocol(n, deviation):
    return dict(
        n=n,
        dim=3,
        packing_fraction=0.7,
        lattice="fcc",
        diameters={"law": "lognormal", "deviation": deviation},
        stages=[{"growth_rate": 1e-3, "pressure": 1e7}],
        analysis={"gaps": {"h_max": 1.0, "stable_only": 1}, "bond_order": {"l": 6, "cutoff": 1.2}, "crystal_score": {}},
    )


def disks(n, seed, deviation):
    """Disks on a hexagonal lattice; n is 2 m k, with m columns and 2 k rows of nearly the same length."""
    columns = round((n * 3**0.5 / 2) ** 0.5)
    while n % (2 * columns):
        columns -= 1
    rows = n // columns
    x, y = np.meshgrid(np.arange(columns), np.arange(rows), indexing="xy")
    sites = np.stack([x + 0.5 * (y % 2) + 0.25, (y + 0.5) * 3**0.5 / 2], axis=-1).reshape(-1, 2) / columns
    cell = np.diag([1.0, rows * 3**0.5 / 2 / columns])
    rng = np.random.default_rng(seed)
    sizes = np.exp(np.sqrt(np.log1p(deviation**2)) * rng.normal(size=n))
    sizes *= np.sqrt(PACKED * FULL[2] * np.linalg.det(cell) / (np.pi / 4 * np.sum(sizes**2)))
    sites += rng.uniform(-KICK, KICK, sites.shape) / columns
    with jam.System.from_arrays(sites, sizes, cell=cell, seed=seed, overlap="shrink") as packing:
        report = packing.crunch()
        made = {"jammed": report.jammed, "phi": report.packing_fraction, "order": np.mean(packing.bond_order(6, 1.2))}
        if report.jammed:
            made["forces"], made["gaps"] = packing.forces, packing.call("gaps", 1.0, 1).gap
        return made


def spheres(o, n, deviation, count):
    made = []
    for entry in ensemble(o, protocol(n, deviation), count):
        one = {"jammed": entry.row["jammed"], "phi": entry.row["packing_fraction"]}
        if one["jammed"]:
            f, gaps, order = entry.read("forces", "gaps", "bond_order")
            one.update(forces=f, gaps=gaps, order=np.mean(order))
        made.append(one)
    return made


def disks_of(o, n, deviation, count):
    return seeded(o, f"hexagonal_n{n}", f"deviation{deviation:g}_", count, lambda s: disks(n, s, deviation))


def one_kind(o, r, axes, dim, n, count):
    loss, order, mark = [], [], "o-" if dim == 3 else "s--"
    name = f"{'FCC' if dim == 3 else 'hexagonal'}, N = {n}"
    for k, deviation in enumerate(SPREADS):
        made = (spheres if dim == 3 else disks_of)(o, n, deviation, count)
        good = [m for m in made if m["jammed"]]
        if len(good) < 2:
            continue
        phi, q = mean_error([m["phi"] for m in good]), mean_error([m["order"] for m in good])
        loss.append((deviation, FULL[dim] - phi[0], phi[1])), order.append((deviation, *q))
        gaps, forces = [m["gaps"] for m in good], [m["forces"] for m in good]
        for axis, values in ((axes[2], gaps), (axes[3], forces)):
            pool = np.sort(np.concatenate(values))
            axis.loglog(
                pool[pool > 0],
                (np.arange(1, len(pool) + 1) / len(pool))[pool > 0],
                mark[1:],
                color=f"C{k}",
                lw=1,
                label=f"{name}, spread {deviation:g}",
            )
    if len(loss) < 3:
        return
    loss, order = np.array(loss), np.array(order)
    axes[0].loglog(loss[:, 0], loss[:, 1], mark, label=name)
    axes[1].semilogx(order[:, 0], order[:, 1], mark, label=f"{ORDER[dim][0]}, {name}")
    x, y, e = np.log(loss[:, 0]), np.log(loss[:, 1]), np.maximum(loss[:, 2] / loss[:, 1], 1e-3)
    (power, _), cov = np.polyfit(x, y, 1, w=1 / e, cov="unscaled")
    r.add("10", f"power of the spread in phi_crystal - phi_J, {name}", 1.0, power, cov[0, 0] ** 0.5)


def main():
    o = arguments(__doc__.splitlines()[0]).parse_args()
    r = Results(o, "near_crystals")
    figure, axes = plt.subplots(1, 4, figsize=(17, 4.5))
    one_kind(o, r, axes, 3, 256 if o.large else 108, 60 if o.large else 6)
    one_kind(o, r, axes, 2, 480 if o.large else 120, 60 if o.large else 6)
    axes[0].plot([1e-3, 3e-2], [2e-3, 6e-2], "k--", lw=1, label="slope 1")
    names = (("spread", "phi_crystal - phi_J"), ("spread", "bond order"), ("h", "cdf of gaps"), ("f", "cdf of forces"))
    for axis, (x, y) in zip(axes, names):
        axis.set(xlabel=x, ylabel=y)
    for k in (0, 1, 2):
        axes[k].legend(fontsize=6)
    r.write(figure)


if __name__ == "__main__":
    main()
