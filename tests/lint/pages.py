"""Rules of pages and messages: words, figures and links."""
import json
import re
import subprocess
import sys

# Where a figure outside of the tables that figures.py writes is refused, and what a figure is there.
MEASURED = r"\d(?:\.\d+)?(?:e-?\d+)? (?:s|ms|us|min|h|minutes|hours|GB|MB|factorisations|evaluations|times as (?:fast|long))(?!\w)"
PAGES_OF_FIGURES = (
    ("tests/bench/", MEASURED + r"|\d %"),
    ("examples/studies/", MEASURED + r"|\d\(\d+\)|\+- ?\d"),
    ("README.md", MEASURED),
)
GUIDE = r"\d(?:\.\d+)?(?:e-?\d+)? (?:s|ms|minutes|hours|factorisations)(?!\w)|\d\(\d\d?\)"


def without_code(text):
    """Blanks code blocks, code spans, display formulas and comments; line breaks stay."""
    pattern = r"^(```|~~~).*?^\1|`[^`\n]*`|\$\$.*?\$\$|<!--.*?-->|^ {4}[^\n]*|\]\([^)\n]*\)"
    return re.sub(pattern, lambda m: re.sub(r"[^\n]", " ", m.group()), text, flags=re.S | re.M)


def without_tables(text):
    """Blanks the tables that bindings/docs/figures.py writes."""
    pattern = r"<!-- figures .*?<!-- end of figures -->"
    return re.sub(pattern, lambda m: re.sub(r"[^\n]", " ", m.group()), text, flags=re.S)


def folders(root):
    """Those of the tree. Builds are left out before the search: other tests make and remove folders in them meanwhile."""
    return sorted(p for p in root.iterdir() if p.is_dir() and not p.name.startswith("build") and p.name != ".git")


def pages(root):
    for path in sorted([*root.glob("*.md"), *(path for folder in folders(root) for path in folder.glob("**/*.md"))]):
        yield path, path.read_text(encoding="utf-8")


def messages(path):
    """(line, text) of the string literals of a source that are sentences."""
    text = path.read_text(encoding="utf-8")
    if path.suffix != ".py":
        text = re.sub(r"//[^\n]*|/\*.*?\*/", lambda m: re.sub(r"[^\n]", " ", m.group()), text, flags=re.S)
    for number, line in enumerate(text.splitlines(), 1):
        for literal in re.findall(r'"((?:[^"\\]|\\.)*)"', line):
            if " " in literal:
                yield number, literal


def words(root):
    for line in (root / "tests/lint/words.txt").read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            pattern, _, plain = line.partition("\t")
            yield re.compile(rf"(?<![\w-])(?:{pattern})(?![\w-])", re.I), plain


def avoided_words(root, problem):
    listed = list(words(root))
    if not all(plain for _, plain in listed) or not any(p.search("It tells you.") for p, _ in listed):
        problem(root / "tests/lint/words.txt", 0, "this rule is broken")

    def check(path, number, text):
        for pattern, plain in listed:
            found = pattern.search(text)
            if found:
                problem(path, number, f"'{found.group()}': write plainly, as in: {plain}")

    for path, text in pages(root):
        if path != root / "CHANGELOG.md":  # lines of earlier versions stay as they were
            for number, line in enumerate(without_code(text).splitlines(), 1):
                check(path, number, line)
    for pattern in ("src/capi/*.?pp", "src/io/*.?pp", "bindings/cli/*.[ch]", "bindings/gen/options.py"):
        for path in sorted(root.glob(pattern)):
            for number, text in messages(path):
                check(path, number, text)


def figures(root, problem):
    """The tables of the pages are those of the results, and no measured figure is typed by hand beside them."""
    made = subprocess.run(
        [sys.executable, "-B", str(root / "bindings/docs/figures.py"), str(root), "--check"], capture_output=True, text=True
    )
    for line in (made.stdout + made.stderr).splitlines():
        problem(line, 0, "run bindings/docs/figures.py")
    results = [(path, json.loads(path.read_text(encoding="utf-8"))) for path in sorted(root.glob("tests/bench/results/*.json"))]
    for path in root.glob("examples/studies/**/results.json"):
        results += [(f"{path}#{name}", result) for name, result in json.loads(path.read_text(encoding="utf-8")).items()]
    for path, result in results:
        missing = {"commit", "date", "command"} - result.keys()
        if missing:
            problem(path, 0, f"no {', '.join(sorted(missing))}")
    if not re.search(MEASURED, "it takes 0.5 s") or re.search(MEASURED, "5 spheres"):
        problem("tests/lint/pages.py", 0, "this rule is broken")
    for path, text in pages(root):
        relative = str(path.relative_to(root))
        kinds = [figure for start, figure in PAGES_OF_FIGURES if relative.startswith(start)]
        kinds += [GUIDE] if relative.startswith("bindings/docs/") else []
        for figure in kinds:
            for number, line in enumerate(without_code(without_tables(text)).splitlines(), 1):
                found = re.search(figure, line)
                if found:
                    problem(path, number, f"the figure '{found.group()}' belongs into a result: see bindings/docs/figures.py")


def anchors(text):
    for heading in re.findall(r"^#+ (.*)$", text, flags=re.M):
        yield re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def links(root, problem):
    """Links within the tree end at a file and a heading that are there, and every picture has a text."""
    for path, text in pages(root):
        bare = re.sub(r"^(```|~~~).*?^\1|`[^`\n]*`", lambda m: re.sub(r"[^\n]", " ", m.group()), text, flags=re.S | re.M)
        for found in re.finditer(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)", bare):
            number = bare.count("\n", 0, found.start()) + 1
            name, _, anchor = found.group(3).partition("#")
            if found.group(1) and not found.group(2).strip():
                problem(path, number, f"the picture {name} has no text")
            if re.match(r"[a-z]+:", name):
                continue
            target = path if not name else root / name[1:] if name.startswith("/") else path.parent / name
            if not target.is_file():
                problem(path, number, f"there is no file {name}")
            elif anchor and name.startswith("/"):
                problem(path, number, f"{name}#{anchor}: the site finds a heading only by a relative path")
            elif anchor and anchor not in anchors(target.read_text(encoding="utf-8")):
                problem(path, number, f"{name or path.name} has no heading #{anchor}")


def changelog(root, problem):
    """What a user notices, once each."""
    path = root / "CHANGELOG.md"
    release = re.split(r"^## ", path.read_text(encoding="utf-8"), flags=re.M)[1]
    lines = [line for line in release.splitlines() if line.startswith("- ")]
    if len(lines) > 100:  # a release that mends what three reviews found
        problem(path, 0, f"{len(lines)} lines in one release: say what a user notices, in 100 at most")
    for line in sorted({line for line in lines if lines.count(line) > 1}):
        problem(path, 0, f"twice: {line[:60]}")
