#!/usr/bin/env python3
"""Writes the tables of figures into the Markdown pages, from results kept as JSON.

usage: figures.py ROOT            every page of the tree; prints the pages that changed
       figures.py ROOT --check    prints the pages that differ from what would be written; exit status 1 if there is one

A page marks the place of a table by two comments; what stands between them is replaced:

    <!-- figures results/crunch.json rows 1-3,7 + results/size.json; columns start, time --> <!-- end of figures -->

Files are relative to the page, or to the root with a leading `/`. Several of them with the same columns make one table.
A file of several results has each under its name: `results.json#finite_size rows 1-3`. Those of a script are what its
`made()` returns, {name: (columns, rows)}.
`<!-- figures machine -->` gives the machine of all results of the page, which must be the same.

A result has the keys machine (if it was recorded), commit, date, command, columns and rows. Where an older measurement is kept, commit and date
are those of the commit that published it. A cell is a text, a number (three digits are shown), a list, {"from", "to"} or
{"value", "error"}. A result without columns has those of `STORED`, and is shown with those of `STUDY`.
"""
import datetime
import fcntl
import json
import math
import os
import platform
import re
import runpy
import subprocess
import sys
from pathlib import Path

KEYS = ("machine", "commit", "date", "command", "columns", "rows")
BLOCK = re.compile(r"(<!-- figures ([^\n]*?) -->)(.*?)(<!-- end of figures -->)", re.S)
STORED = ["figure", "quantity", "published", "ours", "error", "sigma"]
STUDY = ["quantity", "published", "ours", "errors between"]


def made_by():
    """Machine, commit and date of a measurement that is made now, for the head of its result."""
    with open("/proc/cpuinfo", encoding="ascii") as file:
        model = next((line.split(":")[1].strip() for line in file if line.startswith("model name")), platform.machine())
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True).stdout.strip()
    return {"machine": f"{model}, {os.cpu_count()} cores", "commit": commit, "date": datetime.date.today().isoformat()}


def text_of(value, indent=""):
    """JSON, one member a line; of a list of rows each is a line."""
    if isinstance(value, dict):
        members = [f"{indent} {json.dumps(key)}: {text_of(item, indent + ' ')}" for key, item in value.items()]
        return "{\n" + ",\n".join(members) + f"\n{indent}}}"
    if isinstance(value, list) and value and isinstance(value[0], (list, dict)):
        return "[\n" + ",\n".join(f"{indent} {json.dumps(item, ensure_ascii=False)}" for item in value) + f"\n{indent}]"
    return json.dumps(value, ensure_ascii=False)


def save(path, command, columns, rows, source=None):
    """Writes a result into a file, or into FILE#NAME beside others. source: machine, commit and date; those of now by default."""
    result = {**(source or made_by()), "command": command, **({} if columns == STORED else {"columns": columns}), "rows": rows}
    file, _, name = str(path).partition("#")
    folder = os.open(os.path.dirname(file) or ".", os.O_RDONLY)
    fcntl.flock(folder, fcntl.LOCK_EX)  # two studies may end at once
    there = json.loads(Path(file).read_text(encoding="utf-8")) if name and os.path.exists(file) else {}
    found = dict(sorted({**there, name: result}.items())) if name else result
    Path(file + ".part").write_text(text_of(found) + "\n", encoding="utf-8")
    os.replace(file + ".part", file)
    os.close(folder)


def load(path):
    """The result of a file, or of FILE#NAME."""
    file, _, name = str(path).partition("#")
    if file.endswith(".py"):
        columns, rows = runpy.run_path(file)["made"]()[name]
        return {"machine": "that of each result", "commit": "", "date": "", "command": "", "columns": columns, "rows": rows}
    found = json.loads(Path(file).read_text(encoding="utf-8"))
    return {"machine": "not recorded", "columns": STORED, **(found[name] if name else found)}


def number(value, digits=3):
    if isinstance(value, int) or value == 0:
        return str(int(value))
    return re.sub(r"e([+-])0*", lambda m: "e" + m.group(1).replace("+", ""), f"{value:.{digits}g}")


def with_error(value, error):
    """0.64235(18): the error in units of the last digit, of which two are shown."""
    digits = max(0, 1 - math.floor(math.log10(error)))
    return f"{value:.{digits}f}({round(error * 10**digits)})"


