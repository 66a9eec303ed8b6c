"""Panels on predictors of motion that motion_md.py and motion_mc.py share. Not a study of its own."""
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import jam
from jam import near_jamming as nj

def quenched(folder, seed, n=1024):
    """The packing as published: sequential LPs from random spheres; kept in the folder, and read from there always."""
    path = Path(folder) / f"quenched_n{n}_seed{seed}.dat"
    if not path.exists():
        Path(folder).mkdir(parents=True, exist_ok=True)
        with jam.System.random(n=n, dim=3, seed=seed, packing_fraction=0.2) as packing:
            packing.crunch(method="sequential_lp")
            packing.write(str(path))
    packing = jam.System.read(str(path))
    found = packing.contacts_from_geometry()
    print(f"phi_J = {packing.packing_fraction:.6f}, {packing.rattlers.sum()} rattlers, {found.excess_contacts} excess contacts")
    return packing


SCALARS = {"force_sum": "sum_j f_ij", "force_pairs": "sum_jk f_ij.f_ik", "s": "S_i"}


def scatter(axis, structure, x, y, labels):
    """Stable spheres in blue, rattlers in red, K over all of them in the title."""
    bare = structure.rattlers
    axis.plot(x[~bare], y[~bare], ".", ms=2)
    axis.plot(x[bare], y[bare], "r.", ms=3)
    k = jam.statistics.spearman(x, y)
    axis.set(xlabel=labels[0], ylabel=labels[1], title=f"{labels[2]}\nK = {k:.2f}")
    return k


def vectors(structure, columns, radius):
    """Figure of <dr_c> over R_J against C_c, a row for each component, a column for each (title, runs, instant)."""
    figure, axes = plt.subplots(3, len(columns), figsize=(3.4 * len(columns), 8.4))
    found = []
    for column, (title, runs, m) in enumerate(columns):
        dr = runs.mean("displacement")[m] / radius
        for c, name in enumerate("xyz"):
            labels = (f"C_{name}", f"<d{name}> / R_J", title)
            found.append(scatter(axes[c, column], structure, structure.c[:, c], dr[:, c], labels))
    return figure, np.array(found).reshape(-1, 3).mean(axis=1)


def variances(structure, columns, radius):
    """The same of Var[dr_c] against |C_c|; K without rattlers is returned too."""
    figure, axes = plt.subplots(3, len(columns), figsize=(3.4 * len(columns), 8.4))
    found, bare = [], []
    for column, (title, runs, m) in enumerate(columns):
        spread = runs.variance()[m] / radius**2
        for c, name in enumerate("xyz"):
            x, y = np.abs(structure.c[:, c]), spread[:, c]
            found.append(scatter(axes[c, column], structure, x, y, (f"|C_{name}|", f"Var[d{name}] / R_J^2", title)))
            bare.append(jam.statistics.spearman(x[~structure.rattlers], y[~structure.rattlers]))
            axes[c, column].set(yscale="log")
    return figure, np.array(found).reshape(-1, 3).mean(axis=1), np.array(bare).reshape(-1, 3).mean(axis=1)


def mobility(structure, rows, radius):
    """<|dr|^2> over R_J^2 against three scalars, a row for each (title, runs, instant). K: (rows, scalars)."""
    figure, axes = plt.subplots(len(rows), 3, figsize=(11, 3.2 * len(rows)), squeeze=False)
    found = []
    for row, (title, runs, m) in enumerate(rows):
        square = runs.mean("distance2")[m] / radius**2
        for axis, (name, text) in zip(axes[row], SCALARS.items()):
            labels = (text, "<|dr|^2> / R_J^2", title)
            found.append(scatter(axis, structure, getattr(structure, name), square, labels))
            axis.set(yscale="log")
    return figure, np.array(found).reshape(-1, 3)


def ranking(axes, structure, runs, radius, title):
    """<dx> of the top (solid) and bottom (dotted) tenth of C_x, <|dr|^2> of those of S, rattlers dashed, against the MSD."""
    stable = np.flatnonzero(~structure.rattlers)
    tenth = max(1, len(stable) // 10)
    x = runs.msd / radius**2
    for axis, key, values, text in (
        (axes[0], structure.c[:, 0], runs.mean("displacement")[:, :, 0] / radius, "<dx> / R_J; ranked by C_x"),
        (axes[1], structure.s, runs.mean("distance2") / radius**2, "<|dr|^2> / R_J^2; ranked by S"),
    ):
        order = stable[np.argsort(key[stable])]
        for few, colour in ((order[-tenth:], "C3"), (order[:tenth], "C0")):
            axis.plot(x, values[:, few[::3]], "-", color=colour, lw=0.4, alpha=0.4)
            axis.plot(x, values[:, few].mean(axis=1), "-", color=colour, lw=2)
        axis.plot(x, values[:, structure.rattlers], "k--", lw=0.4)
        axis.set(xscale="log", xlabel="MSD / R_J^2", ylabel=text, title=f"{title}; red: top, blue: bottom tenth")
    axes[1].set(yscale="log")


def decay(runs, structure, kind):
    """(MSD, K) from the maximum of K on."""
    return nj.decay_curve(runs, structure, kind)
