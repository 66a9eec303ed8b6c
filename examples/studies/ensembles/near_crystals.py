#!/usr/bin/env python3
"""Near-crystals: FCC spheres and hexagonal disks with a small spread of diameters, section 10 of the studies.

usage: near_crystals.py [--large] [--folder DIR] [--only-read]

Log-normal diameters on the sites of the crystal. Spheres: packing fraction 0.7, growth at G = 1e-3 to p = 1e7, crunch. Disks lie
in the rectangle that fits their lattice, where there is no molecular dynamics: random displacements and a crunch. The thesis
gives no parameters. Known (G. Tsekenis, arXiv 2006.07373): phi_J falls linearly with the spread. Packings that
end without a verdict are left out. Small: 108 spheres, 120 disks, 6 packings a spread. Large: 256 spheres, 480 disks, 60.
"""
import numpy as np
from common import Results, arguments, ensemble, mean_error, seeded

import jam

FULL = {3: np.pi / 18**0.5, 2: np.pi / 12**0.5}
SPREADS = (1e-3, 3e-3, 1e-2, 3e-2)
PACKED = 0.945  # disks: start at this part of the crystal's density
KICK = 0.01  # disks: random displacements at the start, each component, in lattice spacings


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
        return {"jammed": report.jammed, "phi": report.packing_fraction}


def spheres(o, n, deviation, count):
    return [{"jammed": e.row["jammed"], "phi": e.row["packing_fraction"]} for e in ensemble(o, protocol(n, deviation), count)]


def disks_of(o, n, deviation, count):
    return seeded(o, f"hexagonal_n{n}", f"deviation{deviation:g}_", count, lambda s: disks(n, s, deviation))


def one_kind(o, r, dim, n, count):
    loss = []
    for deviation in SPREADS:
        phi = [m["phi"] for m in (spheres if dim == 3 else disks_of)(o, n, deviation, count) if m["jammed"]]
        if len(phi) > 1:
            mean, error = mean_error(phi)
            loss.append((deviation, FULL[dim] - mean, error))
    if len(loss) > 2:
        x, y, e = np.array(loss).T
        (power, _), cov = np.polyfit(np.log(x), np.log(y), 1, w=1 / np.maximum(e / y, 1e-3), cov="unscaled")
        text = f"power of the spread in phi_crystal - phi_J, {'FCC' if dim == 3 else 'hexagonal'}, N = {n}"
        r.add("10", text, 1.0, power, cov[0, 0] ** 0.5)


def main():
    o = arguments(__doc__.splitlines()[0]).parse_args()
    r = Results(o, "near_crystals")
    one_kind(o, r, 3, 256 if o.large else 108, 60 if o.large else 6)
    one_kind(o, r, 2, 480 if o.large else 120, 60 if o.large else 6)
    r.write()


if __name__ == "__main__":
    main()
