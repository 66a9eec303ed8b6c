"""Joins modules into one file without imports, for pages that are one file. A module imports by lines
`import { names } from './x.mjs';`, exports declarations alone, and no two modules declare one name.

usage: bundle.py FOLDER OUT MODULE...     OUT .mjs keeps the exports of the last module, .js is a classic script
"""
import re
import sys
from pathlib import Path

folder, out, *names = sys.argv[1:]
IMPORT = re.compile(r"^import \{([^}]*)\} from '\./(\w+)\.mjs';\n", re.M)
parts = []
for name in names:
    text = (Path(folder) / f"{name}.mjs").read_text()
    for wanted, source in IMPORT.findall(text):
        if source not in names[: names.index(name)] or " as " in wanted:
            sys.exit(f"{name}.mjs imports {wanted} of {source}, which does not stand before it")
    text = IMPORT.sub("", text)
    if re.search(r"^import |import\.meta", text, re.M):
        sys.exit(f"{name}.mjs imports what a bundle cannot hold")
    parts.append(text if out.endswith(".mjs") else re.sub(r"^export ", "", text, flags=re.M))
declared = re.findall(r"^(?:export )?(?:async )?(?:const|let|function|class) (\w+)", "\n".join(parts), re.M)
if twice := {n for n in declared if declared.count(n) > 1}:
    sys.exit(f"declared twice: {', '.join(sorted(twice))}")
Path(out).write_text("\n".join(parts))
