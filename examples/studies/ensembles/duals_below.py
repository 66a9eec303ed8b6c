#!/usr/bin/env python3
"""Do the duals of the first linear program (LP) below jamming follow the distribution of forces? An open question of chapter 2.

usage: duals_below.py [--large] [--folder DIR] [--only-read] [--out DIR]

Growth stops at p, a crunch by full LPs begins; the duals of its first LP, with mean 1, are compared with the forces of the jammed state:
contacts in common, largest distance of the two cumulative distributions, and the share of small values. Small: N = 256, 4 seeds. Large: 1024, 10.
"""
import numpy as np
from common import Results, arguments, mean_error, seeded

import jam

PRESSURES = (1e1, 1e2, 1e3, 1e4, 1e5)


def one(n, seed, pressure):
    first = []
    with jam.System.random(n, seed=seed) as packing:
        packing.compress([(1e-2, min(pressure, 500.0))] + [(3e-3, pressure)] * (pressure > 500))

        def step(s):
            if not first and len(s.duals):
                first.append((np.array(s.pairs), np.array(s.duals)))

        report = packing.crunch(on_step=step, method="sequential_lp", full_lps=1)
        pairs, duals = first[0]
        use = duals > 1e-9 * duals.max()
        return {"duals": duals[use] / duals[use].mean(), "pairs": pairs[use], "forces": packing.forces / packing.forces.mean(),
                "contacts": packing.contacts.pairs, "good": report.jammed and report.excess_contacts == 0}  # fmt: skip


def main():
    o = arguments(__doc__.splitlines()[0]).parse_args()
    n, seeds = (1024, 10) if o.large else (256, 4)
    r = Results(o, "duals_below")
    x = np.geomspace(1e-3, 10, 60)
    share = lambda values: np.searchsorted(np.sort(values), x) / len(values)  # noqa: E731
    for pressure in PRESSURES:
        good = [m for m in seeded(o, f"duals_below_n{n}", f"p{pressure:g}_", seeds, lambda s: one(n, s, pressure)) if m["good"]]
        if len(good) < 2:
            continue
        key = lambda pairs: set(map(tuple, np.sort(pairs, axis=1).tolist()))  # noqa: E731
        common = [len(key(m["pairs"]) & key(m["contacts"])) / len(m["contacts"]) for m in good]
        r.add("duals", f"share of the final contacts with a dual in the first LP, p = {pressure:g}", "rises to 1", *mean_error(common))
        off = [np.max(np.abs(share(m["duals"]) - share(m["forces"]))) for m in good]
        r.add("duals", f"largest distance of the two cumulative distributions, p = {pressure:g}", "0: the same law", *mean_error(off))
        few = [np.mean(m["duals"] < 0.1) / np.mean(m["forces"] < 0.1) for m in good]
        r.add("duals", f"duals below a tenth of the mean over forces below it, p = {pressure:g}", "1: the same law", *mean_error(few))
    r.write()


if __name__ == "__main__":
    main()
