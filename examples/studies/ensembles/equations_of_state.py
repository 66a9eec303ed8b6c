#!/usr/bin/env python3
"""Pressure against packing fraction while diameters grow: figures 1.14, 1.15 and 2.5.

usage: equations_of_state.py [--large] [--folder DIR] [--only-read]

Spheres: growth at one rate from 0.2 to p = 1e4 beside Carnahan-Starling and the free-volume line d / (1 - phi / phi_J); the
two-stage protocol with phi_J from its crunch. Mari-Kurchan spheres: the exact liquid 1 + 4 phi, planted at each density, and
growth from 0.3 (not planted beyond) and from 2.5. Rates G are of the diameter; kappa = G / (2 sqrt 3) is that of the thesis.
Small: N = 256, two seeds. Large: N = 1024, five seeds, slower rates. Each run is kept when done.
"""
import matplotlib.pyplot as plt
import numpy as np
from common import Results, arguments, mean_error, seeded

import jam

LEAVES = 0.1  # a curve has left the liquid where p is so much above it, relatively
PHI_D = 1.776  # dynamical transition of Mari-Kurchan spheres, d = 3


def liquid(phi):
    return jam.eos("carnahan_starling", 3, phi, 0.64)


def curve(series):
    """Means of p over windows: 2 % of density while p < 100, then a factor 1.5 of p. Samples last equally many collisions, so
    each counts by its time."""
    phi, p, time = series["fraction"], series["pressure"], np.diff(series["time"], prepend=0.0)
    use = np.isfinite(p) & (time > 0)
    phi, p, time = phi[use], p[use], time[use]
    late = np.argmax(p > 100) if (p > 100).any() else len(p)
    window = np.concatenate([np.floor(np.log(phi[:late]) / 0.02), 1e6 + np.floor(np.log(p[late:]) / np.log(1.5))])
    found = [[np.average(x[window == w], weights=time[window == w]) for x in (phi, p)] for w in np.unique(window)]
    return np.array(found).T


def grown(n, seed, rates, **start):
    """(phi, p) of growth: rates is a list of (G, p at its end); then phi_J of the crunch."""
    with jam.System.random(n, seed=seed, **start) as packing:
        with packing.observing(sample_every=1) as seen:
            packing.compress(rates)
            phi, p = curve(seen.series)
        score = packing.crystal_score() if "model" not in start else 0.0
        jammed = packing.crunch()
        found = jammed.packing_fraction if jammed.jammed else np.nan
    return {"phi": phi, "p": p, "phi_j": found, "score": score}


def planted(n, seed, phi, collisions):
    with jam.System.random(n, seed=seed, model="mk", packing_fraction=phi) as fluid:
        report = fluid.run(collisions)
    return {"p": report.pressure, "error": report.pressure_error}


def leaves(run, line):
    """Packing fraction where p stays LEAVES above the line from there on; nan if it never does."""
    above = run["p"] > (1 + LEAVES) * line(run["phi"])
    last = np.flatnonzero(~above)
    return run["phi"][last[-1]] if len(last) and last[-1] + 1 < len(above) else run["phi"][0] if above.all() else np.nan


def spheres(o, r, axes, n, seeds):
    rates = (1.0, 1e-1, 1e-2, 1e-3, 1e-4) if o.large else (1.0, 1e-1, 1e-2, 1e-3)
    cs = np.vectorize(liquid)
    for rate in rates:
        runs = seeded(o, f"eos_n{n}", f"rate{rate:g}_", seeds, lambda s: grown(n, s, [(rate, 1e4)]))
        if not runs:
            continue
        for k, run in enumerate(runs):
            colour = f"C{rates.index(rate)}"
            axes[0].semilogy(
                run["phi"], 1 / run["p"], "-", lw=1, color=colour, label=f"G = {rate:g}" if k == 0 else None
            )
            low = run["phi"] < 0.56
            axes[1].plot(run["phi"][low], (cs(run["phi"]) - run["p"])[low], lw=1, color=colour)
        left = [leaves(run, cs) for run in runs]
        known = "fast: at once" if rate == rates[0] else "none"
        r.add("8", f"G = {rate:g}: phi where p leaves Carnahan-Starling by 10 %", known, np.mean(left), spread(left))
        r.add(
            "8",
            f"G = {rate:g}: crystal score at the end",
            "slow: orders" if rate < 1e-2 else "none",
            np.mean([run["score"] for run in runs]),
        )
    phi = np.linspace(0.2, 0.64, 100)
    axes[0].semilogy(phi, 1 / cs(phi), "k--", lw=1, label="Carnahan-Starling")
    axes[0].semilogy(phi, (1 - phi / 0.644) / 3, "k:", lw=1, label="free volume, phi_J = 0.644")
    axes[0].axvline(0.545, color="0.7", lw=1)
    axes[0].set(xlabel="phi", ylabel="1 / p", ylim=(1e-4, 0.5), title="growth at one rate")
    axes[1].set(xlabel="phi", ylabel="p_CS - p", ylim=(-6, 6), title="vertical line: melting, 0.545")
    axes[1].axvline(0.545, color="0.7", lw=1)
    axes[0].legend(fontsize=7)


