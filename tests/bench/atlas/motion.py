"""The reduced pressure of a fluid by molecular dynamics: error against time, and the error that libjam itself reports."""
import time

import numpy as np

import jam

N, REPEATS = 1024, 8


def pressures(fraction, lengths=(10, 30, 100, 300, 1000, 3000)):
    """Runs of several lengths (collisions a sphere) from independent states of one packing fraction, and p of a long run."""
    starts = []
    for seed in range(1, REPEATS + 1):
        fluid = jam.System.random(N, 3, seed, packing_fraction=min(fraction, 0.3))
        if fraction > 0.3:
            fluid.compress([dict(growth_rate=1e-2, packing_fraction=fraction)])
        fluid.run(300)
        starts.append(fluid)
    rows = []
    for length in lengths:
        found, reported, seconds = [], [], []
        for start in starts:
            began = time.process_time()
            run = start.copy().run(length)
            seconds.append(time.process_time() - began)
            found.append(run.pressure)
            reported.append(run.pressure_error)
        rows.append(
            dict(
                collisions=length,
                seconds=float(np.median(seconds)),
                mean=float(np.mean(found)),
                scatter=float(np.std(found, ddof=1)),
                reported=float(np.median(reported)),
            )
        )
    # p - 1 of N spheres at rest as a whole is N / (N - 1) times the thermodynamic one.
    published = 1.0 + (jam.eos("carnahan_starling", 3, fraction, 0.64) - 1.0) * N / (N - 1)
    return dict(fraction=fraction, carnahan_starling=published, rows=rows)
