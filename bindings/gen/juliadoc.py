"""Comments of the header as Julia's docstrings: Markdown in which no name is mangled, and Julia's own words."""
import re
import textwrap

from model import item_names

# Of an array or a number that the caller asks for, the call fills in lengths itself.
DROPPED = r"[,;.]? ?\*(?:rows|needed) = (?:their number )?\w+(?:\^\d)?(?: \w+)?(?=[:;.,])"


# Functions that change their system; their names end in ! in Julia.
CHANGING = frozenset("""run compress crunch relax shear decompress monte_carlo contacts_from_geometry observe stop_observing add_note strain
    set_positions set_velocities set_cell scale_diameters set_memory_limit""".split())
OTHER_NAMES = {"create": "System", "read": "System", "get_crunch_report": "report", "get_info": "info", "write_checkpoint": "checkpoint",
               "read_checkpoint": "from_checkpoint", "check_packing": "judge", "diameters": "sizes", "crunch_history": "history",
               "write_page": "page", "get_cell": "cell", "view_positions": "positions", "view_velocities": "velocities",
               "decompress_history": "soft_history"}


def julia_name(name):
    """A function of C as Julia calls it."""
    short = OTHER_NAMES.get(name.removeprefix("jam_"), name.removeprefix("jam_").removeprefix("get_"))
    return short + "!" * (short in CHANGING)


def enum_name(name):
    return name.removeprefix("jam_")


def word_of(item):
    """An item's name without its prefix as a word: E_OVERLAP of the statuses is overlap."""
    return item.lower().removeprefix("e_")


def escaped(text):
    """Text for a Julia string with Markdown in it: names with underscores become code, no star or dollar has a meaning."""
    parts = re.split(r"(`[^`]*`)", text.replace("_*", "_..."))
    for k in range(0, len(parts), 2):
        parts[k] = re.sub(r"(?<!\w)(\*?(?:\w+\.)*\w*_\w+(?:\(\))?|\*\w+)", r"`\1`", parts[k])
    joined = "".join(p if p.startswith("`") else p.replace("*", "×") for p in re.split(r"(`[^`]*`)", "".join(parts)))
    return joined.replace("\\", "\\\\").replace("$", "\\$").replace('"""', "'''")


def raw(signature, text):
    """The docstring of something of the raw layer: C's comment under its name."""
    return f'"""\n    {signature}\n' + (f"\n{escaped(text)}\n" if text else "") + '"""\n'


def member_text(m, api):
    """What a member is, its enum's items as words."""
    if not m.enum:
        return cleaned(m.doc.replace("1: ", "", 1) if m.bool else m.doc, api)
    items = "|".join(sorted(item_names(api.enum(m.enum)), key=len, reverse=True))
    text = re.sub(r"^jam_\w+,? ?", "", m.doc)
    return cleaned(re.sub(rf"\b(?<!JAM_)({items})\b", lambda k: f"`:{word_of(k.group())}`", text), api)


def member_row(m, api):
    kind = f"one of {choices(m.enum, api)}; " if m.enum else "Bool; " if m.bool else ""
    return f"`{m.name}`: {kind}{member_text(m, api)}".rstrip("; ")


def struct(s, api):
    """The docstring of a struct: C's comment, and its members with the words that they take."""
    first, *notes = s.doc.split("\n- ")
    lines = wrapped(cleaned(first, api))
    for rows in (notes, s.shown):
        lines += [""] * bool(rows)
        for row in rows:
            lines += wrapped(cleaned(row, api) if isinstance(row, str) else member_row(row, api), "- ")
    return f'"""\n    {s.name}\n\n' + "\n".join(lines) + '\n"""\n'


def spoken(text, api):
    """Names of C as Julia has them."""
    items, functions = api.words, {f.name for f in api.functions}
    text = re.sub(r"\bJAM_E_(\w+)", lambda m: f"an error `:{m.group(1).lower()}`", text)
    text = re.sub(r"\bJAM_[A-Z_0-9]+\b", lambda m: f"`:{word_of(items[m.group()])}`" if m.group() in items else m.group(), text)
    text = re.sub(r"\bjam_\w+", lambda m: f"`{julia_name(m.group())}`" if m.group() in functions else m.group(), text)
    return text.replace("NULL", "`nothing`")


def cleaned(text, api):
    text = re.sub(DROPPED, "", " ".join(text.split()))
    return escaped(" ".join(spoken(text, api).split()))


def wrapped(text, indent=""):
    return textwrap.wrap(text, 118, initial_indent=indent, subsequent_indent="  " if indent else "", break_long_words=False)


def choices(enum, api):
    return ", ".join(f"`:{word_of(n)}`" for n in item_names(api.enum(enum)))


def docstring(signature, f, members, indices, api):
    """members: of the option structs, which are keywords; indices: arrays and numbers that count from 1."""
    lines = ["    " + signature, ""] + wrapped(cleaned(f.prose, api))
    rows = [f"`{a}`: one of {choices(e, api)}" for a, e in f.enums.items()]
    for a, extents in f.shapes.items():
        if a == "table":
            continue
        extent = ", ".join(reversed(extents))
        rows.append(f"`{a}`: array `({extent})`" + (", indices from 1" if a in indices else ""))
    rows += [f"`{a}`: counts from 1" for a in indices if a not in f.shapes]
    rows += [member_row(m, api) for m in members]
    if f.errors:
        rows.append("errors: " + ", ".join(f"`:{e.lower()}`" + (f" ({cleaned(why, api)})" if why else "") for e, why in f.errors))
    if rows:
        lines.append("")
        for row in rows:
            lines += wrapped(row, "- ")
    return '"""\n' + "\n".join(line.rstrip() for line in lines) + '\n"""\n'
