#!/usr/bin/python3
"""Where crunch jams, and where and why it stops: by start density, method, dimension, sizes and crystals.

usage: failure_map.py [--out MAP.json] [--picture MAP.png] [--seeds 2] [--limit SECONDS] [--scale 1] [--only-draw] [--scenes]

--scenes: scenes with walls, and disks of which one is 50 times as wide as the others in the mean, instead of the other maps; three minutes.

Every result is checked here from positions, diameters and contacts alone, over all images. An independent linear program
(HiGHS of scipy) looks for a motion of each packing that is called jammed. "wrong" is a packing with an overlap, or one called
jammed that is not; it must not come up: then the exit status is 1. Set PYTHONPATH to the built module.
"""
import argparse
import itertools
import json
import sys
import time

import numpy as np

KINDS = {
    "jammed 1SS": "#4c9f70",
    "jammed hyperstatic": "#a6d8a8",
    "stopped": "#f2c14e",
    "refused": "#c9c9c9",
    "wrong": "#d1495b",
}
JAMMED = {2: 0.84, 3: 0.64, 4: 0.46, 5: 0.31}


def overlap(x, sizes, box):
    """Largest overlap over the contact distance by brute force, and whether a sphere overlaps its own image."""
    n, d = x.shape
    reach = 2 if sizes.max() > 0.5 * box else 1
    worst = 0.0
    sigma = 0.5 * (sizes[:, None] + sizes[None, :])
    dx = x[:, None, :] - x[None, :, :]
    dx -= box * np.round(dx / box)
    shifts = itertools.product(range(-reach, reach + 1), repeat=d) if n <= 12 else [(0,) * d]
    for shift in shifts:
        r = np.sqrt(((dx + box * np.array(shift, float)) ** 2).sum(-1))
        if not any(shift):
            np.fill_diagonal(r, np.inf)
        worst = max(worst, (1.0 - r / sigma).max())
    return worst


