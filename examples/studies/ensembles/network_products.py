#!/usr/bin/env python3
"""Contact vectors and forces of each sphere: figures 3.1 and 3.3 of the thesis.

usage: network_products.py [--large] [--n N] [--count K] [--folder DIR] [--only-read] [--out DIR]

Packings as published: sequential LPs from random spheres at 0.2. Forces have mean 1 in each packing, rattlers are omitted.
Small: 10 packings of N = 128. Large: 20 of N = 1024.
"""
import matplotlib.pyplot as plt
import numpy as np
from common import Results, mean_error, options, seeded

import jam

TAIL = 0.25  # published: density of sum f.f ~ exp(TAIL x), x <= 0
CLASSES = (("all", "C0"), ("bucklers", "C1"), ("others", "C2"))


def products(n, seed):
    with jam.System.random(n=n, seed=seed, packing_fraction=0.2) as packing:
        report = packing.crunch(method="sequential_lp")
        if not report.jammed or report.excess_contacts:
            return {"good": False}
        plain, forces = packing.contact_dots(weighted=0), packing.contact_dots(weighted=1)
        z = packing.coordination
        return {
            "good": True,
            "dot": plain.dot,
            "force_dot": forces.dot,
            "buckler": z[plain.sphere] == packing.dim + 1,
            "S": packing.sphere_structure(weighted=0).s,
            "force_sum": packing.sphere_structure(weighted=1).s,
            "z": z,
            "phi": report.packing_fraction,
            "rattlers": report.rattlers / n,
            "positions": packing.positions,
            "diameter": packing.diameters.mean(),
            "pairs": packing.contacts.pairs,
            "vectors": packing.contacts.vectors,
        }


def draw(axis, values, buckler, bins):
    """Densities of all, of bucklers and of others; they add up."""
    middle = 0.5 * (bins[1:] + bins[:-1])
    for (name, colour), use in zip(CLASSES, (np.ones(len(values), bool), buckler, ~buckler)):
        count = np.histogram(values[use], bins)[0] / use.sum() / np.diff(bins)
        axis.step(middle, np.where(count > 0, count, np.nan), where="mid", lw=1, color=colour, label=name)


def figure_of_products(r, made):
    join = lambda name: np.concatenate([m[name] for m in made])  # noqa: E731
    buckler, z = join("buckler").astype(bool), join("z")
    stable = z > 0
    s, force_sum, z = join("S")[stable], join("force_sum")[stable], z[stable]
    figure, axes = plt.subplots(2, 2, figsize=(11, 8.4))
    draw(axes[0, 0], join("dot"), buckler, np.linspace(-1, 0.55, 63))
    axes[0, 0].set(xlabel="n_ij . n_ik", ylabel="pdf")
    draw(axes[0, 1], join("force_dot"), buckler, np.linspace(-8, 4, 97))
    axes[0, 1].set(xlabel="f_ij . f_ik, mean force 1", ylabel="pdf", yscale="log")
    draw(axes[1, 0], s, z == 4, np.arange(-5.5, 0.01, 0.1))
    for k in range(4, 12):
        axes[1, 0].axvline(-0.5 * k, color="0.85", lw=0.8, zorder=0)
    axes[1, 0].set(xlabel="S_i; grey: -z/2", ylabel="pdf")
    draw(axes[1, 1], force_sum, z == 4, np.arange(-30, 0.01, 0.75))
    x = np.linspace(-30, 0, 50)
    axes[1, 1].plot(x, 0.25 * np.exp(TAIL * x), "k--", lw=1, label=f"exp({TAIL} x)")
    axes[1, 1].set(xlabel="sum_jk f_ij . f_ik = -sum_j f_ij^2 / 2", ylabel="pdf", yscale="log", ylim=(1e-5, 1))
    inset = axes[1, 1].inset_axes([0.1, 0.62, 0.35, 0.33])
    values, count = np.unique(z, return_counts=True)
    inset.semilogy(values, count / count.sum(), "o-", ms=3)
    inset.set_xlabel("z", fontsize=7)
    inset.tick_params(labelsize=6)
    for place, axis in np.ndenumerate(axes):
        axis.legend(fontsize=8, loc={(0, 1): "upper left", (1, 1): "lower right"}.get(place, "best"))
    r.picture(figure, "network_products")
    bins = np.linspace(-1, 0.55, 63)
    height = np.histogram(join("dot"), bins)[0]
    r.add("3.3", "n.n where its density is largest", ("touching triple", 0.5), 0.5 * (bins[1:] + bins[:-1])[np.argmax(height)])
    bins = np.linspace(-8, 4, 97)
    r.add("3.3", "f.f where its density is largest", ("sharp peak", 0.0), 0.5 * (bins[1:] + bins[:-1])[np.argmax(np.histogram(join("force_dot"), bins)[0])])
    cuts = np.arange(-16, -3.9, 1.0)

    def tail(few):
        pool = np.concatenate([m["force_sum"][m["z"] > 0] for m in few])
        share = np.array([np.mean(pool < c) for c in cuts])
        return np.polyfit(cuts, np.log(np.maximum(share, 0.5 / len(pool))), 1)[0]

    rng = np.random.default_rng(1)
    error = np.std([tail([made[i] for i in rng.integers(len(made), size=len(made))]) for _ in range(60)], ddof=1)
    r.add("3.3", "slope of the logarithm of the cdf of sum f.f on -16 to -4", TAIL, tail(made), error)
    r.add("3.3", "least S + z / 2", ">= 0", min((m["S"] + 0.5 * m["z"])[m["z"] > 0].min() for m in made))


