"""Doxygen input filter: makes documentation comments of the plain comments of the public headers, to standard output."""
import re
import sys

# A rule between sections, and the comment on the whole section that may follow it (a blank line ends it).
RULE = re.compile(r"^/\* (-{10,}) (.*?) (?:-+ )?\*/\n(?:/\* ((?:(?!\*/).)*)\*/\n\n)?", re.M | re.S)


def each(found):
    """Members that share a line, one by one with their parts of the comment."""
    names, parts = re.split(r",\s+", found.group(2)), " ".join(found.group(3).split()).split("; ")
    parts = parts * len(names) if len(parts) == 1 else parts
    return "\n".join(f"  {found.group(1)} {name}; /* {part} */" for name, part in zip(names, parts))


def header(text):
    text = RULE.sub("", text)
    text = re.sub(r"<([a-z_]+(?: [a-z_]+)*)>", r"&lt;\1&gt;", text)  # a mean such as <n_a n_b> is no tag
    top = text.index("*/")
    text = text[:top].replace("@", "\\@") + text[top:]
    text = re.sub(r"/\* libjam:", "/** @file jam.h\n * libjam:", text, count=1)
    text = re.sub(
        r"(?<!\*/\n)^(?=JAM_API jam_status jam_\w+_options_init\()",
        "/* Fills *o with the defaults. */\n",
        text,
        flags=re.M,
    )
    text = re.sub(r"^(?=#define JAM_\w+_COLUMNS \d)", "/* Number of columns of the table. */\n", text, flags=re.M)
    # One declaration each: Sphinx takes `typedef struct X {...} X` for two.
    text = re.sub(r"^typedef (struct|enum) (\w+) \{(.*?)^\} \2;", r"\1 \2 {\3};", text, flags=re.S | re.M)
    text = re.sub(r"^ +(\w+) (\w+(?:,\s+\w+)+);\s*/\* ((?:(?!\*/).)*)\*/", each, text, flags=re.S | re.M)
    text = re.sub(r"(;|,|\d|\w)([ \t]*)/\* ", r"\1\2/**< ", text)  # behind a member
    text = re.sub(r"^/\* ", "/** ", text, flags=re.M)  # above a declaration
    text = re.sub(r"(?<!\\)@enum jam_", "jam_", text)  # of a member
    text = re.sub(r"(/\*\*<(?:(?!\*/).)*?)@bool\b", r"\g<1>1:", text, flags=re.S)

    def parts(found):
        """What a comment says under a label or a tag of its own becomes a paragraph with that label."""
        comment = found.group(0)
        for tag, label in (("@shape", "Shapes"), ("@enum", "Values"), ("@bool", "Flags"), ("@optional", "May be left out"), ("@errors", "Errors"), ("Status:", "Status")):
            comment = re.sub(rf"(?<=[\s*.]){tag}\s+(?:\* )?(?=\S)", f"\n *\n * @par {label}\n * ", comment, count=1)
        return re.sub(r"Example: (\S+)", r"Example: `\1`.\n *\n *", comment)

    return re.sub(r"^/\*\*(?!<)(?:(?!\*/).)*\*/\n(?=JAM_API)", parts, text, flags=re.S | re.M)


if __name__ == "__main__":
    source = open(sys.argv[1], encoding="utf-8").read()
    if sys.argv[1].endswith(".h"):
        source = header(source)
    elif sys.argv[1].endswith(".hpp"):
        source = re.sub(r"^(\s*)// ", r"\1/// ", source, flags=re.M)
    sys.stdout.write(source)
