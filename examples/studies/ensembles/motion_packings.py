#!/usr/bin/env python3
"""Which of sum f and S predicts the mobility of spheres, and how much that depends on the packing: figures 3.10 and 3.14.

usage: motion_packings.py [--large] [--folder DIR] [--out DIR] [--only-read]

Packings of other seeds, in dynamics as motion_md.py at tau = 2, 5 and 10, and in Monte Carlo as motion_mc.py, alpha = 2 at the middle temperature,
last sweep. Small: 8 packings, 500 runs of dynamics and 100 of Monte Carlo of each, about 15 minutes. Large: 20, 500 and 1000. Runs are
kept.
"""
import sys

import numpy as np
from common import HERE, Results, arguments, mean_error

import jam
from jam import near_jamming as nj

sys.path.insert(0, str(HERE.parent))
import near_jamming_common as near  # noqa: E402

ALPHA, MIDDLE = 2.0, 1
RATIOS, TAUS, MD_RUNS = (0.999, 0.99), (2, 5, 10), 500


def predicted(structure, square):
    """K[x_i, <|dr_i|^2>] of each predictor."""
    return [jam.statistics.spearman(getattr(structure, name), square) for name in near.SCALARS]


def correlations(o, seed, count):
    """Those of one packing: in dynamics at each density and tau, then in Monte Carlo."""
    packing = near.kept_packing(o.folder, seed)
    structure = nj.predictors(packing)
    found = []
    for ratio in RATIOS:
        runs = near.md_runs(packing, o.folder, f"{seed}q_{MD_RUNS}", ratio, MD_RUNS)
        found += [predicted(structure, runs.mean("distance2")[near.INSTANTS.index(tau)]) for tau in TAUS]
    runs = near.mc_runs(packing, o.folder, f"{seed}q_{count}", ALPHA, near.TEMPERATURES[ALPHA][MIDDLE], count)
    return [*found, predicted(structure, runs.mean("distance2")[-1])]


def main():
    o = arguments(__doc__.splitlines()[0]).parse_args()
    packings, count = (20, 1000) if o.large else (8, 100)
    r = Results(o, "motion_packings")
    k = np.array([correlations(o, seed, count) for seed in range(1, packings + 1)])  # (packing, kind of run, predictor)
    where = [("3.10", f"phi/phi_J = {ratio}, tau = {tau}") for ratio in RATIOS for tau in TAUS] + [("3.14", "alpha = 2")]
    names = list(near.SCALARS)
    for row, (figure, state) in enumerate(where):
        more = np.abs(k[:, row, names.index("s")]) - np.abs(k[:, row, names.index("force_sum")])
        r.add(figure, f"|K| of S minus that of sum f, {state}, mean of {packings} packings", "> 0", *mean_error(more))
        r.add(figure, f"share of packings in which |K| of S is above that of sum f, {state}", "one packing: yes", np.mean(more > 0))
    r.write()


if __name__ == "__main__":
    main()
