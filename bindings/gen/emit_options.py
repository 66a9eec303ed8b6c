"""What is made from the table of options: the parser and help of jam-pack, completion of bash and zsh, the page of the guide."""
import re
import textwrap

from option import STAGES, START, usage
from options import ABOUT, EXAMPLE, NOTES, options

MADE = "made by bindings/gen/generate.py from bindings/gen/options.py; do not edit"
OWN_FORM = ("stage", "sizes", "cell")  # kinds whose values have a form of their own
COLUMN = 25  # where the help begins what it says of an option


def _wrapped(text, width):
    """Lines of the text. An option such as --no-crunch stays whole."""
    return textwrap.wrap(text, width, break_on_hyphens=False)


def help_text():
    """Lines, those of options that need a host behind a tab, and how many come before the options."""
    lines = ["Usage: jam-pack [options]", *_wrapped(ABOUT, 80), "", "Example: jam-pack " + EXAMPLE, ""]
    head_lines = len(lines)
    for section, rows in options(host=True):
        lines.append(section)
        for o in rows:
            said = _wrapped(o.help, 92 - COLUMN)
            head = "  " + usage(o)
            if len(head) < COLUMN - 1:
                text = [head.ljust(COLUMN) + said.pop(0)]
            else:
                text = [head]
            lines += ["\t" * o.host + line for line in text + [" " * COLUMN + line for line in said]]
    for note in NOTES:
        lines += ["", *_wrapped(note, 92)]
    return head_lines, lines


C_TYPES = {
    "switch": "int",
    "integer": "int64_t",
    "choice": "int64_t",
    "text": "const char *",
    "input": "const char *",
    "output": "const char *",
}


def _c_default(o):
    if o.kind == "choice":
        return str(o.words.index(o.default))
    if o.kind == "integer":
        return "NOT_GIVEN" if o.default is None else str(o.default)
    if o.kind in ("positive", "not_negative", "pressure", "delta", "fraction"):
        return "INFINITY" if o.default is None else repr(o.default)
    return None


def emit_c(_api):
    rows = [o for _, section in options(host=True) for o in section if o.kind != "help"]
    fields = "\n".join(
        f"  {C_TYPES.get(o.kind, 'double')}{'' if 'char' in C_TYPES.get(o.kind, '') else ' '}{o.field};"
        for o in rows
        if o.kind not in OWN_FORM
    )
    table, defaults = [], []
    for o in rows:
        place = "0" if o.kind in OWN_FORM else f"offsetof(options, {o.field})"
        low, high = (o.low, o.high) if o.kind == "integer" else (0, 0)
        words = '"' + " ".join(o.words) + '"' if o.words else "NULL"
        flags = " | ".join([f for f, on in (("AFTER_CRUNCH", o.after_crunch), ("TAKES_STDOUT", o.stdout), ("NEEDS_HOST", o.host)) if on]) or "0"
        without, needs = ('"' + " ".join("--" + name for name in names) + '"' for names in (o.without, o.needs))
        table.append(
            f'    {{"--{o.name}", TAKE_{o.kind.upper()}, {place}, {low}, {high}, {words}, {flags},\n'
            f"     {without}, {needs}}},"
        )
        if _c_default(o):
            defaults.append(f"    .{o.field} = {_c_default(o)},")
    head_lines, lines = help_text()
    said = "\n".join('    "' + line.replace("\\", "\\\\").replace('"', '\\"').replace("\t", "\\t") + '",' for line in lines)
    stages = ", ".join(f"{{{growth!r}, {pressure!r}}}" for growth, pressure in STAGES)
    kinds = ",\n  ".join(f"TAKE_{k.upper()}" for k in dict.fromkeys(o.kind for o in rows))
    return f"""/* The options of jam-pack: {MADE}. */
/* clang-format off */
#ifndef JAM_PACK_OPTIONS_TABLE_H
#define JAM_PACK_OPTIONS_TABLE_H

/* Numbers that were not given are INFINITY, integers NOT_GIVEN. */
typedef struct options {{
{fields}
  given given; /* what has a form of its own */
}} options;

/* Packing fraction of a random start by default. */
#define START_FRACTION(dim) ldexp({START[0]!r}, (dim) > {START[1]} ? {START[1]} - (int)(dim) : 0)

#ifdef JAM_PACK_OPTIONS_TABLE
enum {{
  {kinds}
}};
enum {{ AFTER_CRUNCH = 1, TAKES_STDOUT = 2, NEEDS_HOST = 4 }};
enum {{ HELP_HEAD = {head_lines} }}; /* lines of the help before the options */

typedef struct option_row {{
  const char *name;
  int kind;
  size_t place; /* in options */
  int64_t low, high;
  const char *words;
  int flags;
  const char *without, *needs; /* names of options, with which and without which it has no effect */
}} option_row;

static const option_row table[] = {{
{chr(10).join(table)}
}};

static const options defaults = {{
{chr(10).join(defaults)}
}};

/* Stages of growth where --growth is not given; the last one goes to --pressure. */
static const stage default_stages[] = {{{stages}}};

static const char *const help[] = {{
{said}
    NULL}};
#endif
#endif
"""


