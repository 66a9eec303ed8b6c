#!/usr/bin/env python3
"""Tables of README.md from results/*.json: published value, ours, error, sigma between, and the command that makes the row.

usage: tables.py [--write]     without --write they are printed; the last line counts rows with a published figure
"""
import json
import sys

from common import HERE

MARK = "## Tables\n"
HEAD = "| section | quantity | published | ours | error | sigma | command |\n|---|---|---|---|---|---|---|"


def text(value):
    return "" if value is None else value if isinstance(value, str) else f"{value:.4g}"


def tables():
    lines, known = [], 0
    for path in sorted((HERE / "results").glob("*.json")):
        found = json.loads(path.read_text(encoding="utf-8"))
        lines += [f"\n### {path.stem}\n", HEAD]
        for row in found["rows"]:
            cells = [row["figure"], row["quantity"].replace("|", "\\|")]
            cells += [text(row[k]) for k in ("published", "ours", "error", "sigma")] + [f"`{found['command']}`"]
            lines.append("| " + " | ".join(cells) + " |")
            known += row["published"] != "none"
    return "\n".join(lines) + "\n", known


made, known = tables()
if "--write" in sys.argv[1:]:
    page = HERE / "README.md"
    before = page.read_text(encoding="utf-8").split(MARK)[0]
    intro = (
        f"All rows come from `results/*.json`, which also hold protocols and numbers of packings. {known} have a published value.\n"
        "An empty error means that the quantity is a count or has no error over packings. Write them anew with `tables.py --write`.\n"
    )
    page.write_text(before + MARK + "\n" + intro + made, encoding="utf-8")
else:
    print(made)
print(f"{known} rows with a published value")
