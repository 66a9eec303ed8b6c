"""JavaScript's tables: words of the enums, structs as WebAssembly lays them out, the arguments of each call."""
import json
import re
from pathlib import Path

from annotations import HeaderError, columns_of
from juliadoc import DROPPED, word_of
from model import TYPES, item_names

MADE = "// Made by bindings/gen/emit_js.py from include/jam/jam.h, in each build.\n"
TYPES_BY_HAND = Path(__file__).parents[1] / "js/types.d.ts.in"
POINTER = 4  # bytes of a pointer and of size_t in WebAssembly
WIDTHS = {"pointer": POINTER, "callback": POINTER, "size_t": POINTER}


def js_name(name):
    """snake_case as JavaScript writes it, without what all names begin with."""
    head, *rest = name.removeprefix("jam_").split("_")
    return head + "".join(word.capitalize() for word in rest)


def class_name(name):
    text = js_name(name)
    return text[0].upper() + text[1:]


def call_name(f):
    """Calls that give what the handle keeps are named after it."""
    name = f.name.removeprefix("jam_").removeprefix("get_")
    return js_name({"check_packing": "check"}.get(name, name))


def _layout(struct):
    at, rows = 0, []
    for m in struct.members:
        size = WIDTHS.get(m.type, TYPES[m.type][0])
        at += -at % size
        if m in struct.shown:
            rows.append([js_name(m.name), at, m.type, m.enum or ("bool" if m.bool else "")])
        at += size
    return at + -at % max(WIDTHS.get(m.type, TYPES[m.type][0]) for m in struct.members), rows


def calls(api):
    """The functions that are called by the header's conventions alone."""
    for f in api.calls:
        if any(a.role == "array_out" and a.type.base not in TYPES for a in f.args):
            raise HeaderError(f"{f.name}: arrays of structs have no rule in JavaScript yet")
    return api.calls


def nested(f, api):
    """{argument: key}: option structs that share names with one before are objects of their own among the options."""
    seen, keys = set(), {}
    for a in f.args:
        if a.role == "struct_in":
            names = {m.name for m in api.struct(a.type.base).shown}
            if names & seen:
                keys[a.name] = js_name(a.type.base.removesuffix("_options"))
            seen |= names
    return keys


def is_file(a):
    return a.role == "string" and a.name == "path"


def _kind(f, a):
    if a.name in f.enums:
        return f.enums[a.name]
    return "bool" if a.name in f.bools else "optional" if a.name in f.optional else ""


def _argument(f, a, api):
    base = a.type.base if api.struct(a.type.base) else a.type.scalar
    kind = nested(f, api).get(a.name, "") if a.role == "struct_in" else _kind(f, a)
    name = "options" if a.role == "struct_out" and base.endswith("_options") else js_name(a.name)
    return [name, "file" if is_file(a) else a.role, base, list(f.shapes.get(a.name, ())), kind]


def emit(api):
    """api.mjs"""
    rows = {}
    for f in calls(api):
        table = columns_of(f, api)
        rows[call_name(f)] = {
            "c": f.name, "system": f.on_system, "fixed": not f.changes, "args": [_argument(f, a, api) for a in f.given],
            **({"columns": [js_name(n.lower()) for n in item_names(table)]} if table else {}),
        }
    out = [MADE]

    def table(name, doc, pairs):
        out.append(f"// {doc}\nexport const {name} = {{")
        out.extend(f"  {key}: {json.dumps(value)}," for key, value in pairs)
        out.append("};")

    table("WORDS", "Words of each enum.", [(e.name, {word_of(n): v for n, (_, v, _) in zip(item_names(e), e.items)}) for e in api.enums])
    layouts = {s.name: _layout(s) for s in api.structs}
    table("STRUCTS", "Bytes of each struct, and of each member its name, place, type and what its numbers mean.",
          [(s, {"size": size, "members": members}) for s, (size, members) in layouts.items()])
    table("DEFAULTS", "What fills option structs.", api.inits.items())
    table("CALLS", "Arguments in C's order: name, role, type, extents, what its numbers mean.", rows.items())
    return "\n".join(out) + "\n"


# ---- index.d.ts

NUMBER = {"double": "Float64Array", "int32_t": "Int32Array", "int64_t": "Float64Array"}


