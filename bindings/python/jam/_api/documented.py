"""Options of a struct in the signature and the docstring of a method that takes them as **options."""
from __future__ import annotations

import inspect
import textwrap
from typing import Any, Callable, TypeVar

from . import generated
from .generated import OPTIONS

Method = TypeVar("Method", bound=Callable[..., Any])


def takes(struct: str) -> Callable[[Method], Method]:
    """Decorates a method: help() and editors show the options of the struct in place of **options."""

    def documented(method: Method) -> Method:
        _spell_out(method, struct)
        return method

    return documented


def _spell_out(method: Any, struct: str) -> None:
    """Puts the options of a struct in place of **options: into the signature that help() and editors show, and into the
    section Parameters of the docstring."""
    signature = inspect.signature(method)
    shown = [p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD]
    new = {name: entry for name, entry in OPTIONS[struct].items() if name not in signature.parameters}
    for name, (kind, _) in new.items():
        hint = kind if kind in ("int", "float", "bool") else "int | str"
        shown.append(inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=f"{hint} | None"))
    method.__signature__ = signature.replace(parameters=shown)
    rows = [
        "progress : bool or callable, optional",
        "    True: a line that changes. A callable gets a Progress; a true answer",
    ]
    rows[-1] += " stops the call."
    for name, (kind, text) in new.items():
        enum = getattr(generated, kind, None) if kind not in ("int", "float", "bool") else None
        choices = "{" + ", ".join(repr(e.name.lower()) for e in enum) + "}" if enum else kind
        rows.append(f"{name} : {choices}, optional")
        rows += textwrap.wrap(" ".join(text.split()), 100, initial_indent="    ", subsequent_indent="    ")
    block = "\n".join(rows)
    doc = inspect.cleandoc(method.__doc__ or "")  # Python 3.13 has taken the indentation away already
    head = "\n\nParameters\n----------\n"
    if head in doc:
        at = doc.find("\n\n", doc.index(head) + len(head))
        at = len(doc) if at < 0 else at
        method.__doc__ = doc[:at] + "\n" + block + doc[at:] + "\n"
    else:
        at = doc.find("\n\nReturns\n")
        at = len(doc) if at < 0 else at
        method.__doc__ = doc[:at] + head + block + doc[at:] + "\n"
