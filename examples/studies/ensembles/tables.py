#!/usr/bin/env python3
"""All rows of results/*.json as a page of Markdown: published value, ours, error, errors between, and the command.

usage: tables.py [PAGE.md]     without PAGE.md the page is printed. The target `docs` makes a page of the site of it.
"""
import json
import sys
from pathlib import Path

HEAD = "| section | quantity | published | ours | error | errors between |\n|---|---|---|---|---|---|"
INTRO = """# All rows of the ensembles

Every row of `examples/studies/ensembles/results`. An empty error means that the quantity is a count or has no error over
packings. {known} of the rows have a published value.
"""


def text(value):
    return "" if value is None else value if isinstance(value, str) else f"{value:.4g}"


def page(folder):
    lines, known = [], 0
    for path in sorted(folder.glob("*.json")):
        found = json.loads(path.read_text(encoding="utf-8"))
        lines += [f"\n## {path.stem}\n", f"`{found['command']}`, commit {found['commit']}, {found['date']}\n", HEAD]
        for row in found["rows"]:
            cells = [row["figure"], row["quantity"].replace("|", "\\|")]
            lines.append("| " + " | ".join(cells + [text(row[k]) for k in ("published", "ours", "error", "sigma")]) + " |")
            known += row["published"] != "none"
    return INTRO.format(known=known) + "\n".join(lines) + "\n"


if __name__ == "__main__":
    made = page(Path(__file__).resolve().parent / "results")
    if len(sys.argv) > 1:
        Path(sys.argv[1]).write_text(made, encoding="utf-8")
    else:
        print(made)
