#!/usr/bin/env python3
"""Polydisperse disks: forces and gaps at jamming against N.

usage: disks.py [--large] [--sizes N ...] [--folder DIR] [--only-read]

Log-normal diameters of deviation 0.2, d = 2, growth from 0.4 at G = 1e-2 to p = 500, then at 3e-3 to 1e7, crunch. The thesis gives no
parameters. It states that d = 2 has no size effect in the forces and a clear one in the gaps, as d = 3, up to logarithms.
All forces together: 0.19 (d = 2). Small: N = 64, 128 and 256 with 6400 disks a size. Large: to N = 4096 with 1e6.
"""
import numpy as np
from common import GAMMA, THETA_E, THETA_L, Results, arguments, ensemble, mean_error
from finite_size import Size, collapse_tail

from jam import scaling


def protocol(n):
    return dict(
        n=n,
        dim=2,
        packing_fraction=0.4,
        diameters={"law": "lognormal", "deviation": 0.2},
        analysis={"gaps": {"h_max": 1.0, "stable_only": 1}, "bond_order": {"l": 6, "cutoff": 1.4}},
    )


def main():
    p = arguments(__doc__.splitlines()[0])
    p.add_argument("--sizes", type=int, nargs="+", help="N (small 64 128 256, large 256 ... 4096)")
    p.add_argument("--particles", type=float, help="disks a size (small 6400, large 1e6)")
    o = p.parse_args()
    sizes, r = {}, Results(o, "disks")
    particles = o.particles or (1e6 if o.large else 6400)
    for n in o.sizes or ((256, 512, 1024, 2048, 4096) if o.large else (64, 128, 256)):
        e = ensemble(o, protocol(n), round(particles / n))
        size = Size(e, "mk", 2)  # no packing is left out for its order
        if len(size.rows) >= 4:
            sizes[n] = size
    n, s = max(sizes.items())
    r.add("10", f"disks: phi_J, N = {n}", "none", *mean_error(s.rows["packing_fraction"]))
    ideal = np.mean(4.0 - 2.0 / s.rows["stable"])
    r.add("10", f"disks: mean z, N = {n}: 2d + 2(1-d)/N'", ("exact", round(float(ideal), 6)), np.concatenate(s.z).mean())
    for name, text, known in (
        ("extended", "extended forces", THETA_E),
        ("localised", "localised forces", THETA_L),
        ("forces", "all forces", 0.19),
        ("gaps", "gaps", -GAMMA),
    ):
        try:
            found = scaling.tail_exponent(getattr(s, name), n, "gaps" if name == "gaps" else "forces")
        except ValueError as error:
            print(f"{name}: {error}")
            continue
        text = f"disks: exponent of {text}, N = {n}, averaged over ranges"
        r.add("10", text, known, found.value, found.error)
    if len(sizes) > 1:
        for name, a, low, high in (("extended", THETA_E, 0.3, 10), ("gaps", -GAMMA, 0.1, 100)):
            found = collapse_tail(sizes, name, a, low, high)
            r.add(
                "10",
                f"disks: exponent of {name} by collapse (S = {found.quality:.2f})",
                a,
                found.value[0],
                found.error[0],
            )
    r.write()


if __name__ == "__main__":
    main()
