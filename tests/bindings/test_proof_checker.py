"""The checker as a program: its files, what it reads and refuses, and what it prints."""
import base64
import gzip
import math
import os
import random
import re
import shutil
import subprocess
import sys
import zlib
from fractions import Fraction

from packings import InFolder
from proof_files import CHECKER, File, doubled, file_of, jamproof
from test_digits import PI
from test_proof import packing
from test_proof_bounds import fcc, made


def run(program, *arguments):
    """Without libjam, numpy and the environment."""
    words = [sys.executable, "-I", "-S", "-B", str(program), *map(str, arguments)]
    return subprocess.run(words, capture_output=True, text=True, check=False)


def flower():
    """A packing whose file has implied contacts."""
    for seed in range(1, 120):
        system, ratio = packing(64, 2, seed)
        if system.report.jammed and system.report.excess_contacts == 1 and "\nimplied " in (text := file_of(system, ratio)):
            return text
    raise AssertionError("no seed gives a packing with an implied contact")


class Program(InFolder):
    @classmethod
    def setUpClass(cls):
        cls.text = made(16, 3, 0)

    def write(self, text):
        path = self.folder / "a.jamproof"
        path.write_bytes(text.encode())
        return path

    def unreadable(self, text, words):
        done = run(CHECKER, self.write(text))
        self.assertEqual((done.returncode, done.stderr, done.stdout.count("\n")), (2, "", 1), done.stdout)
        self.assertIn(words, done.stdout)

    def test_the_checker_is_a_program_of_its_own(self):
        """It runs without libjam and without numpy, and with an inverse in the file, which it then leaves as it is."""
        path, other = self.write(self.text), self.folder / "b.jamproof"
        first, second = run(CHECKER, path, other), run(CHECKER, other)
        self.assertEqual((first.returncode, second.returncode), (0, 0), first.stdout + first.stderr)
        self.assertEqual(first.stdout, second.stdout)
        self.assertEqual(run(CHECKER, other, self.folder / "c.jamproof").stdout, first.stdout)
        self.assertEqual(other.read_bytes(), (self.folder / "c.jamproof").read_bytes())
        packed = self.folder / "a.jamproof.gz"  # as libjam writes it under such a name
        packed.write_bytes(gzip.compress(self.text.encode()))
        self.assertEqual(run(CHECKER, packed).stdout, first.stdout)
        packed.write_bytes(packed.read_bytes()[:-9])
        self.assertEqual(run(CHECKER, packed).returncode, 2)
        lines = other.read_text(encoding="ascii").splitlines()
        bad = lines[-1].split()
        bad[2] = bad[2][:100] + ("A" if bad[2][100] != "A" else "B") + bad[2][101:]
        other.write_text("\n".join(lines[:-1] + [" ".join(bad)]) + "\n", encoding="ascii")
        self.assertIn(run(CHECKER, other).returncode, (1, 2))
        self.assertEqual(run(CHECKER, self.folder / "none").returncode, 2)
        self.assertEqual(run(CHECKER, self.write(self.text.replace("sphere 1", "sphere 0", 1))).returncode, 1)

    def test_a_full_output_is_no_failed_proof(self):
        words = [sys.executable, "-I", "-S", "-B", str(CHECKER), str(self.write(self.text))]
        with open("/dev/full", "w") as full:
            done = subprocess.run(words, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"\Astandard output: cannot be written.*\n\Z")

    def test_alone_it_proves_what_libjam_writes_and_names_the_file_that_others_need(self):
        alone = shutil.copy(CHECKER, self.folder)
        path = self.write(self.text)
        self.assertEqual(run(alone, path).stdout, run(CHECKER, path).stdout)
        f = File(self.text)
        taken = {frozenset(c[1:3]) for c in f.contacts} | {frozenset([f.contacts[0][1]])}
        other = next(k for k in range(len(f.spheres)) if frozenset([f.contacts[0][1], str(k)]) not in taken)
        f.lines.append([*f.contacts[0][:2], str(other), *f.contacts[0][3:]])  # a contact too many
        for text, name in (
            ("\n".join(fcc()) + "\n", "jamproof_trapped.py"),
            (flower(), "jamproof_implied.py"),
            (f.text(), "jamproof_trapped.py"),
        ):
            done = run(alone, self.write(text))
            self.assertEqual((done.returncode, done.stderr), (4, ""), done.stdout)
            first = done.stdout.splitlines()[0]
            self.assertEqual(first, f"could not try: {name}, which this file needs, is not beside jamproof.py")
        self.assertEqual(run(alone, self.write(self.text), "--xyz", "none.xyz").returncode, 4)
        os.symlink(CHECKER, self.folder / "link.py")  # files are beside the one that the link leads to
        self.assertEqual(run(self.folder / "link.py", self.write("\n".join(fcc()) + "\n")).returncode, 0)

    def test_exponents_take_no_memory(self):
        unit = next(line for line in self.text.splitlines() if line.startswith("unit "))
        for new in ("unit 1p40000000000", "unit 1p-5200000000"):
            self.unreadable(self.text.replace(unit, new), "an exponent of two is beyond")
        complete = self.folder / "b.jamproof"
        run(CHECKER, self.write(self.text), complete)
        for text in (self.text, "\n".join(fcc()) + "\n"):
            *_, data = complete.read_text(encoding="ascii").split()
            done = run(CHECKER, self.write(text + f"inverse -1000000000 {data}\n"))
            self.assertEqual(done.stderr, "")
            self.assertIn(done.returncode, (0, 1))  # a crystal that closes exactly needs none

    def test_what_cannot_be_written_is_said(self):
        """And the file that is written is the whole one, also from a pipe and of a crystal, which needs no inverse."""
        path = self.write(self.text)
        done = run(CHECKER, path, self.folder / "none" / "b.jamproof")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertIn("cannot be written", done.stderr)
        other = self.folder / "b.jamproof"
        words = [sys.executable, "-I", "-S", "-B", str(CHECKER), "/dev/stdin", str(other)]
        self.assertEqual(subprocess.run(words, input=self.text, capture_output=True, text=True, check=False).returncode, 0)
        self.assertTrue(other.read_text(encoding="ascii").startswith(self.text))
        path = self.write("\n".join(fcc()) + "\n")
        self.assertEqual(run(CHECKER, path, other).returncode, 0)
        self.assertEqual(other.read_bytes(), path.read_bytes())

    def test_what_says_nothing_sensible_cannot_be_read(self):
        """Exit status 2 and one sentence, not a proof and not a traceback."""

        def header(name, *words):
            return lambda f, r: f.header(name).__setitem__(slice(1, None), words)

        def without(*names):
            return lambda f, r: f.lines.__setitem__(slice(None), [line for line in f.lines if line[0] not in names])

        def contact(at, to):
            return lambda f, r: f.contacts[0].__setitem__(at, to)

        def more(*words):
            return lambda f, r: f.lines.append(words)

        once = ("dim", "unit", "cell", "non_additivity", "gamma")
        changes = {
            "is not positive": [header("unit", "-1p0"), header("unit", "0p0"), header("gamma", "0p0"), header("gamma", "-1p-4")],
            "must be above -1 and at most 1": [header("non_additivity", x) for x in ("-2p0", "-3p0", "-1p0", "1p0,1p-60", "2p0")],
            "times, not once": [doubled(x) for x in once] + [without(x) for x in once],
            "has not as many numbers as": [header("dim", "4"), header("dim", "1"), header("gamma", "1p-4", "1p-5"), header("unit")]
            + [lambda f, r: f.spheres[0].pop(), lambda f, r: f.spheres[0].append("1p0"), lambda f, r: f.contacts[0].pop()],
            "dim is not 1 or more": [header("dim", "0"), header("dim", "-2")],
            "lists no contact": [without("contact")],
            "no sphere is stable": [lambda f, r: [s.__setitem__(1, "0") for s in f.spheres], without("sphere", "contact")],
            "names a sphere that is not there": [contact(1, "999"), contact(2, "-1")],
            "names a contact that is not there": [more("implied", "9999", "0", "1"), more("tile", "0", "1", "-1")],
            "the first line is not": [lambda f, r: f.lines.clear(), lambda f, r: f.lines.pop(0)],
        }
        for words, kinds in changes.items():
            for k, change in enumerate(kinds):
                with self.subTest(words=words, kind=k):
                    f = File(self.text)
                    change(f, random)
                    self.unreadable(f.text(), words)
        for change in (header("non_additivity", "1p0"), header("unit", "1p-3")):  # the ends of what may be
            f = File(self.text)
            change(f, random)
            self.assertIn(run(CHECKER, self.write(f.text())).returncode, (0, 1))

    def test_only_what_libjam_writes_is_read(self):
        """A flag that is neither 0 nor 1, signs and zeros in front, carriage returns, a contact twice: each is refused by name."""
        contact, sphere = ([line for line in self.text.splitlines() if line.startswith(word)][0] for word in ("contact", "sphere 1"))
        i, j = contact.split()[1:3]
        image = " ".join(str(-int(n)) for n in contact.split()[3:6])
        again = f"contact {j} {i} {image} {contact.split()[6]}"
        for old, new, why in (
            ("sphere 1", "sphere True", "neither 1, stable, nor 0"),
            ("sphere 1", "sphere 01", "neither 1, stable, nor 0"),
            (sphere, sphere.replace("p-", "p-0", 1), "not a whole number"),
            (sphere, sphere.replace("sphere 1 ", "sphere 1 +", 1), "not a whole number"),
            (sphere, sphere.replace("sphere 1 ", "sphere 1 \u0661", 1), "ascii"),
            (sphere, sphere.replace("p-", "p-1p-", 1), "not of the form m p e"),
            (contact, contact.replace(f"contact {i}", f"contact +{i}"), "not a whole number"),
            (contact, contact.replace(f"contact {i}", f"contact 0{i}"), "not a whole number"),
            (contact, contact + "\n" + contact, "a contact is there twice"),
            (contact, contact + "\n" + again, "a contact is there twice"),
            (contact, f"{contact}\rcontact 0 1 0 0 0 1p0", "carriage return"),
            (contact, contact + "\n", "a line is empty"),
            (contact, contact + "\n ", "a line is empty"),
            (contact, contact + "\nstrict\nstrict", "is there twice"),
        ):
            with self.subTest(new=new):
                self.unreadable(self.text.replace(old, new, 1), why)

    def test_an_inverse_takes_no_more_memory_than_the_equations(self):
        """A hundred megabytes of zeros: the line 'inverse' is unpacked to the size that the contacts give, and no further."""
        bomb = base64.b64encode(zlib.compress(bytes(10**8), 9)).decode()
        path = self.write(self.text + f"inverse 0 {bomb}\n")
        words = [sys.executable, "-I", "-S", "-B", "-c", LIMITED, str(CHECKER), str(path)]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (2, ""), done.stdout)
        self.assertIn("more numbers than the equations", done.stdout)

    def test_it_says_what_was_proved(self):
        """The second line: all digits of phi that it prints are those of the exact packing near the centres of the file."""
        for text in (self.text, "\n".join(fcc()) + "\n", flower()):
            path = self.write(text)
            line = run(CHECKER, path).stdout.splitlines()[1]
            scene = jamproof.Scene(path)
            self.assertTrue(line.startswith(f"d = {scene.dim}, N = {len(scene.x)}, {len(scene.contacts)} contacts, "), line)
            shown = line.split("phi = ")[1]
            self.assertRegex(shown, r"^0\.\d{28,}\.\.\.$")
            balls = PI / {2: 4, 3: 6}[scene.dim] * sum(v**scene.dim for v in scene.ratio)
            edges = math.prod(Fraction(scene.cell[q][q], scene.one) for q in range(scene.dim))
            square = (balls / edges) ** 2 * scene.gamma**scene.dim
            phi = math.isqrt(math.floor(square * 10**120))
            self.assertTrue(f"0.{phi:060d}".startswith(shown[:26]), (shown, phi))

    def test_it_is_compared_with_an_xyz_file(self):
        system, ratio = packing(16, 3, 7)
        path, xyz = self.write(file_of(system, ratio)), self.folder / "a.xyz"
        system.write(str(xyz))
        done = run(CHECKER, path, "--xyz", xyz)
        self.assertIn("the same packing: stable centres within", done.stdout)
        self.assertIn(done.returncode, (0, 3), done.stdout)
        within = float(re.search("stable centres within ([^,]*),", done.stdout).group(1))
        self.assertLess(within, 1e-15)
        head, *rows = xyz.read_text().split("\n")[1:-1]
        for change, why in (
            (rows[:-1], "another packing: 15 spheres"),
            ([rows[1], rows[0], *rows[2:]], "another packing: stable centres"),
            (None, "cannot be read"),
        ):
            xyz.write_text("\n".join([str(len(change)), head, *change]) + "\n" if change else "16\nno header\n")
            done = run(CHECKER, path, "--xyz", xyz)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(why, done.stdout)

    def test_an_xyz_file_that_is_not_whole_is_refused(self):
        for dim in (2, 3, 4):
            system, ratio = packing(16, dim, 7)
            path, xyz = self.write(file_of(system, ratio)), self.folder / "a.xyz"
            system.write(str(xyz))
            whole = xyz.read_text()
            lattice, row = re.search('Lattice="[^"]*"', whole)[0], whole.split("\n")[2]
            other = lambda at, word: " ".join([*row.split()[:at], word, *row.split()[at + 1 :]])
            edges = " ".join(f"{float(r == c)}" for r in range(dim) for c in range(dim))
            for old, new, why in (
                (lattice, f'Lattice="{edges}"', "the same packing"),
                (lattice, 'Lattice="1 0 0"', "cannot be read"),
                (lattice, 'Lattice=""', "cannot be read"),
                (f":pos:R:{max(dim, 3)}", f":pos:R:{dim - 1}", "cannot be read"),
                (row, row.rsplit(" ", 1)[0], "cannot be read"),
                (row, other(1, "1e999999999"), "cannot be read"),
                (row, other(1 + max(dim, 3), "0"), "cannot be read"),
                ("16\n", "17\n", "cannot be read"),
            ):
                xyz.write_text(whole.replace(old, new, 1))
                done = run(CHECKER, path, "--xyz", xyz)
                self.assertEqual((done.returncode in (0, 3), done.stderr), (why == "the same packing", ""), new)
                self.assertIn(f"{xyz}: {why}", done.stdout)

    def test_words_without_numbers_are_no_traceback(self):
        for line in ("implied", "tile", "inverse", "dim", "gamma", "sphere", "contact"):
            done = run(CHECKER, self.write(self.text + line + "\n"))
            self.assertIn(done.returncode, (1, 2, 3), line)
            self.assertEqual((done.stderr, done.stdout.count("\n")), ("", 1 if done.returncode == 2 else 2), line)


LIMITED = """
import resource, runpy, sys
resource.setrlimit(resource.RLIMIT_AS, (96 << 20, 96 << 20))
sys.argv = sys.argv[1:]
runpy.run_path(sys.argv[0], run_name="__main__")
"""
