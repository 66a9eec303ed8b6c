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
packings. {known} of the {all} rows have a published number and an error: {one} of them agree within one error, {two} within
two, and {far} differ by more than three. Published texts, such as a law of other packings, an exact or a nominal value, are
not counted. Most large differences are those of estimators that neglect corrections; their causes are on
[the page of the ensembles](/examples/studies/ensembles/README.md).
"""


def text(value):
    return "" if value is None else value if isinstance(value, str) else f"{value:.4g}"


def page(folder):
    lines, off, rows = [], [], 0
    for path in sorted(folder.glob("*.json")):
        found = json.loads(path.read_text(encoding="utf-8"))
        lines += [f"\n## {path.stem}\n", f"`{found['command']}`, commit {found['commit']}, {found['date']}\n", HEAD]
        for row in found["rows"]:
            cells = [row["figure"], row["quantity"].replace("|", "\\|")]
            lines.append("| " + " | ".join(cells + [text(row[k]) for k in ("published", "ours", "error", "sigma")]) + " |")
            rows += 1
            if not isinstance(row["published"], str) and row["sigma"] is not None:
                off.append(row["sigma"])
    one, two, far = (sum(test(s) for s in off) for test in (lambda s: s <= 1, lambda s: s <= 2, lambda s: s > 3))
    intro = INTRO.format(known=len(off), all=rows, one=one, two=two, far=far)
    return intro + "\n".join(lines) + "\n"


if __name__ == "__main__":
    made = page(Path(__file__).resolve().parent / "results")
    if len(sys.argv) > 1:
        Path(sys.argv[1]).write_text(made, encoding="utf-8")
    else:
        print(made)
