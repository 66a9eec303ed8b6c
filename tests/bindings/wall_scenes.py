"""Scenes with walls, and what tests compute of them from positions alone: distances, gaps, energies, growth."""
import jam
import numpy as np
from jamming_oracle import vectors

#: Their packings are jammed without flexes for the seeds of the tests
SCENES = {
    "lines": {"dim": 2, "walls": "y", "cell": [2, 1]},
    "strip": {"dim": 2, "walls": "y"},
    "box": {"dim": 2, "walls": "xy"},
    "circle": {"dim": 2, "container": "ball"},
    "slit": {"walls": "z", "cell": [1, 1, 1.3]},
    "brick": {"walls": "xyz"},
    "tube": {"container": "cylinder", "cell": [1, 1, 1.5]},
    "can": {"container": "cylinder", "walls": "z"},
    "ball": {"container": "ball"},
    "cone": {"container": "cone", "walls": "z"},
}
#: Others, narrow in one direction, for fluids and the void
NARROW = {
    "slit": {"cell": [1, 1, 0.5], "walls": "z"},
    "duct": {"cell": [0.6, 1, 0.5], "walls": "xz"},
    "box": {"cell": [0.7, 0.8, 0.5], "walls": "xyz"},
    "tube": {"container": "cylinder", "cell": [1, 1, 0.9]},
    "can": {"container": "cylinder", "cell": [1, 1, 0.6], "walls": "z"},
    "ball": {"container": "ball"},
    "lines": {"dim": 2, "walls": "y"},
    "square": {"dim": 2, "walls": "xy", "cell": [1, 0.8]},
    "circle": {"dim": 2, "container": "ball"},
}


def start(name, n, seed, phi=0.15, **more):
    sizes = {"diameters": 0.5 + 0.6 * (0.618 * np.arange(n) % 1)} if more.pop("unequal", False) else {}
    return jam.System.random(n=n, seed=seed, packing_fraction=phi, **sizes, **SCENES[name], **more)


def closed_axes(scene, dim):
    kind, letters = scene.get("container"), scene.get("walls", "")
    return [c for c in range(dim) if "xyzw"[c] in letters or kind == "ball" or (kind in ("cylinder", "cone") and c < 2)]


def wall_distances(scene, x, edges):
    """(n, walls) distances, (n, walls, d) directions away from each wall: flat ones axis by axis, then the round one."""
    d, kind = x.shape[1], scene.get("container")
    distance, normal = [], []
    for letter in scene.get("walls", ""):
        c = "xyz".index(letter)
        for side in (0, 1):
            distance.append(edges[c] - x[:, c] if side else x[:, c])
            normal.append(np.tile((1 - 2 * side) * np.eye(d)[c], (len(x), 1)))
    if kind:
        flat = x - edges / 2
        flat[:, (d if kind == "ball" else 2) :] = 0
        r = np.linalg.norm(flat, axis=1)
        # Of a cone half as wide at the end of z, whose generators and axis enclose the angle a.
        a = np.arctan(edges[0] / 4 / edges[-1]) if kind == "cone" else 0.0
        distance.append(np.cos(a) * (edges[0] / 2 - r) - np.sin(a) * x[:, -1])
        normal.append(-np.cos(a) * flat / np.maximum(r, 1e-300)[:, None] - np.sin(a) * np.eye(d)[-1])
    return np.array(distance).T, np.array(normal).transpose(1, 0, 2)


def open_cell(scene, edges):
    """Lattice vectors of the axes that repeat; far apart along walls."""
    return np.diag(np.where(np.isin(np.arange(len(edges)), closed_axes(scene, len(edges))), 1e3, edges))


def away(scene, s, r):
    """The nearest images of vectors."""
    edges = np.diag(open_cell(scene, np.diag(s.cell)))
    return r - edges * np.round(r / edges)


def all_gaps(scene, s):
    """(h, i, j, n, distance) of all near pairs and walls."""
    x, sigma, edges = s.positions, s.diameters, np.diag(s.cell)
    found = []
    for i, j, r in vectors(x, open_cell(scene, edges), 1):
        length = np.linalg.norm(r)
        if i != j and length < 2 * sigma.max():
            found.append((2 * length / (sigma[i] + sigma[j]) - 1, i, j, r / length, length))
    distance, normal = wall_distances(scene, x, edges)
    for i, w in np.ndindex(distance.shape):
        found.append((2 * distance[i, w] / sigma[i] - 1, i, -1 - w, normal[i, w], distance[i, w]))
    return found


def overlaps(scene, x, s):
    """(overlap, contact distance, i, j) of all pairs and walls, touching or not."""
    edges, cell, radius = np.diag(s.cell), np.diag(open_cell(scene, np.diag(s.cell))), s.diameters / 2
    i, j = np.triu_indices(len(x), 1)
    r = x[i] - x[j]
    shifts = np.stack(np.meshgrid(*[[-1, 0, 1]] * s.dim), -1).reshape(-1, s.dim) * cell
    length = np.linalg.norm(r[None] + shifts[:, None], axis=2)
    sigma = np.broadcast_to(radius[i] + radius[j], length.shape)
    distance = wall_distances(scene, x, edges)[0]
    k, w = np.indices(distance.shape)
    i, j = (np.concatenate([np.broadcast_to(a, length.shape).ravel(), b.ravel()]) for a, b in ((i, k), (j, -1 - w)))
    sigma = np.concatenate([sigma.ravel(), np.broadcast_to(radius[:, None], distance.shape).ravel()])
    return sigma - np.concatenate([length.ravel(), distance.ravel()]), sigma, i, j


def energy(scene, x, s, scale="relative", alpha=2.0):
    """Of soft spheres."""
    delta, sigma, _, _ = overlaps(scene, x, s)
    inside = np.maximum(delta, 0) / (sigma if scale == "relative" else 1)
    return (inside**alpha).sum() / (1 if scale == "bare" else alpha)


def largest_growth(scene, s, x):
    """Factor by which the diameters may be multiplied with the spheres at x."""
    delta, sigma, _, _ = overlaps(scene, x, s)
    return (1 - delta / sigma).min()


def contact_rows(s):
    """Rows n . (u_i - u_j) of the contacts of the network, and the distances of both centres; 0 at walls."""
    (i, j), v, k = s.contacts.pairs.T, s.contacts.vectors, np.arange(len(s.contacts.pairs))
    rows, pair = np.zeros((len(k), s.n, s.dim)), j >= 0
    rows[k, i] = v
    rows[k[pair], j[pair]] -= v[pair]
    return rows.reshape(len(k), -1), np.where(pair, s.diameters[i] / 2 + s.diameters[np.maximum(j, 0)] / 2, 0)
