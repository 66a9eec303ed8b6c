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
from compiled import compiled
from proof_files import ROOT, apart, file_of, jamproof
from test_proof import packing
from test_proof_bounds import fcc, square_lattice
from test_proof_checker import flower
from test_proof_strict import angles_of_tiles_in_a_free_cell, packed
from test_proof_walls import SCENES, isostatic, ring

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


def mutant(text, r):
    """One line of a file changed: a digit, an exponent, a word, the order of two, a word less, half of the digits; a line less or twice."""
    lines = text.splitlines()
    of = [k for k, line in enumerate(lines) if r.random() < 0.1 or not line.startswith(("sphere", "contact"))] or [1]
    at, change = r.choice(of[1:] or of), r.randrange(8)
    words = lines[at].split(" ")
    k = r.randrange(len(words))
    if change == 0:
        words[k] = re.sub("[0-9]", lambda m: r.choice("0123456789") if r.random() < 0.3 else m[0], words[k])
    elif change == 1:
        words[k] = re.sub("p(-?[0-9]+)", lambda m: f"p{int(m[1]) + r.choice((-1, 1, 3))}", words[k])
    elif change == 2:
        words[k] = r.choice(["1", "+1", "01", "x", "1p", "p2", "0p0", "1p-30", "7p2,", "1p20000", "\u00e9", "-" + words[k], words[k][1:]])
    elif change == 3:
        other = r.randrange(len(words))
        words[k], words[other] = words[other], words[k]
    elif change == 4:
        del words[k]
    elif change == 5:  # sixteen digits instead of thirty-two
        words[1:] = [word.split(",")[0] for word in words[1:]]
    lines[at : at + 1] = [] if change == 6 else [" ".join(words)] * (2 if change == 7 else 1)
    return "\n".join(lines) + "\n"


def made():
    """Kinds that the set has not: strict, with implied contacts, and crystals that close exactly."""
    systems = (packed(32, 2, seed) for seed in range(1, 60))
    exact = next(s for s in systems if s.report.jammed and s.prove(strict=True).theorem == jam.Theorem.EXACT)
    between = [file_of(*isostatic(SCENES[name], (1, 2, 3))[0]) for name in ("box", "slit", "circle", "ball", "can")]
    between.append(file_of(ring(6, loose=1), np.ones(7)))  # trapped
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
        for k, text in enumerate(text for text in texts if "\nround " in text):
            changed.append(self.folder / f"apart{k}")
            changed[-1].write_text(apart(text), encoding="ascii")
        for k in range(MUTANTS):
            changed.append(self.folder / f"mutant{k}")
            changed[-1].write_text(mutant(texts[k % len(texts)], r), encoding="utf-8")
        self.compare(changed)
