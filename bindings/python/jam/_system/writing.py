"""What a system writes: its packing, contacts, page, and the file of all of it."""
from __future__ import annotations

import html
import os
import tempfile
from pathlib import Path
from typing import Any, Mapping

import numpy as np

from .. import raw
from .._api.arrays import as_array
from .._api.options import as_enum
from .._api.results import Modes
from .._formats import gsd
from .._formats.replacing import MENDED
from ..errors import JamError, StoreError
from .network import Network
from .passing_file import passing_file
from .state import State


class Writing(State, Network):
    """Files of a system."""

    def write(
        self, path: str | os.PathLike[str], format: int | str = "auto", *, scale: float = 1.0, density: float = 1.0
    ) -> None:
        """Writes positions and diameters with 17 digits.

        Parameters
        ----------
        path : path-like
            The file appears whole or not at all.
        format : {'auto', 'plain', 'xyz', 'lammps', 'vtp'}
            'auto' goes by the ending: .xyz and .extxyz are extended XYZ; .data and .lmp LAMMPS data; .vtp ParaView's;
            .gsd HOOMD's (needs python3-gsd); .dat, .txt and no ending plain text. With .gz behind it the file is
            compressed. Other endings are refused. jam.files.formats() lists them.
        scale : float
            All lengths times this, 1e-12 to 1e12. With 1 reading gives the same bits; another scale rounds.
        density : float
            Of the spheres, in the unit of LAMMPS data, which alone have a place for it.
        """
        name = os.fsdecode(path)
        if format == "auto" and gsd.is_name(name):
            if scale != 1.0 or density != 1.0:
                raise ValueError("GSD files are written without scale and density")
            return gsd.write(name, self)
        self._done(lambda: raw.jam_write_scaled(self.handle, name, as_enum(format, "Format", "format"), float(scale), float(density)))

    def write_contacts(self, path: str | os.PathLike[str], format: int | str = "auto") -> None:
        """Writes the contact network: pairs, unit vectors, gaps and forces.

        Parameters
        ----------
        path : path-like
            The file appears whole or not at all.
        format : {'auto', 'csv', 'dump', 'vtp'}
            'auto' goes by the ending: .csv is a table, .dump a LAMMPS dump local, .vtp lines for ParaView. With .gz
            behind it the file is compressed.
        """
        self._done(lambda: raw.jam_write_contacts(self.handle, os.fspath(path), as_enum(format, "ContactFormat", "format")))

    def page(
        self,
        path: str | os.PathLike[str],
        title: str = "",
        *,
        values: Mapping[str, Any] | None = None,
        modes: Modes | None = None,
        small: bool = False,
    ) -> None:
        """Writes one HTML file that shows the packing in a browser; it needs no network.

        It shows spheres and contact forces to turn and to slice, the numbers of each sphere, the certificate and
        distributions.

        Parameters
        ----------
        path : path-like
            The file appears whole or not at all.
        title : str
            Its heading.
        values : mapping of str to array_like, shape (n,) or (n, d)
            Under these names: numbers that spheres can be coloured by, (n,), and displacements that are
            animated, (n, d).
        modes : Modes, optional
            Vibrational modes to animate, as of modes().
        small : bool
            The picture alone, without the numbers beside it.

        Examples
        --------
        >>> import jam
        >>> disks = jam.System.random(n=64, dim=2, seed=1, diameters=[1.0] * 32 + [1.4] * 32)
        >>> report = disks.crunch()
        >>> disks.page("disks.html", values={"height": disks.positions[:, 1]}, modes=disks.modes(4))
        """
        rows: dict[str, Any] = {}  # a name that ends in [] has d rows
        for name, given in (values or {}).items():
            column = as_array(given, name=name)
            if "\n" in name or not name or name.endswith("[]"):
                raise ValueError(f"{name!r} is no name of values: it must be one line that is not empty or ends in []")
            if column.shape == (self.n, self.dim):
                rows[name + "[]"] = column.T.reshape(-1)
            elif column.shape == (self.n,):
                rows[name] = column
            else:
                raise ValueError(f"{name} must have shape ({self.n},) or ({self.n}, {self.dim}), not {column.shape}")
        if modes is not None:
            for k, vectors in enumerate(as_array(modes.vectors, name="modes")):
                whole = np.zeros((self.n, self.dim))
                whole[modes.spheres] = vectors
                rows[f"mode {k}, omega {modes.frequencies[k]:.4g}[]"] = whole.T.reshape(-1)
        numbers = np.concatenate(list(rows.values())) if rows else None
        self._done(lambda: raw.jam_write_page(self.handle, os.fspath(path), title, int(small), "\n".join(rows), numbers))

    def _repr_html_(self) -> str:
        """What notebooks show: the small page in a frame. Above 20000 spheres the text of repr, to keep notebooks small."""
        if self._handle is None or self.n > 20000:
            return f"<pre>{html.escape(repr(self))}</pre>"
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "page.html")
            self.page(file, small=True)
            text = file.read_text(encoding="utf-8")
        return (
            f'<iframe srcdoc="{html.escape(text)}" title="{html.escape(repr(self))}" '
            'style="width:100%;height:480px;border:1px solid #ccc"></iframe>'
        )

    def save(self, path: str | os.PathLike[str], *, refined: bool = False) -> None:
        """Writes the packing with all its results to one HDF5 file, which jam.load reads (needs python3-h5py).

        Stored are the state from which dynamics continue, report, contacts, forces, history, the calls made with their
        options, and where it was made. What was observed is not. Positions and box have the layout of H5MD.
        refined=True stores the centres of refined_positions() too. The name ends in .h5 or .hdf5.

        A progress callable may save: the file holds the last step of the call that runs, as write_checkpoint does, without
        results. Its last call then has the status "running". A second thread gets BusyError meanwhile.
        """
        from .._formats.write_packing import save

        save(self, path, refined=refined)

    def _state(self) -> bytes:
        """The bytes of a checkpoint, which holds all: velocities, shifts, results."""
        with passing_file() as file:
            self.write_checkpoint(str(file))
            return file.read_bytes()

    def _checkpointed(self) -> tuple[bytes, Any]:
        """The bytes of a checkpoint and the system that they make: one call of the library, so that no part is of another
        moment. Raises what reading it raises, where nothing could read it back.
        """
        try:
            pickled: Any = self.__reduce__()
            make, (state, *more) = pickled
        except OSError as error:
            what = f"the state cannot be written below {tempfile.gettempdir()}: {error}. {MENDED}"
            raise StoreError(error.errno or 5, what) from error
        try:
            return state, make(state, *more)
        except JamError as error:
            if isinstance(error, MemoryError):
                raise
            raise type(error)(f"nothing would read this packing back: {error}. write() writes its spheres") from error
