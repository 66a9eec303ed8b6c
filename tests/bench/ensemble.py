#!/usr/bin/env python3
"""What a packing of an ensemble costs, from nothing to its checked file, and which stages change its statistics.

usage: ensemble.py [--n 256] [--seeds 1,200] [--out ensemble.json] [--picture ensemble.png] [--protocols default,...]

Processor time on one thread, part by part; the protocols take turns on each seed. Stages that begin alike make the same
fluid of one seed, so differences from the default are means of differences over seeds, with their standard errors.
PYTHONPATH: the built module.
"""
import argparse
import json
import tempfile
import time
from pathlib import Path

import numpy as np

import jam
from jam import store
from jam._formats.write_packing import write_file
from jam.ensemble import protocol as protocols

FIRST = (1e-2, 500.0)
STAGES = {
    "default": [FIRST, (3e-3, 1e7)],
    "second stage to 1e4": [FIRST, (3e-3, 1e4)],
    "second stage to 3000": [FIRST, (3e-3, 3e3)],
    "second stage at 6e-3": [FIRST, (6e-3, 1e7)],
    "first stage to 1e4": [(1e-2, 1e4)],
    "first stage alone": [FIRST],
}
PARTS = ("start", "growth", "crunch", "analysis", "image", "file", "check")


def statistics_of(packing, results, report):
    """Per sphere or per contact, so that means over packings compare."""
    gap, force = np.asarray(results["gaps"].gap), np.asarray(packing.forces)
    stable = packing.n - report.rattlers
    return {
        "phi_J": report.packing_fraction,
        "rattlers": report.rattlers / packing.n,
        **{f"gaps below {h}": float((gap < float(h)).sum()) / stable for h in ("1e-4", "1e-2", "0.1")},
        **{f"forces below {f} of the mean": float((force < float(f) * force.mean()).mean()) for f in ("0.01", "0.1")},
        "<f^2> / <f>^2": float((force**2).mean() / force.mean() ** 2),
        "crystal score": float(results["crystal_score"]),
    }


def one(protocol, seed, folder):
    times, last = dict.fromkeys(PARTS, 0.0), time.process_time()

    def lap(part):
        nonlocal last
        now = time.process_time()
        times[part] += now - last
        last = now

    packing = protocols.begin(protocol, seed)
    lap("start")
    collisions = 0
    for stage in protocol["stages"]:
        given = dict(stage)
        collisions += getattr(packing, given.pop("verb"))(**given).collisions
    lap("growth")
    report = packing.crunch(**protocol["crunch"])
    lap("crunch")
    results = {name: getattr(packing, name)(**given) for name, given in protocol["analysis"].items()}
    lap("analysis")
    data = store.image(packing, analysis=results, protocol=protocols.to_json(protocol), protocol_id="bench")
    lap("image")
    write_file(folder / f"{seed}.h5", data, folder)
    lap("file")
    read = jam.load(folder / f"{seed}.h5")
    verdict = str(read.check())
    lap("check")
    return {
        "seed": seed,
        "seconds": times,
        "collisions": collisions,
        "factorisations": report.factorisations,
        "jammed": bool(report.jammed) and verdict.startswith("Collectively jammed"),
        "excess": report.excess_contacts,
        **statistics_of(packing, results, report),
    }


def measure(n, seeds, names, out):
    """Writes what there is after each seed, so that a run that was stopped is not lost."""
    runs = {name: [] for name in names}
    complete = {}
    for name in names:
        stages = [{"growth_rate": rate, "pressure": pressure} for rate, pressure in STAGES[name]]
        complete[name] = protocols.complete(dict(n=n, dim=3, stages=stages))
    with tempfile.TemporaryDirectory() as folder:
        one(complete[names[-1]], 1, Path(folder))  # all libraries are in memory now
        for seed in seeds:
            for name in names:
                runs[name].append(one(complete[name], seed, Path(folder)))
            out.write_text(json.dumps({"n": n, "runs": runs}, indent=1) + "\n", encoding="utf-8")


def compare(runs):
    """Mean and standard error of each quantity, and of the difference from the default over seeds."""
    mean = lambda x: (float(np.mean(x)), float(np.std(x, ddof=1) / np.sqrt(len(x))))
    by_seed = {run["seed"]: run for run in runs["default"]}
    rows = {}
    for name, of in runs.items():
        rows[name] = {}
        for key in of[0]:
            if isinstance(of[0][key], (int, float)) and key != "seed":
                values = np.array([float(r[key]) for r in of])
                base = np.array([float(by_seed[r["seed"]][key]) for r in of])
                rows[name][key] = [*mean(values), *mean(values - base)]
        for part in PARTS:
            rows[name][f"{part} (s)"] = float(np.mean([r["seconds"][part] for r in of]))
    return rows


def together(raws):
    """Results of several ranges of seeds as one."""
    runs = {name: [run for raw in raws for run in raw["runs"].get(name, [])] for name in raws[0]["runs"]}
    quantities = [k for k, v in runs["default"][0].items() if isinstance(v, float)]
    return {"n": raws[0]["n"], "quantities": quantities, "means": compare(runs), "runs": runs}


def draw(raw, picture):
    import matplotlib.pyplot as plt

    names = list(raw["means"])
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4), constrained_layout=True)
    at = np.zeros(len(names))
    for part, colour in zip(PARTS, ("#718096", "#2b6cb0", "#c05621", "#2f855a", "#d69e2e", "#805ad5", "#e53e3e")):
        width = np.array([raw["means"][name][f"{part} (s)"] for name in names])
        left.barh(names, width, left=at, color=colour, label=part)
        at += width
    left.invert_yaxis()
    left.set_xlabel(f"processor time of a packing (s), N = {raw['n']}")
    left.legend(fontsize=8)
    keys = [k for k in raw["means"]["default"] if k in raw["quantities"]]
    for name, marker in zip(names[1:], "osD^v<>"):
        values = [raw["means"][name][k] for k in keys]
        right.plot([v[2] / v[3] if v[3] else 0.0 for v in values], keys, marker, mfc="none", label=name)
    for x in (-2, 2):
        right.axvline(x, color="0.7", lw=0.8)
    right.set_xlabel("difference from the default over its standard error")
    right.legend(fontsize=7)
    figure.savefig(picture, dpi=130)


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--n", type=int, default=256)
    p.add_argument("--seeds", default="1,200", help="first, last")
    p.add_argument("--protocols", default=",".join(STAGES))
    p.add_argument("--out", type=Path, default=Path("ensemble.json"))
    p.add_argument("--more", type=Path, nargs="*", default=[], help="results of other seeds, to be drawn with these")
    p.add_argument("--picture", type=Path)
    o = p.parse_args()
    first, last = map(int, o.seeds.split(","))
    if not o.out.exists():
        measure(o.n, range(first, last + 1), o.protocols.split(","), o.out)
    raw = together([json.loads(path.read_text(encoding="utf-8")) for path in (o.out, *o.more)])
    for name, row in raw["means"].items():
        print(name, json.dumps(row))
    if o.picture:
        draw(raw, o.picture)


if __name__ == "__main__":
    main()
