#!/usr/bin/env python3
"""Every own figure and table of the thesis in its order: picture, command, statistics there and here, values, verdict.

usage: thesis.py 2.15 3.3 ...    prints the commands of these figures, small ones and those that made the values, and the values; all: of
                                 every figure

bindings/docs/figures.py writes the lists of made() into the page, bindings/docs/site.py the values into a page of the site.

thesis.json lists what each figure shows and which rows of results.json and ensembles/results.json belong to it; no value of ours
stands there. `says` is what the page calls a value whose row has a shorter name. Verdicts: `reproduced`: the same size and comparable statistics, values agree; `smaller`: all panels, fewer or smaller
packings; `part`: panels are missing; `different`: done, and the values or curves differ, with a paragraph on the page that says why;
`missing`. A figure called reproduced or smaller whose rows differ by more than LIMIT errors is refused, unless it says why.
"""
import json
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parents[1] / "bindings/docs"))
import figures  # noqa: E402

COLUMNS = ["figure", "shows", "picture", "small", "large", "thesis", "here", "verdict"]
VALUES = ["figure", "quantity", "published", "ours", "errors between"]
VERDICTS = ("reproduced", "smaller", "part", "different", "missing")
LIMIT = 3.0
# The smallest run of each script that has all its panels; the others take a minute or two without options.
SMALL = {
    "both_sides.py": "--sizes 96 --particles 576",
    "complexity.py": "--sizes 32 64 128 --seeds 2",
    "estimators.py": "--sizes 64 128 --particles 600",
    "finite_size.py": "--sizes 64 128",
    "finite_size_panels.py": "--sizes 64 128",
    "gap_plateau.py": "PICTURE.png --n 64 --seeds 2",
    "growth_rate_table.py": "run TABLE.jsonl 64 2",
    "lp_noise.py": "--n 64",
    "lp_tolerance.py": "--n 100 --seeds 2",
    "motion_mc.py": "--n 128 --runs 20",
    "motion_md.py": "--n 128 --runs 20 --long-runs 5",
    "near_jamming_exponents.py": "RUNS --runs 20",
    "near_jamming_modes.py": "RUNS PICTURE.png --runs 20",
    "near_jamming_packings.py": "RUNS PICTURE.png --runs 20",
    "network_distributions.py": "PICTURE.png PACKINGS",
    "network_floppy_modes.py": "PICTURE.png 64 1",
    "network_products.py": "--n 64 --count 4",
    "path_to_jamming.py": "--n 64 --seeds 2 --kappas 1e-3",
    "sketches.py": "--disks 64 --spheres 64",
}
# Of them those of a few seconds, from which the tests choose.
SECONDS = (
    "complexity.py",
    "finite_size_panels.py",
    "lp_noise.py",
    "network_floppy_modes.py",
    "network_products.py",
    "path_to_jamming.py",
)
FIGURES, TABLES = 63, 2


def cells(value):
    """(quantity, published, ours, errors between, command) of one reference to a result."""
    result = figures.load(HERE / value["from"])
    if "quantity" in value:
        rows = [row for row in result["rows"] if row[1] == value["quantity"]]
        if len(rows) != 1:
            raise SystemExit(f"{value['from']}: {len(rows)} rows are called {value['quantity']!r}")
        _, published, ours, sigma = figures.study_row(rows[0])
        return value["quantity"], value.get("published", published), figures.cell(ours), sigma, result["command"]
    column = result["columns"].index(value["column"])
    found = result["rows"][value["row"] - 1]
    first = [row[0] for row in result["rows"]]
    which = figures.cell(found[0])
    if first.count(found[0]) > 1:
        which += f", {result['columns'][1]} = {found[1]}"
    ours, quantity = found[column], f"{value['column']}, {which}"
    published, sigma = value["published"], None
    if isinstance(published, (int, float)):
        number, error = value_error(ours)
        sigma = round(abs(number - published) / error, 1) if error else None
    shown = published if isinstance(published, str) else f"{published:g}"
    return quantity, shown, figures.cell(ours), sigma, result["command"]