def _text(doc, api):
    """C's comment with JavaScript's names."""
    functions = {f.name: call_name(f) for f in api.functions}
    structs = {s.name: class_name(s.name) for s in api.structs}
    words = {c: word_of(n) for c, n in api.words.items()}
    text = re.sub(DROPPED, "", " ".join(doc.split()))
    text = re.sub(r"\bJAM_E_(\w+)", lambda m: f"a JamError '{m.group(1).lower()}'", text)
    text = re.sub(r"\bJAM_[A-Z_0-9]+\b", lambda m: f"'{words[m.group()]}'" if m.group() in words else m.group(), text)
    text = re.sub(r"\bjam_\w+", lambda m: functions.get(m.group()) or structs.get(m.group()) or js_name(m.group()), text)
    return text.replace("NULL", "null").replace("*/", "* /").strip()


def _doc(lines, indent=""):
    lines = [line for line in lines if line.strip()]
    return [] if not lines else [f"{indent}/** {lines[0]}", *(f"{indent} * {line}" for line in lines[1:])][:-1] + [
        (f"{indent}/** {lines[0]}" if len(lines) == 1 else f"{indent} * {lines[-1]}") + " */"]


def _member(m):
    return class_name(m.enum) if m.enum else "boolean" if m.bool else "number"


def _input(f, a):
    if a.name in f.enums:
        return class_name(f.enums[a.name])
    return {"handle": "Packing", "string": "string", "array_in": "Numbers | null"}.get(a.role, "boolean" if a.name in f.bools else "number")


def _output(a):
    return NUMBER[a.type.scalar] if a.role == "array_out" else class_name(a.type.base) if a.role == "struct_out" else "number"


def optional_from(args, f):
    """From which of its plain arguments on a call may leave them out: arrays, enums (then the first value), flags."""
    at = len(args)
    while at and (args[at - 1].role == "array_in" or _kind(f, args[at - 1])):
        at -= 1
    return at


def _result(f, api):
    given, table = f.outputs, columns_of(f, api)
    fields = [("bytes", "Uint8Array")] if any(is_file(a) for a in f.args) else []
    if table:
        fields += [(js_name(n.lower()), "Float64Array") for n in item_names(table)]
        fields += [(js_name(a.name), _output(a)) for a in given if a.name != "table"]
        return "{ " + "; ".join(f"{n}: {t}" for n, t in fields) + " }"
    fields += [("options" if a.type.base.endswith("_options") else js_name(a.name), _output(a)) for a in given]
    return "this" if not fields else fields[0][1] if len(fields) == 1 else "{ " + "; ".join(f"{n}: {t}" for n, t in fields) + " }"


def _method(f, api):
    args, apart = f.plain, nested(f, api)
    structs = [a for a in f.args if a.role == "struct_in"]
    at = optional_from(args, f)
    head = [f"{js_name(a.name)}{'?' if k >= at else ''}: {_input(f, a)}" for k, a in enumerate(args)]
    if structs or f.on_system:
        kinds = [f"{{ {apart[a.name]}?: {class_name(a.type.base)} }}" if a.name in apart else class_name(a.type.base) for a in structs]
        head.append("options?: " + " & ".join(kinds + ["Progressing"] * f.on_system))
    shapes = [f"{js_name(a)}: shape ({', '.join(e)}), flat." for a, e in f.shapes.items() if a != "table"]
    return _doc([_text(f.prose, api), *shapes], "  ") + [f"  {call_name(f)}({', '.join(head)}): {_result(f, api).replace('this', 'this' if f.on_system else 'void')};"]


def emit_types(api):
    """index.d.ts, which begins with what is written by hand."""
    inits, out = api.inits, [TYPES_BY_HAND.read_text(), MADE]
    for e in api.enums:
        out += _doc([_text(e.doc, api), *(f"- '{word_of(n)}': {_text(d, api)}" for n, (_, _, d) in zip(item_names(e), e.items))])
        out.append(f"export type {class_name(e.name)} = " + " | ".join(f"'{word_of(n)}'" for n in item_names(e)) + ";")
    for s in api.structs:
        if s.has_pointers:
            continue
        given = s.name in inits
        out += _doc([_text(s.doc, api)]) + [f"export interface {class_name(s.name)}{'' if given else ' extends Report'} {{"]
        for m in s.shown:
            if m.name == "status" and not given:
                continue
            out += _doc([_text(m.doc, api)], "  ")
            big = " | bigint" if m.type == "int64_t" and given else ""
            out.append(f"  {js_name(m.name)}{'?' if given else ''}: {_member(m)}{big};")
        out.append("}")
    for head, wanted in (("Methods", True), ("FreeCalls", False)):
        out.append(f"export interface {head} {{")
        for f in calls(api):
            if f.on_system is wanted and f.name != "jam_write_checkpoint":  # checkpoint()
                out += _method(f, api)
        out.append("}")
    return "\n".join(out) + "\n"
