"""Comments of the header as docstrings that Python users expect: numpydoc sections, shapes, Python's names."""
import re
import textwrap

from emit_python import camel
from juliadoc import DROPPED
from model import item_names


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
    words, functions = api.words, {f.name for f in api.functions}
    text = re.sub(r"\bJAM_E_(\w+)", lambda m: camel(m.group(1).lower()) + "Error", text)
    text = re.sub(r"\bJAM_[A-Z_]+\b", lambda m: repr(words[m.group()].lower()) if m.group() in words else m.group(), text)

    def named(m):
        word = m.group()
        return camel(word) if api.enum(word) else word.removeprefix("jam_") + "()" * (word in functions)

    text = re.sub(r"\bjam_\w+", named, text)
    return re.sub(r"\*(?=[a-z])", "", text).replace("NULL", "None")


def cleaned(doc, api):
    text = re.sub(DROPPED, "", " ".join(doc.split()))
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
