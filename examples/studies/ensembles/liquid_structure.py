#!/usr/bin/env python3
"""Structure factor, direct correlation and compressibility of the hard-sphere liquid against equations of state.

usage: liquid_structure.py [--large] [--folder DIR] [--only-read] [--out DIR]

S(q) of snapshots in equilibrium gives rho c(q) = 1 - 1/S(q) (Ornstein and Zernike) and, for q -> 0, kT (d rho / d P) = S(0). The
limit is that of 1/S = a + b q^2 + ... with two to four terms up to all q below QLAST, averaged with weights exp(-AIC/2) as in
tail_exponents.py. On synthetic S(q) of Percus and Yevick with the noise of small runs it has a bias below 1 %, half of its error;
with two and three terms alone it is 2 % too low. Beside it: c(q) of Percus and Yevick (M. S. Wertheim, Phys. Rev. Lett. 10, 321
(1963)) and 1 / (d (phi p) / d phi) of the equations of state of Carnahan and Starling (d = 3) and Henderson (d = 2). Small:
N = 500, 60 snapshots of each of three runs. Large: N = 4000, 100 of ten.
"""
import numpy as np
from common import Results, arguments, seeded

import jam

STATES = ((3, 0.20), (3, 0.35), (3, 0.45), (2, 0.30), (2, 0.50))
FORM = {2: "henderson", 3: "carnahan_starling"}
QMAX, QLAST = 12.0, 4.5  # in 1/diameter: of S(q), and of the fits towards q = 0
TERMS = (2, 3, 4)  # powers of q^2 in 1/S
WAIT, APART = 200.0, 5.0  # collisions of a sphere before the first snapshot and between two


def liquid(dim, phi, n, seed, snapshots):
    """q in 1/diameter, the mean S(q) over snapshots, and the pressure."""
    with jam.System.random(n=n, dim=dim, seed=seed, packing_fraction=min(phi, 0.3 if dim == 3 else 0.4)) as spheres:
        if spheres.packing_fraction < phi - 1e-9:
            spheres.compress([{"growth_rate": 0.01, "packing_fraction": phi}])
        spheres.run(WAIT)
        total, pressures = 0.0, []
        for _ in range(snapshots):
            pressures.append(spheres.run(APART).pressure)
            found = spheres.structure_factor(QMAX)
            total = total + found.s
        return {"q": found.q, "s": total / snapshots, "phi": spheres.packing_fraction, "p": np.mean(pressures)}


def percus_yevick(q, phi):
    """rho c(q) of hard spheres in d = 3, q in 1/diameter, by Simpson's rule over c(r) inside the diameter."""
    l1, l2 = (1 + 2 * phi) ** 2 / (1 - phi) ** 4, -((1 + phi / 2) ** 2) / (1 - phi) ** 4
    r = np.linspace(0.0, 1.0, 2001)
    c = -(l1 + 6 * phi * l2 * r + phi / 2 * l1 * r**3)
    weight = np.where(np.arange(len(r)) % 2, 4.0, 2.0)
    weight[[0, -1]] = 1.0
    kernel = np.sinc(q[:, None] * r / np.pi) * r**2
    return 24 * phi * (kernel * c * weight).sum(axis=1) * (r[1] - r[0]) / 3


def inverse_compressibility(dim, phi):
    """d (phi p) / d phi of the equation of state."""
    step = 1e-4
    above, below = (jam.eos(FORM[dim], dim, phi + s, 0.0) * (phi + s) for s in (step, -step))
    return (above - below) / (2 * step)


def multiplicity(q, dim):
    """Wave vectors of each length in a cubic cell; q[0] is the shortest one."""
    square = np.rint((q / q[0]) ** 2).astype(int)
    edge = int(square[-1] ** 0.5) + 1
    axes = np.meshgrid(*[np.arange(-edge, edge + 1) ** 2] * dim, sparse=True)
    return np.bincount(sum(axes).ravel(), minlength=square[-1] + 1)[square]


def limit(q, s, relative):
    """a of 1/S = a + b q^2 + ... up to each end, averaged by AIC, and its error, which contains the choice.

    The error of S is `relative` times the fitted S, by iteration: with the measured S lengths that are low by chance would weigh less.
    """
    found = []
    for terms in TERMS:
        for last in range(terms + 2, int(np.sum(q < QLAST)) + 1):
            x = np.stack([q[:last] ** (2 * k) for k in range(terms)], axis=1)
            fitted = np.full(last, 1 / s[:last].mean())
            for _ in range(20):
                error = relative[:last] * fitted
                normal = np.linalg.inv((x / error[:, None] ** 2).T @ x)
                beta = normal @ (x / error[:, None] ** 2).T @ (fitted * (2 - s[:last] * fitted))
                fitted = np.maximum(x @ beta, 0.3 * fitted)
            chi2 = np.sum(((s[:last] * fitted - 1) / relative[:last]) ** 2)
            found.append((chi2 + 2 * terms - 2 * last, beta[0], normal[0, 0]))
    aic, a, variance = np.array(found).T
    weight = np.exp(-0.5 * (aic - aic.min()))
    weight /= weight.sum()
    mean = weight @ a
    choice = np.sqrt(weight @ (a - mean) ** 2)
    return mean, np.hypot(np.sqrt(weight @ variance), choice)


def main():
    o = arguments(__doc__.splitlines()[0]).parse_args()
    n, runs, snapshots = (4000, 10, 100) if o.large else (500, 3, 60)
    r = Results(o, "liquid_structure")
    for dim, phi in STATES:
        name = f"liquid_structure_n{n}"
        made = seeded(o, name, f"d{dim}_phi{phi}_", runs, lambda s: liquid(dim, phi, n, s, snapshots))
        if len(made) < 2:
            continue
        q, every = made[0]["q"], np.array([m["s"] for m in made])
        s = every.mean(axis=0)
        m = multiplicity(q, dim)
        noise = np.mean(m * every.var(axis=0, ddof=1) / s**2)  # of one wave vector in one run
        a, a_error = limit(q, s, np.sqrt(noise / (m * len(made))))
        law = inverse_compressibility(dim, phi)
        which = {3: "Carnahan-Starling", 2: "Henderson"}[dim]
        r.add("1", f"d = {dim}, phi = {phi}: 1/S(0) = d (phi p)/d phi", (which, round(law, 4)), a, a_error)
        if dim == 3:
            theory = percus_yevick(q, phi)
            off = np.sqrt(np.mean((1 - 1 / s - theory) ** 2)) / np.abs(theory).max()
            r.add("1", f"d = 3, phi = {phi}: rms of rho c(q) less Percus-Yevick over its largest value", "small", off)
    r.write()


if __name__ == "__main__":
    main()
