#!/usr/bin/env python3
"""Makes a table of the bench page from what a benchmark printed: results/NAME.json, with machine, commit and date of now.

usage: results.py NAME RAW.json [RAW.json ...]     NAME: a function below, whose first line is the command of the benchmark
Then `bindings/docs/figures.py ROOT` writes the page.
"""
import json
import statistics
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parents[1] / "bindings/docs"))
import figures  # noqa: E402


def span(values):
    return {"from": min(values), "to": max(values)}


def spread(values):
    """median (least to most), the most to two digits"""
    low, high = f"{min(values):.2g}", f"{max(values):.2g}"
    middle = f"{statistics.median(values):.2g}"
    return middle if low == high else f"{middle} ({low} to {high})"


def ranges(numbers):
    """1 to 50, 101 to 110"""
    parts = []
    for x in sorted(numbers):
        parts = parts[:-1] + [(parts[-1][0], x)] if parts and parts[-1][1] == x - 1 else [*parts, (x, x)]
    return ", ".join(f"{a} to {b}" if a < b else str(a) for a, b in parts)


def whole(values):
    return f"{statistics.median(values):.0f} ({min(values)} to {max(values)})" if len(values) > 1 else values[0]


def crunch(raw):
    """crunch_cases.py [FILE]"""
    columns = ["start", "seeds", "factorisations", "crunch (s)", "with growth (s)", "phi_J", "isostatic", "largest force residual"]
    rows = []
    for case in raw["cases"]:
        runs = case["runs"]
        of = {key: [run[key] for run in runs] for key in runs[0]}
        total = [a + b for a, b in zip(of["dynamics"], of["crunch"])]
        phi = [f"{min(of['phi']):.4f}", f"{max(of['phi']):.4f}"]
        isostatic = sum(run["jammed"] and run["excess"] == 0 for run in runs)
        rows.append(
            [case["case"], len(runs), whole(of["factorisations"]), spread(of["crunch"]), spread(total)]
            + [" to ".join(dict.fromkeys(phi)), f"{isostatic} of {len(runs)}", max(of["residual"])]
        )
    return columns, rows


def size(raw):
    """size_chart.py --sizes 256,512,1024,2048,4096 --seeds 3 --growth 3e-4 --pressure 1e7"""
    rows = []
    for n in sorted({run["n"] for run in raw}):
        cells = [n]
        for method in ("barrier_path", "sequential_lp"):
            runs = [run for run in raw if run["n"] == n and run["method"] == method]
            cells += [whole([run["factorisations"] for run in runs]), spread([run["seconds"] for run in runs])]
        rows.append(cells)
    return ["N", "barrier path: factorisations", "barrier path (s)", "sequential LPs: factorisations", "sequential LPs (s)"], rows


def clp(raw):
    """clp_race FILE 3 30"""
    rows = []
    for row in raw["solvers"]:
        answer = row["solved"] == 1
        rows.append(
            [row["solver"] + ("" if answer else " (no answer)"), row["seconds"], row["ratio"], row["gain_error"] if answer else None]
        )
    return ["solver", "processor time (s)", "over the interior point", "error of the gain"], rows


def resume(*raws):
    """crunch_resume.py FILE.json 500 3 [PRESSURE]"""
    rows = []
    for raw in raws:
        start = f"growth at G = 1e-2 to p = {raw['pressure']:g}" if raw["pressure"] else "random points at 0.3"
        runs = raw["rows"]
        cost = sum(r["stopped"] for r in runs) / sum(r["whole"] for r in runs)
        rows.append([start, len(runs), cost, sum(r["same"] for r in runs), sum(r["jammed"] for r in runs)])
    return ["start", "stops", "factorisations with the stop over without", "same packing", "jammed"], rows


