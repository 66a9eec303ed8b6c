"""Routes to the jamming point: time against the errors of density, contacts and forces.

Each function returns points of one route. A point holds processor seconds since the start, the distance of phi_J from the
route's own limit, contacts that the limit has and the point lacks (missed) and the other way round (added), the residual of
the force balance and the root mean square error of contact forces over the mean force. What a route does not give is None.
"""
import time

import numpy as np

import jam

# Tolerances of a crunch, from loose to the defaults: gain, step, polish.
SETTINGS = (
    ("gain 1e-3", dict(gain_tolerance=1e-3, step_tolerance=1.0, polish=0)),
    ("gain 1e-6", dict(gain_tolerance=1e-6, step_tolerance=1e-2, polish=0)),
    ("gain 1e-9", dict(gain_tolerance=1e-9, step_tolerance=1e-5, polish=0)),
    ("no polish", dict(polish=0)),
    ("defaults", {}),
)


def network(packing):
    """Contacts of the stored network as a dict of pair -> force over the mean force; empty without a network."""
    try:
        contacts = packing.contacts
    except jam.JamError:
        return {}
    table = contacts.table()
    force = np.asarray(table["force"], float)
    mean = force.mean() if len(force) and force.mean() > 0 else 1.0
    return {(int(i), int(j)): f / mean for i, j, f in zip(table["i"], table["j"], force)}


def errors(found, limit):
    """(missed, added, root mean square error of the forces of common contacts)"""
    common = found.keys() & limit.keys()
    force = float(np.sqrt(np.mean([(found[pair] - limit[pair]) ** 2 for pair in common]))) if common else None
    return len(limit) - len(common), len(found) - len(common), force


def point(setting, seconds, error, found=None, limit=None, residual=None, status="ok", **more):
    missed, added, force = errors(found, limit) if found and limit else (None, None, None)
    return dict(
        setting=setting,
        seconds=seconds,
        error=error,
        missed=missed,
        added=added,
        force_error=force,
        residual=residual,
        status=status,
        **more,
    )


def crunched(start, settings=SETTINGS, limit_seconds=3600.0, **options):
    """Sequential LPs or the barrier path, by tolerance. The limit is the run with the default tolerances."""
    runs = []
    for name, setting in settings[::-1]:
        packing = start.copy()
        began = time.process_time()
        report = packing.crunch(wall_time=limit_seconds, **setting, **options)
        runs.append((name, time.process_time() - began, report, network(packing)))
        if report.status == jam.StatusCode.LIMIT:  # nothing would judge the looser ones
            break
    _, _, best, limit = runs[0]
    ended = best.status != jam.StatusCode.LIMIT
    return [
        point(
            name,
            seconds,
            abs(r.packing_fraction - best.packing_fraction) if ended else None,
            found,
            limit if ended else None,
            r.force_residual if ended and found else None,  # without a network there is none
            jam.StatusCode(r.status).name.lower(),
            jammed=bool(r.jammed),
            phi=r.packing_fraction,
            factorisations=r.factorisations,
            lps=r.lp_solves,
        )
        for name, seconds, r, found in runs[::-1]
    ]


def grown(start, rate, last=10):
    """Molecular dynamics alone: phi_J by the fit of the glass branch over the last decade of p, up to p = 10^last. Contacts by
    `contacts_from_geometry`, forces by the momentum that pairs exchange in 200 collisions a sphere."""
    packing = start.copy()
    seconds, samples, points = 0.0, [], []
    first = np.ceil(4 * np.log10(packing.pressure)) / 4
    for exponent in np.arange(first, last + 0.1, 0.25):
        began = time.process_time()
        report = packing.compress([(rate, 10.0**exponent)])
        seconds += time.process_time() - began
        if report.status != 0:
            points.append(point(f"p = 1e{exponent:g}", seconds, None, status=report.stop_reason.name.lower()))
            break
        samples = (samples + [(report.packing_fraction, report.pressure)])[-5:]
        if exponent % 1.0 == 0.0 and len(samples) >= 3:
            fit = jam.glass_fit(*np.array(samples).T)
            state = packing.copy()
            began = time.process_time()
            state.contacts_from_geometry()
            geometry = time.process_time() - began
            began = time.process_time()
            by_collisions = momenta(packing)
            points.append(
                dict(
                    setting=f"p = 1e{exponent:g}",
                    phi=fit.jammed_fraction,
                    seconds=seconds,
                    seconds_geometry=geometry,
                    seconds_momenta=time.process_time() - began,
                    network=network(state),
                    momenta=by_collisions,
                )
            )
    limit = packing.copy()
    best = limit.crunch()
    exact = network(limit)
    for k, p in enumerate(points):
        if "network" not in p:
            continue
        points[k] = point(
            p["setting"],
            p["seconds"],
            abs(p["phi"] - best.packing_fraction),
            p["network"],
            exact,
            seconds_geometry=p["seconds_geometry"],
            seconds_momenta=p["seconds_momenta"],
            phi=p["phi"],
        )
        points[k]["force_error_geometry"] = points[k]["force_error"]
        points[k]["force_error"] = errors(p["momenta"], exact)[2]
    return points


def momenta(packing):
    """Mean forces by collisions, on a copy: pair -> force over the mean."""
    run = packing.copy()
    with run.observing(collisions=1):
        run.run(200)
    seen = run.observed_pairs()
    mean = seen.momentum.mean()
    return {(int(i), int(j)): m / mean for (i, j), m in zip(seen.pair, seen.momentum)}


def softened(n, seed, minimiser, distances, limit_seconds=3600.0):
    """Soft spheres from above: random overlapping spheres at packing fraction 0.70 are decompressed to one distance
    ln(R / R_J) after the other. The limit is a crunch of the last state, shrunk to contact."""
    packing = jam.System.random(n=n, seed=seed, packing_fraction=0.70, overlap="allow")
    seconds, rows = 0.0, []
    for distance in distances:
        began = time.process_time()
        report = packing.decompress(
            distance=distance, isostatic=0, crunch=0, minimiser=minimiser, wall_time=limit_seconds
        )
        seconds += time.process_time() - began
        rows.append((f"ln(R/R_J) = {distance:g}", seconds, report, network(packing)))
        if report.status != 0 or seconds > limit_seconds:
            break
    below = jam.System.from_arrays(packing.positions, packing.diameters, overlap="shrink")
    best = below.crunch()
    exact = network(below)
    return [
        point(
            name,
            seconds,
            abs(r.jammed_fraction - best.packing_fraction),
            found,
            exact,
            r.force_residual,
            jam.StatusCode(r.status).name.lower(),
            phi=r.jammed_fraction,
            evaluations=r.evaluations,
        )
        for name, seconds, r, found in rows
    ]
