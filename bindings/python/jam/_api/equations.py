"""Equations of state of equal spheres in closed form, and the fit of the glass branch."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from .arrays import Array, as_array
from .exceptions import ArgumentError, DimensionError, TooFewError, UnsupportedError
from .generated import JAM_MAX_DIM, Report
from .shown import Word


class EosForm(Word):
    """Equations of state p(phi) in closed form, of equal spheres."""

    CARNAHAN_STARLING = 0  # d = 3, as the next three
    PY_VIRIAL = 1  # Percus-Yevick, virial route
    PY_COMPRESSIBILITY = 2  # Percus-Yevick, compressibility route
    VIRIAL = 3  # series to the seventh coefficient
    MK = 4  # Mari-Kurchan model: 1 + 2^d phi / 2, exact for zeta infinite
    FREE_VOLUME = 5  # glass: d / (1 - phi / jammed_fraction)
    HENDERSON = 6  # d = 2: (1 + phi^2 / 8) / (1 - phi)^2, Mol. Phys. 30, 971 (1975)
    PADE = 7  # liquid, any d: Pade approximant [4/5] of B_2 .. B_10, where it rises


@dataclass(frozen=True, repr=False)
class Glass(Report):
    """A fit of the glass branch p = d' / (1 - phi/phi_J). Errors are standard errors.

    jammed_fraction: phi_J
    jammed_error: its error
    dimension: d', free, near d for a good glass
    dimension_error: its error
    r_squared: of the straight line 1/p against phi
    """

    jammed_fraction: float
    jammed_error: float
    dimension: float
    dimension_error: float
    r_squared: float


# B_{n+2} / B_2^{n+1}, n = 1 .. 8, of d = 2 .. 8: Clisby and McCoy, J. Stat. Phys. 122, 15 (2006), table 1. The first two are
# exact; the others are known to 1e-8 .. 1e-5 of B_2^{n+1}.
_VIRIAL = {
    2: (0.782004438, 0.53223180, 0.33355604, 0.1988425, 0.1148728, 0.0649930, 0.0362193, 0.0199537),
    3: (0.625, 0.2869495, 0.110252, 0.03888198, 0.01302354, 0.0041832, 0.0013094, 0.0004035),
    4: (0.506339990, 0.15184606, 0.0357041, 0.0077359, 0.0014303, 0.0002888, 0.0000441, 0.0000113),
    5: (0.4140625, 0.0759724807, 0.0129551, 0.0009815, 0.0004162, -0.0001120, 0.0000747, -0.0000492),
    6: (0.340941322, 0.03336314, 0.0075231, -0.0017385, 0.0013066, -0.0008950, 0.0006673, -0.000525),
    7: (0.2822265625, 0.00986494662, 0.0070724, -0.0035121, 0.0025386, -0.0019937, 0.0016869, -0.001514),
    8: (0.234613606, -0.00255768, 0.00743092, -0.0045164, 0.0034149, -0.0028624, 0.0025969, -0.002511),
}
_PARTS, _HALVINGS = 1000, 40  # of the search for the first pole or maximum: to 1e-15 of the density


def _pade(dim: int) -> tuple[Array, Array]:
    """Numerator and denominator, highest power first, of the approximant [4/5] of the series in x = B_2 rho. The denominator is
    that for which the terms x^5 .. x^9 of its product with the series vanish. [4/5] has no pole in the liquid in any
    dimension; [5/4] has one in d = 7, with a zero beside it."""
    c = np.array((1.0, 1.0, *_VIRIAL[dim]))
    rows = np.array([[c[5 + r - j] for j in range(1, 6)] for r in range(5)])
    below: Array = np.ones(6)
    below[1:] = np.linalg.solve(rows, -c[5:])
    above: Array = np.array([below[: k + 1] @ c[k::-1] for k in range(5)])
    return above[::-1], below[::-1]


def _liquid(dim: int, phi: float) -> float:
    above, below = _pade(dim)
    # denominator and slope change sign only at a pole or at a maximum
    slope: Array = np.polysub(np.polymul(np.polyder(above), below), np.polymul(above, np.polyder(below)))

    def rises(x: float) -> bool:
        return bool(np.polyval(below, x) > 0 and np.polyval(slope, x) > 0)

    x = 2.0 ** (dim - 1) * phi
    parts = x * np.arange(1, _PARTS + 1) / _PARTS
    falls = ~((np.polyval(below, parts) > 0) & (np.polyval(slope, parts) > 0))
    if falls.any() and phi:
        low, high = (x * (int(falls.argmax()) + k) / _PARTS for k in (0, 1))
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if rises(middle) else (low, middle)
        raise ArgumentError(
            f"packing_fraction is {phi:g}: in d = {dim} the pressure of this equation of state of the liquid rises only "
            f"up to {low / 2.0 ** (dim - 1):.4g}, its pole or maximum"
        )
    return float(np.polyval(above, x) / np.polyval(below, x))


def eos(form: int | str, dim: int, packing_fraction: float, jammed_fraction: float = 0.0) -> float:
    """Reduced pressure p = beta P / rho of an equation of state.

    Parameters
    ----------
    form : {'carnahan_starling', 'py_virial', 'py_compressibility', 'virial', 'mk', 'free_volume', 'henderson', 'pade'}
        An EosForm.
    dim : int
    packing_fraction : float
    jammed_fraction : float
        Of 'free_volume'.

    Returns
    -------
    float

    Raises
    ------
    ArgumentError, DimensionError, UnsupportedError
    """
    f = packing_fraction
    if isinstance(form, str):
        if form.upper() not in EosForm.__members__:
            raise ValueError(f"{form!r} is none of {', '.join(m.name.lower() for m in EosForm)}")
        form = EosForm[form.upper()]
    if form not in tuple(EosForm):
        raise ArgumentError(f"form is {form}, not an EosForm")
    if dim not in _VIRIAL:
        raise DimensionError(f"dim is {dim}, supported are 2..{JAM_MAX_DIM}")
    if not 0 <= f < np.inf:
        raise ArgumentError(f"packing_fraction is {f:g}, it must be >= 0 and finite")
    of = 3 if form <= EosForm.VIRIAL else 2 if form == EosForm.HENDERSON else dim
    if dim != of:
        raise UnsupportedError(f"this equation of state is of d = {of}, dim is {dim}")
    if f >= 1 and form not in (EosForm.VIRIAL, EosForm.MK, EosForm.FREE_VOLUME):
        raise ArgumentError(f"packing_fraction is {f:g}, it must be below 1")
    if form == EosForm.CARNAHAN_STARLING:
        return (1 + f + f**2 - f**3) / (1 - f) ** 3
    if form == EosForm.PY_VIRIAL:
        return (1 + 2 * f + 3 * f**2) / (1 - f) ** 2
    if form == EosForm.PY_COMPRESSIBILITY:
        return (1 + f + f**2) / (1 - f) ** 3
    if form == EosForm.VIRIAL:
        return 1 + f * (4 + f * (10 + f * (18.365 + f * (28.224 + f * (39.82 + f * 53.34)))))
    if form == EosForm.MK:
        return 1 + 2.0 ** (dim - 1) * f
    if form == EosForm.HENDERSON:
        return (1 + f**2 / 8) / (1 - f) ** 2
    if form == EosForm.PADE:
        return _liquid(dim, f)
    if not jammed_fraction > f:
        raise ArgumentError(f"jammed_fraction is {jammed_fraction:g}, it must be above the packing fraction {f:g}")
    return dim / (1 - f / jammed_fraction)


def glass_fit(fraction: Any, pressure: Any) -> Glass:
    """Fits the glass branch p = d' / (1 - phi/phi_J) by least squares on 1/pressure against fraction; the line must fall.

    Parameters
    ----------
    fraction : array_like, shape (m,)
        At least 3.
    pressure : array_like, shape (m,)

    Returns
    -------
    Glass

    Raises
    ------
    ArgumentError, TooFewError
    """
    phi, p = as_array(fraction, name="fraction"), as_array(pressure, name="pressure")
    if phi.ndim != 1 or phi.shape != p.shape:
        raise ArgumentError(f"fraction has the shape {phi.shape} and pressure {p.shape}: they are points of one line")
    if len(phi) < 3:
        raise TooFewError(f"{len(phi)} points, a fit with errors needs 3")
    for name, values in (("fraction", phi), ("pressure", p)):
        if not ((values > 0) & np.isfinite(values)).all():
            raise ArgumentError(f"{name} must be positive and finite")
    # centred, as near jamming phi changes in its last digits only
    m, x, y = len(phi), phi - phi[0], 1 / p
    dx, dy = x - x.mean(), y - y.mean()
    sxx, sxy = dx @ dx, dx @ dy
    if not (sxx > 0 and sxy < 0):
        raise ArgumentError("1/pressure does not fall with the packing fraction: no glass branch")
    slope = sxy / sxx
    residual = float(((dy - slope * dx) ** 2).sum())
    variance, distance = residual / (m - 2), -y.mean() / slope
    jammed = float(phi[0] + x.mean() + distance)
    dimension = float(-1 / (slope * jammed))
    return Glass(
        jammed_fraction=jammed,
        jammed_error=float(np.sqrt(variance * (1 / m + distance**2 / sxx)) / abs(slope)),
        dimension=dimension,
        # d' = 1 / a, with a the intercept at fraction 0, whose variance is that of a line's value there
        dimension_error=float(dimension**2 * np.sqrt(variance * (1 / m + phi.mean() ** 2 / sxx))),
        r_squared=float(1 - residual / (dy @ dy)),
    )
