#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The rings of tests 4 and 16 equal the output of rings.sh.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/04_fundamental_diagram" "$scratch/16_single_file"
"$here/rings.sh" "$scratch"
for folder in 04_fundamental_diagram 16_single_file; do
  diff -r "$scratch/$folder" "$here/$folder" | grep -v "^Only in $here" >&2 && exit 1
done
exit 0
