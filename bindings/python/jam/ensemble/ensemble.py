"""Packings of one protocol in a folder: making them, and reading what is there.

A file that is damaged is named by a DamagedWarning and by status(), and left out of all that is read.
"""
from __future__ import annotations

import os
import random
from concurrent.futures import Executor
from contextlib import suppress
from pathlib import Path
from typing import Any, Iterable, Iterator, Mapping

import numpy as np

from .._api.arrays import Array
from .._formats.replacing import remove_abandoned
from .._formats.shard import write_shard
from ..errors import StoreError
from .campaign import Campaign, progress_bar
from .capacity import Capacity, capacity, check_plan
from .entry import Entry
from .folder import Folder, builds_of
from .pool import LocalPool
from .protocol import ProtocolError, complete, identity, packing_name, to_json, whole_seed
from .status import Status, warn
from .tables import as_table


class Ensemble:
    """Packings of one protocol in a folder.

    Parameters
    ----------
    folder : path
        Made by run() where it is missing. Other protocols may live in it, and other campaigns may run in it.
    protocol : mapping or str, optional
        See jam.ensemble.complete; ``dict(n=128, dim=3)`` is enough. A str is the name of one of the folder, or its
        beginning; None: the only one of the folder.
    unverified : bool
        Also reads files without a seal, or with one that does not fit: of an older version, or changed by another
        program. Only for files of your own.
    """

    def __init__(
        self,
        folder: str | os.PathLike[str],
        protocol: Mapping[str, Any] | str | None = None,
        unverified: bool = False,
    ) -> None:
        self.files = Folder(folder, unverified)
        if protocol is None or isinstance(protocol, str):
            names = self.files.protocol_names()
            known = [k for k in names if k.startswith(protocol or "")]
            if len(known) != 1:
                asked = "" if protocol is None else f", {len(known)} of them begin with {protocol!r}"
                raise ProtocolError(
                    f"{folder} contains {len(names)} protocols ({', '.join(names) or 'none'}){asked}: give one, or its name"
                )
            protocol = self.files.protocol(known[0])  # as it was written: later options have their defaults in it
        else:
            protocol = complete(protocol)
        #: The protocol with every default spelled out
        self.protocol: dict[str, Any] = dict(protocol)
        #: Its name
        self.id = identity(self.protocol)

    def name(self, seed: int) -> str:
        """Name of the packing of a seed, with this version of libjam."""
        return packing_name(self.id, seed)

    # ---- making
    def run(
        self,
        seeds: Iterable[int],
        executor: Executor | None = None,
        progress: bool = True,
        retry: bool = False,
        workers: int | None = None,
        remake_damaged: bool = False,
    ) -> Status:
        """Makes the packings of these seeds that are not there yet.

        Parameters
        ----------
        seeds : iterable of int
            One packing each.
        executor : concurrent.futures.Executor, optional
            Default: a LocalPool of `workers` processes. For example mpi4py.futures.MPIPoolExecutor() or
            dask.distributed.Client(address).get_executor(). It stays open.
        progress : bool
            A bar by tqdm on a terminal.
        retry : bool
            Also those that failed before.
        remake_damaged : bool
            Also those whose file cannot be read: it is replaced. Without it such a file stays, and status() names it.

        Returns
        -------
        Status
            What is there of these seeds.

        Raises
        ------
        StoreError
            The folder cannot be written (read-only, disk full). Nothing that was finished is lost.
        """
        seeds = list(dict.fromkeys(map(whole_seed, seeds)))
        self.files.prepare()
        self.files.keep_protocol(self.id, to_json(self.protocol))
        done, failed = self.files.scan()
        names = {s: self.name(s) for s in seeds}
        left_out = self.files.rows({k: done[k] for k in names.values() if k in done})[1] if remake_damaged else {}
        todo = [
            s for s in seeds if (names[s] not in done and (retry or names[s] not in failed)) or names[s] in left_out
        ]
        random.shuffle(todo)  # two campaigns with the same seeds then share the work
        own = executor is None
        pool = LocalPool(workers) if executor is None else executor
        try:
            bar = progress_bar(progress, len(seeds), len(seeds) - len(todo))
            Campaign(self.files, self.protocol, pool, bar, remake_damaged).work(todo)
        except BaseException:
            if own:
                pool.shutdown(cancel_futures=True)  # packings under way are dropped, their workers killed
                with suppress(OSError):  # the error that ended the campaign is the one to report
                    remove_abandoned(self.files.parts)  # a worker may have been killed while it wrote
            raise
        if own:
            pool.shutdown()
        return self.status(seeds)

    def advise(self, wall_time: float = 3600.0, workers: int | None = None, seed: int = 1) -> Capacity:
        """How many packings of this protocol a time allows, from the seconds that those in the folder took.

        Where there is none, the packing of `seed` is made first; it stays in the folder.

        Parameters
        ----------
        wall_time : float
            Seconds; default one hour.
        workers : int, optional
            Default as of run: the number of cores that this process may use.
        seed : int
            Of the packing that is made where there is none.

        Raises
        ------
        ProtocolError
            This packing failed; the text says why.
        """
        count = check_plan(wall_time, workers)
        rows = self._rows()
        if not np.isfinite(rows["seconds_made"]).any():
            self.run([seed], progress=False, workers=1)
            rows = self._rows()
        rows, failures = rows[np.isfinite(rows["seconds_made"])], self.failures()
        if not len(rows):
            raise ProtocolError(f"there is no packing to measure, and that of seed {seed} failed: {failures[-1]['text']}")
        sizes = [self.files.packing(name.decode()).stat().st_size for name in rows["name"]]
        return capacity(rows, len(failures), sizes, wall_time, count)

    # ---- reading
    def status(self, seeds: Iterable[int] | None = None) -> Status:
        """What is there of the seeds; None: of all that were made or failed."""
        done, failed = self.files.scan()
        rows, left_out = self.files.rows(done)
        rows = rows[rows["protocol"] == self.id.encode()]
        if seeds is None:
            lost = sum(f["protocol"] == self.id for f in self.files.failures(failed))
            asked = len(rows) + lost + len(left_out)
        else:
            names = [self.name(s) for s in dict.fromkeys(map(whole_seed, seeds))]
            rows = rows[np.isin(rows["name"], np.array(names, "S32"))]
            left_out = {k: v for k, v in left_out.items() if k in set(names)}
            asked, lost = len(names), sum(n in failed for n in names)
        jammed = int((rows["jammed"] != 0).sum())
        return Status(asked, len(rows), jammed, lost, tuple(left_out.values()), builds_of(rows))

    def _rows(self) -> Array:
        rows = _readable(self.files)
        found: Array = rows[rows["protocol"] == self.id.encode()]
        return found

    def damaged(self) -> dict[Path, str]:
        """Files of the folder that cannot be read, of any protocol, and what is wrong with each."""
        return {self.files.packing(name): text for name, text in self.files.rows()[1].items()}

    def table(self, pandas: bool = False) -> Any:
        """Reports of all packings of this protocol, a row each, by seed.

        Returns
        -------
        numpy structured array, or pandas.DataFrame
            Fields: seed, name, protocol, version, commit and library (the build), n, dim, the fields of CrunchReport
            (enums as numbers, in a DataFrame as words), crystal_score, seconds_made, written. Without a crunch
            packing_fraction and diameter_mean are those of the packing, other numbers nan or -1. Files that cannot be read
            have no row.
        """
        return as_table(self._rows(), pandas)

    def failures(self) -> list[dict[str, Any]]:
        """Records of the seeds that failed: seed, status, text, machine, time.

        Records that cannot be read, of any protocol, come first: seed -1, status "damaged_record".
        """
        found: list[dict[str, Any]] = sorted(
            (f for f in self.files.failures() if f["protocol"] in (self.id, "")), key=lambda f: int(f["seed"])
        )
        return found

    def __len__(self) -> int:
        return len(self._rows())

    def __iter__(self) -> Iterator[Entry]:
        """Entries by seed."""
        for row in self._rows():
            yield Entry(row, self.files.packing(row["name"].decode()), self.files.unverified)

    def each(self, *names: str, jammed: bool = True, max_crystal_score: float = np.inf) -> Iterator[Any]:
        """Results of one packing after the other: an array for one name, a tuple for several.

        Parameters
        ----------
        names : str
            Stored attributes of Entry: "forces", "gaps", "gap_pairs", "coordination", "positions", "contacts", ...
        jammed : bool
            Only packings with a certificate.
        max_crystal_score : float
            Omits packings with more order (1 to 2 is usual for equal spheres).
        """
        for entry in self:
            if (jammed and not entry.row["jammed"]) or entry.row["crystal_score"] > max_crystal_score:
                continue
            try:
                found = entry.read(*names)
            except StoreError as error:
                warn([str(error.strerror)])
                continue
            yield found[0] if len(names) == 1 else found

    def export(self, folder: str | os.PathLike[str], per_shard: int = 1000) -> list[Path]:
        """Packs the packings into HDF5 files of `per_shard` each, a group a packing; jam.load(path, name) reads one.

        Returns
        -------
        list of Path
            The shards, in the order of seeds.
        """
        target = Path(folder)
        target.mkdir(parents=True, exist_ok=True)
        rows, made = self._rows(), []
        for k in range(0, len(rows), per_shard):
            names = [name.decode() for name in rows["name"][k : k + per_shard]]
            path = target / f"{self.id}-{k // per_shard:05d}.h5"
            left_out = write_shard(path, to_json(self.protocol), {n: self.files.packing(n) for n in names})
            warn(left_out)
            made.append(path)
        return made


def _readable(files: Folder) -> Array:
    """Rows of the files that can be read; a warning names the others."""
    rows, left_out = files.rows()
    warn(left_out.values())
    return rows


def protocols(folder: str | os.PathLike[str]) -> dict[str, dict[str, Any]]:
    """The protocols of a folder by name; Ensemble(folder, name) opens one."""
    files = Folder(folder)
    return {name: files.protocol(name) for name in files.protocol_names()}


def table(
    folder: str | os.PathLike[str], pandas: bool = False, unverified: bool = False, options: bool = False
) -> Any:
    """Reports of all packings of a folder, of every protocol: the table of Ensemble, whose column `protocol` names it.

    options: a DataFrame that also has a column for each option that one of the protocols sets otherwise than the library
    does by itself, such as start.n or stages.0.growth_rate.
    """
    files = Folder(folder, unverified)
    known = {name: files.protocol(name) for name in files.protocol_names()} if options else None
    return as_table(_readable(files), pandas or options, known)
