"""The solid of spheres that overlap: volumes of their union, against closed forms, sums of arcs and random points."""
import itertools
import json
import math
import os
import subprocess
import tempfile
import unittest

import jam
import numpy as np
from packings import InFolder

PACK = os.environ.get("JAM_PACK")


def soft(x, radii, **options):
    x = np.asarray(x, float)
    return jam.System.from_arrays(x, 2 * np.broadcast_to(radii, len(x)).astype(float), dim=x.shape[1], overlap="allow", **options)


def lens(a, b, d, dim):
    """What two balls share, neither inside the other (Weisstein, MathWorld: Sphere-Sphere, Circle-Circle Intersection)."""
    if dim == 3:
        return math.pi * (a + b - d) ** 2 * (d * d + 2 * d * (a + b) - 3 * (a - b) ** 2) / (12 * d)
    root = math.sqrt((-d + a + b) * (d + a - b) * (d - a + b) * (d + a + b))
    first = a * a * math.acos((d * d + a * a - b * b) / (2 * d * a))
    return first + b * b * math.acos((d * d + b * b - a * a) / (2 * d * b)) - root / 2


def ball(r, dim):
    return math.pi * r * r if dim == 2 else 4 / 3 * math.pi * r**3


def union_of_disks(x, r):
    """Area inside any of the disks, by Green's theorem along the arcs that lie in no other disk."""
    area = 0.0
    for i, (c, a) in enumerate(zip(x, r)):
        covered = []
        for j, (q, b) in enumerate(zip(x, r)):
            d = math.dist(c, q)
            if j == i or d >= a + b or b <= a - d:
                continue
            if a <= b - d:
                covered = [(0, 2 * math.pi)]
                break
            middle, half = math.atan2(q[1] - c[1], q[0] - c[0]), math.acos((d * d + a * a - b * b) / (2 * d * a))
            low = (middle - half) % (2 * math.pi)
            covered += [(low, min(low + 2 * half, 2 * math.pi)), (0, low + 2 * half - 2 * math.pi)]
        at = 0.0
        for low, high in [*sorted(s for s in covered if s[1] > s[0]), (2 * math.pi, 2 * math.pi)]:
            if low > at:
                turn = (math.sin(low) - math.sin(at), math.cos(at) - math.cos(low))
                area += (a * a * (low - at) + a * (c[0] * turn[0] + c[1] * turn[1])) / 2
            at = max(at, high)
    return area


def union_of_balls(x, r, steps=4000):
    """The same in space, by Simpson's rule over heights between those where circles appear or vanish."""
    ends = sorted({v for c, a in zip(x, r) for v in (c[2] - a, c[2] + a)})
    total = 0.0
    for low, high in zip(ends, ends[1:]):
        t = np.linspace(0, math.pi, steps + 1)  # dense at both ends
        z, dz = (low + high) / 2 - (high - low) / 2 * np.cos(t), (high - low) / 2 * np.sin(t)
        area = []
        for height in z:
            cut = [(c[:2], math.sqrt(a * a - (height - c[2]) ** 2)) for c, a in zip(x, r) if abs(height - c[2]) < a]
            area.append(union_of_disks([c for c, _ in cut], [a for _, a in cut]))
        weight = np.ones(steps + 1)
        weight[1:-1:2], weight[2:-1:2] = 4, 2
        total += (weight * area * dz).sum() * (t[1] - t[0]) / 3
    return total


def solid(s, axis=0):
    return float(s.solid_profile(axis, 1).solid[0])


def inside(s, points, options):
    """Which points lie in a sphere or an image of one."""
    closed = {"ball": "xyz", "cylinder": "xy"}.get(options.get("container"), "") + options.get("walls", "")
    steps = [(0,) if axis in closed else (-1, 0, 1) for axis in "xyz"[: s.dim]]
    found = np.zeros(len(points), bool)
    for shift in np.array(list(itertools.product(*steps))) @ s.cell:
        for x, r in zip(s.positions, s.radii):
            found |= ((points - x - shift) ** 2).sum(1) < r * r
    return found


