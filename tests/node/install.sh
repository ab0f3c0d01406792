#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs the packages of package-lock.json: install.sh FOLDER. Status 77 without node, npm or, at the first time, a
# network.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$1

for tool in node npm; do
  command -v "$tool" >/dev/null && continue
  echo "skipped: there is no $tool on this machine"
  exit 77
done

# `done` is written last: an interrupted installation is repeated
mkdir -p "$folder"
if [[ -e $folder/done ]] && cmp -s "$here/package-lock.json" "$folder/package-lock.json"; then exit 0; fi
rm -f "$folder/done"
cp "$here/package.json" "$here/package-lock.json" "$folder"
cd "$folder" || exit 1
if timeout 90 npm ci --ignore-scripts --no-audit --no-fund --loglevel=error >npm.log 2>&1; then
  touch "done"
  exit 0
fi
cat npm.log
if grep -Eq 'E(INTEGRITY|USAGE|JSONPARSE)' npm.log; then exit 1; fi
echo "skipped: npm could not install its packages"
exit 77
