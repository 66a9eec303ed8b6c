"""Stress and quasi-static shear: against sums over pairs, finite differences, elastic moduli, and the way back."""
import contextlib
import importlib.util
import io
import os
import pickle
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import jam
from jam.statistics import yield_point


def soft(n=64, dim=2, phi=0.9, seed=1, **options):
    s = jam.System.random(n=n, dim=dim, diameters=[1.0, 1.4] * (n // 2), packing_fraction=phi, overlap="allow", seed=seed)
    s.relax(**options)
    return s


#: Dimension, packing fraction and options of a soft packing: harmonic and Hertzian spheres, every minimiser.
KINDS = (
    (2, 0.9, {}),
    (3, 0.72, {"alpha": 2.5, "minimiser": "fire"}),
    (4, 0.55, {"alpha": 2.5, "minimiser": "lbfgs"}),
)


def lowest_curvature(s):
    """Smallest eigenvalue of the Hessian of harmonic spheres, of all pairs that overlap, by nearest images; times sigma^2."""
    x, sigma, cell, d = s.positions, s.diameters, s.cell, s.dim
    h = np.zeros((s.n, d, s.n, d))
    for i in range(s.n):
        r = x[i] - x[:i]
        r -= np.round(r @ np.linalg.inv(cell)) @ cell
        length, contact = np.sqrt((r * r).sum(axis=1)), (sigma[i] + sigma[:i]) / 2
        for j in np.flatnonzero(length < contact):
            n = np.outer(r[j], r[j]) / length[j] ** 2
            block = n / contact[j] ** 2 - (1 / length[j] - 1 / contact[j]) / contact[j] * (np.eye(d) - n)
            h[i, :, i] += block
            h[j, :, j] += block
            h[i, :, j] -= block
            h[j, :, i] -= block
    return np.linalg.eigvalsh(h.reshape(s.n * d, -1))[0] * sigma.mean() ** 2


def sliding_sums(s, strain):
    """Energy, stress sum of f r n n / V, of harmonic spheres, in a brick whose images above and below slide by strain times
    their distance (Lees and Edwards)."""
    x, sigma, (rows, columns) = s.positions, s.diameters, np.triu_indices(s.n, 1)
    side = np.linalg.det(s.cell) ** (1 / s.dim)
    r = x[rows] - x[columns]
    above = np.round(r[:, 1:2] / side)
    r[:, 1:2] -= above * side
    r[:, 0:1] -= above * (strain * side % side)
    r[:, 0] -= np.round(r[:, 0] / side) * side
    r[:, 2:] -= np.round(r[:, 2:] / side) * side
    length, contact = np.sqrt((r * r).sum(axis=1)), (sigma[rows] + sigma[columns]) / 2
    h = np.maximum(0, 1 - length / contact)
    return (h * h).sum() / 2, np.einsum("k,ka,kb->ab", h / contact / length, r, r) / side**s.dim


class Stress(unittest.TestCase):
    def test_soft_packing_by_pairs(self):
        for s in (soft(40), soft(32, 3, 0.72, 2)):
            _, stress = sliding_sums(s, 0.0)
            scale = np.trace(stress)
            np.testing.assert_allclose(s.stress(), stress, atol=1e-10 * scale)
            self.assertTrue(np.array_equal(s.stress(), s.stress().T))

    def test_hard_packing_has_trace_d(self):
        s = jam.System.random(n=64, dim=3, seed=2)
        s.compress()
        s.crunch()
        c, f, n = s.contacts.pairs, s.forces, s.contacts.vectors
        r = (s.diameters[c[:, 0]] + s.diameters[c[:, 1]]) / 2
        sums = np.einsum("k,ka,kb->ab", f * r, n, n)
        np.testing.assert_allclose(s.stress(), 3 * sums / np.trace(sums), atol=1e-12)

    def test_between_walls_the_normal_stress_is_that_of_the_walls(self):
        s = jam.System.random(n=60, dim=2, walls="y", seed=3)
        s.compress()
        s.crunch()
        for wall in s.walls().stress:
            self.assertAlmostEqual(s.stress()[1, 1], wall, delta=1e-9)

    def test_files_and_page_have_it(self):
        hard = jam.System.random(n=40, dim=3, seed=2)
        hard.compress()
        hard.crunch()
        with tempfile.TemporaryDirectory() as folder:
            path, page = Path(folder, "packing.xyz"), Path(folder, "packing.html")
            for s, scale, unit in ((hard, 2.0, 1.0), (soft(40), 2.0, 2.0**-2)):
                whole = np.zeros((3, 3))
                whole[: s.dim, : s.dim] = s.stress()
                s.write(path, scale=scale)
                read = re.search(r'stress="([^"]*)"', path.read_text().splitlines()[1])[1]
                np.testing.assert_allclose(np.fromstring(read, sep=" ").reshape(3, 3), -whole * unit, rtol=1e-15, atol=0)
                self.assertEqual(jam.System.read(path, overlap="allow").n, s.n)
                s.page(page)
                told = float(re.search(r'"deviatoric stress over pressure": ([-+.0-9e]+)', page.read_text())[1])
                tensor = s.stress()
                self.assertAlmostEqual(told, np.linalg.norm(s.dim * tensor / np.trace(tensor) - np.eye(s.dim)), 12)
        loose = jam.System.random(n=20, dim=2, seed=1)
        with tempfile.TemporaryDirectory() as folder:
            loose.write(Path(folder, "loose.xyz"))
            self.assertNotIn("stress", Path(folder, "loose.xyz").read_text())

    def test_of_dynamics_has_the_trace_of_the_pressure(self):
        for given in (dict(dim=2, diameters=[1.0, 1.4] * 100), dict(dim=3, walls="z"), dict(dim=3, masses="volume", diameters=[1.0, 1.3] * 100)):
            with self.subTest(dim=given["dim"], options=list(given)):
                s = jam.System.random(n=200, packing_fraction=0.3, seed=4, **given)
                s.run(collisions_per_particle=20)
                alike = s.copy()
                with s.observing(sample_every=40) as observed:
                    s.run(collisions_per_particle=40)
                alike.run(collisions_per_particle=40)
                self.assertTrue(np.array_equal(alike.positions, s.positions))
                self.assertAlmostEqual(observed.stress.trace() / s.dim / observed.series["pressure"][0], 1.0, delta=1e-12)
                self.assertTrue(np.array_equal(observed.stress, observed.stress.T))
        growing = jam.System.random(n=200, packing_fraction=0.3, seed=4)
        with growing.observing(sample_every=40) as observed:
            growing.compress(growth_rate=1e-2, collisions_per_particle=40)
        self.assertAlmostEqual(observed.stress.trace() / 3 / observed.series["pressure"][0], 1.0, delta=1e-12)

    def test_of_dynamics_is_what_walls_take(self):
        """The normal component at flat walls is their pressure, but for what sum m x v gains in this time: below 1 %."""
        s = jam.System.random(n=200, dim=3, walls="z", packing_fraction=0.3, seed=2)
        s.run(collisions_per_particle=50)
        with s.observing() as observed:
            s.run(collisions_per_particle=1000)
        self.assertAlmostEqual(observed.stress[2, 2] / np.mean(s.walls().pressure), 1.0, delta=0.01)


class Shear(unittest.TestCase):

    def test_the_way_back_before_an_event(self):
        for dim, phi, given in KINDS:
            with self.subTest(dim=dim, **given):
                s = soft(64, dim, phi, **given)
                t = s.copy()
                t.shear(1.0, until="event", step=2e-3, **given)
                first = t.shear_rows[-1]["strain"]
                self.assertGreater(first, 0)
                turn = min(0.5 * first, 4e-3)
                u = s.copy()
                report = u.shear([turn, 0.0], step=turn / 4, **given)
                self.assertEqual(report.events, 0)
                moved = u.positions - s.positions
                moved -= np.round(moved / s.box) * s.box
                moved -= moved.mean(axis=0)
                stable = s.coordination > 0
                self.assertLess(np.abs(moved[stable]).max(), 1e-12 * s.box * 10)

    def test_energy_is_the_work_but_at_events(self):
        """Between events, energy and the trapezoidal sum of the work differ at second order in the step."""
        departs = {1e-3: 0.0, 2.5e-4: 0.0}
        for step in departs:
            for seed in (1, 2, 3):
                s = soft(64, seed=seed)
                report = s.shear(0.1, step=step)
                h = s.shear_rows
                self.assertGreater(report.events, 0)
                self.assertEqual(report.events, h["event"].sum())
                work = s.box**2 * np.diff(h["strain"]) * (h["stress"][1:] + h["stress"][:-1]) / 2
                lost = work - np.diff(h["energy"]) * s.n
                at = h["event"][1:] == 1
                self.assertTrue((lost[at] > 0).all())
                self.assertTrue((np.diff(h["strain"])[at] <= 1e-6 * 1.01).all())
                self.assertLess(np.abs(lost[~at]).sum(), 0.02 * lost[at].sum())
                departs[step] += np.abs(lost[~at]).sum()
        self.assertLess(departs[2.5e-4], departs[1e-3] / 5)  # 16 at second order, 4 at first; the shorter step resolves more events

    def test_a_search_for_an_event_ends(self):
        """Where no minimum is found behind the strain that bisection came to."""
        s = soft(64, seed=6)
        p = s.stress().trace() / 2
        given = dict(mode=[[1, 0], [0, -1]], stress=[[p, -0.15 * p], [-0.15 * p, p]], strain="tilts", step=2e-3)
        report = s.shear(0.3, wall_time=100.0, **given)
        self.assertEqual(report.stop_reason, jam.StopReason.STALLED)
        self.assertLess(report.strain, 0.3)

    def test_pressure_and_single_components_are_held(self):
        start = soft(64)
        s, t, p = start.copy(), start.copy(), start.stress().trace() / 2
        s.shear(0.02, strain="volume", pressure=p)
        np.testing.assert_allclose(s.shear_rows["pressure"], p, rtol=1e-9)
        t.shear(0.02, strain="edges_volume", pressure=p, components=1 << 3)  # the edge along y alone
        self.assertAlmostEqual(t.stress()[1, 1] / p, 1.0, delta=1e-9)
        self.assertEqual(t.cell[0, 0], start.cell[0, 0])

    def test_components_are_held_at_values_of_their_own(self):
        for dim, phi, alpha in ((2, 0.9, 2.0), (3, 0.72, 2.5), (4, 0.55, 2.0)):
            start = soft(40, dim, phi, alpha=alpha)
            p = start.stress().trace() / dim
            target = p * (np.diag(np.linspace(1.1, 0.9, dim)) + 0.03 * (1 - np.eye(dim)))
            for minimiser in ("newton", "fire", "lbfgs"):
                with self.subTest(dim=dim, minimiser=minimiser):
                    s = start.copy()
                    report = s.shear(1e-3, stress=target, strain="all", alpha=alpha, minimiser=minimiser)
                    self.assertEqual(report.stop_reason, jam.StopReason.STRAIN)
                    held = ~(np.eye(dim, k=1, dtype=bool) & (np.arange(dim) == 1))
                    held &= held.T  # all but the component that the shear drives
                    np.testing.assert_allclose(s.stress()[held], target[held], atol=1e-10 * p)

    def test_a_cell_that_follows_a_load_takes_whole_steps(self):
        """The work is that of all stresses on the logarithm of the whole strain. Without its commutators the energy departs from
        the work at every length of a step, and the shear proceeds by steps of its resolution."""
        for n, seed, alpha, step in ((8, 29, 1.5, 5e-3), (32, 1, 2.0, 5e-3), (32, 2, 2.0, 1e-3)):
            s = soft(n, seed=seed, alpha=alpha)
            stress = np.diag([1.2, 1.0]) * s.stress().trace() / 2
            report = s.shear(0.05, step=step, alpha=alpha, stress=stress, strain="edges_volume", wall_time=100.0)
            self.assertEqual(report.stop_reason, jam.StopReason.STRAIN)
            halvings = np.log2(step / 1e-6) + 3  # of an event, and what tests it
            self.assertLess(report.steps, (len(s.shear_rows) + report.events) * halvings)

    def test_loads_work(self):
        s = soft(64)
        p = s.stress().trace() / 2
        target = np.array([[p, -0.05 * p], [-0.05 * p, p]])
        given = dict(mode=[[1, 0], [0, -1]], stress=target, strain="tilts")
        s.shear(1e-5, step=1e-5, **given)
        for _ in range(4):
            energy, before, step = s.shear_rows[-1]["energy"] * s.n, s.cell.T, 1e-4
            self.assertEqual(s.shear(step, step=step, **given).events, 0)
            stress = s.shear_rows["stress"]
            e = s.cell.T @ np.linalg.inv(before) - np.eye(2)
            load = target[0, 1] * (e - e @ e / 2)[0, 1] * s.box**2
            work = s.box**2 * step * stress.mean()
            gain = s.shear_rows[-1]["energy"] * s.n - energy
            self.assertAlmostEqual((gain + load) / work, 1.0, delta=1e-3)

    def test_a_stress_beyond_yield_keeps_the_last_minimum(self):
        for seed in range(1, 9):  # some packings yield at less at once, others hold it to the end
            s = soft(64, seed=seed)
            p = s.stress().trace() / 2
            target = np.array([[p, -0.15 * p], [-0.15 * p, p]])
            report = s.shear(0.3, mode=[[1, 0], [0, -1]], stress=target, strain="tilts", step=2e-3)
            if report.strain > 0 and report.stop_reason == jam.StopReason.STALLED:
                break
        self.assertGreater(report.strain, 0)
        self.assertEqual(report.stop_reason, jam.StopReason.STALLED)
        self.assertIn("stress[1] cannot be held", str(report))
        self.assertAlmostEqual(s.stress()[0, 1], target[0, 1], delta=1e-10 * p)
        t = soft(64)
        before = t.positions.copy()
        report = t.shear(0.1, mode=[[1, 0], [0, -1]], stress=[[p, 0.9 * p], [0.9 * p, p]], strain="tilts")
        self.assertEqual((report.strain, report.rigid), (0, False))
        self.assertTrue(np.array_equal(before, t.positions))

    def test_jams_by_shear(self):
        s = jam.System.random(n=64, dim=2, diameters=[1.0, 1.4] * 32, packing_fraction=0.83, overlap="allow", seed=6)
        self.assertEqual(s.relax().contacts, 0)
        self.assertEqual(s.shear(0.5, step=5e-3, until="jammed", resolution=1e-4, max_evaluations=30000).stop_reason, jam.StopReason.JAMMED)
        self.assertGreater(s.shear_rows[-1]["pressure"], 0)
        self.assertEqual(s.shear_rows[-2]["pressure"], 0)
        self.assertLess(s.shear_rows[-1]["strain"] - s.shear_rows[-2]["strain"], 5e-3)

    def test_hard_disks_dilate_by_their_stress(self):
        s = jam.System.random(n=32, dim=2, diameters=[1.0, 1.4] * 16, seed=3)
        s.compress()
        s.crunch()
        report = s.shear(0.004, step=1e-4)
        h = s.shear_rows
        smooth = h["event"][1:] == 0
        volume = 1 / h["phi"]
        work = np.diff(h["strain"]) * (volume[1:] * h["stress"][1:] + volume[:-1] * h["stress"][:-1]) / 2
        scale = np.abs(np.diff(h["strain"]) * np.diff(h["stress"]) * volume[1:])
        self.assertTrue(((work - np.diff(volume))[smooth] <= 0.2 * scale[smooth] + 1e-12).all())
        self.assertEqual(report.rigid, 1)
        self.assertEqual(s.rigidity().jammed, jam.Verdict.YES)
        self.assertTrue(s.report.jammed)

    def test_refusals(self):
        s = soft(16)
        p = s.stress().trace() / 2
        for bad in (dict(to=[]), dict(to=[0.0]), dict(to=[0.1, 0.1]), dict(to=np.nan), dict(to=0.1, step=0.0),
                    dict(to=0.1, mode=[[0, 0], [1, 0]]), dict(to=0.1, mode=np.zeros((2, 2))), dict(to=0.1, mode=np.eye(3)), dict(to=0.1, mode=[0, 1, 0, 0]),
                    dict(to=0.1, resolution=-1.0), dict(to=0.1, until="never"), dict(to=0.1, pressure=1.0),
                    # stresses that no cell holds; the first is not symmetric
                    dict(to=0.1, stress=[[p, 0], [0.1 * p, p]], strain="all"), dict(to=0.1, stress=[[p, 0], [0, -p]], strain="all"),
                    dict(to=0.1, stress=[[p, 0], [0, np.nan]], strain="all"), dict(to=0.1, stress=[[p, 0], [0, 2 * p]], strain="volume"),
                    dict(to=0.1, stress=[[p, 0], [0, p]]), dict(to=0.1, stress=[[p, 0], [0, p]], strain="all", pressure=p)):
            with self.assertRaises((jam.JamError, ValueError), msg=str(bad)):
                s.shear(**bad)
        with self.assertRaisesRegex(jam.JamError, "magnitude"):
            soft(24, 3, 0.72).shear(0.01, stress=np.eye(3) + 2 * np.eye(3)[:, [0, 2, 1]] * [0, 1, 1], strain="all")
        hard = jam.System.random(n=16, dim=2, seed=1)
        for options in (dict(alpha=2.5), dict(stress=np.eye(2), strain="all")):
            with self.assertRaisesRegex(jam.JamError, "hard"):
                hard.shear(0.1, **options)
        with self.assertRaises(jam.JamError):
            jam.System.random(n=16, dim=2, walls="y", seed=1, overlap="allow").shear(0.1)

    def test_a_limit_of_time_keeps_the_last_minimum(self):
        hard = jam.System.random(n=32, dim=2, diameters=[1.0, 1.4] * 16, seed=3)
        hard.compress()
        hard.crunch()
        report = hard.shear(100.0, step=1e-4, wall_time=0.5)
        self.assertEqual(report.stop_reason, jam.StopReason.WALL_TIME)
        self.assertTrue(hard.report.jammed)

    def test_what_cannot_be_asked_for_is_told(self):
        """Steps longer than the way to an event, hard packings that are not jammed, ends that are not reached."""
        ends = []
        for step in (1e-3, 0.05):
            s = soft(16)
            ends.append((s.shear(0.05, step=step).first_event, s.shear_rows["stress"][-1]))
        self.assertAlmostEqual(ends[0][0], ends[1][0], delta=2e-6)  # each is known to the resolution
        self.assertAlmostEqual(ends[0][1], ends[1][1], delta=1e-9)
        self.assertEqual(soft(16).shear(1e-13).strain, 1e-13)  # was taken for rounding of the turns
        gas = jam.System.random(n=16, dim=2, diameters=[1.0, 1.4] * 8, seed=1)
        start = gas.packing_fraction
        self.assertEqual(gas.shear(2e-3, step=1e-3).strain, 2e-3)
        self.assertGreater(gas.shear_rows["phi"][0], start)  # a crunch jams it before the first step
        self.assertTrue(gas.report.jammed)
        for phi, until, rigid in ((0.4, "jammed", False), (0.9, "unjammed", True)):
            s = soft(16, phi=phi)
            report = s.shear(0.02, step=0.01, until=until)
            self.assertEqual((report.stop_reason, report.strain, bool(report.rigid)), (jam.StopReason.STRAIN, 0.02, rigid))
            self.assertEqual(report.packing_fraction, s.packing_fraction)

    def test_a_checkpoint_of_other_words_is_a_shear(self):
        """jam-pack says what it cannot continue: a shear whose note it does not understand, or none."""
        s = jam.System.random(n=16, dim=2, seed=1)
        with tempfile.TemporaryDirectory() as folder:
            for why in ("is no checkpoint of a shear", "another version"):
                s.write_checkpoint(file := os.path.join(folder, "state"))
                done = subprocess.run([sys.executable, "-m", "jam", "shear", "--resume", file, "--to", "0.1"], capture_output=True, text=True)
                self.assertEqual((done.returncode, why in done.stderr), (2, True), done.stderr)
                s.add_note("shear --to 0.1 at the row 8")

    def test_every_stop_reason_has_its_word(self):
        for reason in jam.StopReason:
            self.assertEqual(jam.raw.jam_stop_string(int(reason)), reason.name.lower())

    def test_a_stop_keeps_the_last_minimum(self):
        s = soft(64)
        seen = []

        def stop(p):
            seen.append(p.steps)
            return p.steps >= 5

        report = s.shear(0.1, step=1e-3, progress=stop)
        self.assertEqual(report.stop_reason, jam.StopReason.CANCELLED)
        self.assertEqual(report.strain, s.shear_rows[-1]["strain"])
        energy, _ = sliding_sums(s, report.strain)
        self.assertAlmostEqual(energy, s.shear_rows[-1]["energy"] * s.n, delta=1e-12)

    def test_a_stop_within_a_step_continues_to_the_same_bits(self):
        whole, parts, step = soft(24, seed=2), soft(24, seed=2), 2e-3
        first = whole.copy().shear(1.0, step=step, until="event").first_event
        steps = int(first / step) + 3
        self.assertGreater(whole.shear(steps * step, step=step).events, 0)
        parts.log(lambda level, line: parts.cancel() if ", event" in line else None)
        stopped = parts.shear(steps * step, step=step)
        parts.log(None)
        self.assertEqual(stopped.stop_reason, jam.StopReason.CANCELLED)
        last = parts.shear_rows[-1]
        self.assertEqual((last["strain"], last["event"], last["phi"]), (stopped.strain, 0, stopped.packing_fraction))
        self.assertEqual((stopped.events, stopped.stress), (0, last["stress"]))
        done = round(stopped.strain / step)
        self.assertAlmostEqual(stopped.strain / step, done, delta=1e-9)
        parts.shear((steps - done) * step, step=step)
        self.assertTrue(np.array_equal(whole.positions, parts.positions))

    def test_a_pressure_far_from_that_of_the_start(self):
        """Starts without contacts, and at 2000 times the pressure; the stress of rounded positions has some nine digits."""
        for phi, before in ((0.1, {}), (0.9, {"strain": "volume", "pressure": 2e-2})):
            s = soft(32, phi=phi, **before)
            self.assertEqual(s.shear(4e-3, step=2e-3, strain="volume", pressure=1e-5, max_evaluations=100000).status, 0)
            self.assertAlmostEqual(sliding_sums(s, 4e-3)[1].trace() / 2e-5, 1, delta=1e-7)

    def test_a_call_continues_another_to_the_same_bits(self):
        """Two calls make what one makes: where rounded positions miss the tolerance, in free cells, and without overlaps."""
        for n, phi, options in (
            (16, 0.9, {"strain": "volume", "pressure": 1e-2}),
            (24, 0.9, {"strain": "all", "pressure": 1e-4, "alpha": 2.5}),
            (16, 0.812, {"scale": "absolute", "alpha": 3.0}),
            (24, 0.86, {}),
        ):
            for seed in (1, 2, 3):
                whole = jam.System.random(n, 2, seed, diameters=[1.0, 1.4] * (n // 2), packing_fraction=phi, overlap="allow")
                parts = whole.copy()
                whole.shear(0.02, step=2e-3, **options)
                parts.shear(0.01, step=2e-3, **options)
                parts.shear(0.01, step=2e-3, **options)
                self.assertTrue(np.array_equal(whole.positions, parts.positions))
                self.assertTrue(np.array_equal(whole.cell, parts.cell))

    def test_a_step_that_opens_all_contacts_keeps_the_pressure(self):
        """Stretched by more than its overlaps, the cell closes again along the other edge."""
        s, mode = soft(16, strain="volume", pressure=1e-7), [[1, 0], [0, 0]]
        report = s.shear(4e-3, step=2e-3, mode=mode, strain="edges_volume", pressure=1e-7, components=1 << 3)
        self.assertEqual(report.status, 0)
        self.assertGreater(s.shear_rows["contacts"].min(), 2 * 8)
        for stress in s.shear_rows["pressure"]:
            self.assertGreater(stress, 0)
        self.assertAlmostEqual(s.stress()[1, 1] / 1e-7, 1, delta=1e-6)

    def test_a_start_at_a_saddle_is_none(self):
        s = jam.System.from_arrays(np.indices((6, 6)).reshape(2, -1).T + 0.5, 1.1, cell=[6, 6], overlap="allow")
        energy, _ = sliding_sums(s, 0)
        s.shear(1e-6, step=1e-6)
        self.assertLess(s.shear_rows["energy"][0] * s.n, 0.99 * energy)
        self.assertGreater(lowest_curvature(s), -1e-6)

    def test_no_cell_becomes_narrower_than_a_sphere(self):
        s = soft(24, phi=0.95, seed=5)
        report = s.shear(2.0, step=0.02, mode=[[1, 0], [0, -1]])
        self.assertEqual((report.status.name, report.stop_reason), ("NOT_CONVERGED", jam.StopReason.STALLED))
        self.assertIn("shortest period", s.status_text)
        self.assertLess(s.diameters.max(), s.cell[1, 1])
        self.assertTrue(np.array_equal(pickle.loads(pickle.dumps(s)).positions, s.positions))
        few = soft(6, phi=1.1, seed=3)
        with self.assertRaisesRegex(jam.errors.OverlapError, "shortest period"):
            few.relax(strain="all", pressure=50.0)
        self.assertTrue(np.array_equal(pickle.loads(pickle.dumps(few)).positions, few.positions))

    def test_no_minimum_is_a_saddle(self):
        """Lattices with few contacts, and layers, balance by their symmetry; the energy falls to every other side."""
        layer = np.array([(k % 4 + j % 2 / 2, j * 0.75**0.5, 2) for j in range(4) for k in range(4)])
        starts = [(np.indices((m,) * d).reshape(d, -1).T + 0.5, [m] * d) for d, m in ((2, 6), (3, 4), (4, 3))]
        starts.append((layer, [4, 4 * 0.75**0.5, 4]))
        for minimiser in ("newton", "fire"):
            for x, cell in starts:
                for sigma in (1.01, 1.25):
                    with self.subTest(minimiser=minimiser, cell=cell, sigma=sigma):
                        s = jam.System.from_arrays(x, sigma, cell=cell, overlap="allow")
                        self.assertLess(lowest_curvature(s), -1e-3)
                        report = s.relax(minimiser=minimiser)
                        self.assertIn(report.status.name, ("OK", "NOT_JAMMED"))
                        self.assertEqual(report.status.name == "OK", report.contacts > 0)
                        self.assertGreater(lowest_curvature(s), -1e-9)
        s = jam.System.from_arrays(*starts[1][:1], 1.3, cell=starts[1][1], overlap="allow")
        s.decompress(pressure=1e-2, isostatic=False, crunch=False)
        self.assertGreater(lowest_curvature(s), -1e-9)
        self.assertGreater(s.contacts.pairs.size, 0)

    def test_fire_alone_does_not_fill_the_memory_for_this(self):
        x = np.indices((30,) * 3).reshape(3, -1).T + 0.5
        s, said = jam.System.from_arrays(x, 1.01, cell=[30] * 3, overlap="allow"), []
        s.log(lambda level, text: said.append(text), "info")
        self.assertEqual(s.relax(minimiser="fire").factorisations, 0)
        self.assertIn("not tested whether this is a saddle", " ".join(said))

    def test_tilted_cells_agree_with_sliding_images(self):
        """Every step of a shear through more than one period, by energies and stresses of sliding images."""
        for s, step in ((soft(32), 0.11), (soft(40, dim=3, phi=0.72, seed=2), 0.23)):
            strain = 0.0
            while strain < 1.3:
                s.shear(step, step=step, resolution=step)
                strain += step
                energy, stress = sliding_sums(s, strain)
                self.assertAlmostEqual(s.shear_rows["energy"][-1] * s.n, energy, delta=1e-10 * energy)
                np.testing.assert_allclose(s.stress(), stress, rtol=0, atol=1e-10 * np.trace(stress))
                self.assertAlmostEqual(s.shear_rows["stress"][-1], -stress[0, 1], delta=1e-10 * np.trace(stress))


class Yield(unittest.TestCase):
    """yield_point on curves of known flow, and on two halves of a run."""

    def curve(self, rng, length=0.01, steps=1000):
        """Rises to a flow of mean 1, with deviations that are correlated over `length`; the strain of its rise is 0.03."""
        strain = np.arange(steps + 1) * 1e-3
        kept, deviation = np.exp(-1e-3 / length), rng.normal(size=steps + 1)
        for k in range(steps):
            deviation[k + 1] = kept * deviation[k] + (1 - kept**2) ** 0.5 * deviation[k + 1]
        return {"strain": strain, "stress": (1 - np.exp(-strain / 0.03)) * (1 + 0.1 * deviation)}

    def test_errors_contain_the_correlation(self):
        rng = np.random.default_rng(1)
        found = [yield_point(self.curve(rng), 0.2) for _ in range(200)]
        pulls = np.array([(y.stress.value - 1) / y.stress.error for y in found])
        self.assertLess((pulls**2).mean(), 2)  # 7/5 for 8 blocks that are independent; rows taken as such give 20
        self.assertGreater((pulls**2).mean(), 0.5)
        self.assertLess(abs(pulls.mean()), 5 / 200**0.5)
        for y in found:
            self.assertGreaterEqual(y.strain.error, 1e-3 * (1 - 1e-9))

    def test_a_curve_without_noise(self):
        strain = np.linspace(0, 1, 1001)
        for way in (1, -1):
            rows = {"strain": way * strain, "stress": way * np.minimum(strain / 0.05, 2.0)}
            y = yield_point(rows, way * 0.5)
            self.assertAlmostEqual(y.stress.value, 2 * way, delta=1e-12)
            self.assertAlmostEqual(y.strain.value, 0.1 * way, delta=1e-9)
            self.assertLess(y.stress.error, 1e-12)
            self.assertAlmostEqual(y.strain.error, 1e-3, delta=1e-9)

    def test_refusals(self):
        rows = self.curve(np.random.default_rng(2))
        cycle = {"strain": np.r_[rows["strain"], 0.9], "stress": np.r_[rows["stress"], 1.0]}
        for bad, beyond, why in ((rows, 0.95, "51 rows lie"), (rows, -0.1, "goes from 0 to 1"),
                                 ({name: -x for name, x in rows.items()}, 0.2, "goes from -?0 to -1"), (rows, 2.0, "goes from 0 to 1"),
                                 ({name: x[:0] for name, x in rows.items()}, 0.2, "no rows"), (cycle, 0.2, "turns"), (dict(rows, stress=rows["stress"] * np.nan), 0.2, "not finite")):
            with self.assertRaisesRegex(ValueError, why):
                yield_point(bad, beyond)


class Pages(unittest.TestCase):
    @unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed, which draws the pages' picture")
    def test_lines_of_the_pages_run(self):
        import matplotlib

        matplotlib.use("Agg")
        docs = Path(__file__).resolve().parents[2] / "bindings" / "docs"
        here = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                for page in ("shear.md", "units.md"):
                    names = {}
                    for lines in re.findall(r"```python\n(.*?)```", (docs / page).read_text(), re.S):
                        with contextlib.redirect_stdout(io.StringIO()):
                            exec(lines, names)
            finally:
                os.chdir(here)
