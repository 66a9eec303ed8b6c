#!/usr/bin/env python3
"""Do a few soft modes explain the motion near jamming? Mean displacements against the modes of two Hessians.

usage: near_jamming_modes.py FOLDER PICTURE.png [--large] [--runs RUNS]
Default: N = 256, 200 runs at phi/phi_J = 0.995. --large: N = 1024, 5000 runs, those of near_jamming_md.py --large when FOLDER
is the same. Runs are saved in FOLDER.
Needs jam, numpy, scipy, matplotlib. Prints a table.

Source: R. Diaz Hernandez Rojas, PhD thesis (Sapienza 2021), chapter 3. Expected: weight is spread over all modes, at late times
more of it on low ones; the curvature u.H.u lies above 40 to 60 % of the frequencies early and above about 20 % late. The thesis
compares u.H.u, whose unit is omega^2, with omega; here both u.H.u and its root are printed.
"""
import near_jamming_common as common
import numpy as np
from near_jamming_common import INSTANTS, plt

from jam import near_jamming as nj

SHOWN = [2, 10, 30, 100]


def main():
    args = common.arguments(__doc__, runs=200)
    packing = common.make_packing(1, n=1024 if args.large else 256)
    runs = common.md_runs(packing, args.folder, 1 if args.large else "n256", 0.995, args.runs)
    shown = [INSTANTS.index(tau) for tau in SHOWN]
    figure, axes = plt.subplots(2, 3, figsize=(13, 7.6))
    print(
        "| Hessian | tau | u.H.u | share of omega below u.H.u | below its root | weight on the lowest tenth | noise |"
    )
    print("|---" * 7 + "|")
    for row, stiffness in enumerate(("harmonic", "hard")):
        modes = packing.modes(which="all", stiffness=stiffness)
        weights = nj.mode_weights(packing, runs, modes, shown, stiffness=stiffness)
        omega = np.sqrt(np.maximum(modes.values, 0.0))[packing.dim :]
        axes[row, 2].plot(omega, np.arange(1, len(omega) + 1) / len(omega), "k-")
        for m, tau in enumerate(SHOWN):
            squares = weights.projections[m] ** 2
            curved = weights.curvature[m]
            print(
                f"| {stiffness} | {tau} | {curved:.3f} | {(omega < curved).mean():.2f} | {(omega < curved**0.5).mean():.2f} "
                f"| {squares[: len(squares) // 10].sum():.2f} | {weights.noise[m]:.1e} |"
            )
            size = max(1, len(squares) // 60)
            whole = len(squares) // size * size
            smooth = np.sqrt(squares[:whole].reshape(-1, size).mean(1))
            (line,) = axes[row, 0].semilogy(np.arange(len(smooth)) * size, smooth, label=f"tau = {tau}")
            axes[row, 2].axvline(curved, color=line.get_color())
            axes[row, 2].axvline(curved**0.5, color=line.get_color(), ls=":")
            axes[row, 1].loglog(modes.participation, np.abs(weights.projections[m]), ".", ms=1.5, label=f"tau = {tau}")
        for at in (1 / packing.hessian_map().size, 1.0):  # extended over all stable spheres; on one of them
            axes[row, 1].axvline(at, color="0.6", lw=1)
        axes[row, 0].set(xlabel="mode", ylabel=f"root mean square |u.v|, {stiffness}")
        axes[row, 1].set(xlabel="inverse participation ratio", ylabel="|u.v|")
        axes[row, 2].set(xlabel="omega; u.H.u solid, its root dotted", ylabel="share of modes")
        axes[row, 0].legend(fontsize=7)
        axes[row, 1].legend(fontsize=7)
    common.save(figure, args.picture)


if __name__ == "__main__":
    main()
