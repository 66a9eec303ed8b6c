"""Dynamics near jamming: isoconfigurational runs, predictors from the contact network, and what they predict.

    packing.crunch()
    structure = jam.near_jamming.predictors(packing)
    runs = packing.isoconf([2, 10, 100], runs=300, density_ratio=0.995)
    jam.near_jamming.correlations(runs, structure)["c"]        # K[C, <dr>] at each instant

Formulas: R. Diaz Hernandez Rojas, thesis (Sapienza 2021), chapter 3.
"""
from __future__ import annotations

from typing import Any, NamedTuple, Sequence

import numpy as np

from . import statistics
from ._api.arrays import Array
from ._api.shown import only
from ._system.runs import Runs, campaign, make_runs as run, take_runs  # noqa: F401  public here
from .statistics import Estimate

__all__ = [
    "Estimate", "ModeWeights", "Prediction", "Predictors", "Runs", "campaign", "clone_distance", "clone_overlap",
    "collapse_exponent", "correlation_errors", "correlations", "decay_curve", "is_caged", "median_over_mean",
    "mode_weights", "overlap", "prediction", "predictors", "propensity", "reliability", "run", "self_scattering",
    "take_runs",
]
__dir__ = only(__all__)

# ---- predictors


class Predictors(NamedTuple):
    """Structure of a jammed packing, a value a sphere; rattlers have zeros. c (n, d): sum_j n_ij; s (n,): sum_{j<k} n_ij.n_ik;
    force_sum (n,): sum_j f_ij; force_pairs (n,): sum_{j<k} f_ij.f_ik; rattlers (n,): bool."""

    c: Array
    s: Array
    force_sum: Array
    force_pairs: Array
    rattlers: Array


def predictors(system: Any) -> Predictors:
    """Predictors from the contact network. StateError before a crunch; ValueError when all spheres are rattlers."""
    plain, weighted, contacts = system.sphere_structure(False), system.sphere_structure(True), system.contacts
    if len(contacts.pairs) == 0:
        raise ValueError("the packing has rattlers only: there is no contact network to predict from")
    total = np.zeros(system.n)
    spheres = contacts.pairs.ravel() >= 0  # below 0: a wall
    np.add.at(total, contacts.pairs.ravel()[spheres], np.repeat(contacts.forces, 2)[spheres])
    return Predictors(plain.c, plain.s, total, weighted.s, np.asarray(system.rattlers, dtype=bool))


# ---- correlations, prediction


def correlations(runs: Runs, structure: Predictors, weights: Any = None, rattlers: bool = True) -> dict[str, Array]:
    """Spearman's K at each instant (m,), with or without rattlers.

    c, c_pooled: K[C, <dr>], mean of components and pooled; s, force_sum, force_pairs: with <|dr|^2>;
    variance: K[|C_c|, Var dr_c], mean of components.
    """
    use = np.ones(len(structure.s), bool) if rattlers else ~structure.rattlers
    first, square = runs.mean("displacement", weights)[:, use], runs.mean("distance2", weights)[:, use]
    spread = runs.variance(weights)[:, use]
    c = structure.c[use]
    pairs = np.array([statistics.spearman_components(c, dr) for dr in first])
    out = {"c": pairs[:, 0], "c_pooled": pairs[:, 1]}
    for name in ("s", "force_sum", "force_pairs"):
        out[name] = np.array([statistics.spearman(getattr(structure, name)[use], r2) for r2 in square])
    out["variance"] = np.array([statistics.spearman_components(np.abs(c), v)[0] for v in spread])
    return out


def correlation_errors(runs: Runs, structure: Predictors, times: int = 100, **options: Any) -> dict[str, Array]:
    """Standard errors (m,) of correlations(), by resampling blocks of runs with replacement."""
    made: dict[str, list[Any]] = {}

    def keep(weights: Array) -> float:
        for name, values in correlations(runs, structure, weights, **options).items():
            made.setdefault(name, []).append(values)
        return 0.0

    statistics.bootstrap(keep, runs.blocks, times)
    return {name: np.std(values, axis=0, ddof=1) for name, values in made.items()}


def reliability(runs: Runs) -> dict[str, Array]:
    """How well means over half of the runs repeat themselves: K between halves (m,), of <dr> and <|dr|^2>.

    The noise of runs bounds K with any predictor by about sqrt(2 K / (1 + K)) (Spearman and Brown)."""
    a, b = runs.halves()
    first, second = runs.mean("displacement", a), runs.mean("displacement", b)
    one, two = runs.mean("distance2", a), runs.mean("distance2", b)
    return {
        "displacement": np.array([statistics.spearman_components(x, y)[0] for x, y in zip(first, second)]),
        "distance2": np.array([statistics.spearman(x, y) for x, y in zip(one, two)]),
    }


class Prediction(NamedTuple):
    """At each instant (m,): mean <dr_c> of the spheres with the top and bottom share of C_c, over components; mean <|dr|^2> of
    those of S; areas under ROC curves: sign of <dr_c> from C_c, top share of <|dr|^2> from S (0.5: no better than chance).
    """

    c_top: Array
    c_bottom: Array
    s_top: Array
    s_bottom: Array
    c_area: Array
    s_area: Array


