"""python3 -m jam --help; python3 -m jam ensemble --help"""
import sys

if __name__ == "__main__":  # workers of mpi4py.futures import this file under another name
    if sys.argv[1:2] == ["ensemble"]:
        from .ensemble.cli import main

        sys.exit(main(sys.argv[2:]))
    else:
        from .cli import main

        sys.exit(main())
