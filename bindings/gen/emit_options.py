"""What is made from the table of options: the parser and help of jam-pack and completion of bash and zsh."""
import textwrap

from option import STAGES, START, usage
from options import ABOUT, EXAMPLE, NOTES, VERBS, options, verbs_of

MADE = "made by bindings/gen/generate.py from bindings/gen/options.py; do not edit"
OWN_FORM = ("stage", "sizes", "cell", "copies")  # kinds whose values have a form of their own
COLUMN = 25  # where the help begins what it says of an option


def wrapped(text, width=120):
    """Lines of the text. An option such as --no-crunch stays whole."""
    return textwrap.wrap(text, width, break_on_hyphens=False)


def _mask(names):
    """A bit a verb."""
    return sum(1 << k for k, v in enumerate(VERBS) if v.name in names)


def _column(head, said, width):
    """Lines of an item of the help: its head, and what is said of it in a column of its own."""
    said = wrapped(said, 92 - width)
    first = ["  " + head] if len(head) + 2 >= width - 1 else [("  " + head).ljust(width) + said.pop(0)]
    return first + [" " * width + line for line in said]


def help_text():
    """Lines as (verbs that show them, text), those of options that need a host behind a tab. Bits of no verb: the help of
    the whole program alone."""
    whole = 1 << len(VERBS)
    every = whole | _mask([v.name for v in VERBS])
    lines = [(whole, "Usage: jam-pack [VERB] [FILE] [options]")]
    lines += [(whole, line) for line in [*wrapped(ABOUT, 80), "", "Example: jam-pack " + EXAMPLE, "", "Verbs"]]
    for v in VERBS:
        lines += [(whole, line) for line in _column(v.usage, v.help, COLUMN)]
        lines += [(_mask([v.name]), line) for line in (f"Usage: jam-pack {v.usage} [options]", *wrapped(f"{v.name}: {v.help}.", 80), "")]
    lines.append((whole, f"jam-pack VERB --help shows the options of one verb."))
    lines.append((whole, ""))
    for section, rows in options(host=True):
        shown = {name for o in rows for name in verbs_of(o)} if section != "Other" else {v.name for v in VERBS}
        lines.append((whole | _mask(shown), section))
        for o in rows:
            verbs = every if o.kind == "help" else whole | _mask(verbs_of(o))
            lines += [(verbs, "\t" * o.host + line) for line in _column(usage(o), o.help, COLUMN)]
    for note in NOTES:
        lines += [(whole, line) for line in ["", *wrapped(note, 92)]]
    return lines


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
    members = {}  # of each type
    for o in rows:
        if o.kind not in OWN_FORM:
            kind = C_TYPES.get(o.kind, "double")
            members.setdefault(kind.rstrip(" *"), []).append("*" * kind.endswith("*") + o.field)
    fields = "\n".join(textwrap.fill(f"{kind} {', '.join(names)};", 116, initial_indent="  ", subsequent_indent="    ") for kind, names in members.items())
    table, defaults = [], []
    for o in rows:
        place = "0" if o.kind in OWN_FORM else f"offsetof(options, {o.field})"
        low, high = ("low", "high") if o.kind == "integer" else ("least", "most")
        text = lambda names: "\n     ".join(f'"{line}"' for line in textwrap.wrap(" ".join(names), 100, break_on_hyphens=False, drop_whitespace=False))
        flags = " | ".join([f for f, on in (("AFTER_CRUNCH", o.after_crunch), ("TAKES_STDOUT", o.stdout), ("NEEDS_HOST", o.host), ("TAKES_GZIP", o.gzip)) if on])
        without, needs = ([f"--{name}" for name in names] for names in (o.without, o.needs))
        more = {"words": text(o.words), "flags": flags, "without": text(without), "needs": text(needs), low: o.low, high: o.high}
        begin = f'    {{"--{o.name}", TAKE_{o.kind.upper()}, {place}, .verbs = {_mask(verbs_of(o))}'
        members = "".join(f", .{member} = {value}" for member, value in more.items() if value)
        table.append(f"{begin}{members}}}," if len(begin + members) < 118 else f"{begin},\n    {members[1:]}}},")
        if _c_default(o):
            defaults.append(f".{o.field} = {_c_default(o)}")
    said = "\n".join(
        f"    {{{verbs}, " + '"' + line.replace("\\", "\\\\").replace('"', '\\"').replace("\t", "\\t") + '"},' for verbs, line in help_text()
    )
    names = "\n  ".join(wrapped(", ".join([f"VERB_{v.name.upper()}" for v in VERBS] + ["VERB_NONE"]), 116))
    verbs = "\n".join(
        f'    {{"{v.name}", ' + ", ".join(f'"--{v.files[k]}"' if k < len(v.files) else "NULL" for k in range(2)) + "}," for v in VERBS
    )
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
  unsigned char named[{len(rows)}]; /* of each row of the table, whether it is on the command line */
}} options;

