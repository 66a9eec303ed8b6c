"""python3 -m jam --help; python3 -m jam ensemble --help; python3 -m jam search --help"""
import sys

if __name__ == "__main__":  # workers of mpi4py.futures import this file under another name
    from ._interrupted import end, raise_again

    verb, words = sys.argv[1:2], sys.argv[2:]
    if verb == ["ensemble"]:
        from .ensemble.cli import main
    elif verb == ["search"]:
        from ._search import main
    else:
        from .cli import main

        words = sys.argv[1:]
    if main.__module__ != "jam.cli":  # C takes the signal there
        raise_again()
    try:
        code = main(words)
    except KeyboardInterrupt:
        end()
    sys.exit(code)
