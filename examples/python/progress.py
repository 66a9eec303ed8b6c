"""Watching and stopping a long call: a progress function, another thread, Ctrl-C. The state stays valid each time."""
import threading

import jam

packing = jam.System.random(n=500, dim=3, seed=1)


def watch(p):
    print(f"  {p.phase.name.lower()}: phi {p.packing_fraction:.6f} after {p.seconds:.1f} s")
    return p.packing_fraction > 0.3 or p.steps >= 3  # true stops the call


report = packing.crunch(progress=watch)
print(f"stopped by the function: {report.status.name}, phi = {packing.packing_fraction:.6f}")

threading.Timer(0.5, packing.cancel).start()
report = packing.crunch()
print(f"stopped by another thread: {report.status.name}, phi = {packing.packing_fraction:.6f}")

try:
    packing.crunch(progress=lambda p: 1 / 0)
except ZeroDivisionError:
    print("an exception in the function comes out of the call")

report = packing.crunch(max_lps=1)  # limits are no errors either
print(f"stopped by a limit: {report.status.name}, and going on from there is another call")
