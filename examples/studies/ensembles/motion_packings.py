#!/usr/bin/env python3
"""Which of sum f and S predicts the mobility of soft spheres, and how much that depends on the packing: figure 3.14.

usage: motion_packings.py [--large] [--folder DIR] [--out DIR] [--only-read]

As motion_mc.py, alpha = 2 at the middle temperature, last sweep, from packings of other seeds. Small: 8 packings with 100 runs of 250
sweeps, about 15 minutes. Large: 20 with 1000. Runs are kept.
"""
import sys

import numpy as np
from common import HERE, Results, arguments, mean_error

import jam
from jam import near_jamming as nj

sys.path.insert(0, str(HERE.parent))
import near_jamming_common as near  # noqa: E402

ALPHA, MIDDLE = 2.0, 1


def correlations(o, seed, count):
    """K[x_i, <|dr_i|^2>] of the predictors of one packing."""
    packing = near.kept_packing(o.folder, seed)
    structure = nj.predictors(packing)
    t = near.TEMPERATURES[ALPHA][MIDDLE]
    runs = near.mc_runs(packing, o.folder, f"{seed}q", ALPHA, t, count)
    square = runs.mean("distance2")[-1]
    return [jam.statistics.spearman(getattr(structure, name), square) for name in near.SCALARS]


def main():
    o = arguments(__doc__.splitlines()[0]).parse_args()
    packings, count = (20, 1000) if o.large else (8, 100)
    r = Results(o, "motion_packings")
    k = np.array([correlations(o, seed, count) for seed in range(1, packings + 1)])
    r.made(f"N = 1024 by sequential LPs, seeds 1 to {packings}, alpha = 2, {near.LAST_SWEEP} sweeps", packings * count)
    for column, text in enumerate(near.SCALARS.values()):
        r.add("3.14", f"K[{text}, <|dr|^2>], alpha = 2, mean of {packings} packings", "largest |K| for S", *mean_error(k[:, column]))
        r.add("3.14", f"the same, standard deviation between packings, {text}", "one packing", k[:, column].std(ddof=1))
    names = list(near.SCALARS)
    better = np.abs(k[:, names.index("s")]) > np.abs(k[:, names.index("force_sum")])
    r.add("3.14", "share of packings in which |K| of S is above that of sum f", "one packing: yes", better.mean())
    r.write()


if __name__ == "__main__":
    main()
