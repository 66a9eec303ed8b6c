"""Ctrl-C while python3 -m jam imports: one line and the end, in place of the traceback of the module that is being imported."""
import os
import signal
import sys
from typing import Any


def end(*_: Any) -> None:
    """As a program ends that does nothing about Ctrl-C: shells see 130."""
    os.write(2, b"python3 -m jam: interrupted\n")
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    os.kill(os.getpid(), signal.SIGINT)


def end_in_one_line() -> None:
    """From now on, if Python looks for the program jam: then it has no name yet, and imports the package first."""
    is_program = sys.argv[:1] == ["-m"] and sys.orig_argv[-len(sys.argv)] in ("jam", "-mjam")
    if is_program and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, end)


def raise_again() -> None:
    """Ctrl-C is an exception again, where it is not ignored."""
    if signal.getsignal(signal.SIGINT) is end:
        signal.signal(signal.SIGINT, signal.default_int_handler)
