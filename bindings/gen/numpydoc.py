"""Comments of the header as docstrings that Python users expect: numpydoc sections, shapes, Python's names."""
import re
import textwrap

from emit_python import camel
from model import item_names

# Of an array or a number that the caller asks for, Python fills in lengths itself.
DROPPED = (
    r"[,;.]? ?\*(?:rows|needed) = (?:their number )?\w+(?:\^\d)?(?: \w+)?(?=[:;.,])",
)


def errors(f):
    """Names of Python's exceptions that a call can raise: by its arguments, those of its comment, and those of work."""
    roles = {a.role for a in f.args}
    names = ["ARGUMENT"] * bool(roles & {"scalar", "array_in", "struct_in"})
    names += ["NONFINITE"] * any(a.role == "array_in" and a.type.base == "double" for a in f.args)
    names += [e for e, _ in f.errors]
    names += ["MEMORY", "BUSY"] * any(a.role == "handle" and not a.type.const for a in f.args)
    return [camel(n.lower()) + "Error" for n in names]


def spoken(text, api):
    """Names of C as Python has them."""
    enums = {e.name: camel(e.name) for e in api.enums}
    items = {f"JAM_{c.removeprefix('JAM_')}": n for e in api.enums for n, (c, _, _) in zip(item_names(e), e.items)}
    text = re.sub(r"\bJAM_E_(\w+)", lambda m: camel(m.group(1).lower()) + "Error", text)
    statuses = {f"JAM_{c.removeprefix('JAM_')}" for e in api.enums if e.name == "jam_status" for c, _, _ in e.items}
    text = re.sub(r"\bJAM_[A-Z_]+\b", lambda m: "StatusCode." + m.group()[4:] if m.group() in statuses else m.group(), text)
    text = re.sub(r"\bJAM_[A-Z_]+\b", lambda m: repr(items[m.group()].lower()) if m.group() in items else m.group(), text)
    functions = {f.name for f in api.functions}

    def named(m):
        word = m.group()
        if word in enums:
            return enums[word]
        return word.removeprefix("jam_") + ("()" if word in functions else "")

    text = re.sub(r"\bjam_\w+", named, text)
    return re.sub(r"\*(?=[a-z])", "", text).replace("NULL", "None")


def cleaned(doc, api):
    text = " ".join(doc.split())
    for pattern in DROPPED:
        text = re.sub(pattern, "", text)
    return re.sub(r"\s+([.,;:])", r"\1", " ".join(spoken(text, api).split()))


def shape(f, a):
    extents = f.shapes.get(a.name, ())
    if a.name == "table" or not extents:
        return ""
    return f", shape ({', '.join(extents)}{',' if len(extents) == 1 else ''})"


def choices(enum, api):
    for e in api.enums:
        if camel(e.name) == enum:
            return "{" + ", ".join(repr(n.lower()) for n in item_names(e)) + "}"
    return "int"


def wrapped(text, indent, width=118):
    return textwrap.wrap(text, width, initial_indent=indent, subsequent_indent=indent, break_long_words=False)


def section(name, rows, indent):
    """rows: (head, text)."""
    if not rows:
        return []
    lines = ["", indent + name, indent + "-" * len(name)]
    for head, text in rows:
        lines.append(indent + head)  # numpydoc wants it on one line
        lines += wrapped(text, indent + "    ") if text else []
    return lines


def docstring(doc, api, indent, parameters=(), returns=(), raises=()):
    text = cleaned(doc, api)
    first = re.match(r".*?[a-z)\]]\.(?= |$)(?<!e\.g\.)(?<! J\.)(?<! al\.)", text)
    head = first.group() if first else text
    rest = text[len(head) :].strip()
    lines = wrapped(head, indent)
    lines += [""] + wrapped(rest, indent) if rest else []
    lines += section("Parameters", parameters, indent) + section("Returns", returns, indent)
    lines += section("Raises", [(", ".join(raises), "")] if raises else [], indent)
    body = "\n".join(line.rstrip() for line in lines).strip().replace("\\", "\\\\").replace('"""', "'''")
    return f'{indent}"""{body}' + ("\n" + indent if "\n" in body else "") + '"""'
