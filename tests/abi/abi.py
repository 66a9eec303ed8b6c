#!/usr/bin/env python3
"""abi.py check|update BUILD: compares jam.h and the library with the recorded header, or records what was added.

recorded/jam/jam.h is the header with which the ABI number began, which old programs were compiled with; what later versions
added under this number is in recorded/latest/jam/jam.h. From JAM_ABI 1 on `update` records additions alone, until the number
is raised.
"""
import itertools
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap

here = pathlib.Path(__file__).resolve().parent
root = here.parent.parent
build = pathlib.Path(sys.argv[2])
HEADER = root / "include/jam/jam.h"
FIRST, LATEST = here / "recorded/jam/jam.h", here / "recorded/latest/jam/jam.h"
DEBIAN = root / "pkgconfig/debian"
UPDATE = "if that is wanted: python3 tests/abi/abi.py update BUILD_FOLDER"


def run(*command):
    done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))} failed with {done.returncode}:\n{done.stdout}")
    return done.stdout


def exported():
    rows = map(str.split, run("nm", "-D", "--defined-only", build / "libjam.so").splitlines())
    return sorted({row[-1].split("@")[0] for row in rows if row[-2] != "A"})  # A: the version node


def plain(path):
    """The header without its comments, a declaration or an instruction of the preprocessor in each line."""
    text = re.sub(r"/\*.*?\*/", "", path.read_text(), flags=re.S)
    parts = re.split(r"^(#(?:.*\\\n)*.*)$", text, flags=re.M)
    lines = [[part] if part.startswith("#") else re.findall(r"extern \"C\" \{|(?:\{[^}]*\}|[^;{}])+;?|\}", " ".join(part.split())) for part in parts]
    return "".join(line.strip() + "\n" for line in itertools.chain(*lines) if line.strip())


def constants(text):
    """Names of constants whose values compiled programs hold."""
    found = []
    for body in re.findall(r"typedef enum \w+ \{(.*?)\}", text, flags=re.S):
        found += re.findall(r"(JAM_\w+)\s*=", body)
    found += re.findall(r"^#define (JAM_[A-Z_]+) +\(?-?\d", text, flags=re.M)
    if len(found) < 50:
        sys.exit(f"only {len(found)} constants recognised in jam.h: this script is broken")
    return found


def measured(header, terms):
    """{term: its value}, as the C compiler sees them with this header."""
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder) / "values.c"
        lines = "".join(f'  printf("%lld\\n", (long long)({e}));\n' for e in terms)
        heads = "#include <jam/jam.h>\n#include <stddef.h>\n#include <stdio.h>\n"
        source.write_text(f"{heads}int main(void) {{\n{lines}  return 0;\n}}\n")
        run("cc", "-I", header.parents[1], source, "-o", source.with_suffix(""))
        return dict(zip(terms, map(int, run(source.with_suffix("")).split())))


def abi_number(text):
    return int(re.search(r"^#define JAM_ABI (\d+)", text, flags=re.M).group(1))


def frozen():
    """From ABI 1 on a number keeps the header with which it began, as old programs do."""
    return FIRST.exists() and abi_number(plain(HEADER)) == abi_number(plain(FIRST)) >= 1


def records():
    return [path for path in (FIRST, LATEST) if path.exists()]


def declared(text):
    """Prototypes with types of callbacks, and the members of each struct in their order."""
    text = re.sub(r"\s+", " ", re.sub(r"^\s*#.*$", "", text, flags=re.M))
    structs = {}
    for name, body in re.findall(r"typedef struct (\w+) \{(.*?)\}", text):
        members = structs[name] = []
        for kind, names in re.findall(r" *((?:const )?\w+) ([^;]+);", body):
            members += [f"{kind} {member.strip()}" for member in names.split(",")]
    return re.findall(r"JAM_API [^;]+;|typedef [^;{]+;", text), structs


def tables(text):
    """{enum of columns: [(column, its number)]}."""
    found = re.findall(r"typedef enum (\w+_column) \{(.*?)\}", text, flags=re.S)
    return {name: re.findall(r"(JAM_\w+)\s*=\s*(\d+)", body) for name, body in found}


def broken_tables(old, now):
    """A column may come behind the last; programs ask for as many as they know, and index by the numbers that they know."""
    for name, columns in old.items():
        if now.get(name, [])[: len(columns)] != columns:
            yield f"{name}: columns went or moved; new ones come behind the last"
    for name, columns in now.items():
        if [int(number) for _, number in columns] != list(range(len(columns))):
            yield f"{name}: the columns are not numbered from 0 to {len(columns) - 1}"


