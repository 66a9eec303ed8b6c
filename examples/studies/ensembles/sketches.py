#!/usr/bin/env python3
"""What one LP does, drawn from small systems of disks: figures 2.1 to 2.4 and 2.12 of the thesis.

usage: sketches.py [--out DIR]          seconds

2.1 exact and linear constraints on one of five disks; 2.2 the five disks before and after one LP; 2.4 two growing disks that
collide; 2.12 snapshots of dynamics at three pressures and the jammed states that crunches find from them.
"""
import matplotlib.pyplot as plt
import numpy as np
from common import Results, arguments

import jam


def five():
    return jam.System.random(n=5, dim=2, seed=4, packing_fraction=0.35)


def images(x, i):
    """Nearest images of the others around disk i."""
    d = np.delete(x, i, axis=0) - x[i]
    return x[i] + d - np.round(d)


def circles(axis, x, sigma, **look):
    for point in x:
        for shift in np.array([[a, b] for a in (-1, 0, 1) for b in (-1, 0, 1)]):
            axis.add_patch(plt.Circle(point + shift, 0.5 * sigma, **look))


def constraints(r, axis):
    """2.1: where the centre of one disk may go while the others rest: |r + s| >= sigma exactly, 2 r.s >= sigma^2 - r^2 linearly."""
    packing = five()
    x, sigma = packing.positions, 1.15 * packing.diameters[0]
    i = 0
    others = images(x, i)
    u = np.linspace(-0.5, 0.5, 400)
    s = np.stack(np.meshgrid(u, u), axis=-1)
    exact, linear = np.ones(s.shape[:2], bool), np.ones(s.shape[:2], bool)
    for other in others:
        d = x[i] - other
        exact &= ((d + s) ** 2).sum(-1) >= sigma**2
        linear &= 2 * s @ d >= sigma**2 - d @ d
    at = (u + x[i, 0], u + x[i, 1])
    axis.contourf(*at, exact, levels=[0.5, 1.5], colors=["#cde7f7"])
    axis.contourf(*at, linear, levels=[0.5, 1.5], colors=["#2a7fb8"])
    for other in others:
        axis.add_patch(plt.Circle(other, sigma, fill=False, ls=":", lw=1))
        axis.add_patch(plt.Circle(other, 0.5 * sigma, color="0.8"))
    axis.add_patch(plt.Circle(x[i], 0.5 * sigma, fill=False, color="C3", lw=1.5))
    axis.plot(*x[i], "r.")
    axis.set(xlim=(x[i, 0] - 0.5, x[i, 0] + 0.5), ylim=(x[i, 1] - 0.5, x[i, 1] + 0.5), aspect="equal")
    axis.set(xlabel="x / L", ylabel="y / L", title="2.1 allowed centres of the red disk:\nexact (light), linear (dark)")
    r.add("2.1", "points that the linear constraints allow and the exact ones do not", ("no overlap", 0.0), np.sum(linear & ~exact))


def one_lp(r, axis):
    """2.2: positions and diameters before and after one LP."""
    packing = five()
    before, sigma = packing.positions.copy(), packing.diameters[0]
    packing.crunch(method="sequential_lp", max_lps=1, full_lps=True, polish=0)
    after, grown = packing.positions, packing.diameters[0]
    moved = after - before
    moved -= np.round(moved)
    circles(axis, before, sigma, color="0.85")
    circles(axis, before + moved, grown, fill=False, color="C0", lw=1.2)
    axis.quiver(*before.T, *moved.T, angles="xy", scale_units="xy", scale=1, color="C3", width=0.008)
    axis.set(xlim=(0, 1), ylim=(0, 1), aspect="equal", xlabel="x / L", ylabel="y / L", title=f"2.2 one LP: diameters times {grown / sigma:.3f}")
    d = after[:, None] - after[None]
    d -= np.round(d)
    least = np.sqrt((d**2).sum(-1))[np.triu_indices(5, 1)].min() / grown
    r.add("2.2", "least distance over the diameter after one LP", ">= 1", least)


def collision(r, axis):
    """2.4: the smallest root of |dr + dv t| = sigma + sigma' t."""
    x, v = np.array([[0.25, 0.4], [0.7, 0.55]]), np.array([[0.5, 0.1], [-0.3, -0.05]])
    sigma, rate = 0.2, 0.1
    dr, dv = x[0] - x[1], v[0] - v[1]
    a, b, c = dv @ dv - rate**2, dr @ dv - sigma * rate, dr @ dr - sigma**2
    t = (-b - np.sqrt(b * b - a * c)) / a
    for k, colour in enumerate(("C0", "C1")):
        axis.add_patch(plt.Circle(x[k], 0.5 * sigma, color=colour, alpha=0.3))
        axis.add_patch(plt.Circle(x[k] + v[k] * t, 0.5 * (sigma + rate * t), fill=False, color=colour, lw=1.5))
        axis.quiver(*x[k], *(v[k] * t), angles="xy", scale_units="xy", scale=1, color=colour, width=0.008)
    axis.set(xlim=(0.05, 0.95), ylim=(0.05, 0.95), aspect="equal", xlabel="x / L", ylabel="y / L", title=f"2.4 growing disks meet after t = {t:.3f}")
    off = np.linalg.norm(dr + dv * t) - sigma - rate * t
    r.add("2.4", "distance less the sum of radii at the collision", ("contact", 0.0), off)


