#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_dates.sh SOURCE_DIR: no page outside docs/measured has a commit or a date, since pages say what is. CHANGELOG.md may;
# years of cited papers may stand anywhere. Prints each breach as file:line: text; exit status 1 if there is one.
set -euo pipefail
shopt -s inherit_errexit
export LC_ALL=C
cd "$1"

month='(January|February|March|April|May|June|July|August|September|October|November|December)'
date="\b(19|20)[0-9]{2}-[0-9]{2}-[0-9]{2}\b|\b$month (19|20)[0-9]{2}\b|\b[0-9]{1,2} $month\b|\b$month [0-9]{1,2}, "
# a commit has a letter and a digit, or the word before it
commit='\b[0-9a-f]{7,40}\b'

mapfile -t pages < <(find . \( -name build -o -name .git -o -name node_modules -o -path ./docs/measured \) -prune -o \
  -name '*.md' ! -path ./CHANGELOG.md -printf '%P\n' | sort)
breaches=$({
  grep -nHoE "$date|\bcommit \`?$commit" "${pages[@]}" || (($? == 1))
  { grep -nHoE "$commit" "${pages[@]}" || (($? == 1)); } | grep -E ':[0-9a-f]*([0-9][a-f]|[a-f][0-9])[0-9a-f]*$' || (($? == 1))
} | sed -E 's/^([^:]*:[0-9]+):/\1: /' | sort -u -t : -k 1,1 -k 2,2n)

[[ -z $breaches ]] || { printf '%s\n' "$breaches" "$(wc -l <<<"$breaches") breaches: measurements belong to docs/measured" && exit 1; }
echo "${#pages[@]} pages without commits and dates"
