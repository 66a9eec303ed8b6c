#!/usr/bin/python3
"""Memory and time that `jam_estimate_crunch` gives before a crunch, against what the crunch takes.

usage: estimate.py OUT.json [PICTURE.png]

Each scene runs in a process of its own. Memory: how far the process's peak rises during the crunch. Time: of the processor
on one thread, of the clock on two. A scene that is in the JSON already is not made again. PYTHONPATH: the built module.
"""
import json
import os
import pathlib
import resource
import subprocess
import sys
import time

SLOW, FAST = [(1e-2, 500.0), (1e-3, 1e6)], [(1e-2, 500.0)]
# d, N, stages, threads, options of the crunch
SCENES = (
    [(3, n, SLOW, 1, {}) for n in (512, 1024, 2048, 4096)]
    + [(3, n, SLOW, 2, {}) for n in (2048, 4096)]
    + [(3, 4096, SLOW, threads, dict(duality_gap=1e-7)) for threads in (1, 2)]
    + [(3, n, FAST, 1, {}) for n in (1024, 2048)]
    + [(3, n, [], 1, {}) for n in (1024, 2048)]
    + [(3, 1024, SLOW, 1, dict(method="sequential_lp"))]
    + [(4, 1024, SLOW, 1, {}), (5, 512, FAST, 1, {})]
)
SEEDS = (1, 2, 3)


def measure(dim, n, stages, threads, options, seed):
    import jam

    jam.System.random(200, 3, 1).crunch()  # code and buffers of all libraries are in memory now
    packing = jam.System.random(n, dim, seed)
    if stages:
        packing.compress(stages)
    estimate = packing.estimate_crunch(threads=threads, **options)
    with open("/proc/self/statm", encoding="ascii") as file:
        before = int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    clock = time.process_time if threads == 1 else time.perf_counter
    began = clock()
    report = packing.crunch(threads=threads, **options)
    return dict(
        seconds=clock() - began,
        bytes=1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before,
        factorisations=report.factorisations,
        stop_reason=report.stop_reason.name.lower(),
        estimated_seconds=estimate.seconds,
        estimated_bytes=estimate.bytes,
        estimated_factorisations=estimate.factorisations,
    )


def draw(rows, picture):
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(9, 4.2))
    kinds = (
        ("slowly grown", lambda r: r["scene"][2] == [list(stage) for stage in SLOW]),
        ("grown to p = 500", lambda r: r["scene"][2] == [list(stage) for stage in FAST]),
        ("random", lambda r: not r["scene"][2]),
    )
    for axis, field, unit, label in ((axes[0], "bytes", 1e-6, "MB"), (axes[1], "seconds", 1.0, "seconds")):
        for name, belongs in kinds:
            mine = [r for r in rows if belongs(r)]
            axis.loglog(
                [unit * r[field] for r in mine], [unit * r["estimated_" + field] for r in mine], "o", ms=4, alpha=0.6, label=name
            )
        ends = axis.get_xlim()
        axis.loglog(ends, ends, "k-", lw=1)
        axis.fill_between(ends, [x / 1.3 for x in ends], [1.3 * x for x in ends], color="k", alpha=0.1, label="within 30 %")
        axis.set(xlabel=f"{label} taken", ylabel=f"{label} estimated", xlim=ends)
        axis.legend(fontsize=8)
        axis.grid(alpha=0.3, which="both")
    figure.tight_layout()
    figure.savefig(picture, dpi=100)


def main():
    if sys.argv[1] == "--measure":
        print(json.dumps(measure(*json.loads(sys.argv[2]))))
        return
    out = pathlib.Path(sys.argv[1])
    rows = json.loads(out.read_text(encoding="ascii")) if out.exists() else []
    known = [(r["scene"], r["seed"]) for r in rows]
    for scene in SCENES:
        scene = json.loads(json.dumps(scene))
        for seed in SEEDS:
            if (scene, seed) in known:
                continue
            asked = json.dumps([*scene, seed])
            found = subprocess.run([sys.executable, __file__, "--measure", asked], check=True, capture_output=True).stdout
            rows.append(dict(scene=scene, seed=seed, **json.loads(found)))
            row = rows[-1]
            print(
                asked,
                f"memory {row['estimated_bytes'] / row['bytes']:.2f}",
                f"time {row['estimated_seconds'] / row['seconds']:.2f}",
                f"factorisations {row['estimated_factorisations']:.0f} and {row['factorisations']}",
                row["stop_reason"],
                flush=True,
            )
            out.write_text(json.dumps(rows, indent=0), encoding="ascii")
    if len(sys.argv) > 2:
        draw(rows, sys.argv[2])


if __name__ == "__main__":
    main()
