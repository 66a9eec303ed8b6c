#!/usr/bin/env python3
"""Prints the tables of README.md from results/*.json: published value, ours, error, sigma between.  usage: tables.py"""
import json

from common import HERE


def text(value):
    return "" if value is None else value if isinstance(value, str) else f"{value:.4g}"


for path in sorted((HERE / "results").glob("*.json")):
    found = json.loads(path.read_text(encoding="utf-8"))
    print(f"\n### {path.stem}\n\n| section | quantity | published | ours | error | sigma |\n|---|---|---|---|---|---|")
    for row in found["rows"]:
        cells = [row["figure"], row["quantity"].replace("|", "\\|")]
        print("| " + " | ".join(cells + [text(row[k]) for k in ("published", "ours", "error", "sigma")]) + " |")