class ClosedForms(unittest.TestCase):
    def test_two_spheres(self):
        for dim in (2, 3):
            for a, b, d in ((0.2, 0.2, 0.3), (0.25, 0.1, 0.3), (0.25, 0.1, 0.2), (0.3, 0.05, 0.26), (0.2, 0.2, 1e-3)):
                x = np.full((2, dim), 0.5)
                x[1] += d * np.array([0.6, 0.8, 0.0][:dim])
                s = soft(x, [a, b])
                exact = ball(a, dim) + ball(b, dim) - lens(a, b, d, dim)
                for axis in range(dim):
                    self.assertAlmostEqual(solid(s, axis), exact, 13)
                    self.assertAlmostEqual(s.solid_profile(axis, 37).solid.mean(), exact, 13)

    def test_a_sphere_inside_another(self):
        for dim in (2, 3):
            for centre in (0.5, 0.55):
                s = soft([[0.5] * dim, [centre] * dim], [0.3, 0.1])
                self.assertAlmostEqual(solid(s), ball(0.3, dim), 13)

    def test_spheres_with_one_centre_count_once(self):
        """Copies and smaller spheres at the same centre change nothing, in any order of rows."""
        for x in ([[0.3, 0.3], [0.5, 0.4]], [[0.25, 0.25, 0.75], [0.5, 0.25, 0.75], [0.5, 0.5, 0.75]]):
            dim = len(x[0])
            true = soft(x, 0.25, cell=[1] * dim).solid_profile(0, 1).solid[0]
            more, radii = x + [x[-1], x[0], x[-1]], [0.25] * len(x) + [0.25, 0.125, 0.25]
            for order in itertools.islice(itertools.permutations(range(len(more))), 0, None, 7):
                s = soft([more[k] for k in order], [radii[k] for k in order], cell=[1] * dim)
                self.assertAlmostEqual(s.solid_profile(0, 1).solid[0], true, 13)

    def test_few_spheres_by_arcs(self):
        rng = np.random.default_rng(3)
        for n, dim in ((3, 2), (6, 2), (9, 2), (3, 3), (5, 3)):
            x, r = rng.uniform(0.3, 0.7, (n, dim)), rng.uniform(0.1, 0.29, n)
            exact = union_of_disks(x, r) if dim == 2 else union_of_balls(x, r)
            self.assertAlmostEqual(solid(soft(x, r)), exact, 12 if dim == 2 else 7)


SCENES = (
    ("periodic", 2, {}),
    ("periodic", 3, {}),
    ("tilted", 3, {"cell": [[1, 0, 0], [0.3, 1.1, 0], [0.2, -0.4, 0.9]]}),
    ("brick", 2, {"walls": "xy"}),
    ("brick", 3, {"walls": "xyz"}),
    ("circle", 2, {"container": "ball"}),
    ("ball", 3, {"container": "ball"}),
    ("cylinder", 3, {"container": "cylinder", "cell": [1, 1, 1.3]}),
    ("closed cylinder", 3, {"container": "cylinder", "walls": "z", "cell": [1, 1, 0.8]}),
)


