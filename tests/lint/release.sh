#!/bin/sh
# release.sh ROOT: what follows from files alone in pkgconfig/release.sh. The zip and the list of parts have the same
# bytes twice, whatever the times of the files; the list names each file, and each row of LINKED.md.
set -eu
root=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
sh -n "$root/pkgconfig/release.sh"
export SOURCE_DATE_EPOCH=1700000000 PYTHONDONTWRITEBYTECODE=1
for name in one two; do
  mkdir -p "$work/$name/tree/bin" "$work/out_$name"
  echo program >"$work/$name/tree/bin/program"
  chmod 755 "$work/$name/tree/bin/program"
  echo text >"$work/$name/tree/text"
  if [ $name = two ]; then touch -d 2001-01-01 "$work/two/tree/text"; fi
  /usr/bin/python3 "$root/pkgconfig/spdx.py" zip "$work/$name/tree" "$work/out_$name/tree.zip"
  /usr/bin/python3 "$root/pkgconfig/spdx.py" list 0123456789ab "$work/out_$name"
  sh "$root/pkgconfig/checksums.sh" "$work/out_$name"
done
diff -r "$work/out_one" "$work/out_two"
/usr/bin/python3 - "$root/pkgconfig/LINKED.md" "$work"/out_one/*.spdx.json <<'END'
import json, re, sys
rows = [line for line in open(sys.argv[1]) if line.startswith("|")][2:]
made = json.load(open(sys.argv[2]))
assert made["spdxVersion"] == "SPDX-2.3" and len(made["packages"]) == len(rows) + 1
assert [f["fileName"] for f in made["files"]] == ["tree.zip"]
ids = [x["SPDXID"] for x in made["packages"] + made["files"]]
assert len(set(ids)) == len(ids) and all(re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", x) for x in ids), ids
ends = {r["relatedSpdxElement"] for r in made["relationships"]}
assert ends == set(ids), ends ^ set(ids)
END