def disks(*raws):
    """disks.py N SEEDS FIRST_SEED"""
    rows = []
    for n in sorted({raw["n"] for raw in raws}):
        runs = [run for raw in raws if raw["n"] == n for run in raw["rows"]]
        jammed = [run for run in runs if run["kind"].startswith("jammed")]
        highs = sum(run["reason"] != "not confirmed" for run in jammed) or None
        seconds = [run["seconds"] for run in runs]
        rows.append(
            [n, ranges(run["seed"] for run in runs), len(jammed), sum(run["proof"] in ("proved", "trapped") for run in jammed), highs]
            + [sum(run["kind"] == "wrong" for run in runs)]
            + [sum(run["kind"] == "stopped" and (run["rigidity"] == "no") is no for run in runs) for no in (True, False)]
            + [statistics.median(run["factorisations"] for run in runs), statistics.median(seconds), max(seconds)]
        )
    columns = ["N", "seeds", "jammed", "proved or trapped by jamproof.py", "confirmed by HiGHS", "wrong", "not jammed, with a motion", "undecided"]
    return columns + ["median of factorisations", "median (s)", "longest (s)"], rows


def proofs(raw):
    """proof 64,256,1024 3 [strict]; proof 4096 1 [strict]; proof 16384 1"""
    rows = []
    for strict, dim, n in sorted({(r["strict"], r["dim"], r["n"]) for r in raw["runs"]}):
        runs = [r for r in raw["runs"] if (r["strict"], r["n"], r["dim"], r["steps"]) == (strict, n, dim, 2)]
        good = [r for r in runs if r["exact"]]
        exact = [statistics.median(f(r) for r in good) if good else None for f in (lambda r: r["radius"], lambda r: r["force_error"] / r["least_force"])]
        every = [statistics.median(f(r) for r in runs) for f in (lambda r: r["rounding"] / r["eigenvalue"], lambda r: r["seconds"], lambda r: r["seconds"] / r["crunch"])]
        rows.append(["free" if strict else "fixed", dim, n, f"{len(good)} of {len(runs)}", f"{sum(r['trapped'] for r in runs)} of {len(runs)}", *exact, *every])
    return ["cell", "d", "N", "proved exact", "trapped", "radius", "force error over least force", "rounding over eigenvalue", "time (s)", "over the time of the crunch"], rows


def verdicts(raw):
    """verdicts.py"""
    rows = []
    for scene in dict.fromkeys(r["scene"] for r in raw):
        runs = [r for r in raw if r["scene"] == scene]
        given = [(v, w) for r in runs for v, w in zip(r["verdict"], r["wanted"])]
        shares = [sum(v == word for v, _ in given) for word in ("YES", "NO", "UNDECIDED")]
        wrong, known = (sum(test(v, w) for v, w in given) for test in (lambda v, w: {v, w} == {"YES", "NO"}, lambda v, w: w is not None))
        shown = [f for r in runs for f in r["flex"]]
        milliseconds = spread([1e3 * r["seconds"] for r in runs])
        rows.append([scene, len(given), *shares, f"{wrong} of {known}", f"{sum(shown)} of {len(shown)}", milliseconds])
    return ["scene", "verdicts", "yes", "no", "undecided", "wrong, of those known", "no with a flex", "time of both kinds and flexes (ms)"], rows


def verdict_numbers(raw):
    """verdicts.py --numbers CHECKOUT"""
    rows = []
    for r in raw[1:]:
        changed = ", ".join(f"{count} {what}" for what, count in r["changed"].items()) or "none"
        rows.append([f"`{r['number']}`", r["factor"], changed.lower(), r["geometry"], r["undecided"], r["wrong"], r["no without a flex"], r["seconds"] / raw[0]["seconds"]])
    return ["number", "times", "verdicts changed", "networks from geometry changed", f"undecided, of {raw[0]['verdicts']}", "wrong", "no without a flex", "ratio of times"], rows


