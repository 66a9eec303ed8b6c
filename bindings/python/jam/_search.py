"""python3 -m jam search DIR: the largest sum of radii from many starts, its best packings as files, each with its proof."""
from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import Any

import numpy as np

from ._api.command import DONE, OUTPUT, PARTIAL, REFUSED, Parser, json_answer, printed, refuse
from .digits import FEWEST_DIGITS
from .ensemble.pool import WorkerDied
from .errors import JamError
from .radii import SAME, Best, Search, best_of, prove
from .system import System

SCENE = ("walls", "container", "box")
CLOSER = 1e-9  # room of maximise_radii that finds the contacts of a best packing again


def parser() -> Parser:
    p = Parser(
        prog="python3 -m jam search",
        description="Searches the largest sum of radii of N spheres from many random starts. DIR keeps the search, which the same "
        "command line continues, and the best packings as best-1.xyz, best-2.xyz, ...",
        epilog="Example: python3 -m jam search disks --n 26 --walls xy --seconds 600 --prove 40. Exit status: 0 found; 1 no maximum "
        "found, a proof failed or interrupted; 2 wrong command line; 3 scene or DIR refused; 4 DIR cannot be written.",
    )
    p.add_argument("folder", metavar="DIR")
    p.add_argument("--n", type=int, required=True, help="spheres")
    p.add_argument("--dim", type=int, default=2, help="dimension (2)")
    p.add_argument("--walls", metavar="x|y|xy|..", help="flat walls at both ends of these axes (none)")
    p.add_argument("--container", choices=("cylinder", "ball"), help="round container; its diameter is the edge of the cell")
    p.add_argument("--box", type=float, help="edge of the cell (1)")
    p.add_argument("--radius-min", type=float, default=0.0, metavar="R", help="bound of all radii (0)")
    p.add_argument("--radius-max", type=float, metavar="R", help="bound of all radii (none)")
    p.add_argument("--strain", choices=("none", "edges", "tilts", "free"), default="none", help="the cell deforms too, at fixed volume (none)")
    p.add_argument("--starts", type=int, metavar="K", help="how many starts in all, with those that DIR has")
    p.add_argument("--seconds", type=float, metavar="S", help="no start begins later")
    p.add_argument("--until", type=float, metavar="V", help="ends when a sum is at least V")
    p.add_argument("--seed", type=int, default=1, help="start k of a seed always ends at the same packing (1)")
    p.add_argument("--keep", type=int, default=10, metavar="K", help="packings of different sums to keep, no fewer than DIR has (10)")
    p.add_argument("--workers", type=int, metavar="W", help="processes (all cores)")
    p.add_argument("--prove", type=int, metavar="DIGITS", help="prove each of them to so many digits: best-1.jamproof, ...")
    p.add_argument("--json", action="store_true", help="the table as one JSON object")
    return p


def _is_in(packing: System, path: str) -> bool:
    """Whether a file of an earlier run has this packing."""
    try:
        old = System.read(path)
    except (JamError, OSError):
        return False
    return np.array_equal(old.positions, packing.positions) and np.array_equal(old.diameters, packing.diameters)


def _write(o: argparse.Namespace, best: Best, rank: int, scene: dict[str, Any]) -> dict[str, Any]:
    """The row of one packing; its files are written."""
    where: dict[str, Any] = {**scene, "box": None, "cell": best.cell}
    packing = System.from_arrays(best.positions, radii=best.radii, **where)
    bounds = {"radius_min": o.radius_min, **({} if o.radius_max is None else {"radius_max": o.radius_max})}
    again = packing.maximise_radii(room=CLOSER, strain=o.strain, **bounds)
    name = os.path.join(o.folder, f"best-{rank}")
    row: dict[str, Any] = {"rank": rank, "value": repr(best.value), "start": best.start, "file": name + ".xyz"}
    proof = Path(name + ".jamproof")
    if not _is_in(packing, name + ".xyz"):
        proof.unlink(missing_ok=True)  # of another packing, which was best before
    packing.write(name + ".xyz")
    if not again.maximum or abs(again.value / best.value - 1) > SAME:
        row["not_proved"] = f"its maximum was not found again: the file has the sum {again.value!r}"
    elif o.prove is not None:
        try:
            proved = prove(packing, o.prove, path=proof)
            row |= {"value": str(proved.value), "value_radius": float(proved.value_radius), "proof": str(proof)}
        except JamError as error:
            row |= {"value_radius": None, "not_proved": str(error)}
    return row


def _show(found: Search, rows: list[dict[str, Any]]) -> None:
    print(f"{found.starts} starts, {found.maxima} maxima, {found.seconds:.0f} s")
    for row in rows:
        proved = row.get("value_radius")
        said = f", proved to {proved:.0e}" if proved is not None else f", not proved: {row['not_proved']}" if "not_proved" in row else ""
        print(f"{row['rank']:3d}  {row['value']}  start {row['start']}  {row['file']}{said}")


@printed
def main(arguments: list[str] | None = None) -> int:
    """Returns the exit status."""
    p = parser()
    o = p.parse(arguments)
    if o.starts is None and o.seconds is None and o.until is None:
        p.error("give --starts, --seconds or --until: the search has no end without them")
    if o.prove is not None and o.prove < FEWEST_DIGITS:
        p.error(f"--prove {o.prove}: it must be {FEWEST_DIGITS} or more")
    if o.prove is not None and o.strain != "none":
        p.error("--prove contradicts --strain: only maxima of fixed cells have a proof")
    old = next(Path(o.folder).glob("best-*.xyz"), None)
    if old and not Path(o.folder, "search.json").exists():
        return refuse(REFUSED, f"{old} is of a search whose search.json is not there: move it away, or take another folder", o.json)
    scene = {name: getattr(o, name) for name in SCENE if getattr(o, name) is not None}
    given = {name: getattr(o, name) for name in ("starts", "seconds", "until", "workers", "folder", "seed", "keep", "radius_min", "radius_max", "strain")}
    try:
        found = best_of(o.n, o.dim, **given, **scene)
        rows = [_write(o, best, rank, scene) for rank, best in enumerate(found.best, 1)]
    except KeyboardInterrupt:
        return refuse(PARTIAL, f"interrupted; what was found is in {o.folder}: the same command line continues", o.json)
    except WorkerDied as error:
        return refuse(PARTIAL, f"{error}. What was found is kept: the same command line continues", o.json)
    except OSError as error:
        return refuse(OUTPUT, str(error), o.json)
    except (ValueError, JamError) as error:
        return refuse(REFUSED, str(error), o.json)
    code = DONE if rows and all("not_proved" not in row for row in rows) else PARTIAL
    if o.json:
        text = "" if rows else "no start ended at a maximum"
        print(json_answer(code, text, starts=found.starts, maxima=found.maxima, seconds=found.seconds, best=rows))
    else:
        _show(found, rows)
    return code
