#!/usr/bin/env python3
"""lint.py RULE ROOT: checks one rule of the source tree, or `all`; prints every violation, exit status 1 if there is one."""
import pathlib
import re
import sys

sys.dont_write_bytecode = True  # in the source tree
import pages  # noqa: E402
import python_layers as python_package  # noqa: E402

root = pathlib.Path(sys.argv[2])
problems = []

# src/README.md: a layer may include itself and those listed here.
LAYERS = {
    "core": [],
    "linalg": ["core"],
    "lp": ["linalg", "core"],
    "network": ["linalg", "core"],
    "crunch": ["verdict", "lp", "network", "linalg", "core"],
    "soft": ["lp", "network", "linalg", "core"],
    "dynamics": ["soft", "network", "linalg", "core"],
    "radii": ["lp", "network", "linalg", "core"],
    "analysis": ["verdict", "lp", "network", "linalg", "core"],
    "verdict": ["proof", "network", "linalg", "core"],
    "proof": ["lp", "network", "linalg", "core"],
    "pore": ["network", "core"],
    "io": ["dynamics", "network", "proof", "pore", "core"],
    "capi": ["core", "linalg", "lp", "network", "crunch", "radii", "soft", "dynamics", "analysis", "pore", "verdict", "proof", "io"],
}
# Folders of a layer: each may include the layer's own headers, itself and those listed here.
FOLDERS = {
    "dynamics/event_driven/kernel": [],
    "dynamics/event_driven": ["dynamics/event_driven/kernel"],
    "dynamics/monte_carlo": [],
    "dynamics/isoconfigurational": ["dynamics/event_driven", "dynamics/monte_carlo"],
    "crunch/approach": [],
    "crunch/path": [],
    "crunch/identify": [],
}
# Third-party headers and the only files (or folders) under src that may see them.
GUESTS = {
    r"(Clp|Coin|coin/|Osi)\w*": ["src/lp/clp_backend.cpp"],
    r"Spectra/": ["src/analysis/modes.cpp"],
    r"(cblas|lapacke|openblas|f77blas)\w*": ["src/linalg/"],
    r"[ds]mumps_c\.h": ["src/linalg/"],
    r"(dirent|dlfcn|fcntl|io|poll|pthread|unistd|windows)\.h|sys/": ["src/io/platform_", "src/core/memory_", "src/core/host_thread_", "src/linalg/"],
    r"Eigen/": ["src/linalg/", "src/network/", "src/analysis/", "src/soft/"],
}
# Layers whose steering numbers all stand in their tuning.hpp, and files of them whose numbers are physics.
TUNED = {
    "core": ["cell.cpp", "double_double.hpp", "limits.hpp", "math.cpp", "math.hpp", "math_normal.cpp", "pair_energy.hpp", "size_laws.cpp",
             "size_report.cpp"],
    "network": ["resolution.hpp"],
    "verdict": [],
    "soft": [],
    "lp": [],
    "radii": [],
    "linalg": ["newton_system.hpp"],
    "analysis": [],
    "pore": ["sphere_hull.cpp"],
    "proof": ["open_gaps.cpp", "theorem.cpp"],
    "crunch": [],
    "dynamics": [],
}
PROGRAMS = [
    "src/**/*.[ch]pp",
    *(f"{folder}/**/*.{kind}" for folder in ("tests", "examples", "bindings") for kind in ("[ch]", "[ch]pp", "py")),
]
# Calls that change the process elsewhere, but in that file the thread alone, and only while a call runs.
OF_THE_THREAD = {("decimal_point.hpp", "setlocale")}
# Files that may keep state of the process, each with its reason.
STATEFUL = {
    "src/linalg/blas/single_thread.cpp": "counts, under a lock, who needs OpenBLAS on one thread, and gives the host its own number back"
}


def problem(path, line, text):
    where = path.relative_to(root) if isinstance(path, pathlib.Path) else path
    problems.append(f"{where}:{line}: {text}")


def files(*patterns):
    return sorted(p for pattern in patterns for p in root.glob(pattern) if p.is_file())


def sources():
    return files("src/**/*.cpp", "src/**/*.hpp", "include/**/*.h")


def includes(path):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        found = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
        if found:
            yield number, found.group(1)


def without_comments(text):
    """Blanks out comments and string contents, keeps line breaks."""
    pattern = r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\''
    return re.sub(pattern, lambda m: re.sub(r"[^\n]", " ", m.group(0)), text, flags=re.S)


