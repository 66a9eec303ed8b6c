#!/usr/bin/env python3
"""Distributions of forces, gaps, frequencies and contact vectors over jammed packings, with fits and a picture.

usage: network_distributions.py PICTURE.png PACKING...      packings at their jamming point, as jam-pack writes them
Make them with: for s in $(seq 100); do jam-pack --seed $s --output p$s.dat; done
Needs the Python package `jam`, numpy, matplotlib.

Exponents and their errors: see tail_exponents.py, which also validates them on samples of known exponent. Frequencies come from the
first 20 packings. Median forces of each sphere start so high that they leave no range. Values to compare with: theta_e = 0.42311 (forces of contacts that touch no buckler), theta_l = 0.17462 (the other
forces), gamma = 0.41269 (gaps): Charbonneau et al., Nat. Commun. 5, 3725 (2014); Lerner, During and Wyart, Soft Matter 9, 8252 (2013).
"""
import sys

import matplotlib.pyplot as plt
import numpy as np

import jam
import tail_exponents as tail

from jam._tails import KINDS
from jam.scaling import tail_exponent

LOCALISED, SMALLEST = 1, 2  # flags of jam_contact_classes
EXPECTED = {
    "extended forces": 0.42311,
    "localised forces": 0.17462,
    "gaps": -0.41269,
    "frequencies": 0.0,
    "smallest forces": 0.17462,
}  # of each sphere: the second criterion for localised ones
WITH_MODES, MOST_SPHERES = 20, 1500  # packings whose full spectrum is computed, none of them larger
DOT_BINS = np.linspace(-1, 1, 121)


def measure(path, with_modes):
    """The data of one packing that the study uses."""
    with jam.System.read(path) as packing:
        found = packing.contacts_from_geometry()
        if found.excess_contacts != 0 or packing.status != 0:
            print(
                f"{path}: {found.excess_contacts} excess contacts, status {packing.status}: left out", file=sys.stderr
            )
            return None
        force, flags = packing.forces, packing.contact_classes()
        classes = {
            "extended forces": (flags & LOCALISED) == 0,
            "localised forces": (flags & LOCALISED) != 0,
            "smallest forces": (flags & SMALLEST) != 0,
        }
        dots, z = packing.contact_dots(weighted=0), packing.coordination
        out = {
            **{name: force[which] / force[which].mean() for name, which in classes.items()},
            "gaps": packing.gaps(h_max=1.0, stable_only=1).gap,
            "dots": np.histogram(dots.dot, DOT_BINS)[0],
            "buckler dots": np.histogram(dots.dot[z[dots.sphere] == packing.dim + 1], DOT_BINS)[0],
            "S": packing.sphere_structure(weighted=0).s[z > 0],
            "z": z[z > 0],
            "phi": packing.packing_fraction,
            "spheres": len(z),
        }
        if with_modes and len(z) <= MOST_SPHERES:
            out["frequencies"] = np.sqrt(np.maximum(packing.modes(which="all").values[packing.dim :], 0.0))
        return out


def fit(samples, name):
    """Values of each packing, those of jam.scaling.tail_exponent, and the lower end they start from."""
    values, kind = [s[name] for s in samples if name in s], "gaps" if name == "gaps" else "forces"
    return values, tail_exponent(values, samples[0]["spheres"], kind), KINDS[kind][1]


def draw_cdf(axis, values, name, result):
    pooled = np.sort(np.concatenate(values))
    cdf = np.arange(1, len(pooled) + 1) / len(pooled)
    shown = np.unique(np.geomspace(1, len(pooled), 400).astype(int)) - 1
    axis.loglog(pooled[shown], cdf[shown], ".", markersize=3, label=name)
    x, at = np.geomspace(result.low, result.high, 50), np.searchsorted(pooled, result.low)
    for a, style, text in (
        (result.value, "-", f"fit: 1 + a = {1 + result.value:.3f} ± {result.error:.3f}"),
        (EXPECTED[name], "--", f"expected {1 + EXPECTED[name]:.3f}"),
    ):
        axis.plot(x, cdf[at] * (x / pooled[at]) ** (1 + a), style, linewidth=1.5, label=text)
    axis.axvspan(result.low, result.high, color="0.92", zorder=0)
    axis.set(xlabel={"gaps": "h", "frequencies": "omega"}.get(name, "f"), ylabel="cumulative distribution")
    axis.legend(fontsize=8)


