"""From nothing to a jammed packing in two dimensions, and its picture.  usage: first.py [PICTURE.png]"""
import sys

import jam

# 200 disks, half of them 1.4 times as large so that they do not crystallise
packing = jam.System.random(n=200, dim=2, seed=1, diameters=[1.0] * 100 + [1.4] * 100)
md = packing.compress(stages=[(3e-2, 500), (1e-2, 1e5)], progress=True)  # (growth rate, reduced pressure)
print(f"molecular dynamics: {md.collisions} collisions, p = {md.pressure:.3g}, phi = {md.packing_fraction:.6f}")

report = packing.crunch(progress=True)
print(report)
if not report.jammed:
    sys.exit("not jammed: " + report.stop_reason.name.lower())

packing.write("packing.xyz")  # for OVITO and ASE
jam.files.write_vtk_network(packing, "forces.vtp")  # for ParaView
jam.plot.packing(packing, forces=True).figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "packing.png", dpi=150)