def strict(raw):
    """strict.py --seeds 3 --sizes2 256,1024 --sizes3 256,1024"""
    rows = []
    for dim, n in sorted({(r["dim"], r["n"]) for r in raw}):
        runs = [r for r in raw if (r["dim"], r["n"]) == (dim, n)]
        for_cell = []
        for cell in ("fixed", "free"):
            for_cell += [whole([r[cell]["factorisations"] for r in runs]), spread([r[cell]["seconds"] for r in runs])]
        ratio = statistics.median(r["free"]["seconds"] / r["fixed"]["seconds"] for r in runs)
        gain = spread([r["free"]["phi"] - r["fixed"]["phi"] for r in runs])
        rows.append([dim, n, *for_cell, ratio, gain, f"{sum(all(r['jammed']) for r in runs)} of {len(runs)}"])
    return ["d", "N", "fixed cell: factorisations", "fixed cell (s)", "free cell: factorisations", "free cell (s)", "ratio of times", "gain of packing fraction", "strictly jammed"], rows  # fmt: skip


def ratios(raw):
    """ratios.py --n 2000"""
    rows = [
        [r["d"], int(r["ratio"]), r["large"], r["volume_of_large"], r["growth_seconds"], r["rate"] / 1e6, r["trial_rate"] / 1e6, r["crunch_seconds"], r["factorisations"], r["contacts"], "yes" if r["jammed"] else "no"]  # fmt: skip
        for r in raw
    ]
    return ["d", "ratio", "large of 2000", "share of volume", "growth (s)", "million collisions per second", "million trials per second", "crunch (s)", "factorisations", "contacts", "jammed"], rows  # fmt: skip


def with_error(value, error):
    return {"value": value, "error": error}


def mixtures(raw):
    """mixtures.py"""
    names = {"equal": "equal", "two sizes": "two sizes, ratio", "log-normal": "log-normal, deviation"}
    laws = dict.fromkeys((r["law"], r["value"]) for r in raw)
    of = {(r["law"], r["value"], r["d"]): r for r in raw}
    rows = [
        [names[law] + (f" {value:g}" if law != "equal" else "")]
        + [x for d in (2, 3) for x in (of[law, value, d]["rate"] / 1e6, of[law, value, d]["ratio"])]
        for law, value in laws
    ]
    return ["diameters"] + [f"d = {d}, {what}" for d in (2, 3) for what in ("million collisions per second", "over equal")], rows


def md_misses(*raws):
    """md_misses.py"""
    runs = [run for raw in raws for run in raw]
    names = ("instructions", "misses of 32 kB", "misses of 1 MB", "mispredicted branches")
    rows = []
    for part in [*runs[0]["parts"], "all"]:
        counts = [run["total"] if part == "all" else run["parts"][part] for run in runs]
        rows.append([part] + [x for k in (0, 1, 2, 3) for x in ([counts[-1][k]] if k in (0, 3) else [c[k] for c in counts])])
    last = f"N = {runs[-1]['n']}"
    columns = ["per collision"]
    for k, name in enumerate(names):
        columns += [f"{name} at {last}"] if k in (0, 3) else [f"{name} at N = {run['n']}" for run in runs]
    return columns, rows


def md_threads(raw):
    """md_threads"""
    line, rows = raw["line_ns"], []
    for r in raw["runs"]:
        two, four = (s for s in r["slabs"] if s["synchronise_ns"] > 0)
        # A collision has two predictions, other events one. The result takes two lines of the cache; at most, the first
        # thread takes six back that it writes and the other has read.
        left = r["event_ns"] - r["valid"]["8"] * (2 - r["exits"] - r["stale"]) * r["prediction_ns"]
        ahead = [r["event_ns"] / (left + lines * line) for lines in (8, 2)]
        rows.append([r["n"], r["packing_fraction"], r["event_ns"], r["parallel"], two["across"], two["gain"], four["gain"], r["valid"]["8"], *ahead])
    columns = ["N", "packing fraction", "an event (ns)", "events over the longest chain", "in both of two slabs", "two slabs, gain at most", "four slabs, gain at most"]
    return columns + ["predictions valid 8 events later", "predictions ahead, gain, lines counted", "predictions ahead, gain at most"], rows


