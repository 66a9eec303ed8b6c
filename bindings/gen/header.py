"""Reads the public header: `swig -xml` gives the declarations, the header text the comments.

This is the one place where the header's argument conventions (name + name_len, needed, view, options, callbacks) are
recognised.
"""
import subprocess
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import annotations
from annotations import HeaderError
from model import HANDLE, TYPES, Api, Arg, Callback, Enum, Function, Member, Struct, Type


def parse_type(text):
    """SWIG's type string, e.g. p.q(const).double, to a Type."""
    const, stars = False, 0
    while True:
        if text.startswith("p."):
            stars, text = stars + 1, text[2:]
        elif text.startswith("q(const)."):
            const, text = True, text[9:]
        else:
            break
    for word in ("struct ", "enum "):
        text = text.removeprefix(word)
    return Type(text, stars, const)


def _attributes(node):
    listing = node.find("attributelist")
    return {} if listing is None else {a.get("name"): a.get("value") for a in listing.findall("attribute")}


def _parms(node):
    found = node.find("attributelist/parmlist")
    for p in [] if found is None else found.findall("parm"):
        a = _attributes(p)
        if a["type"] != "void":
            yield Arg(a.get("name", ""), parse_type(a["type"]))


def _layout(struct):
    at = align = 0
    for m in struct.members:
        size = TYPES[m.type][0]
        if at % size:
            raise HeaderError(f"{struct.name} has a hole before {m.name}, which a later member could fill: write `reserved`")
        m.offset, at, align = at, at + size, max(align, size)
    if at % align:
        raise HeaderError(f"{struct.name} has a hole at its end, which a later member could fill: write `reserved`")
    struct.size = at


def classify(args, callbacks, structs, pointing):
    """Names the role of each argument by the header's conventions."""
    names = {a.name: a for a in args}
    for k, a in enumerate(args):
        t, after = a.type, args[k + 1].name if k + 1 < len(args) else ""
        if t.base == HANDLE:
            a.role = "new_handle" if t.stars == 2 else "handle"
        elif t.base in callbacks:
            a.role = "callback"
        elif t.base == "void":
            a.role = "user"
        elif t.stars == 1 and after == a.name + "_len" and args[k + 1].type.stars == 0:
            a.role = "array_in" if t.const else "array_out"
        elif t.base in pointing:
            a.role = "start"
        elif t.base in structs:
            a.role = "struct_in" if t.const else "struct_out"
        elif t.base == "char" and t.stars == 1 and t.const:
            a.role = "string"
        elif t.stars == 2:
            a.role = "view"
        elif a.name == "columns" and after == "table":
            a.role = "columns"  # how many of the table the caller knows
        elif a.name.endswith("_len") and a.name[:-4] in names:
            a.role = "view_len" if t.stars == 1 else "len"
        elif t.stars == 1 and not t.const:
            a.role = "scalar_out"  # `needed` among them
        elif t.stars == 0 and t.scalar in TYPES:
            a.role = "scalar"
        else:
            raise HeaderError(f"argument {a.name} of type {t.c()} follows no rule of the header")
    return args


def read_header(header, swig="swig"):
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "jam.xml"
        done = subprocess.run(
            [swig, "-xml", "-module", "jam", "-o", str(out), str(header)], capture_output=True, text=True
        )
        if done.returncode or not out.exists():
            raise HeaderError(f"swig -xml failed: {done.stderr}")
        root = ElementTree.parse(out).getroot()
    docs = annotations.comments(Path(header).read_text())
    api = Api()
    for node in root.iter():
        if node.tag not in ("cdecl", "class", "enum", "constant"):
            continue
        a = _attributes(node)
        name = a.get("name", "")
        if node.tag == "constant" and name.startswith("JAM_"):
            api.constants.append((name, int(a["value"])))
        elif node.tag == "enum":
            items = [_attributes(i) for i in node.findall("enumitem")]
            rows = [(i["name"], int(i["enumvalue"]), docs.get((name, i["name"]), "")) for i in items]
            api.enums.append(Enum(name, rows, docs.get(name, "")))
        elif node.tag == "class" and name.startswith("jam_"):
            members = []
            for m in node.iter("cdecl"):
                b = _attributes(m)
                if b.get("kind") != "variable":
                    continue
                kind = "pointer" if b.get("decl") == "p." else b["type"]
                kind = "callback" if kind in [c.name for c in api.callbacks] else kind
                if kind not in TYPES or b.get("decl") not in ("", None, "p."):
                    what = f"{b.get('decl')}{b['type']}"
                    raise HeaderError(f"{name}.{b['name']}: members are flat and of fixed width, not {what}")
                tags = annotations.of_member(f"{name}.{b['name']}", docs.get((name, b["name"]), ""))
                members.append(Member(b["name"], kind, 0, *tags))
            struct = Struct(name, members, doc=docs.get(name, ""))
            _layout(struct)
            api.structs.append(struct)
        elif node.tag == "cdecl" and a.get("kind") == "typedef" and a.get("decl", "").startswith("p.f("):
            api.callbacks.append(Callback(name, parse_type(a["type"]), list(_parms(node)), docs.get(name, "")))
        elif node.tag == "cdecl" and a.get("kind") == "function" and name.startswith("jam_"):
            stars = a["decl"].rsplit(").", 1)[1].count("p.")
            result = parse_type("p." * stars + a["type"])
            tags = annotations.of_function(name, docs.get(name, ""))
            api.functions.append(Function(name, result, list(_parms(node)), "", *tags))
            api.functions[-1].doc = annotations.readable(api.functions[-1])
    callbacks, structs = {c.name for c in api.callbacks}, {s.name for s in api.structs}
    for f in api.functions:
        classify(f.args, callbacks, structs, {s.name for s in api.structs if s.has_pointers})
    annotations.check(api)
    names = [n for n, _ in api.constants] + [n for e in api.enums for n, _, _ in e.items]
    lower = [n.lower() for n in names + [x.name for x in api.structs + api.functions + api.callbacks]]
    if twice := {n for n in lower if lower.count(n) > 1}:
        raise HeaderError(f"names that Fortran cannot distinguish: {sorted(twice)}")
    return api
