"""Charts of the atlas, and the table of what digits cost."""
import json
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

STYLE = {
    "barrier path": ("C0", "o-"),
    "sequential LPs": ("C1", "s-"),
    "sequential LPs by Clp": ("C3", "s--"),
    "MD at G = 0.01": ("C2", "^:"),
    "MD at G = 0.001": ("C2", "^--"),
    "MD at G = 0.0003": ("C2", "^-"),
    "soft spheres, Newton": ("C4", "D-"),
    "soft spheres, FIRE": ("C4", "D:"),
}
PANELS = (
    ("error", r"$|\varphi_J - $limit$|$", 1e-17),
    ("wrong", "contacts missed or added", 0.5),
    ("residual", "residual of the force balance", 1e-17),
    ("force_error", "rms error of forces / mean force", 1e-17),
)


def value(point, key):
    if key == "wrong":
        return None if point["missed"] is None else point["missed"] + point["added"]
    return point[key]


def draw(data, folder):
    for n in data["sizes"]:
        draw_routes([r for r in data["routes"] if r["n"] == n], folder / f"atlas_{n}.png")
    draw_motion(data, folder / "atlas_motion.png")
    if "analysis" in data:
        source, chart = folder / "analysis.json", pathlib.Path(__file__).parents[1] / "analysis_chart.py"
        source.write_text(json.dumps(data["analysis"]), encoding="ascii")
        subprocess.run([sys.executable, chart, source, folder / "atlas_analysis.png"], check=True)


def draw_routes(mine, picture):
    starts = list(dict.fromkeys(r["start"] for r in mine))
    figure, axes = plt.subplots(
        len(PANELS), len(starts), figsize=(4 * len(starts), 12), sharex="col", sharey="row", squeeze=False
    )
    for column, start in enumerate(starts):
        for route in (r for r in mine if r["start"] == start):
            colour, line = STYLE[route["route"]]
            for axis, (key, _, least) in zip(axes[:, column], PANELS):
                points = [
                    (p["seconds"], max(value(p, key), least)) for p in route["points"] if value(p, key) is not None
                ]
                if points:
                    axis.loglog(*zip(*points), line, color=colour, ms=4, label=route["route"])
                stopped = [
                    (p["seconds"], max(value(p, key), least))
                    for p in route["points"]
                    if value(p, key) is not None and p["status"] != "ok"
                ]
                if stopped:
                    axis.loglog(*zip(*stopped), "x", color="k", ms=7)
        n = next(r["n"] for r in mine if r["start"] == start)
        axes[0, column].set_title(f"N = {n}, start: {start}")
        axes[-1, column].set_xlabel("processor seconds")
    for axis, (_, label, _) in zip(axes[:, 0], PANELS):
        axis.set_ylabel(label)
    for axis in axes.flat:
        axis.grid(alpha=0.3)
    figure.suptitle("Crosses: not certified, as the status says")
    figure.tight_layout(rect=(0, 0.03, 1, 1))
    drawn = {label: line for axis in axes[0] for line, label in zip(*axis.get_legend_handles_labels())}
    figure.legend(drawn.values(), drawn, loc="lower center", ncol=len(drawn), fontsize=9)
    figure.savefig(picture, dpi=80)


def draw_motion(data, picture):
    figure, axes = plt.subplots(1, len(data["motion"]), figsize=(5 * len(data["motion"]), 4), squeeze=False)
    for axis, fluid in zip(axes[0], data["motion"]):
        rows, best = fluid["rows"], fluid["rows"][-1]["mean"]
        seconds = [r["seconds"] for r in rows]
        axis.loglog(seconds, [r["scatter"] / best for r in rows], "o-", label="scatter of eight runs")
        axis.loglog(seconds, [r["reported"] / best for r in rows], "s--", label="error that libjam reports")
        off = abs(best - fluid["carnahan_starling"]) / best
        axis.axhline(off, color="grey", lw=0.8, label="Carnahan-Starling less the longest runs")
        axis.set(xlabel="processor seconds", title=f"packing fraction {fluid['fraction']:g}")
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    axes[0][0].set_ylabel("relative error of the pressure")
    figure.tight_layout()
    figure.savefig(picture, dpi=80)


def digits_table(routes):
    """For each start, the cheapest point whose phi_J is right to k digits, as Markdown."""
    lines = [
        "| N | start | digits of phi_J | take | seconds | contacts wrong | force residual |",
        "|---|---|---|---|---|---|---|",
    ]
    for n in dict.fromkeys(r["n"] for r in routes):
        for start in dict.fromkeys(r["start"] for r in routes if r["n"] == n):
            points = [
                (p["seconds"], f"{r['route']}, {p['setting']}", p)
                for r in routes
                if (r["n"], r["start"]) == (n, start)
                for p in r["points"]
                if p["error"] is not None
            ]
            last = None
            for digits in (3, 5, 8, 12, 15):
                right = [q for q in points if q[2]["error"] <= 0.5 * 10.0**-digits]
                if not right:
                    continue
                seconds, name, p = min(right, key=lambda q: q[0])
                if name == last:
                    lines[-1] = lines[-1].replace(
                        f"| {start} | {lines[-1].split('|')[3].strip()} |", f"| {start} | {digits} |"
                    )
                    continue
                last = name
                wrong = "" if p["missed"] is None else p["missed"] + p["added"]
                residual = "" if p["residual"] is None else f"{p['residual']:.0e}"
                lines.append(f"| {n} | {start} | {digits} | {name} | {seconds:.2g} | {wrong} | {residual} |")
    return "\n".join(lines) + "\n"
