"""What the public header says, as plain objects: the one table of types, and what each language asks of a call."""
from dataclasses import dataclass, field

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


def item_names(e):
    """Names of an enum's items without what they have in common."""
    names = [n for n, _, _ in e.items]
    prefix = names[0][: names[0].rindex("_") + 1]
    while not all(n.startswith(prefix) for n in names):
        prefix = prefix[: prefix.rstrip("_").rindex("_") + 1]
    return [n[len(prefix) :] for n in names]
