"""The atlas of speed against accuracy: every route to the jamming point from the same starts, analyses, and pressure.

usage: python3 tests/bench/atlas FOLDER [--sizes 1024,4096] [--only-draw] [--analysis build/tests/bench/analysis] [--scenes]

Writes atlas.json, its charts and digits.md (what so many digits of phi_J cost) into FOLDER; 27 to 30 minutes on one core.
--scenes measures three other scenes instead: a slit, a tube and disks of ratio 50, into scenes.json, atlas_scenes.png and
scenes.md; ten minutes. Times are processor times. What atlas.json holds already is not measured again, so a killed atlas goes on. PYTHONPATH: the
built module.
"""
import argparse
import json
import pathlib
import subprocess
import sys

import jam
import numpy as np

import charts
import motion
import routes

sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))
from grown import grown

STARTS = {
    "random": None,
    "p = 500": [(1e-2, 500.0)],
    "p = 1e5": [(1e-2, 500.0), (3e-3, 1e5)],
    "p = 1e7": [(1e-2, 500.0), (3e-3, 1e7)],
}
# Half of the spheres are 1.4 times as wide: equal ones form layers at flat walls. The one disk of ratio 50 has the area of
# 2500 of the others.
MIXTURE = np.where(np.arange(1024) % 2, 1.4, 1.0)
SCENES = {
    "slit": dict(n=1024, diameters=MIXTURE, walls="z"),
    "tube": dict(n=1024, diameters=MIXTURE, container="cylinder", cell=[1, 1, 2]),
    "disks of ratio 50": dict(n=2048, dim=2, diameters=np.append(60.0, np.where(np.arange(2047) % 2, 1.4, 1.0))),
}
SCENE_START = [(1e-2, 500.0)]
# Per LP Clp's simplex takes some 60 times as long as the interior point: it starts near jamming only.
CLP_STARTS = ("p = 1e5", "p = 1e7")


def start_state(n, name):
    if name in SCENES:
        made = jam.System.random(seed=1, packing_fraction=0.2, **SCENES[name])
        made.compress(SCENE_START)
        return made
    if STARTS[name] is None:
        return jam.System.random(n, 3, 1)
    return grown(n, 1, STARTS[name])[0]


def routes_from(n, name):
    """(route, a function of the start that measures it). The larger size leaves out what takes minutes: LPs from far, Clp."""
    if name in SCENES:
        yield "barrier path", lambda start: routes.crunched(start, limit_seconds=300.0)
        yield "sequential LPs", lambda start: routes.crunched(start, limit_seconds=300.0, method="sequential_lp")
        yield "MD at G = 0.01", lambda start: routes.grown(start, 1e-2, last=8)
        return
    large, near = n > 2000, name in CLP_STARTS
    settings = routes.SETTINGS[-2:] if large and not near else routes.SETTINGS
    yield "barrier path", lambda start: routes.crunched(start, settings)
    if not large or name == "p = 1e7":
        settings_lps = routes.SETTINGS[-1:] if large else routes.SETTINGS
        yield "sequential LPs", lambda start: routes.crunched(start, settings_lps, method="sequential_lp")
    if near and not large:
        yield "sequential LPs by Clp", lambda start: routes.crunched(
            start, routes.SETTINGS[1::2], method="sequential_lp", lp_solver="clp"
        )
    if name == "p = 500":
        for rate in (1e-2, 1e-3) if large else (1e-2, 1e-3, 3e-4):
            yield f"MD at G = {rate:g}", lambda start, rate=rate: routes.grown(start, rate)
    if name == "random":
        distances = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6) + (() if large else (1e-7, 1e-8, 1e-9, 1e-10))
        for minimiser in ("Newton",) if large else ("Newton", "FIRE"):
            yield f"soft spheres, {minimiser}", lambda _, m=minimiser: routes.softened(n, 1, m.lower(), distances)


def measure(args, data, keep):
    if not data["motion"]:
        data["motion"] = [motion.pressures(fraction) for fraction in (0.3, 0.5)]
    if "analysis" not in data and pathlib.Path(args.analysis).exists():
        data["analysis"] = json.loads(subprocess.run([args.analysis], check=True, capture_output=True).stdout)
    known = {(r["n"], r["start"], r["route"]) for r in data["routes"]}
    for n in args.sizes:
        for name in STARTS:
            missing = [(route, run) for route, run in routes_from(n, name) if (n, name, route) not in known]
            start = start_state(n, name) if missing else None
            for route, run in missing:
                points = run(start)
                data["routes"].append(dict(n=n, start=name, route=route, points=points))
                print(f"N = {n}, {name}, {route}: {points[-1]['seconds']:.2f} s", flush=True)
                keep(data)


def measure_scenes(data, keep):
    known = {(r["start"], r["route"]) for r in data["routes"]}
    for name, given in SCENES.items():
        for route, run in routes_from(given["n"], name):
            if (name, route) in known:
                continue
            data["routes"].append(dict(n=given["n"], start=name, route=route, points=run(start_state(0, name))))
            print(f"{name}, {route}: {data['routes'][-1]['points'][-1]['seconds']:.2f} s", flush=True)
            keep(data)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--sizes", type=lambda text: [int(word) for word in text.split(",")], default=[1024, 4096])
    parser.add_argument("--analysis", default="build/tests/bench/analysis")
    parser.add_argument("--only-draw", action="store_true")
    parser.add_argument("--scenes", action="store_true")
    args = parser.parse_args()
    args.folder.mkdir(parents=True, exist_ok=True)
    file = args.folder / ("scenes.json" if args.scenes else "atlas.json")

    def keep(data):
        part = file.with_suffix(".part")
        part.write_text(json.dumps(data, indent=0), encoding="ascii")
        part.replace(file)

    data = json.loads(file.read_text(encoding="ascii")) if file.exists() else dict(routes=[], motion=[])
    if args.scenes:
        if not args.only_draw:
            measure_scenes(data, keep)
        charts.draw_routes(data["routes"], args.folder / "atlas_scenes.png")
        (args.folder / "scenes.md").write_text(charts.digits_table(data["routes"]), encoding="ascii")
        print(charts.digits_table(data["routes"]))
        return
    data["sizes"] = args.sizes
    if not args.only_draw:
        measure(args, data, keep)
    keep(data)
    charts.draw(data, args.folder)
    table = charts.digits_table([r for r in data["routes"] if r["n"] in data["sizes"]])
    (args.folder / "digits.md").write_text(table, encoding="ascii")
    print(table)


if __name__ == "__main__":
    main()