def md_windows(runs):
    """md_windows N PHI WINDOWS EVENTS"""
    rows = []
    for key in dict.fromkeys((r["n"], r["packing_fraction"], r["events_per_sphere"]) for r in runs):
        some = [r for r in runs if (r["n"], r["packing_fraction"], r["events_per_sphere"]) == key]
        count = sum(r["windows"] for r in some)
        late, differ = (sum(r[what] for r in some) / count for what in ("late", "differ"))
        processors = [r["one_thread_ns"] / r["in_turn_ns"] for r in some]
        wall = [r["wall_gain"][2] for r in some]
        again = [statistics.median(1 / (1 / g + share) for g in wall) for share in (late, differ)]
        rows.append([*key, len(some), some[0]["put_off"], late, differ, sum(r["unseen"] for r in some), spread(processors), spread(wall), *again])
    columns = ["N", "packing fraction", "events per sphere in a window", "runs", "put off", "windows flagged", "windows with other bits", "of these not flagged"]
    return columns + ["gain, in turn on one core", "gain on two cores", "with flagged windows again", "with those of other bits again"], rows


def ensemble(*raws):
    """ensemble.py --seeds 1,60; ... 61,120; ... 121,220 and 221,320 with --protocols"""
    import ensemble as bench

    found = bench.together(list(raws))
    rows = []
    for name, m in found["means"].items():
        part = lambda *names: sum(m[f"{n} (s)"] for n in names)
        rows.append(
            [name, len(found["runs"][name]), m["collisions"][0] / 1e6, m["factorisations"][0], part("growth"), part("crunch"), part("start", "image", "file")]
            + [part("analysis", "check"), part(*bench.PARTS), with_error(m["phi_J"][0], m["phi_J"][1])]
            + ["" if name == "default" else f"{m['phi_J'][2]:.1e} ± {m['phi_J'][3]:.1e}"]
        )
    columns = ["stages", "packings", "million collisions", "factorisations", "growth (s)", "crunch (s)", "store (s)", "analyse and check (s)"]
    return columns + ["a packing (s)", "phi_J", "phi_J less that of the default"], rows


def ensemble_statistics(*raws):
    """ensemble.py --seeds 1,60; ... 61,120; ... 121,220 and 221,320 with --protocols"""
    import ensemble as bench

    found = bench.together(list(raws))
    means = found["means"]
    others = ("second stage to 1e4", "second stage to 3000", "first stage alone")
    rows = []
    for key in found["quantities"]:
        difference = [f"{means[o][key][2]:.2g} ± {means[o][key][3]:.1g}" for o in others]
        rows.append([key, with_error(*means["default"][key][:2]), *difference])
    return ["mean of", "default", *(f"{o} less the default" for o in others)], rows


def wall_rows(raws):
    rows = []
    for raw in raws:
        for n, rate in raw["collisions"].items():
            for scene, cost in rate.items():
                if any(row[:2] == [int(n), scene] for row in rows):
                    continue  # the first run with this scene
                runs = [r for r in raw["crunches"] if (r["n"], r["scene"]) == (int(n), scene)]
                done = [r for r in runs if r["jammed"]]
                rows.append(
                    [int(n), scene, cost, cost / rate["cube"], spread([r["crunch_seconds"] for r in runs]), whole([r["factorisations"] for r in runs])]
                    + [f"{len(done)} of {len(runs)}", max(r["excess"] for r in done)]
                    + [max(r["force_residual"] for r in done), max(r["max_contact_gap"] for r in done)]
                )
    rows.sort(key=lambda row: row[0])
    columns = ["N", "scene", "microseconds a collision", "over the cube", "crunch (s)", "factorisations", "jammed", "most contacts above isostatic"]
    return columns + ["largest force residual", "largest gap of a contact"], rows


def walls(*raws):
    """walls.py --sizes 256,512,1024,2048 --seeds 3; walls.py --sizes 4096 --scenes cube,slit --seeds 2"""
    return wall_rows(raws)


