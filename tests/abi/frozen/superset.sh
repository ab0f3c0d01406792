#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The contract of INCLUDE_DIR contains the frozen one (1.0.txt, 1.0/): every frozen struct begins as it did, with the same
# fields and function types at the same places, and every frozen constant has its value. What is new stands in
# `#if DMRP_TARGET_MINOR >= n`. A sentence of the headers that has changed has a line in VERSIONING.md.
# While the draft number is not 0 nothing is frozen, and there is nothing to contain.
#
# Called as: superset.sh INCLUDE_DIR C_COMPILER [--freeze]. --freeze copies the headers, once, when their draft number is 0.
set -euo pipefail
export LC_ALL=C
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
include=$(realpath "$1") compiler=$2
frozen=$here/1.0 versioning=$here/../../../VERSIONING.md
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# layout INCLUDE_DIR, described INCLUDE_DIR
layout() {
  awk -f "$here/../layout.awk" "$1"/dmrp/*.h "$1"/dmrp/ext/*.h >"$scratch/layout.c"
  "$compiler" -std=c99 -DDMRP_TARGET_MINOR=9999 -I "$1" "$scratch/layout.c" -o "$scratch/layout"
  "$scratch/layout"
}
described() { awk -f "$here/../describe.awk" "$1"/dmrp/*.h "$1"/dmrp/ext/*.h; }
draft_of() { sed -n 's/^#define DMRP_ABI_DRAFT //p' "$1/dmrp/abi.h"; }

draft=$(draft_of "$include")
if ((draft != 0)); then
  [[ ! -d $frozen ]] || { echo "v1 is frozen: DMRP_ABI_DRAFT stays 0" && exit 1; }
  echo "draft $draft: nothing is frozen yet"
  exit 77
fi
if [[ ${3:-} == --freeze ]]; then
  [[ ! -d $frozen ]] || { echo "refused: v1 is frozen" && exit 1; }
  mkdir -p "$frozen/dmrp"
  cp -r "$include"/dmrp/{*.h,plugin.hpp,cpp,ext} "$frozen/dmrp"
  echo "DisableFormat: true" >"$frozen/.clang-format"
  layout "$include" >"$frozen.txt"
  exit
fi
[[ -d $frozen ]] || { echo "the draft number is 0, and nothing is frozen: $0 $include $compiler --freeze" && exit 1; }
layout "$frozen" >"$scratch/frozen.txt"
cmp -s "$scratch/frozen.txt" "$frozen.txt" || { echo "1.0.txt is not the layout of 1.0/: one was edited" && exit 1; }
layout "$include" >"$scratch/now.txt"
described "$frozen" >"$scratch/frozen_described.txt"
described "$include" >"$scratch/described.txt"
awk -f "$here/superset.awk" part=frozen_layout "$scratch/frozen.txt" part=layout "$scratch/now.txt" \
  part=frozen_described "$scratch/frozen_described.txt" part=described "$scratch/described.txt" >"$scratch/breaches"

# NAME <tab> all that the headers say of it, in one line; of a list of constants: under the first
sentences() {
  awk -F '\t' '
    { add($1, $5) }
    $6 != "" && $6 != group { add("list of " $1, $6) }
    { group = $6 }
    function add(name, text) {
      gsub(/\\n/, " ", text); gsub(/  +/, " ", text)
      if (!(name in all)) names[++count] = name
      all[name] = all[name] (all[name] == "" ? "" : " ") text
    }
    END { for (i = 1; i <= count; ++i) print names[i] "\t" all[names[i]] }' "$1" | sort
}
sentences "$scratch/frozen_described.txt" >"$scratch/frozen_sentences"
sentences "$scratch/described.txt" >"$scratch/sentences"
# of names in both, those that say something else
comm -13 "$scratch/frozen_sentences" "$scratch/sentences" | join -t $'\t' - <(cut -f 1 "$scratch/frozen_sentences") |
  while IFS=$'\t' read -r name text; do
    line="- \`$name\` $(sha256sum <<<"$text" | cut -c 1-8):"
    grep -qF -- "$line" "$versioning" ||
      echo "what the headers say of $name has changed: VERSIONING.md needs a line '$line WHY'"
  done >>"$scratch/breaches"

if [[ -s $scratch/breaches ]]; then
  cat "$scratch/breaches"
  echo "FAILED: $(wc -l <"$scratch/breaches") breaches of what is frozen"
  exit 1
fi
echo "contains what is frozen: $(grep -c '^dmrp_' "$frozen.txt") structs, $(grep -c ' = ' "$frozen.txt") constants"
