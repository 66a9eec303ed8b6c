#!/usr/bin/python3
"""Crunch time against force residual and against |phi_J - reference|, from the JSON of crunch_race.

usage: crunch_race.py RACE.json PICTURE.png
"""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

data = json.load(open(sys.argv[1]))
style = {
    ("barrier_path", 0): ("o", "C0", "barrier path, last LPs by interior point"),
    ("barrier_path", 1): ("*", "C0", "the same, polished"),
    ("sequential_lp", 0): ("s", "C1", "sequential LPs, interior point"),
    ("sequential_lp", 1): ("P", "C1", "the same, polished"),
    ("barrier_path, last LPs by Clp", 0): ("D", "C3", "barrier path, last LPs by Clp"),
}
figure, axes = plt.subplots(1, 2, figsize=(10, 4), sharey=True)
for key, (marker, colour, label) in style.items():
    rows = [r for r in data["rows"] if (r["method"], r["polish"]) == key]
    for axis, field in ((axes[0], "force_residual"), (axes[1], "phi_error")):
        axis.loglog(
            [max(r[field], 3e-16) for r in rows],
            [r["seconds"] for r in rows],
            marker,
            color=colour,
            label=label,
            ms=9,
            alpha=0.7,
        )
axes[0].set_xlabel("force residual / mean force")
axes[1].set_xlabel(r"$|\varphi_J - \varphi_{ref}|$ (at least 3e-16 drawn)")
axes[0].set_ylabel("seconds, one core")
axes[0].legend(fontsize=8)
axes[0].set_title(f"N = {data['n']}, d = {data['dim']}")
axes[1].set_title("gain tolerances 1e-5 ... 1e-12")
for axis in axes:
    axis.grid(alpha=0.3)
figure.tight_layout()
figure.savefig(sys.argv[2], dpi=110)
