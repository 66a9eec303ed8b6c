"""The system of spheres: a thin, native-feeling layer over the C handle."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from ._api.shown import only
from . import errors, raw
from ._api.arrays import as_vector
from ._api.calls import freeze
from ._api.errors import METHODS
from ._api.given import cell_of, enclosure_of, layout_of, positions_of, refuse_start_options, refuse_unnamed_box, sizes_of
from ._api.options import option_struct, other_word
from ._api.results import Contacts, Modes
from ._api.size_laws import density_of
from ._formats import frames, gsd
from ._system.converting import Converting
from ._system.copies import Copies
from ._system.passing_file import passing_file
from ._system.pore_space import PoreSpace
from ._system.progress import end, reporter
from ._system.verbs import Verbs
from ._system.writing import Writing

__all__ = ["Contacts", "Modes", "System"]
__dir__ = only(__all__)


class System(Verbs, Writing, PoreSpace, Copies, Converting):
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

    if not TYPE_CHECKING:  # a checker of types knows all names without it

        def __getattr__(self, name: str) -> Any:
            if hasattr(type(self), name):  # a property has raised AttributeError: it is raised again
                return object.__getattribute__(self, name)
            word = other_word(name, dir(type(self)))
            raise AttributeError(f"a System has no attribute {name!r}" + (f"; did you mean {word}?" if word else ""))

    # ---- making
    @classmethod
    def random(
        cls,
        n: int | None = None,
        dim: int = 3,
        seed: int = 1,
        *,
        packing_fraction: float | None = None,
        porosity: float | None = None,
        diameters: Any = None,
        progress: Any = None,
        **options: Any,
    ) -> "System":
        """Random sequential start: spheres are placed one by one where they do not overlap.

        With overlap='allow' they are independent uniform points, for soft spheres.

        Parameters
        ----------
        n : int, optional
            Number of spheres. Default: that of the diameters, 1024 without any.
        dim : int
            Dimension, 2 to 8.
        seed : int
            Seed of every random stream of this system.
        packing_fraction : float, optional
            Of the start. Default: 0.2, halved for each dimension above 3. Denser packings than random addition makes
            are grown by `compress`, which takes a packing_fraction or porosity too.
        porosity : float, optional
            Instead: the void fraction of the start, 1 - packing_fraction.
        diameters : array_like, optional
            n values, for example of jam.sizes; only their ratios count. Default: all equal.
        progress : bool or callable, optional
            As of `compress`. A true answer of the callable ends the call with StoppedError, as wall_time does.
        **options
            box or cell as of `from_arrays`, walls and container as there, model ('euclid' or 'mk'), mk_zeta, masses,
            non_additivity, wall_time, memory_limit.

        Examples
        --------
        >>> import jam
        >>> jam.System.random(n=100, dim=2, seed=7)
        System(n=100, dim=2, packing_fraction=0.2, box=1, seed=7)
        """
        sizes = None if diameters is None else as_vector(diameters, name="diameters")
        packing_fraction = density_of(packing_fraction, porosity)
        if packing_fraction is None:
            packing_fraction = 0.0  # the library's own, by dimension
        if n is None:
            n = 1024 if sizes is None else len(sizes)
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
            Confirms d. Without it a last column that equals the sizes is refused: most such arrays are x, y, z, r.
        **options
            overlap ('refuse', the default, 'shrink': scales all diameters until no pair overlaps, or 'allow': soft
            spheres), seed, model, mk_zeta, masses, non_additivity, wall_time, memory_limit.
            walls: axes with flat walls at 0 and at the edge of the cell, as truth values (False, False, True) or as
            letters "z". container: a member of Container in small letters, such as 'cylinder' (about z; walls="z"
            closes its ends). It touches the faces of the cell. Nothing repeats across a wall.

        Examples
        --------
        >>> import jam
        >>> jam.System.from_arrays([[1.0, 1.0], [3.0, 3.0]], radii=0.5, box=4.0).diameters
        array([1., 1.])
        """
        x = positions_of(positions, diameters, radii, dim)
        sizes = sizes_of(diameters, radii, len(x))
        refuse_start_options(options, ("packing_fraction",), "the diameters are given")
        if options.get("n") not in (None, len(x)):
            raise ValueError(f"n is {options['n']}, and there are {len(x)} positions")
        if box is None and cell is None:
            refuse_unnamed_box(x)
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
            overlap ('refuse' or 'shrink'), seed, model, mk_zeta, masses, non_additivity, frame; box, or cell as of
            from_arrays, where the file names none; origin, (d,), where the corner of the cell is in a file that does not
            say it; columns, names of what the columns of a table contain, in order: x, y, z (or x1, x2, ...), radius or
            diameter, others are not read; walls and container, as of from_arrays, where the file does not name its
            walls. GSD files take the keywords of jam.files.read_gsd too.

        Examples
        --------
        >>> import jam
        >>> with open("grains.csv", "w") as file:
        ...     _ = file.write("x,y,z,mass,r\\n0,0,3,1,0.5\\n1,1,-3,1,0.5\\n")
        >>> jam.System.read("grains.csv", cell=[4, 4, 8], origin=[-2, -2, -4]).cell.diagonal()
        array([4., 4., 8.])
        """
        name = os.fsdecode(path)
        if gsd.is_name(name):
            given = {key: value for key, value in options.items() if value is not None}
            return cls._noted(*gsd.arguments(name, **given))
        for unknown in ("diameters", "radii"):
            if unknown in options:
                raise TypeError(
                    f"{unknown}= goes with GSD files and jam.files.read_ase alone: "
                    "read other files without sizes by numpy, and pass the arrays to System.from_arrays"
                )
        walls = options.get("walls")
        layout = layout_of(options)
        options["container"], options["walls"] = enclosure_of(options.get("container"), walls, None)
        made = cls._made(*raw.jam_read(name, layout, option_struct("jam_create_options", options), None))
        if walls is not None and not isinstance(walls, str):
            enclosure_of(None, walls, made.dim)  # as many truth values as the file has axes
        return made

    @classmethod
    def from_checkpoint(cls, path: str | os.PathLike[str]) -> "System":
        """Reads a file of `write_checkpoint`. The dynamics continue to the same bits as if they had never stopped."""
        return cls._made(*raw.jam_read_checkpoint(os.fspath(path), None))

    @classmethod
    def from_ase(
        cls, atoms: Any, diameters: Any = None, *, radii: Any = None, dim: int = 3, **options: Any
    ) -> "System":
        """The spheres of an ase.Atoms, periodic in all directions without walls; `to_ase` is the way back.

        Parameters
        ----------
        atoms : ase.Atoms
            With an array `radius` or `diameter`, unless sizes are given here.
        diameters, radii : array_like, optional
            One for all or one for each sphere.
        dim : int
            2 takes a plane z = const, periodic in x and y.
        **options
            As of `from_arrays`.
        """
        notes: list[str] = []
        given = frames.of_atoms(atoms, diameters, options, radii=radii, dim=dim, notes=notes, where="atoms")
        return cls._noted(given, notes)

    @classmethod
    def _noted(cls, arguments: dict[str, Any], notes: list[str]) -> "System":
        """from_arrays, with what a reader changed or assumed on the way in `notes`."""
        made = cls.from_arrays(**arguments)
        for note in notes:
            raw.jam_add_note(made.handle, note)
        return made

    @classmethod
    def _made(cls, status: int, handle: Any) -> "System":
        if status != 0:
            raise errors.StoppedError(f"no system was made: {raw.jam_last_error()}")
        return cls(handle)

    @classmethod
    def _create(cls, options: dict[str, Any], positions: Any, diameters: Any, progress: Any = None) -> "System":
        box, vectors = cell_of(options.pop("box", None), options.pop("cell", None), options["dim"])
        container, walls = enclosure_of(options.pop("container", None), options.pop("walls", None), options["dim"])
        beside = ("diameters", "cell") if positions is None else ("diameters", "radii", "cell")
        made = option_struct("jam_create_options", dict(options, box=box, container=container, walls=walls), beside)
        told = reporter(progress)

        def on_progress(p: Any) -> bool:
            return bool(told(freeze(p, "jam_progress"))) if told else False

        try:
            flat = None if vectors is None else vectors.reshape(-1)
            answer = raw.jam_create(made, positions, diameters, flat, told and on_progress)
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
        """Deep copy with results and what was observed. It has the same seed, so set velocities to make its dynamics differ.

        In a progress callable it is the packing that the callable sees in `positions`: that before the call, or the snapshot.
        """
        made = System._made(*raw.jam_copy(self.handle))
        made.trace, made.calls = list(self.trace), [dict(call) for call in self.calls]
        return made

    __copy__ = copy

    def __deepcopy__(self, memo: dict[str, Any]) -> "System":
        return self.copy()

    def __reduce__(self) -> tuple[Any, ...]:
        return restore, (self._state(), [dict(call) for call in self.calls], list(self.trace))

    def __repr__(self) -> str:
        if self._handle is None:
            return "System(closed)"
        i = self.info
        return f"System(n={i.n}, dim={i.dim}, packing_fraction={i.packing_fraction:.8g}, box={i.box:g}, seed={i.seed})"

    def __len__(self) -> int:
        return self.n


def restore(state: bytes, calls: list[Any], trace: list[Any]) -> System:
    """A system from the bytes of a checkpoint."""
    with passing_file() as file:
        file.write_bytes(state)
        made = System.from_checkpoint(file)
    made.calls, made.trace = calls, trace
    return made


METHODS.update(name for name in dir(System) if callable(getattr(System, name)))
