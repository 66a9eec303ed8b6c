#!/usr/bin/env python3
"""Sheared packings of harmonic disks against published laws: shear modulus by pressure, plastic events by size.

usage: shear_events.py PICTURE.png
- Modulus: G grows as p^(alpha - 3/2), 1/2 for alpha = 2 (O'Hern et al., Phys. Rev. E 68, 011306 (2003)). Packings of 512
  disks are relaxed at the pressure p with all strains free, so that they are stable to shear.
- Events: in steady flow the mean strain between two events falls as N^(-2/3) (Karmakar, Lerner, Procaccia, Phys. Rev. E
  82, 055103 (2010), of other potentials). Here at phi = 0.9, by steps of 1e-3, from strain 0.1 to 0.2.
Half of the disks are 1.4 times as large. Minutes of one processor. Needs `jam`, numpy, matplotlib.
"""
import sys

import matplotlib.pyplot as plt
import numpy as np

import jam

PRESSURES = (1e-2, 3e-3, 1e-3, 3e-4)  # p N^2 > 70: smaller systems have a plateau below
SIZES = {32: 48, 64: 24, 128: 12, 256: 6}  # packings of each
FROM, TO = 0.1, 0.2


def start(n, seed):
    return jam.System.random(n=n, dim=2, diameters=[1.0, 1.4] * (n // 2), packing_fraction=0.9, overlap="allow", seed=seed)


def modulus(pressure, seed):
    """G sigma^2 / epsilon at this p sigma^2 / epsilon, the mean over simple shear and pure shear."""
    packing = start(512, seed)
    unit = float(np.mean(packing.diameters)) ** 2
    packing.relax(strain="all", pressure=pressure / unit)
    c = packing.elastic_tensor(stiffness="soft", prestress=1.0).relaxed
    pure = (c[0, 0, 0, 0] + c[1, 1, 1, 1] - c[0, 0, 1, 1] - c[1, 1, 0, 0]) / 4
    return unit * (c[0, 1, 0, 1] + pure) / 2


def events(n, seed):
    packing = start(n, seed)
    packing.relax()
    packing.shear(TO, step=1e-3)
    rows = packing.shear_rows
    return int(rows["event"][rows["strain"] > FROM].sum())


def fit(x, y, error):
    """Exponent of a power law, and its standard error."""
    coefficients, covariance = np.polyfit(np.log(x), np.log(y), 1, w=np.array(y) / np.array(error), cov="unscaled")
    return coefficients[0], np.sqrt(covariance[0, 0])


def spread(values):
    return float(np.mean(values)), float(np.std(values, ddof=1) / np.sqrt(len(values)))


def main(picture):
    figure, axes = plt.subplots(1, 2, figsize=(8.6, 3.4), constrained_layout=True)
    laws = []
    moduli = [spread([modulus(p, seed) for seed in range(1, 25)]) for p in PRESSURES]
    for p, (mean, error) in zip(PRESSURES, moduli):
        print(f"p {p:g}: G {mean:.5g} +- {error:.2g}", flush=True)
    laws.append(fit(PRESSURES, *zip(*moduli)))
    gaps = []
    for n, packings in SIZES.items():
        counts = [events(n, seed) for seed in range(1, packings + 1)]
        total = sum(counts)
        gaps.append(((TO - FROM) * packings / total, (TO - FROM) * packings / total**1.5))
        print(f"N {n}: {total} events of {packings} packings, strain between two {gaps[-1][0]:.5f} +- {gaps[-1][1]:.1g}", flush=True)
    laws.append(fit(list(SIZES), *zip(*gaps)))
    for axis, x, (y, error), law, published in (
        (axes[0], PRESSURES, zip(*moduli), laws[0], 0.5),
        (axes[1], list(SIZES), zip(*gaps), laws[1], -2 / 3),
    ):
        axis.errorbar(x, y, error, fmt="o", mfc="white", label=f"exponent {law[0]:.2f} ± {law[1]:.2f}")
        middle = len(x) // 2
        axis.plot(x, y[middle] * (np.array(x) / x[middle]) ** published, "k--", lw=1, label=f"published {published:.2f}")
        axis.set(xscale="log", yscale="log")
        axis.set_xticks(x, [f"{v:g}" for v in x])
        axis.minorticks_off()
        axis.legend(frameon=False, fontsize=8)
        print(f"exponent {law[0]:.3f} +- {law[1]:.3f}, published {published:.3f}")
    axes[0].set(xlabel=r"pressure $p \sigma^2 / \epsilon$", ylabel=r"shear modulus $G \sigma^2 / \epsilon$")
    axes[1].set(xlabel="N", ylabel="strain between two events")
    figure.savefig(picture, dpi=100)


if __name__ == "__main__":
    main(sys.argv[1])
