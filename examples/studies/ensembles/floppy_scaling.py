#!/usr/bin/env python3
"""Floppy modes against N, from the spheres of finite_size.py.

usage: floppy_scaling.py [--large] [--folder DIR] [--only-read]

Opening a contact by s (in mean diameters) gives one mode: m is its median displacement over s, W = f / m,
s_plus the opening at which the next contact forms (s_dagger of the thesis). s_return is s* of the thesis, where p dV
returns to zero (twice s_star): a contact is stable if Sigma = s_return / s_plus > 1.
Expected: f_min ~ N^(-1/(1+theta)), s_plus ~ N^(-1/(1-gamma)) / m, pdf(W) ~ W^theta_e.
"""
import sys

import numpy as np
from common import GAMMA, THETA_E, Results, arguments, ensemble, mean_error
from final_network import power
from finite_size import MAX_ORDER, protocol

from jam.scaling import tail_exponent


def main():
    p = arguments(__doc__.splitlines()[0])
    p.add_argument("--sizes", type=int, nargs="+", help="N (small: 200 400; large: 256 512 1024)")
    p.add_argument("--particles", type=float, default=5e4, help="with --large: particles a size (5e4)")
    o = p.parse_args()
    r = Results(o, "floppy_scaling")
    found, weights = {}, {}
    for n in o.sizes or ((256, 512, 1024) if o.large else (200, 400)):
        e = ensemble(o, protocol("euclid", n, floppy_modes={}), round(o.particles / n) if o.large else 3200 // n)
        rows, w = [], []
        for entry in e:
            if not entry.row["jammed"] or entry.row["excess_contacts"] or entry.row["crystal_score"] > MAX_ORDER:
                continue
            modes, f, pairs, z, sigma = entry.read("floppy_modes", "forces", "pairs", "coordination", "diameters")
            local = (z[pairs] == 4).any(axis=1)
            s, index = modes["s_plus"] / sigma.mean(), modes["s_return"] / modes["s_plus"]
            m = f / modes["weight"]  # median displacement over the opening
            use = ~local & (s > 0) & np.isfinite(s)
            rows.append(
                (
                    np.median(m[use]),
                    np.median((s * m)[use]),
                    f[~local].min(),
                    np.mean(index > 1),
                )
            )
            scaled = modes["weight"][~local]
            w.append(scaled / scaled.mean())
        if len(rows) < 4:
            continue
        found[n], weights[n] = np.array(rows), w
    if len(found) < 2:
        sys.exit("two sizes with 4 packings each are needed")
    expected = {
        "displacement over opening": 0.0,
        "s_plus times displacement over opening": -1 / (1 - GAMMA),
        "f_min": -1 / (1 + THETA_E),
    }
    for k, (name, law) in enumerate(expected.items()):
        slope = power(list(found), [np.log10(a[:, k]) for a in found.values()])  # packings scatter by factors of three
        text = f"power of N of {name} ({'median' if k < 2 else 'least'} of a packing, mean of its logarithm)"
        r.add("9", text, round(law, 4), *slope)
    largest = max(found)
    share, error = mean_error(found[largest][:, 3])
    r.add("9", f"share of contacts with Sigma = s_return / s_plus > 1, N = {largest}", "stable: all", share, error)
    try:
        law = tail_exponent(weights[largest], largest)
        r.add("9", f"exponent of W of extended modes, N = {largest}", THETA_E, law.value, law.error)
    except ValueError as problem:
        print(problem)
    r.write()


if __name__ == "__main__":
    main()
