"""What signatures of methods say: the options of a struct in place of **options, and which methods change a packing."""
from __future__ import annotations

import inspect
import textwrap
from typing import Any, Callable, TypeVar

from . import generated
from .generated import CALLS, OPTIONS

Method = TypeVar("Method", bound=Callable[..., Any])


def takes(struct: str) -> Callable[[Method], Method]:
    """Decorates a method: help() and editors show the options of the struct in place of **options."""

    def documented(method: Method) -> Method:
        _spell_out(method, struct)
        return method

    return documented


def _methods(cls: type) -> dict[str, Any]:
    """The methods of a class that are calls of the header under their own name."""
    return {name[4:]: method for name in CALLS if callable(method := getattr(cls, name[4:], None))}


def changing(cls: type) -> list[str]:
    """Methods that change the packing: their report says what stopped them, or has the forces of the network that they made."""
    reports = {name: getattr(generated, str(inspect.signature(m).return_annotation), None) for name, m in _methods(cls).items()}
    return [name for name, r in reports.items() if {"stop_reason", "min_force"} & getattr(r, "__annotations__", {}).keys()]


def measuring(cls: type) -> list[str]:
    """Methods that return numbers of the packing and leave it as it is, and take no file or other packing."""
    others = _methods(cls).keys() - changing(cls)
    roles = {name: {role for _, role, _ in CALLS["jam_" + name][1]} for name in _methods(cls) if name in others}
    return [name for name, r in roles.items() if r & {"array_out", "struct_out"} and not r & {"string", "handle"}]


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
