"""The longest silence of a crunch between two calls of its progress callback, in processor time of the process, so that a
busy machine does not count.

usage: silence.py [N [SECONDS]]      a dilute start of N spheres, stopped after so much wall time
"""
import sys
import time

import jam


def main():
    n = int(sys.argv[1]) if len(sys.argv) > 1 else 16384
    limit = float(sys.argv[2]) if len(sys.argv) > 2 else 60.0
    packing = jam.System.random(n, 3, 1, packing_fraction=0.3)
    began = time.monotonic()
    told = [time.process_time()]

    def listen(progress):
        told.append(time.process_time())
        return time.monotonic() - began > limit

    report = packing.crunch(progress=listen)
    silence = max(b - a for a, b in zip(told, told[1:]))
    print(f"N = {n}, {report.factorisations} factorisations, {len(told) - 1} calls, longest silence {silence:.3f} s")


if __name__ == "__main__":
    main()
