"""Makes lab.html, one file, from the parts beside this program and the package for JavaScript.

usage: build_lab.py PACKAGE OUT [STORED]     PACKAGE has jam.wasm, jam.bundle.mjs and worker.bundle.js
STORED: another lab.html, of an earlier build; status 1 if more than its WebAssembly, which names its commit, differs.
"""
import base64
import gzip
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
START = "needs unpack start".split()
LAB = "texts unpack recipe parts engine keep view session panel_make panel_check panel_look main".split()
PROOF = "exact scene inverse implied trapped check".split()
EXPORT = re.compile(r"^export (?=(?:async )?(?:const|let|function|class) )|^export \{[^}]*\}.*\n", re.M)
PACKED = re.compile('(<script type="text/plain" id="(\\w+)">)([^<]*)')


def joined(folder, names):
    with tempfile.TemporaryDirectory() as place:
        out = Path(place) / "joined.js"
        subprocess.run([sys.executable, "-B", HERE.parent / "bundle.py", folder, out, *names], check=True)
        return out.read_text("utf-8")


def packed(data):
    return base64.b64encode(gzip.compress(data, 9, mtime=0)).decode()


def page(package):
    library = EXPORT.sub("", (package / "jam.bundle.mjs").read_text("utf-8"))
    library = f"const {{ spawnOn, webPort }} = (() => {{\n{library}\nreturn {{ spawnOn, webPort }};\n}})();\n"
    parts = {"CSS": (HERE / "lab.css").read_text("utf-8"), "START": joined(HERE, START),
             "WASM": packed((package / "jam.wasm").read_bytes()), "ENGINE": packed((package / "worker.bundle.js").read_bytes()),
             "CHECKER": packed(joined(HERE / "proof", PROOF).encode()),
             "SCRIPTS": packed(f'"use strict";\n{library}{joined(HERE, LAB)}'.encode())}  # fmt: skip
    return re.sub("@([A-Z]+)@", lambda m: parts[m[1]], (HERE / "lab.html").read_text("utf-8"))


def contents(text):
    """What stays the same with another commit and another zlib."""
    parts = {name: gzip.decompress(base64.b64decode(data)) for _, name, data in PACKED.findall(text) if name != "wasm"}
    return PACKED.sub(r"\1", text), parts


if __name__ == "__main__":
    made = page(Path(sys.argv[1]))
    Path(sys.argv[2]).write_text(made, "utf-8")
    if sys.argv[3:] and contents(Path(sys.argv[3]).read_text("utf-8")) != contents(made):
        sys.exit(f"{sys.argv[3]} is not what this tree makes: build it anew and commit it")
