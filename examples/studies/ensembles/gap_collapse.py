#!/usr/bin/env python3
"""Why does the collapse of gaps prefer an exponent below gamma? Looks into figure 4.6, a row of finite_size.py.

usage: gap_collapse.py [--large] [--kappa K] [--folder DIR] [--only-read]

--kappa grows more slowly than the default protocol (9e-4), and names the results after it.
Three suspects: the error of the collapse is too small; the smallest N has another density of gaps altogether; the range holds gaps so
wide that they follow no power law. Synthetic packings follow the law exactly, with as many gaps and packings as the real ones.
"""
import matplotlib.pyplot as plt
import numpy as np
from common import GAMMA, G_OF_KAPPA, Results, arguments, ensemble, mean_error
from finite_size import CROSSOVER, Size, protocol

from jam import scaling

BULK = 0.1  # gaps up to here: tail and shoulder, no second shell
BEND = 0.3  # scaled gap where the law goes over into the part linear in h


def grown(n, kappa):
    """The protocol of finite_size.py, with another growth rate where kappa is given."""
    if not kappa:
        return protocol("euclid", n)
    stages = [{"growth_rate": 1e-2, "pressure": 500.0}, {"growth_rate": kappa * G_OF_KAPPA, "pressure": 1e7}]
    return dict(n=n, dim=3, stages=stages)


def collapsed(samples, top, resamples=20):
    grid = lambda n: np.geomspace(0.1, top, 30) * n ** (-1 / (1 - GAMMA))  # noqa: E731
    return scaling.collapse(samples, grid, [-GAMMA], resamples=resamples)


def synthetic(rng, real):
    """Packings with the exact law up to BULK, as many as there are, with as many gaps each."""
    made = {}
    for n, samples in real.items():
        bend = BEND * n ** (-1 / (1 - GAMMA)) / BULK
        made[n] = [BULK * scaling.draw_left_power(rng, len(g), -GAMMA, bend) for g in samples]
    return made


def powers(r, samples, n, text):
    """Gaps a sphere below h, and the power of h from one decade to the next; errors over packings."""
    below = {h: np.array([np.sum(g < h) / n for g in samples]) for h in (1e-4, 1e-3, 1e-2, 1e-1)}
    for h in below:
        r.add("6.5.5", f"gaps below {h:g} a sphere{text}N = {n}", "none", *mean_error(below[h]))
    for low, high in ((1e-4, 1e-3), (1e-3, 1e-2), (1e-2, 1e-1)):
        few, many = below[low], below[high]
        power = np.log10(many.mean() / few.mean())
        error = mean_error(many / many.mean() - few / few.mean())[1] / np.log(10)
        law = scaling.crossover(np.array([low, high]) * n ** (1 / (1 - GAMMA)), *CROSSOVER, -GAMMA)
        row = f"power of h in the number of gaps, h = {low:g} to {high:g}{text}N = {n}"
        r.add("6.5.5", row, ("law of Mari-Kurchan packings", round(float(np.log10(law[1] / law[0])), 4)), power, error)


def main():
    p = arguments(__doc__.splitlines()[0])
    p.add_argument("--sizes", type=int, nargs="+", help="N (small: 100 200 400; large: 256 512 1024 2048)")
    p.add_argument("--particles", type=float, default=5e4, help="with --large: particles a size (5e4)")
    p.add_argument("--trials", type=int, default=30, help="synthetic sets (30)")
    p.add_argument("--kappa", type=float, help="radius rate from p = 500 to 1e7 (that of the default protocol, 9e-4)")
    o = p.parse_args()
    r = Results(o, f"gap_collapse_kappa{o.kappa:g}" if o.kappa else "gap_collapse")
    every, clear, tail = {}, {}, {}
    for n in o.sizes or ((256, 512, 1024, 2048) if o.large else (100, 200, 400)):
        e = ensemble(o, grown(n, o.kappa), round(o.particles / n) if o.large else 3200 // n)
        s = Size(e, "euclid")
        if len(s.rows) >= 4:
            every[n], clear[n], tail[n] = s.gaps, s.clear, [g[g < BULK] for g in s.gaps]
    found = collapsed(every, 15)
    r.add("6.5.5", "collapse, scaled h up to 15", -GAMMA, found.value[0], found.error[0])
    if len(every) > 2:
        rest = {n: g for n, g in every.items() if n > min(every)}
        found = collapsed(rest, 200)
        r.add("6.5.5", f"collapse, up to 200, without N = {min(every)}", -GAMMA, found.value[0], found.error[0])
    for n, samples in every.items():
        powers(r, samples, n, f", kappa = {o.kappa or 9e-4:g}, ")
        powers(r, clear[n], n, f", kappa = {o.kappa or 9e-4:g}, without bucklers, ")
    rng = np.random.default_rng(1)
    drawn = [collapsed(synthetic(rng, tail), 200, 12) for _ in range(o.trials)]
    value = np.array([f.value[0] for f in drawn])
    r.add("6.5.5", "synthetic packings with the published law: collapse", ("true", -GAMMA), *mean_error(value))
    r.add("6.5.5", f"largest S of {o.trials} synthetic sets", "about 1", max(f.quality for f in drawn))
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.5))
    for n, samples in every.items():
        h = np.geomspace(1e-5, 0.5, 60)
        counts = np.array([np.searchsorted(np.sort(g), h) / n for g in samples])
        mean, error = counts.mean(axis=0), counts.std(axis=0, ddof=1) / len(counts) ** 0.5
        axes[0].errorbar(h, mean / h ** (1 - GAMMA), error / h ** (1 - GAMMA), lw=1, label=f"N = {n}")
    axes[0].set(xscale="log", xlabel="h", ylabel="gaps a sphere below h, over h^(1-gamma)")
    axes[1].hist(value, 15, label="synthetic, law exact")
    axes[1].axvline(-GAMMA, color="k", lw=1, label="-gamma")
    axes[1].axvline(collapsed(every, 200, 2).value[0], color="C1", label="real packings")
    axes[1].set(xlabel="exponent by collapse", ylabel="sets")
    axes[0].legend(fontsize=8), axes[1].legend(fontsize=8)
    r.write(figure)


if __name__ == "__main__":
    main()
