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
LAB = "texts needs recipe parts engine keep view session panel_make panel_check panel_look main".split()
PROOF = "exact scene inverse implied trapped check".split()
EXPORT = re.compile(r"^export (?=(?:async )?(?:const|let|function|class) )|^export \{[^}]*\}.*\n", re.M)


def joined(folder, names):
    with tempfile.TemporaryDirectory() as place:
        out = Path(place) / "joined.js"
        subprocess.run([sys.executable, "-B", HERE.parent / "bundle.py", folder, out, *names], check=True)
        return out.read_text("utf-8")


def script(text):
    """Inside a script element, which nothing in it may end. Comments and empty lines stay in the sources."""
    text = re.sub(r"^[ \t]*(?:/\*(?:(?!\*/)[\s\S])*\*/|//.*)?[ \t]*\n", "", text, flags=re.M)
    if re.search("</script|<!--", text, re.I):
        sys.exit("a part has </script> or <!--")
    return text


def page(package):
    library = EXPORT.sub("", (package / "jam.bundle.mjs").read_text("utf-8"))
    js = f"const {{ spawnOn, webPort }} = (() => {{\n{library}\nreturn {{ spawnOn, webPort }};\n}})();\n{joined(HERE, LAB)}"
    wasm = base64.b64encode(gzip.compress((package / "jam.wasm").read_bytes(), 9, mtime=0)).decode()
    parts = {"CSS": (HERE / "lab.css").read_text("utf-8"), "JS": script(js), "WASM": wasm,
             "ENGINE": script((package / "worker.bundle.js").read_text("utf-8")), "CHECKER": script(joined(HERE / "proof", PROOF))}  # fmt: skip
    return re.sub("@([A-Z]+)@", lambda m: parts[m[1]], (HERE / "lab.html").read_text("utf-8"))


def without_wasm(text):
    return re.sub('(id="wasm">)[^<]*', r"\1", text)


if __name__ == "__main__":
    made = page(Path(sys.argv[1]))
    Path(sys.argv[2]).write_text(made, "utf-8")
    if sys.argv[3:] and without_wasm(Path(sys.argv[3]).read_text("utf-8")) != without_wasm(made):
        sys.exit(f"{sys.argv[3]} is not what this tree makes: build it anew and commit it")
