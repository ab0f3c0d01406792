#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A run has the same bits however it is divided among workers, processes and --resume.
source "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

experiment=$here/crossing.toml
run() {
  expect_status 0 "$host" "$experiment" --quiet "$@"
}

run --jobs 1 --out "$scratch/alone"
run --jobs 2 --out "$scratch/two"
run --jobs 2 --out "$scratch/again"
expected=$(values_of "$scratch/alone")
[[ $(query "$scratch/alone" "SELECT count(*) FROM trial WHERE outcome IN ('succeeded', 'failed')") == 12 ]] ||
  fail "12 trials should be finished"
[[ $(query "$scratch/alone" "SELECT count(*) FROM value WHERE value IS NOT NULL") -gt 100 ]] ||
  fail "there should be values to compare"
[[ $(query "$scratch/alone" "SELECT count(DISTINCT seed) FROM trial") == 3 ]] ||
  fail "a seed belongs to a repetition, not to a combination"
[[ $(values_of "$scratch/two") == "$expected" ]] || fail "--jobs 2 differs from --jobs 1"
[[ $(values_of "$scratch/again") == "$expected" ]] || fail "a second run differs from the first"

# --resume runs missing trials and leaves the others as they are
query "$scratch/two" "PRAGMA foreign_keys = ON; DELETE FROM trial WHERE id IN (0, 5, 11);"
[[ $(values_of "$scratch/two") != "$expected" ]] || fail "deleting rows should show"
kept="SELECT id, wall_time_s FROM trial WHERE id NOT IN (0, 5, 11) ORDER BY id"
before=$(query "$scratch/two" "$kept")
run --resume --jobs 2 --out "$scratch/two"
[[ $(values_of "$scratch/two") == "$expected" ]] || fail "--resume differs from a run in one go"
[[ $(query "$scratch/two" "$kept") == "$before" ]] || fail "--resume ran finished trials again"

# shards: disjoint, complete, the same trials
run --shard 0/2 --out "$scratch/even"
run --shard 1/2 --out "$scratch/odd"
ids() { query "$1" "SELECT group_concat(id, ' ') FROM (SELECT id FROM trial ORDER BY id)"; }
[[ $(ids "$scratch/even") == "0 2 4 6 8 10" ]] || fail "shard 0/2 has the trials $(ids "$scratch/even")"
[[ $(ids "$scratch/odd") == "1 3 5 7 9 11" ]] || fail "shard 1/2 has the trials $(ids "$scratch/odd")"
query "$scratch/even" "ATTACH '$scratch/odd/results.sqlite' AS odd; INSERT INTO trial SELECT * FROM odd.trial;
  INSERT INTO value SELECT * FROM odd.value; INSERT INTO event SELECT * FROM odd.event;"
[[ $(values_of "$scratch/even") == "$expected" ]] || fail "the shards together differ from a run in one go"

# the same with replanning, dispatch by waypoint and ordered execution
directed=$scratch/directed.toml
sed 's/dmrp.planner.individual/dmrp.planner.ecbs8/' "$experiment" >"$directed"
cat >>"$directed" <<'EOF'
[simulation]
dispatch        = "waypoint"
execution       = "ordered"
replan_period_s = 3
replan_stray_m  = 0.8
replan_stall_s  = 2.5
EOF
run_directed() {
  expect_status 0 "$host" "$directed" --quiet "$@"
}
run_directed --jobs 1 --out "$scratch/directed"
run_directed --jobs 2 --out "$scratch/directed_two"
query "$scratch/directed_two" "PRAGMA foreign_keys = ON; DELETE FROM trial WHERE id IN (1, 6);"
run_directed --resume --jobs 2 --out "$scratch/directed_two"
[[ $(values_of "$scratch/directed_two") == "$(values_of "$scratch/directed")" ]] ||
  fail "with replanning, --jobs 2 and --resume differ from --jobs 1"
[[ $(values_of "$scratch/directed") != "$expected" ]] || fail "dispatch and execution should change values"

# a run cannot be continued with another experiment
sed 's/^seed .*/seed = 8/' "$experiment" >"$scratch/other.toml"
expect_status 2 "$host" "$scratch/other.toml" --quiet --resume --out "$scratch/two"
# a run does not write into a folder that is not empty
expect_status 2 "$host" "$experiment" --quiet --out "$scratch/two"
