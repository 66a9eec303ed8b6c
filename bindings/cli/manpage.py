"""manpage.py VERSION OUT.gz PROGRAM...: the manual page of jam-pack, made from what it prints for --help."""
import gzip
import re
import subprocess
import sys

version, out, *program = sys.argv[1:]
lines = subprocess.run([*program, "--help"], check=True, capture_output=True, text=True).stdout.splitlines()


def quoted(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text.startswith((".", "'")) else text


about, options, notes, example = [], [], [], ""
section = ""
for line in lines[1:]:
    item = re.match(r"  (\S.*?)(?:  +(.*))?$", line)
    more = re.match(r" {10,}(\S.*)$", line)
    if line.startswith("Example: "):
        example = line.removeprefix("Example: ")
    elif item:
        options += [".TP", f".B {quoted(item.group(1))}"] + ([quoted(item.group(2))] if item.group(2) else [])
    elif more:
        options.append(quoted(more.group(1)))
    elif re.fullmatch(r"[A-Z][\w ]*", line):
        section = line
        options.append(f".SS {line}")
    elif line and section == "Verbs":
        options += [".PP", quoted(line)]
    elif line:
        (notes if section else about).append(quoted(line))

page = [
    f'.TH JAM\\-PACK 1 "" "libjam {version}" "User Commands"',
    ".SH NAME",
    "jam\\-pack \\- make and analyse jammed packings of hard spheres",
    ".SH SYNOPSIS",
    ".B jam\\-pack",
    "[\\fIVERB\\fR] [\\fIFILE\\fR] [\\fIoptions\\fR]",
    ".SH DESCRIPTION",
    *about,
    ".SH OPTIONS",
    *options,
    ".SH EXIT STATUS",
    *notes,
    ".SH EXAMPLE",
    ".EX",
    quoted(example),
    ".EE",
]
with open(out, "wb") as file, gzip.GzipFile("", "wb", 9, file, mtime=0) as packed:
    packed.write(("\n".join(page) + "\n").encode())
