#!/usr/bin/env python3
"""other_versions.py BUILD: old_reads.c runs with this library when it is compiled with a header of another version of 1.x.

A shorter header lacks the last member of structs and the last column of tables: an old program and a new library. A longer
one has more of both: a new program and an old library. Members that old_reads.c names stay.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

here = pathlib.Path(__file__).resolve().parent
header = (here.parents[1] / "include/jam/jam.h").read_text()
program = here / "old_reads.c"
build = pathlib.Path(sys.argv[1]).resolve()
STRUCT = r"typedef struct (jam_\w+) \{\n  uint32_t struct_size;(.*?)\} \1;"
COLUMNS = r"typedef enum jam_\w+_column \{(.*?)\} jam_\w+_column;\n#define (JAM_\w+_COLUMNS) (\d+)"


def plain(text):
    return re.sub(r"/\*.*?\*/", "", text, flags=re.S)


def shorter(text):
    """Without last members and columns, as far as the program does not name them."""
    named = set(re.findall(r"\w+", program.read_text()))
    cut = []

    def without_member(found):
        members = found.group(2).rstrip()
        start, _, last = members.rpartition("\n")
        names = re.findall(r"(\w+)(?=[,;])", last)
        size = "double" in last or "int64_t" in last
        if not size or len(names) != 1 or names[0] in named:
            return found.group()
        cut.append(f"{found.group(1)}.{names[0]}")
        return f"typedef struct {found.group(1)} {{\n  uint32_t struct_size;{start}\n}} {found.group(1)};"

    def without_column(found):
        items, (count, number) = found.group(1), found.groups()[1:]
        start, _, last = items.rstrip().rpartition(",")
        if last.split()[0] in named:
            return found.group()
        cut.append(last.split()[0])
        return found.group().replace(items, start + "\n").replace(f"{count} {number}", f"{count} {int(number) - 1}")

    return re.sub(COLUMNS, without_column, re.sub(STRUCT, without_member, text, flags=re.S), flags=re.S), cut


def longer(text):
    """With two members more in each struct and a column more in each table."""
    grown = []

    def with_members(found):
        grown.append(found.group(1))
        return found.group().replace(f"}} {found.group(1)};", f"  double later_real;\n  int64_t later_whole;\n}} {found.group(1)};")

    def with_column(found):
        items, (count, number) = found.group(1), found.groups()[1:]
        grown.append(count)
        more = f"{items.rstrip()},\n  {count[:-1]}_LATER = {number}\n"
        return found.group().replace(items, more).replace(f"{count} {number}", f"{count} {int(number) + 1}")

    return re.sub(COLUMNS, with_column, re.sub(STRUCT, with_members, text, flags=re.S), flags=re.S), grown


def run(*command, **more):
    done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)
    print(done.stdout, end="")
    return done.returncode


wrong = 0
for name, change, flags in (("shorter", shorter, []), ("longer", longer, ["-DLONGER"])):
    with tempfile.TemporaryDirectory() as folder:
        include = pathlib.Path(folder) / "jam"
        include.mkdir()
        text, changed = change(plain(header))
        if len(changed) < 20:
            sys.exit(f"only {len(changed)} structs and tables of jam.h are {name}: this script is broken")
        (include / "jam.h").write_text(text)
        compiled = pathlib.Path(folder) / name
        library = [f"-L{build}", f"-Wl,-rpath,{build}", "-ljam", "-lm"]
        if run("cc", "-std=gnu99", "-Wall", "-Wextra", *flags, "-I", folder, program, "-o", compiled, *library):
            sys.exit(f"{name}: does not compile")
        print(f"{name} by {len(changed)} structs and tables")
        wrong += run(compiled) != 0
sys.exit(wrong)
