"""Diameters of named laws, and what a set of diameters is."""
from __future__ import annotations

import os
from typing import Any

import numpy as np

from .. import raw
from .arrays import Array, as_array, as_vector
from .calls import freeze, new_report
from .generated import SizeReport
from .given import cell_of, enclosure_of
from .options import option_struct


def density_of(packing_fraction: float | None, porosity: float | None) -> float | None:
    """The packing fraction, given as such or as a porosity (void fraction), or None."""
    if porosity is None:
        return packing_fraction
    if packing_fraction is not None:
        raise TypeError("packing_fraction and porosity are 1 minus each other: give one of them")
    if not 0.0 < float(porosity) < 1.0:
        raise ValueError(f"porosity is {porosity}, it must be above 0 and below 1")
    return 1.0 - float(porosity)


def rows_of(law: str, curve: Any) -> tuple[str, Any]:
    """The law's text without the file that it or `curve` names, and the rows (rows, 2) of this file or of the curve."""
    if isinstance(curve, (str, os.PathLike)):
        name = os.fsdecode(curve)
        if set(",=") & set(name):
            raise ValueError(f"{name!r}: rename the file of the curve: a comma or = in its name is part of a law's text")
        law, curve = law + ("," if ":" in law else ":") + name, None
    if curve is not None:
        rows = as_array(list(curve.items()) if isinstance(curve, dict) else curve, name="curve")
        if rows.ndim != 2 or rows.shape[1] != 2:
            raise ValueError(f"curve must have shape (rows, 2), not {rows.shape}")
        return law, rows
    head, _, items = str(law).partition(":")
    fields = [item for item in items.split(",") if "=" in item]
    if ",".join(fields) == items:
        return law, None
    made = option_struct("jam_diameters_options", {})
    rows = np.empty(raw.jam_parse_diameters(law, made, None)[1])
    raw.jam_parse_diameters(law, made, rows)
    return ":".join([head, *filter(None, [",".join(fields)])]), rows.reshape(-1, 2)


def contact_distance(a: Array, b: Array, non_additivity: float) -> Array:
    """Of the centres of touching spheres with the diameters a and b."""
    return np.asarray(0.5 * (a + b) * np.where(a == b, 1.0, 1.0 + non_additivity))


def volume_of(container: int, cell: Array) -> float:
    """Of the container in this cell, as the library has it. No system has no sphere: here is a small one in the middle."""
    dim, size = len(cell), 1e-9 * float(np.abs(cell).sum())
    made, info = option_struct("jam_create_options", {"dim": dim, "container": container}), new_report("jam_info")
    raw.jam_get_info(raw.jam_create(made, 0.5 * cell.sum(0)[None], np.array([size]), cell.reshape(-1), None)[1], info)
    return float(info.volume)


def sizes(
    law: str = "equal",
    n: int | None = None,
    *,
    curve: Any = None,
    porosity: float | None = None,
    packing_fraction: float | None = None,
    cell: Any = None,
    box: Any = None,
    container: Any = None,
    dim: int = 3,
    **options: Any,
) -> Array:
    """Diameters of a named law, in the unit of the user.

    Parameters
    ----------
    law : str
        equal (mean), list (curve), uniform (low, high), normal (mean, deviation), lognormal (mean, deviation), power
        (exponent, low, high), weibull (scale, shape; Rosin-Rammler), sieve (curve). Normal, lognormal and weibull may be
        cut by low and high. A text such as 'lognormal:deviation=0.3,share=volume' holds fields and rows too.
    n : int, optional
        Number of spheres. Without it a porosity or packing fraction in a cell gives the number, and the last sphere is
        adjusted so that the density is exact.
    curve : array_like, shape (rows, 2), dict, or path-like, optional
        Rows (diameter, share) of a list, or (size, share that passes) of a sieve curve, from 0 to 1 or to 100 per cent.
    porosity : float, optional
        Void fraction of the packing to be made. Instead: packing_fraction.
    cell, box : optional
        As of System.from_arrays. Spheres of more volume than that are refused.
    container : str, optional
        As of System.random: a density is then one of this container in the cell. Flat walls change no volume.
    dim : int
        Dimension, of volumes.
    **options
        mean, deviation, low, high, exponent, scale, shape; share ('number' or 'volume'; usual: volume for weibull and
        sieve, else number); draw ('quantiles', the default: few spheres follow the law; 'random'); seed, of random.

    Returns
    -------
    array, shape (n,)
        Quantiles ascend.

    Raises
    ------
    ArgumentError, DimensionError, FormatError, IoError, NonfiniteError, UnplaceableError

    Examples
    --------
    >>> import jam
    >>> jam.sizes("list", 5, curve=[(1.0, 0.6), (1.4, 0.4)])
    array([1. , 1. , 1. , 1.4, 1.4])
    >>> grains = jam.sizes("sieve", 200, curve=[(1, 0), (2, 30), (4, 100)])
    >>> round(jam.size_report(grains).d50, 2)
    2.44
    """
    fraction = density_of(packing_fraction, porosity)
    side, vectors = cell_of(box, cell, dim)
    if side is not None:
        vectors = side * np.eye(dim)
    volume = None if vectors is None else volume_of(enclosure_of(container, None, dim)[0], vectors)
    if fraction is not None and volume is None:
        raise TypeError("a density needs cell or box")
    if n is None and fraction is None:
        raise TypeError("give n, or porosity and cell, from which it follows")
    if fraction is not None and n is not None:
        raise TypeError("give n or a density: from the density in the cell n follows")
    if "walls" in options:
        raise TypeError("flat walls take no volume of the cell: give walls= to System.random, and here container= where it is round")
    text, rows = rows_of(law, curve)
    plain = dict(options, n=n, dim=dim, cell_volume=volume, packing_fraction=fraction)
    raw.jam_parse_diameters(text, option_struct("jam_diameters_options", {}), None)  # names laws before their options
    made = option_struct("jam_diameters_options", plain)
    given = {name: getattr(made, name) for name, value in options.items() if value is not None}
    _, count = raw.jam_parse_diameters(text, made, None)  # other fields stay as they are
    for name, value in given.items():
        if getattr(made, name) != value and value == value:
            raise TypeError(f"{name} is given twice, as {value} and in the law's text")
    if count:
        if rows is not None:
            raise TypeError("the law's text and curve both give rows")
        rows = np.empty(count)
        raw.jam_parse_diameters(text, made, rows)
    rows = None if rows is None else rows.reshape(-1)
    out = np.empty(raw.jam_diameters(made, rows, None)[1] if n is None else max(made.n, 0))
    raw.jam_diameters(made, rows, out)
    return out


def size_report(diameters: Any, dim: int = 3) -> SizeReport:
    """What a set of diameters is: moments, D10, D50, D90 by volume, and the densities in reach.

    The densities in reach are those of the bulk. Walls lower them, about as one over the width of the container: the guide's studies
    of scenes show by how much.

    Parameters
    ----------
    diameters : array_like, shape (n,)
        Each above 0.
    dim : int
        Dimension, of volumes.

    Returns
    -------
    SizeReport

    Examples
    --------
    >>> import jam
    >>> report = jam.size_report([1.0, 1.0, 1.4, 1.4], dim=2)
    >>> round(report.polydispersity, 4), round(report.d50, 1)
    (0.1667, 1.4)
    """
    made = new_report("jam_size_report")
    raw.jam_get_size_report(dim, as_vector(diameters, name="diameters"), made)
    return freeze(made, "jam_size_report")
