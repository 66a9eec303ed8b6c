"""A packing as objects of other packages: pandas, NetworkX, ASE. Each is imported when it is asked for."""
from __future__ import annotations

import math
from typing import Any

import numpy as np

from .._api.given import closed_axes, container_word, walls_of
from ..errors import StateError
from .network import Network
from .state import State


class Converting(State, Network):
    """What a system is in other packages."""

    def to_pandas(self, what: str = "spheres") -> Any:
        """A DataFrame with a row for each sphere, contact or step.

        Parameters
        ----------
        what : {'spheres', 'contacts', 'history'}
            'spheres': position, diameter and, after a crunch, contacts and kind (a word). 'contacts': i, j, unit vector
            from j to i, gap and force, which contacts by distance do not have. 'history': the steps of the last crunch, their phase as a word.

        Examples
        --------
        >>> import jam
        >>> disks = jam.System.random(n=64, dim=2, seed=1, diameters=[1.0] * 32 + [1.4] * 32)
        >>> report = disks.crunch()
        >>> list(disks.to_pandas("contacts"))
        ['i', 'j', 'nx', 'ny', 'gap', 'force']
        """
        import pandas

        still = self.copy()
        makers = {"spheres": still._sphere_columns, "contacts": still._contact_columns, "history": still._step_columns}
        if what not in makers:
            raise ValueError(f"{what!r} is none of {', '.join(makers)}")
        return pandas.DataFrame(makers[what]())

    def to_networkx(self) -> Any:
        """The contact network as a networkx.MultiGraph: two spheres of a small cell may touch through two images.

        Nodes have position, diameter and kind ('sphere', 'buckler' or 'rattler'), edges force, gap and vector (from j to i,
        of unit length); contacts by distance have no force. A wall that is touched is a node below 0, -1 - w, of kind 'wall'.

        Examples
        --------
        >>> import jam
        >>> disks = jam.System.random(n=64, dim=2, seed=1, diameters=[1.0] * 32 + [1.4] * 32)
        >>> report = disks.crunch()
        >>> disks.to_networkx().number_of_edges() == report.contacts
        True
        """
        import networkx

        graph, still = networkx.MultiGraph(), self.copy()
        contacts, kinds = still.contacts, still._kinds()
        for i, (x, size) in enumerate(zip(still.positions, still.diameters)):
            graph.add_node(i, position=tuple(x), diameter=float(size), kind=kinds[i])
        graph.add_nodes_from((int(j) for j in contacts.pairs[:, 1] if j < 0), kind="wall")
        for (i, j), vector, gap, force in zip(contacts.pairs, contacts.vectors, contacts.gaps, contacts.forces):
            carried = {"force": float(force)} if math.isfinite(force) else {}
            graph.add_edge(int(i), int(j), vector=tuple(vector), gap=float(gap), **carried)
        return graph

    def to_ase(self, symbol: str = "X") -> Any:
        """An ase.Atoms with the array `radius`, periodic in the directions of the packing. In d = 2 all z are 0.

        Parameters
        ----------
        symbol : str
            Chemical symbol of every sphere.

        Examples
        --------
        >>> import jam
        >>> disks = jam.System.random(n=8, dim=2, seed=1)
        >>> again = jam.System.from_ase(disks.to_ase(), dim=2)
        >>> bool((again.positions == disks.positions).all())
        True
        """
        from ase import Atoms

        if self.dim not in (2, 3):
            raise ValueError(f"ASE has three dimensions, this system has d = {self.dim}")
        still = self.copy()
        x, cell = np.zeros((self.n, 3)), np.eye(3)
        x[:, : self.dim] = still.positions
        cell[: self.dim, : self.dim] = still.cell
        closed = closed_axes(still.info) + [True]
        atoms = Atoms([symbol] * self.n, positions=x, cell=cell, pbc=[k < self.dim and not closed[k] for k in range(3)])
        if any(closed[: self.dim]):
            atoms.info.update(container=container_word(still.info), walls=walls_of(still.info))
        if still.info.non_additivity != 0:
            atoms.info["non_additivity"] = still.info.non_additivity
        atoms.set_array("radius", 0.5 * still.diameters)
        return atoms

    def _kinds(self) -> Any:
        kinds = np.full(self.n, "sphere", dtype=object)
        kinds[self.bucklers] = "buckler"
        kinds[self.rattlers] = "rattler"
        return kinds

    def _sphere_columns(self) -> dict[str, Any]:
        found: dict[str, Any] = dict(zip(self._axes(), self.positions.T.copy()), diameter=self.diameters.copy())
        try:
            found.update(contacts=self.coordination, kind=self._kinds())
        except StateError:
            pass  # no network yet
        return found

    def _contact_columns(self) -> dict[str, Any]:
        c = self.contacts
        axes = {"n" + axis: c.vectors[:, k].copy() for k, axis in enumerate(self._axes())}
        force = {} if math.isfinite(self.info.contact_gap) else {"force": c.forces}
        return {"i": c.pairs[:, 0].copy(), "j": c.pairs[:, 1].copy(), **axes, "gap": c.gaps, **force}

    def _step_columns(self) -> dict[str, Any]:
        from .._api.generated import StepPhase

        rows = self.history
        found: dict[str, Any] = {name: rows[name].copy() for name in rows.dtype.names or ()}
        found["phase"] = [StepPhase(int(p)).name.lower() for p in rows["phase"]]
        return found

    def _axes(self) -> list[str]:
        return ["x", "y", "z"][: self.dim] if self.dim <= 3 else [f"x{k}" for k in range(self.dim)]
