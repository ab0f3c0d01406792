#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The page of the toolkit lists every header, each with the first sentence of its own comment. Called as:
# toolkit.sh SOURCE_DIR [--update], which writes the table.
set -euo pipefail
export LC_ALL=C
cd "$1"
page=docs/toolkit.md

table() {
  echo "| header | what |"
  echo "| --- | --- |"
  local header
  for header in sdk/include/dmrp/toolkit/*; do
    awk -v name="$(basename "$header")" '
      /^\/\/ / && !/SPDX/ { text = text (text == "" ? "" : " ") substr($0, 4); next }
      text != "" { exit }
      END {
        if (index(text, name ": ") != 1) { print FILENAME ": does not begin with // " name ": ..." >"/dev/stderr"; exit 1 }
        text = substr(text, length(name) + 3)
        if (match(text, /\.( |$)/)) text = substr(text, 1, RSTART - 1)
        sub(/:$/, "", text)
        gsub(/\|/, "\\|", text)
        print "| [`" name "`](../sdk/include/dmrp/toolkit/" name ") | " text " |"
      }' "$header"
  done
}
table >/dev/null
if [[ ${2:-} == --update ]]; then
  { sed '/^| header/,$d' "$page" && table; } >"$page.new" && mv "$page.new" "$page"
elif ! diff <(grep '^|' "$page") <(table); then
  echo "$page is not what the headers say; if they are right: $0 $1 --update"
  exit 1
fi
