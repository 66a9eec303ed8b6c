"""States from molecular dynamics for the benchmarks of crunch, stored in a folder and reused."""
import os
import time


def grown(n, seed, stages, folder=None):
    """n spheres in d = 3 after stages of (growth rate, pressure), and the seconds that took; NaN seconds for a state found in the folder."""
    import jam

    name = "-".join([f"n{n}", f"seed{seed}"] + [f"{growth:g}-{pressure:g}" for growth, pressure in stages]) + ".dat"
    kept = os.path.join(folder, name) if folder else ""
    if os.path.exists(kept):
        return jam.System.read(kept), float("nan")
    system = jam.System.random(n, 3, seed)
    began = time.process_time()
    system.compress(stages)
    if kept:
        system.write(kept)
    return system, time.process_time() - began
