#!/usr/bin/env python3
"""What a collapse of extended forces gives when the law holds at small forces only: figures 4.12 and 4.13.

usage: collapse_range.py [--large] [--out DIR]

Synthetic packings of N = 256 to 2048, 1e5 spheres each as in finite_size.py --model mk, whose density is f^theta_e exp(-b f) with a flat
part below N c = 1. With b = 1 + theta_e c has about the power that estimators.py finds in Mari-Kurchan packings between f = 0.1 and
0.3. The exponent by the same call of jam.scaling, and S of c and of c - 0.25 / N, are printed for several upper ends of the scaled
force. Small: 6 trials. Large: 50.
"""
import sys

import numpy as np
from common import HERE, THETA_E, Results, arguments, mean_error

from jam import scaling

sys.path.insert(0, str(HERE.parent))
from tail_exponents import Synthetic  # noqa: E402

SIZES, PARTICLES, VALUES = (256, 512, 1024, 2048), 1e5, 1.3  # extended forces a sphere
ENDS = (3.0, 5.0, 10.0)  # of f N^(1/(1+theta_e))
LOW, OFFSET, U = 0.1, 0.25, 1 / (1 + THETA_E)
LAWS = {"law without bend to f = 1": 0.0, "bent as in Mari-Kurchan packings": 1 + THETA_E}


def draw(rng, bend):
    made = {}
    for n in SIZES:
        law = Synthetic(THETA_E, int(VALUES * n), lambda x: np.exp(-bend * x) * (x < (20 if bend else 1)), "flat", spheres=n)
        made[n] = [np.sort(law.draw(rng)) for _ in range(round(PARTICLES / n))]
    return made


def collapse(samples, end):
    """Exponent, and S of c and of c - 0.25/N at the true one."""
    grid = lambda n: np.geomspace(LOW, end, 30) * n**-U  # noqa: E731
    found = scaling.collapse(samples, grid, [THETA_E], resamples=20)
    curves = [(n, scaling.cdf_grid(s, grid(n))) for n, s in samples.items()]
    quality = [
        scaling.quality([(n, c._replace(c=c.c - offset / n)) for n, c in curves], *scaling.tail_scaling([THETA_E])) for offset in (0.0, OFFSET)
    ]
    return found.value[0], quality


def main():
    o = arguments(__doc__.splitlines()[0]).parse_args()
    trials = 50 if o.large else 6
    r = Results(o, "collapse_range")
    for text, bend in LAWS.items():
        every = [draw(np.random.default_rng(700 + t), bend) for t in range(trials)]
        pool = np.sort(np.concatenate(every[0][SIZES[0]]))
        local = np.log(np.searchsorted(pool, 0.3) / np.searchsorted(pool, 0.1)) / np.log(3)
        r.add("4.12", f"{text}: power of c between f = 0.1 and 0.3", "like Mari-Kurchan packings" if bend else f"{1 + THETA_E}", local)
        for end in ENDS:
            found = [collapse(samples, end) for samples in every]
            value, error = mean_error([f[0] for f in found])
            r.add("4.12", f"{text}: exponent by collapse to scaled f = {end:g}", ("true", THETA_E), value, error)
            for offset, q in zip((0.0, OFFSET), np.mean([f[1] for f in found], axis=0)):
                r.add("4.13", f"{text}: S of c - {offset:g} / N to scaled f = {end:g}", "about 1", q)
    r.write()


if __name__ == "__main__":
    main()
