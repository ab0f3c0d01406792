#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# check_program.sh PROGRAM ARGUMENT...: a benchmark's program runs, and its list has values. This does not test times.
set -euo pipefail
list=$(mktemp)
trap 'rm -f "$list"' EXIT
"$@" --json >"$list"
rows=$(sqlite3 -batch :memory: "SELECT count(*) FROM json_each(CAST(readfile('$list') AS TEXT))
  WHERE json_extract(value, '\$.name') <> '' AND json_extract(value, '\$.value') >= 0")
((rows > 0)) || { echo "no values: $(cat "$list")" && exit 1; }
