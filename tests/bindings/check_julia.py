"""Checks the Julia raw layer as text: every ccall names an exported symbol with the types of the header, and every
struct has the size and offsets that a compiled C program prints.

The types are read from the header here by a small parser of its own, not by the generator that wrote the file.
"""
import argparse
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCALARS = {
    "double": "Cdouble",
    "int32_t": "Int32",
    "uint32_t": "UInt32",
    "int64_t": "Int64",
    "uint64_t": "UInt64",
    "size_t": "Csize_t",
    "jam_status": "Int32",
    "char": "Cchar",
}
BYTES = {"Cdouble": 8, "Int32": 4, "UInt32": 4, "Int64": 8, "UInt64": 8, "Csize_t": 8, "Ptr{Cvoid}": 8}


def allowed(c, name):
    """Julia ccall types that fit a C parameter."""
    base = re.sub(r"\bconst\b|\bstruct\b|\*", " ", c).split()[0]
    stars = c.count("*")
    if base == "char" and stars == 1 and "const" in c:
        return {"Cstring"}
    if base in ("jam_system", "void") and stars == 1 or base.endswith("_fn"):
        return {"Ptr{Cvoid}"}
    if base == "jam_system" and stars == 2:
        return {"Ref{Ptr{Cvoid}}"}
    julia = SCALARS.get(base, base)
    if stars == 2:
        return {f"Ref{{Ptr{{{julia}}}}}"}
    return {f"Ptr{{{julia}}}", f"Ref{{{julia}}}"} if stars else {julia}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--layout", required=True)
    parser.add_argument("--library", required=True)
    parser.add_argument("--julia", required=True)
    args = parser.parse_args()
    text = Path(args.julia).read_text()
    header = re.sub(r"/\*.*?\*/", " ", (ROOT / "include/jam/jam.h").read_text(), flags=re.S)
    symbols = set(
        re.findall(
            r" T (jam_\w+)",
            subprocess.run(
                ["nm", "-D", "--defined-only", args.library], capture_output=True, text=True, check=True
            ).stdout,
        )
    )
    bad = []
    declared = {}
    for result, name, params in re.findall(r"JAM_API\s+([\w\s\*]*?)(jam_\w+)\s*\(([^)]*)\)", header):
        params = [p.strip() for p in params.split(",") if p.strip() not in ("", "void")]
        declared[name] = (result.strip(), params)
    called = {}
    for name, result, types, passed in re.findall(
        r"ccall\(symbol\(:(\w+)\), ([\w{}]+), \(([^)]*)\)((?:, (?:_\w+\([^)]*\)|\w+))*)\)", text
    ):
        called[name] = (result, [t.strip() for t in types.split(",") if t.strip()], passed)
    for name, (result, params) in declared.items():
        if name not in called:
            bad.append(f"{name}: not in the Julia layer")
            continue
        if name not in symbols:
            bad.append(f"{name}: not exported by the library")
        got_result, types, _ = called[name]
        fits = {"Cstring"} if "char" in result else {"Cvoid"} if result == "void" else {SCALARS[result.split()[-1]]}
        if got_result not in fits:
            bad.append(f"{name}: returns {result}, Julia says {got_result}")
        if len(types) != len(params):
            bad.append(f"{name}: {len(params)} parameters, Julia has {len(types)}")
        for p, t in zip(params, types):
            if t not in allowed(re.sub(r"\w+$", "", p), p):
                bad.append(f"{name}: parameter '{p}', Julia says {t}")
    for name in sorted(set(called) - set(declared)):
        bad.append(f"{name}: called, but not in the header")
    printed = subprocess.run([args.layout], capture_output=True, text=True, check=True).stdout.split("\n")
    sizes, offsets, values = {}, {}, {}
    for line in filter(None, printed):
        a, b, *rest = line.split()
        if b == "sizeof":
            sizes[a] = int(rest[0])
        elif b == "value" and len(rest) == 1:  # of an enum; a member has two numbers
            values[a] = int(rest[0])
        else:
            offsets.setdefault(a, []).append((b, int(rest[0]), int(rest[1])))
    structs = {
        n: re.findall(r"^    (\w+)::([\w{}]+)", body, re.M)
        for n, body in re.findall(r"mutable struct (\w+)\n(.*?)\nend", text, re.S)
    }
    if set(structs) != set(sizes):
        bad.append(f"structs differ: {set(structs) ^ set(sizes)}")
    for name, members in structs.items():
        at, mine = 0, []
        for member, kind in members:
            size = BYTES[kind]
            at = -(-at // size) * size
            mine.append((member, at, size))
            at += size
        align = max(BYTES[k] for _, k in members)
        if mine != offsets.get(name) or -(-at // align) * align != sizes.get(name):
            bad.append(f"{name}: Julia's layout {mine} is not the compiler's {offsets.get(name)}")
        if f"{name}() = new({sizes.get(name)}," not in text and members[0][0] == "struct_size":
            bad.append(f"{name}: struct_size of the constructor is not {sizes.get(name)}")
    constants = {n: int(v) for n, v in re.findall(r"^const (JAM_\w+) = Int32\((-?\d+)\)", text, re.M)}
    for name, value in values.items():
        if constants.get(name) != value:
            bad.append(f"{name}: {constants.get(name)} in Julia, {value} in C")
    print("\n".join(bad) or f"{len(called)} calls, {len(structs)} structs, {len(values)} enum values agree")
    sys.exit(bool(bad))


if __name__ == "__main__":
    main()
