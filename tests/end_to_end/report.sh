#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A run writes report.html; `report` reproduces the same file; a folder that is no run directory gets an error of one
# line.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

run=$scratch/run
expect_status 0 "$host" "$here/crossing.toml" --out "$run"
grep -Eq "run   report.html  results.sqlite  traces/" "$scratch/stdout" || fail "the last line does not name the files"
cp "$run/report.html" "$scratch/before.html"
expect_status 0 "$host" report "$run"
[[ $(cat "$scratch/stdout") == "$run/report.html" ]] || fail "report does not print its file: $(cat "$scratch/stdout")"
cmp "$scratch/before.html" "$run/report.html" || fail "the same results give a different report"
grep -q "dmrp:" <(grep -E "^<!-- dmrp:(styles|data|scripts) -->$" "$run/report.html") && fail "a placeholder remains"
grep -Eq '<(script|img|iframe)[^>]* src=|<link[^>]* href="(http|/)' "$run/report.html" && fail "the page fetches something"

# a run that goes on is read: what is finished makes a page, and the run ends as it would
"$host" "$here/crossing.toml" --trials 60 --quiet --out "$scratch/live" &
live=$!
until [[ $(sqlite3 -batch "$scratch/live/results.sqlite" "SELECT count(*) FROM trial" 2>"$scratch/not_yet") -ge 2 ]]; do
  kill -0 $live || fail "the run ended before it was read: $(cat "$scratch/not_yet")"
  sleep 0.1
done
expect_status 0 "$host" report "$scratch/live"
grep -Eq '"trials_planned":240,"trials_finished":([2-9]|[1-9][0-9]+),' "$scratch/live/report.html" ||
  fail "the page of a run that goes on does not count its trials"
kill -INT $live
wait $live

# results for programs
expect_status 0 "$host" "$here/crossing.toml" --trials 1 --json --out "$scratch/json"
[[ $(head -c 1 "$scratch/stdout") == "{" && ! -s $scratch/stderr ]] || fail "--json prints something else"
found=$(sqlite3 :memory: "SELECT json_extract(j, '\$.trials.succeeded') + json_extract(j, '\$.trials.failed'),
  json_array_length(j, '\$.combinations') FROM (SELECT CAST(readfile('$scratch/stdout') AS TEXT) AS j)")
[[ $found == "4|4" ]] || fail "--json has $found"

# the data, without a browser
data() {
  sed -n 's|.*<script type="application/json" id="dmrp-data">\(.*\)</script>$|\1|p' "$run/report.html"
}
[[ $(data | wc -c) -gt 10000 ]] || fail "there are no data"
data | grep -q '"trials_planned":12,"trials_finished":12' || fail "the trials are not counted"
data | grep -q '"varied":"local_controller"' || fail "controllers are not compared"

# an interrupted run
query "$run" "PRAGMA foreign_keys = ON; DELETE FROM trial WHERE id > 4;"
expect_status 0 "$host" report "$run"
data | grep -q '"trials_planned":12,"trials_finished":5' || fail "missing trials are not counted"

# a run without trials, and folders that are no run directory
query "$run" "PRAGMA foreign_keys = ON; DELETE FROM trial;"
for error in "$run: no trial is finished" "$scratch: is no run directory \(no results.sqlite\)" "$scratch/none: is no run"; do
  expect_status 2 "$host" report "${error%%:*}"
  [[ $(messages) == 1 ]] || fail "not one line: $(cat "$scratch/stderr")"
  grep -Eq "$error" "$scratch/stderr" || fail "'$(cat "$scratch/stderr")' does not match '$error'"
done