def _completed(host=False):
    return [o for _, rows in options(host) for o in rows]


def emit_bash(_api):
    rows = _completed()
    words = " ".join("--" + o.name for o in rows)
    choices = "".join(
        f"    --{o.name}) COMPREPLY=($(compgen -W '{' '.join(o.words)}' -- \"$word\")); return ;;\n"
        for o in rows
        if o.words
    )
    files = "|".join("--" + o.name for o in rows if o.kind in ("input", "output", "sizes"))
    others = "|".join(
        "--" + o.name for o in rows if o.kind not in ("switch", "help", "choice", "input", "output", "sizes")
    )
    return f"""# Completion of jam-pack for bash: {MADE}.
_jam_pack() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}}
  COMPREPLY=()
  case $before in
{choices}    {files}) COMPREPLY=($(compgen -f -- "$word")); return ;;
    {others}) return ;;
  esac
  COMPREPLY=($(compgen -W '{words}' -- "$word"))
}}
complete -o filenames -F _jam_pack jam-pack
"""


def emit_zsh(_api):
    lines = []
    for o in _completed():
        said = o.help.split(";")[0].replace("[", "(").replace("]", ")").replace(":", ",").replace("'", "")
        value = ""
        if o.words:
            value = f":{o.name}:({' '.join(o.words)})"
        elif o.kind in ("input", "output", "sizes"):
            value = f":{o.name}:_files"
        elif o.kind not in ("switch", "help"):
            value = f":{o.metavar.replace(':', ' ').replace('[', '').replace(']', '')}: "
        star = "*" if o.kind == "stage" else ""
        lines.append(f"  '{star}--{o.name}[{said}]{value}'")
    return f"#compdef jam-pack\n# Completion of jam-pack for zsh: {MADE}.\n_arguments \\\n" + " \\\n".join(lines) + "\n"


def _marked(text):
    """Options as code, since Markdown makes one dash of two."""
    return re.sub(r"(?<![`\w-])--[a-z][\w-]*", r"`\g<0>`", text).replace("|", "\\|")


def emit_page(_api):
    out = [
        f"<!-- {MADE} -->",
        "# The command line",
        "",
        *_wrapped(ABOUT, 120),
        "",
        "```sh",
        "jam-pack " + EXAMPLE,
        "python3 -m jam " + EXAMPLE,
        "```",
        "",
        "Both commands run the same code. Options of Python alone are marked; it also reads and writes `.gsd` files.",
        "",
    ]
    for section, rows in options(host=True):
        out += [f"## {section}", "", "| option | meaning |", "|---|---|"]
        for o in rows:
            mark = " (Python)" if o.host else ""
            out.append(f"| `{usage(o).replace('|', chr(92) + '|')}`{mark} | {_marked(o.help)} |")
        out.append("")
    out += ["## How it ends", ""]
    for note in NOTES:
        out += [*_wrapped(_marked(note), 120), ""]
    out += ["Completion for bash and zsh is installed with the program, and `man jam-pack` shows these lines.", ""]
    return "\n".join(out)
