#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Compares size and offsets of all public structs, and the constants, with those written down in v1.txt.
# Called as: layout.sh INCLUDE_DIR C_COMPILER [--update]. With --update it writes v1.txt: until v1 is frozen a draft
# may take something away, but with a higher DMRP_ABI_DRAFT; from then on fields and constants are only ever added.
set -euo pipefail
export LC_ALL=C
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
include=$1 compiler=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

awk -f "$here/layout.awk" "$include"/dmrp/*.h "$include"/dmrp/ext/*.h >"$scratch/layout.c"
"$compiler" -std=c99 -I "$include" "$scratch/layout.c" -o "$scratch/layout"
"$scratch/layout" >"$scratch/now.txt"
if [[ ${3:-} == --update ]]; then
  gone=$(comm -23 <(sort -u "$here/v1.txt") <(sort -u "$scratch/now.txt"))
  [[ -z $gone || $gone == *"DMRP_ABI_DRAFT = "* ]] ||
    { echo "refused: DMRP_ABI_DRAFT is as before, and this is gone: ${gone%%$'\n'*}" && exit 1; }
  cp "$scratch/now.txt" "$here/v1.txt"
elif ! diff -u "$here/v1.txt" "$scratch/now.txt"; then
  echo "the layout has changed; if that is meant: $0 $include $compiler --update"
  exit 1
fi
