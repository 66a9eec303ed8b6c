#!/usr/bin/env python3
"""Seconds that lab.html takes in Chromium: from its start to a packing of 1024 spheres, and to the verdict on a file of it.
Processor seconds of the page with its worker, which decide, and seconds of the clock.

usage: page_times.py LAB [--n 1024]     status 1 where a packing takes more than 12 s, or a verdict more than 3 s
"""
import argparse
import json
import os
import pathlib
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "bindings"))
LIMITS = {"make": 12, "verdict": 3}  # s


def measured(lab, work):
    def used():
        return sum(p["cpuTime"] for p in lab.page.processes() if p["type"] == "renderer")

    cpu, clock = used(), time.monotonic()
    work()
    return {"processor": round(used() - cpu, 2), "clock": round(time.monotonic() - clock, 2)}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("lab")
    parser.add_argument("--n", type=int, default=1024)
    args = parser.parse_args()
    os.environ["JAM_LAB"] = args.lab
    import browser
    import lab_page

    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder)
        lab = lab_page.Lab(browser, place)
        times = {"make": measured(lab, lambda: lab.make({"n": args.n, "dim": 3, "seed": 1}))}
        said, path = lab.text("status"), place / "file.xyz"
        path.write_bytes(lab.saved("save-xyz", "packing.xyz"))
        lab.page.new_tab()  # a page that has compiled nothing yet
        lab.open()
        times["verdict"] = measured(lab, lambda: lab.give("file", path))
        print(json.dumps({"n": args.n, **times, "said": [said, lab.text("verdict")]}, indent=1))
        lab.page.close()
    sys.exit(any(times[name]["processor"] > most for name, most in LIMITS.items()))


if __name__ == "__main__":
    main()
