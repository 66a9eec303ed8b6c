#!/usr/bin/env python3
"""Does the interval of one standard error contain the true exponent in 68 % of trials? jam.scaling on synthetic packings.

usage: scaling_coverage.py [TRIALS] [--out DIR]        default 1000; each packing has 6 N values, the plateau of the density is set by N
"""
import numpy as np
from common import GAMMA, THETA_E, THETA_L, Results, arguments

from jam import scaling


def packings(rng, n, a, m):
    plateau = (6.0 * n) ** (-1.0 / (1.0 + a))
    return plateau, [scaling.draw_left_power(rng, 6 * n, a, plateau) for _ in range(m)]


def main():
    p = arguments(__doc__.splitlines()[0])
    p.add_argument("trials", type=int, nargs="?", default=1000)
    o = p.parse_args()
    trials, r = o.trials, Results(o, "scaling_coverage")
    for name, a in (("extended forces", THETA_E), ("gaps", -GAMMA), ("localised forces", THETA_L)):
        for n, m in ((64, 100), (256, 30)):
            rng, cut, whole = np.random.default_rng(11), [], []
            for k in range(trials):
                plateau, samples = packings(rng, n, a, m)
                found = scaling.fit_power(samples, 1.0, plateau, resamples=100, seed=k)
                cut.append((found.value - a) / found.error)
                found = scaling.fit_power(samples, 1.0, resamples=100, seed=k)
                whole.append((found.value - a) / found.error)
            spread = (0.683 * 0.317 / trials) ** 0.5
            text = f"{name}, N = {n}, {m} packings: share of trials within one error"
            r.add("6.6.5", text + ", truncated likelihood", ("nominal", 0.683), np.mean(np.abs(cut) < 1), spread)
            r.add("6.6.5", text + ", no truncation", ("nominal", 0.683), np.mean(np.abs(whole) < 1), spread)
            r.add(
                "6.6.5",
                f"{name}, N = {n}: mean of (found - true) / error, truncated",
                ("nominal", 0.0),
                np.mean(cut),
                trials**-0.5,
            )
    few = max(20, trials // 10)
    inside = []
    for k in range(few):
        rng = np.random.default_rng(500 + k)
        sizes = {n: packings(rng, n, -GAMMA, 40)[1] for n in (32, 64, 128)}
        grid = lambda n: np.geomspace(0.05, 20, 14) * (6.0 * n) ** (-1 / (1 - GAMMA))  # noqa: E731
        found = scaling.collapse(sizes, grid, [-GAMMA], resamples=15, seed=k)
        inside.append(abs(found.value[0] + GAMMA) < found.error[0])
    spread = (0.683 * 0.317 / few) ** 0.5
    r.add(
        "6.5.5",
        f"collapse of gaps, N = 32, 64, 128, {few} trials: share within one error",
        ("nominal", 0.683),
        np.mean(inside),
        spread,
    )
    r.write()


if __name__ == "__main__":
    main()
