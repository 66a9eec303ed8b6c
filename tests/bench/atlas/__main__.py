"""The atlas of speed against accuracy: every route to the jamming point from the same starts, analyses, and pressure.

usage: python3 tests/bench/atlas FOLDER [--sizes 1024,4096] [--only-draw] [--analysis build/tests/bench/analysis]

Writes atlas.json, its charts and digits.md (what so many digits of phi_J cost) into FOLDER; 27 to 30 minutes on one core.
Times are processor times. What atlas.json holds already is not measured again, so a killed atlas goes on. PYTHONPATH: the
built module.
"""
import argparse
import json
import pathlib
import subprocess
import sys

import jam

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
# Per LP Clp's simplex takes some 60 times as long as the interior point: it starts near jamming only.
CLP_STARTS = ("p = 1e5", "p = 1e7")


def start_state(n, name):
    if STARTS[name] is None:
        return jam.System.random(n, 3, 1)
    return grown(n, 1, STARTS[name])[0]


def routes_from(n, name):
    """(route, a function of the start that measures it). The larger size leaves out what takes minutes: LPs from far, Clp."""
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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--sizes", type=lambda text: [int(word) for word in text.split(",")], default=[1024, 4096])
    parser.add_argument("--analysis", default="build/tests/bench/analysis")
    parser.add_argument("--only-draw", action="store_true")
    args = parser.parse_args()
    args.folder.mkdir(parents=True, exist_ok=True)
    file = args.folder / "atlas.json"

    def keep(data):
        part = file.with_suffix(".part")
        part.write_text(json.dumps(data, indent=0), encoding="ascii")
        part.replace(file)

    data = json.loads(file.read_text(encoding="ascii")) if file.exists() else dict(routes=[], motion=[])
    data["sizes"] = args.sizes
    if not args.only_draw:
        measure(args, data, keep)
    keep(data)
    charts.draw(data, args.folder)
    (args.folder / "digits.md").write_text(charts.digits_table(data), encoding="ascii")
    print(charts.digits_table(data))


if __name__ == "__main__":
    main()
