"""Brings the packing of a file to its jamming point.  usage: crunch_file.py IN OUT [PICTURE.png]"""
import sys

import jam

packing = jam.System.read(sys.argv[1])  # plain text or extended XYZ
before = packing.packing_fraction
report = packing.crunch(wall_time=600, progress=True)  # seconds; what was reached by then is kept
print(
    f"phi {before:.6f} -> {report.packing_fraction:.12f} ({report.stop_reason.name.lower()}), {report.contacts} contacts "
    f"({report.excess_contacts} more than one state of self-stress needs), {report.rattlers} rattlers"
)
print(f"certificate: overlap {report.max_overlap:.1e}, force imbalance {report.force_residual:.1e}")

steps = packing.history  # a structured array, one row a step of the crunch
print(f"{len(steps)} steps; the density gained by the last: {steps['gain'][-1]:.1e}")

packing.write(sys.argv[2])
if len(sys.argv) > 3:
    jam.plot.summary(packing).savefig(sys.argv[3], dpi=120)
sys.exit(not report.jammed)
