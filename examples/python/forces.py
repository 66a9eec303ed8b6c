"""Reads the contact network of a packing, checks the balance of forces, and compares forces at bucklers with the others."""
import numpy as np

import jam

packing = jam.System.random(n=128, dim=3, seed=1)
packing.compress()
packing.crunch()

contacts = packing.contacts  # pairs (m, 2), vectors (m, d), gaps (m,), forces (m,); row k is contact k
net = np.zeros((packing.n, packing.dim))
np.add.at(net, contacts.pairs[:, 0], contacts.forces[:, None] * contacts.vectors)  # vectors point from j to i
np.add.at(net, contacts.pairs[:, 1], -contacts.forces[:, None] * contacts.vectors)
print(f"{len(contacts)} forces, mean {contacts.forces.mean():.6f}, worst imbalance {np.abs(net).max():.1e}")
assert np.abs(net).max() < 1e-8

at_buckler = packing.bucklers[contacts.pairs].any(axis=1)  # these forces follow another power law
print(f"median force {np.median(contacts.forces):.3f}; at bucklers {np.median(contacts.forces[at_buckler]):.3f}")

gap, pair = packing.gaps(1.0, True)  # h_max, stable spheres only
print(f"{len(gap)} gaps below 1, the smallest {gap[0]:.2e} between {pair[0, 0]} and {pair[0, 1]}")
