"""Isoconfigurational runs, Monte Carlo and statistics from Python: against formulas and against each other."""
import functools
import os
import tempfile
from dataclasses import replace

import numpy as np

import jam
from jam import near_jamming as nj
from jam import statistics as st


def jammed(n=128, seed=5):
    packing = jam.System.random(n=n, dim=3, seed=seed)
    packing.compress([(1e-2, 500), (1e-2, 1e5)])
    assert packing.crunch().jammed
    return packing


def refused(error, f, *args, **named):
    try:
        f(*args, **named)
    except error:
        return True
    return False


def test_runs(packing):
    structure = nj.predictors(packing)
    options = dict(density_ratio=0.99, block=10)
    runs = packing.isoconf([2, 10, 50], runs=60, keep=[1], **options)
    assert runs.runs == 60 and runs.blocks == 6 and runs.status == jam.StatusCode.OK
    sets = runs.kept[1]
    assert sets.shape == (60, packing.n, 3)
    assert np.allclose(sets.mean(0), runs.mean("displacement")[1], rtol=0, atol=1e-15)
    assert np.allclose((sets**2).sum(2).mean(0), nj.propensity(runs)[1], rtol=1e-12)
    assert np.allclose(nj.self_scattering(sets, 7 / packing.diameters.mean()).mean(), runs.mean("scattering")[1])
    assert np.allclose(nj.overlap(sets, 0.3 * packing.diameters.mean()).mean(), runs.mean("overlap")[1])
    q = (sets**2).sum((1, 2)) / packing.n
    assert np.allclose(q.std(), runs.deviation("msd")[1], rtol=1e-6)
    # parts of a campaign are the campaign, bit for bit
    first = packing.isoconf([2, 10, 50], runs=20, keep=np.array([1]), **options)
    assert first.origin == runs.origin
    second = packing.isoconf([2, 10, 50], first_run=20, runs=40, keep=[1], **options)
    joined = first.merge(second)
    for name in ("displacement", "square", "distance2", "distance4"):
        assert np.array_equal(joined.total(name), runs.total(name))
    assert np.array_equal(joined.kept[1], sets)
    assert refused(ValueError, second.merge, first)
    other = packing.copy()
    other.scale_diameters(0.999)
    assert refused(ValueError, first.merge, other.isoconf([2, 10, 50], first_run=20, runs=20, **options))
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "runs.npz")
        runs.save(file)
        assert refused(ValueError, runs.save, os.path.join(folder, "runs.h5"))
        os.mkfifo(file + ".pipe")  # nobody writes into it: reading would wait for ever
        assert refused(jam.errors.StoreError, nj.Runs.load, file + ".pipe")
        back = jam.near_jamming.Runs.load(file)
        with open(file, "rb") as saved:
            good = saved.read()
        # the last bytes list the members: numpy and zipfile overlook some flips there
        for at in [*range(0, len(good), len(good) // 50), *range(len(good) - 2000, len(good), 7)]:
            changed = bytearray(good)
            changed[at] ^= 8
            with open(file, "wb") as target:
                target.write(changed)
            try:
                same = nj.Runs.load(file)
                assert same.series.keys() == runs.series.keys() and same.kept.keys() == runs.kept.keys()
                assert all(np.array_equal(same.total(k), runs.total(k)) for k in ("distance4", "square", "msd"))
            except jam.errors.StoreError as error:
                assert file in str(error)
    assert np.array_equal(back.total("distance4"), runs.total("distance4")) and back.runs == 60
    # structure predicts motion at once and less later; variances know nothing of it
    k = nj.correlations(runs, structure)
    assert k["c"][0] > 0.5 and k["s"][0] > 0.5 and k["force_sum"][0] < -0.3
    assert k["c"][0] > k["c"][2] and abs(k["c"] - k["c_pooled"]).max() < 0.05
    without = nj.correlations(runs, structure, rattlers=False)
    assert abs(without["c"] - k["c"]).max() < 0.1
    errors = nj.correlation_errors(runs, structure, 20)
    assert (errors["c"] > 0).all() and (errors["c"] < 0.1).all()
    halves = nj.reliability(runs)
    assert (halves["displacement"] > 0.3).all() and (halves["distance2"] <= 1.0).all()
    p = nj.prediction(runs, structure)
    assert p.c_top[0] > 0 > p.c_bottom[0] and p.s_top[0] > p.s_bottom[0]
    assert p.c_area[0] > 0.7 and p.s_area[0] > 0.7
    assert 0.6 < nj.median_over_mean(sets) < 0.9
    assert nj.is_caged(runs, packing).all()
    weights = nj.mode_weights(packing, runs, packing.modes(which="all"))
    assert np.allclose((weights.projections**2).sum(1), 1.0)
    assert (weights.curvature > 0).all() and (weights.noise < 1e-3).all()


def test_scenes_are_not_mixed():
    """The same spheres in another cell, between walls or in another model are another packing."""
    box = jam.System.random(n=30, dim=3, seed=2, packing_fraction=0.2, walls="xyz")
    x, diameters, cell = box.positions, box.diameters, np.array(box.cell)
    make = functools.partial(jam.System.from_arrays, x, diameters, seed=box.seed)
    scenes = [box, make(cell=cell), make(cell=2 * cell), make(cell=cell, masses="volume"), make(cell=cell, walls="x")]
    runs = [s.isoconf([2], runs=20, first_run=20 * k, block=20) for k, s in enumerate(scenes)]
    for k, first in enumerate(runs[:-1]):
        for second in runs[k + 1 :]:
            assert refused(ValueError, first.merge, replace(second, first_run=20 * (k + 1)))


def test_without_a_run_means_say_why(packing):
    stopped = packing.isoconf([2], runs=4, density_ratio=0.99, wall_time=1e-9)
    for none, why in ((stopped, "stopped"), (replace(stopped, status=jam.StatusCode.NOT_CONVERGED), "cannot move")):
        for mean in (lambda: none.msd, lambda: none.time, lambda: nj.propensity(none)):
            try:
                mean()
                assert False
            except ValueError as error:
                assert "no run was made" in str(error) and why in str(error)


def test_campaign(packing):
    """A campaign that was stopped goes on to the same bits; another one does not touch its file."""
    options = dict(density_ratio=0.99, block=4, keep=[0])
    whole = packing.isoconf([2, 5], runs=20, **options)
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "runs.npz")
        part = nj.campaign(packing, file, [2, 5], 10, part=4, **options)  # as if it was stopped amid a block
        assert part.runs == 10 and nj.Runs.load(file).runs == 10
        made = nj.campaign(packing, file, [2, 5], 20, part=8, **options)
        for runs in (made, nj.Runs.load(file)):
            assert runs.runs == 20 and (runs.counts == 4).all()
            assert np.array_equal(runs.distance4, whole.distance4)
            assert np.array_equal(runs.kept[0], whole.kept[0])
        other = packing.copy()
        other.scale_diameters(0.999)
        for change in (
            lambda: nj.campaign(packing, file, [2, 6], 20, **options),
            lambda: nj.campaign(packing, file, [2, 5], 20, **dict(options, density_ratio=0.98)),
            lambda: nj.campaign(other, file, [2, 5], 20, **options),
        ):
            assert refused(ValueError, change)
        # Monte Carlo with default options is not molecular dynamics; it continues as itself, and so does a resumed call
        path = os.path.join(folder, "carlo.npz")
        carlo = nj.campaign(packing, path, [2, 5], 4, monte_carlo={}, **options)
        assert nj.campaign(packing, path, [2, 5], 8, monte_carlo={}, **options).runs == 8
        assert refused(ValueError, carlo.merge, packing.isoconf([2, 5], first_run=4, runs=4, **options))
        with packing.copy() as again:
            again.isoconf([2, 5], runs=4, **options)
            assert again.isoconf([2, 5], runs=8, resume=True, **options).origin == whole.origin
            assert nj.take_runs(again).runs == 8
        # a part that is refused loses nothing
        tight = dict(options, memory_limit=1e3)
        assert refused(jam.JamError, nj.campaign, packing, file, [2, 5], 40, **tight)
        assert nj.Runs.load(file).runs == 20


def test_edges(packing):
    """Where the method ends it says so: beyond the cage, and without a network."""
    structure = nj.predictors(packing)
    runs = packing.isoconf([2, 500], runs=40, density_ratio=0.8, block=10)
    assert list(nj.is_caged(runs, packing)) == [True, False]
    k = nj.correlations(runs, structure)
    assert k["c"][0] > 0.25 and k["c"][1] < 0.6 * k["c"][0] and abs(k["s"][1]) < 0.2
    # sums fit into the memory, whole sets do not
    limit = 1e5
    assert packing.isoconf([2], runs=100, density_ratio=0.9, block=100, memory_limit=limit).runs == 100
    wide = dict(runs=100, keep=[0], density_ratio=0.9, block=100, memory_limit=limit)
    assert refused(jam.JamError, packing.isoconf, [2], **wide)
    # spheres that touch nothing: rattlers only
    loose = jam.System.from_arrays(np.array([[0.2, 0.2, 0.2], [0.7, 0.7, 0.7], [0.2, 0.7, 0.2]]), [0.1] * 3)
    assert loose.contacts_from_geometry().contacts == 0
    assert refused(ValueError, nj.predictors, loose)


def test_masses():
    """In free flight <|dr_i|^2> = d T t^2 / m_i, so large spheres of equal density go less far by their volumes."""
    sizes = [1.0] * 30 + [1.5] * 30
    for masses, ratio in (("equal", 1.0), ("volume", 1.5**3)):
        mixture = jam.System.random(n=60, dim=3, seed=2, packing_fraction=0.1, diameters=sizes, masses=masses)
        runs = mixture.isoconf([1e-6], clock="time", runs=200, block=200)
        mobility = nj.propensity(runs)[0]
        assert abs(mobility[:30].mean() / mobility[30:].mean() / ratio - 1.0) < 0.06


def test_monte_carlo(packing):
    runs = packing.isoconf([10, 100], monte_carlo=dict(alpha=2, temperature=1e-6), runs=20, block=5)
    assert 0.4 < runs.acceptance < 0.5 and runs.step > 0
    k = nj.correlations(runs, nj.predictors(packing))
    assert k["s"][0] > 0.3
    # so hot that the packing melts: said by is_caged, and the network predicts nothing
    hot = packing.isoconf([400], monte_carlo=dict(alpha=2, temperature=1.0), runs=20, block=5)
    assert not nj.is_caged(hot, packing).any()
    before = packing.positions.copy()
    moved = packing.copy()
    report = moved.monte_carlo(alpha=2, temperature=1e-6, sweeps=200)
    assert report.sweeps == 200 and report.energy > 0 and not np.array_equal(moved.positions, before)
    assert refused(jam.JamError, lambda: moved.contacts)  # the network belongs to the state before


def test_errors():
    fluid = jam.System.random(n=32, dim=3, seed=1)
    assert refused(jam.errors.StateError, nj.predictors, fluid)
    assert refused(TypeError, fluid.isoconf, [1], no_such_option=1)
    one = fluid.isoconf([1], runs=2, block=2)
    assert refused(ValueError, one.halves)
    assert refused(ValueError, st.spearman, [1, 2], [1, 2])
    assert refused(ValueError, st.spearman, [1, 2, 3], [1, 2])


def test_statistics():
    from scipy.stats import spearmanr

    draw = np.random.default_rng(1)
    x = np.round(draw.normal(size=200), 1)  # with ties
    y = np.round(x + draw.normal(size=200), 1)
    assert abs(st.spearman(x, y) - spearmanr(x, y)[0]) < 1e-12
    assert np.isnan(st.spearman(np.ones(5), np.arange(5)))
    assert st.roc_area([1, 2, 3, 4], [0, 0, 1, 1]) == 1.0 and st.roc_area([1, 1, 1, 1], [0, 1, 0, 1]) == 0.5
    assert st.deciles(np.arange(100), np.arange(100.0)) == (94.5, 4.5)
    # a mean of blocks: the bootstrap gives the textbook error
    values = draw.normal(size=50)
    made = st.bootstrap(lambda w: (w * values).sum() / w.sum(), 50, 2000)
    assert abs(made.std() / (values.std() / np.sqrt(50)) - 1.0) < 0.06
    # curves that collapse by construction, with noise
    controls = np.array([0.1, 0.03, 0.01, 0.003])
    xs = [np.geomspace(1e-4, 1e-1, 25) * c**1.8 * 10 ** draw.uniform(-0.3, 0.3) for c in controls]
    ys = [1.0 / (1.0 + (a / c**1.8 * 100) ** 0.4) + 1e-3 * draw.normal(size=25) for a, c in zip(xs, controls)]
    assert abs(st.collapse(xs, ys, controls) - 1.8) < 0.02
    # curves without one exponent: 2 above y = 0.5, 1 below
    ys = [np.linspace(0.9, 0.1, 81)] * 4
    xs = [np.exp(-5 * ys[0]) * np.where(ys[0] > 0.5, c**2.0, c) for c in controls]
    assert abs(st.collapse(xs, ys, controls, between=(0.6, 0.8)) - 2.0) < 1e-9
    assert abs(st.collapse(xs, ys, controls, between=(0.2, 0.4)) - 1.0) < 1e-9
    assert 1.2 < st.collapse(xs, ys, controls) < 1.8
    # an oscillator: its spectrum is a line at its frequency
    t = np.linspace(0, 100, 2001)
    omega = np.linspace(0, 6, 121)
    assert abs(omega[np.argmax(st.velocity_spectrum(t, np.cos(3 * t), omega))] - 3.0) < 0.06
    a, b = draw.normal(size=(2, 40, 3))
    assert abs(nj.clone_overlap(a, a) - 1.0) < 1e-12 and abs(nj.clone_overlap(a, b)) < 0.5
    assert nj.clone_distance(a, a) == 0.0


if __name__ == "__main__":
    packing = jammed()
    test_statistics()
    test_errors()
    test_masses()
    test_runs(packing)
    test_scenes_are_not_mixed()
    test_without_a_run_means_say_why(packing)
    test_campaign(packing)
    test_edges(packing)
    test_monte_carlo(packing)
    print("ok")
