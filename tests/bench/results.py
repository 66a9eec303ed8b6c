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


def disks(*raws):
    """disks.py N SEEDS FIRST_SEED"""
    rows = []
    for n in sorted({raw["n"] for raw in raws}):
        runs = [run for raw in raws if raw["n"] == n for run in raw["rows"]]
        jammed, others = ([run for run in runs if run["jammed"] is truth] for truth in (True, False))
        seconds = [run["seconds"] for run in runs]
        rows.append(
            [n, ranges(run["seed"] for run in runs), len(jammed), sum(run["proof"] in ("proved", "trapped") for run in jammed)]
            + [sum(run["oracle"] is True for run in jammed) or None, sum(run["oracle"] is False for run in jammed)]
            + [sum((run["rigidity"] == "no") is no for run in others) for no in (True, False)]
            + [statistics.median(run["factorisations"] for run in runs), statistics.median(seconds), max(seconds)]
        )
    columns = ["N", "seeds", "jammed", "proved or trapped by jamproof.py", "confirmed by HiGHS", "wrong", "not jammed, with a motion", "undecided"]
    return columns + ["median of factorisations", "median (s)", "longest (s)"], rows


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


def advise(raw):
    """advise.py 512"""
    rows = []
    for row in raw["rows"]:
        name = ", ".join(f"{key}={value:g}" for key, value in row["options"].items())
        rows.append([f"`{name}`" if name else "the defaults", row["seconds"], row["error"], row["residual"], f"{row['jammed']} of {raw['seeds']}"])
    return ["options of `crunch`", "processor time (s)", "error of phi_J", "force residual", "jammed"], rows


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


def wasm(raw):
    """JAM_BITS_SET=portable wasm.py BUILD-WASM BUILD --sizes 256,1024 --rounds 2"""
    rows = [["bytes of jam.wasm; gzipped", raw["bytes"], raw["gzipped"], raw["bytes"] / raw["gzipped"]]]
    rows += [[key + " (s)", *times, times[0] / times[1]] for key, times in raw["rows"].items()]
    return ["spheres, step", "WebAssembly", "native, portable loops", "ratio"], rows


def read(path):
    text = Path(path).read_text(encoding="utf-8")
    return [json.loads(line) for line in text.splitlines()] if path.endswith(".jsonl") else json.loads(text)


def main():
    name, raws = sys.argv[1], [read(path) for path in sys.argv[2:]]
    made = globals()[name]
    columns, rows = made(*raws)
    old = raws[0] if isinstance(raws[0], dict) and "commit" in raws[0] else None  # a result that was kept with its source
    source = old and {key: old[key] for key in ("machine", "commit", "date")}
    figures.save(HERE / "results" / f"{name}.json", made.__doc__.strip(), columns, rows, source)


if __name__ == "__main__":
    main()
