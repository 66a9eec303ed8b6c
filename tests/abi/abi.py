#!/usr/bin/env python3
"""abi.py symbols|constants|abidiff|update BUILD: compares the interface with what is recorded in this folder, or records it.

From JAM_ABI 1 on `update` records additions alone, until the number is raised.
"""
import itertools
import pathlib
import re
import subprocess
import sys
import tempfile

here = pathlib.Path(__file__).resolve().parent
root = here.parent.parent
build = pathlib.Path(sys.argv[2])
SYMBOLS, CONSTANTS, DUMP = here / "symbols.txt", here / "constants.c", here / "libjam.abi"
HEADER = here / "recorded/jam/jam.h"  # what old_program.c is compiled with
DEBIAN = root / "pkgconfig/debian"
UPDATE = "if that is wanted: python3 tests/abi/abi.py update BUILD_FOLDER"


def run(*command, ok=(0,)):
    done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode not in ok:
        sys.exit(f"{' '.join(map(str, command))} failed with {done.returncode}:\n{done.stdout}")
    return done


def exported():
    lines = run("nm", "-D", "--defined-only", build / "libjam.so").stdout.splitlines()
    return sorted({line.split()[-1].split("@")[0] for line in lines})


def header_text():
    return re.sub(r"/\*.*?\*/", "", (root / "include/jam/jam.h").read_text(), flags=re.S)


def items():
    """Names of constants whose values compiled programs hold. Structs are compared by abidiff and tests/bindings/layout.c."""
    text = header_text()
    found = []
    for body in re.findall(r"typedef enum \w+ \{(.*?)\}", text, flags=re.S):
        found += re.findall(r"(JAM_\w+)\s*=", body)
    found += re.findall(r"^#define (JAM_[A-Z_]+) +\(?-?\d", text, flags=re.M)
    if len(found) < 50:
        sys.exit(f"only {len(found)} constants recognised in jam.h: this script is broken")
    return found


def measured(names):
    """Their values, as the C compiler sees them."""
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder) / "values.c"
        lines = "".join(f'  printf("%lld\\n", (long long)({e}));\n' for e in names)
        source.write_text(f"#include <jam/jam.h>\n#include <stdio.h>\nint main(void) {{\n{lines}  return 0;\n}}\n")
        run("cc", "-I", root / "include", source, "-o", source.with_suffix(""))
        return run(source.with_suffix("")).stdout.split()


def constants_text():
    names = items()
    lines = "".join(f"CHECK({name} == {value})\n" for name, value in zip(names, measured(names)))
    return f"""/* Made by tests/abi/abi.py. Values that compiled programs hold; a line that fails to compile is a break of the binary
 * interface. */
#include <jam/jam.h>
#define JOIN(a, b) a##b
#define NAMED(a, b) JOIN(a, b)
#define CHECK(truth) typedef char NAMED(check_, __LINE__)[(truth) ? 1 : -1];
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wunused-local-typedefs"
#endif

{lines}
/* The library that is loaded must be of the same interface as the header. */
int main(void) {{ return jam_abi_version() == JAM_ABI ? 0 : 1; }}
"""


def differences(recorded, now, what):
    lost, new = sorted(set(recorded) - set(now)), sorted(set(now) - set(recorded))
    for text in lost:
        print(f"{what} gone: {text}")
    for text in new:
        print(f"{what} not recorded: {text}")
    if lost or new:
        sys.exit(UPDATE)


def fixed_constants(text):
    """Lines of constants that stay as they are. The number of columns of a table may grow."""
    return set(re.findall(r"^CHECK\((?!JAM_\w+_COLUMNS ==).*\)", text, flags=re.M))


def symbols():
    differences(SYMBOLS.read_text().split(), exported(), "symbol")


def constants():
    pattern = r"CHECK\((.*) == -?\d+\)"
    differences(re.findall(pattern, CONSTANTS.read_text()), items(), "constant")


def abidiff():
    # Bits of the exit status: 1 error, 2 usage, 4 some change, 8 an incompatible change. Additions are left to `symbols`.
    done = run("abidiff", "--no-added-syms", DUMP, build / "tests/abi/libjam_abi.so", ok=range(16))
    print(done.stdout)
    if done.returncode:
        sys.exit(f"abidiff returned {done.returncode}; {UPDATE}")


def abi_number(text):
    return int(re.search(r"^#define JAM_ABI (\d+)", text, flags=re.M).group(1))


