#!/usr/bin/env python3
"""Ideal packings, whose radii move while three moments keep their ratios, beside jammed packings of the same start.

usage: ideal_packings.py PICTURE.png [--large] [--result FILE.json]
Small: d = 2, up to 64 disks, 2 packings each. Large: d = 2 and 3, up to 1024 spheres.
A start has diameters spread evenly over 1 +- w, with the polydispersity w / sqrt(3), and grows by dynamics. From its end one packing is crunched,
and the radii of another move to a maximum of the common factor at fixed ratios of sum R, sum R^2 and sum R^3 (maximise_radii).
Both become networks of equal springs. Expected for radii that move (arXiv:2404.07492): more contacts than isostatic, a shear modulus that
does not vanish in large packings, no plateau of D(omega) at low omega; for crunched packings: G ~ 1 / N and a plateau down to omega = 0.
Needs the Python package `jam`, numpy, scipy, matplotlib. Prints the tables.
"""
import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import jam  # noqa: E402

sys.path.append(str(Path(__file__).resolve().parents[2] / "bindings/docs"))
import figures  # noqa: E402

WIDTH = 0.6  # of the sizes where the number of spheres changes
COLUMNS = ["d", "N", "polydispersity", "packings", "phi_J", "phi ideal", "z ideal", "z of a simple maximum", "rattlers", "G", "G ideal"]
LARGE = {dim: ((64, 10), (256, 10), (1024, 4)) for dim in (2, 3)}  # numbers of spheres and of packings
SMALL = {2: ((16, 2), (64, 2))}
COLOURS = {2: "tab:blue", 3: "tab:red"}


def ends(dim, n, width, seed):
    """The crunched packing and the ideal one, from one start; None where one of them did not end as such."""
    sizes = 1 + width * (2 * np.random.default_rng(seed).permutation(n) + 1 - n) / n
    start = jam.System.random(n=n, dim=dim, seed=seed, diameters=sizes)
    start.compress()
    ideal = start.copy()
    crunched, moved = start.crunch(), ideal.maximise_radii(moments=(1, 2, 3))
    if not (crunched.jammed and moved.maximum):
        print(f"d = {dim}, N = {n}, w = {width}, seed {seed}: jammed {crunched.jammed}, maximum {moved.maximum}", flush=True)
        return None
    return start, crunched, ideal, moved


def frequencies(packing):
    """omega of all modes of a network of equal springs but the translations."""
    return np.sqrt(np.maximum(packing.modes(which="all").frequencies[packing.dim :], 0))


def modulus(packing):
    """G in units of the spring constant and the mean diameter."""
    return packing.moduli().shear * np.mean(packing.diameters) ** (packing.dim - 2)


def mean(values):
    if len(set(values)) < 2:  # no error
        return values[0] if values else None
    return {"value": float(np.mean(values)), "error": float(np.std(values, ddof=1) / np.sqrt(len(values)))}


def scene(dim, n, width, packings, spectra):
    """A row of the table; modes of both kinds are added to `spectra` if it is a dict."""
    phi, moved_phi, shear, moved_shear, contacts, rattlers = [], [], [], [], [], 0
    for seed in range(1, packings + 1):
        found = ends(dim, n, width, seed)
        if found is None:
            continue
        start, crunched, ideal, moved = found
        phi.append(crunched.packing_fraction), moved_phi.append(moved.packing_fraction)
        shear.append(modulus(start)), moved_shear.append(modulus(ideal))
        contacts.append(2 * moved.contacts / (n - moved.rattlers))
        rattlers += moved.rattlers
        if spectra is not None:
            for kind, packing in (("crunched", start), ("ideal", ideal)):
                spectra.setdefault((dim, kind), []).append(frequencies(packing))
    expected = 2 * (dim * (n - 1) + 1 + n - 3) / n
    row = [dim, n, f"{width / np.sqrt(3):.3f}", len(phi), mean(phi), mean(moved_phi), mean(contacts), f"{expected:.3f}", rattlers]
    return row + [mean(shear), mean(moved_shear)]


def draw(rows, spectra, picture):
    figure, axes = plt.subplots(1, 3, figsize=(15, 4.6), layout="constrained")
    most = max(row[1] for row in rows)
    for dim in sorted({row[0] for row in rows}):
        colour = COLOURS[dim]
        by_width = [r for r in rows if r[0] == dim and r[1] == min(256, most)]
        by_n = [r for r in rows if r[0] == dim and r[2] == f"{WIDTH / np.sqrt(3):.3f}"]
        for column, kind, style in ((0, "crunched", "--o"), (1, "ideal", "-s")):
            label = f"d = {dim}, {kind}"
            for axis, chosen, x, y in ((axes[0], by_width, 2, 4 + column), (axes[1], by_n, 1, 9 + column)):
                chosen = [r for r in chosen if isinstance(r[y], dict)]
                at = [float(r[x]) for r in chosen]
                axis.errorbar(at, [r[y]["value"] for r in chosen], [r[y]["error"] for r in chosen], fmt=style, color=colour, label=label)
            label = f"d = {dim}, N = {by_n[-1][1]}, {kind}"
            omega = np.sort(np.concatenate(spectra[dim, kind]))
            bins = np.geomspace(0.02, 3, 40)
            density = np.histogram(omega, bins)[0] / np.diff(bins) / len(omega)
            axes[2].loglog(np.sqrt(bins[1:] * bins[:-1]), np.where(density > 0, density, np.nan), style[:-1], color=colour, label=label)
    axes[0].set(xlabel="polydispersity", ylabel="packing fraction", title=f"N = {min(256, most)}")
    axes[1].set(xlabel="N", ylabel="shear modulus G", xscale="log", yscale="log", title=f"polydispersity {WIDTH / np.sqrt(3):.2f}")
    axes[2].set(xlabel="omega", ylabel="D(omega)", title=f"polydispersity {WIDTH / np.sqrt(3):.2f}")
    for axis in axes:
        axis.legend(fontsize=8)
    figure.savefig(picture, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("picture")
    parser.add_argument("--large", action="store_true")
    parser.add_argument("--result", help="rows of the table, as JSON")
    o = parser.parse_args()
    rows, spectra = [], {}
    for dim, sizes in (LARGE if o.large else SMALL).items():
        for n, packings in sizes:
            for width in (0.2, 0.4, WIDTH, 0.8) if n == min(256, sizes[-1][0]) else (WIDTH,):
                keep = spectra if n == sizes[-1][0] and width == WIDTH else None
                rows.append(scene(dim, n, width, packings, keep))
                print(*rows[-1], flush=True)
    draw(rows, spectra, o.picture)
    if o.result:
        figures.save(o.result, "ideal_packings.py PICTURE.png" + " --large" * o.large, COLUMNS, rows)


if __name__ == "__main__":
    main()
