"""Hessian, vibrational modes, density of states and moduli of a packing.  usage: modes.py [PICTURE.png]"""
import sys

import numpy as np

import jam

packing = jam.System.random(n=200, dim=2, seed=1, diameters=[1.0] * 100 + [1.4] * 100)
packing.crunch()

hessian = packing.hessian()  # scipy.sparse.csr_matrix; 'hard' and 'power' are other stiffnesses
print(f"Hessian {hessian.shape[0]} x {hessian.shape[1]}, {hessian.nnz} entries, trace {hessian.diagonal().sum():.6g}")

modes = packing.modes(8)  # the lowest; which='all' gives every one
for omega, spread in zip(modes.frequencies, modes.participation):
    print(f"omega {omega:.5f}  participation {spread:.4f}")
u = modes.vectors[0].reshape(-1)  # (N', d): displacements of the stable spheres modes.spheres
assert abs(u @ hessian @ u / modes.values[0] - 1) < 1e-6

moduli = packing.moduli()
print(
    f"bulk modulus {moduli.bulk:.4f} ({moduli.bulk_affine:.4f} were all displacements affine), shear modulus {moduli.shear:.4f}"
)

if len(sys.argv) > 1:
    every = packing.modes(which="all")
    ax = jam.plot.density_of_states(every)
    smooth = packing.density_of_states(moments=80)  # without computing modes: for large packings
    ax.plot(smooth.omega, smooth.density, lw=1, color="0.4")
    ax.set_title(f"{len(every)} modes of {len(every.spheres)} stable disks", fontsize=10)
    ax.figure.savefig(sys.argv[1], dpi=120)
    print(f"integral of D(omega) {np.trapz(smooth.density, smooth.omega):.3f}")
