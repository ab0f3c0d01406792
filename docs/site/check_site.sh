#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_site.sh SITE_DIR: every relative link of the pages leads to a file of the site, and every anchor to a place on its
# page. The headers' pages in api/ are Doxygen's own business. Prints each breach; exit status 1 if there is one.
set -euo pipefail
export LC_ALL=C
cd "$1"
mapfile -t pages < <(find . -name '*.html' ! -path './api/*' -printf '%P\n' | sort)
breaches=0 count=0
while IFS=$'\t' read -r page target; do
  count=$((count + 1))
  path=${target%%#*} path=${path%%\?*} anchor=
  [[ $target != *#* ]] || anchor=${target#*#}
  file=$page
  [[ -z $path ]] || file=$(realpath --canonicalize-missing --relative-to=. "$(dirname "$page")/$path")
  [[ ! -d $file ]] || file=$file/index.html
  if [[ ! -e $file ]]; then
    echo "$page: no such file: $target"
  elif [[ -n $anchor && $anchor != __* && $file == *.html ]] && ! grep -qF "id=\"$anchor\"" "$file"; then
    echo "$page: no such place: $target"
  else
    continue
  fi
  breaches=$((breaches + 1))
done < <(grep -oE '(href|src)="[^"]*"' -- "${pages[@]}" /dev/null |
  sed -E 's/^([^:]*):(href|src)="(.*)"$/\1\t\3/' | awk -F'\t' '$2 !~ /^([a-z]+:|\/|$)/' | sort -u)
((breaches == 0)) || { echo "$breaches of $count links of ${#pages[@]} pages lead nowhere" && exit 1; }
echo "${#pages[@]} pages, $count links: all lead somewhere"
