"""What the command lines of the module have in common: exit status, options by their whole names, answers in JSON."""
from __future__ import annotations

import argparse
import functools
import json
import os
import sys
from typing import Any, Callable, NoReturn

DONE, PARTIAL, USAGE, REFUSED, OUTPUT = range(5)  # exit status, as python3 -m jam


class Parser(argparse.ArgumentParser):
    """Takes options by their whole names, each once, and answers in JSON where that was asked for."""

    words: list[str] = []  # of the command line

    def __init__(self, **more: Any) -> None:
        super().__init__(allow_abbrev=False, **more)

    def error(self, message: str) -> NoReturn:
        if "--json" in Parser.words:
            print(json_answer(USAGE, message))
        super().error(message)

    def parse(self, arguments: list[str] | None) -> argparse.Namespace:
        """These words, by default those of the process."""
        Parser.words = words = sys.argv[1:] if arguments is None else arguments
        names = [word.partition("=")[0] for word in words if word.startswith("--")]
        for name in names:
            if names.count(name) > 1:  # the second value would replace the first one in silence
                self.error(f"{name} is given twice: leave one out")
        return self.parse_args(words)


def json_answer(code: int, text: str, **more: Any) -> str:
    """As of the other verbs: exit status, what was said, and what there is."""
    return json.dumps({"status": code, "text": text, **more})


def refuse(code: int, text: str, as_json: bool) -> int:
    """Says why, and returns the exit status."""
    print(f"jam: {text}", file=sys.stderr)
    if as_json:
        print(json_answer(code, text))
    return code


def _nowhere(flags: int) -> int:
    """The least descriptor that is free, in workers too."""
    descriptor = os.open(os.devnull, flags)
    os.set_inheritable(descriptor, True)
    return descriptor


def _keep_standard_streams() -> None:
    """Those that are closed lead nowhere from now on: no file that is opened becomes one of them, and what is printed fails.
    Messages vanish; print would write them to standard output in place of a sys.stderr that is None."""
    if sys.stdin is None:
        sys.stdin = open(_nowhere(os.O_RDWR))
    if sys.stdout is None:
        sys.stdout = open(_nowhere(os.O_RDONLY), "w")
    if sys.stderr is None:
        sys.stderr = open(_nowhere(os.O_RDWR), "w")


def printed(answer: Callable[[list[str] | None], int]) -> Callable[[list[str] | None], int]:
    """Decorates the main function of a command. In it only print may raise OSError: that becomes a message and the status OUTPUT."""

    @functools.wraps(answer)
    def printing(arguments: list[str] | None = None) -> int:
        _keep_standard_streams()
        try:
            try:
                return answer(arguments)
            finally:
                sys.stdout.flush()
        except OSError as error:
            print(f"jam: cannot write standard output: {error.strerror}", file=sys.stderr)
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # the interpreter flushes it once more at its end
            return OUTPUT

    return printing
