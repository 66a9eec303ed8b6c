"""An example in C of each public call, from tests/calls.def and calls.h: the test every_call runs the same calls.

examples(root): {name of the call: lines of C}        call_examples.py ROOT: all of them as one C file, to standard output
"""
import re
import sys
from pathlib import Path

STARTS = {
    "SPACE": "sys: a packing in d = 3",
    "SOFT": "sys: spheres that may overlap (options.overlap = JAM_OVERLAP_ALLOW)",
    "NETWORK": "sys: a packing with a contact network, as after jam_crunch",
    "SHEARED": "sys: as jam_shear left it",
    "MINIMUM": "sys: as jam_decompress left it",
    "OBSERVED": "sys: after jam_observe and a run",
    "RUNS": "sys: after jam_isoconf",
    "STEP": "in the progress callback of jam_crunch with options.steps = 1",
}
#: What calls.h does by functions of its own, and the declarations that it needs here.
WORDS = {
    "read_back(in, sys, NULL)": 'jam_read(call_file(), create_options(in), NULL, NULL, &other)',
    'read_back(in, sys, "")': 'jam_read_as(call_file(), "cell=1,1", create_options(in), NULL, NULL, &other)',
    "checkpoint_back(sys)": "jam_read_checkpoint(call_file(), NULL, NULL, &other)",
    "cancelled(sys)": "jam_cancel(sys)",
    "monte_carlo_options(in, 2.0)": "monte_carlo_options(in)",
    "call_file()": '"file"',
    "call_image()": '"image.npy"',
    "call_progress": "NULL",
    "WHOLE_ZERO": "first_instant",
    "LARGE_ZERO": "first_contact",
}
DECLARED = {
    "real[0], matrix_of(in, sys, 1.0, dimension_of(sys), 7.0)": ("cell, 4", "const double cell[4] = {1, 0, 7, 1}; /* d = 2 */"),
    "real[0], matrix_of(in, sys, 0.3, 1, 0.1)": ("strain, 4", "const double strain[4] = {0.3, 0.1, 0, 0.3}; /* d = 2 */"),
    "real[0], wave_of(in, sys)": ("wave, 2", "const double wave[2] = {0.3, 0.3}; /* d = 2 */"),
    "whole[0], copies_of(in, sys)": ("copies, 2", "const int32_t copies[2] = {1, 2}; /* d = 2 */"),
    "real[0], numbers_of(in, sys, JAM_VIEW_POSITIONS)": ("x, 24", "double x[24]; /* of 12 disks */"),
    "real[0], numbers_of(in, sys, JAM_VIEW_VELOCITIES)": ("v, 24", "double v[24]; /* of 12 disks */"),
    "REALS(0)": ("x, 4096", "double x[4096];"),
    "REALS(1)": ("y, 4096", "double y[4096];"),
    "REALS(2)": ("z, 4096", "double z[4096];"),
    "real[2]": ("z", "double z[4096];"),
    "WHOLES(0)": ("i, 4096", "int32_t i[4096];"),
    "WHOLES(1)": ("j, 4096", "int32_t j[4096];"),
    "LARGE": ("k, 4096", "int64_t k[4096];"),
    "&needed": ("&needed", "size_t needed;"),
    "&view": ("&view", "const double *view;"),
    "&other": ("&other", "jam_system *other = NULL;"),
}


def _bare(call):
    """Without what the tests put around a call or its arguments."""
    call = re.sub(r"^sys \? (.*) : JAM_E_NULL$|^(.*) == JAM_ABI \? .*$", lambda m: m[1] or m[2], call)
    call = re.sub(r"^\((.*), (?:JAM_OK|text\(.*\))\)$", r"\1", call)
    call = re.sub(r"^(?:text|of_model|if_built)\((.*)\)$|^made\((.*), &other\)$", lambda m: m[1] or m[2], call)
    for word, meant in WORDS.items():
        call = call.replace(word, meant)
    return re.sub(r"\b(?:NUMBER|COUNT)\(([^()]*)\)", r"\1", call)


def _example(start, call, small, arrays):
    lines, call = [f"/* {STARTS[start]} */"] if start in STARTS else [], _bare(call)
    for word, (meant, declared) in DECLARED.items():
        if word in call:
            call = call.replace(word, meant)
            lines.append(declared)
    lines += [declared for name, declared in arrays.items() if re.search(rf"\b{name}\b", call)]
    if report := re.search(r"REPORT\((\w+)\)", call):
        call = call.replace(report[0], "&report")
        lines.append(f"{report[1]} report = {{.struct_size = sizeof report}};")
    if options := re.search(r"\b(\w+)_options\(in\)", call):
        kind = f"jam_{options[1]}_options"
        call = call.replace(options[0], "&options")
        lines += [f"{kind} options;", f"{kind}_init(&options, sizeof options);", *small.get(options[1], ())]
    elif options := re.search(r"options_of_(\w+),", call):
        call = call.replace(f"options_of_{options[1]}", "options")
        lines.append(f"jam_{options[1]}_options options;")
    return [*lines, call + ";"]


def examples(root):
    """The lines of each call by its name."""
    head = (root / "tests/calls.h").read_text().replace("\\\n", "")
    small = {"monte_carlo": ["options.sweeps = 20;"]}
    for name, several, one in re.findall(r"^OPTIONS\((\w+), (?:\((o->[^()]*)\)|(o->[^,()]*)),\s", head, re.M):
        small[name] = [f"{part};" for part in (several or one).replace("o->", "options.").split(", ")]
    arrays = {
        name: f"const {kind} {name}[] = {values};"
        for kind, rest in re.findall(r"^static const (\w+) (\w+\[\].*);$", head, re.M)
        for name, values in re.findall(r"(\w+)\[\] = (\{[^}]*\})", rest)
    }
    table = re.sub(r"\n {5}", " ", (root / "tests/calls.def").read_text())
    return {name: _example(start, call, small, arrays) for name, start, call in re.findall(r"^CALL\((\w+), (\w+), (.*)\)$", table, re.M)}


if __name__ == "__main__":
    print("#include <jam/jam.h>\n\nvoid every_example(jam_system *sys);\nvoid every_example(jam_system *sys) {")
    for lines in examples(Path(sys.argv[1])).values():
        print("  {", *lines, sep="\n    ", end="\n  }\n")
    print("}")
