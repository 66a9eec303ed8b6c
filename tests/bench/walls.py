#!/usr/bin/env python3
"""What walls cost: collisions and a crunch in a slit, box, tube and ball beside the periodic cube, and the errors reached.

python3 tests/bench/walls.py [--sizes 256,1024] [--scenes cube,slit] [--seeds 3] [--seconds 600] [--equal] [--out walls.json] [--picture walls.png]
Half of the spheres are 1.4 times as wide: equal ones crystallise at flat walls (--equal). Collisions at packing fraction
0.45, scene after scene; then growth with G = 1e-2 to p = 1e4 and a crunch. Processor time, one thread. Errors of a crunch:
largest force residual, and the largest |h| of a contact. --draw FILE draws results.
Last the edge: scenes that cannot be made or jammed, and the answer.
"""
import argparse
import json
import statistics
import time
from pathlib import Path

import jam
import numpy as np

SCENES = {
    "cube": {},
    "slit": {"walls": "z"},
    "box": {"walls": "xyz"},
    "tube": {"container": "cylinder"},
    "ball": {"container": "ball"},
}
COLOURS = dict(zip(SCENES, ("#555555", "#2b6cb0", "#2f855a", "#c05621", "#805ad5")))
EDGES = [
    ("tube narrower than a sphere", {"n": 4, "packing_fraction": 0.5, "container": "cylinder", "cell": [0.2, 0.2, 4]}),
    ("slit narrower than a sphere", {"n": 4, "packing_fraction": 0.5, "walls": "z", "cell": [1, 1, 0.2]}),
    ("one sphere in a ball", {"n": 1, "packing_fraction": 0.2, "container": "ball"}),
    ("as wide as the tube: one row of spheres", {"n": 3, "packing_fraction": 0.2, "container": "cylinder", "cell": [1, 1, 3]}),
    ("six disks in a circle, ending around a seventh place", {"n": 6, "dim": 2, "packing_fraction": 0.2, "container": "ball", "seed": 1}),
    ("denser than spheres fit at random", {"n": 500, "packing_fraction": 0.6, "walls": "z"}),
]


def started(scene, n, seed, equal):
    sizes = {} if equal else {"diameters": np.where(np.arange(n) % 2, 1.4, 1.0)}
    return jam.System.random(n, seed=seed, packing_fraction=0.2, **sizes, **SCENES[scene])


