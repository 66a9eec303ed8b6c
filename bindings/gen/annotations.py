"""The tags in the comments of the header. They and the declarations are all that code is generated from; prose goes into
documentation alone. bindings/README.md says how they are written.

    @shape out (n, d), table (m, jam_x_column)    of a function: shape of every array
    @enum kind jam_x, form jam_y                  of a function: whose values an argument takes
    @bool weighted                                of a function: arguments that are 1 or 0
    @optional fraction                            of a function: last arguments that may be left out, then 0
    @errors STATE (why), IO                       of a function: beside the common errors
    @enum jam_x, @bool                            of a member, anywhere in its comment
"""
import re

FUNCTION_TAGS = ("shape", "enum", "bool", "optional", "errors", "since")


class HeaderError(Exception):
    """The header has something that the rules of the project do not foresee."""


def _clean(comment):
    lines = [re.sub(r"^\s*\*? ?", "", line).rstrip() for line in comment.strip().splitlines()]
    return "\n".join(lines).strip()


def comments(text):
    """Doc comments by name: functions and types from the comment above, members and items from the one behind."""
    docs = {}
    comment = r"/\*((?:(?!\*/).)*)\*/\s*"
    for m in re.finditer(
        comment + r"(?:JAM_API\s[^;(]*?\b(jam_\w+)\s*\(|typedef (?:struct|enum) (jam_\w+)|"
        r"typedef [^;(]*\(\*(jam_\w+)\)|typedef \w+ (jam_\w+);)",
        text,
        re.S,
    ):
        docs[next(g for g in m.groups()[1:] if g)] = _clean(m.group(1))
    for m in re.finditer(r"typedef (struct|enum) (jam_\w+) \{(.*?)\n\}", text, re.S):
        pattern = r"\b(\w+(?:, \w+)*);" if m.group(1) == "struct" else r"\b(JAM_\w+)\s*=\s*-?\d+,?"
        for item in re.finditer(pattern + r"[ \t]*/\*((?:(?!\*/).)*)\*/", m.group(3), re.S):
            names, said = item.group(1).split(", "), " ".join(_clean(item.group(2)).split())
            parts = said.split("; ")
            if len(names) > 1 and len(parts) not in (1, len(names)):
                raise HeaderError(f"{m.group(2)}: {item.group(1)} share a comment of {len(parts)} parts: {said}")
            docs.update(zip(((m.group(2), n) for n in names), parts * len(names) if len(parts) == 1 else parts)
                        if len(names) > 1 else {(m.group(2), names[0]): said}.items())
    return docs


def _pairs(text, pattern, what):
    found = re.findall(pattern, text)
    if re.sub(pattern, "", text).replace(",", "").strip():
        raise HeaderError(f"{what} is not understood: {text}")
    return found


def of_function(name, comment):
    """(prose, {array: (extents)}, {argument: enum}, [argument that is a flag], [argument that may be left out], [(error, why)])."""
    parts = re.split(r"\s*@(\w+)\s+", " ".join(comment.split()))
    tags = dict(zip(parts[1::2], parts[2::2]))
    unknown = [t for t in parts[1::2] if t not in FUNCTION_TAGS or parts[1::2].count(t) > 1]
    if unknown:
        raise HeaderError(f"{name}: @{unknown[0]} is unknown or stands twice")
    shapes = _pairs(tags.get("shape", ""), r"(\w+) \(([^()]*)\)", f"{name}: @shape")
    enums = _pairs(tags.get("enum", ""), r"(\w+) (jam_\w+)", f"{name}: @enum")
    errors = _pairs(tags.get("errors", ""), r"\b([A-Z_]+)(?: \(([^()]*)\))?", f"{name}: @errors")
    bools, optional = (tags[t].split(", ") if t in tags else [] for t in ("bool", "optional"))
    prose = re.split(rf"\s*@(?:{'|'.join(FUNCTION_TAGS)})\b", comment)[0]
    return prose, {a: tuple(e.strip() for e in s.split(",")) for a, s in shapes}, dict(enums), bools, optional, errors


def of_member(name, comment):
    """(readable comment, its enum or None, whether it is 0 or 1)."""
    tags = re.findall(r"@(\w+)", comment)
    if [t for t in tags if t not in ("enum", "bool")] or len(tags) > 1:
        raise HeaderError(f"{name}: a member has one tag, @enum jam_x or @bool, not {comment}")
    enum = re.search(r"@enum (jam_\w+)", comment)
    return re.sub(r"@bool\b", "1:", comment.replace("@enum ", "")), enum and enum.group(1), "@bool" in comment


