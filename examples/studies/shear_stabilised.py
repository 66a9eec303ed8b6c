#!/usr/bin/env python3
"""How often is a soft packing unstable to shear, at a fixed box and with free shear?

usage: shear_stabilised.py PICTURE.png [--large] [--packings M]
Dagois-Bohy et al., Phys. Rev. Lett. 109, 095703 (2012): packings made at a fixed box can have a negative shear modulus.
The fraction depends on p N^2 alone. It falls to 0 for large p N^2. With free shear there are none.
Each start is relaxed at pressure p twice: with the volume free, and with tilts and edges too. The least eigenvalue of the
relaxed elastic tensor over all traceless strains says whether a packing is stable. Its energy includes pre-stress.
Default: 32 spheres, under a minute. --large: three sizes. Needs `jam`, numpy, matplotlib.
"""
import argparse
import sys

import matplotlib.pyplot as plt
import numpy as np

import jam

START = {2: 0.90, 3: 0.70}  # packing fractions of the random points


def least_shear_modulus(packing, pressure):
    """Least second derivative of the enthalpy with a strain that keeps the volume, over the volume."""
    d = packing.dim
    c = np.asarray(packing.elastic_tensor(stiffness="soft", prestress=1.0).relaxed)
    basis = []
    for a in range(d):
        for b in range(a + 1, d):
            e = np.zeros((d, d))
            e[a, b] = e[b, a] = np.sqrt(0.5)
            basis.append(e)
    for a in range(1, d):
        e = np.diag([1.0] * a + [-float(a)] + [0.0] * (d - a - 1))
        basis.append(e / np.linalg.norm(e))
    # r -> exp(e) r keeps the volume. The second order of exp adds -p |e|^2, and |e| = 1.
    matrix = np.array([[np.einsum("ab,abcd,cd", e, c, f) for f in basis] for e in basis])
    return np.linalg.eigvalsh(matrix)[0] - pressure


def sample(d, n, seed, pressure, strain):
    sizes = [1.0, 1.4] * (n // 2) if d == 2 else None
    packing = jam.System.random(n=n, dim=d, seed=seed, packing_fraction=START[d], overlap="allow", diameters=sizes)
    # With this scale the stiffness of a contact is 1; the box has side 1. So pressures go with the diameter to 2 - d.
    pressure *= float(np.mean(packing.diameters)) ** (2 - d)
    try:
        report = packing.relax(strain=strain, pressure=pressure, scale="absolute", max_evaluations=50000)
    except jam.errors.OverlapError:  # the cell became narrower than a sphere
        return None
    if report.status != 0 or report.contacts == 0:
        return None
    return least_shear_modulus(packing, report.pressure)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("picture")
    parser.add_argument("--large", action="store_true")
    parser.add_argument("--packings", type=int, default=0)
    o = parser.parse_args()
    packings = o.packings or (400 if o.large else 20)
    figure, axes = plt.subplots(1, 2, figsize=(8.6, 3.6), constrained_layout=True, sharey=True)
    for d, axis in zip((2, 3), axes):
        sizes = ((16, 32, 64) if d == 2 else (32, 64, 128)) if o.large else (32,)
        for n, marker in zip(sizes, "osD"):
            for strain, colour in (("volume", "C0"), ("all", "C1")):
                x, y, error = [], [], []
                for scaled in 10.0 ** np.arange(-1.0, 3.1, 1.0):
                    moduli = [sample(d, n, seed, scaled / n**2, strain) for seed in range(1, packings + 1)]
                    found = np.array([m for m in moduli if m is not None])
                    if not len(found):
                        sys.exit(f"d {d} N {n} {strain} pN^2 {scaled:g}: none of {packings} packings has a minimum")
                    share = float(np.mean(found < 0.0))
                    x.append(scaled), y.append(share)
                    error.append(np.sqrt(max(share * (1 - share), 1.0 / len(found)) / len(found)))
                    print(
                        f"d {d} N {n} {strain:6s} pN^2 {scaled:8g}: {len(found)} packings, unstable {share:.3f}",
                        flush=True,
                    )
                label = f"N = {n}, " + ("volume free" if strain == "volume" else "shear free too")
                axis.errorbar(x, y, error, fmt=marker + "-", color=colour, ms=4, mfc="white", label=label)
        axis.set(xscale="log", xlabel="p N$^2$", title=f"d = {d}", ylim=(-0.05, 1.0))
        axis.legend(fontsize=7, frameon=False)
    axes[0].set_ylabel("share with a negative shear modulus")
    figure.savefig(o.picture, dpi=110)


if __name__ == "__main__":
    main()