/* First words of a command line. */
enum {{
  {names}
}};

/* Packing fraction of a random start by default. */
#define START_FRACTION(dim) ldexp({START[0]!r}, (dim) > {START[1]} ? {START[1]} - (int)(dim) : 0)

#ifdef JAM_PACK_OPTIONS_TABLE
enum {{
  {kinds}
}};
enum {{ AFTER_CRUNCH = 1, TAKES_STDOUT = 2, NEEDS_HOST = 4, TAKES_GZIP = 8 }};
typedef struct option_row {{
  const char *name;
  int kind;
  size_t place; /* in options */
  int64_t low, high;   /* of an integer */
  double least, most;  /* of another number; 0, 0: no limits of its own */
  const char *words;
  int flags;
  const char *without, *needs; /* names of options, with which and without which it has no effect; or NULL */
  unsigned verbs;              /* bits of those that take it */
}} option_row;

static const option_row table[] = {{
{chr(10).join(table)}
}};

static const options defaults = {{
{textwrap.fill(", ".join(defaults), 116, initial_indent="    ", subsequent_indent="    ")}
}};

/* Stages of growth where --growth is not given; the last one goes to --pressure. */
static const stage default_stages[] = {{{stages}}};

typedef struct help_line {{
  unsigned verbs; /* bits of those that show it; VERB_NONE: the help of the whole program */
  const char *text;
}} help_line;

static const help_line help[] = {{
{said}
    {{0, NULL}}}};

typedef struct verb_row {{
  const char *name, *first, *second; /* options that its words without dashes stand for, or NULL */
}} verb_row;

static const verb_row verb_table[] = {{
{verbs}
}};
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
    verbs = " ".join(v.name for v in VERBS)
    of_verb = "".join(
        f"    {v.name}) takes='{' '.join('--' + o.name for o in rows if v.name in verbs_of(o) or o.kind == 'help')}' ;;\n"
        for v in VERBS
        if v.takes is not None
    )
    return f"""# Completion of jam-pack for bash: {MADE}.
_jam_pack() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} takes='{words}'
  COMPREPLY=()
  case $before in
{choices}    {files}) COMPREPLY=($(compgen -f -- "$word")); return ;;
    {others}) return ;;
  esac
  case ${{COMP_WORDS[1]}} in
{of_verb}  esac
  if [ "$COMP_CWORD" = 1 ]; then takes="{verbs} $takes"; fi
  case $word in
    -*) COMPREPLY=($(compgen -W "$takes" -- "$word")) ;;
    *) COMPREPLY=($(compgen -W "$takes" -- "$word") $(compgen -f -- "$word")) ;;
  esac
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
    verbs = " ".join(f"{v.name}\\:'{v.help.replace(':', ',').split(';')[0]}'" for v in VERBS)
    lines += [f'  "1:verb:(({verbs}))"', "  '*:file:_files'"]
    return f"#compdef jam-pack\n# Completion of jam-pack for zsh: {MADE}.\n_arguments \\\n" + " \\\n".join(lines) + "\n"
