"""One option of jam-pack, and the defaults that it takes from the library's source.

Kinds: what a value may be and where it goes.
    switch        0 or 1
    integer       within low .. high
    positive      a finite number > 0, within low .. high where these are given
    not_negative  a finite number >= 0, likewise
    pressure      a finite number > 1, that of an ideal gas
    delta         a number above -1 and at most 1
    choice        one of `words`; its number counts, as in the enum of jam.h
    text          any text
    input         the name of a file that is read
    output        the name of a file that is written; `after_crunch` marks those that show its network
    stage         RATE[:P], repeatable
    fraction      a number above 0 and below 1
    sizes         a law of jam_parse_diameters, or a file of diameters
    cell          d or d d numbers, parted by commas
    copies        d whole numbers above 0, parted by commas
"""
import re
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Option:
    name: str  # without the dashes
    kind: str
    metavar: str
    help: str
    default: object = None
    low: float = 0
    high: float = 0
    words: tuple = ()
    host: bool = False  # of python3 -m jam alone
    after_crunch: bool = False
    stdout: bool = False  # "-" is standard output
    gzip: bool = False  # compressed where the name ends in .gz
    without: tuple = ()  # beside one of these it would have no effect: refused
    needs: tuple = ()  # without any of these it would have no effect: refused

    @property
    def field(self):
        return self.name.replace("-", "_")


@dataclass(frozen=True)
class Verb:
    """The first word of a command line."""

    name: str
    files: tuple  # options that words without dashes stand for, in order
    help: str
    takes: object  # names of its options, parted by blanks; None: all but those of other verbs alone

    @property
    def usage(self):
        words = {"input": "FILE", "output": "[OUTPUT]", "page": "OUTPUT.html"}
        files = "[FILE]" if self.name == "compress" else " ".join(words[f] for f in self.files)
        return f"{self.name} {files}".rstrip()


def usage(o):
    """As the help writes it: --name VALUE."""
    value = "|".join(o.words) or o.metavar
    return f"--{o.name} {value}".rstrip()


INT32_MAX, INT64_MAX = 2**31 - 1, 2**63 - 1


def growth_stages():
    """Growth by default, from the source of the library: rate and pressure of each stage."""
    folder = Path(__file__).resolve().parents[2] / "src/dynamics"
    text = "\n".join(path.read_text() for path in sorted(folder.rglob("*.cpp")) + sorted(folder.rglob("*.hpp")))
    number = r"([\d.e+-]+)"
    found = re.findall(rf"first_rate = {number}, first_pressure = {number}, last_rate = {number};", text)
    last = re.findall(rf"default_compress_options\(\) {{.*?o\.pressure = {number};", text, re.S)
    if len(found) != 1 or len(last) != 1:
        raise ValueError("src/dynamics names the stages of growth by default no more, or twice")
    first_rate, first_pressure, last_rate = map(float, found[0])
    return ((first_rate, first_pressure), (last_rate, float(last[0])))


def start_fraction():
    """(packing fraction of a random start, dimension above which it is halved each time), from the library's source."""
    text = (Path(__file__).resolve().parents[2] / "src/core/tuning.hpp").read_text()
    found = re.findall(r"halved for each dimension above (\d)\nconstexpr double start_fraction_3d = ([\d.]+);", text)
    if len(found) != 1:
        raise ValueError("src/core/tuning.hpp names the packing fraction of a start no more, or twice")
    return float(found[0][1]), int(found[0][0])


STAGES, START = growth_stages(), start_fraction()
