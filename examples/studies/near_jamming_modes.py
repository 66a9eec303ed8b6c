#!/usr/bin/env python3
"""Do a few soft modes explain the motion near jamming? Mean displacements against the modes of two Hessians.

usage: near_jamming_modes.py FOLDER PICTURE.png [--large] [--runs RUNS] [--result FILE.json#NAME]
Default: N = 256, 200 runs at phi/phi_J = 0.995. --large: N = 1024, 5000 runs. Runs are saved in FOLDER.
Needs jam, numpy, scipy, matplotlib. Prints a table.

Source: R. Diaz Hernandez Rojas, PhD thesis (Sapienza 2021), chapter 3. u is the mean displacement of the stable spheres, |u| = 1, v_n a
mode. Expected: weight is spread over all modes, at late times more of it on low ones; the rank correlation K[u, v_n] over the
components of all spheres gives the same picture; the curvature u.H.u lies above 40 to 60 % of the frequencies early and above about
20 % late. The thesis compares u.H.u, whose unit is omega^2, with omega; here both u.H.u and its root are printed.
"""
import sys
from pathlib import Path

import near_jamming_common as common
import numpy as np
from near_jamming_common import INSTANTS, plt
from scipy.stats import rankdata, spearmanr

from jam import near_jamming as nj

sys.path.append(str(Path(__file__).resolve().parents[2] / "bindings/docs"))
import figures  # noqa: E402

SHOWN = [2, 10, 30, 100]
COLUMNS = ["Hessian", "tau", "share of frequencies below u.H.u", "below its root", "weight on the lowest tenth of the modes",
           "share of K[u, v]^2 on it", "rank correlation of their absolute values", "share of modes with K beyond three errors of independence"]  # fmt: skip


def ranks(columns):
    """Ranks of the entries of each column, less their mean, norm 1."""
    r = rankdata(columns, axis=0)
    r -= r.mean(axis=0)
    return r / np.linalg.norm(r, axis=0)


def draw(axes, modes, u_v, k, curved, tau):
    """One time: |u.v| and |K[u, v]| of each mode with their root mean squares, |u.v| against participation, curvature."""
    size = max(1, len(u_v) // 60)
    whole = len(u_v) // size * size
    for axis, values in ((axes[0], u_v), (axes[1], k)):
        smooth = np.sqrt((values[:whole] ** 2).reshape(-1, size).mean(1))
        (line,) = axis.semilogy((np.arange(len(smooth)) + 0.5) * size, smooth, label=f"tau = {tau}")
        axis.semilogy(np.abs(values), ".", ms=1, alpha=0.35, color=line.get_color())
    axes[2].loglog(modes.participation, np.abs(u_v), ".", ms=1.5, label=f"tau = {tau}")
    axes[3].axvline(curved, color=line.get_color())
    axes[3].axvline(curved**0.5, color=line.get_color(), ls=":")


def finish(axes, stiffness, omega, spheres):
    axes[3].plot(omega, np.arange(1, len(omega) + 1) / len(omega), "k-")
    for at in (1 / spheres, 1.0):  # extended over all stable spheres; on one of them
        axes[2].axvline(at, color="0.6", lw=1)
    axes[0].set(xlabel="mode n; lines: root mean square", ylabel=f"|u.v_n|, {stiffness}", ylim=(1e-6, 1))
    axes[1].set(xlabel="mode n; lines: root mean square", ylabel=f"|K[u, v_n]|, {stiffness}", ylim=(1e-6, 1))
    axes[2].set(xlabel="inverse participation ratio", ylabel="|u.v_n|")
    axes[3].set(xlabel="omega; u.H.u solid, its root dotted", ylabel="share of modes")
    for axis in axes[:3]:
        axis.legend(fontsize=7)


def row(stiffness, tau, omega, u_v, k, curved):
    tenth = len(u_v) // 10
    return [
        {"hard": "hard spheres"}.get(stiffness, stiffness),
        tau,
        f"{(omega < curved).mean():.2f}",
        f"{(omega < curved**0.5).mean():.2f}",
        f"{(u_v[:tenth] ** 2).sum() / (u_v**2).sum():.2f}",
        f"{(k[:tenth] ** 2).sum() / (k**2).sum():.2f}",
        f"{spearmanr(np.abs(k), np.abs(u_v)).statistic:.2f}",
        f"{(np.abs(k) > 3 / len(k) ** 0.5).mean():.2f}",
    ]


def main():
    args = common.arguments(__doc__, result=True, runs=200)
    packing = common.make_packing(1, n=1024 if args.large else 256)
    runs = common.md_runs(packing, args.folder, 1 if args.large else "n256", 0.995, args.runs)
    shown, stable = [INSTANTS.index(tau) for tau in SHOWN], packing.hessian_map()
    mean = runs.mean("displacement")[:, stable].reshape(len(INSTANTS), -1)
    figure, axes = plt.subplots(2, 4, figsize=(17, 7.6))
    rows = []
    for line, stiffness in zip(axes, ("harmonic", "hard")):
        modes = packing.modes(which="all", stiffness=stiffness)
        weights = nj.mode_weights(packing, runs, modes, shown)
        omega = np.sqrt(np.maximum(modes.values, 0.0))[packing.dim :]
        every = ranks(mean[shown].T).T @ ranks(modes.vectors.reshape(len(modes.values), -1).T)
        for m, tau in enumerate(SHOWN):
            u_v, k, curved = weights.projections[m], every[m], weights.curvature[m]
            found = row(stiffness, tau, omega, u_v, k, curved)
            rows += [found] * (tau in (SHOWN[0], SHOWN[-1]))  # what the page shows
            print("| " + " | ".join(map(str, found)) + " |", flush=True)
            draw(line, modes, u_v, k, curved, tau)
        finish(line, stiffness, omega, stable.size)
    common.save(figure, args.picture)
    if args.result:
        figures.save(args.result, f"near_jamming_modes.py RUNS PICTURE.png{' --large' * args.large}", COLUMNS, rows)


if __name__ == "__main__":
    main()
