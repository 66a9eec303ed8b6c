"""Many seeds on all cores: systems go through a process pool by pickle.  usage: ensemble.py [SEEDS [PICTURE.png]]"""
import os
import sys
from concurrent.futures import ProcessPoolExecutor

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # one thread each: the processes share the cores

import numpy as np  # noqa: E402

import jam  # noqa: E402


def make(seed):
    packing = jam.System.random(n=128, dim=2, seed=seed, diameters=[1.0] * 64 + [1.4] * 64)
    packing.compress(growth_rate=3e-2, pressure=1e4)
    packing.crunch()
    return packing  # with its report and contacts


if __name__ == "__main__":
    seeds = range(1, 1 + (int(sys.argv[1]) if len(sys.argv) > 1 else 8))
    with ProcessPoolExecutor() as pool:
        packings = [p for p in pool.map(make, seeds) if p.report.jammed]
    phi = np.array([p.packing_fraction for p in packings])
    print(
        f"{len(packings)} of {len(seeds)} jammed; phi_J = {phi.mean():.5f} +- {phi.std(ddof=1) / np.sqrt(len(phi)):.5f}"
    )
    forces = np.concatenate([p.forces for p in packings])
    print(f"{len(forces)} forces, mean {forces.mean():.6f}, smallest {forces.min():.2e}")
    if len(sys.argv) > 2:
        jam.plot.cdf(forces, slopes=[1.19], label="forces").figure.savefig(sys.argv[2], dpi=120)