def walls_equal(*raws):
    """walls.py --equal --sizes 2048 --scenes cube,slit,box,ball --seeds 2"""
    columns, rows = wall_rows(raws)
    return columns, [row for row in rows if row[0] == 2048]


def walls_edge(*raws):
    """walls.py"""
    return ["scene", "answer"], raws[0]["edges"]


def md(raw):
    """md_speed"""
    rows = []
    for fraction in sorted({r["packing_fraction"] for r in raw["nve"]}):
        runs = {r["n"]: r["collisions_per_second"] / 1e6 for r in raw["nve"] if r["packing_fraction"] == fraction}
        rows.append([f"packing fraction {fraction:g}, millions of collisions per second", *(runs[n] for n in (1024, 16384, 100000))])
    for name, text in (("observed: series", "with `jam_observe`, series"), ("observed: collisions of pairs", "with `jam_observe`, collisions of all pairs")):  # fmt: skip
        found = {r["n"]: r["rate_ratio"] for r in raw["against"] if r["rival"] == name}
        rows.append([f"{text}: rate over the plain rate", *(found[n] for n in (1024, 16384, 100000))])
    return ["what", "N = 1024", "N = 16384", "N = 1e5"], rows


def monte_carlo(raw):
    """monte_carlo"""
    rows = [
        [r["scene"] + (f", alpha = {r['alpha']:g}, T = {r['temperature']:g}" if r["alpha"] else ""), r["step"], r["trials_a_second"] / 1e6, r["ratio"]]
        for r in raw
    ]  # fmt: skip
    return ["system (N = 1024)", "step in diameters", "millions of trials per second", "over a plain cell-list code"], rows


def near_jamming(raw):
    """near_jamming_accuracy.py PICTURE.png 1000"""
    rows = [
        [r["scene"], r["instant"], r["runs"], r["seconds"], {"value": r["k"], "error": r["error"]}]
        for r in raw
        if r["runs"] in (100, 1000)
    ]
    return ["dynamics", "collisions or sweeps", "runs", "processor time (s)", "K"], rows


def soft_cell(raw):
    """soft_cell.py FILE.json 512"""
    rows = []
    for pressure in sorted({r["pressure"] for r in raw["race"]}, reverse=True):
        line = [pressure]
        for minimiser in ("newton", "fire", "lbfgs"):
            runs = [r for r in raw["race"] if (r["pressure"], r["minimiser"]) == (pressure, minimiser)]
            best = [r for r in runs if r["residual"] < 1e-12]
            line.append(min(best, key=lambda r: r["residual"])["seconds"] if best else "not reached")
        rows.append(line)
    return ["pressure (stiffness over diameter)", "Newton (s)", "FIRE (s)", "L-BFGS (s)"], rows


def pore_space(raw):
    """pore_space.py --n 1024"""
    rows = []
    for run in raw["rows"]:
        what = f"{run['at']:g} of the radius" if run["kind"].startswith("mesh") else f"{run['at']} voxels along each edge"
        rows.append([run["kind"], what, run["error"], run["seconds"], run["bytes"] / 1e6])
    return ["what", "resolution", "error of the volume or the porosity", "seconds", "MB"], rows


def structure(raw):
    """structure.py OUT.json PICTURE.png"""
    rows = [[r["task"], r["n"], r["at"], r["seconds"], r["error"]] for r in raw if r["task"] != "g(r)" or r["at"] == "160 bins"]
    return ["task", "N", "resolution", "processor time (s)", "relative error"], rows


def factorisation(raw):
    """single_precision"""
    rows = []
    for case in raw["cases"]:
        doubles = statistics.median(p["seconds"] for p in case["points"] if p["precision"] == "double")
        row = [case["decades"], doubles]
        for asked in (1e-2, 1e-10):
            found = [p for p in case["points"] if p["precision"] == "single" and p["asked"] == asked and p["found"]]
            row += [found[0]["seconds"] if found else "not converged"]
        rows.append(row)
    return ["decades of weights (N = 4096)", "doubles (s)", "floats, error 1e-2 (s)", "floats, error 1e-10 (s)"], rows


