#!/usr/bin/env python3
"""Collisions a second of fluids of unequal spheres beside equal ones: against the ratio of two sizes, and against the spread of many.

python3 tests/bench/mixtures.py [--n 4000] [--dims 2,3] [--seconds 1] [--rounds 5] [--out mixtures.json] [--picture mixtures.png]
Constant volume, packing fraction 0.5 in d = 3 and 0.68 in d = 2. Two sizes fill the same volume each; log-normal diameters
are quantiles of the law. Processor time, one thread; all scenes take turns, and a rate is compared with that of equal
spheres in the same round.
"""
import argparse
import json
import statistics
import time
from pathlib import Path

import jam
import numpy as np

FRACTION = {2: 0.68, 3: 0.5}
RATIOS = (1.2, 1.4, 2, 3, 4, 6, 10)
DEVIATIONS = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6)


def scenes(n, d):
    yield "equal", 1.0, None
    for ratio in RATIOS:
        large = max(2, round(n / (ratio**d + 1)))
        yield "two sizes", ratio, np.r_[np.full(large, ratio), np.ones(n - large)]
    for deviation in DEVIATIONS:
        yield "log-normal", deviation, jam.sizes("lognormal", n, deviation=deviation, draw="quantiles")


def fluid(n, d, diameters):
    given = {} if diameters is None else {"diameters": diameters}
    s = jam.System.random(n, d, 1, packing_fraction=0.2 if d == 3 else 0.3, **given)
    s.compress(growth_rate=0.1, pressure=1e12, packing_fraction=FRACTION[d])
    s.run(collisions_per_particle=20)
    return s


def measure(n, d, seconds, rounds):
    rows = [{"d": d, "n": n, "law": law, "value": value, "rates": [], "over_equal": [], "system": fluid(n, d, sizes)} for law, value, sizes in scenes(n, d)]
    lengths = {}
    for turn in range(rounds + 1):
        for k, row in enumerate(rows):
            begin = time.process_time()
            report = row["system"].run(collisions_per_particle=lengths.get(k, 5.0))
            rate = report.collisions / (time.process_time() - begin)
            if turn == 0:  # how long a round is
                lengths[k] = max(5.0, round(rate * seconds / n))
                continue
            row["rates"].append(rate)
            row["over_equal"].append(rate / rows[0]["rates"][-1])
    for row in rows:
        del row["system"]
        row["rate"], row["ratio"] = statistics.median(row["rates"]), statistics.median(row["over_equal"])
        print(d, row["law"], row["value"], f"{row['rate'] / 1e6:.2f} M/s, {row['ratio']:.2f}", flush=True)
    return rows


def draw(rows, path):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(9, 3.6), constrained_layout=True, sharey=True)
    for axis, law, label in zip(axes, ("two sizes", "log-normal"), ("ratio of the two diameters", "relative deviation of log-normal diameters")):
        for d, colour in ((2, "#2b6cb0"), (3, "#c05621")):
            mine = [r for r in rows if r["d"] == d and r["law"] in ("equal", law)]
            x = [(1.0 if law == "two sizes" else 0.0) if r["law"] == "equal" else r["value"] for r in mine]
            y = [r["rate"] / 1e6 for r in mine]
            low = [v - min(r["rates"]) / 1e6 for v, r in zip(y, mine)]
            high = [max(r["rates"]) / 1e6 - v for v, r in zip(y, mine)]
            axis.errorbar(x, y, yerr=(low, high), fmt="o-", color=colour, mfc="white", capsize=2, label=f"d = {d}, packing fraction {FRACTION[d]}")
        axis.set(xlabel=label, ylim=(0, None))
        axis.grid(alpha=0.3)
    axes[0].set(xscale="log", xticks=[1, 2, 4, 10], xticklabels=["1", "2", "4", "10"], ylabel="million collisions a second")
    axes[0].minorticks_off()
    axes[1].legend(fontsize=8)
    figure.savefig(path, dpi=110)


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--n", type=int, default=4000)
    p.add_argument("--dims", type=lambda t: [int(x) for x in t.split(",")], default=[2, 3])
    p.add_argument("--seconds", type=float, default=1.0, help="of a scene in a round")
    p.add_argument("--rounds", type=int, default=5)
    p.add_argument("--out", type=Path, default=Path("mixtures.json"))
    p.add_argument("--picture", type=Path)
    o = p.parse_args()
    if not o.out.exists():
        rows = [row for d in o.dims for row in measure(o.n, d, o.seconds, o.rounds)]
        o.out.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    if o.picture:
        draw(json.loads(o.out.read_text(encoding="utf-8")), o.picture)


if __name__ == "__main__":
    main()
