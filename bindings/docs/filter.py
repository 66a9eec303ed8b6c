"""Doxygen input filter: turns the plain comments of the public headers into documentation comments, to standard output."""
import re
import sys

text = open(sys.argv[1], encoding="utf-8").read()
if sys.argv[1].endswith(".h"):
    text = text.replace("<sigma>", "&lt;sigma&gt;")
    text = re.sub(r"/\* libjam:", "/** @file jam.h\n * libjam:", text, count=1)
    text = re.sub(r"^/\* -{10,} (.*) \*/$", r"", text, flags=re.M)  # section rules
    text = re.sub(r"(;|,|\d|\w)([ \t]*)/\* ", r"\1\2/**< ", text)  # behind a member
    text = re.sub(r"^/\* ", "/** ", text, flags=re.M)  # above a declaration
elif sys.argv[1].endswith(".hpp"):
    text = re.sub(r"^(\s*)// ", r"\1/// ", text, flags=re.M)
sys.stdout.write(text)