def liquid(raw):
    """liquid.py"""
    columns = ["d", "phi", "p of dynamics", "pade", "pade, difference (%)", "closed form", "closed form, difference (%)"]
    rows = []
    for run in raw:
        row = [run["dim"], run["fraction"], {"value": run["pressure"], "error": run["error"]}]
        for form in ("pade", {2: "henderson", 3: "carnahan_starling"}.get(run["dim"])):
            p = run.get(form)
            off = None if p is None else {"value": 100 * (p / run["pressure"] - 1), "error": 100 * run["error"] / run["pressure"]}
            row += [None if p is None else f"{p:.4f}", off]
        rows.append(row)
    return columns, rows


def advise(raw):
    """advise.py 512"""
    rows = []
    for row in raw["rows"]:
        name = ", ".join(f"{key}={value:g}" for key, value in row["options"].items())
        rows.append([f"`{name}`" if name else "the defaults", row["seconds"], row["error"], row["residual"], f"{row['jammed']} of {raw['seeds']}"])
    return ["options of `crunch`", "processor time (s)", "error of phi_J", "force residual", "jammed"], rows


def analysis(raw):
    """analysis"""
    forces = {f"{r['method']} {r.get('refinements', '')}".strip(): r for r in raw["forces"]}["null vector 2"]
    modes = next(r for r in raw["spectrum"] if r["method"] == "lanczos" and r["count"] == 100)
    rows = [
        ["contacts, forces, gaps, classes and structure from positions", raw["n"], raw["contacts_forces_gaps_classes_structure"]["cpu"], forces["error"]],
        ["all modes with vectors", raw["n"], raw["full_spectrum_with_vectors"]["cpu"], raw["spectrum"][0]["error"]],
        ["lowest 100 modes", raw["n"], raw["lowest_100"]["cpu"], modes["error"]],
        ["floppy modes of all contacts", raw["n"], raw["floppy_all"]["cpu"], raw["floppy_blocks"]["residual"]],
        ["contacts and forces", raw["tiled_n"], raw["tiled_forces"]["cpu"], None],
        ["lowest 100 modes", raw["tiled_n"], raw["tiled_lowest_100"]["cpu"], None],
    ]
    return ["task", "N", "processor time (s)", "error"], rows


def ablation(*raws):
    """ablation, five seeds per set"""
    runs = [run for raw in raws for run in raw]
    nothing = {(r["set"], r["start"]): r for r in runs if r["off"] == "none"}
    sets = list(dict.fromkeys(r["set"] for r in runs))

    def cell(off, of):
        some = [r for r in runs if r["off"] == off and r["set"] == of and (of, r["start"]) in nothing]
        number, jammed = sum(1 for key in nothing if key[0] == of), sum(r["jammed"] for r in some)
        if len(some) < 0.5 * number:
            return None
        rest = f", {jammed} of {len(some)} jammed" if jammed < len(some) else ""
        rest += f", {len(some)} of {number} run" if len(some) < number else ""
        if off == "none":
            middle = statistics.median(r["factorisations"] for r in some)
            return f"{middle:.0f}, {statistics.median(r['seconds'] for r in some):.2g} s{rest}"
        pairs = [(r, nothing[of, r["start"]]) for r in some]
        mean = [
            statistics.geometric_mean(max(a[key], least) / max(b[key], least) for a, b in pairs)
            for key, least in (("factorisations", 1), ("seconds", 1e-3))
        ]
        return f"{mean[0]:.2f}, {mean[1]:.2f}{rest}"

    rows = [["nothing" if off == "none" else off] + [cell(off, of) for of in sets] for off in dict.fromkeys(r["off"] for r in runs)]
    return ["off"] + sets, rows