PATH, LEAST = (1e3, 1e5, 1e7), 1e-12  # pressures of figure 2.12; distances below are drawn there


def states(r, axis, n):
    """2.12: one growing packing and the jammed states that crunches find on its way, by their distance from the
    last one. Rattlers lie where dynamics left them and are left out."""
    packing = jam.System.random(n=n, seed=1)
    packing.compress([(1e-2, 500.0)])
    sets, jammed, held = [], [], []
    for pressure in PATH:
        packing.compress([(3e-3, pressure)])
        with packing.copy() as copy:
            for k in range(8):
                copy.run(10)
                sets.append((pressure, copy.positions.copy()))
                if k % 2 == 0:
                    with copy.copy() as end:
                        end.crunch()
                        jammed.append((pressure, end.positions.copy()))
                        held.append(end.coordination > 0)
    stable, origin = np.array(held).all(axis=0), jammed[-1][1]

    def away(x):
        d = (x - origin)[stable]
        d -= np.round(d)
        return (d - d.mean(axis=0)).ravel()

    ends = np.array([away(x) for _, x in jammed])
    unit = packing.diameters.mean() * stable.sum() ** 0.5
    for colour, pressure in zip(("C0", "C1", "C2"), PATH):
        moving = [np.linalg.norm(away(x)) / unit for p, x in sets if p == pressure]
        axis.loglog(pressure * 1.12 ** np.arange(len(moving)), moving, ".", color=colour, label=f"dynamics, p = {pressure:g}")
        few = np.array([p == pressure for p, _ in jammed])
        still = np.maximum(np.linalg.norm(ends[few], axis=1) / unit, LEAST)
        axis.loglog(pressure * 1.25 ** np.arange(len(still)), still, "*", ms=9, color=colour, mec="k", mew=0.5, label="jammed states from there")
        spread = np.sqrt(((ends[few] - ends[few].mean(axis=0)) ** 2).sum(axis=1).mean()) / unit
        r.add("2.12", f"root mean square distance of the jammed states from p = {pressure:g}, diameters", "falls with p", spread)
    axis.set(xlabel="reduced pressure; points beside each other: later", ylabel=f"rms distance from the last jammed state / diameter (0: {LEAST:g})")
    axis.set(title=f"2.12 one packing, {n} spheres")
    axis.legend(fontsize=6)


def disks(r, axis, n):
    """2.3: jammed disks of size ratio 1.4 with their force network; rattlers in colour."""
    packing = jam.System.random(n=n, dim=2, seed=1, packing_fraction=0.4, diameters=np.where(np.arange(n) % 2, 1.4, 1.0))
    report = packing.crunch(method="sequential_lp")
    x, sigma, stable = packing.positions, packing.diameters, ~packing.rattlers
    for point, s, kept in zip(x, sigma, stable):
        for shift in np.array([[a, b] for a in (-1, 0, 1) for b in (-1, 0, 1)]):
            axis.add_patch(plt.Circle(point + shift, 0.5 * s, color="0.88" if kept else "#f2a65a", ec="0.6", lw=0.4))
    contacts = packing.contacts
    for (i, j), v, f in zip(contacts.pairs, contacts.vectors, contacts.forces):
        end = x[i] - v * 0.5 * (sigma[i] + sigma[j])
        axis.plot(*np.stack([x[i], end]).T, "k-", lw=0.8 * f, solid_capstyle="round")
    axis.set(xlim=(0, 1), ylim=(0, 1), aspect="equal", xlabel="x / L", ylabel="y / L")
    axis.set(title=f"{n} disks, phi_J = {report.packing_fraction:.4f}; lines: forces; orange: rattlers")
    r.add("2.3", f"phi_J of {n} disks, size ratio 1.4, sequential LPs from 0.4", "about 0.84", report.packing_fraction)
    r.add("2.3", "contacts above isostatic", "0", report.excess_contacts)


def main():
    p = arguments(__doc__.splitlines()[0])
    p.add_argument("--disks", type=int, default=1024, help="of figure 2.3 (1024)")
    p.add_argument("--spheres", type=int, default=1024, help="of figure 2.12 (1024)")
    o = p.parse_args()
    r = Results(o, "sketches")
    figure, axes = plt.subplots(2, 2, figsize=(10.5, 10))
    for axis, draw in zip(axes.flat, (constraints, one_lp, collision)):
        draw(r, axis)
    states(r, axes.flat[3], o.spheres)
    r.picture(figure)
    figure, axis = plt.subplots(figsize=(9, 9))
    disks(r, axis, o.disks)
    r.picture(figure, "sketches_disks")
    r.write()


if __name__ == "__main__":
    main()