def prediction(runs: Runs, structure: Predictors, share: float = 0.1) -> Prediction:
    """Prediction by ranking, without rattlers."""
    use = ~structure.rattlers
    c, s, rows = structure.c[use], structure.s[use], []
    for dr, r2 in zip(runs.mean("displacement")[:, use], runs.mean("distance2")[:, use]):
        by_axis = np.array([statistics.deciles(c[:, k], dr[:, k], share) for k in range(c.shape[1])]).mean(0)
        mobile = r2 >= np.quantile(r2, 1.0 - share)
        rows.append(
            [
                *by_axis,
                *statistics.deciles(s, r2, share),
                statistics.roc_area(c, dr > 0),
                statistics.roc_area(s, mobile),
            ]
        )
    return Prediction(*np.array(rows).T)


def median_over_mean(displacements: Any) -> float:
    """Slope of median against mean of |dr|^2 over spheres, from whole sets (runs, n, d); about 0.75 in a cage."""
    r2 = (np.asarray(displacements) ** 2).sum(2)
    mean, median = r2.mean(0), np.median(r2, axis=0)
    return float(mean @ median / (mean @ mean))


def collapse_exponent(
    ensembles: Sequence[Runs],
    structure: Predictors,
    control: Any,
    kind: str = "c",
    times: int = 40,
    between: tuple[float, float] | None = None,
) -> Estimate:
    """Exponent nu for which K[C, <dr>] (kind 'c') or K[S, <|dr|^2>] ('s') against MSD / control^nu fall on one curve.

    Each curve counts from its maximum on. control: phi_J - phi or T of each ensemble. between: the lowest and the highest K
    to use. The error is that of resampled blocks of runs; all need as many blocks.
    """
    blocks = min(r.blocks for r in ensembles)

    def curves(weights: Array) -> tuple[Any, ...]:
        pairs = [decay_curve(r, structure, kind, _fill(weights, r.blocks)) for r in ensembles]
        return [x for x, _ in pairs], [k for _, k in pairs]

    return statistics.collapse_estimate(curves, blocks, control, times, between=between)


def decay_curve(runs: Runs, structure: Predictors, kind: str = "c", weights: Any = None) -> tuple[Array, Array]:
    """MSD and K[C, <dr>] (kind 'c') or K[S, <|dr|^2>] ('s') from the maximum of K on: before it K rises as the noise of few
    runs averages out, which is no decorrelation."""
    if kind == "c":
        mean = runs.mean("displacement", weights)
        k = np.array([statistics.spearman_components(structure.c, dr)[0] for dr in mean])
    else:
        k = np.array([statistics.spearman(structure.s, r2) for r2 in runs.mean("distance2", weights)])
    start = int(np.argmax(k))
    return runs.mean("msd", weights)[start:], k[start:]


def _fill(weights: Array, blocks: int) -> Array:
    """Weights of all blocks of an ensemble: those beyond the resampled ones count only where nothing is resampled."""
    rest = 1.0 if (weights == 1).all() else 0.0
    return np.concatenate([weights, np.full(blocks - len(weights), rest)])


def is_caged(runs: Runs, system: Any, limit: float = 0.1) -> Array:
    """Whether the root of the MSD is below `limit` mean diameters (m,): beyond it the packing's network says nothing any more."""
    return np.sqrt(runs.msd) < limit * system.diameters.mean()


# ---- modes


class ModeWeights(NamedTuple):
    """At each instant: projections (m, modes) of the normalised <dr> on modes; curvature (m,): u.H.u; noise (m,): mean square
    projection on the translations, which no run can move along."""

    projections: Array
    curvature: Array
    noise: Array


def mode_weights(system: Any, runs: Runs, modes: Any, instants: Sequence[int] | None = None) -> ModeWeights:
    """<dr> of the stable spheres, normalised, against the modes of system.modes(which='all')."""
    stable, d = system.hessian_map(), system.dim
    mean = runs.mean("displacement")
    rows, curved, noise = [], [], []
    for m in range(len(mean)) if instants is None else instants:
        u = mean[m][stable]
        u = u / np.linalg.norm(u)
        rows.append(modes.vectors.reshape(len(modes), -1) @ u.reshape(-1))
        curved.append(float(modes.values @ rows[-1] ** 2))
        noise.append(float(((u.sum(0) / np.sqrt(len(stable))) ** 2).mean()) / d)
    return ModeWeights(np.array(rows), np.array(curved), np.array(noise))


# ---- glass observables from whole displacement sets or trajectories


def self_scattering(displacements: Any, q: float) -> Array:
    """F_s(q): mean of cos(q dr_c) over spheres and axes, of sets (..., n, d)."""
    return np.cos(q * np.asarray(displacements)).mean((-2, -1))


def overlap(displacements: Any, length: float) -> Array:
    """Q: share of spheres that moved less than `length`, of sets (..., n, d)."""
    return ((np.asarray(displacements) ** 2).sum(-1) < length**2).mean(-1)


def propensity(runs: Runs) -> Array:
    """Dynamic propensity <|dr_i|^2> of each sphere at each instant (m, n)."""
    return runs.mean("distance2")


def clone_overlap(a: Any, b: Any) -> Array:
    """Overlap of the displacements of two clones (..., n, d): sum a.b over the root of sum a.a sum b.b."""
    a, b = np.asarray(a), np.asarray(b)
    return (a * b).sum((-2, -1)) / np.sqrt((a * a).sum((-2, -1)) * (b * b).sum((-2, -1)))


def clone_distance(a: Any, b: Any) -> Array:
    """Mean square distance between clones, (1/N) sum |r_i^A - r_i^B|^2, of their displacements (..., n, d)."""
    return ((np.asarray(a) - np.asarray(b)) ** 2).sum(-1).mean(-1)
