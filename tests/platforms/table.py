#!/usr/bin/env python3
"""Makes tests/bench/results/platforms.json from what the scripts of this folder left in build-*/result.json.

usage: table.py [FOLDER]     where the builds are, the root of the tree by default
A platform that was not run now keeps its row, which names the commit that it was run at. Then `bindings/docs/figures.py ROOT` writes the page.
"""
import json
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "bindings/docs"))
import figures  # noqa: E402

COLUMNS = ["platform", "unit tests and tests of the C interface", "bits of dynamics", "bits of crunches", "files", "minutes",
           "commit"]
COMMAND = "sh tests/run.sh processors windows libcxx"
path = ROOT / "tests/bench/results/platforms.json"
rows = {row[0]: row for row in json.loads(path.read_text())["rows"]} if path.exists() else {}
for file in sorted(Path(sys.argv[1] if len(sys.argv) > 1 else ROOT).glob("build-*/result.json")):
    run = json.loads(file.read_text())
    tests = f"{run['passed']} of {run['tests']} pass" if run["tests"] else "not run"
    rows[run["platform"]] = [run["platform"], tests, run["md"], run["crunch"], run["files"], run["minutes"], run["commit"]]
figures.save(path, COMMAND, COLUMNS, [rows[name] for name in sorted(rows)])
