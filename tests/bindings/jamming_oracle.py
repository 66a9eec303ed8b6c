"""Jammed or not by another arithmetic than the library's: largest support of a self-stress by HiGHS, rank by SVD.

Contacts are found by brute force over all images. Nothing of the library is used.
"""
import itertools

import numpy as np
from scipy.optimize import linprog


def vectors(positions, cell, reach=2):
    """(i, j, r) of all images within `reach` cells, i <= j; of a sphere and itself one of each opposite pair."""
    n, d = positions.shape
    shifts = np.array(list(itertools.product(range(-reach, reach + 1), repeat=d))) @ cell
    for i in range(n):
        for j in range(i, n):
            r = positions[i] - positions[j] + shifts
            if i == j:
                first = [next((x for x in v if abs(x) > 1e-12), 0.0) for v in r]
                r = r[np.array(first) > 0]
            yield from ((i, j, v) for v in r)


def contacts(positions, diameters, cell, tolerance, own_images, non_additivity=0.0, reach=2):
    out, nearest = [], np.inf
    for i, j, r in vectors(positions, cell, reach):
        sigma = 0.5 * (diameters[i] + diameters[j])
        if diameters[i] != diameters[j]:
            sigma *= 1 + non_additivity
        length = np.linalg.norm(r)
        nearest = min(nearest, length / sigma - 1)
        if length / sigma - 1 < tolerance and (own_images or i != j):
            out.append((i, j, r / length, length))
    return out, nearest


def rigidity_rows(found, n, d, strict):
    rows = np.zeros((len(found), n * d))
    strain = np.zeros((len(found), d * (d + 1) // 2))
    upper = np.triu_indices(d)
    for k, (i, j, u, length) in enumerate(found):
        rows[k, i * d : i * d + d] += u
        rows[k, j * d : j * d + d] -= u
        strain[k] = np.outer(u, u)[upper] * np.where(upper[0] == upper[1], 1, 2) * length
    return (rows, strain) if strict else (rows, None)


def support(rows, strain, d):
    """Which contacts carry force in some non-negative balance: max sum t with f >= t, 0 <= t <= 1."""
    m = len(rows)
    balance = [np.hstack([rows.T, np.zeros((rows.shape[1], m + 1))])]
    if strain is not None:  # the virial is a pressure: a multiple of the unit matrix
        upper = np.triu_indices(d)
        unit = (upper[0] == upper[1]).astype(float)
        balance.append(np.hstack([strain.T, np.zeros((len(unit), m)), -unit[:, None]]))
    equal = np.vstack(balance)
    less = np.hstack([-np.eye(m), np.eye(m), np.zeros((m, 1))])
    cost = np.concatenate([np.zeros(m), -np.ones(m), [0.0]])
    bounds = [(0, None)] * m + [(0, 1)] * m + [(0, None)]
    found = linprog(cost, less, np.zeros(m), equal, np.zeros(len(equal)), bounds, method="highs")
    assert found.status == 0, found.message
    return found.x[m : 2 * m] > 0.5


def judge(positions, diameters, cell, strict=False, tolerance=1e-9, non_additivity=0.0, reach=2):
    """(jammed, contacts with force, flexes) of all pairs with gaps below the tolerance, taken as closed."""
    n, d = positions.shape
    found, _ = contacts(positions, diameters, cell, tolerance, strict, non_additivity, reach)
    if not found:
        return False, 0, -1
    rows, strain = rigidity_rows(found, n, d, strict)
    on = support(rows, strain, d)
    if not on.any():
        return False, 0, -1
    spheres = sorted({q for k in np.flatnonzero(on) for q in found[k][:2]})
    columns = np.concatenate([np.arange(b * d, b * d + d) for b in spheres])
    kept = rows[np.ix_(on, columns)]
    if strict:  # and no growth: the trace of the strain is 0
        upper = np.triu_indices(d)
        trace = np.concatenate([np.zeros(len(columns)), (upper[0] == upper[1]).astype(float)])
        kept = np.vstack([np.hstack([kept, strain[on]]), trace])
    values = np.linalg.svd(kept, compute_uv=False)
    flexes = kept.shape[1] - d - int((values > 1e-6 * values[0]).sum())
    return flexes == 0, int(on.sum()), flexes
