#!/usr/bin/env python3
"""How fast a factorisation can get on more cores: list scheduling of its fronts with the times of one thread. JSON to stdout.

usage: task_graph.py FRONTS.json...      each from the program `fronts`

A front is a chain of stages: sums of its children, the halves of its panel, the product below, sums again. A stage is cut into
parts of at least half of `product` multiplications, or `additions` numbers, whatever the number of cores. Three plans:

    tree    every front is one task
    lists   subtrees of at most LIGHT of all work, the heaviest first to the core that is free; then the fronts above them one by
            one, each stage on all cores: what the library does
    queue   every part of every stage is a task, in one queue for the whole tree; the longest way to the root goes first

Parts of a stage take the same time. The speed of memory, which all cores share, does not count.
"""
import heapq
import json
import math
import sys

CORES = (2, 4, 8, 32)
DISPATCH = 5e-6  # seconds to hand a part to a waiting thread
WHOLE = 1e-3  # fronts that take less are one task
MOST = 4  # parts of a stage, ThreadTuning::most_parts: narrower ones take more time in all (tried.md)
LIGHT = 0.05  # SupernodeTuning::splits_subtree


def panel_stages(rows, columns, narrow):
    """(multiplications, can be cut) of factor_panel in src/linalg/dense_front.cpp"""
    if columns <= narrow:
        return [(columns**3 / 3, False), ((rows - columns) * columns**2, True)]
    left = (columns // 2 + narrow - 1) // narrow * narrow
    right = columns - left
    product = right * (rows - left - 0.5 * right) * left
    return [*panel_stages(rows, left, narrow), (product, True), *panel_stages(rows - left, right, narrow)]


def stages_of(data):
    """For each front the list of (seconds, parts)."""
    narrow, narrow_seconds = data["narrow"]
    fronts = data["fronts"]
    added = [0.0] * len(fronts)
    for parent, rows, columns, _, _ in fronts:
        if parent >= 0:
            added[parent] += (rows - columns) ** 2 / 2
    rest = data["seconds"] - sum(f[3] + f[4] for f in fronts)
    an_addition = rest / sum(added)
    out = []
    for (_, rows, columns, panel, square), numbers in zip(fronts, added):
        split = panel_stages(rows, columns, narrow)
        small = min(0.5 * panel, sum(m for m, cut in split if not cut) * narrow_seconds / (narrow**3 / 3))
        work = {cut: sum(m for m, c in split if c == cut) or 1.0 for cut in (False, True)}
        cut_in = lambda amount, least: min(MOST, max(1, math.ceil(amount / least)))  # noqa: E731
        chain = [(m / work[cut] * (panel - small if cut else small), cut_in(m, data["product"]) if cut else 1) for m, cut in split]
        chain.append((square, cut_in((rows - columns) ** 2 / 2 * columns, data["product"])))
        chain.append((numbers * an_addition, cut_in(numbers, data["additions"])))
        total = sum(seconds for seconds, _ in chain)
        out.append(chain if total > WHOLE else [(total, 1)])
    return out


def schedule(chains, parent, cores):
    """Time of list scheduling; chains[k]: the stages of front k."""
    ways = [0.0] * len(chains)  # from the start of a front to the end of the root
    for k in reversed(range(len(chains))):
        ways[k] = sum(s for s, _ in chains[k]) + (ways[parent[k]] if parent[k] >= 0 else 0.0)
    missing = [0] * len(chains)
    for p in parent:
        if p >= 0:
            missing[p] += 1
    ready, running, now, idle = [], [], 0.0, cores
    stage, open_parts = [0] * len(chains), [0] * len(chains)

    def begin(k):
        seconds, parts = chains[k][stage[k]]
        open_parts[k] = parts
        for _ in range(parts):
            heapq.heappush(ready, (-ways[k], k, seconds / parts + (DISPATCH if parts > 1 else 0.0)))

    for k, count in enumerate(missing):
        if count == 0:
            begin(k)
    while ready or running:
        while ready and idle:
            _, k, seconds = heapq.heappop(ready)
            idle -= 1
            heapq.heappush(running, (now + seconds, k))
        now, k = heapq.heappop(running)
        idle += 1
        open_parts[k] -= 1
        if open_parts[k]:
            continue
        ways[k] -= chains[k][stage[k]][0]
        stage[k] += 1
        if stage[k] < len(chains[k]):
            begin(k)
        elif parent[k] >= 0:
            missing[parent[k]] -= 1
            if missing[parent[k]] == 0:
                begin(parent[k])
    return now


def lists(chains, parent, cores):
    work, children = [sum(s for s, _ in chain) for chain in chains], [[] for _ in chains]
    whole = sum(work)
    for k, p in enumerate(parent):
        if p >= 0:
            work[p] += work[k]
            children[p].append(k)
    open_roots, light, time = [k for k, p in enumerate(parent) if p < 0], [], 0.0
    while open_roots:
        k = open_roots.pop()
        if work[k] < LIGHT * whole:
            light.append(work[k])
            continue
        open_roots += children[k]
        for seconds, parts in chains[k]:
            time += math.ceil(parts / cores) * (seconds / parts + (DISPATCH if parts > 1 else 0.0))
    loads = [0.0] * cores
    for seconds in sorted(light, reverse=True):
        loads[loads.index(min(loads))] += seconds
    return time + max(loads)


def main():
    rows = []
    for path in sys.argv[1:]:
        with open(path) as source:
            data = json.load(source)
        chains, parent = stages_of(data), [f[0] for f in data["fronts"]]
        whole = [[(sum(s for s, _ in chain), 1)] for chain in chains]
        one = sum(s for chain in chains for s, _ in chain)
        for cores in CORES:
            times = {
                "tree": schedule(whole, parent, cores),
                "lists": lists(chains, parent, cores),
                "queue": schedule(chains, parent, cores),
            }
            rows.append({"n": data["n"], "cores": cores, **{name: one / t for name, t in times.items()}})
    print(json.dumps({"rows": rows}, indent=1))


if __name__ == "__main__":
    main()