def value_error(text):
    """Value and standard error of a cell: {value, error}, 0.64235(18) or 0.503 +- 0.087."""
    if isinstance(text, dict):
        return text["value"], text["error"]
    found = re.match(r"(-?\d+\.?(\d*))(?:\((\d+)\)| \+- (\d+\.\d+))", str(text))
    if not found:
        return float(text), None
    error = float(found.group(4)) if found.group(4) else int(found.group(3)) / 10 ** len(found.group(2))
    return float(found.group(1)), error


def commands(entry):
    """{large: small}: the commands that made the values of a figure, and the small ones."""
    found = {}
    for value in entry["values"]:
        large = figures.load(HERE / value["from"])["command"]
        name, *options = large.split()
        model = " --model mk" if "mk" in options else ""
        found[large] = " ".join([name, *SMALL.get(name, "").split()]) + model
    return found


def runnable(command):
    """The command from the root of the checkout; scripts of ensembles write into studies, the others where PICTURE.png is."""
    name, *options = command.split()
    folder = "examples/studies" + "/ensembles" * (HERE / "ensembles" / name).is_file()
    return " ".join(["python3", f"{folder}/{name}", *options])


def row(entry):
    """The figure's row, and a row for each of its values."""
    name = entry["figure"]
    if entry["verdict"] not in VERDICTS:
        raise SystemExit(f"{name}: no verdict {entry['verdict']}")
    found = [cells(value) for value in entry["values"]]
    missing = [key for key in ("shows", "thesis", "here") if not entry[key]]
    if missing or (not found and entry["verdict"] != "missing") or not (HERE / entry["picture"]).is_file():
        raise SystemExit(f"{name}: no {missing[0] if missing else 'value or picture'}")
    off = [sigma for *_, sigma, _ in found if sigma is not None]
    if entry["verdict"] in ("reproduced", "smaller") and any(s > LIMIT for s in off) and "because" not in entry:
        raise SystemExit(f"{name} is called {entry['verdict']}, but {max(off)} errors lie between")
    large = commands(entry)
    picture = f"[picture]({entry['picture']})"
    how = ["; ".join(f"`{c}`" for c in dict.fromkeys(which)) for which in (large.values(), large)]
    verdict = entry["verdict"] + (f": {entry['because']}" if "because" in entry else "")
    shown = [value.get("says", quantity) for value, (quantity, *_) in zip(entry["values"], found)]
    values = [[name, quantity] + [str(x) if str(x) != "None" else "" for x in numbers] for quantity, (_, *numbers, _) in zip(shown, found)]
    return [name, entry["shows"], picture, *how, entry["thesis"], entry["here"], verdict], values


def made():
    """{name: (columns, rows)} of the three tables."""
    entries = json.loads((HERE / "thesis.json").read_text(encoding="utf-8"))
    made_rows = [row(e) for e in entries]
    rows, values = [first for first, _ in made_rows], [line for _, lines in made_rows for line in lines]
    tables = [e for e in entries if e["figure"].startswith("table")]
    if len(entries) - len(tables) != FIGURES or len(tables) != TABLES:
        raise SystemExit(f"{len(entries) - len(tables)} figures and {len(tables)} tables, {FIGURES} and {TABLES} are wanted")
    counts = []
    for verdict in VERDICTS:
        these = [e for e in entries if e["verdict"] == verdict]
        of_tables = sum(e in tables for e in these)
        counts.append([verdict, len(these) - of_tables, of_tables, ", ".join(e["figure"] for e in these)])
    of_verdicts = ["verdict", "figures", "tables", "which"], counts
    return {"thesis": (COLUMNS, rows), "thesis_values": (VALUES, values), "thesis_verdicts": of_verdicts}


def printed(wanted):
    """The commands of the figures wanted, one a line, and their values: published, ours, errors between."""
    entries = json.loads((HERE / "thesis.json").read_text(encoding="utf-8"))
    unknown = set(wanted) - {e["figure"] for e in entries} - {"all"}
    if unknown:
        raise SystemExit(f"no figure {', '.join(sorted(unknown))}")
    for entry in entries:
        if entry["figure"] in wanted or "all" in wanted:
            for large, small in commands(entry).items():
                print(f"{entry['figure']}\tsmall\t{runnable(small)}\n{entry['figure']}\tlarge\t{runnable(large)}")
            for line in row(entry)[1]:
                print(line[0], "value", *line[1:], sep="\t")


if __name__ == "__main__":
    printed(sys.argv[1:])