def readable(f):
    """The comment of a function for people who read it in another language: tags in words."""
    shapes = ", ".join(f"{a} ({', '.join(e)})" for a, e in f.shapes.items())
    errors = ", ".join(f"JAM_E_{e}" + (f" ({why})" if why else "") for e, why in f.errors)
    tail = [f"Shapes: {shapes}."] * bool(shapes) + [f"Errors: {errors}."] * bool(errors)
    return "\n".join([f.prose] * bool(f.prose) + tail)


def check(api):
    """Refuses tags that do not fit the declarations, and declarations that lack a tag."""
    enums = {e.name for e in api.enums}
    for s in api.structs:
        for m in s.members:
            if m.enum and m.enum not in enums:
                raise HeaderError(f"{s.name}.{m.name}: there is no enum {m.enum}")
            named = [w for w in re.findall(r"jam_\w+", m.doc) if w in enums]
            if m.type == "int32_t" and named and not m.enum:
                raise HeaderError(f"{s.name}.{m.name} names {named[0]}: write @enum {named[0]}")
            if m.type != "int32_t" and (m.enum or m.bool):
                raise HeaderError(f"{s.name}.{m.name}: only an int32_t holds an enum or a bool")
    for f in api.functions:
        arrays = [a.name for a in f.args if a.role in ("array_in", "array_out")]
        if sorted(arrays) != sorted(f.shapes):
            raise HeaderError(f"{f.name}: @shape has {sorted(f.shapes)}, and its arrays are {sorted(arrays)}")
        for a, e in f.enums.items():
            if e not in enums or not any(b.name == a and b.role == "scalar" for b in f.args):
                raise HeaderError(f"{f.name}: @enum {a} {e} names no argument or no enum")
        for a in f.bools:
            if not any(b.name == a and b.role == "scalar" and b.type.base == "int32_t" for b in f.args):
                raise HeaderError(f"{f.name}: @bool {a} names no argument of type int32_t")
        last = [b.name for b in f.args if b.role == "scalar"]
        if f.optional != last[len(last) - len(f.optional) :]:
            raise HeaderError(f"{f.name}: @optional {', '.join(f.optional)} are not its last numbers, {', '.join(last)}")
        for a, extents in f.shapes.items():
            if (a == "table") != (extents[-1] in enums):
                raise HeaderError(f"{f.name}: the last extent of a table, and of no other array, is the enum of its columns")
        if "table" in f.shapes:
            if not any(a.role == "columns" for a in f.args):
                raise HeaderError(f"{f.name}: `int32_t columns` stands before its table")
            name, number = count_of_columns(columns_of(f, api))
            if dict(api.constants).get(name) != number:
                raise HeaderError(f"{f.name}: its table has {number} columns, so write #define {name} {number}")


def count_of_columns(e):
    """Name and value of the constant with the number of columns of such an enum."""
    return f"JAM_{e.items[0][0].split('_')[1]}_COLUMNS", len(e.items)


def columns_of(f, api):
    """Of a function that fills a `table`: the enum of its columns."""
    return api.enum(f.shapes["table"][-1]) if "table" in f.shapes else None


def last_extent(f, a, api):
    """Last extent of an array of rank 2 and more where it is known before the call: "d", "n" or a number. It is the first
    extent of the Fortran array."""
    extents = f.shapes[a.name]
    if len(extents) > 1 and (extents[-1] in ("d", "n") or extents[-1].isdigit()):
        return int(extents[-1]) if extents[-1].isdigit() else extents[-1]
    return None


def stripped(text):
    """The header with comments of which only the tags are left: it must generate the same code."""

    def tags(found):
        inner = " ".join(re.sub(r"\n\s*\* ?", " ", found.group(1)).split())
        if found.start() and text[found.start() - 1] != "\n":  # of a member, or of several that share it
            parts = [" ".join(re.findall(r"@enum jam_\w+|@bool\b", part)) or "-" for part in inner.split("; ")]
            return f"/* {'; '.join(parts)} */"
        start = re.search(r"@(?:shape|enum|bool|optional|errors) (?!jam_)", inner)
        return f"/* {inner[start.start() :] if start else ''} */"

    return re.sub(r"/\*((?:(?!\*/).)*)\*/", tags, text, flags=re.S)
