"""The proof checker of the browser says what jamproof.py says: of proved packings of every kind, and of changed files."""
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import unittest

import numpy as np
import test_proof_round
from compiled import compiled
from test_proof import ROOT, file_of, jamproof, packing
from test_proof_bounds import fcc, square_lattice
from test_proof_checker import flower
from test_proof_strict import angles_of_tiles_in_a_free_cell, packed
from test_proof_walls import SCENES, isostatic

import jam
from packings import InFolder

NODE = shutil.which("node")
PROGRAM, LIBRARY = pathlib.Path(__file__).with_name("check_proofs.mjs"), ROOT / "bindings/js/lab/proof/check.mjs"
SET = sorted((ROOT / "examples/studies/reference_set").glob("*.jamproof"))
MUTANTS = int(os.environ.get("JAM_MUTANTS", "60"))
# Words about damage that other libraries find: of base64, zlib, and numbers that no file of libjam has.
FOREIGN = "cannot be read: (?!'ascii'|the |a |no |unknown |non_add|an |'[^ ]*' is )"


def answers(paths):
    """Of JavaScript: status, text, summary."""
    told = subprocess.run([NODE, PROGRAM, LIBRARY.as_uri()], input="\n".join(map(str, paths)), text=True, check=True, capture_output=True)
    return [tuple(json.loads(line).values()) for line in told.stdout.splitlines()]


def expected(path, out):
    """Of Python, and the file with its inverse."""
    try:
        scene = jamproof.Scene(path)
    except (OSError, ValueError, LookupError, TypeError, OverflowError, MemoryError, jamproof.zlib.error) as error:
        return 2, f"cannot be read: {error}", ""
    status, text = jamproof.conclusion(scene)
    jamproof.complete(scene, out)
    return status, text, jamproof.summary(scene)


def without_delta(answer):
    """An inverse that each makes for itself is another one in its last digits, and delta with it."""
    status, text, summary = answer
    return status, re.sub("(delta|left|4 a0 a2|4 beta eta|inner|outer|radius|gamma_error|force_error) [0-9.e+-]+", r"\1", text), summary


def one_digit(words, r):
    at = r.randrange(1, len(words))
    spots = [k for k, c in enumerate(words[at]) if c.isdigit()]
    if spots:
        k = r.choice(spots)
        words[at] = words[at][:k] + r.choice("0123456789") + words[at][k + 1 :]


def exponent(words, r):
    at = r.randrange(1, len(words))
    words[at] = re.sub("p(-?[0-9]+)", lambda m: f"p{int(m[1]) + r.choice((-1, 1, 3))}", words[at])


def sign(words, r):
    at = r.randrange(1, len(words))
    words[at] = words[at][1:] if words[at].startswith("-") else "-" + words[at]


def swap(words, r):
    a, b = r.randrange(1, len(words)), r.randrange(1, len(words))
    words[a], words[b] = words[b], words[a]


def shorter(words, r):
    del words[r.randrange(len(words))]


def odd(words, r):
    words[r.randrange(len(words))] = r.choice(["1", "+1", "01", "x", "1p", "p2", "0p0", "1p-30", "7p2,", "1p20000", "\u00e9"])


def coarse(words, r):
    """Sixteen digits instead of thirty-two."""
    words[1:] = [word.split(",")[0] for word in words[1:]]


def mutant(text, r):
    lines, change = text.splitlines(), r.randrange(9)
    of = [k for k, line in enumerate(lines) if r.random() < 0.1 or not line.startswith(("sphere", "contact"))] or [1]
    at = r.choice(of[1:] or of)
    if change == 7:
        del lines[at]
    elif change == 8:
        lines.insert(at, lines[at])
    else:
        words = lines[at].split(" ")
        (one_digit, exponent, sign, swap, shorter, odd, coarse)[change](words, r) if len(words) > 1 else shorter(words, r)
        lines[at] = " ".join(words)
    return "\n".join(lines) + "\n"


def made():
    """Kinds that the set has not: strict, with implied contacts, and crystals that close exactly."""
    systems = (packed(32, 2, seed) for seed in range(1, 60))
    exact = next(s for s in systems if s.report.jammed and s.prove(strict=True).theorem == jam.Theorem.EXACT)
    scenes = {**SCENES, **test_proof_round.SCENES}
    between = [file_of(*isostatic(scenes[name], (1, 2, 3))[0]) for name in ("box", "slit", "circle", "ball", "can")]
    between.append(file_of(test_proof_round.ring(6, loose=1), np.ones(7)))  # trapped
    return [file_of(exact, strict=True), flower(), "\n".join(fcc()) + "\n", square_lattice(), angles_of_tiles_in_a_free_cell(), *between]


@unittest.skipUnless(NODE, "node is not installed")
class TwoCheckers(InFolder):
    def compare(self, paths, plain=lambda answer: answer):
        outs = [self.folder / f"{k}.jamproof" for k, _ in enumerate(paths)]
        for path, out, found in zip(paths, outs, answers(paths)):
            wanted = expected(path, out)
            with self.subTest(path=str(path)):
                hinted = re.search("^inverse", path.read_text("utf-8"), re.M)
                if re.match(FOREIGN, wanted[1]) or wanted[0] == 1 and not hinted:
                    self.assertEqual(found[0], wanted[0])  # why a matrix without an inverse is refused, rounding decides
                else:
                    self.assertEqual(plain(found), plain(wanted))
        return [out for out in outs if out.exists()]

    def test_sums_of_radii_are_refused_by_name(self):
        path = self.folder / "sum.jamproof"
        path.write_bytes(pathlib.Path(__file__).with_name("sum26.jamproof").read_bytes())
        ((status, text, _),) = answers([path])
        self.assertEqual((status, text), (2, "cannot be read: files with 'sum', of a largest sum of radii, need jamproof.py"))

    def test_the_reference_set(self):
        """With inverses of their own but for digits, with one inverse to every digit."""
        some = SET if MUTANTS > 60 else SET[:1]
        for dim in compiled(4):
            some = [*some, self.folder / "d4"]
            some[-1].write_text(file_of(*packing(64, dim, 1)), encoding="ascii")
        completed = self.compare(some, without_delta)
        self.assertEqual(len(completed), len(some))
        self.compare(completed)

    def test_other_kinds_and_changed_files(self):
        r, sources = random.Random(1), made()
        sources += [path.read_text(encoding="ascii") for path in SET if "d2" in path.name or "d3" in path.name][::4]
        for k, text in enumerate(sources):
            (self.folder / f"source{k}").write_text(text, encoding="ascii")
        completed = self.compare([self.folder / f"source{k}" for k, _ in enumerate(sources)], without_delta)
        self.assertEqual(len(completed), len(sources))
        texts, changed = [path.read_text(encoding="ascii") for path in completed], []
        inverse = re.search("^inverse.*\n", texts[0], re.M)[0]
        for k, text in enumerate((texts[0].replace("\n", "\n\n", 1), texts[0] + "\n", texts[0] + "strict\n", texts[0] + inverse)):
            changed.append(self.folder / f"twice{k}")
            changed[-1].write_text(text, encoding="ascii")
        for k in range(MUTANTS):
            changed.append(self.folder / f"mutant{k}")
            changed[-1].write_text(mutant(texts[k % len(texts)], r), encoding="utf-8")
        self.compare(changed)