def names_of(calls):
    return {found.group(1) for call in calls if (found := re.match(r"JAM_API [^(]*?\b(jam_\w+)\(", call))}


def breaks(record):
    """What programs compiled with the recorded header would meet. Functions, constants, members at the end of a struct and
    columns at the end of a table may come."""
    before, text = plain(record), plain(HEADER)
    (old_calls, old_structs), (calls, structs) = declared(before), declared(text)
    broken = [f"{call} is gone or another one" for call in old_calls if call not in calls]
    broken += [f"{name} is not exported" for name in sorted(names_of(old_calls) - set(exported()))]
    broken += broken_tables(tables(before), tables(text))
    offsets = []
    for name, old in old_structs.items():
        for was, now in itertools.zip_longest(old, structs.get(name, [])[: len(old)], fillvalue="nothing"):
            if was == now:
                member = re.search(r"\w+(?=(?:\[\w+\])*$)", was).group()
                offsets.append(f"offsetof({name}, {member})")
            elif not (" reserved" in was and was.split()[0] == now.split()[0]):  # what was reserved may be used
                broken.append(f"{name}: {was} is {now} now")
    kept = set(constants(text))
    broken += [f"{name} is gone" for name in constants(before) if name not in kept]
    # the number of columns of a table may grow
    terms = offsets + [name for name in constants(before) if name in kept and not name.endswith("_COLUMNS")]
    if not broken:
        then, now = measured(record, terms), measured(HEADER, terms)
        broken += [f"{term} was {then[term]} and is {now[term]}" for term in terms if then[term] != now[term]]
    return broken


def refuse_breaks():
    broken = [line for record in records() for line in breaks(record)]
    if broken:
        sys.exit("\n".join(dict.fromkeys(broken)) + "\nold programs would break: raise JAM_ABI in jam.h first")


def check():
    refuse_breaks()
    declared_names = names_of(declared(plain(HEADER))[0])
    wrong = [f"{name}: declared or exported, not both" for name in sorted(declared_names ^ set(exported()))]
    if plain(records()[-1]) != plain(HEADER):
        wrong.append("jam.h has what is not recorded; " + UPDATE)
    if wrong:
        sys.exit("\n".join(wrong))


def record_header(path):
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = ["/* Made by tests/abi/abi.py: jam.h as programs were compiled with. */", *plain(HEADER).splitlines()]
    fill = lambda line: line if line.startswith("#") else textwrap.fill(line, 118, subsequent_indent="  ", break_on_hyphens=False)
    path.write_text("".join(fill(line) + "\n" for line in lines))


def grown():
    """Calls that take a struct or give a table which has grown since the last record: a program that uses what is new needs
    this library, though the name of the call is older."""
    last = records()[-1]
    sizes = [f"sizeof({name})" for name in declared(plain(last))[1]]
    then, now = measured(last, sizes), measured(HEADER, sizes)
    new = {size[7:-1] for size in sizes if then[size] < now[size]}
    columns = tables(plain(last))
    new |= {enum for enum, found in tables(plain(HEADER)).items() if len(columns.get(enum, found)) < len(found)}
    calls = re.findall(r"/\*((?:(?!\*/).)*)\*/\s*JAM_API[^;(]*?\b(jam_\w+)\(([^;]*);", HEADER.read_text(), flags=re.S)
    return {call for comment, call, arguments in calls if new & set(re.findall(r"jam_\w+", comment + arguments))}


def record_debian(newer):
    """Debian's list says with which version a symbol came, or what it takes or gives last grew."""
    number = abi_number(plain(HEADER))
    file = DEBIAN / f"libjam{number}.symbols"
    if not file.exists():
        print(f"{file.relative_to(root)} is missing: rename Debian's files to the new number")
        return
    version = re.search(r"project\(jam VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text()).group(1)
    had = dict(re.findall(rf"^ (\S+)@JAM_{number} (\S+)$", file.read_text(), flags=re.M))
    names = [f"JAM_{number}", *exported()]  # the version node too
    lines = [f" {name}@JAM_{number} {version if name in newer else had.get(name, version)}" for name in names]
    head = f"libjam.so.{number} libjam{number} #MINVER#\n* Build-Depends-Package: libjam-dev\n"
    file.write_text(head + "\n".join(lines) + "\n")


def update():
    if not frozen():  # a new number, or none yet
        shutil.rmtree(LATEST.parents[1], ignore_errors=True)
        record_header(FIRST)
    refuse_breaks()
    newer = grown()
    if plain(records()[-1]) != plain(HEADER):
        record_header(LATEST)
    record_debian(newer)


{"check": check, "update": update}[sys.argv[1]]()
