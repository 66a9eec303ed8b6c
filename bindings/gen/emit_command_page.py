"""The page of the guide on the command line, out of the table of options."""
import re
import textwrap

from emit_options import MADE, wrapped
from option import usage
from options import ABOUT, EXAMPLE, EXITS, NOTES, VERBS, options, verbs_of


def _marked(text):
    """Options as code, since Markdown makes one dash of two."""
    return re.sub(r"(?<![`\w-])--[a-z][\w-]*", r"`\g<0>`", text).replace("|", "\\|")


def emit():
    out = [
        f"<!-- {MADE} -->",
        "# The command line",
        "",
        *wrapped(ABOUT, 120),
        "",
        "```sh",
        "jam-pack " + EXAMPLE,
        "python3 -m jam " + EXAMPLE,
        "```",
        "",
        "Both commands run the same code. Options marked (Python) are of `python3 -m jam` alone, which also reads and writes `.gsd` files.",
        "",
        "## Verbs",
        "",
        "| first word | what it does |",
        "|---|---|",
        *(f"| `{v.usage}` | {_marked(v.help)} |" for v in VERBS),
        "",
        "`jam-pack VERB --help` shows the options of one verb. Options that the verb does not take are refused, and so are options",
        "that are given twice, except `--growth`.",
        "",
        "```sh",
        "jam-pack compress --n 512 --pressure 1e4 --output dense.xyz",
        "jam-pack crunch dense.xyz jammed.xyz --json",
        "jam-pack check jammed.xyz",
        "jam-pack export jammed.xyz jammed.data --contacts contacts.csv",
        "jam-pack page jammed.xyz jammed.html",
        "```",
        "",
    ]
    for section, rows in options(host=True):
        out += [f"## {section}", ""]
        if all(verbs_of(o) == ["export"] for o in rows):
            out += ["Only `jam-pack export` takes these options.", ""]
        for o in rows:
            said = f"- `{usage(o)}`{' (Python)' if o.host else ''}: {_marked(o.help)}"
            out += textwrap.wrap(said, 120, subsequent_indent="  ", break_on_hyphens=False)
        out.append("")
    out += ["## How it ends", ""]
    for note in NOTES:
        if "status" not in note:
            out += [*wrapped(_marked(note), 120), ""]
    out += [
        "With `--input` or FILE the verdict of a crunch is that of the packing at the end. `check` moves no spheres of the file.",
        "",
        "| exit status | pack, compress, crunch, shear | check | info, export, page |",
        "|---|---|---|---|",
        *("| " + " | ".join(row) + " |" for row in EXITS),
        "",
        *wrapped(
            "`ensemble` runs `python3 -m jam ensemble`, with exit status 0: all packings are there. 1: some failed or are missing. 2: wrong "
            "command line. 3: protocol or folder refused, or Python has no module `jam`. 4: the folder cannot be written. `search` runs "
            "`python3 -m jam search`, with the same statuses except 1: no maximum was found, or a proof failed."
        ),
        "",
        *wrapped(
            "With `--json` standard output is one JSON object and nothing else, also after a failure; messages go to standard "
            "error. The objects of the verbs in the table have `file`, `status` (the exit status), `text` (the messages; of `check` the "
            "verdict), `n`, `dim` and `packing_fraction` of the packing reached (`null` if the failure came before any packing) "
            "and `version`, and then the results of the verb. `ensemble status --json` has `status` and `text` too. The member `notes` "
            "gives the reason if the table of contacts is empty, is not the only one possible, or is not that of a jammed packing."
        ),
        "",
    ]
    out += ["Completion for bash and zsh is installed with the program, and `man jam-pack` shows all options.", ""]
    return "\n".join(out)
