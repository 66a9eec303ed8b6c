#!/usr/bin/env python3
"""Near-crystals: FCC spheres and hexagonal disks with a small spread of diameters, section 10 of the studies.

usage: near_crystals.py [--large] [--folder DIR] [--only-read]

Log-normal diameters on the sites of the crystal. Spheres: packing fraction 0.7, growth at G = 1e-3 to p = 1e7, crunch. Disks lie
in the rectangle that fits their lattice, where there is no molecular dynamics: random displacements and a crunch. The thesis
gives no parameters. Known (G. Tsekenis, arXiv 2006.07373): phi_J falls linearly with the spread; the force exponent is
universal, those of gaps and localised forces are not. Packings that end without a verdict are counted. Small: 108 spheres, 120
disks, 6 packings a spread. Large: 256 spheres, 480 disks, 60.
"""
import matplotlib.pyplot as plt
import numpy as np
from common import THETA_E, Results, arguments, ensemble, kept, mean_error

import jam
from jam import scaling

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
        made = {
            "jammed": report.jammed,
            "status": report.stop_reason.name,
            "phi": report.packing_fraction,
            "excess": report.excess_contacts,
            "rattlers": report.rattlers,
            "order": np.mean(packing.bond_order(6, 1.2)),
        }
        if report.jammed:
            made["forces"], made["gaps"] = packing.forces, packing.call("gaps", 1.0, 1).gap
            made["local"] = local(packing.contacts.pairs, packing.coordination, 2)
        return made


def local(pairs, z, dim):
    """Contacts of spheres that have d + 1 of them: their forces are localised."""
    return (z[pairs] == dim + 1).any(axis=1)


def spheres(o, r, n, deviation, count):
    e = ensemble(o, protocol(n, deviation), count)
    made = []
    for entry in e:
        one = {
            "jammed": entry.row["jammed"],
            "status": str(entry.row["stop_reason"]),
            "rattlers": entry.row["rattlers"],
        }
        one.update(phi=entry.row["packing_fraction"], excess=entry.row["excess_contacts"])
        if one["jammed"]:
            f, gaps, order, pairs, z = entry.read("forces", "gaps", "bond_order", "pairs", "coordination")
            one.update(forces=f, gaps=gaps, order=np.mean(order), local=local(pairs, z, 3))
        made.append(one)
    if made:
        r.used(e, len(made))
    return made


def disks_of(o, r, n, deviation, count):
    make = [
        kept(o, f"hexagonal_n{n}", f"deviation{deviation:g}_seed{s}", lambda: disks(n, s, deviation))
        for s in range(1, count + 1)
    ]
    made = [m for m in make if m is not None]
    r.made(
        f"{n} disks, hexagonal, log-normal deviation {deviation:g}, random displacements of {KICK:g}, crunch", len(made)
    )
    return made


def law(r, text, values, low, high, published):
    try:
        found = scaling.fit_power(values, high, low)
        text = f"exponent of {text} on {low:.1e} ... {high:.1e}"
        r.add("10", text, f"{published}; not determined here", found.value, found.error)  # a few small packings
    except ValueError as problem:
        print(text, problem)


def one_kind(o, r, axes, dim, n, count):
    loss, order, mark = [], [], "o-" if dim == 3 else "s--"
    name = f"{'FCC' if dim == 3 else 'hexagonal'}, N = {n}"
    for k, deviation in enumerate(SPREADS):
        made = (spheres if dim == 3 else disks_of)(o, r, n, deviation, count)
        good = [m for m in made if m["jammed"]]
        label = f"{name}, spread {deviation:g}"
        if made:
            r.add("10", f"share without a verdict, {label}", "none", 1 - len(good) / len(made))
        if len(good) < 2:
            continue
        phi, q = mean_error([m["phi"] for m in good]), mean_error([m["order"] for m in good])
        loss.append((deviation, FULL[dim] - phi[0], phi[1])), order.append((deviation, *q))
        r.add("10", f"phi_J, {label}", "none", *phi)
        r.add("10", f"{ORDER[dim][0]}, {label}", "none", *q)
        r.add("10", f"excess contacts, largest, {label}", "0: isostatic", max(m["excess"] for m in good))
        r.add("10", f"share of rattlers, {label}", "none", *mean_error([m["rattlers"] / n for m in good]))
        gaps, forces = [m["gaps"] for m in good], [m["forces"] for m in good]
        for axis, values in ((axes[2], gaps), (axes[3], forces)):
            pool = np.sort(np.concatenate(values))
            axis.loglog(
                pool[pool > 0],
                (np.arange(1, len(pool) + 1) / len(pool))[pool > 0],
                mark[1:],
                color=f"C{k}",
                lw=1,
                label=label,
            )
        small = 0.03 * deviation, deviation  # forces below the spread are the small ones
        law(r, f"extended forces, {label}", [m["forces"][~m["local"].astype(bool)] for m in good], *small, THETA_E)
        few = [m["forces"][m["local"].astype(bool)] for m in good]
        if sum(map(len, few)) > 200:
            law(r, f"localised forces, {label}", few, *small, "not 0.175")
        law(r, f"gaps, {label}", gaps, 1e-3 * deviation, 0.3 * deviation, "not -0.41269")
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