def cell(value):
    if value is None:
        return ""
    if isinstance(value, str):
        return value.replace("|", "\\|")
    if isinstance(value, list):
        return ", ".join(map(cell, value))
    if isinstance(value, dict):
        if "error" in value:
            return with_error(value["value"], value["error"])
        low, high = cell(value["from"]), cell(value["to"])
        return low if low == high else f"{low} to {high}"
    return number(value)


def study_row(row):
    """A row of the columns STUDY from one of the columns STORED."""
    _, quantity, published, ours, error, sigma = row
    published = number(published, 6) if isinstance(published, float) else published
    return [quantity, "" if published == "none" else published, {"value": ours, "error": error} if error else number(ours, 4), sigma]


def read(path):
    result = load(path)
    if result["columns"] == STORED:
        result.update(columns=STUDY, rows=[study_row(row) for row in result["rows"]])
    missing = [key for key in KEYS if key not in result]
    if missing or any(len(row) != len(result["columns"]) for row in result["rows"]):
        raise SystemExit(f"{path}: {'no ' + missing[0] if missing else 'a row of another length'}")
    return result


def numbers(text):
    """Rows of `1-3,7`."""
    for part in text.split(","):
        first, _, last = part.partition("-")
        yield from range(int(first), int(last or first) + 1)


def table(parts, names):
    """Lines of one table of (result, row numbers) and of where it comes from; no row numbers: all rows."""
    columns = parts[0][0]["columns"]
    if any(result["columns"] != columns for result, _ in parts):
        raise SystemExit(f"results of different columns in one table: {', '.join(columns)}")
    unknown = [name for name in names if name not in columns]
    if unknown:
        raise SystemExit(f"no column {unknown[0]} among {', '.join(columns)}")
    kept = [columns.index(name) for name in names] or range(len(columns))
    lines = ["| " + " | ".join(columns[k] for k in kept) + " |", "|" + "---|" * len(kept)]
    for result, rows in parts:
        for i in rows or range(1, len(result["rows"]) + 1):
            lines.append("| " + " | ".join(cell(result["rows"][i - 1][k]) for k in kept) + " |")
    made = [f"`{r['command']}`, commit {r['commit']}, {r['date']}" for r, _ in parts if r["command"]]
    return lines + (["", "*" + "; ".join(dict.fromkeys(made)) + "*"] if made else [""])


def block(root, page, text):
    """The results and columns that a marker names."""
    files, _, columns = text.partition("; columns ")
    parts = []
    for part in files.split(" + "):
        name, _, rows = part.strip().partition(" rows ")
        path = root / name[1:] if name.startswith("/") else page.parent / name
        parts.append((read(path), list(numbers(rows)) if rows else None))
    return parts, [name.strip() for name in columns.split(",") if name.strip()]


def written(root, page, text):
    """The text of the page with its tables made anew."""
    machines = set()
    made = {}
    for found in BLOCK.finditer(text):
        if found.group(2) != "machine":
            parts, columns = block(root, page, found.group(2))
            machines |= {result["machine"] for result, _ in parts}
            made[found.start()] = table(parts, columns)

    def replaced(found):
        if found.group(2) != "machine":
            lines = made[found.start()]
        elif len(machines) == 1:
            lines = [f"Machine: {next(iter(machines))}."]
        else:
            raise SystemExit(f"{page}: results of several machines: {', '.join(sorted(machines))}")
        return found.group(1) + "\n" + "\n".join(lines) + " " + found.group(4)

    return BLOCK.sub(replaced, text)


def pages(root):
    listed = subprocess.run(["git", "-C", str(root), "ls-files", "*.md"], capture_output=True, text=True)
    names = listed.stdout.split() if listed.returncode == 0 else [str(p.relative_to(root)) for p in root.rglob("*.md")]
    return [root / name for name in names if not name.startswith("build") and (root / name).exists()]


def main():
    root, check = Path(sys.argv[1]).resolve(), "--check" in sys.argv[2:]
    different = []
    for page in pages(root):
        before = page.read_text(encoding="utf-8")
        if before.count("<!-- figures ") != len(BLOCK.findall(before)):
            raise SystemExit(f"{page}: a block of figures has no end")
        after = written(root, page, before)
        if after != before:
            different.append(page)
            if not check:
                page.write_text(after, encoding="utf-8")
    for page in different:
        print(f"{page.relative_to(root)}: " + ("its tables differ from the results" if check else "written"))
    sys.exit(check and bool(different))


if __name__ == "__main__":
    main()
