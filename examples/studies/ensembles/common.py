"""What the studies on ensembles share: arguments, ensembles, and the table of published value, ours, error and sigma."""
from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from typing import Callable

import numpy as np

import jam

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parents[2] / "bindings/docs"))
import figures  # noqa: E402  # machine, commit and date of a result

G_OF_KAPPA = 2 * 3**0.5  # growth rate of the diameter over the radius rate of the thesis
THETA_E, GAMMA, THETA_L = 0.42311, 0.41269, 0.17462  # mean field; theta_l is empirical


def arguments(text: str) -> argparse.ArgumentParser:
    """--large, --folder, --workers, --only-read, --out, --update."""
    p = argparse.ArgumentParser(description=text)
    p.add_argument("--large", action="store_true", help="the real thing: hours; a run that was killed goes on")
    p.add_argument("--folder", default="packings", help="where the packings are kept (packings)")
    p.add_argument("--workers", type=int, help="processes (all cores)")
    p.add_argument("--only-read", action="store_true", help="make no packing: what is there is analysed")
    p.add_argument("--out", type=Path, default=Path("studies"), help="folder of results.json and pictures/ (studies)")
    p.add_argument("--update", dest="out", action="store_const", const=HERE, help="write them into the checkout, which the pages show")
    return p


def options(text: str, **numbers: tuple[int, int]) -> argparse.Namespace:
    """The arguments of a study. numbers: its own whole numbers, each with the small and the large default: n=(256, 1024)."""
    p = arguments(text)
    for name, (small, large) in numbers.items():
        p.add_argument(f"--{name}", type=int, help=f"small {small}, large {large}")
    o = p.parse_args()
    for name, defaults in numbers.items():
        setattr(o, name, getattr(o, name) or defaults[o.large])
    return o


def ensemble(o: argparse.Namespace, protocol: dict, seeds: int) -> jam.ensemble.Ensemble:
    """The ensemble of a protocol, made where it is not there yet."""
    made = jam.ensemble.Ensemble(o.folder, protocol)
    if not o.only_read:
        print(f"{made.id}: {made.run(range(1, seeds + 1), workers=o.workers)}", flush=True)
    return made


def kept(o: argparse.Namespace, study: str, key: str, make: Callable[[], dict]) -> dict | None:
    """Arrays by name, from FOLDER/studies/STUDY/KEY.npz where it is there; else make() is called and its result kept.

    For runs that are no packings: a study that was killed continues. None with --only-read where nothing is there.
    """
    path = Path(o.folder) / "studies" / study / f"{key}.npz"
    if not path.exists():
        if o.only_read:
            return None
        path.parent.mkdir(parents=True, exist_ok=True)
        part = path.with_name(f"{key}.{os.getpid()}.part.npz")
        np.savez(part, **make())
        os.replace(part, path)
        print(f"{study}: {key}", flush=True)
    with np.load(path) as there:
        return dict(there)


def seeded(o: argparse.Namespace, study: str, key: str, seeds: int, make: Callable[[int], dict]) -> list[dict]:
    """kept() of make(1), make(2) ... make(seeds), under KEYseed1 and so on; without those that are not there."""
    made = (kept(o, study, f"{key}seed{s}", lambda: make(s)) for s in range(1, seeds + 1))
    return [m for m in made if m is not None]


def command(words: list[str]) -> str:
    """What makes the same numbers: the command line without folders, --workers and --only-read."""
    made, skip = [Path(words[0]).name], False
    for word in words[1:]:
        name = word.split("=")[0]
        if not skip and name not in ("--only-read", "--update", "--folder", "--out", "--workers"):
            made.append(word)
        skip = not skip and word in ("--folder", "--out", "--workers")
    return " ".join(made)


def shown(path: str, rows: list[list]) -> list[list]:
    """The rows that the checkout has, made anew: pages refer to them by number. Without the study in the file all rows are stored."""
    try:
        there = figures.load(path)["rows"]
    except (FileNotFoundError, KeyError):
        return rows
    anew = {tuple(row[:2]): row for row in rows}
    gone = [row[1] for row in there if tuple(row[:2]) not in anew]
    if gone:
        raise SystemExit(f"{path} has rows that this run did not make; take the study out to store others: {'; '.join(gone)}")
    return [anew[tuple(row[:2])] for row in there]


class Results:
    """Rows (figure, quantity, published, ours, error, sigma between) of one study."""

    def __init__(self, o: argparse.Namespace, name: str) -> None:
        self.out, self.name, self.rows = o.out, name, []

    def add(
        self, figure: str, quantity: str, published: float | str | tuple[str, float], ours: float, error: float = np.nan
    ) -> None:
        """published: a number of the thesis, a text, or (whose value it is, value) where the thesis has none."""
        value = published[1] if isinstance(published, tuple) else published
        published = f"{published[0]}: {published[1]:g}" if isinstance(published, tuple) else published
        known = isinstance(value, (int, float)) and np.isfinite(error) and error > 0
        sigma = round(abs(float(ours) - float(value)) / float(error), 1) if known else None
        self.rows.append([figure, quantity, published, float(ours), float(error) if np.isfinite(error) else None, sigma])
        print(f"{figure:8} {quantity:58} {published!s:>12} {ours:12.5g} {error:10.2g}  {sigma}", flush=True)

    def picture(self, figure, name: str | None = None, dpi: int = 64) -> None:
        """pictures/<name>.png, by default named after the study."""
        (self.out / "pictures").mkdir(parents=True, exist_ok=True)
        figure.tight_layout()
        figure.savefig(self.out / "pictures" / f"{name or self.name}.png", dpi=dpi)

    def write(self, figure=None) -> None:
        """results.json#<name>, and the picture of the study."""
        self.out.mkdir(parents=True, exist_ok=True)
        path = f"{self.out}/results.json#{self.name}"
        rows = shown(path, self.rows) if self.out == HERE else self.rows
        figures.save(path, command(sys.argv), figures.STORED, rows)
        if figure is not None:
            self.picture(figure, dpi=80)


def mean_error(values: np.ndarray) -> tuple[float, float]:
    """Mean and its standard error."""
    return float(np.mean(values)), float(np.std(values, ddof=1) / np.sqrt(len(values)))