# By what diameters decrease where this is off, by growing numbers.
DECOMPRESSIONS = {
    "decompressions": "none",
    "decompressions after 1": "1e-4",
    "decompressions after 2": "1e-4, 1e-3",
    "decompressions after 3": "1e-4, 1e-3, 1e-2",
    "decompression by 1e-3": "1e-4, 1e-2, 0.03",
    "none": "1e-4, 1e-3, 1e-2, 0.03",
}


def decompressions(runs):
    """ablation "off=MECHANISM" ... disks1000"""
    rows = []
    for off in (off for off in DECOMPRESSIONS if any(r["off"] == off for r in runs)):
        of = [r for r in runs if r["off"] == off]
        seconds = [r["seconds"] for r in of]
        worse = sum(a["phi"] < b["phi"] - 1e-9 for a, b in zip(of, (r for r in runs if r["off"] == "decompressions")))
        rows.append([DECOMPRESSIONS[off], len(of), sum(r["jammed"] for r in of), worse, statistics.median(seconds), statistics.mean(seconds), max(seconds)])
    return ["relative decreases of diameters", "packings", "jammed", "of lower density than with none", "median (s)", "mean (s)", "longest (s)"], rows


def products(raw):
    """products.py OUT.json PICTURE.png FOLDER 2 512,1024,2048 OpenBLAS=... builtin=... reference=..."""
    first = raw[0]["build"]
    cost = {(r["n"], r["seed"], r["build"]): r["seconds"] / r["factorisations"] for r in raw}
    rows = []
    for n in dict.fromkeys(r["n"] for r in raw):
        for build in dict.fromkeys(r["build"] for r in raw):
            some = [r for r in raw if (r["n"], r["build"]) == (n, build)]
            ratio = [cost[n, r["seed"], build] / cost[n, r["seed"], first] for r in some]
            rows.append(
                [n, build, whole([r["factorisations"] for r in some]), spread([r["seconds"] for r in some]), spread(ratio)]
                + [max(r["residual"] for r in some), f"{sum(r['jammed'] for r in some)} of {len(some)}"]
            )
    return ["N", "products", "factorisations", "crunch (s)", "a factorisation, over " + first, "largest force residual", "jammed"], rows


def threads(*raws):
    """cholesky 16384 5 all 4096, three times"""
    rows = []
    for runs in zip(*(raw["runs"] for raw in raws)):
        rows.append([runs[0]["n"], span([round(r["jam_1"]["factorise_s"] / r["jam_2"]["factorise_s"], 2) for r in runs])])
    return ["N", "two threads over one (rate)"], rows


def task_graph(raw):
    """fronts N > FRONTS.json for N = 4096 and 16384; task_graph.py FRONTS.json..."""
    rows = [[row["n"], row["cores"]] + [round(row[plan], 2) for plan in ("tree", "lists", "queue")] for row in raw["rows"]]
    return ["N", "cores", "a front is a task", "subtrees, then front by front", "parts of fronts in one queue"], rows


def read(path):
    text = Path(path).read_text(encoding="utf-8")
    return [json.loads(line) for line in text.splitlines()] if path.endswith(".jsonl") else json.loads(text)


def main():
    name, raws = sys.argv[1], [read(path) for path in sys.argv[2:]]
    made = {f.__name__: f for f in (crunch, size, clp, resume, disks, proofs, verdicts, verdict_numbers, strict, md, monte_carlo, near_jamming, soft_cell, pore_space, structure, liquid, advise, analysis, factorisation, ablation, decompressions, ratios, mixtures, md_misses, md_threads, md_windows, ensemble, ensemble_statistics, walls, walls_equal, walls_edge, products, threads, task_graph)}[name]
    columns, rows = made(*raws)
    old = raws[0] if isinstance(raws[0], dict) and "commit" in raws[0] else None  # a result that was kept with its source
    source = old and {key: old[key] for key in ("machine", "commit", "date")}
    figures.save(HERE / "results" / f"{name}.json", made.__doc__.strip(), columns, rows, source)


if __name__ == "__main__":
    main()
