"""Symmetries of a packing between walls, for the proof of a largest sum of radii with more contacts than unknowns.

A symmetry is a signed permutation of the axes about the middle of the cell that takes each sphere to one of its size and
weight, and contacts to contacts. With it unknowns and equations have orbits, and those may be equal in number.
"""
from __future__ import annotations

import itertools
from typing import Any, Iterator, NamedTuple

import numpy as np

from ._api.arrays import Array

NEAR = 1e-9  # of centres and radii that are symmetric, in units of the box: a hint, the proof is of exact ones


class Symmetry(NamedTuple):
    """Component k of the image of x is component axes[k] of x, mirrored if signs[k] < 0. Sphere i goes to sphere to[i]."""

    axes: tuple[int, ...]
    signs: tuple[int, ...]
    to: tuple[int, ...]

    def after(self, other: Symmetry) -> Symmetry:
        """Of both, the other one first."""
        axes = tuple(other.axes[k] for k in self.axes)
        signs = tuple(s * other.signs[k] for k, s in zip(self.axes, self.signs))
        return Symmetry(axes, signs, tuple(self.to[i] for i in other.to))

    def words(self) -> str:
        """As a proof file has it."""
        return " ".join(str((a + 1) * s) for a, s in zip(self.axes, self.signs)) + " " + " ".join(map(str, self.to))


class Fold(NamedTuple):
    """Orbits under a group: of each unknown its first one and the sign to it (0: it cannot move), and of each equation."""

    generators: list[Symmetry]
    first: Array
    sign: Array
    row: Array

    @property
    def unknowns(self) -> Array:
        return np.flatnonzero((self.first == np.arange(len(self.first))) & (self.sign != 0))

    @property
    def rows(self) -> Array:
        return np.flatnonzero(self.row == np.arange(len(self.row)))

    def matrix(self) -> Array:
        """Displacements of all unknowns from those of the orbits."""
        found = np.zeros((len(self.first), len(self.unknowns)))
        free = np.flatnonzero(self.sign)
        found[free, np.searchsorted(self.unknowns, self.first[free])] = self.sign[free]
        return found


def symmetries(x: Array, radii: Array, weights: list[Any], edge: Array) -> Iterator[Symmetry]:
    """All of a packing but the identity."""
    n, d = x.shape
    for axes in itertools.permutations(range(d)):
        if any(edge[k] != edge[a] for k, a in enumerate(axes)):
            continue
        for signs in itertools.product((1, -1), repeat=d):
            image = np.where(np.array(signs) > 0, x[:, axes], edge - x[:, axes])
            to = [int(np.argmin(abs(x - row).max(1))) for row in image]
            same = abs(x[to] - image).max() < NEAR and abs(radii[to] - radii).max() < NEAR
            if same and len(set(to)) == n and all(weights[i] == weights[p] for i, p in enumerate(to)) and to != list(range(n)):
                yield Symmetry(axes, signs, tuple(to))


def _group(generators: list[Symmetry]) -> list[Symmetry]:
    found = list(generators)
    for g in found:
        found += [new for h in generators if (new := h.after(g)) not in found]
    return found


def _fold(generators: list[Symmetry], contacts: list[tuple[int, int]], walls: list[tuple[int, bool]], n: int, d: int) -> Fold | None:
    """None where a contact goes to a pair that is none."""
    size = n * (d + 1)
    first, sign, row = np.arange(size), np.ones(size, int), np.arange(len(contacts))
    at = {c: k for k, c in enumerate(contacts)}
    for g in _group(generators):
        for i, p in enumerate(g.to):
            for k in range(d + 1):
                a, b, s = i * (d + 1) + (g.axes[k] if k < d else d), p * (d + 1) + k, g.signs[k] if k < d else 1
                if a == b and s < 0:
                    sign[a] = 0
                if a < first[b]:
                    first[b], sign[b] = a, s * abs(sign[b])
        for (i, j), k in at.items():
            if j < 0:
                axis, far = walls[-1 - j]
                to = g.axes.index(axis)
                end = -1 - walls.index((to, far == (g.signs[to] > 0)))
                image = g.to[i], end
            else:
                image = min(g.to[i], g.to[j]), max(g.to[i], g.to[j])
            if image not in at:
                return None
            row[at[image]] = min(row[at[image]], row[k])
    return Fold(generators, first, sign, row)


def square_fold(
    x: Array, radii: Array, weights: list[Any], edge: Array, contacts: list[tuple[int, int]], walls: list[tuple[int, bool]]
) -> Fold | None:
    """Orbits as many of contacts as of unknowns, of no symmetry if that does."""
    n, d = x.shape
    all_of_them = list(symmetries(x, radii, weights, edge)) if len(contacts) > n * (d + 1) else []
    tried: list[list[Symmetry]] = [[], *([g] for g in all_of_them), all_of_them]
    for some in tried + [list(two) for two in itertools.combinations(all_of_them, 2)]:
        fold = _fold(some, contacts, walls, n, d)
        if fold is not None and len(fold.rows) == len(fold.unknowns):
            return fold
    return None
