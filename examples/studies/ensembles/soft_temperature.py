#!/usr/bin/env python3
"""Pressure of soft spheres at finite temperature on both sides of jamming, on one curve: p = T^(-1/alpha) P(T^(-1/alpha) (phi - phi_J)).

usage: soft_temperature.py [--large] [--folder DIR] [--only-read] [--out DIR]

p is the virial pressure beta P / rho of Monte Carlo with the energy h^alpha of a relative overlap h, from the jammed packing with
diameters scaled to phi. x = T^(-1/alpha) (phi / phi_J - 1). Expected: P = 3 / |x| far below jamming (hard spheres) and x^(alpha - 1)
far above. Closer to jamming below, soft spheres act as hard ones of a smaller diameter (J. A. Barker and D. Henderson, J. Chem. Phys.
47, 4714 (1967)), here by T^(1/alpha) Gamma(1 + 1/alpha), which shifts x: P = 3 / (|x| + 3 Gamma(1 + 1/alpha)). The errors of the powers
contain packings, temperatures and the range of x. Small: N = 128, 4 packings, 3000 sweeps. Large: N = 1024, 20, 10000.
"""
from math import gamma

import matplotlib.pyplot as plt
import numpy as np
from common import Results, arguments, mean_error, seeded

import jam

ALPHAS = (1.5, 2.0, 2.5)
OVERLAPS = (1e-3, 3e-4, 1e-4)  # T^(1/alpha)
X = np.concatenate([-np.geomspace(300, 0.3, 10), [0.0], np.geomspace(0.3, 300, 10)])
NEAR = 0.031  # largest |phi / phi_J - 1|: beyond, the laws have corrections
RANGES = ((3.0, 300.0), (10.0, 300.0), (3.0, 100.0))  # of |x|, for powers


def pressures(n, seed, sweeps):
    """Mean p for each alpha, temperature and x, over the second half of a run."""
    with jam.System.random(n=n, seed=seed) as packing:
        packing.compress([(1e-2, 500.0), (3e-3, 1e7)])
        if not packing.crunch().jammed:
            return {"p": np.zeros(0)}
        instants = sweeps // 2 + np.arange(1, 41) * (sweeps // 80)  # the first half is left out
        p = np.full((len(ALPHAS), len(OVERLAPS), len(X)), np.nan)
        for a, alpha in enumerate(ALPHAS):
            for t, overlap in enumerate(OVERLAPS):
                how = {"alpha": alpha, "temperature": overlap**alpha, "energy_unit": "relative"}
                for k, x in enumerate(X):
                    if abs(x) * overlap > NEAR:
                        continue
                    with packing.copy() as soft:
                        soft.monte_carlo(sweeps=1, **{**how, "temperature": 1e-3 * how["temperature"]})
                        soft.scale_diameters((1 + x * overlap) ** (1 / 3))
                        runs = soft.isoconf(instants, monte_carlo=how, runs=1, block=1)
                        p[a, t, k] = runs.series["pressure"][0].mean()
        return {"p": p}


def power(p, side, low, high, shift):
    """Power of |x| + shift in p between two |x|, one value a packing."""
    use = (np.sign(X) == side) & (np.abs(X) >= low * 0.999) & (np.abs(X) <= high * 1.001) & np.isfinite(p[0])
    return [np.polyfit(np.log(np.abs(X[use]) + shift), np.log(one[use]), 1)[0] for one in p]


def laws(r, alpha, scaled):
    """Rows of one alpha: both powers, two temperatures on one curve."""
    shell = 3 * gamma(1 + 1 / alpha)
    for side, law, shift, text in (
        (-1, -1.0, 0.0, "power of |x| in P, below jamming"),
        (-1, -1.0, shell, "power of |x| + 3 Gamma(1 + 1/alpha) in P, below jamming"),
        (1, alpha - 1, 0.0, "power of x in P, above jamming"),
    ):
        found = [mean_error(power(scaled[:, t], side, *span, shift)) for t in range(len(OVERLAPS)) for span in RANGES]
        value, error = np.array(found).T
        r.add("1", f"alpha = {alpha:g}: {text}", law, value.mean(), np.hypot(error.mean(), value.std()))
    off = np.log(scaled[:, 0] / scaled[:, -1])[:, np.abs(X) <= 10]  # the same packings at two temperatures
    text = f"alpha = {alpha:g}: mean ln of P at T^(1/alpha) = {OVERLAPS[0]:g} over that at {OVERLAPS[-1]:g}, |x| <= 10"
    r.add("1", text, 0.0, *mean_error(off.mean(axis=1)))


def draw(axis, alpha, scaled):
    for t, overlap in enumerate(OVERLAPS):
        use = np.isfinite(scaled[0, t])
        mean, bar = scaled[:, t].mean(axis=0), scaled[:, t].std(axis=0, ddof=1) / len(scaled) ** 0.5
        axis.errorbar(X[use], mean[use], bar[use], fmt="osd"[t], ms=4, mfc="none", capsize=2, label=f"T^(1/alpha) = {overlap:g}")
    far = np.geomspace(1, 400, 40)
    axis.plot(-far[10:], 3 / far[10:], "k:", lw=1.2, label="3 / |x|")
    axis.plot(-far, 3 / (far + 3 * gamma(1 + 1 / alpha)), "k-", lw=0.8, label="3 / (|x| + 3 Gamma(1 + 1/alpha))")
    axis.plot(far[10:], scaled[:, -1, -1].mean() * (far[10:] / X[-1]) ** (alpha - 1), "k--", lw=1.2, label=f"slope {alpha - 1:g}")
    axis.set_xscale("symlog", linthresh=0.3)
    axis.set_xticks([-100, -10, -1, 0, 1, 10, 100])
    axis.set(yscale="log", xlabel="x = T^(-1/alpha) (phi / phi_J - 1)", title=f"alpha = {alpha:g}")
    axis.legend(fontsize=7)


def main():
    o = arguments(__doc__.splitlines()[0]).parse_args()
    n, seeds, sweeps = (1024, 20, 10000) if o.large else (128, 4, 3000)
    r = Results(o, "soft_temperature")
    name = f"soft_temperature_n{n}_{sweeps}"
    made = [m for m in seeded(o, name, "", seeds, lambda s: pressures(n, s, sweeps)) if m["p"].size]
    every = np.array([m["p"] for m in made])
    figure, axes = plt.subplots(1, 3, figsize=(15, 4.6), sharey=True)
    for a, (alpha, axis) in enumerate(zip(ALPHAS, axes)):
        scaled = every[:, a] * np.array(OVERLAPS)[:, None]  # packing, temperature, x
        laws(r, alpha, scaled)
        draw(axis, alpha, scaled)
    axes[0].set(ylabel="P = p T^(1/alpha)")
    r.write(figure)


if __name__ == "__main__":
    main()
