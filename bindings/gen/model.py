"""Reads the public header into plain objects: `swig -xml` gives the declarations, the header text the comments.

Everything that is generated starts from here, so this file holds the one table of types and the one place where the
header's argument conventions (name + name_len, needed, view, options, callbacks) are recognised.
"""
import subprocess
import tempfile
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field
from pathlib import Path

import annotations
from annotations import HeaderError

# ctype: (bytes, Julia, Fortran, Python, numpy). Alignment equals size for all of them on LP64.
TYPES = {
    "double": (8, "Cdouble", "real(c_double)", "float", "float64"),
    "int32_t": (4, "Int32", "integer(c_int32_t)", "int", "int32"),
    "uint32_t": (4, "UInt32", "integer(c_int32_t)", "int", "uint32"),
    "int64_t": (8, "Int64", "integer(c_int64_t)", "int", "int64"),
    "uint64_t": (8, "UInt64", "integer(c_int64_t)", "int", "uint64"),
    "size_t": (8, "Csize_t", "integer(c_size_t)", "int", "uint64"),
    "char": (1, "Cchar", "character(kind=c_char)", "str", None),
    "pointer": (8, "Ptr{Cvoid}", "type(c_ptr)", None, None),  # of a struct, as is the next
    "callback": (8, "Ptr{Cvoid}", "type(c_funptr)", None, None),
}
ALIASES = {"jam_status": "int32_t"}  # typedefs of scalars in the header
HANDLE = "jam_system"


@dataclass
class Type:
    base: str  # "double", "jam_crunch_report", "void", ...
    stars: int  # levels of pointer
    const: bool  # of what is pointed to (or of the innermost)

    @property
    def scalar(self):
        return ALIASES.get(self.base, self.base)

    def c(self):
        return ("const " if self.const else "") + self.base + " " + "*" * self.stars


@dataclass
class Arg:
    name: str
    type: Type
    role: str = ""  # see classify()


@dataclass
class Function:
    name: str
    result: Type
    args: list
    doc: str = ""  # as people read it, with its tags in words
    prose: str = ""
    shapes: dict = field(default_factory=dict)  # {array: extents}
    enums: dict = field(default_factory=dict)  # {argument: enum}
    bools: list = field(default_factory=list)  # arguments that are 1 or 0
    optional: list = field(default_factory=list)  # last arguments that may be left out, then 0
    errors: list = field(default_factory=list)  # (name without JAM_E_, why)

    @property
    def roles(self):
        return {a.role for a in self.args}

    @property
    def on_system(self):
        return bool(self.args) and self.args[0].role == "handle"

    @property
    def changes(self):
        """Whether the system may be another one afterwards."""
        return self.on_system and not self.args[0].type.const

    @property
    def given(self):
        """The arguments beside the system."""
        return self.args[1:] if self.on_system else self.args

    @property
    def plain(self):
        """What a caller gives in the order of C; members of option structs are keywords."""
        return [a for a in self.given if a.role in ("scalar", "string", "array_in", "handle")]

    @property
    def counter(self):
        """What says how much the arrays that are filled hold."""
        return next((a for a in self.args if a.role == "scalar_out" and a.name in ("needed", "rows")), None)

    @property
    def outputs(self):
        results = ("array_out", "struct_out", "scalar_out")
        return [a for a in self.args if a.role in results and a.name not in ("needed", "rows")]

    @property
    def reports(self):
        """A call that works on a system and gives something back may take long; a setter gives nothing."""
        return self.changes and bool(self.roles & {"array_out", "struct_out"})

    def may_be_left_out(self, a):
        """An array that stands behind all that a call on a system needs."""
        behind = self.plain[self.plain.index(a) :]
        return self.on_system and all(b.role == "array_in" for b in behind)


@dataclass
class Member:
    name: str
    type: str
    offset: int = 0
    doc: str = ""
    enum: str = None  # whose values it takes
    bool: bool = False


@dataclass
class Struct:
    name: str
    members: list
    size: int = 0
    doc: str = ""

    @property
    def has_pointers(self):
        """Each language fills such a struct by hand, from arrays of its own."""
        return any(m.type in ("pointer", "callback") for m in self.members)

    @property
    def shown(self):
        """The members that a user sets or reads."""
        return [m for m in self.members if not m.name.startswith(("struct_size", "reserved"))]


@dataclass
class Enum:
    name: str
    items: list  # (name, value, doc)
    doc: str = ""


@dataclass
class Callback:
    name: str
    result: Type
    args: list
    doc: str = ""


@dataclass
class Api:
    constants: list = field(default_factory=list)  # (name, value)
    enums: list = field(default_factory=list)
    structs: list = field(default_factory=list)
    callbacks: list = field(default_factory=list)
    functions: list = field(default_factory=list)

    def struct(self, name):
        return next((s for s in self.structs if s.name == name), None)

    def enum(self, name):
        return next((e for e in self.enums if e.name == name), None)

    @property
    def words(self):
        """{item of an enum: its name without what all of them have in common}"""
        return {c: n for e in self.enums for n, (c, _, _) in zip(item_names(e), e.items)}

    @property
    def inits(self):
        """{struct: init function} of the option structs."""
        functions = {f.name for f in self.functions}
        return {s.name: s.name + "_init" for s in self.structs if s.name + "_init" in functions}

    @property
    def calls(self):
        """Functions with a status that follow the header's conventions alone: on a system, or formulas that need none."""
        apart = {"callback", "new_handle", "view"}
        inits = self.inits.values()
        return [f for f in self.functions if f.result.base == "jam_status" and f.name not in inits and not f.roles & apart]

    def members(self, f):
        """Members of all option structs of a call: its keywords."""
        return [m for a in f.args if a.role == "struct_in" for m in self.struct(a.type.base).shown]


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


def item_names(e):
    """Names of an enum's items without what they have in common."""
    names = [n for n, _, _ in e.items]
    prefix = names[0][: names[0].rindex("_") + 1]
    while not all(n.startswith(prefix) for n in names):
        prefix = prefix[: prefix.rstrip("_").rindex("_") + 1]
    return [n[len(prefix) :] for n in names]
