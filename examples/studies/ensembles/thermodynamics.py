#!/usr/bin/env python3
"""The crystal of hard spheres, its coexistence with the liquid, and the entropy near jamming: chapter 1 of the thesis.

usage: thermodynamics.py [--large] [--folder DIR] [--only-read] [--out DIR]

Crystal: p of FCC spheres by dynamics against K. R. Hall's equation (J. Chem. Phys. 57, 2252 (1972)). Coexistence: the densities of liquid
(Carnahan and Starling) and crystal (Hall) that have one pressure and one chemical potential. Jamming: s = -integral of p dphi / phi
along slow growth, so s = d ln(1 - phi / phi_J) + a constant where p = d / (1 - phi / phi_J). Small: 108 and 256 spheres. Large: 864, 1024.
"""
import numpy as np
from common import Results, arguments, kept, mean_error, seeded
from scipy.optimize import fsolve

import jam

CLOSE = np.pi / 18**0.5
FREEZING, MELTING = 0.494, 0.545
CRYSTAL_ENERGY = 4.9589  # free energy a sphere over kT at 0.545, thermal length sigma: J. M. Polson et al., J. Chem. Phys. 112, 5339 (2000)
HALL = (2.557696, 0.1253077, 0.1762393, -1.053308, 2.818621, -2.921934, 1.118413)  # powers of b = 4 (1 - phi / CLOSE)


def fcc(cells, phi, ratio, seed):
    """4 cells^3 spheres on FCC sites in a cubic box."""
    corner = np.indices((cells,) * 3).reshape(3, -1).T
    sites = np.concatenate([corner + np.array(s) for s in ((0, 0, 0), (0, 0.5, 0.5), (0.5, 0, 0.5), (0.5, 0.5, 0))])
    ratio = ratio * (phi / (np.pi / 6 * np.sum(np.broadcast_to(ratio, len(sites)) ** 3))) ** (1 / 3)
    return jam.System.from_arrays((sites + 0.25) / cells, np.broadcast_to(ratio, len(sites)).copy(), seed=seed, overlap="shrink")


def hall(phi):
    b = 4 * (1 - phi / CLOSE)
    return 12 / b - 3 + sum(c * b**k for k, c in enumerate(HALL))


def carnahan_starling(phi):
    return (1 + phi + phi**2 - phi**3) / (1 - phi) ** 3


def densities():
    """Packing fractions of liquid and crystal that have one pressure and one chemical potential, in units of kT and sigma."""

    def between(x):
        liquid, solid = x
        grid = np.linspace(MELTING, solid, 200)
        y = (hall(grid) - 1) / grid
        excess = CRYSTAL_ENERGY + 1 - np.log(6 / np.pi * MELTING) + np.sum(0.5 * (y[1:] + y[:-1]) * np.diff(grid))
        below = liquid * (4 - 3 * liquid) / (1 - liquid) ** 2
        mu = [a + p(phi) + np.log(phi) for a, p, phi in ((below, carnahan_starling, liquid), (excess, hall, solid))]
        return liquid * carnahan_starling(liquid) - solid * hall(solid), mu[0] - mu[1]

    return fsolve(between, (FREEZING, MELTING))


def crystal(cells, phi, seed, collisions):
    with fcc(cells, phi, 1.0, seed) as packing:
        packing.run(0.2 * collisions)
        return {"p": [packing.run(collisions / 5).pressure for _ in range(5)]}


def coexistence(o, r, cells, collisions):
    fractions = np.array([0.53, MELTING, 0.57, 0.60, 0.64, 0.68, 0.72])
    made = [kept(o, "thermodynamics", f"fcc{cells}_phi{x:g}", lambda: crystal(cells, x, 1, collisions)) for x in fractions]
    if None in made:
        return
    n = 4 * cells**3
    p, error = np.array([mean_error(m["p"]) for m in made]).T * n / (n - 1)  # total momentum 0: 3 (N - 1) freedoms
    for x, value, e in zip(fractions, p, error):
        r.add("crystal", f"p of the crystal, phi = {x:g}", ("Hall", round(hall(x), 4)), value, e)
    cubed = 6 / np.pi  # P sigma^3 = 6 phi p / pi
    solid = cubed * MELTING * np.array([p[1], error[1]])
    r.add("crystal", "P sigma^3 of the crystal at 0.545", f"liquid at 0.494: {cubed * FREEZING * carnahan_starling(FREEZING):.4g}", *solid)
    for name, value, known in zip(("liquid", "crystal"), densities(), (FREEZING, MELTING)):
        r.add("crystal", f"density of the {name} in coexistence", known, value)


def path(n, seed):
    p, phi = [], []
    with jam.System.random(n, seed=seed) as packing:
        packing.compress([(1e-2, 500.0)])
        for target in 10 ** np.arange(2.8, 6.01, 0.1):
            md = packing.compress([(1e-3, float(target))])
            p.append(md.pressure), phi.append(md.packing_fraction)
        return {"p": p, "phi": phi, "phi_j": packing.crunch().packing_fraction}


def entropy(o, r, n, seeds):
    made = seeded(o, "thermodynamics", f"path_n{n}_", seeds, lambda s: path(n, s))
    slopes = []
    for m in made:
        x = np.log(1 - m["phi"] / m["phi_j"])
        # p dphi / phi = -p (1 - phi/phi_J) / (phi/phi_J) dx: smooth in x
        smooth = m["p"] * -np.expm1(x) ** -1 * np.exp(x)
        s = np.concatenate([[0], np.cumsum(0.5 * (smooth[1:] + smooth[:-1]) * np.diff(x))])
        slopes.append(np.polyfit(x, s, 1)[0])
    if len(slopes) > 1:
        r.add("entropy", f"slope of the entropy a sphere against ln(1 - phi / phi_J), N = {n}, p = 600 to 1e6", 3, *mean_error(slopes))


def main():
    o = arguments(__doc__.splitlines()[0]).parse_args()
    r = Results(o, "thermodynamics")
    coexistence(o, r, 6 if o.large else 3, 2000.0 if o.large else 300.0)
    entropy(o, r, 1024 if o.large else 256, 5 if o.large else 2)
    r.write()


if __name__ == "__main__":
    main()
