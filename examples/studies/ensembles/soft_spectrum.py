#!/usr/bin/env python3
"""End of the plateau of D(omega) against the distance above jamming: omega* ~ distance^(1/2), D ~ (omega / omega*)^2 below.

usage: soft_spectrum.py [--large] [--n N] [--seeds K] [--folder DIR] [--only-read] [--out DIR]

Harmonic soft spheres from random points at 0.72 are decompressed in steps. At each distance x = ln(R / R_J) all modes are computed
without and with pre-stress; omega is in units of the root of the stiffness over the mass. omega* is where the share of modes below
omega is a part LEVELS of that of the same packing nearest to jamming, whose D(omega) is a plateau down to its lowest modes.
The error of its power contains the packings, the level, the range of x and a correction. Small: N = 256, 6 packings. Large: N = 1024, 20.
"""
import matplotlib.pyplot as plt
import numpy as np
from common import Results, mean_error, options, seeded

import jam

LEVELS = (0.25, 0.5, 0.75)
LEAST_MODES = 15  # modes below omega*: with fewer the finite size shows
SPANS = ((1e-4, 5e-3), (1e-3, 3e-2), (1e-4, 3e-2))
WINDOWS = ((0.15, 0.5), (0.2, 0.6), (0.3, 0.7))  # of omega over omega*, for the power of D with pre-stress
KINDS = (("without pre-stress", 0.0), ("with pre-stress", 1.0))


def spectra(n, seed, smallest):
    """Distances, and omega of all modes but the translations: without and with pre-stress."""
    with jam.System.random(n=n, seed=seed, packing_fraction=0.72, overlap="allow") as packing:
        x, found = [], {text: [] for text, _ in KINDS}
        for target in 10.0 ** np.arange(-1.5, np.log10(smallest) - 1e-9, -0.25):
            down = packing.decompress(distance=target, energy_factor=0.3, isostatic=0, crunch=0)
            if down.status != 0:
                break
            if x and down.steps == 0:
                continue
            x.append(down.distance)
            for text, prestress in KINDS:
                values = packing.modes(which="all", stiffness="soft", prestress=prestress).values
                if prestress == 0.0:  # trace of the Hessian: 2 contacts times the stiffness
                    unit = np.sqrt(values.sum() / (2 * down.contacts))
                found[text].append(np.sign(values) * np.sqrt(np.abs(values)) / unit)
        width = min(len(v) for v in found[KINDS[0][0]])
        return {"x": np.array(x), **{text: np.array([np.sort(v)[3:width] for v in found[text]]) for text, _ in KINDS}}


def crossing(omega, plateau, level):
    """omega where the number of modes below falls to `level` times that of the packing at jamming; nan with few modes."""
    count = np.arange(1, len(omega) + 1)
    below = count / np.maximum(np.searchsorted(plateau, omega), 1)
    use = np.flatnonzero(below < level)
    use = use[use < len(omega) // 2]  # the upper edge of the spectrum is something else
    return omega[use[-1]] if len(use) and use[-1] >= LEAST_MODES else np.nan


def powers(made, text):
    """(power, error over packings) of omega* against x for each level, range and model: A x^a, on the widest range A x^a exp(b sqrt(x)),
    whose factor is the leading correction of the number of contacts (soft_scaling_laws.py)."""
    found = []
    for level in LEVELS:
        for span, corrected in [(s, False) for s in SPANS] + [(SPANS[-1], True)]:
            slopes = []
            for m in made:
                star = np.array([crossing(w, m[KINDS[0][0]][-1], level) for w in m[text][:-1]])
                x = m["x"][:-1]
                use = np.isfinite(star) & (x > span[0]) & (x < span[1])
                terms = np.transpose([np.ones(use.sum()), np.log(x[use])] + ([np.sqrt(x[use])] if corrected else []))
                if len(terms) > terms.shape[1]:
                    slopes.append(np.linalg.lstsq(terms, np.log(star[use]), rcond=None)[0][1])
            if len(slopes) > 2:
                found.append(mean_error(slopes))
    return found


def low_power(made, low, high):
    """Power of omega in D between low and high times omega*, with pre-stress: counts of all packings, error over packings."""
    counts = []
    for m in made:
        few = many = 0
        for w, x in zip(m[KINDS[1][0]][:-1], m["x"][:-1]):
            star = crossing(w, m[KINDS[0][0]][-1], 0.5)
            if x < 3e-2 and np.isfinite(star):
                few, many = few + np.sum((w > 0) & (w < low * star)), many + np.sum((w > 0) & (w < high * star))
        counts.append((few, many))
    few, many = np.array(counts, float).T
    if few.sum() == 0:
        return np.nan, np.nan
    error = mean_error(many / many.mean() - few / few.mean())[1] / np.log(high / low)
    return np.log(many.sum() / few.sum()) / np.log(high / low) - 1, error


def draw(made, axes):
    for axis, (text, _) in zip(axes, KINDS):
        mean = made[0]
        for k in range(0, len(mean["x"]), 2):
            pool = np.sort(np.concatenate([m[text][k] for m in made if len(m["x"]) > k]))
            share = np.arange(1, len(pool) + 1) / len(pool)
            axis.loglog(pool[pool > 0], share[pool > 0], lw=1, color=plt.cm.viridis(k / len(mean["x"])), label=f"x = {mean['x'][k]:.1e}")
        axis.set(xlabel="omega", ylabel=f"share of modes below omega, {text}", xlim=(3e-3, 3), ylim=(1e-3, 1.1))
        axis.legend(fontsize=6)
    for k, level in enumerate(LEVELS):
        for m in made:
            star = np.array([crossing(w, m[KINDS[0][0]][-1], level) for w in m[KINDS[0][0]][:-1]])
            axes[2].loglog(m["x"][:-1], star, ".", ms=4, color=f"C{k}", label=f"level {level}" if m is made[0] else None)
    x = np.array([3e-5, 3e-2])
    axes[2].loglog(x, 1.5 * x**0.5, "k:", label="slope 1/2")
    axes[2].set(xlabel="x = ln(R / R_J)", ylabel="omega*, without pre-stress")
    axes[2].legend(fontsize=7)


def main():
    o = options(__doc__.splitlines()[0], n=(256, 1024), seeds=(6, 20))
    n, seeds, smallest = o.n, o.seeds, 1e-6
    r = Results(o, "soft_spectrum")
    made = [m for m in seeded(o, f"soft_spectrum_n{n}", "", seeds, lambda s: spectra(n, s, smallest)) if len(m["x"]) > 8]
    for text, _ in KINDS:
        found = powers(made, text)
        if not found:
            continue
        value, error = np.array(found).T
        r.add("1", f"power of the distance in omega_s, end of the plateau, {text}", 0.5, value.mean(), np.hypot(error.mean(), value.std()))
    value, error = np.array([low_power(made, *span) for span in WINDOWS]).T
    r.add("1", "power of omega in D below omega_s, with pre-stress", 2.0, value.mean(), np.hypot(error.mean(), value.std()))
    figure, axes = plt.subplots(1, 3, figsize=(15, 4.6))
    draw(made, axes)
    r.write(figure)


if __name__ == "__main__":
    main()