def layers():
    for path in files("src/**/*.cpp", "src/**/*.hpp"):
        layer = path.relative_to(root).parts[1]
        if layer not in LAYERS:
            problem(path, 0, f"folder {layer} is no layer of src/README.md")
            continue
        for number, name in includes(path):
            target = name.split("/")[0]
            if target in LAYERS and target != layer and target not in LAYERS[layer]:
                problem(path, number, f"layer {layer} must not include {name}")
            folder, inner = str(path.relative_to(root / "src").parent), name.rpartition("/")[0]
            if folder in FOLDERS and inner in FOLDERS and inner != folder and inner not in FOLDERS[folder]:
                problem(path, number, f"folder {folder} must not include {name}")


def python_layers():
    python_package.check(root / "bindings/python/jam", sys.stdlib_module_names, problem)
    # the rule sees a circle of three, and none where nothing leads back
    if python_package.circles({"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}}) != ["a", "b", "c"]:
        problem("tests/lint/python_layers.py", 0, "this rule is broken")


def private_headers():
    for path in sources():
        relative = str(path.relative_to(root))
        for number, name in includes(path):
            if relative.startswith("include/") and name not in ("stddef.h", "stdint.h"):
                problem(path, number, f"the public header must not include {name}")
            for pattern, homes in GUESTS.items():
                if re.match(pattern, name) and not any(relative.startswith(home) for home in homes):
                    problem(path, number, f"{name} belongs to {', '.join(homes)} only")


def declarations(text):
    """(line, comment, code) of every declaration of the header that has its comment right above."""
    for found in re.finditer(r"(/\*(?:(?!\*/).)*\*/)\n((?:JAM_API|typedef)\b(?:[^;{]|\{[^}]*\})*;)", text, flags=re.S):
        yield text.count("\n", 0, found.start(2)) + 1, found.group(1), found.group(2)


def doc_comments():
    path = root / "include/jam/jam.h"
    text = path.read_text()
    documented = set()
    for line, comment, code in declarations(text):
        documented.add(line)
        said = re.search(r"@since 0\.1|Threads:|Errors:|may be NULL with length 0|report may be NULL", comment)
        if said:
            problem(path, line, f"`{said.group()}` is a rule at the top of the header, or a tag")
        common = re.search(r"@errors [^@]*\b(NULL|STRUCT_SIZE|ARGUMENT|NONFINITE|BUFFER|MEMORY|BUSY)\b(?![^(]*\))", comment)
        if common:
            problem(path, line, f"any call may return JAM_E_{common.group(1)}: say in prose what is particular")
        for example in re.findall(r"Example: (\S+)", comment):
            if not (root / example).is_file():
                problem(path, line, f"there is no {example}")
    for number, line in enumerate(text.splitlines(), 1):
        if re.match(r"JAM_API|typedef", line) and number not in documented and "_options_init(" not in line:
            problem(path, number, "no comment right above")
    if len(documented) < 20:
        problem(path, 0, f"only {len(documented)} declarations recognised: this rule is broken")


def table_of_calls():
    """tests/calls.def, which drives tests of bad arguments, of memory faults and a fuzz target, holds every call of the header once."""
    calls = re.findall(r"JAM_API [^;(]*\b(jam_\w+)\(", without_comments((root / "include/jam/jam.h").read_text()))
    table = root / "tests/calls.def"
    listed = re.findall(r"^CALL\((\w+), ", table.read_text(), flags=re.M)
    for name in sorted(set(calls) ^ set(listed)):
        problem(table, 0, f"{name} is missing" if name in calls else f"{name} is no call of jam.h")
    for name in sorted({n for n in listed if listed.count(n) > 1}):
        problem(table, 0, f"{name} stands twice")
    if len(calls) < 100:
        problem(table, 0, "this rule is broken")


def names():
    path = root / "include/jam/jam.h"
    code = without_comments(path.read_text())
    for number, line in enumerate(code.splitlines(), 1):
        for name in re.findall(r"\b(?:jam|JAM)_\w+", line):
            if len(name) > 31:
                problem(path, number, f"{name} has {len(name)} characters, 31 are allowed")
        if re.match(r"JAM_API", line):
            name = re.search(r"(\w+)\(", line)
            if name and not name.group(1).startswith("jam_"):
                problem(path, number, f"{name.group(1)} does not begin with jam_")
        if re.search(r"\b(unsigned|long|short|float|bool|int)\b(?! main)", line):
            problem(path, number, "only double, int32_t, int64_t, uint32_t, size_t and char are used")
        found = re.match(r"\s+(JAM_\w+)\s*(=?)", line)
        if found and not found.group(2):
            problem(path, number, f"{found.group(1)} has no explicit value")
    for name, arguments in re.findall(r"JAM_API [^;(]*\b(jam_\w+)\(([^;]*)\);", code):
        if arguments.count(",") > 9:
            problem(path, 0, f"{name} has {arguments.count(',') + 1} arguments, 10 are allowed: an option struct, or two calls")
    for body in re.findall(r"typedef struct \w+ \{(.*?)\}", code, flags=re.S):
        if not re.match(r"\s*uint32_t struct_size;", body):
            problem(path, 0, "a struct does not begin with struct_size:" + body[:60])


def file_sizes():
    for path in files(*PROGRAMS):
        count = len(path.read_text().splitlines())
        most = 300 if path.parent == root / "bindings/gen" else 600
        if count > most:
            problem(path, count, f"more than {most} lines")
        elif count > 300:
            print(f"note: {path.relative_to(root)} has {count} lines, 300 is the aim")
    header = len((root / "include/jam/jam.h").read_text().splitlines())
    if header > 1865:  # 130 calls, of which each has its comment
        problem(root / "include/jam/jam.h", header, "more than 1865 lines")


def namespaces():
    """Names of the inside stand in jam::inside: no class of jam.hpp or of a program that links libjam.a has the same symbol."""
    for path in files("src/**/*.cpp", "src/**/*.hpp", "src/**/*.cpp.in"):
        first = re.search(r"^(?:inline )?namespace ([\w:]+) \{", path.read_text(), flags=re.M)
        if first and not first.group(1).startswith("jam::inside"):
            problem(path, 0, f"namespace {first.group(1)}: names of the inside stand in jam::inside")


def no_side_effects():
    """The library prints nothing, ends no process, takes no signal and keeps no state of its own (but for locks)."""
    calls = r"(?<![\w.>:])(?:std::)?(printf|fprintf|puts|putchar|perror|exit|_exit|abort|quick_exit|signal|sigaction|raise|setlocale|srand|rand)\s*\("
    streams = r"\bstd::(cout|cerr|clog)\b|\bstderr\b|\bstdout\b"
    state = r"^(?:static |inline )*(?:int|double|bool|size_t|int32_t|int64_t|char|std::(?!mutex)\w+(?:<[^;()]*>)?) \w+(?:\[\w*\])?(?: = [^;(]*|\{[^;]*\})?;"
    for path in files("src/**/*.cpp", "src/**/*.hpp"):
        code = without_comments(path.read_text())
        for number, line in enumerate(code.splitlines(), 1):
            for pattern in (calls, streams):
                found = re.search(pattern, line)
                if found and (path.name, found.group(1)) not in OF_THE_THREAD:
                    problem(path, number, f"{found.group(0).strip()} has no place in the library")
            if re.match(state, line) and str(path.relative_to(root)) not in STATEFUL:
                problem(path, number, f"mutable state of the process: {line.strip()}")


def own_math():
    """Elementary functions whose bits depend on the C library and on the processor are called in tests alone; what C
    rounds exactly (sqrt, floor, ldexp, ...) is free."""
    names = (
        "log2|log10|log1p|exp|exp2|expm1|pow|cbrt|hypot|sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|asinh|acosh|atanh"
        "|erf|erfc|tgamma|lgamma|fma"
    )  # and log, which is a member of Monitor too
    inexact = rf"(?:(?:std::|__builtin_)(?:log|{names})|(?<![\w.>:])(?:{names}))[fl]?\s*\("
    random = r"std::(?:normal|lognormal|exponential|gamma|uniform_real|uniform_int)_distribution|std::shuffle"
    if not re.search(inexact, "x = std::pow(2, 3);") or re.search(inexact, "x = math::pow(2, 3); log(1);"):
        problem("tests/lint/lint.py", 0, "this rule is broken")
    for path in files("src/**/*.[ch]pp"):
        own = re.match(r"src/core/math\.[ch]pp", str(path.relative_to(root)))
        for number, line in enumerate(without_comments(path.read_text()).splitlines(), 1):
            for pattern in (inexact, random):
                found = re.search(pattern, line)
                if found and not own:
                    problem(path, number, f"{found.group(0)}...) has other bits elsewhere; core/math.hpp has its own")


def steering_numbers():
    """Fractions and large numbers that choose what is done stand in the layer's tuning file. Free are simple ones, roundings
    and what stands for infinity (powers of ten from 1e-6 and 1e6 on), constants of ten digits and more, option defaults,
    and binary fractions."""
    number = r"(?<![\w.])(?:\d+\.\d*(?:e[+-]?\d+)?|\d+e[+-]?\d+)(?![\w.])"
    simple = r"(0\.0|0\.25|0\.5|1\.0|2\.0|3\.0|4\.0|8\.0|10\.0|1e-(?:[6-9]|\d\d+)|\de(?:[6-9]|\d\d+)|0\.\d{10,})$"
    if [x for x in re.findall(number, "0.3 * 1e-12 + 2.0 + 7") if not re.match(simple, x)] != ["0.3"]:
        problem("tests/lint/lint.py", 0, "this rule is broken")
    for layer, physics in TUNED.items():
        for path in files(f"src/{layer}/**/*.[ch]pp"):
            if path.name in physics or path == root / "src" / layer / "tuning.hpp":
                continue
            for line, code in enumerate(without_comments(path.read_text()).splitlines(), 1):
                if re.match(r"\s*o\.\w+ = ", code):
                    continue
                for found in re.findall(number, code):
                    if not re.match(simple, found):
                        problem(path, line, f"{found} belongs into src/{layer}/tuning.hpp")


def plain_words():
    """Text files are ASCII (Python: but for labels) without trailing blanks, and speak of nobody's machine."""
    for path in files(*PROGRAMS, "include/**/*.h", "tests/**/*.sh", "examples/**/*.sh", "pkgconfig/*"):
        text = path.read_bytes()
        for number, line in enumerate(text.split(b"\n"), 1):
            # Python may label an axis with a Greek letter; long dashes stay out there too.
            if re.search(b"\xe2\x80[\x93\x94]", line) if path.suffix == ".py" else any(byte > 126 for byte in line):
                problem(path, number, "not ASCII")
            if line.rstrip() != line and not path.name == "generated.py":
                problem(path, number, "blanks at the end of the line")
            if re.search(rb"/(home|root|work)/\w", line):
                problem(path, number, "a path of one machine")


def avoided_words():
    pages.avoided_words(root, problem)


def figures():
    pages.figures(root, problem)


def links():
    pages.links(root, problem)


def changelog():
    pages.changelog(root, problem)


def columns():
    """Lines end by column 120: build files, shell, Fortran and C (lint/format checks its layout); by 160 in pages of the guide."""
    kinds = ("CMakeLists.txt", "*.cmake", "*.sh", "*.f90", "*.[ch]")
    below = [f"{folder.name}/**/{kind}" for folder in pages.folders(root) if folder.name[0] != "." for kind in kinds]
    for path in files("CMakeLists.txt", "src/**/*.[ch]pp", *below):
        for number, line in enumerate(path.read_text().splitlines(), 1):
            if len(line) > 120:
                problem(path, number, f"{len(line)} columns, 120 are allowed")
    for path in files("README.md", "CHANGELOG.md", "bindings/docs/*.md"):  # but tables that figures.py writes
        tables = re.compile(r"<!-- figures.*?<!-- end of figures -->", re.S)
        text = tables.sub(lambda m: "\n" * m.group().count("\n"), path.read_text(encoding="utf-8"))
        for number, line in enumerate(text.splitlines(), 1):
            if len(line) > 160:
                problem(path, number, f"{len(line)} columns, 160 are allowed in a page")


RULES = [layers, python_layers, private_headers, doc_comments, names, table_of_calls, file_sizes, namespaces, no_side_effects]
RULES += [own_math, steering_numbers, plain_words, avoided_words, figures, links, changelog, columns]
for rule in RULES:
    if sys.argv[1] in ("all", rule.__name__):
        rule()
if sys.argv[1] not in ["all"] + [rule.__name__ for rule in RULES]:
    problem("tests/lint/lint.py", 0, f"no rule {sys.argv[1]}")
print("\n".join(problems))
sys.exit(bool(problems))