class ManySpheres(InFolder):
    """Spheres of two sizes at random places, deep in one another, that pass the walls too."""

    def scene(self, dim, options, n=25):
        rng = np.random.default_rng(dim)
        cell = np.array(options.get("cell", [1.0] * dim), float)
        rows = np.diag(cell) if cell.ndim == 1 else cell
        s = rng.uniform(size=(400, dim))
        x = s @ rows
        round_axes = {"ball": dim, "cylinder": 2}.get(options.get("container"), 0)
        x = x[((x[:, :round_axes] - 0.5) ** 2).sum(1) < 0.25][:n]
        return soft(x, np.where(np.arange(len(x)) % 2, 0.12, 0.2), **{"cell": rows, **options})

    def test_shares_of_random_points(self):
        for name, dim, options in SCENES:
            s = self.scene(dim, options)
            rng = np.random.default_rng(1)
            brick = np.diag(s.cell)
            points = rng.uniform(size=(60000, dim)) * brick
            round_axes = {"ball": dim, "cylinder": 2}.get(options.get("container"), 0)
            off = np.sqrt(((points[:, :round_axes] - 0.5) ** 2).sum(1)) if round_axes else np.zeros(len(points))
            points, off = points[off < 0.5], off[off < 0.5]
            held = inside(s, points, options)
            fraction = np.linalg.solve(s.cell.T, points.T).T % 1
            for axis in range(dim + (round_axes > 0)):
                p = s.solid_profile(axis, 4)
                where = off if axis == dim else fraction[:, axis] * p.high[-1]
                for low, high, share in zip(p.low, p.high, p.solid):
                    own = held[(where >= low) & (where < high)]
                    error = math.sqrt(share * (1 - share) / len(own)) + 1e-12
                    self.assertLess(abs(own.mean() - share), 4.5 * error, (name, axis, low))

    def test_slabs_shells_and_lines_add_up_to_the_same(self):
        for name, dim, options in SCENES:
            s = self.scene(dim, options)
            whole = [solid(s, axis) for axis in range(dim)]
            p = s.solid_profile(1, 13)
            volume = np.ones(13)
            if "container" in options:
                shells = s.solid_profile(dim, 7)
                power = 3 if name == "ball" else 2
                volume = shells.high**power - shells.low**power
                p = shells
            whole.append((p.solid * volume).sum() / volume.sum())
            np.testing.assert_allclose(whole, whole[0], rtol=1e-9, err_msg=name)
            report = s.write_voxels(f"{self.folder}/s.npy", size=0.02, lines=6)
            self.assertLess(abs(1 - report.porosity - whole[0]), 2e-4, name)
            # the rim of a round container is as wide as a voxel
            report = s.write_voxels(f"{self.folder}/c.npy", size=0.01)
            self.assertLess(abs(1 - report.porosity - whole[0]), 3e-3, name)

    def test_non_additive_mixtures(self):
        """Contacts at (1 + D) times the sum of the radii: for D < 0 unlike spheres in contact overlap."""
        for dim in (2, 3):
            s = jam.System.random(n=20, dim=dim, seed=1, diameters=np.where(np.arange(20) % 2, 1, 1.4), non_additivity=-0.3)
            s.compress(growth_rate=1e-2, pressure=1e4)
            points = np.random.default_rng(2).uniform(size=(100000, dim)) * np.diag(s.cell)
            share = solid(s)
            self.assertLess(share, s.packing_fraction - 0.01)
            self.assertLess(abs(inside(s, points, {}).mean() - share), 4.5 * math.sqrt(share * (1 - share) / 100000))
            apart = jam.System.random(n=20, dim=dim, seed=1, packing_fraction=0.2, non_additivity=0.3,
                                      diameters=np.where(np.arange(20) % 2, 1, 1.4))
            self.assertAlmostEqual(solid(apart), apart.packing_fraction, 13)


@unittest.skipUnless(PACK, "jam-pack is not built")
class Program(unittest.TestCase):
    def test_porosity_of_info(self):
        s = jam.System.random(n=60, seed=1, packing_fraction=2.0, overlap="allow")
        with tempfile.TemporaryDirectory() as folder:
            path = folder + "/soft.xyz"
            s.write(path)
            done = subprocess.run([PACK, "info", path, "--json"], capture_output=True, text=True, check=True, timeout=120)
            text = subprocess.run([PACK, "info", path], capture_output=True, text=True, check=True, timeout=120).stdout
        self.assertAlmostEqual(json.loads(done.stdout)["porosity"], 1 - solid(s), 12)
        self.assertIn("packing fraction 2.000000000000 (overlaps counted twice), porosity 0.1", text)