def figure_of_packing(r, m):
    """3.1: spheres coloured by S_i, and one of them with its contact vectors."""
    figure = plt.figure(figsize=(11.5, 5.6))
    axis = figure.add_subplot(1, 2, 1)
    x, sigma, s = m["positions"] % 1.0, float(m["diameter"]), m["S"]
    order = np.argsort(x[:, 2])  # far ones first: seen along z
    for i in order:
        for shift in np.array([[a, b] for a in (-1, 0, 1) for b in (-1, 0, 1)]):
            axis.add_patch(plt.Circle(x[i, :2] + shift, 0.5 * sigma, fc=plt.cm.viridis(-s[i] / 4), ec="k", lw=0.3))
    axis.set(xlim=(0, 1), ylim=(0, 1), aspect="equal", xlabel="x / L", ylabel="y / L", title=f"N = {len(x)}, phi_J = {float(m['phi']):.4f}, seen along z")
    figure.colorbar(plt.cm.ScalarMappable(plt.Normalize(-4, 0), "viridis_r"), ax=axis, label="S_i; 0: rattlers")
    zoom = figure.add_subplot(1, 2, 2, projection="3d")
    i = int(np.flatnonzero(m["z"] == 6)[0])
    ends, n = m["pairs"], m["vectors"]
    own = np.concatenate([n[ends[:, 0] == i], -n[ends[:, 1] == i]])  # n_ij points from j to i
    total = own.sum(axis=0)
    for v in own:
        zoom.quiver(*-v, *v, color="C0", lw=1.5, arrow_length_ratio=0.15)
    zoom.quiver(0, 0, 0, *total, color="C3", lw=2.5, arrow_length_ratio=0.2)
    zoom.set(xlim=(-1, 1), ylim=(-1, 1), zlim=(-1, 1), title=f"n_ij of sphere {i} (blue), C_i (red): S_i = {s[i]:.2f}")
    r.picture(figure, "network_products_packing")


def main():
    o = options(__doc__.splitlines()[0], n=(128, 1024), count=(10, 20))
    n, count = o.n, o.count
    r = Results(o, "network_products")
    made = [m for m in seeded(o, f"network_products_n{n}", "", count, lambda s: products(n, s)) if m["good"]]
    for name, text, known in (("phi", "phi_J", 0.635), ("rattlers", "share of rattlers", 0.013)):
        mean, error = mean_error([float(m[name]) for m in made])
        single = error * (len(made) + 1) ** 0.5  # of the mean less one packing, which is what the thesis has
        r.add("3.1", f"{text}, N = {n}; error: of it less one packing", known if n == 1024 else f"{known} at N = 1024", mean, single)
    figure_of_products(r, made)
    figure_of_packing(r, made[0])
    r.write()


if __name__ == "__main__":
    main()