def collisions(scenes, n, equal, rounds=5):
    """Microseconds of processor time a collision: medians over rounds, in each of which every scene runs."""
    systems = {}
    for scene in scenes:
        systems[scene] = started(scene, n, 1, equal)
        systems[scene].compress(growth_rate=1e-2, packing_fraction=0.45)
        systems[scene].run(collisions_per_particle=20)
    taken = {scene: [] for scene in scenes}
    for _ in range(rounds):
        for scene, s in systems.items():
            begin = time.process_time()
            made = s.run(collisions_per_particle=max(20, 100000 // n)).collisions
            taken[scene].append(1e6 * (time.process_time() - begin) / made)
    return {scene: statistics.median(values) for scene, values in taken.items()}


def crunched(scene, n, seed, equal, seconds):
    s = started(scene, n, seed, equal)
    begin = time.process_time()
    s.compress(growth_rate=1e-2, pressure=1e4, wall_time=seconds)
    grown = time.process_time() - begin
    begin = time.process_time()
    r = s.crunch(wall_time=seconds)
    return {
        "scene": scene, "n": n, "seed": seed, "growth_seconds": grown, "crunch_seconds": time.process_time() - begin,
        "factorisations": r.factorisations, "jammed": bool(r.jammed), "packing_fraction": r.packing_fraction,
        "contacts": r.contacts, "excess": r.excess_contacts, "force_residual": r.force_residual, "max_contact_gap": r.max_contact_gap,
    }  # fmt: skip


def edge(given):
    try:
        s = jam.System.random(**given)
        r = s.crunch(wall_time=60)
        return "jammed" if r.jammed else f"not jammed: {s.status}"
    except (jam.errors.JamError, ValueError) as error:
        return f"refused: {error}"


def draw(found, path):
    import matplotlib.pyplot as plt

    fig, axes = plt.subplots(1, 3, figsize=(12, 3.8), constrained_layout=True)
    for scene, colour in COLOURS.items():
        rate = sorted((int(n), of[scene]) for n, of in found["collisions"].items() if scene in of)
        axes[0].plot(*zip(*rate), "o-", ms=4, color=colour, label=scene)
        runs = [r for r in found["crunches"] if r["scene"] == scene]
        sizes = sorted({r["n"] for r in runs})
        time_of = [statistics.median(r["crunch_seconds"] for r in runs if r["n"] == n) for n in sizes]
        axes[1].plot(sizes, time_of, "o-", ms=4, color=colour)
        done = [r for r in runs if r["jammed"]]
        axes[2].plot([r["crunch_seconds"] for r in done], [r["force_residual"] for r in done], "o", ms=4, color=colour)
        axes[2].plot([r["crunch_seconds"] for r in done], [r["max_contact_gap"] for r in done], "x", ms=4, color=colour)
    axes[0].set(xscale="log", ylim=(0, None), xlabel="N", ylabel="microseconds a collision")
    axes[1].set(xscale="log", yscale="log", xlabel="N", ylabel="seconds of the crunch")
    axes[2].set(xscale="log", yscale="log", xlabel="seconds of the crunch", ylabel="error", ylim=(1e-17, 1e-11))
    axes[2].plot([], [], "o", color="0.5", ms=4, label="forces, over their mean")
    axes[2].plot([], [], "x", color="0.5", ms=4, label="gaps of contacts")
    axes[0].legend(frameon=False)
    axes[2].legend(frameon=False)
    for a in axes[:2]:
        ticks = sorted({r["n"] for r in found["crunches"]})
        a.set_xticks(ticks, [str(n) for n in ticks])
        a.minorticks_off()
    for a in axes:
        a.grid(alpha=0.3)
    fig.savefig(path, dpi=100)


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--sizes", type=lambda t: [int(x) for x in t.split(",")], default=[256, 512, 1024])
    p.add_argument("--scenes", type=lambda t: t.split(","), default=list(SCENES))
    p.add_argument("--seeds", type=int, default=3)
    p.add_argument("--equal", action="store_true")
    p.add_argument("--seconds", type=float, default=1800)
    p.add_argument("--out", type=Path, default=Path("walls.json"))
    p.add_argument("--picture", type=Path)
    p.add_argument("--draw", type=Path, nargs="+", help="only draw these results")
    o = p.parse_args()
    if o.draw:
        found = {"collisions": {}, "crunches": []}
        for part in (json.loads(path.read_text()) for path in o.draw):
            found["crunches"] += part["crunches"]
            for n, of in part["collisions"].items():
                found["collisions"].update({n: {**of, **found["collisions"].get(n, {})}})
        return draw(found, o.picture)
    found = {"collisions": {}, "crunches": [], "edges": []}
    for n in o.sizes:
        found["collisions"][str(n)] = collisions(o.scenes, n, o.equal)
        print(n, found["collisions"][str(n)], flush=True)
        for seed in range(1, o.seeds + 1):
            for scene in o.scenes:
                found["crunches"].append(crunched(scene, n, seed, o.equal, o.seconds))
                print(found["crunches"][-1], flush=True)
                o.out.write_text(json.dumps(found, indent=1) + "\n")
    for name, given in EDGES:
        found["edges"].append([name, edge(given)])
        print(found["edges"][-1], flush=True)
    o.out.write_text(json.dumps(found, indent=1) + "\n")
    if o.picture:
        draw(found, o.picture)


main()
