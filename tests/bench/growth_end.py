"""Where growth ends: the same packings grown at 3e-3 to p = 1e5, 1e6 and 1e7, a crunch from each.

usage: growth_end.py FOLDER [CASE:N:PACKINGS ...]   makes what FOLDER lacks, then writes results/growth_end.json

Cases: d2 (disks 1 : 1.4), d3, d3mix (1 : 1.4), d4, mk (Mari-Kurchan). The three growths are one run, so rows compare
pairs. Processor time; phi_J against that from 1e7, mean and its standard error over packings.
"""
import json
import sys
import time
from pathlib import Path

import numpy as np

import jam

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "bindings/docs"))

import figures  # noqa: E402

PRESSURES = (1e5, 1e6, 1e7)
WORDS = {"d2": "disks 1 : 1.4", "d3": "equal spheres", "d3mix": "spheres 1 : 1.4", "d4": "equal spheres, d = 4", "mk": "Mari-Kurchan"}


def start(case: str, n: int, seed: int) -> jam.System:
    two = [1.0 if i % 2 else 1.4 for i in range(n)]
    options = {"d2": dict(dim=2, diameters=two), "d3mix": dict(diameters=two), "d4": dict(dim=4), "mk": dict(model="mk", packing_fraction=2.5)}
    return jam.System.random(n, seed=seed, **options.get(case, {}))


def timed(call):
    begun = time.process_time()
    report = call()
    return report, time.process_time() - begun


def row_of(case: str, n: int, seed: int) -> dict:
    system, row, rate, contacts = start(case, n, seed), {"case": case, "n": n, "seed": seed}, None, []
    for k, pressure in enumerate(PRESSURES):
        stage = {"pressure": pressure} if rate is None else {"pressure": pressure, "growth_rate": rate}
        grown, row[f"grow{k}"] = timed(lambda: system.compress(**stage))
        rate, crunched = grown.growth_rate, system.copy()
        report, row[f"crunch{k}"] = timed(crunched.crunch)
        row[f"phi{k}"], row[f"jammed{k}"] = crunched.packing_fraction, bool(report.jammed)
        contacts.append({tuple(sorted(pair)) for pair in np.asarray(crunched.contacts.pairs).tolist()})
    row["differ0"], row["differ1"] = len(contacts[0] ^ contacts[2]), len(contacts[1] ^ contacts[2])
    return row


def summary(case: str, n: int, rows: list[dict]) -> list:
    def of(name: str, k: int) -> np.ndarray:
        return np.array([row[f"{name}{k}"] for row in rows], dtype=float)

    total = [sum(of("grow", j) for j in range(k + 1)) + of("crunch", k) for k in range(3)]
    out = [WORDS[case], n, len(rows), round(float(total[2].mean()), 3)]
    for k in (0, 1):
        off = of("phi", k) - of("phi", 2)
        out += [round(float(total[k].sum() / total[2].sum()), 3), f"{off.mean():+.1e} ± {off.std(ddof=1) / len(off) ** 0.5:.1e}", int(sum(row[f"differ{k}"] > 0 for row in rows))]
    return out


if __name__ == "__main__":
    folder, table = Path(sys.argv[1]), []
    for task in sys.argv[2:]:
        case, n, packings = task.split(":")
        path = folder / f"{case}_{n}.json"
        path.touch()
        with path.open("a", buffering=1) as out:
            for seed in range(len(path.read_text().splitlines()) + 1, int(packings) + 1):
                out.write(json.dumps(row_of(case, int(n), seed)) + "\n")
    for path in sorted(folder.glob("*_*.json"), key=lambda p: (p.stem.split("_")[0], int(p.stem.split("_")[1]))):
        case, n = path.stem.split("_")
        if len(rows := [json.loads(line) for line in path.read_text().splitlines()]) > 1:
            table.append(summary(case, int(n), rows))
    columns = ["packings", "N", "pairs", "s to 1e7", "time to 1e5", "phi_J from 1e5", "other network (1e5)", "time to 1e6", "phi_J from 1e6", "other network (1e6)"]
    figures.save(HERE / "results/growth_end.json", "growth_end.py FOLDER " + " ".join(sys.argv[2:]), columns, table)
