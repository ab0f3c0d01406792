#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Compares a run of one of these experiments with its bands: judge.sh RUN_DIR TEST_FOLDER
#
# Prints a table in Markdown. Exits with status 1 if a judged value is outside its band. TEST_FOLDER/bands.sql selects
# rows (model, what, measured, low, high, held) from the view measured(model, scenario, repetition, metric, value); low
# and high may be NULL; held = 0 reports a value without judging it. All runs are also judged by two conditions: nobody
# leaves the free space, and nobody overlaps anything by more than 5 cm.
set -euo pipefail
results=$1/results.sqlite
bands=$2/bands.sql

faults=$(sqlite3 -batch "$results" "SELECT count(*) FROM fault")
if ((faults > 0)); then
  echo "$faults faults in $1" >&2
  exit 1
fi

sqlite3 -batch -separator $'\t' "$results" "
  CREATE TEMP VIEW measured AS
    SELECT pedestrian_model AS model, scenario, repetition, metric, value
    FROM trial JOIN value ON trial_id = id WHERE subject_kind = 'system';
  $(cat "$bands")
  SELECT model,
    CASE metric WHEN 'outside_free_space' THEN 'people who left the free space'
                WHEN 'wall_overlap' THEN 'overlap with a wall, m' ELSE 'overlap of two people, m' END,
    max(value), 0, CASE metric WHEN 'outside_free_space' THEN 0 ELSE 0.05 END, 1
    FROM measured WHERE metric IN ('outside_free_space', 'wall_overlap', 'people_overlap')
    GROUP BY model, metric ORDER BY metric, model DESC;" |
  awk -F'\t' '
    BEGIN { print "| model | what | measured | band | |"; print "| --- | --- | ---: | --- | --- |" }
    {
      value = $3 == "" ? "none" : sprintf("%.4g", $3)
      band = $4 == "" && $5 == "" ? "" : $4 == "" ? "at most " sprintf("%.4g", $5) : \
             $5 == "" ? "at least " sprintf("%.4g", $4) : sprintf("%.4g to %.4g", $4, $5)
      inside = $3 != "" && ($4 == "" || $3 + 0 >= $4 + 0) && ($5 == "" || $3 + 0 <= $5 + 0)
      verdict = band == "" ? "" : inside ? "ok" : $6 == 1 ? "FAILED" : "outside, known"
      if (verdict == "FAILED") failed = 1
      printf "| %s | %s | %s | %s | %s |\n", $1, $2, value, band, verdict
    }
    END { exit failed }'
