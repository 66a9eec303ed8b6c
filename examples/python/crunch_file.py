"""Brings somebody's packing to its jamming point and tells forces, gaps and modes.  usage: crunch_file.py FILE [PICTURE.png]"""
import sys

import numpy as np

import jam

packing = jam.System.read(sys.argv[1])
report = packing.crunch()
print(f"phi_J = {report.packing_fraction:.12f}, {report.contacts} contacts ({report.excess_contacts} more than one state of "
      f"self-stress needs), {report.rattlers} rattlers, force residual {report.force_residual:.1e}")

contacts = packing.contacts                                  # pairs, vectors, gaps, forces; row k is contact k
at_buckler = packing.bucklers[contacts.pairs].any(axis=1)    # these forces follow another power law
print(f"median force {np.median(contacts.forces):.3f}; at bucklers {np.median(contacts.forces[at_buckler]):.3f}")

gaps = packing.gaps(1.0, True)                               # h_max, stable spheres only
print(f"{len(gaps.gap)} gaps below 1, the smallest {gaps.gap[0]:.2e}")

modes = packing.modes(10)
print("lowest frequencies", np.array2string(modes.frequencies, precision=4))
hessian = packing.hessian()                                  # scipy.sparse.csr_matrix
print(f"Hessian {hessian.shape[0]} x {hessian.shape[1]}, {hessian.nnz} entries, trace {hessian.diagonal().sum():.6g}")

if len(sys.argv) > 2:
    jam.plot.summary(packing).savefig(sys.argv[2], dpi=120)
