#!/usr/bin/python3
"""What decompressions leave open of 50 packings of 1000 equal disks, against the time of a crunch.

usage: decompressions_chart.py RAW.jsonl PICTURE.png     RAW: what `ablation ... disks1000` printed
"""
import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from results import DECOMPRESSIONS

def main(raw, picture):
    runs = [json.loads(line) for line in Path(raw).read_text(encoding="utf-8").splitlines()]
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), constrained_layout=True)
    for (off, label), marker in zip(DECOMPRESSIONS.items(), "osD^vP"):
        of = [r for r in runs if r["off"] == off]
        if not of:
            continue
        seconds = np.sort([r["seconds"] for r in of])
        open_share = 1 - np.mean([r["jammed"] for r in of])
        error = np.sqrt((open_share + 1 / len(of)) * (1 - open_share) / len(of))
        left.errorbar(seconds.mean(), open_share, error, fmt=marker, capsize=3, label=label)
        right.step(seconds, 1 - np.arange(1, len(of) + 1) / len(of), where="post", label=label)
    left.set(xlabel="mean processor time of a crunch (s)", ylabel="share not shown to be jammed")
    left.set_xlim(left=0), left.set_ylim(bottom=0)
    right.set(xscale="log", xlabel="processor time (s)", ylabel="share of crunches that take longer")
    left.legend(title="diameters decrease by", fontsize=8)
    figure.savefig(picture, dpi=120)


if __name__ == "__main__":
    main(*sys.argv[1:])
