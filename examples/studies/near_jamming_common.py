"""What the studies near jamming share: their options, the packing, its runs, published exponents. Not a study of its own."""
import argparse
import os

import matplotlib.pyplot as plt  # noqa: F401  for those that import this
import numpy as np

import jam
from jam import near_jamming as nj

# ---- options

LARGE = {"runs": 5000}  # what --large makes
LAST_SWEEP = 250  # as published


def arguments(doc, result=False, picture=True, **small):
    """Options of a study. small: runs it makes unless --large or --runs N is given, e.g. runs=100; result: whether it takes
    --result FILE.json#NAME; picture: whether it draws. folder is made."""
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    if picture:
        parser.add_argument("picture")
    parser.add_argument("--large", action="store_true")
    if result:
        parser.add_argument("--result", help="rows of the table, as JSON")
    for name in small:
        parser.add_argument(f"--{name}", type=int)
    args = parser.parse_args()
    for name, count in small.items():
        if getattr(args, name) is None:
            setattr(args, name, LARGE.get(name, count) if args.large else count)
    os.makedirs(args.folder, exist_ok=True)
    return args


def save(figure, picture):
    figure.tight_layout()
    figure.savefig(picture, dpi=75)


# ---- packing and runs

RATIOS = (0.96, 0.98, 0.99, 0.995, 0.999)  # phi / phi_J
# tau: collisions of the system over N, as in the thesis. Each counts for two spheres, so jam.h's collisions per particle are 2 tau.
PER_PARTICLE = 2
INSTANTS = [1, 2, 3, 5, 7, 10, 14, 20, 30, 50, 70, 100]  # tau
LONG_RATIOS = (0.96, 0.98, 0.99, 0.999)
LONG_INSTANTS = [100, 300, 1000, 2000, 3000, 5000, 7000, 10000]  # the last is 100 times that of the others, as published
TEMPERATURES = {1.5: (1e-4, 3.16e-4, 1e-3), 2.0: (4.64e-6, 2.15e-5, 1e-4), 2.5: (2.15e-7, 1.47e-6, 1e-5)}


def make_packing(seed, n=1024, quenched=False):
    """Grown, or by sequential linear programs from random spheres."""
    if quenched:
        packing = jam.System.random(n=n, dim=3, seed=seed, packing_fraction=0.2)
        report = packing.crunch(method="sequential_lp")
    else:
        packing = jam.System.random(n=n, dim=3, seed=seed)
        packing.compress([(1e-2, 500.0), (3e-3, 1e5)])
        report = packing.crunch()
    print(
        f"phi_J = {report.packing_fraction:.6f}, {report.rattlers} rattlers, {report.excess_contacts} excess contacts"
    )
    return packing


def kept_packing(folder, seed, n=1024):
    """The packing as published, by sequential linear programs; kept in the folder, and read from there always."""
    path = os.path.join(folder, f"quenched_n{n}_seed{seed}.dat")
    if not os.path.exists(path):
        os.makedirs(folder, exist_ok=True)
        with make_packing(seed, n, quenched=True) as packing:
            packing.write(path)
    packing = jam.System.read(path)
    found = packing.contacts_from_geometry()
    print(f"phi_J = {packing.packing_fraction:.6f}, {packing.rattlers.sum()} rattlers, {found.excess_contacts} excess contacts")
    return packing


def taus(runs):
    """tau at the instants of runs."""
    return runs.instants / PER_PARTICLE


def md_runs(packing, folder, name, ratio, count):
    """Runs at one density, from the file of an earlier call if it contains them. Those at 0.995 keep all at tau = 20."""
    return nj.campaign(
        packing,
        os.path.join(folder, f"md_{name}_{ratio}.npz"),
        [PER_PARTICLE * tau for tau in INSTANTS],
        count,
        part=500,
        density_ratio=ratio,
        block=50 if count >= 500 else 5,
        keep=[INSTANTS.index(20)] if ratio == 0.995 else [],
    )


def long_md_runs(packing, folder, name, ratio, count):
    path = os.path.join(folder, f"long_{name}_{ratio}.npz")
    instants = [PER_PARTICLE * tau for tau in LONG_INSTANTS]
    return nj.campaign(packing, path, instants, count, part=5, density_ratio=ratio, block=5)


def mc_runs(packing, folder, name, alpha, temperature, count):
    """Runs at one energy and temperature, from the file of an earlier call if it contains them."""
    return nj.campaign(
        packing,
        os.path.join(folder, f"mc_{name}_{alpha}_{temperature}.npz"),
        np.unique(np.round(np.geomspace(2, LAST_SWEEP, 12))),
        count,
        monte_carlo=dict(alpha=alpha, temperature=temperature),
        block=20 if count >= 200 else 2,
    )


# ---- published, R. Diaz Hernandez Rojas, PhD thesis (Sapienza 2021), chapter 3

MD_EXPONENTS = {"c": 1.80, "s": 1.65}
MC_EXPONENTS = {1.5: {"c": 0.84, "s": 0.45}, 2.0: {"c": 0.64, "s": 0.40}, 2.5: {"c": 0.51, "s": 0.35}}
NAMES = {
    "c": "K[C, <dr>]",
    "s": "K[S, <|dr|^2>]",
    "force_sum": "K[sum f]",
    "force_pairs": "K[sum f.f]",
    "variance": "K[|C|, Var]",
}


# ---- panels of motion_md.py and motion_mc.py

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