def frozen():
    """From ABI 1 on a number keeps the header with which it began, as old programs do."""
    return HEADER.exists() and abi_number(header_text()) == abi_number(HEADER.read_text()) >= 1


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


def refuse_breaks():
    """What went or changed needs the next number. Functions, constants, members at the end of a struct and columns at the
    end of a table may come."""
    broken = sorted(set(SYMBOLS.read_text().split()) - set(exported()))
    broken += sorted(fixed_constants(CONSTANTS.read_text()) - fixed_constants(constants_text()))
    broken += broken_tables(tables(HEADER.read_text()), tables(header_text()))
    (old_calls, old_structs), (calls, structs) = declared(HEADER.read_text()), declared(header_text())
    broken += [call for call in old_calls if call not in calls]
    for name, old in old_structs.items():
        for before, now in itertools.zip_longest(old, structs.get(name, [])[: len(old)], fillvalue="nothing"):
            # what was reserved may be used
            if before != now and not (" reserved" in before and before.split()[0] == now.split()[0]):
                broken.append(f"{name}: {before} is {now} now")
    if broken:
        sys.exit("\n".join(broken) + "\nold programs would break: raise JAM_ABI in jam.h first")


def record_header():
    """The header without its comments."""
    now = re.sub(r"\s*\n(?=\s*\n)|[ \t]+$", "", header_text(), flags=re.M)
    HEADER.parent.mkdir(parents=True, exist_ok=True)
    HEADER.write_text("/* Made by tests/abi/abi.py: jam.h as old programs were compiled with. */\n" + now.lstrip())


def grown():
    """Calls that take a struct or give a table which has grown since the last record: a program that uses what is new needs
    this library, though the name of the call is older."""
    sizes = dict(re.findall(r"<class-decl name='(jam_\w+)' size-in-bits='(\d+)'", DUMP.read_text()))
    text = header_text()
    sizes = {name: int(size) for name, size in sizes.items() if f"}} {name};" in text}
    now = dict(zip(sizes, map(int, measured([f"8 * sizeof({name})" for name in sizes]))))
    new = {name for name, size in sizes.items() if size < now[name]}
    columns = dict(re.findall(r"CHECK\((JAM_\w+_COLUMNS) == (\d+)\)", CONSTANTS.read_text()))
    for enum, found in tables(text).items():
        count = f"JAM_{found[0][0].split('_')[1]}_COLUMNS"
        new |= {enum} if int(columns.get(count, len(found))) < len(found) else set()
    header = (root / "include/jam/jam.h").read_text()
    calls = re.findall(r"/\*((?:(?!\*/).)*)\*/\s*JAM_API[^;(]*?\b(jam_\w+)\(([^;]*);", header, flags=re.S)
    return {call for comment, call, arguments in calls if new & set(re.findall(r"jam_\w+", comment + arguments))}


def record_debian():
    """Debian's list says with which version a symbol came, or what it takes or gives last grew."""
    number = abi_number(header_text())
    file = DEBIAN / f"libjam{number}.symbols"
    if not file.exists():
        print(f"{file.relative_to(root)} is missing: rename Debian's files to the new number")
        return
    version = re.search(r"project\(jam VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text()).group(1)
    had = dict(re.findall(rf"^ (\S+)@JAM_{number} (\S+)$", file.read_text(), flags=re.M))
    newer = grown() if DUMP.exists() else set()
    lines = [f" {name}@JAM_{number} {version if name in newer else had.get(name, version)}" for name in exported()]
    head = f"libjam.so.{number} libjam{number} #MINVER#\n* Build-Depends-Package: libjam-dev\n"
    file.write_text(head + "\n".join(lines) + "\n")


def update():
    if frozen():
        refuse_breaks()
    else:
        record_header()
    record_debian()
    SYMBOLS.write_text("\n".join(exported()) + "\n")
    CONSTANTS.write_text(constants_text())
    library = build / "tests/abi/libjam_abi.so"
    if library.exists():
        run(
            "abidw",
            "--exported-interfaces-only",
            "--no-corpus-path",
            "--no-comp-dir-path",
            "--no-show-locs",
            "--drop-private-types",
            "--headers-dir",
            root / "include",
            "--out-file",
            DUMP,
            library,
        )
        DUMP.write_text(DUMP.read_text().replace(f"{root}/", ""))  # where the tree lies is no part of the interface


{"symbols": symbols, "constants": constants, "abidiff": abidiff, "update": update}[sys.argv[1]]()