def draw_drift(axis, values, name, result, spheres, floor):
    high, a = tail.apparent(values, spheres, floor)
    axis.semilogx(high, a, "o-", markersize=3, label="power law alone, up to x")
    axis.axhspan(
        result.value - result.error,
        result.value + result.error,
        color="C1",
        alpha=0.25,
        label="with corrections, all ranges",
    )
    axis.axhline(EXPECTED[name], color="gray", linestyle="--", label="expected")
    axis.set(xlabel="upper end x of the range", ylabel=f"exponent of the density, {name}")
    axis.legend(fontsize=8)


def draw_dots(axis, samples):
    for name, label in (("dots", "all stable spheres"), ("buckler dots", "bucklers")):
        height = np.sum([s[name] for s in samples], axis=0).astype(float)
        height /= height.sum() * (DOT_BINS[1] - DOT_BINS[0])
        axis.step(DOT_BINS[:-1], height, where="post", label=label)
        top = np.argmax(height)
        print(f"{name}: the histogram peaks at {0.5 * (DOT_BINS[top] + DOT_BINS[top + 1]):.3f}")
    axis.axvline(0.5, color="gray", linestyle=":")
    axis.set(xlabel="n_ij . n_ik", ylabel="density")
    axis.legend(fontsize=8)


def draw_sums(axis, samples):
    s, z = np.concatenate([m["S"] for m in samples]), np.concatenate([m["z"] for m in samples])
    for k in range(4, 10):
        values = s[z == k]
        if len(values) > 20:
            axis.hist(values, bins=60, density=True, histtype="step", label=f"z = {k}")
            axis.axvline(-0.5 * k, color="gray", linestyle=":", linewidth=0.8)
            print(f"z = {k}: {len(values)} spheres, smallest S = {values.min():.4f}, edge at {-0.5 * k}")
    axis.set(xlabel="S_i (dotted: -z/2)", ylabel="density")
    axis.legend(fontsize=8)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    samples = [m for m in (measure(path, k < WITH_MODES) for k, path in enumerate(sys.argv[2:])) if m]
    if not samples:
        sys.exit("no packing with one state of self-stress")
    phi = np.array([s["phi"] for s in samples])
    print(f"{len(samples)} packings, phi_J = {phi.mean():.5f} +- {phi.std() / np.sqrt(max(1, len(phi) - 1)):.5f}")
    print(f"{'':18} {'range':>20} {'values':>7} {'exponent':>9} {'error':>7} {'expected':>9} {'sigmas':>7}")
    figure, axes = plt.subplots(3, 3, figsize=(14, 12))
    for k, name in enumerate(EXPECTED):
        if name not in samples[0]:
            continue
        values, r, floor = fit(samples, name)
        print(
            f"{name:18} {r.low:9.2e} .. {r.high:7.3g} {r.count:7d} {r.value:9.4f} {r.error:7.4f} {EXPECTED[name]:9.4f}"
            f" {abs(r.value - EXPECTED[name]) / r.error:7.1f}",
            flush=True,
        )
        if k < 4:
            draw_cdf(axes[0, k] if k < 3 else axes[2, 0], values, name, r)
        if k < 3:
            draw_drift(axes[1, k], values, name, r, samples[0]["spheres"], floor)
    draw_dots(axes[2, 1], samples)
    draw_sums(axes[2, 2], samples)
    figure.suptitle(
        f"{len(samples)} packings; grey: from the end of finite size to the weighted mean of the upper ends"
    )
    figure.tight_layout()
    figure.savefig(sys.argv[1], dpi=80)


if __name__ == "__main__":
    main()
