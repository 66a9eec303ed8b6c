#!/usr/bin/python3
"""Verdicts on equal disks, grown at G = 1e-2 to p = 500, then at 3e-3 to 1e7. Each jammed one is checked again from
positions, contacts and forces, without libjam. jamproof.py proves or traps it in integers, and up to 300 disks HiGHS of scipy
looks for a motion. JSON to stdout; exit status 1 if one is wrong.

usage: disks.py N SEEDS [FIRST_SEED]      with PYTHONPATH set to the built module
"""
import collections
import itertools
import json
import statistics
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import jam

MOST_FOR_HIGHS = 300  # it needs minutes for a thousand

sys.path.append(str(Path(__file__).parents[2] / "bindings/proof"))
import jamproof  # noqa: E402


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


def proof(system):
    """The first word of what jamproof.py says of the packing: proved, trapped, or not proved."""
    with tempfile.TemporaryDirectory() as folder:
        path = folder + "/a.jamproof"
        system.write_proof(path)
        return jamproof.conclusion(jamproof.Scene(path))[1].split(":")[0]


n, seeds = int(sys.argv[1]), int(sys.argv[2])
first = int(sys.argv[3]) if len(sys.argv) > 3 else 1
rows = []
for seed in range(first, first + seeds):
    s = jam.System.random(n, 2, seed)
    s.compress([(1e-2, 500.0), (3e-3, 1e7)])
    began = time.process_time()
    report = s.crunch(wall_time=600)
    seconds = time.process_time() - began
    kind, reason = verdict(s, report, motion=n <= MOST_FOR_HIGHS)
    rows.append(
        {
            "seed": seed,
            "kind": kind,
            "reason": reason,
            "proof": proof(s) if report.jammed else "",
            "rigidity": s.rigidity("collective").jammed.name.lower(),
            "seconds": round(seconds, 3),
            "factorisations": report.factorisations,
            "lps": report.lp_solves,
            "phi": report.packing_fraction,
            "force_residual": report.force_residual,
        }
    )
    print(json.dumps(rows[-1]), file=sys.stderr, flush=True)
json.dump(
    {
        "n": n,
        "kinds": collections.Counter(row["kind"] for row in rows),
        "not_confirmed": sum(row["reason"] == "not confirmed" for row in rows),
        "median_seconds": statistics.median(row["seconds"] for row in rows),
        "median_factorisations": statistics.median(row["factorisations"] for row in rows),
        "rows": rows,
    },
    sys.stdout,
    indent=1,
)
print()
sys.exit(any(row["kind"] == "wrong" for row in rows))
