#!/usr/bin/env python3
"""What the store of an ensemble costs, and whether kills lose anything.

usage: ensemble_store.py [--kills 1000] [--entries 100000] [--out FILE.json]

overhead   seconds of image and file of one packing (N = 128, d = 3) over a task of one second, median of 21
listing    seconds of the table of so many entries with the index, and of reading one entry without it (median of 300)
kills      SIGKILLs of random workers amid a campaign of small packings; packings lost, half-read or written twice
"""
import argparse
import json
import os
import random
import shutil
import signal
import statistics
import tempfile
import threading
import time
from pathlib import Path

import jam
from jam import store
from jam._formats.write_packing import write_file
from jam.ensemble import Ensemble, LocalPool
from jam.ensemble import index
from jam.ensemble.folder import Place
from jam.ensemble.row import row_of

SMALL = dict(n=24, dim=2, diameters={"law": "bidisperse"}, stages=[{"growth_rate": 0.1, "pressure": 100.0}])


def overhead(folder):
    """Seconds beyond the physics of one packing."""
    system, results = jam.ensemble.make(jam.ensemble.complete(dict(n=128, dim=3)), 1)
    wall, processor = [], []
    for k in range(21):
        begin, cpu = time.perf_counter(), time.process_time()
        data = store.image(system, analysis=results)
        write_file(folder / f"{k}.h5", data)
        wall.append(time.perf_counter() - begin)
        processor.append(time.process_time() - cpu)
    return {"bytes": len(data), "wall": statistics.median(wall), "processor": statistics.median(processor)}


def listing(folder, entries):
    """One packing under many names: the table needs names, sizes and times only."""
    e = Ensemble(folder, SMALL)
    e.run([1], progress=False, workers=1)
    first = next(iter(e))
    with store.open_file(first.path) as file:
        row = row_of(file)
    rows = {}
    for seed in range(2, entries + 1):
        name = e.name(seed)
        if seed % 50000 == 2:  # a file may have 65000 names
            source = folder / f"{seed}.h5"
            shutil.copy2(first.path, source)
            stat = source.stat()
        os.link(source, e.files.packing(name))
        row["seed"], row["name"] = seed, name
        key, stamp = e.files.indexed(e.files.packing(name))
        rows[key] = stamp, row.tobytes()
    index.add(e.files.index, rows)
    begin, cpu = time.perf_counter(), time.process_time()
    table = e.table()
    warm = {"wall": time.perf_counter() - begin, "processor": time.process_time() - cpu, "entries": len(table)}
    cold = []
    for seed in range(2, 302):
        begin = time.process_time()
        e.files.row(Place(e.files.packing(e.name(seed))))
        cold.append(time.process_time() - begin)
    return {**warm, "seconds_an_entry_without_index": statistics.median(cold)}


def kills(folder, wanted):
    """Kills random workers until so many were killed; then finishes in peace and looks at every file."""
    e, done, seen = Ensemble(folder, SMALL), [0], {}
    with LocalPool(4) as pool:
        ended = threading.Event()

        def kill():
            while done[0] < wanted and not ended.wait(random.expovariate(20.0)):
                if done[0] % 50 == 0:
                    for found in e.files.scan()[0].items():
                        seen.setdefault(*found)
                if pids := pool.pids:
                    os.kill(random.choice(pids), signal.SIGKILL)
                    done[0] += 1

        thread = threading.Thread(target=kill)
        thread.start()
        while done[0] < wanted:
            e.run(range(4 * wanted), pool, progress=False, retry=True)
            if e.status(range(4 * wanted)).missing == 0 and e.status(range(4 * wanted)).failed == 0:
                break
        ended.set()
        thread.join()
        status = e.run(range(4 * wanted), pool, progress=False, retry=True)
    there = e.files.scan()[0]
    bad = sum(len(x.system().forces) == 0 for x in e)
    return {
        "kills": done[0],
        "done": status.done,
        "failed": status.failed,
        "finished_files_lost_or_changed": sum(there.get(k) != v for k, v in seen.items()),
        "unreadable": bad,
    }


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--kills", type=int, default=1000)
    p.add_argument("--entries", type=int, default=100000)
    p.add_argument("--out", type=Path)
    o = p.parse_args()
    made = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        made["overhead"] = overhead(folder)
        if o.entries:
            made["listing"] = listing(folder / "many", o.entries)
        if o.kills:
            made["kills"] = kills(folder / "kills", o.kills)
    text = json.dumps(made, indent=1)
    print(text)
    if o.out:
        o.out.write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
