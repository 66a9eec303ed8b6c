"""Pages of the API of Julia and Fortran, from the text of their sources."""
import re

JULIA = """# Julia

Exported functions and types of the package `Jam`; [the guide's page](/bindings/docs/julia.md) says how to add it. Each function of
C is there too, as `Jam.jam_...`.
"""
FORTRAN = """# Fortran

Procedures of the type `packing` of the module `jam_packing`; [the guide's page](/bindings/docs/fortran.md) says how to use it.
`force = disks%forces()` calls the first kind, `call disks%gaps(...)` the second. The module `jam` has each function of C.
"""


def _fenced(kind, text):
    return f"```{kind}\n{text.rstrip()}\n```\n"


def _docstrings(text):
    """(signature, body) of each docstring that opens with an indented signature."""
    for block in text.split('\n"""\n')[1::2]:
        lines = block.splitlines()
        k = next((k for k, line in enumerate(lines) if not line.startswith("    ")), len(lines))
        if k:
            yield "\n".join(line[4:] for line in lines[:k]), "\n".join(lines[k:]).strip()


def _short_docstrings(text):
    """The same of docstrings of one line, whose signature stands behind them."""
    for body, signature in re.findall(r'^"(.+)"\n(?:function )?(?:Base\.)?([a-z]\w*!?\([^)\n]*\))', text, re.M):
        if "::System" in signature and not re.match(r"(?:letters|count_of)\(", signature):
            yield signature.replace("::System", ""), body


def _text(folders, name):
    """The file, which stands in one of the folders."""
    return next(folder / name for folder in folders if (folder / name).exists()).read_text()


def julia(folders):
    """Docstrings of the package, by file, without the raw layer."""
    pages = [JULIA]
    for name in re.findall(r'include\("(\w+\.jl)"\)', _text(folders, "Jam.jl")):
        text = _text(folders, name)
        blocks = [] if name in ("raw.jl", "tables.jl") else [*_docstrings(text), *_short_docstrings(text)]
        if not blocks:
            continue
        head = text.splitlines()[0].removeprefix("# ")
        pages.append(f"\n## {'Calls of the header' if name == 'methods.jl' else re.split('[.:;,] ', head)[0].rstrip('.')}\n")
        for signature, body in blocks:
            body = body.replace("```jldoctest", "```julia-repl").replace("\\$", "$").replace("\\\\", "\\")
            pages.append(_fenced("julia", signature) + "\n" + body + "\n")
    return "\n".join(pages)


def _procedures(text):
    """{procedure: (comment, head, declarations of its dummies)}."""
    found, comment, lines = {}, [], iter(text.splitlines())
    for line in lines:
        if line.startswith("  ! "):
            comment.append(line[4:])
            continue
        head = re.match(r"  (?:function|subroutine) (\w+)\(", line)
        if head:
            while line.endswith("&"):
                line = line[:-1] + next(lines).strip()
            dummies = []
            for row in lines:
                if row.startswith("  end "):
                    break
                if "intent(" in row and ":: self" not in row:
                    dummies.append(row.strip())
            found[head.group(1)] = (" ".join(comment), line.strip(), dummies)
        comment = []
    return found


def fortran(folders):
    pages = [FORTRAN]
    for name, title in (("jam_base.f90", "Made, copied, written, watched"), ("jam_packing.f90", "Calls of the header")):
        text = _text(folders, name)
        procedures = _procedures(text)
        pages.append(f"\n## {title}\n")
        for shown, body in re.findall(r"^    procedure :: (\w+)(?: => (\w+))?$", text, re.M):
            if (body or shown) not in procedures:
                continue
            comment, head, dummies = procedures[body or shown]
            head = head.replace(body or shown, shown, 1).replace("(self, ", "(").replace("(self)", "()")
            pages.append(_fenced("fortran", "\n".join([head] + ["  " + d for d in dummies])) + "\n" + re.sub(r"([*<|_])", r"\\\1", comment) + "\n")
    return "\n".join(pages)
