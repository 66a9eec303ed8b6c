"""The system of spheres: a thin, native-feeling layer over the C handle."""
from __future__ import annotations

import html
import os
import tempfile
from pathlib import Path
from typing import Any, Mapping

import numpy as np

from ._api import calls, given, errors
from . import raw
from ._system.network import Network
from ._system.progress import end, reporter
from ._system.state import State
from ._system.verbs import Verbs
from ._api.results import Contacts, Modes

__all__ = ["Contacts", "Modes", "System"]


class System(State, Verbs, Network):
    """N spheres in a periodic cube, or in any periodic cell.

    Make one by `System.random`, `System.from_arrays` or `System.read`. `run`, `compress` and `crunch` move the spheres.
    `report`, `contacts`, `forces`, `gaps`, `hessian` and `modes` describe the jammed network.

    Lengths are in the unit of `box`, diameters are diameters (not radii), and kT/m = 1. Only one call at a time may run
    on a system: a second thread gets `BusyError`. Ctrl-C stops a running call with a valid state and raises
    KeyboardInterrupt.

    Examples
    --------
    >>> import jam
    >>> disks = jam.System.random(n=64, dim=2, seed=1, diameters=[1.0] * 32 + [1.4] * 32)
    >>> report = disks.crunch()
    >>> report.jammed, report.max_overlap < 1e-12
    (True, True)
    >>> disks.forces.mean().round(12)
    1.0
    """

    # ---- making
    @classmethod
    def random(
        cls,
        n: int = 1024,
        dim: int = 3,
        seed: int = 1,
        *,
        packing_fraction: float | None = None,
        diameters: Any = None,
        progress: Any = None,
        **options: Any,
    ) -> "System":
        """Random sequential start: spheres are placed one by one where they do not overlap.

        With overlap='allow' they are independent uniform points, for soft spheres.

        Parameters
        ----------
        n : int
            Number of spheres.
        dim : int
            Dimension, 2 to 8.
        seed : int
            Seed of every random stream of this system.
        packing_fraction : float, optional
            Of the start. Default: 0.2, halved for each dimension above 3.
        diameters : array_like, optional
            n values; only their ratios count. Default: all equal.
        progress : bool or callable, optional
            As of `compress`. A true answer of the callable ends the call with StoppedError, as wall_time does.
        **options
            box or cell as of `from_arrays`, model ('euclid' or 'mk'), mk_zeta, masses, non_additivity, wall_time,
            memory_limit.

        Examples
        --------
        >>> import jam
        >>> jam.System.random(n=100, dim=2, seed=7)
        System(n=100, dim=2, packing_fraction=0.2, box=1, seed=7)
        """
        sizes = None if diameters is None else calls.as_array(diameters, name="diameters").reshape(-1)
        if packing_fraction is None:
            packing_fraction = 0.0  # the library's own, by dimension
        made = dict(options, n=n, dim=dim, seed=seed, packing_fraction=packing_fraction)
        return cls._create(made, None, sizes, progress)

    @classmethod
    def from_arrays(
        cls,
        positions: Any,
        diameters: Any = None,
        box: Any = None,
        *,
        radii: Any = None,
        cell: Any = None,
        dim: int | None = None,
        **options: Any,
    ) -> "System":
        """Spheres at given positions.

        Parameters
        ----------
        positions : array_like, shape (n, d)
            In the unit of `box`; wrapped into it. Without box and cell they must lie in [0, 1]. Any real dtype, order
            and stride. An array that is not C-contiguous float64 is copied once. Masked values are refused.
        diameters : array_like, shape (n,), or float
            One for each sphere, or one for all.
        box : float or array_like, shape (d,), optional
            Side of the periodic cube, default 1, or d sides of a brick.
        cell : array_like, shape (d, d) or (d,), optional
            Instead of box: cell vectors, one a row, or the sides of a brick. Positions are in the frame of these
            vectors, which must be right-handed.
        radii : array_like, shape (n,), or float, optional
            Instead of diameters.
        dim : int, optional
            Confirms d. Without it a last column that equals the sizes is refused: most such arrays hold x, y, z, r.
        **options
            overlap ('refuse', the default, 'shrink': scales all diameters until no pair overlaps, or 'allow': soft
            spheres), seed, model, mk_zeta, masses, non_additivity, wall_time, memory_limit.

        Examples
        --------
        >>> import jam
        >>> jam.System.from_arrays([[1.0, 1.0], [3.0, 3.0]], radii=0.5, box=4.0).diameters
        array([1., 1.])
        """
        x = given.positions_of(positions, diameters, radii, dim)
        sizes = given.sizes_of(diameters, radii, len(x))
        given.refuse_start_options(options, ("packing_fraction",), "the diameters are given")
        if options.get("n") not in (None, len(x)):
            raise ValueError(f"n is {options['n']}, and there are {len(x)} positions")
        if box is None and cell is None:
            given.refuse_unnamed_box(x)
        options.update(n=len(x), dim=x.shape[1], box=box, cell=cell)
        return cls._create(options, x.reshape(-1), sizes)

    @classmethod
    def read(cls, path: str | os.PathLike[str], **options: Any) -> "System":
        """Reads a packing: plain text, extended XYZ, data and dumps of LAMMPS, tables, each also compressed, or GSD.

        The content gives the format, except for GSD (needs python3-gsd), where the ending .gsd does. For other formats
        there is jam.files.read_ase.

        Parameters
        ----------
        path : path-like
            The file. Positions and diameters come back with the bits that were written.
        **options
            overlap ('refuse' or 'shrink'), seed, model, mk_zeta, masses, non_additivity, frame, and box where the file
            names none. GSD files take the keywords of jam.files.read_gsd too.
        """
        name = os.fsdecode(path)
        if name.lower().endswith(".gsd"):
            from . import other_files

            return other_files.read_gsd(name, **{key: value for key, value in options.items() if value is not None})
        for unknown in ("diameters", "radii", "cell"):
            if unknown in options:
                raise TypeError(
                    f"{unknown}= goes with GSD files and jam.files.read_ase alone: "
                    "read other files without sizes or cell by numpy, and pass the arrays to System.from_arrays"
                )
        options["box"] = given.side_of(options.get("box"))
        return cls._made(*raw.read_watched(name, calls.options("jam_create_options", options), None))

    @classmethod
    def from_checkpoint(cls, path: str | os.PathLike[str]) -> "System":
        """Reads a file of `checkpoint_write`. The dynamics continue to the same bits as if they had never stopped."""
        return cls._made(*raw.checkpoint_read_watched(os.fspath(path), None))

    @classmethod
    def _made(cls, status: int, handle: Any) -> "System":
        if status != 0:
            raise errors.StoppedError(f"no system was made: {raw.jam_last_error()}")
        return cls(handle)

    @classmethod
    def _create(cls, options: dict[str, Any], positions: Any, diameters: Any, progress: Any = None) -> "System":
        box, vectors = given.cell_of(options.pop("box", None), options.pop("cell", None), options["dim"])
        made = calls.options("jam_create_options", dict(options, box=box))
        told = reporter(progress)

        def on_progress(p: Any) -> bool:
            return bool(told(calls.freeze(p, "jam_progress"))) if told else False

        try:
            if vectors is None:
                answer = raw.create_watched(made, positions, diameters, told and on_progress)
            else:
                flat = vectors.reshape(-1)
                answer = raw.create_in_cell_watched(made, flat, positions, diameters, told and on_progress)
        finally:
            end(told)
        return cls._made(*answer)

    # ---- life
    def close(self) -> None:
        """Frees the system once no array views its memory. Any other use then raises ClosedError."""
        self._handle = None

    def __enter__(self) -> "System":
        self.handle
        return self

    def __exit__(self, *exc: Any) -> None:
        self.close()

    def copy(self) -> "System":
        """Deep copy with results and what was observed. It has the same seed, so set velocities to make its dynamics differ."""
        made = System._made(*raw.jam_copy(self.handle))
        made.trace, made.calls = list(self.trace), list(self.calls)
        return made

    __copy__ = copy

    def __deepcopy__(self, memo: dict[str, Any]) -> "System":
        return self.copy()

    def __reduce__(self) -> tuple[Any, ...]:
        with tempfile.TemporaryDirectory() as folder:  # the checkpoint holds all: velocities, shifts, results
            file = Path(folder, "state")
            self.checkpoint_write(str(file))
            return _restore, (file.read_bytes(), self.calls, self.trace)

    def _results(self) -> tuple[Any, ...] | None:
        """Report, contacts and history, None where there is none."""
        found: list[Any] = []
        for name in ("report", "contacts", "history"):
            try:
                found.append(getattr(self, name))
            except errors.StateError:
                found.append(None)
        return tuple(found) if found[1] is not None or found[0] is not None else None

    def __repr__(self) -> str:
        if self._handle is None:
            return "System(closed)"
        i = self.info
        return f"System(n={i.n}, dim={i.dim}, packing_fraction={i.packing_fraction:.8g}, box={i.box:g}, seed={i.seed})"

    def __len__(self) -> int:
        found: int = self.n
        return found

    # ---- files
    def write(self, path: str | os.PathLike[str], format: int | str = "auto") -> None:
        """Writes positions and diameters with 17 digits.

        Parameters
        ----------
        path : path-like
            The file appears whole or not at all.
        format : {'auto', 'plain', 'xyz', 'lammps', 'vtp'}
            'auto' goes by the ending: .xyz and .extxyz are extended XYZ; .data and .lmp LAMMPS data; .vtp ParaView's;
            .gsd HOOMD's (needs python3-gsd); .dat, .txt and no ending plain text. With .gz behind it the file is
            compressed. Other endings are refused.
        """
        name = os.fsdecode(path)
        if format == "auto" and name.endswith(".gsd"):
            from . import other_files

            return other_files.write_gsd(self, name)
        calls.finished(raw.jam_write(self.handle, name, calls.as_enum(format, "Format")))

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
        calls.finished(raw.jam_write_contacts(self.handle, os.fspath(path), calls.as_enum(format, "ContactFormat")))

    def page(
        self,
        path: str | os.PathLike[str],
        title: str = "",
        *,
        values: Mapping[str, Any] | None = None,
        small: bool = False,
    ) -> None:
        """Writes one HTML file to look at the packing in a browser; it needs no network.

        It shows spheres and contact forces to turn and to slice, the numbers of each sphere, the certificate and
        distributions.

        Parameters
        ----------
        path : path-like
            The file appears whole or not at all.
        title : str
            Its heading.
        values : mapping of str to array_like, shape (n,)
            More numbers that spheres can be coloured by, under these names.
        small : bool
            The picture alone, without the numbers beside it.

        Examples
        --------
        >>> import jam
        >>> disks = jam.System.random(n=64, dim=2, seed=1, diameters=[1.0] * 32 + [1.4] * 32)
        >>> report = disks.crunch()
        >>> disks.page("disks.html", values={"height": disks.positions[:, 1]})
        """
        columns = {name: calls.as_array(x, name=name).reshape(-1) for name, x in (values or {}).items()}
        for name, column in columns.items():
            if "\n" in name or not name:
                raise ValueError(f"{name!r} is no name of values: it must be one line that is not empty")
            if len(column) != self.n:
                raise ValueError(f"{name} must have shape ({self.n},), not {column.shape}")
        numbers = np.concatenate(list(columns.values())) if columns else None
        calls.finished(raw.jam_write_page(self.handle, os.fspath(path), title, int(small), "\n".join(columns), numbers))

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

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the packing with all its results to one HDF5 file, which jam.load reads (needs python3-h5py).

        Stored are the state that dynamics go on from, report, contacts, forces, history, the calls made with their
        options, and where it was made. What was observed is not. Positions and box have the layout of H5MD.
        """
        from . import store

        store.save(self, path)


def _restore(state: bytes, calls: list[Any], trace: list[Any]) -> System:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "state")
        file.write_bytes(state)
        made = System.from_checkpoint(file)
    made.calls, made.trace = calls, trace
    return made
