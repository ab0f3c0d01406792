#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Every constant, macro, struct and field of the contract that a page names is there: DMRP_..., dmrp_..., dmrp_x.field.
# Names of the build (DMRP_TEST_DATA, dmrp_add_plugin) are looked up in the sources. The changelog and measurements may
# name what is gone. Called as: contract_names.sh SOURCE_DIR
set -euo pipefail
export LC_ALL=C
cd "$1"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
name='\b(DMRP_[A-Z0-9_]*[A-Z0-9]|dmrp_[a-z0-9_]*[a-z0-9](\.[a-z0-9_]+)?)\b'

awk -f tests/abi/describe.awk sdk/include/dmrp/*.h sdk/include/dmrp/ext/*.h | cut -f 1 >"$scratch/contract"
grep -rohE "$name" sdk host core cmake packaging plugins examples tests CMakeLists.txt --exclude='*.md' --exclude-dir=frozen |
  grep -v '[.]' | sort -u - "$scratch/contract" >"$scratch/names"

breaches=0
while IFS=: read -r file line word; do
  type=${word%%.*}
  # a file, as dmrp_manual.sh; or the first part of a list, as in DMRP_FLAG_*
  [[ $word == *.* ]] && ! grep -qx "$type" "$scratch/contract" && word=$type
  grep -qx -- "$word" "$scratch/names" || grep -q "^${word}_" "$scratch/names" && continue
  echo "$file:$line: $word is neither in the headers nor in the sources"
  breaches=$((breaches + 1))
done < <(find . \( -name build -o -name node_modules -o -name measured -o -name CHANGELOG.md \) -prune -o -name '*.md' -print0 |
  xargs -0 grep -nHoE "$name" | sed 's|^\./||')
((breaches == 0)) || { echo "$breaches names that are gone" && exit 1; }
echo "$(find docs -name '*.md' | wc -l) pages of docs/ name nothing that is gone"
