"""What release.sh needs beside shells: a zip whose bytes follow from its files, and the list of parts in SPDX's form.

usage: spdx.py zip FOLDER FILE      SOURCE_DATE_EPOCH is the time of each entry
       spdx.py list COMMIT FOLDER   FOLDER/libjam-VERSION.spdx.json: the files there, and what LINKED.md lists
"""
import hashlib
import json
import os
import re
import sys
import time
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
WHEN = time.gmtime(int(os.environ["SOURCE_DATE_EPOCH"]))


def make_zip(folder, file):
    with zipfile.ZipFile(file, "w") as made:
        for path in sorted(path for path in folder.rglob("*") if path.is_file()):
            entry = zipfile.ZipInfo(str(path.relative_to(folder.parent)), WHEN[:6])
            entry.external_attr = (0o755 if os.access(path, os.X_OK) else 0o644) << 16
            made.writestr(entry, path.read_bytes(), zipfile.ZIP_DEFLATED, 9)


def make_list(commit, folder):
    version = re.search(r"project\(jam VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in (ROOT / "pkgconfig/LINKED.md").read_text().splitlines()
            if line.startswith("|")][2:]

    def package(key, name, licence, source, **more):
        return {"SPDXID": f"SPDXRef-{key}", "name": name, "licenseDeclared": licence, "downloadLocation": source,
                "filesAnalyzed": False, **more}

    parts = [package("libjam", "libjam", "MIT", "NOASSERTION", versionInfo=version)]
    for name, licence, when, _, source in rows:
        # a cell with several licences says in words which version has which
        known = licence if re.fullmatch(r"[\w.-]+( WITH [\w.-]+)?", licence) and licence != "BSD-3-Clause-LBNL" else "NOASSERTION"
        parts.append(package("part-" + re.sub(r"[^A-Za-z0-9]+", "-", name).strip("-"), name, known, source,
                             comment=f"{licence}; in a build: {when}".replace("`", "")))
    target = folder / f"libjam-{version}.spdx.json"
    made = [path for path in sorted(folder.iterdir()) if path.is_file() and path.suffix not in (".md", ".json") and not path.name.startswith("SHA256")]
    files = [{"SPDXID": f"SPDXRef-file-{k}", "fileName": path.name,
              "checksums": [{"algorithm": "SHA256", "checksumValue": hashlib.sha256(path.read_bytes()).hexdigest()}]}
             for k, path in enumerate(made)]
    document = {
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"libjam-{version}",
        "documentNamespace": f"https://github.com/libjam/libjam/spdx/{commit}",
        "creationInfo": {"created": time.strftime("%Y-%m-%dT%H:%M:%SZ", WHEN), "creators": ["Tool: pkgconfig/spdx.py"]},
        "packages": parts, "files": files,
        "relationships": [{"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES", "relatedSpdxElement": "SPDXRef-libjam"},
                          *({"spdxElementId": "SPDXRef-libjam", "relationshipType": "CONTAINS", "relatedSpdxElement": f["SPDXID"]}
                            for f in files),
                          *({"spdxElementId": "SPDXRef-libjam", "relationshipType": "DEPENDS_ON", "relatedSpdxElement": p["SPDXID"]}
                            for p in parts[1:])]}
    target.write_text(json.dumps(document, indent=1) + "\n")


if __name__ == "__main__":
    if sys.argv[1] == "zip":
        make_zip(Path(sys.argv[2]), sys.argv[3])
    else:
        make_list(sys.argv[2], Path(sys.argv[3]))
