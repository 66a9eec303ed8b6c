#!/bin/sh
# checksums.sh FOLDER [KEY]: writes FOLDER/SHA256SUMS over the files there, and with a key of GnuPG its signature beside
# it. `sha256sum -c SHA256SUMS` and `gpg --verify SHA256SUMS.asc` check a download.
set -eu
cd "$1"
rm -f SHA256SUMS SHA256SUMS.asc
sums=$(mktemp)
find . -maxdepth 1 -type f ! -name 'SHA256SUMS*' -printf '%P\n' | LC_ALL=C sort | xargs -d '\n' sha256sum >"$sums"
mv "$sums" SHA256SUMS && chmod 644 SHA256SUMS
sha256sum -c --quiet SHA256SUMS
if [ $# -gt 1 ]; then gpg --batch --local-user "$2" --armor --detach-sign SHA256SUMS; fi
