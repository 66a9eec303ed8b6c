"""Processor time of jam.digits.refine against digits and spheres: d = 3, ratio 1.4, after a crunch.

usage: digits.py     writes results/digits.json, from which figures.py makes the table of the page on proofs
"""
import sys
import time
from pathlib import Path

import jam
import jam.digits

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "bindings/docs"))

import figures  # noqa: E402

rows = []
for n, digits in ((64, 100), (64, 1000), (256, 100), (256, 1000), (1024, 100), (1024, 1000)):
    packing = jam.System.random(n=n, dim=3, seed=1, diameters=[1.0, 1.4] * (n // 2))
    packing.compress()
    packing.crunch()
    begun = time.process_time()
    found = jam.digits.refine(packing, digits)
    rows.append([n, digits, found.steps, round(time.process_time() - begun, 3)])
figures.save(HERE / "results/digits.json", "digits.py", ["N", "digits", "Newton's steps", "seconds of processor time"], rows)
