"""Lays out the sources of the site: the tree's Markdown as it is, by links, and pages of the API made from the header.

usage: site.py ROOT FOLDER      then: sphinx-build -c ROOT/bindings/docs FOLDER/source FOLDER/html
"""
import re
import shutil
import sys
from pathlib import Path

import api_layers
import call_examples
import figures
import filter as header_filter

SHOWN = ("README.md", "CHANGELOG.md", "LICENSE", "bindings", "examples", "include", "src", "tests")


PYTHON = """# Python

The package `jam`. Options are keywords under the names of the C header, and enum values are given by name: `model="mk"`.

## The system

```{eval-rst}
.. autoclass:: jam.System
   :members:
   :inherited-members:
```

## Results

```{eval-rst}
.. autoclass:: jam.Contacts
   :members:
.. autoclass:: jam.Modes
   :members:
.. autoclass:: jam.Observed
   :members:
.. autoclass:: jam.Step
   :members:
.. autofunction:: jam.advise
.. autoclass:: jam.Advice
   :members:
.. autofunction:: jam.eos
.. autofunction:: jam.glass_fit
.. autofunction:: jam.sizes
.. autofunction:: jam.size_report
```

## Pictures

```{eval-rst}
.. automodule:: jam.plot
   :members:
```

## Ensembles

```{eval-rst}
.. autoclass:: jam.ensemble.Ensemble
   :members:
.. autoclass:: jam.ensemble.Entry
   :members:
.. autoclass:: jam.ensemble.Status
   :members:
.. autofunction:: jam.ensemble.complete
.. autofunction:: jam.ensemble.protocols
.. autofunction:: jam.ensemble.table
.. autofunction:: jam.load
```

## Files for other programs

```{eval-rst}
.. automodule:: jam.files
   :members:
```

## Errors

```{eval-rst}
.. automodule:: jam.errors
   :members:
```
"""

# A declaration of the header, and how breathe calls its kind.
KINDS = (
    (r"^#define (JAM_\w+) \d", "define"),
    (r"^JAM_API [^;(]*?\b(jam_\w+)\(", "function"),
    (r"^typedef struct (\w+) \{", "struct"),
    (r"^typedef enum (\w+) \{", "enum"),
    (r"^typedef [^{;(]*?\b(jam_\w+);", "typedef"),
    (r"^typedef [^{;]*?\(\*(jam_\w+)\)", "typedef"),
)


def declarations(text):
    """(place, kind, name) of every declaration, in the order of the header."""
    return sorted((m.start(), kind, m.group(1)) for pattern, kind in KINDS for m in re.finditer(pattern, text, re.M))


def shown(comment):
    """The comment on a section as a paragraph of Markdown."""
    words = re.sub(r"\s*\n \* ?", " ", comment or "").strip()
    return re.sub(r"([*<|])", r"\\\1", words)


def api_pages(header, examples):
    """(name, text) of a page for each section of the header; its short rules become headings on it. Calls with an example."""
    rules = list(header_filter.RULE.finditer(header))
    ends = [r.start() for r in rules[1:]] + [len(header)]
    pages = []
    for rule, end in zip(rules, ends):
        title = rule.group(2)[0].upper() + rule.group(2)[1:]
        if len(rule.group(1)) > 20:
            name = re.sub(r"\W+", "_", title.lower())
            pages.append([name, f"# {title}\n"])
        else:
            pages[-1][1] += f"\n## {title}\n"
        pages[-1][1] += f"\n{shown(rule.group(3))}\n"
        for _, kind, name in declarations(header[rule.end() : end]):
            members = ":members:\n" if kind == "struct" else ""
            pages[-1][1] += f"\n```{{doxygen{kind}}} {name}\n{members}```\n"
            if name in examples:
                pages[-1][1] += "\n".join(("\n```c", *examples[name], "```\n"))
    return pages


def main():
    root, generated, folder = (Path(name).resolve() for name in sys.argv[1:])
    source = folder / "source"
    shutil.rmtree(folder, ignore_errors=True)  # a kept environment would hide warnings of pages that did not change
    (source / "api").mkdir(parents=True)
    for name in SHOWN:
        if (root / name).exists():
            (source / name).symlink_to(root / name)
    # The start page stands at the top, so that the site opens with it; its links begin with / and hold in both places.
    (source / "index.md").write_text((root / "bindings/docs/index.md").read_text())
    pages = api_pages((root / "include/jam/jam.h").read_text(), call_examples.examples(root))
    for name, text in pages:
        (source / "api" / f"{name}.md").write_text(text)
    listed = "\n".join(name for name, _ in pages)
    (source / "api" / "c.md").write_text(
        "# C\n\nEverything that `jam/jam.h` declares, in the order of work. The conventions stand at the top of the header"
        " and on the page on [languages](/bindings/docs/languages.md). Below each call stands an example; a test makes the same calls.\n\n"
        f"```{{toctree}}\n:maxdepth: 2\n\n{listed}\n```\n"
    )
    (source / "api" / "cpp.md").write_text(
        "# C++\n\nThe header `jam/jam.hpp` needs C++17 and nothing but `jam.h`.\n\n"
        "```{doxygennamespace} jam\n:members:\n:undoc-members:\n:content-only:\n```\n"
    )
    values = figures.read(f"{root}/examples/studies/thesis.py#thesis_values")
    (source / "api" / "thesis_values.md").write_text(
        "# Values of the thesis\n\nPublished values and ours of [each figure](/examples/studies/thesis.md), which explains the symbols.\n\n"
        + "\n".join(figures.table([(values, None)], []))
    )
    # the package as a build puts it together; conf.py imports it
    for part in (root / "bindings/python/jam", generated / "python/jam"):
        shutil.copytree(part, folder / "python/jam", dirs_exist_ok=True)
    (source / "api" / "python.md").write_text(PYTHON)
    (source / "api" / "julia.md").write_text(api_layers.julia([root / "bindings/julia/Jam/src", generated / "julia"]))
    (source / "api" / "fortran.md").write_text(api_layers.fortran([root / "bindings/fortran", generated / "fortran"]))


if __name__ == "__main__":
    main()
