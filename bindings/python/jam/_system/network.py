"""The jammed network of a system: contacts, forces, stiffness, modes, pair correlation."""
from __future__ import annotations

from typing import Any

import numpy as np

from .. import raw
from .._api.arrays import Array, as_rows, unknown_array
from .._api.calls import freeze, invoke, new_report, not_cancelled, same
from .._api.generated import CheckReport, CrunchReport, ModeColumn, ModesWhich
from .._api.options import as_enum, option_struct
from .._api.results import Contacts, Correlation, Modes
from .._api.tuples import FlexResult, StressStatesResult
from .analysis import Analysis


class Network(Analysis):
    """The contact network that crunch or contacts_from_geometry found; of contacts_by_distance what needs no forces."""

    @property
    def report(self) -> CrunchReport:
        """Result and certificate of the last crunch, a CrunchReport."""
        made = new_report("jam_crunch_report")
        raw.jam_get_crunch_report(self.handle, made)
        return freeze(made, "jam_crunch_report")

    @property
    def history(self) -> Array:
        """Steps of the last crunch as a structured array: one field for each HistoryColumn, in lower case."""
        return as_rows(self._ask("crunch_history"))

    @property
    def contacts(self) -> Contacts:
        """Pairs, unit vectors, gaps and forces of the contacts, as copies. Forces are NaN after contacts_by_distance.

        Examples
        --------
        >>> import jam
        >>> disks = jam.System.random(n=64, dim=2, seed=1, diameters=[1.0] * 32 + [1.4] * 32)
        >>> report = disks.crunch()
        >>> contacts = disks.contacts
        >>> contacts.pairs.shape == (report.contacts, 2), abs(contacts.gaps).max() < 1e-10
        (True, True)
        """
        still = raw.jam_copy(self.handle)[1]  # no other thread comes between the four
        parts = (invoke(still, self.dim, name, (), {})[1] for name in ("contacts", "contact_vectors", "contact_gaps", "forces"))
        return Contacts(*parts)

    @property
    def forces(self) -> Array:
        """Contact forces, shape (contacts,), mean 1. Times report.force_scale they are lambda r of the LP."""
        return self._ask("forces")

    @property
    def coordination(self) -> Array:
        """Number of contacts of each sphere, shape (n,); 0 for rattlers."""
        return self._ask("coordination")

    @property
    def rattlers(self) -> Array:
        """Which spheres are rattlers: bool, shape (n,)."""
        return self.coordination == 0

    @property
    def bucklers(self) -> Array:
        """Which spheres are bucklers, with exactly d + 1 contacts: bool, shape (n,)."""
        return self.coordination == self.dim + 1

    def hessian(self, stiffness: int | str = "harmonic", **options: Any) -> Any:
        """Hessian of the contact network. The unit is the stiffness at the mean force.

        Parameters
        ----------
        stiffness : {'harmonic', 'power', 'hard'}
            'power' takes alpha.
        **options
            alpha, prestress.

        Returns
        -------
        scipy.sparse.csr_matrix, shape (d N', d N')
            Row d k + c is component c of sphere hessian_map()[k]. Rattlers are omitted.
        """
        from scipy.sparse import csr_matrix

        with self._failing():
            chosen = option_struct("jam_hessian_options", dict(options, stiffness=stiffness))
            spheres = self._ask("hessian_map")
            size = self.dim * len(spheres)
            status, count = raw.jam_hessian(self.handle, chosen, None, None, None)
            not_cancelled(status)
            start, column, value = np.empty(size + 1, np.int32), np.empty(count, np.int32), np.empty(count)
            status, filled = raw.jam_hessian(self.handle, chosen, start, column, value)
            self._note(not_cancelled(status))
            same(filled, count)
            same(self._ask("hessian_map"), spheres)
        return csr_matrix((value, column, start), shape=(size, size))

    def modes(
        self,
        k: int = 10,
        which: int | str = "lowest",
        stiffness: int | str = "harmonic",
        *,
        progress: Any = None,
        alpha: float | None = None,
        prestress: float | None = None,
        **options: Any,
    ) -> Modes:
        """Vibrational modes of the network.

        Parameters
        ----------
        k : int
            How many.
        which : {'lowest', 'highest', 'near', 'all'}
            'near' takes frequency. 'lowest' and 'near' leave the d translations out.
        stiffness : {'harmonic', 'power', 'hard'}
            As in `hessian`.
        alpha : float, optional
            Of stiffness 'power', > 1.
        prestress : float, optional
            Overlap (of 'hard' the gap) of a contact of mean force, over the mean diameter.
        **options
            frequency, tolerance, memory_limit.

        Examples
        --------
        >>> import jam
        >>> disks = jam.System.random(n=64, dim=2, seed=1, diameters=[1.0] * 32 + [1.4] * 32)
        >>> report = disks.crunch()
        >>> modes = disks.modes(5)
        >>> len(modes), (modes.values > 0).all()
        (5, True)
        """
        if "count" in options:
            raise TypeError("modes() takes the number of modes as k, not as count")
        handle = self.handle
        with self._reporting(progress):
            h = option_struct("jam_hessian_options", {"stiffness": stiffness, "alpha": alpha, "prestress": prestress})
            o = option_struct("jam_modes_options", dict(options, which=which, count=k))
            spheres = self._ask("hessian_map")
            m = self.dim * len(spheres)
            if as_enum(which, "ModesWhich", "which") != ModesWhich.ALL:
                m = max(0, min(k, m))  # the library refuses less than 1
            table, vectors = unknown_array((m, len(ModeColumn))), unknown_array((m, len(spheres), self.dim))
            status, m = raw.jam_modes(handle, h, o, raw.JAM_MODE_COLUMNS, table.reshape(-1), vectors.reshape(-1))
            self._note(not_cancelled(status))
            same(self._ask("hessian_map"), spheres)
        values, participation = np.ascontiguousarray(table[:m].T)
        return Modes(values, vectors[:m], participation, spheres, self.status)

    def pair_correlation(
        self, r_max: float = 4.0, bins: int = 200, *, kind: Any = None, a: int = -1, b: int = -1
    ) -> Correlation:
        """g(r) in equal bins from 0 to r_max: an array with the distances as its attribute `r`. No contact network is needed.

        Parameters
        ----------
        r_max : float
            In mean diameters.
        bins : int
            Number of bins.
        kind : array_like of int, shape (n,), optional
            A label for each sphere.
        a, b : int
            The labels whose g_ab(r) is wanted; -1 means any.

        With walls g(r) is over centres spread evenly in the container. There spheres of more than 8 different diameters are taken
        as 8 classes of sizes; d must be 2 or 3.

        Examples
        --------
        >>> import jam
        >>> g = jam.System.random(n=64, dim=3, seed=1).pair_correlation(2.0, 40)
        >>> g.shape, (g[:20] == 0).all()
        ((40,), True)
        >>> g.r[:2]
        array([0.025, 0.075])
        """
        if kind is None and (a, b) != (-1, -1):
            raise ValueError(f"a={a} and b={b} are kinds of spheres: give the kind of each sphere as `kind`")
        found: Correlation = self.call("pair_correlation", kind, a=a, b=b, r_max=r_max, bins=bins).view(Correlation)
        found.r = self.distances(r_max, bins)
        return found

    @staticmethod
    def distances(r_max: float = 4.0, bins: int = 200) -> Array:
        """The distances `r` of pair_correlation: the middles of its bins, in mean diameters."""
        return (np.arange(bins) + 0.5) * (r_max / bins)

    def stress_states(self, *, progress: Any = None) -> StressStatesResult:
        """States of self-stress, from positions alone.

        Returns
        -------
        force : array, shape (contacts,)
            The balanced forces, mean 1; the centre of the non-negative ones where there are several states.
        basis : array, shape (m, contacts)
            An orthonormal basis of the m states.
        residual : float
            Largest unbalanced force over the mean force.
        """
        handle, contacts = self.handle, self.report.contacts
        with self._reporting(progress):
            status, _, m = raw.jam_stress_states(handle, None, None)
            not_cancelled(status)
            force, basis = unknown_array(contacts), unknown_array((m, contacts))
            status, residual, filled = raw.jam_stress_states(handle, force, basis.reshape(-1))
            self._note(not_cancelled(status))
            same((filled, self.report.contacts), (m, contacts))
        return StressStatesResult(force, basis, residual)

    def check(
        self, *, crunch: bool = True, prove: bool = False, wall_time: float | None = None, progress: Any = None
    ) -> CheckReport:
        """Tests the packing as it is: by positions, diameters and cell alone. Nothing moves or changes.

        Parameters
        ----------
        crunch : bool
            An undecided packing is crunched, as a copy, to say what that changes.
        prove : bool
            A jammed packing is proved, see prove(). The text says what was proved.
        wall_time : float, optional
            Limit of this crunch in seconds.

        Returns
        -------
        CheckReport
            jammed, strictly_jammed and stationary are a Verdict. It prints as one paragraph; str(report) is that text.

        Examples
        --------
        >>> import jam
        >>> disks = jam.System.random(n=64, dim=2, seed=1, diameters=[1.0] * 32 + [1.4] * 32)
        >>> disks.check().jammed.name
        'NO'
        >>> report = disks.crunch()
        >>> print(str(disks.check()).split(".")[0])
        Collectively jammed, but not strictly
        """
        handle = self.handle
        with self._reporting(progress):
            chosen = option_struct("jam_check_options", {"crunch": crunch, "prove": prove, "wall_time": wall_time})
            made = new_report("jam_check_report")
            status = not_cancelled(raw.jam_check_packing(handle, chosen, made))
            found: CheckReport = freeze(made, "jam_check_report")
            self._note(status, found)
        object.__setattr__(found, "text", raw.jam_check_text(made))
        return found

    def flex(self, kind: int | str = "collective", *, progress: Any = None) -> FlexResult:
        """A motion that keeps or opens all contacts, for a packing that is not jammed.

        Returns
        -------
        out : array, shape (n, d)
            Displacements in the unit of the box; the largest is at most one mean diameter.
        strain : array, shape (d, d)
            Of the cell; 0 for the collective kind.
        """
        out, strain = unknown_array((self.n, self.dim)), unknown_array((self.dim, self.dim))
        with self._reporting(progress):
            kind = as_enum(kind, "RigidityKind", "kind")
            self._note(not_cancelled(raw.jam_flex(self.handle, kind, out.reshape(-1), strain.reshape(-1))[0]))
        return FlexResult(out, strain)
