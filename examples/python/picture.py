"""Pictures of a packing in two dimensions, and files for ParaView and OVITO.  usage: picture.py [PICTURE.png]"""
import sys

from matplotlib.figure import Figure

import jam

packing = jam.System.random(n=300, dim=2, seed=2, diameters=[1.0] * 150 + [1.4] * 150)
packing.compress(stages=[(3e-2, 1e4)])
packing.crunch()

figure = Figure(figsize=(11, 5.4), layout="constrained")
left, right = figure.subplots(1, 2)
jam.plot.packing(packing, left, forces=True)  # disks; bucklers and rattlers coloured, forces over them
jam.plot.network(packing, right)  # the force network alone, width by force
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "picture.png", dpi=120)

packing.write("picture.xyz")  # OVITO, ASE
jam.files.write_vtk(packing, "picture.vtp")  # ParaView: filter Glyph, sphere, scale by diameter
jam.files.write_vtk_network(packing, "picture-forces.vtp")  # filter Tube, vary radius by force
jam.files.write_csv(packing, "picture.csv")  # spreadsheets
print(packing.report)
