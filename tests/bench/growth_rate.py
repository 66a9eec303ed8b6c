"""The second growth rate of large packings: the same starts grown to p = 500, then at several rates to p = 1e6, a crunch from each.

usage: growth_rate.py FOLDER [CASE:N:PACKINGS ...]   makes what FOLDER lacks, then writes results/growth_rate.json

Cases as in growth_end.py. Packings of different rates are different ones: phi_J is the difference of pairs of the same start,
mean and standard error. Processor time.
"""
import json
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "bindings/docs")]

import figures  # noqa: E402
from growth_end import WORDS, start, timed  # noqa: E402

RATES = (3e-3, 1e-3, 3e-4)  # the first is the default


def row_of(case: str, n: int, seed: int) -> dict:
    fluid, row = start(case, n, seed), {"case": case, "n": n, "seed": seed}
    _, row["first"] = timed(lambda: fluid.compress([(1e-2, 500.0)]))
    for k, rate in enumerate(RATES):
        system = fluid.copy()
        _, row[f"grow{k}"] = timed(lambda: system.compress([(rate, 1e6)]))
        report, row[f"crunch{k}"] = timed(system.crunch)
        row[f"phi{k}"], row[f"jammed{k}"], row[f"factor{k}"] = system.packing_fraction, bool(report.jammed), report.factorisations
    return row


def rows_of(rows: list[dict]) -> list[list]:
    def of(name: str, k: int) -> np.ndarray:
        return np.array([row[f"{name}{k}"] for row in rows], dtype=float)

    first, out = np.array([row["first"] for row in rows]), []
    total = [first + of("grow", k) + of("crunch", k) for k in range(len(RATES))]
    for k, rate in enumerate(RATES):
        off, ratio = of("phi", k) - of("phi", 0), total[k] / total[0]
        error = len(rows) ** -0.5
        out.append([
            WORDS[rows[0]["case"]], rows[0]["n"], f"{rate:g}", len(rows), round(float((first + of("grow", k)).mean()), 1),
            round(float(of("crunch", k).mean()), 1), int(of("factor", k).mean()),
            f"{ratio.mean():.2f} ± {ratio.std(ddof=1) * error:.2f}", f"{off.mean():+.1e} ± {off.std(ddof=1) * error:.1e}",
            f"{int(of('jammed', k).sum())} of {len(rows)}",
        ])  # fmt: skip
    return out


if __name__ == "__main__":
    folder, table = Path(sys.argv[1]), []
    folder.mkdir(parents=True, exist_ok=True)
    for task in sys.argv[2:]:
        case, n, packings = task.split(":")
        with (folder / f"{case}_{n}.json").open("a+", buffering=1) as out:
            out.seek(0)
            for seed in range(len(out.readlines()) + 1, int(packings) + 1):
                out.write(json.dumps(row_of(case, int(n), seed)) + "\n")
    for path in sorted(folder.glob("*_*.json")):
        if len(rows := [json.loads(line) for line in path.read_text().splitlines()]) > 1:
            table += rows_of(rows)
    columns = ["packings", "N", "second rate", "starts", "growth (s)", "crunch (s)", "factorisations", "time to that of 0.003", "phi_J to that of 0.003", "jammed"]
    figures.save(HERE / "results/growth_rate.json", "growth_rate.py FOLDER " + " ".join(sys.argv[2:]), columns, table)
