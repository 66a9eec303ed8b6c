"""python3 -m jam --help"""
import sys

from .cli import main

sys.exit(main())
