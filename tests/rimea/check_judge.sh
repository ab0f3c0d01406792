#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The judge passes values inside their bands and fails others, for a run made by hand.
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

sqlite3 -batch "$scratch/results.sqlite" "
  CREATE TABLE trial(id, scenario, pedestrian_model, repetition);
  CREATE TABLE value(trial_id, metric, subject_kind, subject, coordinate, value);
  CREATE TABLE fault(trial_id);
  INSERT INTO trial VALUES (0, 's', 'm', 0);
  INSERT INTO value VALUES (0, 'travel_time', 'system', NULL, NULL, 30.0), (0, 'wall_overlap', 'system', NULL, NULL, 0.05);"

# expect STATUS WORDS [SQL]: after the change, the judge exits with STATUS and prints WORDS
expect() {
  local output status=0
  sqlite3 -batch "$scratch/results.sqlite" "${3-}"
  output=$("$here/judge.sh" "$scratch" "$here/01_corridor" 2>&1) || status=$?
  [[ $status == "$1" && $output == *"$2"* ]] && return
  printf 'FAILED: expected status %s and "%s", not %s:\n%s\n' "$1" "$2" "$status" "$output" >&2
  exit 1
}

expect 0 '| m | time for 40 m, s | 30 | 26 to 34 | ok |'
expect 1 '| 34.1 | 26 to 34 | FAILED |' "UPDATE value SET value = 34.1 WHERE metric = 'travel_time'"
expect 1 '| none | 26 to 34 | FAILED |' "UPDATE value SET value = NULL WHERE metric = 'travel_time'"
expect 1 '| 0.06 | 0 to 0.05 | FAILED |' \
  "UPDATE value SET value = 30 WHERE metric = 'travel_time'; UPDATE value SET value = 0.06 WHERE metric = 'wall_overlap'"
expect 1 '1 faults' "UPDATE value SET value = 0 WHERE metric = 'wall_overlap'; INSERT INTO fault VALUES (0)"
expect 0 'ok' "DELETE FROM fault"
