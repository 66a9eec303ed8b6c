#!/usr/bin/env python3
"""abi.py symbols|constants|abidiff|update BUILD: compares the interface with what is recorded in this folder, or records it."""
import pathlib
import re
import subprocess
import sys
import tempfile

here = pathlib.Path(__file__).resolve().parent
root = here.parent.parent
build = pathlib.Path(sys.argv[2])
SYMBOLS, CONSTANTS, DUMP = here / "symbols.txt", here / "constants.c", here / "libjam.abi"
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
    found += re.findall(r"#define (JAM_[A-Z_]+) +\(?-?\d", text)
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


def update():
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