def moves(n, d, pairs, normals):
    """Whether a motion opens contacts of the force-carrying spheres and closes none: the test of collective jamming."""
    from scipy.optimize import linprog
    from scipy.sparse import coo_matrix

    carrying = np.unique(pairs)
    index = np.full(n, -1)
    index[carrying] = np.arange(len(carrying))
    k = np.repeat(np.arange(len(pairs)), d)
    columns = [(index[pairs[:, e]][:, None] * d + np.arange(d)).ravel() for e in (0, 1)]
    s = coo_matrix(
        (np.concatenate([normals.ravel(), -normals.ravel()]), (np.concatenate([k, k]), np.concatenate(columns))),
        shape=(len(pairs), d * len(carrying)),
    ).tocsr()
    # A solver's tolerance lets contacts close a little, and a weak force makes that a large motion of others. Displacements
    # up to 1 at a tolerance of 1e-10 tell both apart: a true motion reaches its bound.
    exact = {"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10}
    rng = np.random.default_rng(1)
    for direction in (np.asarray(s.sum(axis=0)).ravel(), rng.standard_normal(s.shape[1])):
        for method in ("highs-ds", "highs-ipm"):
            found = linprog(
                -direction, A_ub=-s, b_ub=np.zeros(len(pairs)), bounds=(-1, 1), options=exact, method=method
            )
            if found.x is not None:
                break
        else:
            return None  # no solver gave an answer
        v = found.x.reshape(-1, d)
        if abs(v - np.median(v, axis=0)).max() > 0.3:
            return True
    return False


def verdict(system, report, motion=True):
    """Kind and reason of a result, recomputed from positions, contacts and forces; motion: HiGHS looks for one too."""
    x, sizes = np.array(system.positions), np.array(system.diameters)
    n, d = x.shape
    if overlap(x, sizes, system.box) > 1e-11:
        return "wrong", "overlap"
    if not report.jammed:
        return "stopped", report.stop_reason.name.lower()
    c = system.contacts
    i, j = c.pairs.T
    sigma = 0.5 * (sizes[i] + sizes[j])
    dx = x[i] - x[j]
    r = c.vectors * sigma[:, None]
    off = (r - dx) / system.box
    if abs(off - np.round(off)).max() * system.box > 1e-9 * sigma.max():
        return "wrong", "a contact is open"
    force = np.zeros_like(x)
    np.add.at(force, i, c.forces[:, None] * c.vectors)
    np.add.at(force, j, -c.forces[:, None] * c.vectors)
    if abs(force).max() > 1e-8 or c.forces.min() <= 0:
        return "wrong", "forces"
    stable = len(set(i) | set(j))
    excess = len(c) - (d * (stable - 1) + 1)
    if excess < 0 or excess != report.excess_contacts:
        return "wrong", "count of contacts"
    moving = moves(n, d, np.array(c.pairs), np.array(c.vectors)) if motion else None
    if moving:
        return "wrong", "a motion is left"
    if moving is None:
        return "jammed hyperstatic" if excess else "jammed 1SS", "not confirmed"
    return ("jammed 1SS", "") if excess == 0 else ("jammed hyperstatic", f"+{excess}")


def sizes_of(kind, n, seed):
    if isinstance(kind, str):  # log-normal, standard deviation over mean
        s = float(kind.split()[1])
        width = np.sqrt(np.log(1.0 + s * s))
        return np.exp(width * np.random.default_rng(seed).standard_normal(n))
    return np.where(np.arange(n) % 2, 1.0, kind)


def run(dim, n, sizes, start, method, seed, limit):
    """start: ("phi", fraction of the jammed density), past 0.4 grown at G = 0.1, or ("p", pressure of a state grown at G = 0.1, then 0.03)."""
    import jam

    began, row = time.process_time(), {}
    try:
        phi = JAMMED[dim] * min(start[1] if start[0] == "phi" else 0.3, 0.4)
        s = jam.System.random(n, dim, seed, packing_fraction=phi, diameters=sizes)
        if start[0] == "phi" and start[1] > 0.4:
            s.compress(growth_rate=0.1, pressure=1e12, packing_fraction=JAMMED[dim] * start[1], wall_time=limit)
        elif start[0] == "p":
            s.compress([(0.1, min(start[1], 1e2))] + ([(0.03, start[1])] if start[1] > 1e2 else []), wall_time=limit)
        report = s.crunch(method=method, wall_time=limit)
        row["kind"], row["reason"] = verdict(s, report)
        row.update(
            phi=report.packing_fraction,
            excess=report.excess_contacts,
            lps=report.lp_solves,
            factorisations=report.factorisations,
            used=report.method.name.lower(),
            force_residual=report.force_residual,
            max_overlap=report.max_overlap,
        )
    except jam.JamError as error:
        refused = isinstance(error, (jam.errors.UnplaceableError, jam.errors.ArgumentError, jam.errors.TooFewError))
        row.update(kind="refused" if refused else "stopped", reason=str(error)[:80])
    row["cpu"] = round(time.process_time() - began, 3)
    return row


def lattice(name):
    """Positions in the unit cube and the diameter at contact of a named lattice."""
    kind, cells = name.split()[0], int(name.split()[1].split("^")[0])
    basis = {
        "square": [(0, 0)],
        "cubic": [(0, 0, 0)],
        "FCC": [(0, 0, 0), (0, 0.5, 0.5), (0.5, 0, 0.5), (0.5, 0.5, 0)],
    }[kind]
    d = len(basis[0])
    grid = np.stack(np.meshgrid(*[np.arange(cells)] * d, indexing="ij"), -1).reshape(-1, 1, d)
    x = ((grid + np.array(basis)) / cells).reshape(-1, d)
    return x, (np.sqrt(0.5) if kind == "FCC" else 1.0) / cells


def crystal(name, seed, limit):
    """Lattices at contact, with vacancies; disks that order while they grow."""
    import jam

    began = time.process_time()
    if name.split()[0] in ("square", "cubic", "FCC"):
        x, sigma = lattice(name)
        vacancies = int(name.split(", ")[1].split()[0]) if "," in name else 0
        keep = np.random.default_rng(seed).permutation(len(x))[vacancies:]
        s = jam.System.from_arrays(x[np.sort(keep)], diameters=np.full(len(keep), sigma), box=1.0)
    else:
        n, spread = int(name.split()[1].strip(",")), float(name.split(", ")[1]) if "," in name else 0.0
        sizes = np.exp(spread * np.random.default_rng(seed).standard_normal(n))
        s = jam.System.random(n, 2, seed, packing_fraction=0.3, diameters=sizes)
        s.compress([(1e-2, 500.0)], wall_time=limit)
    report = s.crunch(wall_time=limit)
    row = dict(zip(("kind", "reason"), verdict(s, report)))
    row.update(phi=report.packing_fraction, excess=report.excess_contacts, factorisations=report.factorisations)
    return dict(row, lps=report.lp_solves, cpu=round(time.process_time() - began, 3))


def crystals(args):
    names = ["square 6^2", "cubic 4^3", "FCC 3^3", "FCC 3^3, 1 vacancy", "FCC 3^3, 8 vacancies"]
    names += [f"disks {n}" for n in (100, 300, 1000)] + ["disks 300, 1e-3", "disks 300, 1e-2"]
    for name, seed in itertools.product(names, range(1, 5 * args.seeds + 1)):
        if name == "disks 1000" and args.scale < 1:
            continue
        row = dict(map="crystals", dim=3 if name[0] in "cF" else 2, line=name, start=f"seed {seed}", seed=seed)
        row.update(crystal(name, seed, args.limit))
        print(row, file=sys.stderr, flush=True)
        yield row


# Half of the spheres are 1.4 times as wide; one disk 50 times as wide as the mean of the others. The rigid motions that each scene allows.
SCENES = {
    "slit": (dict(walls="z"), 2),
    "box": (dict(walls="xyz"), 0),
    "tube": (dict(container="cylinder", cell=[1, 1, 2]), 2),
    "can": (dict(container="cylinder", walls="z"), 1),
    "ball": (dict(container="ball"), 3),
    "disks between lines": (dict(dim=2, walls="y"), 1),
    "disks in a circle": (dict(dim=2, container="ball"), 1),
    "one disk of ratio 50": (dict(dim=2), 2),
}
SCENE_STARTS = [("phi", 0.05), ("phi", 0.2), ("phi", 0.3), ("p", 1e2), ("p", 1e4), ("p", 1e7)]


def wall_geometry(scene, x, edge):
    """(n, walls) distances and (n, walls, d) directions away from each wall, numbered as System.walls()."""
    d, found = x.shape[1], []
    for c in range(d):
        if "xyz"[c] in scene.get("walls", ""):
            for side in (0, 1):
                normal = np.zeros_like(x)
                normal[:, c] = 1 - 2 * side
                found.append((edge[c] - x[:, c] if side else x[:, c], normal))
    if "container" in scene:
        off = x - edge / 2
        off[:, 2 if scene["container"] == "cylinder" else d :] = 0
        r = np.linalg.norm(off, axis=1)
        found.append((edge[0] / 2 - r, -off / np.maximum(r, 1e-300)[:, None]))
    if not found:
        return np.zeros((len(x), 0)), np.zeros((len(x), 0, d))
    return np.array([f[0] for f in found]).T, np.array([f[1] for f in found]).transpose(1, 0, 2)


def scene_verdict(scene, symmetries, system, report):
    """As verdict(), for scenes with walls: rank by singular values, and HiGHS looks for a motion that opens a contact."""
    from scipy.optimize import linprog

    x, a, edge = np.array(system.positions), np.array(system.diameters) / 2, np.diag(system.cell)
    n, d = x.shape
    closed = {"cylinder": 2, "ball": d}.get(scene.get("container"), 0)
    repeats = np.array([c >= closed and "xyz"[c] not in scene.get("walls", "") for c in range(d)])
    distance, normal = wall_geometry(scene, x, edge)
    dx = x[:, None] - x[None]
    dx -= np.where(repeats, edge * np.round(dx / edge), 0)
    r = np.linalg.norm(dx, axis=2)
    np.fill_diagonal(r, np.inf)
    worst = max((1 - r / (a[:, None] + a)).max(), (1 - distance / a[:, None]).max(initial=-1))
    if worst > 1e-11:
        return "wrong", "overlap"
    if not report.jammed:
        return "stopped", report.stop_reason.name.lower()
    c = system.contacts
    rows, force = np.zeros((len(c), n * d)), np.zeros_like(x)
    for k, ((i, j), f) in enumerate(zip(c.pairs, c.forces)):
        true = normal[i, -1 - j] if j < 0 else dx[i, j] / r[i, j]
        gap = distance[i, -1 - j] / a[i] - 1 if j < 0 else r[i, j] / (a[i] + a[j]) - 1
        if abs(gap) > 1e-9 or abs(true - c.vectors[k]).max() > 1e-9:
            return "wrong", "a contact is open"
        rows[k, i * d : i * d + d] += true
        force[i] += f * true
        if j >= 0:
            rows[k, j * d : j * d + d] -= true
            force[j] -= f * true
    if abs(force).max() > 1e-8 or c.forces.min() <= 0:
        return "wrong", "forces"
    stable = np.unique(c.pairs[c.pairs >= 0])
    excess = len(c) - (d * len(stable) - symmetries + 1)
    if excess != report.excess_contacts:
        return "wrong", "count of contacts"
    columns = (stable[:, None] * d + np.arange(d)).ravel()
    flexes = len(columns) - symmetries - np.linalg.matrix_rank(rows[:, columns], tol=1e-7)
    if flexes != report.flexes:
        return "wrong", "a motion is left"
    found = linprog(-rows.sum(0), A_ub=-rows, b_ub=np.zeros(len(rows)), bounds=(-1, 1))
    if found.x is None:
        return "jammed hyperstatic" if excess else "jammed 1SS", "not confirmed"
    if found.fun < -1e-6:
        return "wrong", "a motion is left"
    if flexes:
        return "jammed hyperstatic", f"{flexes} flexes held"
    return ("jammed 1SS", "") if excess == 0 else ("jammed hyperstatic", f"+{excess}")


def scene_rows(args):
    import jam

    for name, start, seed in itertools.product(SCENES, SCENE_STARTS, range(1, args.seeds + 1)):
        scene, symmetries = SCENES[name]
        large = name == "one disk of ratio 50"
        if large and seed > 1:
            continue
        n = 1300 if large else int(128 * args.scale)
        sizes = np.where(np.arange(n) % 2, 1.4, 1.0)
        sizes[0] = 60.0 if large else 1.0
        began = time.process_time()
        phi = start[1] if start[0] == "phi" else 0.15
        s = jam.System.random(n, seed=seed, packing_fraction=phi, diameters=sizes, **scene)
        if start[0] == "p":
            s.compress([(0.1, min(start[1], 1e2))] + ([(0.03, start[1])] if start[1] > 1e2 else []), wall_time=args.limit)
        report = s.crunch(wall_time=args.limit)
        begin = f"fraction {start[1]:g}" if start[0] == "phi" else f"p {start[1]:g}"
        row = dict(map="scenes", dim=s.dim, n=n, line=name, start=begin, seed=seed)
        row.update(zip(("kind", "reason"), scene_verdict(scene, symmetries, s, report)))
        row.update(phi=report.packing_fraction, excess=report.excess_contacts, lps=report.lp_solves)
        row.update(factorisations=report.factorisations, cpu=round(time.process_time() - began, 3))
        print(row, file=sys.stderr, flush=True)
        yield row


def study(args):
    if args.scenes:
        return {"seeds": args.seeds, "limit": args.limit, "rows": list(scene_rows(args))}
    rows = list(crystals(args))
    starts = [("phi", f) for f in (0.05, 0.2, 0.4, 0.6, 0.8, 0.95)] + [("p", p) for p in (1e1, 1e3, 1e6, 1e9, 1e12)]
    sizes = {2: (128, 1.4), 3: (128, 1.0), 4: (96, 1.0), 5: (64, 1.0)}
    for dim, method, start, seed in itertools.product(
        sizes, ("barrier_path", "sequential_lp"), starts, range(1, args.seeds + 1)
    ):
        n, ratio = int(sizes[dim][0] * args.scale), sizes[dim][1]
        row = run(dim, n, sizes_of(ratio, n, seed), start, method, seed, args.limit)
        rows.append(
            dict(map="density", dim=dim, n=n, method=method, start=f"{start[0]} {start[1]:g}", seed=seed, **row)
        )
        print(rows[-1], file=sys.stderr, flush=True)
    kinds = (1.0, 1.4, 2.0, 4.0, 10.0, "log-normal 0.2", "log-normal 0.5")
    for kind, n, dim, seed in itertools.product(kinds, (4, 8, 32, 128, 512), (2, 3), range(1, args.seeds + 1)):
        if n > 128 * args.scale:
            continue
        row = run(dim, n, sizes_of(kind, n, seed), ("phi", 0.3), "barrier_path", seed, args.limit)
        rows.append(
            dict(map="sizes", dim=dim, n=n, sizes=kind if isinstance(kind, str) else f"1:{kind:g}", seed=seed, **row)
        )
        print(rows[-1], file=sys.stderr, flush=True)
    return {"seeds": args.seeds, "limit": args.limit, "rows": rows}


def draw(data, picture):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    maps = (
        (
            "density",
            lambda r: (f"d = {r['dim']}, {r['method']}", r["start"]),
            "start at this part of the jammed density (random to 0.4, then grown fast), or grown to pressure p; in each cell: median factorisations",
        ),
        (
            "sizes",
            lambda r: (r["sizes"], f"d = {r['dim']}, N = {r['n']}"),
            "diameters half and half or log-normal (deviation over mean), random start at 0.3 of the jammed density; +k: contacts beyond one state of self-stress",
        ),
        (
            "crystals",
            lambda r: (r["line"], r["start"]),
            "lattices at contact with vacancies; disks grown to p = 500, equal or log-normal (deviation); +k: contacts beyond one state of self-stress",
        ),
    )
    scenes = (
        "scenes",
        lambda r: (r["line"], r["start"]),
        "128 spheres, half of them 1.4 times as wide, and 1300 disks; start at this packing fraction, or grown to pressure p; in each cell: median factorisations",
    )
    if any(r["map"] == "scenes" for r in data["rows"]):
        maps = (scenes,)
        figure, axes = plt.subplots(1, 1, figsize=(10.5, 5), squeeze=False)
        axes = axes[0]
    else:
        figure, axes = plt.subplots(3, 1, figsize=(10.5, 14), height_ratios=(8, 7, 9))
    order = list(KINDS)
    for axis, (name, key, title) in zip(axes, maps):
        rows = [r for r in data["rows"] if r["map"] == name]
        lines = list(dict.fromkeys(key(r)[0] for r in rows))
        columns = (
            list(dict.fromkeys(key(r)[1] for r in rows))
            if name != "sizes"
            else sorted({key(r)[1] for r in rows}, key=lambda c: (c[:5], int(c.split("N = ")[1])))
        )
        for a, line in enumerate(lines):
            for b, column in enumerate(columns):
                cell = [r for r in rows if key(r) == (line, column)]
                if not cell:
                    continue
                for part, r in enumerate(sorted(cell, key=lambda r: order.index(r["kind"]))):
                    axis.add_patch(
                        plt.Rectangle((b + part / len(cell), a), 1 / len(cell), 1, color=KINDS[r["kind"]], lw=0)
                    )
                notes = [
                    " ".join(
                        sorted(
                            {
                                r["reason"].replace("_", " ")[:14]
                                for r in cell
                                if r["kind"] in ("jammed hyperstatic", "stopped", "wrong")
                            }
                        )
                    )
                ]
                if name == "density" and any(r.get("used", r["method"]) != r["method"] for r in cell):
                    notes.append("LPs alone" if all(r.get("used") == "sequential_lp" for r in cell) else "some by LPs")
                work = [r["factorisations"] for r in cell if "factorisations" in r]
                notes += [f"{np.median(work):.0f}"] if work else []
                axis.text(b + 0.5, a + 0.5, "\n".join(n for n in notes if n), ha="center", va="center", fontsize=6)
        axis.set(
            xlim=(0, len(columns)),
            ylim=(len(lines), 0),
            xticks=np.arange(len(columns)) + 0.5,
            yticks=np.arange(len(lines)) + 0.5,
        )
        axis.set_xticklabels(
            [c.replace("phi ", r"$\varphi_0/\varphi_J$ = ").replace("p 1", "p = 1") for c in columns],
            fontsize=7,
            rotation=12,
        )
        axis.set_yticklabels(lines, fontsize=8)
        sizes = {r["dim"]: r["n"] for r in rows} if name == "density" else {}
        axis.set_title(
            (", ".join(f"N = {n} (d = {d})" for d, n in sizes.items()) + ":\n" if name == "density" else "") + title,
            fontsize=8,
        )
        for k in range(len(columns) + 1):
            axis.axvline(k, color="white", lw=2)
        for k in range(len(lines) + 1):
            axis.axhline(k, color="white", lw=2)
        axis.tick_params(length=0)
        for spine in axis.spines.values():
            spine.set_visible(False)
    found = {r["kind"] for r in data["rows"]}
    figure.legend(
        handles=[
            plt.Rectangle((0, 0), 1, 1, color=c, label=k + ("" if k in found else " (none)")) for k, c in KINDS.items()
        ],
        loc="lower center",
        ncol=5,
        fontsize=8,
        frameon=False,
    )
    figure.tight_layout(rect=(0, 0.03, 1, 1))
    figure.savefig(picture, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", default="failure_map.json")
    parser.add_argument("--picture")
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--limit", type=float, default=20.0)
    parser.add_argument("--scale", type=float, default=1.0)
    parser.add_argument("--only-draw", action="store_true")
    parser.add_argument("--scenes", action="store_true")
    args = parser.parse_args()
    if args.only_draw:
        data = json.load(open(args.out))
    else:
        data = study(args)
        json.dump(data, open(args.out, "w"), indent=0)
    if args.picture:
        draw(data, args.picture)
    counts = {k: sum(r["kind"] == k for r in data["rows"]) for k in KINDS}
    print(json.dumps(counts))
    return 1 if counts["wrong"] else 0


if __name__ == "__main__":
    sys.exit(main())
