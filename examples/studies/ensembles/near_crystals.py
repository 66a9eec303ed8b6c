#!/usr/bin/env python3
"""Near-crystals: FCC with a small spread of diameters, section 10 of the studies.

usage: near_crystals.py [--large] [--folder DIR] [--only-read]

Log-normal diameters on FCC sites at packing fraction 0.7, growth at G = 1e-3 to p = 1e7, crunch. The thesis gives no
parameters. Known (G. Tsekenis, arXiv 2006.07373): phi_J falls linearly with the spread; the force exponent is universal, those
of gaps and localised forces are not. Small: N = 108, 6 packings a spread. Large: N = 108 and 256, 60.
"""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from common import GAMMA, Results, arguments, ensemble, mean_error

from jam import scaling

FCC = np.pi / np.sqrt(18.0)


def protocol(n, deviation):
    return dict(
        n=n,
        dim=3,
        packing_fraction=0.7,
        lattice="fcc",
        diameters={"law": "lognormal", "deviation": deviation},
        stages=[{"growth_rate": 1e-3, "pressure": 1e7}],
        analysis={"gaps": {"h_max": 1.0, "stable_only": 1}, "bond_order": {"l": 6, "cutoff": 1.2}, "crystal_score": {}},
    )


def main():
    p = arguments(__doc__.splitlines()[0])
    o = p.parse_args()
    r = Results(o, "near_crystals")
    figure, axes = plt.subplots(1, 4, figsize=(16, 4))
    for n in (108, 256) if o.large else (108,):
        loss, order = [], []
        spreads = (1e-3, 3e-3, 1e-2, 3e-2)
        for deviation in spreads:
            e = ensemble(o, protocol(n, deviation), 60 if o.large else 6)
            rows = e.table()
            rows = rows[rows["jammed"] != 0]
            if len(rows) < 2:
                continue
            r.used(e, len(rows))
            phi = mean_error(rows["packing_fraction"])
            q6 = mean_error([np.mean(q) for q in e.each("bond_order")])
            loss.append((deviation, FCC - phi[0], phi[1]))
            order.append((deviation, *q6))
            label = f"N = {n}, spread {deviation:g}"
            r.add("10", f"phi_J, {label}", "none", *phi)
            r.add("10", f"Q_6, {label}", "none", *q6)
            r.add("10", f"excess contacts, {label}", "0: isostatic", rows["excess_contacts"].mean())
            gaps, forces = list(e.each("gaps")), list(e.each("forces"))
            for axis, values in ((axes[2], gaps), (axes[3], forces)):
                pool = np.sort(np.concatenate(values))
                axis.loglog(pool, np.arange(1, len(pool) + 1) / len(pool), label=label)
            cut = scaling.fit_power(forces, 0.3, 0.01)
            r.add("10", f"exponent of all forces on 0.01 ... 0.3, {label}", "none", cut.value, cut.error)
            low, high = 30 * n ** (-1 / (1 - GAMMA)) * deviation, 0.3 * deviation
            try:
                cut = scaling.fit_power(gaps, high, low)
                r.add(
                    "10",
                    f"exponent of gaps on {low:.1e} ... {high:.1e}, {label}",
                    "differs from -0.41",
                    cut.value,
                    cut.error,
                )
            except ValueError as problem:
                print(label, problem)
        loss, order = np.array(loss), np.array(order)
        axes[0].loglog(loss[:, 0], loss[:, 1], "o-", label=f"N = {n}")
        axes[1].semilogx(order[:, 0], order[:, 1], "o-")
        few = loss[loss[:, 0] <= 1e-2]
        power = np.polyfit(np.log(few[:, 0]), np.log(few[:, 1]), 1, w=few[:, 1] / np.maximum(few[:, 2], 1e-12))[0]
        r.add("10", f"power of the spread in phi_FCC - phi_J, spread <= 0.01, N = {n}", 1.0, power)
    axes[0].plot([1e-3, 3e-2], [2e-3, 6e-2], "k--", lw=1, label="slope 1")
    for axis, x, y in zip(
        axes, ("spread", "spread", "h", "f"), ("phi_FCC - phi_J", "Q_6", "cdf of gaps", "cdf of forces")
    ):
        axis.set(xlabel=x, ylabel=y)
    axes[0].legend(fontsize=8)
    axes[2].legend(fontsize=7)
    r.write(figure)


if __name__ == "__main__":
    main()