def spread(values):
    return mean_error(values)[1] if len(values) > 1 else np.nan


def two_stages(o, r, axis, n, seeds):
    rates = [(1.732e-2, 500.0), (1.04e-3, 1e9)]
    make = seeded(o, f"eos_n{n}", "two_stages_", seeds, lambda s: grown(n, s, rates))
    runs = [m for m in make if np.isfinite(m["phi_j"]) and m["score"] < 1.5]
    if not runs:
        return
    ratio = []
    for run in runs:
        x = 1 - run["phi"] / run["phi_j"]
        axis.loglog(x[x > 0], 1 / run["p"][x > 0], ".-", ms=3, lw=0.6)
        use = (run["p"] > 1e4) & (run["p"] < 1e6)
        ratio.append(np.mean(run["p"][use] * x[use]) / 3)
    x = np.geomspace(1e-9, 0.5, 2)
    axis.loglog(x, x / 3, "k--", lw=1, label="1/p = (1 - phi/phi_J) / d")
    axis.set(xlabel="1 - phi / phi_J, phi_J of the crunch", ylabel="1 / p", title="two stages")
    axis.legend(fontsize=7)
    r.add("8", "two stages: p (1 - phi/phi_J) / d, p = 1e4 to 1e6", "1 to 1.07", np.mean(ratio), spread(ratio))


def exact(phi, n):
    """Pressure of the planted liquid: 1 + 4 phi for large N. A pair is uniform outside the core, so g is 1 / (1 - core)."""
    return 1 + 4 * phi * (1 - 1 / n) / (1 - 8 * phi / n)


def mari_kurchan(o, r, axis, n, seeds):
    densities = (0.3, 0.6, 0.9, 1.2, 1.5, 1.776, 2.1, 2.5)
    means = []
    for k, phi in enumerate(densities):
        runs = seeded(o, f"eos_mk_n{n}", f"planted{phi:g}_", 20, lambda s: planted(n, 100 * k + s, phi, 200))  # other seeds at each density
        p = np.array([float(m["p"]) for m in runs])
        if len(p) < 2:
            continue
        mean, error = mean_error(p)
        means.append((phi, mean, p.std(ddof=1)))
        text = f"Mari-Kurchan liquid planted at {phi:g}, 20 runs: p; 1 + 4 phi = {1 + 4 * phi:g}, at this N"
        r.add("8", text, ("exact", round(exact(phi, n), 4)), mean, error)
    if means:
        x, y, e = np.array(means).T
        axis.errorbar(x, 1 / y, e / y**2, fmt="ko", ms=4, label="planted, no growth")
    line = np.linspace(0.2, 2.8, 100)
    axis.semilogy(line, 1 / (1 + 4 * line), "k--", lw=1, label="1 + 4 phi")
    rates = (1e-1, 1e-2, 1e-3, 3.46e-4) if o.large else (1e-1, 1e-2, 1e-3)
    for start, text in ((0.3, "from 0.3"), (2.5, "planted at 2.5")):
        for k, rate in enumerate(rates):
            how = dict(model="mk", packing_fraction=start)
            runs = seeded(o, f"eos_mk_n{n}", f"from{start:g}_rate{rate:g}_", seeds, lambda s: grown(n, s, [(rate, 1e4)], **how))
            if not runs:
                continue
            for run in runs:
                label = f"{text}, G = {rate:g}" if run is runs[0] else None
                axis.semilogy(run["phi"], 1 / run["p"], "-" if start < 1 else "-.", lw=1, color=f"C{k}", label=label)
    axis.axvline(PHI_D, color="0.7", lw=1)
    axis.set(xlabel="phi", ylabel="1 / p", ylim=(1e-4, 1), title="Mari-Kurchan; vertical line: phi_d = 1.776")
    axis.legend(fontsize=6)


def main():
    o = arguments(__doc__.splitlines()[0]).parse_args()
    n, seeds = (1024, 5) if o.large else (256, 2)
    r = Results(o, "equations_of_state")
    figure, axes = plt.subplots(1, 4, figsize=(18, 4.5))
    spheres(o, r, axes, n, seeds)
    two_stages(o, r, axes[2], n, seeds)
    mari_kurchan(o, r, axes[3], n, seeds)
    r.write(figure)


if __name__ == "__main__":
    main()
